#!/usr/bin/python3
"""Prints docs/rooms.md: each room with its folder, its purpose, its first header and the rooms that it may include, as the CMakeLists.txt files
have them; then the example of each room that has one.

The comment above `frustumscreen_room` is a room's purpose; its last line is `# Begin with HEADER.`. The example of a room is the part of
tests/examples/ROOM_example.cpp between `// example` and `// end`; the comment at the beginning of that file says what it shows.
Exit status 1: a room lacks one of these, or an example belongs to no room.
"""

import pathlib
import re
import sys
import textwrap

ROOT = pathlib.Path(__file__).resolve().parents[1]
TOP = ("firmware_host", "app", "assets_baked", "tests/simulators")
EXAMPLES = ROOT / "tests" / "examples"
KEYWORDS = {"LIBRARIES", "PRIVATE", "SOURCES", "APART", "USES"}
HEAD = """# Rooms

A room is a folder that is one static library. This page is generated from the `CMakeLists.txt` files and from `tests/examples`: `cmake/rooms_page.py > docs/rooms.md`.
A newcomer to a room opens the header of the fourth column first. A room may include the rooms of the last column, what those may include, and nothing else;
`tests/layers` checks every `#include` against this list. Rooms whose name is a link have an example below.

| folder | room | purpose | begin with | may include |
|---|---|---|---|---|"""
EXAMPLES_HEAD = """
## Examples

How each room is used, in about ten lines. The test `examples_test` runs all examples. They are in a namespace of their own, so that each name is
written with its room. A function that no header declares is defined in the whole file."""


class Lack(Exception):
    """A sentence for the author of the CMakeLists.txt or the example."""


def rooms(file):
    """The rooms that a CMakeLists.txt declares: name, purpose, first header, used rooms."""
    folder = file.parent.relative_to(ROOT)
    text = file.read_text(encoding="utf-8")
    for match in re.finditer(r"((?:^#.*\n)*)^frustumscreen_room\(\s*(\S+)([^)]*)\)", text, re.MULTILINE):
        name, comment = match[2], [line.lstrip("# ") for line in match[1].splitlines()]
        begin = re.fullmatch(r"Begin with (\S+)\.", comment.pop()) if len(comment) > 1 else None
        if not begin:
            raise Lack(f"{folder}: write the purpose of {name} directly above frustumscreen_room, and below it '# Begin with HEADER.'")
        if not (file.parent / begin[1]).is_file():
            raise Lack(f"{folder}: {name} begins with {begin[1]}, which is not there")
        uses, wanted = [], False
        for word in match[3].split():
            if word in KEYWORDS:
                wanted = word == "USES"
            elif wanted:
                uses.append(word)
        yield name, " ".join(comment), begin[1], uses


def example(name):
    """The section of a room: what its example shows, the headers of the house that it includes, and its lines."""
    file = EXAMPLES / f"{name}_example.cpp"
    text = file.read_text(encoding="utf-8")
    sentence = " ".join(line[3:] for line in re.match(r"(?:// .*\n)*", text)[0].splitlines())
    shown = re.search(r"^ *// example\n(.*?)^ *// end\n", text, re.MULTILINE | re.DOTALL)
    if not sentence or not shown:
        raise Lack(f"{file.relative_to(ROOT)}: begin with a comment that says what it shows, and put '// example' and '// end' around the example")
    includes = re.findall(r'^#include "(?!tests/).*"$', text, re.MULTILINE)
    place = file.relative_to(ROOT).as_posix()
    return "\n".join([f"\n### {name}\n", f"{sentence} [The whole file](../{place})", "\n```cpp", *includes, "", textwrap.dedent(shown[1]) + "```"])


def page():
    """The whole page, without its last line break."""
    with_example = {file.name.removesuffix("_example.cpp") for file in EXAMPLES.glob("*_example.cpp")}
    lines, examples = [HEAD], [EXAMPLES_HEAD]
    for top in TOP:
        for file in sorted((ROOT / top).rglob("CMakeLists.txt")):
            folder = file.parent.relative_to(ROOT).as_posix()
            for name, purpose, begin, uses in rooms(file):
                used = " ".join(sorted(set(uses) - {"base"})) or ("base" if uses else "nothing")
                shown = f"[{name}](#{name})" if name in with_example else name
                lines.append(f"| `{folder}` | {shown} | {purpose} | [{begin}](../{folder}/{begin}) | {used} |")
                if name in with_example:
                    with_example.remove(name)
                    examples.append(example(name))
    if with_example:
        raise Lack(f"tests/examples: there is no room {', '.join(sorted(with_example))}")
    return "\n".join(lines + examples)


def main():
    try:
        print(page())
    except Lack as lack:
        print(f"rooms_page.py: {lack}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
