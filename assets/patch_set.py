"""Reads a patch set of patchlab with NumPy alone: what each number means, in thirty lines.

    for patch in read("patches.json"): print(patch["id"], patch["surface"], patch["sigma"])
"""
import json

import numpy as np


def rotation(r):
    """R(r): turns by |r| rad about r; its columns are the patch's axes x, y and z, the outward normal."""
    angle = np.linalg.norm(r)
    x, y, z = r / angle if angle > 0 else r
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def height(patch, x, y):
    """z(x, y) in the patch's own axes; kappa > 0 bends towards +z. A point there is R @ (x, y, z) + c."""
    a, b, curved = *patch["kappa"], patch["surface"] in ("sphere", "circular_cylinder")
    s = a * x**2 + b * y**2
    return s / (1 + np.sqrt(np.clip(1 - max(a, b, key=abs) * s, 0, None))) if curved else s / 2


def read(file):
    with open(file, encoding="utf-8") as stream:
        patches = json.load(stream)["patches"]
    for patch in patches:
        value = dict(zip(patch["parameters"]["names"], patch["parameters"]["values"]))
        both = value.get("kappa", 0.0)
        along_x = 0.0 if "cylind" in patch["surface"] else both
        patch["kappa"] = value.get("kappa_x", along_x), value.get("kappa_y", both)
        patch["R"] = rotation(np.array([value["r_x"], value["r_y"], value.get("r_z", 0.0)]))
        patch["c"] = np.array([value["c_x"], value["c_y"], value["c_z"]])
        patch["covariance"] = np.array(patch["covariance"]) if patch["covariance"] else None
        patch["sigma"] = None if patch["covariance"] is None else np.sqrt(np.diag(patch["covariance"]))
    return patches
