#!/usr/bin/python3
"""NumPy reads the table and the patch set, and finds the same bits in both."""
from consumer import SET, export, needed

np = needed("numpy", "python3-numpy")
from patch_set import height, read  # noqa: E402


def vertices(file):
    """The vertices of a binary PLY, by the types that its header announces."""
    data = file.read_bytes()
    header, body = data.split(b"end_header\n", 1)
    lines = header.decode().splitlines()
    kinds = {"double": "<f8", "uint": "<u4"}
    fields = [(line.split()[2], kinds[line.split()[1]]) for line in lines if line.startswith("property") and "list" not in line]
    count = int(next(line for line in lines if line.startswith("element vertex")).split()[2])
    return np.frombuffer(body, np.dtype(fields), count)


def check_table(patches):
    table = np.genfromtxt(export("csv", "set.csv"), delimiter=",", names=True, dtype=None, encoding="utf-8")
    assert len(table) == len(patches) == 10
    for row, patch in zip(table, patches):
        names, size = patch["parameters"]["names"], len(patch["parameters"]["names"])
        assert row["id"] == patch["id"] and row["surface"] == patch["surface"] and row["size"] == size
        assert [row[name] for name in names] == patch["parameters"]["values"]
        assert np.array_equal([row["sigma_" + name] for name in names], patch["sigma"])
        upper = [[row[f"cov_{i + 1}_{j + 1}"] for j in range(i, size)] for i in range(size)]
        assert all(np.array_equal(upper[i], patch["covariance"][i, i:]) for i in range(size))
        assert np.isnan(row["cov_11_11"]) == (size < 11) and np.isnan(row["kappa_x"]) == ("kappa_x" not in names)


def check_surfaces(patches):
    """The triangles lie on the surfaces as the thirty lines compute them, and their normals point out."""
    mesh = vertices(export("ply", "set.ply"))
    for number, patch in enumerate(patches):
        own = mesh[mesh["patch"] == number]
        q = (np.column_stack([own["x"], own["y"], own["z"]]) - patch["c"]) @ patch["R"]
        assert len(own) > 500 and np.abs(q[:, 2] - height(patch, q[:, 0], q[:, 1])).max() < 1e-15
        assert (np.column_stack([own["nx"], own["ny"], own["nz"]]) @ patch["R"][:, 2]).min() > 0
        assert (own["height_sigma"] > 0).all()


set_of_ten = read(SET)
check_table(set_of_ten)
check_surfaces(set_of_ten)
assert all(np.allclose(patch["R"] @ patch["R"].T, np.eye(3), atol=1e-15) for patch in set_of_ten)
