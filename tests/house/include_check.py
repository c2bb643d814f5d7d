#!/usr/bin/python3
"""Who may include what: the floors of the house, and the edge at which each large library is seen.

include_check.py              checks the tree, prints one line for each fault
include_check.py --self-test  plants one fault of each kind and checks that it is found
"""
import collections
import re
import sys

from tree import read_tree, report

# Lowest floor first. A room includes itself and rooms of lower floors, never a neighbour on its own floor.
FLOORS = (
    ("engine/base",),
    ("engine/pose", "engine/scan"),
    ("engine/patch",),
    ("engine/map", "engine/fit", "engine/sensor", "engine/mesh"),
    ("engine/region", "engine/io"),
    ("engine/export", "engine/project"),
    ("engine/cli", "viewer"),
)
# Within the viewer, lowest first; each may include those before it, and a header that lies beside them.
VIEWER_ROOMS = ("camera", "platform", "render", "tool", "worker", "panel", "app")

Rule = collections.namedtuple("Rule", "where unless line why")
CODE = r"\.(cc|h)$"
RULES = (
    Rule(r"^(engine|viewer|tests)/.*" + CODE, r"^(engine/scan/\w+\.cc|engine/scan/pcl\.h|tests/.*)$",
         r"#include <pcl/", "PCL is seen in the .cc files of engine/scan and in engine/scan/pcl.h only"),
    Rule(r"^(engine|viewer|tests)/.*" + CODE, r"^(engine/mesh/\w+\.(cc|h)|engine/io/\w*mesh\w*\.cc|tests/.*)$",
         r"#include <OpenMesh/", "OpenMesh is seen in engine/mesh and in the mesh reader and writer of engine/io only"),
    Rule(r"^engine/.*\.h$", r"^engine/mesh/\w+\.h$",
         r"#include <OpenMesh/", "no public header includes OpenMesh"),
    Rule(r"^engine/.*" + CODE, r"^$",
         r"#include <(GL|GLES\d?|EGL|GLFW|epoxy)/|#include <imgui", "the engine knows no GL, GLFW or ImGui"),
    Rule(r"^viewer/(render|camera|worker)/.*" + CODE, r"^$",
         r"#include <imgui|#include <GLFW/", "viewer/render, camera and worker know no ImGui and no window"),
    Rule(r"^viewer/panel/.*" + CODE, r"^$",
         r"#include <(GL|EGL|GLFW|epoxy)/|\bgl[A-Z]\w+\(", "viewer/panel knows no GL"),
    Rule(r"^engine/.*" + CODE, r"^engine/(cli/.*|base/file\.cc)$",
         r"#include <(iostream|print)>|\bstd::c(out|err|log)\b|(?<![\w])(std::)?(printf|puts|putchar|perror)\(|\b(stdout|stderr)\b",
         "the engine never prints"),
    Rule(r"^engine/.*" + CODE, r"^engine/cli/.*$",
         r"\bstd::(thread|jthread|async)\b", "the engine starts no thread of its own"),
    Rule(r"^(engine|viewer|tests)/.*\.h$", r"^$",
         r"^\s*using namespace ", "a header opens no namespace for its readers"),
)


def code_lines(text):
    """The lines with comments and string literals blanked, include paths kept."""
    text = re.sub(r"/\*.*?\*/", lambda match: "\n" * match.group().count("\n"), text, flags=re.S)
    for line in text.split("\n"):
        if not line.startswith("#include"):
            line = re.sub(r'"(\\.|[^"\\])*"', '""', line)
        yield re.sub(r"//.*", "", line)


def floor_of(path):
    return next((number for number, rooms in enumerate(FLOORS) for room in rooms if path.startswith(room + "/")), None)


def room_of(path):
    return path.split("/")[0] if path.startswith("viewer/") else "/".join(path.split("/")[:2])


def storey(path):
    """Where a file stands within the viewer; below every room where it lies beside them; None: in no known room."""
    folders = path.split("/")[1:-1]
    if not folders:
        return -1
    return VIEWER_ROOMS.index(folders[0]) if folders[0] in VIEWER_ROOMS else None


def climbs(path, included):
    """True where `path` includes a room that is not below it."""
    if not path.startswith(("engine/", "viewer/")):
        return False
    if path.startswith("viewer/") and included.startswith("viewer/"):
        return storey(included) > storey(path)
    return room_of(path) != room_of(included) and floor_of(included) >= floor_of(path)


def include_faults(tree, path, number, line):
    match = re.match(r'#include "([^"]+)"', line)
    if not match:
        return
    included = match.group(1)
    if included not in tree and not included.startswith("build/"):
        yield f'{path}:{number}: "{included}" is no file of the tree; the include path is the repository path'
    elif climbs(path, included):
        yield f'{path}:{number}: "{included}" is not on a lower floor'


def unknown_rooms(tree):
    for path in sorted(tree):
        if not re.search(CODE, path) or not path.startswith(("engine/", "viewer/")):
            continue
        if floor_of(path) is None or (path.startswith("viewer/") and storey(path) is None):
            yield f"{path}: its room has no floor in tests/house/include_check.py"


def faults(tree):
    found = list(unknown_rooms(tree))
    if found:
        return found
    for path, text in tree.items():
        if not re.search(CODE, path):
            continue
        if path.endswith(".h") and "#pragma once" not in text:
            found.append(f"{path}: a header starts with #pragma once")
        rules = [rule for rule in RULES if re.search(rule.where, path) and not re.search(rule.unless, path)]
        for number, line in enumerate(code_lines(text), 1):
            found += include_faults(tree, path, number, line)
            found += [f"{path}:{number}: {rule.why}" for rule in rules if re.search(rule.line, line)]
    return found


# (file, its text, whether it is a fault): one plant for each rule, and look-alikes that are none.
PLANTS = (
    ("engine/pose/up.cc", '#include "engine/patch/patch.h"', True),
    ("engine/pose/beside.cc", '#include "engine/scan/scan.h"', True),
    ("engine/region/down.cc", '#include "engine/fit/fit_patch.h"', False),
    ("engine/cli/beside.cc", '#include "viewer/app/app.h"', True),
    ("viewer/render/up.cc", '#include "viewer/app/app.h"', True),
    ("viewer/beside.h", "#pragma once", False),
    ("viewer/beside.h", '#pragma once\n#include "viewer/app/app.h"', True),
    ("engine/fit/lost.cc", '#include "fit_patch.h"', True),
    ("engine/attic/a.cc", "", True),
    ("viewer/attic/a.cc", "", True),
    ("engine/io/read.cc", "#include <pcl/io/pcd_io.h>", True),
    ("engine/scan/scan.h", "#pragma once\n#include <pcl/point_types.h>", True),
    ("engine/scan/knn.cc", "#include <pcl/point_types.h>", False),
    ("engine/io/export.cc", "#include <OpenMesh/Core/IO/MeshIO.hh>", True),
    ("engine/io/read_mesh.cc", "#include <OpenMesh/Core/IO/MeshIO.hh>", False),
    ("engine/io/read_mesh.h", "#pragma once\n#include <OpenMesh/Core/IO/MeshIO.hh>", True),
    ("engine/fit/draw.cc", "#include <epoxy/gl.h>", True),
    ("viewer/render/text.cc", "#include <imgui.h>", True),
    ("viewer/panel/tree.cc", "void f() { glDrawArrays(0, 0, 3); }", True),
    ("engine/fit/loud.cc", 'void f() { std::printf("x"); }', True),
    ("engine/fit/louder.cc", 'void f() { std::fprintf(stderr, "x"); }', True),
    ("engine/fit/quiet.cc", 'int f(char* b) { return std::snprintf(b, 2, "x"); }  // no printf() here', False),
    ("engine/fit/many.cc", "void f() { std::thread t; }", True),
    ("engine/fit/open.h", "#pragma once\nusing namespace std;", True),
    ("engine/fit/twice.h", "", True),
)
STANDING = {"engine/patch/patch.h": "#pragma once", "engine/scan/scan.h": "#pragma once",
            "engine/fit/fit_patch.h": "#pragma once", "viewer/app/app.h": "#pragma once"}


def self_test():
    assert not faults(STANDING)
    wrong = [path for path, text, is_fault in PLANTS if bool(faults({**STANDING, path: text})) != is_fault]
    return report([f"the plant {path} is judged wrongly" for path in wrong])


if __name__ == "__main__":
    sys.exit(self_test() if sys.argv[1:] == ["--self-test"] else report(faults(read_tree())))
