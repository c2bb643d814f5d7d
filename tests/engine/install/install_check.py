#!/usr/bin/python3
"""install_check.py BUILD SET FLAGS: installs the engine from its build folder, builds a program against what that left, in
folders of its own, and runs it. FLAGS are those of the compiler (sanitizers)."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
BUILD, SET, FLAGS = sys.argv[1:4]


def run(*command):
    ran = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    assert ran.returncode == 0, f"{command}\n{ran.stdout}\n{ran.stderr}"
    return ran.stdout


def check_headers(headers):
    """None shows PCL, GL or ImGui but the one of the component; none is left that includes what is not there."""
    for header in headers.rglob("*.h"):
        for include in re.findall(r'#include [<"]([^>"]+)[>"]', header.read_text(encoding="utf-8")):
            assert not re.match(r"(GL|EGL|GLFW|epoxy|imgui|viewer)", include), (header, include)
            assert not include.startswith("pcl/") or header.name == "pcl.h", (header, include)
            assert not include.startswith("engine/") or (headers / include).is_file(), (header, include)


with tempfile.TemporaryDirectory(prefix="patchlab_install_") as folder:
    prefix, out = pathlib.Path(folder, "prefix"), pathlib.Path(folder, "build")
    for component in "engine", "pcl":
        run("cmake", "--install", BUILD, "--prefix", prefix, "--component", component)
    check_headers(prefix / "include/patchlab")
    run("cmake", "-S", HERE / "consumer", "-B", out, f"-DCMAKE_PREFIX_PATH={prefix}", f"-DCMAKE_CXX_FLAGS={FLAGS}")
    run("cmake", "--build", out)
    lines = run(out / "consumer", SET).splitlines()
    ids = [patch["id"] for patch in json.loads(pathlib.Path(SET).read_text(encoding="utf-8"))["patches"]]
    assert [line.split()[0] for line in lines] == ids and all(float(line.split()[1]) > 0 for line in lines)
    run(out / "pcl_consumer")
    assert run(prefix / "bin/patchlab", "--version")
