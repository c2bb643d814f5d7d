#!/usr/bin/python3
"""What holds for every file of the tree: CMake knows it, it names no developer's machine, it holds no leftovers.

tree_check.py              checks the tree, prints one line for each fault
tree_check.py --self-test  plants one fault of each kind and checks that it is found
"""
import posixpath
import re
import sys

from tree import read_tree, report

MACHINE = re.compile(r"(?<![\w.])/(?:home|root|Users|work)/\w")
LEFTOVER = re.compile(r"\b(?:TO" r"DO|FIX" r"ME|XX" r"X)\b|^[<>]{7} ")


def nearest_cmake(tree, path):
    folder = posixpath.dirname(path)
    while folder and posixpath.join(folder, "CMakeLists.txt") not in tree:
        folder = posixpath.dirname(folder)
    return posixpath.join(folder, "CMakeLists.txt")


def unlisted_sources(tree):
    """Sources and shaders that no CMakeLists.txt names: they would never be built, or their tests never run."""
    for path in tree:
        if not re.match(r"(engine|viewer|tests)/.*\.cc$", path):
            continue
        cmake = nearest_cmake(tree, path)
        names = re.split(r"[\s()\"]+", tree.get(cmake, ""))
        if posixpath.relpath(path, posixpath.dirname(cmake) or ".") not in names:
            yield f"{path}: {cmake} does not list it"


def line_faults(path, text):
    for number, line in enumerate(text.split("\n"), 1):
        if MACHINE.search(line):
            yield f"{path}:{number}: names a path of a developer's machine"
        if LEFTOVER.search(line):
            yield f"{path}:{number}: unfinished business"
        if line != line.rstrip():
            yield f"{path}:{number}: blanks at the end of the line"


def faults(tree):
    found = list(unlisted_sources(tree))
    for path, text in tree.items():
        if path.startswith("assets/"):
            continue
        found += line_faults(path, text)
        if text and not text.endswith("\n"):
            found.append(f"{path}: its last line has no end")
    return found


PLANTS = (
    ("engine/fit/lost.cc", "\n", True),
    ("engine/fit/fit_patch.cc", "\n", False),
    ("tests/engine/fit/fit_test.cc", "\n", False),
    ("tests/engine/fit/lost_test.cc", "\n", True),
    ("README.md", "see /" + "home/someone/scan.pcd\n", True),
    ("README.md", "see ../shared/scans and https://example.org/home/page\n", False),
    ("engine/fit/fit_patch.h", "// TO" + "DO: more\n", True),
    ("engine/fit/fit_patch.h", "int a; \n", True),
    ("engine/fit/fit_patch.h", "int a;", True),
)
STANDING = {"engine/fit/CMakeLists.txt": "patchlab_room(fit SOURCES fit_patch.cc)\n",
            "tests/engine/fit/CMakeLists.txt": "patchlab_test(fit_test SOURCES fit_test.cc LINKS patchlab::fit)\n"}


def self_test():
    assert not faults(STANDING)
    wrong = [path for path, text, is_fault in PLANTS if bool(faults({**STANDING, path: text})) != is_fault]
    return report([f"the plant {path} is judged wrongly" for path in wrong])


if __name__ == "__main__":
    sys.exit(self_test() if sys.argv[1:] == ["--self-test"] else report(faults(read_tree())))
