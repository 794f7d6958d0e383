"""Reads the lists from which the image is made. A line: a pattern or a name, two or more spaces, a reason or a purpose.

Errors   Wrong, one sentence: a line without its second part.
"""

import functools
import re


class Wrong(Exception):
    """A mistake that a person can correct, in one sentence."""


def lines_of(path):
    """(the part before two or more spaces, the part after them) of each line."""
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.strip() and not line.startswith("#"):
            first, _, rest = re.sub(r"\s{2,}", "\t", line.strip()).partition("\t")
            if not rest:
                raise Wrong(f"{path}: '{line.strip()}' has nothing behind two spaces")
            yield first, rest.replace("\t", " ")


@functools.cache
def regex_of(pattern):
    """* stays within a folder, ** does not."""
    parts = [".*" if part == "**" else "[^/]*" if part == "*" else re.escape(part) for part in re.split(r"(\*\*|\*)", pattern)]
    return re.compile("".join(parts))


def first_match(lines, path, names=()):
    """The second part of the first line whose pattern matches the path or is one of the names; None without such a line."""
    for pattern, rest in lines:
        if pattern in names or ":" not in pattern and regex_of(pattern).fullmatch(path):
            return rest
    return None
