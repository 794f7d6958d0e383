#!/usr/bin/python3
"""Prints docs/rooms.md: each room with its folder, its purpose and the rooms that it may include, as the CMakeLists.txt files have them.

A room's purpose is the comment above its `frustumscreen_room`. Exit status 1: a room has no purpose.
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
TOP = ("firmware_host", "app", "assets_baked", "tests/simulators")
KEYWORDS = {"LIBRARIES", "PRIVATE", "SOURCES", "USES", "UNITY"}
HEAD = """# Rooms

A room is a folder that is one static library. This page is generated from the `CMakeLists.txt` files: `cmake/rooms_page.py > docs/rooms.md`.
A room may include the rooms of the last column, what those may include, and nothing else; `tests/layers` holds every `#include` against it.

| folder | room | purpose | may include |
|---|---|---|---|"""


def rooms(file):
    """The rooms that a CMakeLists.txt declares: name, purpose, used rooms."""
    text = file.read_text(encoding="utf-8")
    for match in re.finditer(r"((?:^#.*\n)*)^frustumscreen_room\(\s*(\S+)([^)]*)\)", text, re.MULTILINE):
        purpose = " ".join(line.lstrip("# ") for line in match[1].splitlines())
        uses, wanted = [], False
        for word in match[3].split():
            if word in KEYWORDS:
                wanted = word == "USES"
            elif wanted:
                uses.append(word)
        yield match[2], purpose, uses


def main():
    lines, without = [], []
    for top in TOP:
        for file in sorted((ROOT / top).rglob("CMakeLists.txt")):
            folder = file.parent.relative_to(ROOT)
            for name, purpose, uses in rooms(file):
                if not purpose:
                    without.append(f"{folder}: {name}")
                used = " ".join(sorted(set(uses) - {"base"})) or ("base" if uses else "nothing")
                lines.append(f"| `{folder}` | {name} | {purpose} | {used} |")
    if without:
        print(f"rooms_page.py: write a comment above frustumscreen_room in {', '.join(without)}", file=sys.stderr)
        return 1
    print("\n".join([HEAD, *lines]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
