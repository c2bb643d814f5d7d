#!/usr/bin/python3
"""format_check.py CLANG_FORMAT: every source of the tree is as .clang-format would lay it out."""
import subprocess
import sys

from tree import TOP, read_tree

sources = [path for path in read_tree() if path.endswith((".cc", ".h"))]
sys.exit(subprocess.run([sys.argv[1], "--dry-run", "--Werror", *sources], cwd=TOP, check=False).returncode)
