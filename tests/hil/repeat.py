"""Helps to run the same tests repeatedly on a busy machine; every run must be clean."""

import subprocess
import sys
from dataclasses import dataclass, field


class Load:
    """`with Load(loops)`: runs so many busy loops in the background."""

    def __init__(self, loops):
        self._loops = loops
        self._processes = []

    def __enter__(self):
        self._processes = [subprocess.Popen([sys.executable, "-c", "while True: pass"], start_new_session=True)
                           for _ in range(self._loops)]

    def __exit__(self, *_):
        for process in self._processes:
            process.kill()
            process.wait()


@dataclass
class Run:
    """One run of the tests."""

    load_average: float  # the average of the last five minutes, at the end
    took_s: float
    stood_s: float  # the longest time for which a picture stood while it should move
    wrong: list = field(default_factory=list)  # names of the tests that failed


def as_text(table):
    """`table`: rows of (busy loops, number, Run)."""
    lines = ["busy loops  run  load average  seconds  longest picture  failed"]
    for loops, number, run in table:
        lines.append(f"{loops:10}  {number:3}  {run.load_average:12.1f}  {run.took_s:7.0f}  {1e3 * run.stood_s:12.0f} ms  "
                     f"{' '.join(run.wrong) or '-'}")
    for loops in sorted({loops for loops, _, _ in table}):
        runs = [run for each, _, run in table if each == loops]
        lines.append(f"beside {loops} busy loops: {sum(not run.wrong for run in runs)} of {len(runs)} clean")
    return "\n".join(lines) + "\n"
