#!/usr/bin/python3
"""Makes the image's root from Debian's packages and ours. It takes only the files that files.list and modules.list name, each with a
reason, and what these need: linked libraries, the modules that a module needs, the targets of symbolic links.

    lean.py ROOT KEPT --from TREE [--from TREE]... --files LIST... [--kernel TREE --modules LIST...]

--from    a tree to take files from; the first tree that has a file wins. --kernel: the tree of the unpacked kernel package
ROOT      a folder that is made; all files have the modes of their packages
KEPT      a table of bytes, reason and path, for image_build/why
Errors    one sentence. A line of a list that matches no file is an error, so that the lists stay true.
"""

import argparse
import fnmatch
import os
import pathlib
import re
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "contents"))
from word_lists import Wrong, lines_of  # noqa: E402

LIBRARIES = ("usr/lib/x86_64-linux-gnu", "usr/lib", "usr/lib/systemd", "usr/lib/x86_64-linux-gnu/systemd", "usr/lib64")
MERGED = ("bin", "sbin", "lib", "lib64")  # links into usr


class Trees:
    """The files of several trees as one tree; paths are relative, without the links of the merged /usr."""

    def __init__(self, roots):
        self.files = {}
        for root in reversed(roots):
            for folder, folders, names in os.walk(root):
                inside = os.path.relpath(folder, root)
                for name in names + [name for name in folders if os.path.islink(os.path.join(folder, name))]:
                    path = os.path.normpath(os.path.join(inside, name))
                    first, _, rest = path.partition("/")
                    if first in MERGED and rest:
                        path = f"usr/{path}"
                    if path not in MERGED:
                        self.files[path] = os.path.join(folder, name)
        self.names = sorted(self.files)

    def like(self, pattern):
        """All paths that match a pattern: * stays within a folder, ** does not."""
        if not any(letter in pattern for letter in "*?["):
            return [pattern] if pattern in self.files else []
        regex = re.escape(pattern).replace(r"\*\*", ".*").replace(r"\*", "[^/]*").replace(r"\?", "[^/]")
        if "[" in pattern:
            return fnmatch.filter(self.names, pattern)
        return [name for name in self.names if re.fullmatch(regex, name)]

    def target(self, path):
        """The target of a symbolic link; None if it is not in the trees, such as a path in /run or /dev."""
        to = os.readlink(self.files[path])
        whole = os.path.normpath(to.lstrip("/") if to.startswith("/") else os.path.join(os.path.dirname(path), to))
        first, _, rest = whole.partition("/")
        whole = f"usr/{whole}" if first in MERGED and rest else whole
        return whole if whole in self.files else None


def linked(trees, paths):
    """path -> names of the libraries that it links, for each path that is an ELF file."""
    real = {trees.files[path]: path for path in paths if not os.path.islink(trees.files[path])}
    elves = [file for file in real if open(file, "rb").read(4) == b"\x7fELF"]
    found = {}
    for begin in range(0, len(elves), 500):
        some = elves[begin : begin + 500]
        out = subprocess.run(["readelf", "--dynamic", "--program-headers", "--wide", *some], check=True, capture_output=True,
                             text=True, env={**os.environ, "LC_ALL": "C"}).stdout
        at = some[0]
        for line in out.splitlines():
            if line.startswith("File: "):
                at = line[6:]
            match = re.search(r"\(NEEDED\).*\[(.*)\]", line) or re.search(r"program interpreter: .*/(.*)\]", line)
            if match:
                found.setdefault(real[at], set()).add(match.group(1))
    return found


def keep_files(trees, lists):
    """path -> reason."""
    kept = {}
    for path in lists:
        for pattern, reason in lines_of(path):
            found = trees.like(pattern)
            if not found:
                raise Wrong(f"{path}: no file is named by '{pattern}'; take the line out, or mend it")
            kept.update({name: reason for name in found if name not in kept})
    new = set(kept)
    while new:
        more = {}
        for path in sorted(new):
            if os.path.islink(trees.files[path]):
                target = trees.target(path)
                if target and not os.path.isdir(trees.files[target]):
                    more.setdefault(target, kept[path])
        for path, names in sorted(linked(trees, sorted(new)).items()):
            for name in sorted(names):
                places = [place for place in (f"{folder}/{name}" for folder in LIBRARIES) if place in trees.files]
                if not places:
                    raise Wrong(f"{path} needs the library {name}, which no package brings: add its package to packages.conf")
                more.setdefault(places[0], kept[path])
        new = set(more) - set(kept)
        kept.update({path: more[path] for path in new})
    return kept


def keep_modules(folder, lists):
    """(path below the modules' folder -> reason, the same of the initrd's alone)."""
    needs, by_name = {}, {}
    for line in (folder / "modules.dep").read_text(encoding="utf-8").splitlines():
        path, _, others = line.partition(":")
        needs[path] = others.split()
        by_name[os.path.basename(path).removesuffix(".ko").replace("-", "_")] = path
    built_in = {os.path.basename(line).removesuffix(".ko").replace("-", "_")
                for line in (folder / "modules.builtin").read_text(encoding="utf-8").split()}
    kept, early = {}, {}
    for path in lists:
        for words, reason in lines_of(path):
            where, name = words.split()
            if name in built_in:
                continue
            if name not in by_name:
                raise Wrong(f"{path}: this kernel has no module {name}")
            for module in (by_name[name], *needs[by_name[name]]):
                kept.setdefault(module, reason)
                if where == "initrd":
                    early.setdefault(module, reason)
    return kept, early


def lay(source, target):
    target.parent.mkdir(parents=True, exist_ok=True)
    if os.path.islink(source):
        os.symlink(os.readlink(source), target)
    else:
        os.link(source, target)  # hard links of a package stay hard links


def lay_modules(kernel, lists, root):
    """Puts the modules that the lists name into the root; returns path -> reason."""
    versions = os.listdir(kernel / "lib/modules")
    if len(versions) != 1:
        raise Wrong(f"{kernel} has not one kernel but {len(versions)}")
    modules = kernel / "lib/modules" / versions[0]
    subprocess.run(["depmod", "--basedir", kernel, versions[0]], check=True)
    loaded, early = keep_modules(modules, lists)
    place = pathlib.Path("usr/lib/modules") / versions[0]
    for path in [*loaded, "modules.order", "modules.builtin", "modules.builtin.modinfo"]:
        lay(modules / path, root / place / path)
    (root / place / "initrd").write_text("".join(f"{path}\n" for path in early), encoding="ascii")
    subprocess.run(["depmod", "--basedir", root / "usr", versions[0]], check=True)

    return {str(place / path): reason for path, reason in loaded.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--from", dest="trees", action="append", required=True, type=pathlib.Path)
    parser.add_argument("--kernel", type=pathlib.Path)
    parser.add_argument("--files", nargs="+", required=True, type=pathlib.Path)
    parser.add_argument("--modules", nargs="+", type=pathlib.Path)
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("kept", type=pathlib.Path)
    arguments = parser.parse_args()

    trees = Trees(arguments.trees)
    kept = keep_files(trees, arguments.files)
    for path in sorted(kept):
        lay(trees.files[path], arguments.root / path)
    for name in MERGED:
        os.symlink(f"usr/{name}", arguments.root / name)

    if arguments.kernel:
        kept.update(lay_modules(arguments.kernel, arguments.modules, arguments.root))
    with open(arguments.kept, "w", encoding="utf-8") as table:
        seen = set()
        for path, reason in sorted(kept.items()):
            state = os.lstat(arguments.root / path)
            table.write(f"{0 if state.st_ino in seen else state.st_size}\t{reason}\t{path}\n")
            seen.add(state.st_ino)


if __name__ == "__main__":
    try:
        main()
    except Wrong as wrong:
        sys.exit(f"build: {wrong}")
