#!/usr/bin/python3
"""Debian's rosbag reads the bag with its own message classes; their checksums are those of the bag."""
from consumer import SET, export, needed

np = needed("numpy", "python3-numpy")
rosbag = needed("rosbag", "python3-rosbag")
genmsg = needed("genpy.dynamic", "python3-genpy")
geometry = needed("geometry_msgs.msg", "python3-geometry-msgs")
sensor = needed("sensor_msgs.msg", "python3-sensor-msgs")
visualization = needed("visualization_msgs.msg", "python3-visualization-msgs")
from patch_set import read  # noqa: E402
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
