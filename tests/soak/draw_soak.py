#!/usr/bin/python3
"""Draws a soak over time: memory of exhibit, watchdog and system, and the times when the screen was dark.

    draw_soak.py MEASURED.json OUT.svg
"""

import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "app/bench/plots"))
from panels import Panel, Series, save_column  # noqa: E402


def main():
    measured, out = (pathlib.Path(word) for word in sys.argv[1:])
    found = json.loads(measured.read_text(encoding="utf-8"))
    names = {"system_mib": "whole system", "exhibit_mib": "exhibit", "tmpfs_mib": "files in memory", "watchdog_mib": "watchdog"}
    memory = Panel("Memory", "minutes", "MiB", log=False)
    for colour, (key, name) in enumerate(names.items()):
        memory.series.append(Series(name, [(sample["at_s"] / 60, sample[key]) for sample in found["samples"] if sample[key] is not None],
                                    colour, "."))
    memory.series.append(Series("a fault begins", [(fault["begin_s"] / 60, 0.0) for fault in found["faults"]], 4, "^", joined=False))
    light = Panel("Lit", "minutes", "1: lit, 0: dark", log=False)
    light.series.append(Series("the screen", [(at / 60, float(lit)) for at, lit in found["looks"]], 0, ",", stepped=True))
    light.series.append(Series("a fault begins", [(fault["begin_s"] / 60, 0.0) for fault in found["faults"]], 4, "^", joined=False))
    disk = Panel("Written to the data partition", "minutes", "MB", log=False)
    first = found["samples"][0]["written_bytes"]
    disk.series.append(Series("written", [(sample["at_s"] / 60, (sample["written_bytes"] - first) / 1e6) for sample in found["samples"]], 1, "."))
    save_column(out, [memory, light, disk])


if __name__ == "__main__":
    main()
