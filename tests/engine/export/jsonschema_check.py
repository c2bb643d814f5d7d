#!/usr/bin/python3
"""python3-jsonschema accepts what is written, and refuses a file with one thing wrong."""
import copy
import json

from consumer import SET, TOP, export, needed

jsonschema = needed("jsonschema", "python3-jsonschema")


def validator(name):
    schema = json.loads((TOP / "assets/schema" / f"{name}.schema.json").read_text(encoding="utf-8"))
    jsonschema.Draft7Validator.check_schema(schema)
    return jsonschema.Draft7Validator(schema)


def wrong_sets(document):
    """Each with one thing wrong."""
    for path, value in (("format", "other"), ("version", 2), ("units", {"length": "mm", "angle": "rad"}), ("correlations", "some"),
                        ("patches", {})):
        yield {**document, path: value}
    for path, value in (("surface", "torus"), ("id", ""), ("covariance", [[1.0]]), ("parameters", {"names": [], "values": []}),
                        ("pose", {"position": [0, 0, 0], "quaternion_xyzw": [0, 0, 1]})):
        other = copy.deepcopy(document)
        other["patches"][0][path] = value
        yield other


sets, footholds = validator("patch_set"), validator("footholds")
conventions = [word for name in ("right_rot_trans", "left_rot_trans", "ros_fixed_axes") for word in ("--covariance", name)]
written = json.loads(export("patch_set", "set.json", *conventions).read_text(encoding="utf-8"))
sets.validate(written)
assert len(written["patches"]) == 10 and len(written["patches"][0]["pose"]) == 6
for wrong in wrong_sets(written):
    assert not sets.is_valid(wrong)
places = json.loads(export("footholds", "feet.json", "--inset-sigmas", "1").read_text(encoding="utf-8"))
footholds.validate(places)
assert len(places["footholds"]) == 10
places["footholds"][3]["polygon"] = places["footholds"][3]["polygon"][:2]
assert not footholds.is_valid(places)
assert export("patch_set", "set.json").read_bytes() == SET.read_bytes()
