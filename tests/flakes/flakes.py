#!/usr/bin/python3
"""Looks for tests that fail now and then; `./test flakes` calls this. What has passed is remembered, so that a run that was ended goes on
where it stood; another commit, or another change of the working tree, begins anew. Exit status 1: something failed.

Each test of `ctest` but those that only compute (label 'computes') runs 20 times beside six busy loops, three tests at a time; then the emulated machines start
five times (./test hil, ./test image), and all of continuous integration runs three times.
"""

import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import signal
import subprocess
import sys
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(os.fspath(ROOT / "tests" / "hil"))
from repeat import Load  # noqa: E402  (the folder is only now known)

BUILD = ROOT / "build" / "release"


def output_of(*command):
    return subprocess.run(command, cwd=ROOT, capture_output=True, check=True).stdout


def state_folder():
    """The passed tests of this commit and this working tree."""
    changes = output_of("git", "diff", "HEAD") + output_of("git", "ls-files", "--others", "--exclude-standard")
    name = output_of("git", "rev-parse", "--short", "HEAD").decode().strip()
    if changes:
        name += "-" + hashlib.sha256(changes).hexdigest()[:8]
    return ROOT / "out" / "flakes" / name


def labels_of(test):
    return next((entry["value"] for entry in test["properties"] if entry["name"] == "LABELS"), [])


def unit_tests(times):
    listed = json.loads(output_of("ctest", "--test-dir", BUILD, "--show-only=json-v1"))
    return [(test["name"], ["ctest", "--test-dir", BUILD, "--tests-regex", f"^{test['name']}$", "--repeat", f"until-fail:{times}",
                            "--no-tests=error", "--output-on-failure"])
            for test in listed["tests"] if "computes" not in labels_of(test)]


class Runs:
    """The runs that passed, one name a line, and the outputs of those that failed."""

    def __init__(self, folder):
        self._folder = folder
        folder.mkdir(parents=True, exist_ok=True)
        self._passed_file = folder / "passed.txt"
        self._passed = set(self._passed_file.read_text(encoding="utf-8").splitlines()) if self._passed_file.exists() else set()
        self.failed = []
        self._lock = threading.Lock()

    def make(self, name, command):
        if name in self._passed:
            return
        begun = time.monotonic()
        ran = subprocess.run([os.fspath(word) for word in command], cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        with self._lock:
            self._note(name, ran, time.monotonic() - begun)

    def _note(self, name, ran, seconds):
        passed = ran.returncode == 0
        print(f"   {name}: {'passed' if passed else 'FAILED'} in {seconds:.0f} s", flush=True)
        if passed:
            with open(self._passed_file, "a", encoding="utf-8") as file:
                file.write(f"{name}\n")
            return
        log = self._folder / f"{name.replace(' ', '_')}.log"
        log.write_bytes(ran.stdout)
        print(f"   its output is in {log}", flush=True)
        self.failed.append(name)


def main():
    parser = argparse.ArgumentParser(prog="./test flakes", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--times", metavar="N", type=int, default=20, help="runs of each test of ctest (20)")
    parser.add_argument("--loops", metavar="N", type=int, default=6, help="busy loops beside them (6)")
    parser.add_argument("--parallel", metavar="N", type=int, default=3, help="tests of ctest at a time (3)")
    parser.add_argument("--boots", metavar="N", type=int, default=5, help="runs of the emulated machines (5)")
    parser.add_argument("--ci", metavar="N", type=int, default=3, help="runs of .ci/run (3)")
    arguments = parser.parse_args()

    signal.signal(signal.SIGTERM, lambda *_: sys.exit(128 + signal.SIGTERM))  # ends the busy loops, too
    folder = state_folder()
    print(f"== what passed is remembered in {folder.relative_to(ROOT)}", flush=True)
    runs = Runs(folder)
    with Load(arguments.loops), concurrent.futures.ThreadPoolExecutor(arguments.parallel) as pool:
        for name, command in unit_tests(arguments.times):
            pool.submit(runs.make, f"{name} x {arguments.times}", command)
    for number in range(1, arguments.boots + 1):
        runs.make(f"hil {number}", ["./test", "hil"])
        runs.make(f"image {number}", ["./test", "image"])
    for number in range(1, arguments.ci + 1):
        runs.make(f"ci {number}", [".ci/run"])
    print(f"== {len(runs.failed)} failed" + "".join(f"\n   {name}" for name in runs.failed))
    return 1 if runs.failed else 0


if __name__ == "__main__":
    sys.exit(main())
