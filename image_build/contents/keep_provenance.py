#!/usr/bin/python3
"""Keeps, beside the image, dpkg's data base and the licence texts of the packages that the image was made from.

    keep_provenance.py OUT --tree NAME=FOLDER... --compiled-in LIST

OUT/NAME/var/lib/dpkg            status and info/*.list of each tree
OUT/NAME/usr/share/doc, .../common-licenses    the packages' copyright files and the licences that they refer to
OUT/compiled_in                  the same of the packages in LIST, as installed on this machine, which builds our programs
Errors   one sentence: a package of LIST is not installed here.
"""

import argparse
import pathlib
import shutil
import subprocess
import sys

from word_lists import Wrong, lines_of


def copy_inside(root, path, target):
    """Copies the file that a path leads to, also through links, if it lies in the tree."""
    root, real = root.resolve(), path.resolve()
    if path.exists() and real.is_file() and real.is_relative_to(root):
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(real, target)


def keep_tree(tree, out):
    place = pathlib.Path("var/lib/dpkg")
    if (tree / place / "status").exists():
        (out / place / "info").mkdir(parents=True)
        shutil.copyfile(tree / place / "status", out / place / "status")
        for path in sorted((tree / place / "info").glob("*.list")):
            shutil.copyfile(path, out / place / "info" / path.name)
    doc = pathlib.Path("usr/share/doc")
    for path in sorted((tree / doc).glob("*/copyright")):
        copy_inside(tree, path, out / path.relative_to(tree))
    for path in sorted((tree / "usr/share/common-licenses").glob("*")):
        copy_inside(tree, path, out / path.relative_to(tree))


def keep_compiled_in(names, out):
    (out / "var/lib/dpkg").mkdir(parents=True)
    with open(out / "var/lib/dpkg/status", "w", encoding="utf-8") as status:
        for name in sorted(names):
            found = subprocess.run(["dpkg-query", "--status", name], capture_output=True, text=True)
            if found.returncode or "\nStatus: install ok installed\n" not in found.stdout:
                raise Wrong(f"{name}, parts of which are compiled into our programs, is not installed: ./setup.sh kiosk")
            status.write(f"{found.stdout.strip()}\n\n")
            copyright_file = pathlib.Path("usr/share/doc") / name / "copyright"
            copy_inside(pathlib.Path("/"), "/" / copyright_file, out / copyright_file)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--tree", action="append", default=[])
    parser.add_argument("--compiled-in", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    shutil.rmtree(arguments.out, ignore_errors=True)
    for tree in arguments.tree:
        name, _, folder = tree.partition("=")
        keep_tree(pathlib.Path(folder), arguments.out / name)
    keep_compiled_in({package for package, _ in lines_of(arguments.compiled_in)}, arguments.out / "compiled_in")


if __name__ == "__main__":
    try:
        main()
    except Wrong as wrong:
        sys.exit(f"build: {wrong}")
