#!/usr/bin/python3
"""Small valid files that the damage starts from, a folder for each target: make_seeds.py SOURCE_FOLDER SEED_FOLDER."""
import json
import pathlib
import struct
import sys
import zlib

PCD = (b"# .PCD v0.7\nVERSION 0.7\nFIELDS x y z _ label\nSIZE 4 8 4 1 2\nTYPE F F F U U\nCOUNT 1 1 1 0 1\nWIDTH 3\nHEIGHT 2\n"
       b"VIEWPOINT 0 0 1 1 0 0 0\nPOINTS 6\n")
PCD_COVARIANCES = (b"VERSION .7\nFIELDS x y z covariance vp_x vp_y vp_z rgb\nSIZE 4 4 4 4 4 4 4 4\nTYPE F F F F F F F U\n"
                   b"COUNT 1 1 1 9 1 1 1 1\nWIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 1 0 1 0 0\nPOINTS 2\n")
PLY = (b"ply\nformat %s 1.0\ncomment small\nobj_info num_cols 3\nelement face 1\nproperty list uchar ushort vertex_indices\n"
       b"element vertex 3\nproperty float x\nproperty double y\nproperty short z\nproperty uchar red\nproperty uchar green\n"
       b"property uchar blue\nend_header\n")
PLY_CAMERA = (b"ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
              b"element camera 1\n" + b"".join(b"property float %s\n" % name for name in (
                  b"view_px view_py view_pz x_axisx x_axisy x_axisz y_axisx y_axisy y_axisz z_axisx z_axisy z_axisz").split()) +
              b"property int viewportx\nproperty int viewporty\nelement range_grid 2\n"
              b"property list uchar int vertex_indices\nend_header\n1 2 3\n4 5 6\n0 0 1 1 0 0 0 -1 0 0 0 -1 2 1\n1 0\n0\n")
FACE = b"\3\0\0\1\0\2\0"
JOINT = ('<joint name="{0}" type="{1}"><parent link="{2}"/><child link="{3}"/><origin xyz="0 0.1 -0.2" rpy="0 0.3 0"/>'
         '<axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/>{4}</joint>')
PLANE = {"surface": "plane", "boundary": "rectangle", "parameters": {
    "names": ["d_x", "d_y", "r_x", "r_y", "r_z", "c_x", "c_y", "c_z"], "values": [0.2, 0.1, 0, 3.1, 0, 0, 0.1, 1]}}


def png(rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 16, 0, 0, 0, 0)
    samples = b"".join(b"\0" + struct.pack(f">{len(row)}H", *row) for row in rows)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(samples)) + chunk(b"IEND", b"")


def literals(points):
    """LZF that repeats nothing."""
    return b"".join(bytes([len(points[i:i + 32]) - 1]) + points[i:i + 32] for i in range(0, len(points), 32))


def compressed(data, size):
    return PCD + b"DATA binary_compressed\n" + struct.pack("<II", len(data), size) + data


def scans():
    vertices = [struct.pack(order + "fdh3B", i, .5, -i, 9, 8, 7) for order in ("<", ">") for i in range(3)]
    triangle = struct.pack("<12f", 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 1, 0) + b"\0\0"
    point = struct.pack("<3f", 1, 2, 3) + struct.pack("<9f", 1e-6, 0, 0, 0, 1e-6, 0, 0, 0, 1e-6) + struct.pack("<3fI", 0, 0, 1, 7)
    yield "read_pcd", [PCD + b"DATA ascii\n0 1 2 1\n1 1e0 2 2\n-2 1 .5 3\nnan nan nan 0\n3 3 3 4\n5 5 5 5\n",
                       PCD + b"DATA binary\n" + b"\1" * 108, compressed(literals(b"\1" * 108), 108),
                       compressed(b"\3\0\0\0\0\xe0\x5f\0", 108), PCD_COVARIANCES + b"DATA binary\n" + 2 * point]
    yield "read_ply", [PLY % b"ascii" + b"3 0 1 2\n1 2 3 9 9 9\n.5 5 6 8 8 8\n-1e0 8 9 7 7 7\n", PLY_CAMERA,
                       PLY % b"binary_little_endian" + FACE + b"".join(vertices[:3]),
                       PLY % b"binary_big_endian" + b"\3\0\0\0\1\0\2" + b"".join(vertices[3:])]
    yield "read_point_table", [b"x,y,z,cxx,cxy,cxz,cyy,cyz,czz,label\n1,2,3,1e-6,0,0,1e-6,0,1e-6,1\n4,5,6,1e-6,0,0,1e-6,0,1e-6,2\n",
                               b"1 2 3 4\n5 6 7 8\n\n9 1e1 -11 12\n", b"//X Y Z vp_x vp_y vp_z sigma\n1 2 3 0 0 0 .1\n4 5 6 1 1 1 .2\n",
                               b'"x";"y";"z";sigma_range;sigma_lateral\r\n1;2;3;.1;.2\r\n']
    yield "read_obj", [b"# mesh\nv 1 2 3\nv 4 5 6 1\nvn 0 0 1\nv -7 8 .9\nf 1//1 2//1 3//1\nf -1 -2 \\\n -3\n"]
    yield "read_off", [b"OFF\n3 1 0\n1 2 3\n4 5 6\n7 8 9\n3 0 1 2\n", b"COFF 1 0 0\n1 2 3 255 0 0 255\n"]
    yield "read_stl", [b" " * 80 + struct.pack("<I", 2) + 2 * triangle,
                       b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\nendsolid\n"]
    yield "read_kitti", [struct.pack("<8f", 10, -2, .5, .25, 20, 3, -1.5, 0), struct.pack("<5f", 10, -2, .5, 12, 31)]
    yield "read_depth_image", [b"P5\n# depths\n3 2\n65535\n" + b"\3" * 12, png([(0, 1000, 2000, 1), (500, 501, 502, 2)])]


def other_files(source):
    def of_json(value):
        return json.dumps(value).encode()
    covariance = [[1e-4 if i == k else 0 for i in range(6)] for k in range(6)]
    chain = {"elements": [{"r": [0.1, -0.2, 0.3], "t": [0.5, 0, 0.2], "phi": 1, "covariance": covariance},
                          {"r": [0, 0.4, 0], "t": [0.1, 0.1, 0], "phi": -1}]}
    scene = {"format": "patchlab.scene", "version": 1, "noise": "kinect1", "objects": [{"name": "table", "patch": PLANE}],
             "camera": {"width": 16, "height": 12, "fx": 20, "fy": 20, "cx": 8, "cy": 6, "depth_step": 0.001, "missing": 0.1,
                        "pose": {"position": [0, 0, 0], "quaternion_xyzw": [0, 0, 0, 1]}}}
    robot = ('<?xml version="1.0"?>\n<robot name="r"><link name="a"/><link name="b"/><link name="c"/><link name="d"/>' +
             JOINT.format("ab", "revolute", "a", "b", "") + JOINT.format("bc", "prismatic", "b", "c", "") +
             JOINT.format("cd", "revolute", "c", "d", '<mimic joint="ab" multiplier="-1" offset="0.1"/>') + "</robot>\n")
    truth = json.loads((source / "assets/bench.truth.json").read_text())
    yield "intrinsics", [b"585,585,320,240", b"585 0 320\n0 585 240\n0 0 1\n",
                         b'{"width": 640, "height": 480, "intrinsic_matrix": [585, 0, 0, 0, 585, 0, 320, 240, 1]}',
                         b"image_width: 640\nimage_height: 480\ndistortion_model: plumb_bob\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
                         b"  data: [585, 0, 320, 0, 585, 240, 0, 0, 1]\ndistortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n"]
    yield "journal", [(source / "assets/sample.patchlab").read_bytes()]
    yield "patch_set", [of_json({**truth, "patches": truth["patches"][:2]})]
    yield "urdf", [robot.encode()]
    yield "robot_patches", [of_json({"format": "patchlab.robot_patches", "version": 1, "urdf": "r.urdf", "patches": [
        {"id": "sole", "link": "d", **PLANE, "covariance": None}]})]
    yield "joints", [of_json({"joints": {"ab": {"value": 0.3, "sigma": 0.002}, "bc": {"value": 0.1, "sigma": 0.001}},
                              "base_in": "body", "link_tolerance": {"rotation": 0.001, "translation": 0.0005}}),
                     b"joint,value,sigma\nab,0.3,0.002\nbc,0.1,0.001\n"]
    yield "chain", [of_json(chain)]
    yield "pose", [of_json(chain), of_json({"r": [0.1, 0, 0], "t": [1, 2, 3], "covariance": covariance})]
    yield "region", [b"0\n5\n17\n", b'{"indices": [0, 5, 17]}']
    yield "scene", [of_json(scene)]


def main(source, folder):
    files = dict(scans())
    files["read_scan"] = [data for name, seeds in files.items() for data in seeds if name != "read_kitti"]  # by its ending only
    files.update(other_files(pathlib.Path(source)))
    for name, seeds in files.items():
        (pathlib.Path(folder) / name).mkdir(parents=True, exist_ok=True)
        for number, data in enumerate(seeds):
            (pathlib.Path(folder) / name / f"seed{number:02}").write_bytes(data)


if __name__ == "__main__":
    main(*sys.argv[1:])
