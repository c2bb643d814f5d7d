"""The tree as the house checks see it: {path from the top: text}, the sources and what stands beside them."""
import pathlib

TOP = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("engine", "viewer", "shaders", "assets", "tests", ".ci")
TEXT = {".cc", ".h", ".py", ".txt", ".md", ".json", ".patchlab", ".vert", ".frag", ".geom", ".glsl", ".cmake", ".sh", ""}


def read_tree(top=TOP):
    files = [file for file in top.iterdir() if file.is_file() and file.name != ".git"]
    files += [file for folder in FOLDERS for file in (top / folder).rglob("*") if file.is_file()]
    return {str(file.relative_to(top)): file.read_text(encoding="utf-8")
            for file in sorted(files) if file.suffix in TEXT and "__pycache__" not in file.parts}


def report(faults):
    """Prints each fault on a line; the exit status for ctest."""
    for fault in faults:
        print(fault)
    return 1 if faults else 0
