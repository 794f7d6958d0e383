#!/usr/bin/python3
"""Finds flaky tests, those that fail now and then; `./test flakes` calls this. Exit status 1: something failed.

Each test of `ctest` must pass 20 runs while six busy loops load the machine, three tests at a time, and five runs under each sanitizer
that continuous integration uses for it. Then the whole of continuous integration must pass three times, and the emulated machines five
times (./test hil, ./test image), of which three are parts of continuous integration.

out/flakes keeps a record of each run that passed, so a hunt that was stopped is continued. The runs of continuous integration start again
from zero with each change of a file, those of the emulated machines unless only pages and tests of ctest have changed. A test of ctest
starts again when one of its inputs changes; one additional run under strace records the inputs (inputs.py). A test that asks git, or that
cannot run under strace, as with a sanitizer, also starts again with each new commit. Tests that have never passed all their runs come
first, and of these the tests with threads.

The hunt skips tests that only compute, because the load of the machine cannot change their result. The label 'computes' marks such tests
with threads. The run under strace finds the others: the test is a program of the build that has one process and one thread from start to
end, and uses no wait, socket, lock, timer, and no file of /proc or /sys. Its disassembly must also have no call of a clock or of random
numbers outside GoogleTest, because strace does not see reads of a clock.
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import signal
import subprocess
import sys

import whole
from hunt import Hunt, tests_of
from inputs import Places

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(os.fspath(ROOT / "tests" / "hil"))
from repeat import Load  # noqa: E402  (found only by the path above)

STATE = ROOT / "out" / "flakes"
SANITIZERS = {"asan": "outside", "tsan": "threads"}  # preset -> label of the tests that ./test runs with it


def output_of(*command):
    return subprocess.run(command, cwd=ROOT, capture_output=True, check=True).stdout


def commit():
    """A name that identifies this commit and the changes of the working tree."""
    return f"{output_of('git', 'rev-parse', '--short', 'HEAD').decode().strip()}-{whole.state(ROOT, whole.ALL)}"


def environment(preset):
    """The environment variables that CMakePresets.json sets for the tests of a preset."""
    presets = json.loads((ROOT / "CMakePresets.json").read_text(encoding="utf-8"))["testPresets"]
    found, = (entry for entry in presets if entry["name"] == preset)
    return {name: value.replace("${sourceDir}", os.fspath(ROOT)) for name, value in found["environment"].items()}


def hunt_tests(hunt, places, loops, parallel, label=None):
    tests = [test for test in tests_of(places) if label is None or label in test.labels]
    labelled = [test for test in tests if "computes" in test.labels]
    waiting = hunt.waiting(test for test in tests if test not in labelled)
    left_out = len(labelled) + len(hunt.only_compute)
    print(f"== {len(tests)} tests of ctest: {len(waiting)} to run, {len(tests) - len(waiting) - left_out} passed with the same inputs, "
          f"{left_out} only compute", flush=True)
    with Load(loops), concurrent.futures.ThreadPoolExecutor(parallel) as pool:
        try:
            for _ in pool.map(hunt.make, waiting):
                pass
        finally:
            hunt.end()
    print(f"== left out because they only compute: {len(labelled)} by their label, {len(hunt.only_compute)} by their trace", flush=True)


def main():
    parser = argparse.ArgumentParser(prog="./test flakes", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--times", metavar="N", type=int, default=20, help="runs of each test of ctest (20)")
    parser.add_argument("--sanitized", metavar="N", type=int, default=5, help="runs of each test under a sanitizer (5)")
    parser.add_argument("--loops", metavar="N", type=int, default=6, help="busy loops beside them (6)")
    parser.add_argument("--parallel", metavar="N", type=int, default=3, help="tests of ctest at a time (3)")
    parser.add_argument("--boots", metavar="N", type=int, default=5, help="runs of the emulated machines, with those in .ci/run (5)")
    parser.add_argument("--ci", metavar="N", type=int, default=3, help="runs of .ci/run (3)")
    arguments = parser.parse_args()

    signal.signal(signal.SIGTERM, lambda *_: sys.exit(128 + signal.SIGTERM))  # an exception, which also ends the busy loops
    print(f"== runs that passed are recorded in {STATE.relative_to(ROOT)}", flush=True)
    git = output_of("git", "rev-parse", "--path-format=absolute", "--git-common-dir").decode().strip()
    places = Places(ROOT, ROOT / "build" / "release", ROOT.parent / "shared", git)
    hunt = Hunt(places, STATE / "tests", commit(), arguments.times)
    hunt_tests(hunt, places, arguments.loops, arguments.parallel)
    failed = hunt.failed
    for preset, label in SANITIZERS.items() if arguments.sanitized else ():
        print(f"== with the preset {preset}", flush=True)
        places = Places(ROOT, ROOT / "build" / preset, ROOT.parent / "shared", git)
        hunt = Hunt(places, STATE / preset, commit(), arguments.sanitized, environment(preset))
        hunt_tests(hunt, places, arguments.loops, arguments.parallel, label)
        failed += [f"{name} ({preset})" for name in hunt.failed]
    failed += whole.repeat(ROOT, STATE, arguments.boots, arguments.ci)
    print(f"== {len(failed)} failed" + "".join(f"\n   {name}" for name in failed))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
