#!/usr/bin/python3
"""Prints the lines and branches that the tests reached in each room, and the files that no test reached; `./test coverage` calls this.

    rooms.py SUMMARY PLACES    SUMMARY: of gcovr --json-summary; PLACES: the build's tests/layers/layers.txt
"""

import json
import pathlib
import sys

WANTED = 85.0  # percent of a room's lines; docs/tested.md gives the reasons of rooms below it


def places(path):
    """Folder -> room."""
    lines = (line.split() for line in path.read_text(encoding="utf-8").splitlines())
    return {words[2]: words[1] for words in lines if words[:1] == ["place"]}


def room_of(file, rooms):
    """The room of the innermost folder that contains the file."""
    folder = max((folder for folder in rooms if file == folder or file.startswith(f"{folder}/")), key=len, default="")
    return folder and rooms[folder]


def percent(part, whole):
    return 100.0 * part / whole if whole else 100.0


def main(summary, layers):
    files = json.loads(pathlib.Path(summary).read_text(encoding="utf-8"))["files"]
    rooms = places(pathlib.Path(layers))
    sums, unreached = {}, []
    for file in files:
        counts = sums.setdefault(room_of(file["filename"], rooms) or "(none)", [0, 0, 0, 0])
        for k, key in enumerate(("line_covered", "line_total", "branch_covered", "branch_total")):
            counts[k] += file[key]
        if file["line_total"] and not file["line_covered"]:
            unreached.append(file["filename"])
    print("   lines  branches  room")
    for room, (lines, all_lines, branches, all_branches) in sorted(sums.items(), key=lambda item: percent(*item[1][:2])):
        mark = "" if percent(lines, all_lines) >= WANTED else f"   below {WANTED:.0f} %"
        print(f"   {percent(lines, all_lines):4.1f} %   {percent(branches, all_branches):4.1f} %  {room} ({all_lines} lines){mark}")
    print(f"== {len(unreached)} files that no test reaches" + "".join(f"\n   {name}" for name in sorted(unreached)))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
