"""What holds for the messages of a patch set, whoever read them: objects of a bag, or of YAML."""
import math

import numpy as np
from patch_set import height

TRIANGLES, LINE_STRIP, SPHERE, DELETE_ALL = 11, 4, 2, 3


def vector(v):
    return np.array([v.x, v.y, v.z])


def turn(q):
    x, y, z, w = q.x, q.y, q.z, q.w
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def on_surface(patch, points):
    q = np.array([vector(point) for point in points])
    return np.abs(q[:, 2] - height(patch, q[:, 0], q[:, 1])).max() < 1e-15


def check_markers(markers, patches):
    assert len(markers) == 3 * len(patches) == len({(m.ns, m.id) for m in markers})
    for number, patch in enumerate(patches):
        surface, outline, ellipsoid = markers[3 * number:3 * number + 3]
        for marker in surface, outline, ellipsoid:
            assert marker.ns == patch["id"] and marker.header.frame_id == patch["frame_id"] and marker.color.a > 0
            assert np.allclose(vector(marker.pose.position), patch["c"], rtol=0, atol=1e-15)
        assert (surface.type, outline.type, ellipsoid.type) == (TRIANGLES, LINE_STRIP, SPHERE)
        assert np.allclose(turn(surface.pose.orientation), patch["R"], rtol=0, atol=1e-14)
        assert len(surface.points) % 3 == 0 and on_surface(patch, surface.points) and on_surface(patch, outline.points)
        assert np.array_equal(vector(surface.scale), [1, 1, 1])
        assert np.array_equal(vector(outline.points[0]), vector(outline.points[-1]))
        check_ellipsoid(patch, ellipsoid)


def check_ellipsoid(patch, marker):
    """Diameters of the 95 % ellipsoid of c along right-handed axes: that is its covariance again."""
    axes, diameters = turn(marker.pose.orientation), vector(marker.scale)
    covariance = axes @ np.diag((diameters / 2) ** 2 / 7.814727903251179) @ axes.T
    expected = patch["covariance"][-3:, -3:]
    assert np.allclose(covariance, expected, rtol=1e-6, atol=1e-9 * np.trace(expected))
    assert abs(np.linalg.det(axes) - 1) < 1e-12


def check_pose(message, patch):
    assert message.header.frame_id == patch["frame_id"]
    assert np.array_equal(vector(message.pose.pose.position), patch["c"])
    assert np.allclose(turn(message.pose.pose.orientation), patch["R"], rtol=0, atol=1e-14)
    covariance = np.array(message.pose.covariance).reshape(6, 6)
    assert np.array_equal(covariance, patch["pose"]["covariance_ros"])
    assert np.linalg.eigvalsh(covariance)[0] > 0
    assert np.allclose(covariance[:3, :3], patch["covariance"][-3:, -3:], rtol=1e-9, atol=1e-15)
    spin = patch["R"][:, 2] @ covariance[3:, 3:] @ patch["R"][:, 2]
    assert (abs(spin - math.pi ** 2 / 3) < 1e-12) == (not patch["spin_observable"])


def check_points(message, number, patch):
    names = ["x", "y", "z", "cov_xx", "cov_xy", "cov_xz", "cov_yy", "cov_yz", "cov_zz", "patch"]
    assert [field.name for field in message.fields] == names and [field.offset for field in message.fields] == list(range(0, 40, 4))
    assert [field.datatype for field in message.fields] == 9 * [7] + [6] and all(field.count == 1 for field in message.fields)
    assert message.point_step == 40 and message.row_step == 40 * message.width and message.height == 1
    cloud = np.frombuffer(bytes(message.data), np.dtype([(name, "<f4") for name in names[:-1]] + [("patch", "<u4")]))
    assert len(cloud) == message.width > 50 and not message.is_bigendian and message.is_dense
    q = (np.column_stack([cloud["x"], cloud["y"], cloud["z"]]).astype(float) - patch["c"]) @ patch["R"]
    assert np.abs(q[:, 2] - height(patch, q[:, 0], q[:, 1])).max() < 1e-5 and (cloud["patch"] == number).all()
    assert message.header.frame_id == patch["frame_id"] and (cloud["cov_xx"] + cloud["cov_yy"] + cloud["cov_zz"] > 0).all()
