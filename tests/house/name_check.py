#!/usr/bin/python3
"""File-local names of one program or library stay apart, so that its sources can be compiled several at a time.

name_check.py              checks the tree, prints one line for each fault
name_check.py --self-test  plants one fault of each kind and checks that it is found
"""
import collections
import posixpath
import re
import sys

from tree import read_tree, report

TARGET = re.compile(r"^(?:patchlab_room|patchlab_test|add_library|add_executable)\((.*?)\)", re.S | re.M)
APART = re.compile(r"set_source_files_properties\(([^)]*)SKIP_UNITY_BUILD_INCLUSION ON\)")
TYPE = re.compile(r"(?:template <.*> *)?(?:struct|class|enum class|enum) (\w+)(?!.*;$)|using (\w+) =")
VALUE = re.compile(r"(?:inline |static |constexpr |const )+[\w:<>, *&]*?[ *&>](\w+)(?:\[\w*\])*(?: = | =$|\{|;)")
FUNCTION = re.compile(r"(?!TEST|INSTANTIATE|return)(?:\[\[.*?\]\] )?(?:inline |static |constexpr )*[\w:<>,*& ]+[ *&](\w+)\((.*?)\)(?: const)? \{")


def target_sources(tree):
    """The sources that CMake compiles together, a list for each target."""
    for path, text in tree.items():
        if posixpath.basename(path) != "CMakeLists.txt":
            continue
        apart = set(" ".join(APART.findall(text)).split())
        for target in TARGET.findall(text):
            names = [word for word in target.split() if word.endswith(".cc") and word not in apart]
            yield [source for name in names if (source := posixpath.join(posixpath.dirname(path), name)) in tree]


def local_names(text):
    """Names that an unnamed namespace holds at its top level; a function counts with the types of its parameters."""
    within = False
    for line in text.split("\n"):
        if line == "namespace {" or line == "}  // namespace":
            within = line == "namespace {"
        elif within:
            if match := TYPE.match(line):
                yield match[1] or match[2]
            elif match := FUNCTION.match(line):
                types = re.sub(r"\s*=[^,]*|\b\w+(?=\s*(?:,|=|$))", "", match[2])
                yield f"{match[1]}({types})"
            elif match := VALUE.match(line):
                yield match[1]


def faults(tree):
    found = []
    for sources in target_sources(tree):
        holders = collections.defaultdict(list)
        for source in sources:
            for name in dict.fromkeys(local_names(tree[source])):
                holders[name].append(source)
        found += [f"{files[1]}: {name} is a name in {files[0]} too; give one a name that says more"
                  for name, files in sorted(holders.items()) if len(files) > 1]
    return found


SOURCE = "namespace patchlab {{\nnamespace {{\n\n{}\n\n}}  // namespace\n}}  // namespace patchlab\n"
PLANTS = (
    ("struct Row {", True),
    ("constexpr double limit = 2.0;", True),
    ("constexpr Row rows[] = {", True),
    ("double area(const Patch& p) {", True),
    ("double area(const Boundary& p) {", False),
    ("constexpr double other = 2.0;", False),
    ("  constexpr double limit = 2.0;", False),
    ("using std::numbers::pi;", False),
)
STANDING = {
    "engine/fit/CMakeLists.txt": "patchlab_room(fit SOURCES a.cc b.cc c.cc)\n"
                                 "set_source_files_properties(c.cc PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)\n",
    "engine/fit/a.cc": SOURCE.format("struct Row {\nconstexpr double limit = 1.0;\nconstexpr Row rows[] = {\n"
                                     "using std::numbers::pi;\ndouble area(const Patch& patch) {"),
    "engine/fit/c.cc": SOURCE.format("struct Row {"),
}


def self_test():
    assert not faults(STANDING), faults(STANDING)
    wrong = [line for line, is_fault in PLANTS
             if bool(faults({**STANDING, "engine/fit/b.cc": SOURCE.format(line)})) != is_fault]
    return report([f"the plant '{line}' is judged wrongly" for line in wrong])


if __name__ == "__main__":
    sys.exit(self_test() if sys.argv[1:] == ["--self-test"] else report(faults(read_tree())))
