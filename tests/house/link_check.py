#!/usr/bin/python3
"""What a program links, read with ldd: link_check.py PROGRAM NAME..., where no library may match a NAME.

link_check.py --self-test checks that a library that is there is found.
"""
import re
import subprocess
import sys

from tree import report


def libraries(program):
    listing = subprocess.run(["ldd", program], capture_output=True, text=True, check=True).stdout
    return [line.split()[0] for line in listing.splitlines()]


def faults(program, names):
    return [f"{program} links {library}" for library in libraries(program)
            if any(re.match(name, library) for name in names)]


def self_test():
    return 0 if faults(sys.executable, ["libc\\.so"]) and not faults(sys.executable, ["libQt"]) else 1


if __name__ == "__main__":
    sys.exit(self_test() if sys.argv[1:] == ["--self-test"] else report(faults(sys.argv[1], sys.argv[2:])))
