#!/usr/bin/python3
"""PyYAML, which ros2 topic pub parses its argument with, reads each file as a message of the type in its first line."""
import types

from consumer import SET, export, needed

np = needed("numpy", "python3-numpy")
yaml = needed("yaml", "python3-yaml")
from patch_set import read  # noqa: E402
from ros_messages import check_markers, check_points, check_pose  # noqa: E402

FLOAT, WHOLE, TRUTH, TEXT = "float", "int", "bool", "str"
XYZ = {"x": FLOAT, "y": FLOAT, "z": FLOAT}
POSE = {"position": XYZ, "orientation": {**XYZ, "w": FLOAT}}
HEADER = {"stamp": {"sec": WHOLE, "nanosec": WHOLE}, "frame_id": TEXT}
COLOUR = {"r": FLOAT, "g": FLOAT, "b": FLOAT, "a": FLOAT}
# The fields of the ROS 2 messages; [x] is a sequence of x.
FIELDS = {
    "visualization_msgs/msg/MarkerArray": {"markers": [{
        "header": HEADER, "ns": TEXT, "id": WHOLE, "type": WHOLE, "action": WHOLE, "pose": POSE, "scale": XYZ, "color": COLOUR,
        "lifetime": {"sec": WHOLE, "nanosec": WHOLE}, "frame_locked": TRUTH, "points": [XYZ], "colors": [COLOUR]}]},
    "geometry_msgs/msg/PoseWithCovarianceStamped": {"header": HEADER, "pose": {"pose": POSE, "covariance": [FLOAT]}},
    "sensor_msgs/msg/PointCloud2": {
        "header": HEADER, "height": WHOLE, "width": WHOLE, "is_bigendian": TRUTH, "point_step": WHOLE, "row_step": WHOLE,
        "fields": [{"name": TEXT, "offset": WHOLE, "datatype": WHOLE, "count": WHOLE}], "data": [WHOLE], "is_dense": TRUTH},
}


EMPTY = {FLOAT: 0.0, WHOLE: 0, TRUTH: False, TEXT: ""}


def message(value, fields):
    """The value as an object with the fields of its message; one that it lacks is empty, one of another name fails."""
    if isinstance(fields, list):
        return [message(element, fields[0]) for element in value or []]
    if isinstance(fields, str):
        assert value is None or type(value).__name__ == fields, (value, fields)
        return EMPTY[fields] if value is None else value
    assert set(value or {}) <= set(fields), (set(value), set(fields))
    return types.SimpleNamespace(**{name: message((value or {}).get(name), inner) for name, inner in fields.items()})


def read_message(file, expected_topic):
    text = file.read_text(encoding="utf-8")
    assert len(text) < 131072  # what Linux takes as one argument of a command
    topic, kind = text.split("\n", 1)[0].split()[5:7]
    assert topic == expected_topic
    return message(yaml.load(text, getattr(yaml, "CSafeLoader", yaml.SafeLoader)), FIELDS[kind])


patches = read(SET)
place = export("ros2-yaml", "set")
assert len(list(place.iterdir())) == 30
for number, patch in enumerate(patches):
    name = f"p{number}_{patch['id'].replace('-', '_')}"
    check_markers(read_message(place / f"{name}.markers.yaml", "/patches").markers, [patch])
    check_pose(read_message(place / f"{name}.pose.yaml", f"/patches/{name}/pose"), patch)
    check_points(read_message(place / f"{name}.points.yaml", f"/patches/{name}/points"), number, patch)
