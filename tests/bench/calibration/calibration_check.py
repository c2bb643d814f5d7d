#!/usr/bin/python3
"""The calibration program on a small battery: calibration_check.py PROGRAM.

The same bytes with any number of threads, other numbers with another seed; every plot is XML, stands in the report,
and keeps its marks and words on its sheet; wrong usage exits 2, a folder that cannot be written 4.
"""
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

SVG = "{http://www.w3.org/2000/svg}"
PLACES = {"x": 0, "x1": 0, "x2": 0, "cx": 0, "y": 1, "y1": 1, "y2": 1, "cy": 1}


def run(program, *options):
    return subprocess.run([program, "--trials", "3", "--points", "60", *options], capture_output=True, text=True).returncode


def files_of(program, folder, *options):
    status = run(program, *options, "-o", str(folder))
    assert status == 0, f"exit status {status}"
    return {file.name: file.read_bytes() for file in folder.iterdir()}


def faults_of_plot(name, text):
    sheet = xml.fromstring(text)
    size = [float(word) for word in sheet.get("viewBox").split()[2:]]
    for element in sheet.iter():
        places = [(float(element.get(key)), axis) for key, axis in PLACES.items() if element.get(key)]
        places += [(float(word), i % 2) for i, word in enumerate(re.split("[ ,]", element.get("points") or "")) if word]
        if not all(0.0 <= value <= size[axis] for value, axis in places):
            yield f"{name}: a {element.tag.removeprefix(SVG)} lies off the sheet"
    if b"nan" in text or b"inf" in text:
        yield f"{name}: a place that is no number"


def faults(program):
    with tempfile.TemporaryDirectory() as place:
        top = pathlib.Path(place)
        once = files_of(program, top / "one", "--threads", "1")
        if once != files_of(program, top / "three", "--threads", "3"):
            yield "the number of threads changes the report"
        if once == files_of(program, top / "seed", "--seed", "2"):
            yield "the seed changes nothing"
        plots = {name: text for name, text in once.items() if name.endswith(".svg")}
        shown = set(re.findall(r"\]\((.*?)\)", once["calibration.md"].decode()))
        if shown != set(plots):
            yield f"the report shows {sorted(shown)}, the plots are {sorted(plots)}"
        for name, text in plots.items():
            yield from faults_of_plot(name, text)
        if run(program) != 2 or run(program, "--noise", "loud", "-o", place) != 2:
            yield "wrong usage does not exit 2"
        (top / "file").write_text("")
        if run(program, "-o", str(top / "file")) != 4:
            yield "a folder that cannot be written does not exit 4"


if __name__ == "__main__":
    if not pathlib.Path(sys.argv[1]).exists():
        print(f"{sys.argv[1]} is not built")
        sys.exit(77)
    found = list(faults(sys.argv[1]))
    print(*found, sep="\n")
    sys.exit(1 if found else 0)
