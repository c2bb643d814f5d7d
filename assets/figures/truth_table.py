#!/usr/bin/python3
"""truth_table.py PATCHES.json TRUTH.json: fitted patches beside the surfaces they were scanned from, as Markdown.

Both are compared where the fitted patch has its centre: how far the true surface lies from it along the fitted normal,
and by how much the two normals differ, in units and in standard deviations that the fit states."""
import json
import math
import sys

import numpy as np


def rotation(r):
    angle = np.linalg.norm(r)
    if angle == 0:
        return np.eye(3)
    x, y, z = np.asarray(r) / angle
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * K + (1 - math.cos(angle)) * K @ K


class Surface:
    def __init__(self, patch):
        p = dict(zip(patch["parameters"]["names"], patch["parameters"]["values"]))
        kind = patch["surface"]
        self.kind = kind
        self.R = rotation([p["r_x"], p["r_y"], p.get("r_z", 0.0)])
        self.c = np.array([p["c_x"], p["c_y"], p["c_z"]])
        k = p.get("kappa", 0.0)
        self.K = np.diag({
            "elliptic_paraboloid": [p.get("kappa_x", 0), p.get("kappa_y", 0), 0],
            "hyperbolic_paraboloid": [p.get("kappa_x", 0), p.get("kappa_y", 0), 0],
            "cylindric_paraboloid": [0, k, 0], "circular_paraboloid": [k, k, 0], "plane": [0, 0, 0],
            "sphere": [k, k, k], "circular_cylinder": [0, k, k]}[kind])

    def value(self, q):  # f = q'Kq - 2 z'q
        return q @ self.K @ q - 2 * q[2]

    def gradient(self, q):
        return 2 * self.K @ q - np.array([0, 0, 2.0])


def meet(surface, point, direction):
    """How far along `direction` from `point` the surface is, by Newton's method, and its normal there."""
    q, d, s = surface.R.T @ (point - surface.c), surface.R.T @ direction, 0.0
    for _ in range(30):
        at = q + s * d
        s -= surface.value(at) / (surface.gradient(at) @ d)
    normal = -surface.gradient(q + s * d)
    return s, surface.R @ (normal / np.linalg.norm(normal))


def compare(fitted, true):
    fit, truth = Surface(fitted), Surface(true)
    away, normal = meet(truth, fit.c, fit.R[:, 2])
    tilt = (fit.R.T @ (normal if normal @ fit.R[:, 2] > 0 else -normal))[:2]
    cov, names = np.array(fitted["covariance_local"]["values"]), fitted["covariance_local"]["names"]
    at = {name: i for i, name in enumerate(names)}
    turn = [at.get("w_x", at.get("tilt_x")), at.get("w_y", at.get("tilt_y"))]
    # What stays put is the place, not the vertex: a patch that slides along a curved surface turns with it.
    J = np.zeros((3, len(names)))
    J[0, at["t_z"]] = 1
    J[1, turn[1]], J[1, at["t_x"]] = 1, fit.K[0, 0]
    J[2, turn[0]], J[2, at["t_y"]] = -1, fit.K[1, 1]
    C = J @ cov @ J.T
    return away, away / math.sqrt(C[0, 0]), np.linalg.norm(tilt), math.sqrt(tilt @ np.linalg.solve(C[1:, 1:], tilt) / 2)


def main():
    fitted, truth = (json.load(open(name)) for name in sys.argv[1:3])
    true = {patch["name"]: patch for patch in truth["patches"]}
    print("""# Lassos on the sample rock field, beside the truth

Each row is a lasso of `lassos.patchlab`, fitted with the surface that the evidence chose. Where the fitted patch has its
centre: how far the true surface lies from it along the fitted normal, and by how much the two normals differ, each also in
standard deviations that the fit states (of the normal: root mean square of two). A paraboloid's vertex is by definition at
the middle of its points; a lasso round the flank of a larger paraboloid is a surface of its own, whose normal may differ by
more than noise. Patches that validation does not accept say so themselves.
""")
    print("| lasso round | truth | fitted | points | accepted | off, mm | in σ | normal off, mrad | in σ |")
    print("| --- | --- | --- | ---: | --- | ---: | ---: | ---: | ---: |")
    for patch in fitted["patches"]:
        away, z, tilt, z_tilt = compare(patch, true[patch["name"]])
        words = [surface.replace("_", " ") for surface in (true[patch["name"]]["surface"], patch["surface"])]
        print(f"| {patch['name']} | {words[0]} | {words[1]} | {patch['fit']['points']} | "
              f"{'yes' if patch['fit']['accepted'] else 'no'} | {1e3 * away:.2f} | {z:.1f} | {1e3 * tilt:.1f} | {z_tilt:.1f} |")


if __name__ == "__main__":
    main()
