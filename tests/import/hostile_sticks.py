#!/usr/bin/python3
"""Gives hostile sticks to frustumscreen-import, as folders. It must refuse each in lines that a person can read, with little memory and
time; the installed set must stay, and the next good stick must be taken.

    hostile_sticks.py BIN [--table FILE]    BIN: the folder of the programs; FILE: for the results, as a table

Exit status 77: a program that this needs is not on this machine.
"""

import argparse
import json
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time
import zlib

import plain_pack
from hostile_cases import CASES, WHOLE

MAX_MIB = 64.0
MAX_WORK_S = 2.0  # on a machine where the fixed work of slowness() takes YARDSTICK_S, as on the machine of docs/sticks.md
YARDSTICK_S = 0.25


class Wrong(Exception):
    pass


def slowness():
    """The time that a fixed piece of work takes now, divided by YARDSTICK_S, at least 1: a busy machine slows all programs."""
    noise = random.Random(1).randbytes(12 << 20)
    begun = time.process_time()
    zlib.compress(noise, 9)
    return max(1.0, (time.process_time() - begun) / YARDSTICK_S)


def measure():
    """Runs the commands on standard input, a JSON list on each line, and prints status, messages, memory and time of each. It is a small
    process of its own, because the measured memory of a program is at least that of the process that starts it."""
    for line in sys.stdin:
        with subprocess.Popen(json.loads(line), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as process:
            said = process.stderr.read()
            _, status, used = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
        print(json.dumps([process.returncode, said.decode(errors="replace"), used.ru_maxrss / 1024, used.ru_utime + used.ru_stime]),
              flush=True)


class Kiosk:
    def __init__(self, program, folder, keys):
        self.program, self.into, self.keys = program, folder / "library", keys
        self._measure = subprocess.Popen([sys.executable, __file__, "--measure", "."], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                         text=True)

    def stop(self):
        self._measure.stdin.close()
        self._measure.wait()
        self._measure.stdout.close()

    def list(self):
        return json.loads(subprocess.run([self.program, "--list", "--into", self.into, "--json"], check=True,
                                         capture_output=True).stdout)["packs"]

    def files(self):
        return sorted(file.name for file in (self.into / "packs").iterdir())

    def take(self, stick):
        """Status, lines, report, MiB, seconds of the processor, seconds by the clock."""
        report = self.into.parent / "report.json"
        report.unlink(missing_ok=True)
        command = [self.program, "--from", stick, "--into", self.into, "--keys", self.keys, "--report", report]
        begun = time.monotonic()
        print(json.dumps([str(word) for word in command]), file=self._measure.stdin, flush=True)
        status, said, mib, work_s = json.loads(self._measure.stdout.readline())
        return status, said, json.loads(report.read_text(encoding="utf-8")), mib, work_s, time.monotonic() - begun


def check(kiosk, case, stick):
    """The row of the table; raises Wrong."""
    before, files = kiosk.list(), kiosk.files()
    status, said, report, mib, work_s, clock_s = kiosk.take(stick)
    row = (case.__name__, len(report["packs"]), mib, work_s, clock_s, said.split("\n")[0])
    if status not in (0, 1):
        raise Wrong(f"it ended with {status}: {said[-500:]}")
    too_much = work_s > MAX_WORK_S and case not in WHOLE and work_s > MAX_WORK_S * slowness()
    if mib > MAX_MIB or too_much:
        raise Wrong(f"it took {mib:.0f} MiB, {work_s:.1f} s of the processor")
    if any(letter < " " and letter != "\n" or letter == "\u202e" for letter in said):
        raise Wrong(f"what it says cannot be printed: {said}")
    if not report["stage"] in ("done", "failed"):
        raise Wrong(f"the report stays at {report['stage']}")
    if case in WHOLE:
        return row
    taken = [told for told in report["packs"] if told["outcome"] not in ("refused", "already_there")]
    if report["stage"] == "done" and taken:
        raise Wrong(f"it was not refused: {taken[:2]}")
    if kiosk.list() != before:
        raise Wrong("the set is another one")
    if kiosk.files() != files:
        raise Wrong(f"other files are there: {kiosk.files()}")
    return row


def check_good(kiosk, signer, folder, serial):
    """Imports a good stick into the same library. Its pack has its own id, so that hostile packs stay newer than the installed ones."""
    description = plain_pack.manifest()
    description["sections"]["identity"]["data"]["id"] = "good"
    (folder / "good.fspack").write_bytes(plain_pack.pack(signer, serial, description))
    status, said, *_ = kiosk.take(folder)
    if status != 0 or [told["serial"] for told in kiosk.list() if told["id"] == "good"] != [serial]:
        raise Wrong(f"a good stick is not taken any more: {said[-500:]}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("--table", type=pathlib.Path)
    parser.add_argument("--only", default="", help="run only cases whose name contains this")
    parser.add_argument("--measure", action="store_true", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.measure:
        measure()
        return 0
    program = arguments.bin / "frustumscreen-import"
    if not shutil.which("minisign"):
        print("left out: minisign is not installed")
        return 77
    wrong, rows = 0, []
    with tempfile.TemporaryDirectory() as place:
        place = pathlib.Path(place)
        (place / "keys").mkdir()
        signer = plain_pack.Signer(place / "keys")
        kiosk = Kiosk(program, place, place / "keys")
        good = place / "good"
        good.mkdir()
        (good / "vase.fspack").write_bytes(plain_pack.pack(signer, 10))
        try:
            check_good(kiosk, signer, good, 1)
        except Wrong as why:
            print(f"FAILED: {why}")
            kiosk.stop()
            return 1
        for serial, case in enumerate(CASES, 2):
            if arguments.only not in case.__name__:
                continue
            stick = place / "stick"
            stick.mkdir()
            try:
                case(stick, signer)
                rows.append(check(kiosk, case, stick))
                check_good(kiosk, signer, good, serial)
                name, packs, mib, work_s, clock_s, line = rows[-1]
                print(f"{name}: {packs} packs, {mib:.0f} MiB, {work_s:.2f} s of the processor, {clock_s:.1f} s; {line}", flush=True)
            except Wrong as why:
                wrong += 1
                print(f"FAILED {case.__name__}: {why}", flush=True)
            subprocess.run(["rm", "-rf", stick], check=True)  # deeper than Python goes
        kiosk.stop()
    if arguments.table:
        arguments.table.write_text("".join(f"| {' | '.join(str(cell) for cell in row)} |\n" for row in rows), encoding="utf-8")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
