"""What the checks of exports by Python programs share.

Each check is run as CHECK.py PATCHLAB: it exports ten_types.json, one fitted patch of each type, with that program into a
folder of its own, and holds what its consumer reads against what assets/patch_set.py reads of the set itself.
"""
import importlib
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
TOP = HERE.parents[2]
SET = HERE / "ten_types.json"
NOT_PROVEN = 77  # the exit status that ctest takes for skipped

sys.path.insert(0, str(TOP / "assets"))


def needed(module, package):
    """The module; the check is skipped, by name, where it is not installed."""
    try:
        return importlib.import_module(module)
    except ImportError:
        print(f"NOT PROVEN: {module} is not installed (Debian package {package})")
        sys.exit(NOT_PROVEN)


def patchlab(*arguments, status=0):
    ran = subprocess.run([sys.argv[1], *map(str, arguments)], capture_output=True, text=True, check=False)
    assert ran.returncode == status, ran.stderr
    return ran


def export(name, file, *options):
    """The file or folder that the format was written to; gone when the check ends."""
    folder = tempfile.TemporaryDirectory(prefix="patchlab_export_")
    KEPT.append(folder)
    place = pathlib.Path(folder.name) / file
    patchlab("export", SET, "--format", name, "-o", place, *options)
    return place


KEPT = []
