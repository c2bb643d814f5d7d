#!/usr/bin/python3
"""Debian's rosbag reads the bag with its own message classes; their checksums are those of the bag."""
import json

from consumer import SET, TOP, export, needed, patchlab

np = needed("numpy", "python3-numpy")
rosbag = needed("rosbag", "python3-rosbag")
genmsg = needed("genpy.dynamic", "python3-genpy")
geometry = needed("geometry_msgs.msg", "python3-geometry-msgs")
sensor = needed("sensor_msgs.msg", "python3-sensor-msgs")
visualization = needed("visualization_msgs.msg", "python3-visualization-msgs")
from patch_set import height, read  # noqa: E402
from ros_messages import DELETE_ALL, check_markers, check_points, check_pose  # noqa: E402

CLASSES = {"visualization_msgs/MarkerArray": visualization.MarkerArray, "sensor_msgs/PointCloud2": sensor.PointCloud2,
           "geometry_msgs/PoseWithCovarianceStamped": geometry.PoseWithCovarianceStamped}

patches = read(SET)
with rosbag.Bag(str(export("ros1-bag", "set.bag"))) as bag:
    info = bag.get_type_and_topic_info()
    assert {kind: known._md5sum for kind, known in CLASSES.items()} == info.msg_types
    for connection in bag._get_connections():  # the definitions that it carries mean the same
        made = genmsg.generate_dynamic(connection.datatype, connection.msg_def)[connection.datatype]
        assert made._md5sum == connection.md5sum and made._slot_types == CLASSES[connection.datatype]._slot_types
    messages = {topic: message for topic, message, _ in bag.read_messages()}
markers = messages["/patches"].markers
assert len(messages) == 21 and info.topics["/patches"].message_count == 1 and markers[0].action == DELETE_ALL
check_markers(markers[1:], patches)
for number, patch in enumerate(patches):
    topic = f"/patches/p{number}_{patch['id'].replace('-', '_')}"
    check_pose(messages[topic + "/pose"], patch)
    check_points(messages[topic + "/points"], number, patch)

# From a journal the clouds are the measured points, with the covariances of the noise model.
folder = export("ros1-bag", "set.bag").parent
journal, bag, written = TOP / "assets/sample.patchlab", folder / "replay.bag", folder / "replay.json"
patchlab("replay", journal, "-o", written, "--export", f"ros1-bag={bag}")
fits = [patch["fit"] for patch in json.loads(written.read_text())["patches"]]
with rosbag.Bag(str(bag)) as opened:
    clouds = [message for topic, message, _ in opened.read_messages() if topic.endswith("/points")]
assert len(clouds) == len(fits)
for cloud, fit, patch in zip(clouds, fits, read(written)):
    assert cloud.width == fit["points"] + fit["outliers"], (cloud.width, fit)
    values = np.frombuffer(bytes(cloud.data), "<f4").reshape(cloud.width, 10).astype(float)
    q = (values[:, :3] - patch["c"]) @ patch["R"]
    off = np.abs(q[:, 2] - height(patch, q[:, 0], q[:, 1]))
    spread = np.sqrt(values[:, 3] + values[:, 6] + values[:, 8])
    assert 0.1 < np.median(off) / np.median(spread) < 1 and np.median(spread) < 0.05, (np.median(off), np.median(spread))
