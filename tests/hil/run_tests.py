#!/usr/bin/env python3
"""Hardware in the loop: makes the guest, starts it once, runs the tests in it. `./test hil` calls this."""

import argparse
import pathlib
import shutil
import signal
import sys
import time
import unittest
from concurrent.futures import ThreadPoolExecutor

import image
from bench import Bench
from hil_test import HilTest

HERE = pathlib.Path(__file__).resolve().parent
# in this order: what the later ones rely on comes first
MODULES = ("boot", "pose", "trackers", "buttons", "unplug", "misbehaviour", "latency", "display", "restart", "kernel")


def say(text):
    print(f"== {text}", flush=True)


def named(tests, name):
    """The tests whose name contains `name`."""
    return [test for test in tests if name in test.id()]


def flat(suite):
    for test in suite:
        if isinstance(test, unittest.TestSuite):
            yield from flat(test)
        else:
            yield test


class Verdicts(unittest.TextTestResult):
    """Keeps what the machine shows when a test has failed, before the next one begins."""

    def _keep(self, test, error):
        folder = HilTest.bench.evidence_of(test)
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "failure.txt").write_text(self._exc_info_to_string(error, test), encoding="utf-8")
        say(f"{error[1]}\n   what the machine shows and says is in {folder}")
        HilTest.bench.keep_evidence(folder)

    def addFailure(self, test, err):
        super().addFailure(test, err)
        self._keep(test, err)

    def addError(self, test, err):
        super().addError(test, err)
        self._keep(test, err)

    def addSubTest(self, test, subtest, err):
        super().addSubTest(test, subtest, err)
        if err is not None:
            self._keep(test, err)


def parse_arguments():
    parser = argparse.ArgumentParser(prog="./test hil", description=__doc__)
    parser.add_argument("--only", metavar="NAME", help="the tests whose name contains NAME")
    parser.add_argument("--list", action="store_true", help="the tests' names, and nothing else")
    parser.add_argument("--keep", action="store_true", help="leave the machine up, and say how to get a shell in it")
    parser.add_argument("--build", type=pathlib.Path, default=image.CHECKOUT / "build" / "release",
                        help="take the programs from this build folder")
    parser.add_argument("--out", type=pathlib.Path, default=image.CHECKOUT / "out" / "hil",
                        help="where to leave what was found; emptied first")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    loader = unittest.TestLoader()
    tests = [test for name in MODULES if (HERE / f"test_{name}.py").exists()
             for test in flat(loader.loadTestsFromName(f"test_{name}"))]
    if arguments.only:
        tests = named(tests, arguments.only)
    if arguments.list:
        print("\n".join(test.id() for test in tests))
        return 0
    if not tests:
        print(f"hil: no test's name contains '{arguments.only}'; --list shows them all", file=sys.stderr)
        return 2

    build, out = arguments.build.resolve(), arguments.out.resolve()
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    with ThreadPoolExecutor() as both:  # one waits for the network, the other for the processor
        making = both.submit(image.root, build / "bin" / "frustumscreen", say)
        packs = image.packs(build, say)
        root = making.result()
    payload = image.payload(build, packs)
    HilTest.bench = Bench(root, payload, build, packs, out)
    passed = False
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # the machine does not outlive its tests
    try:
        say("starting the machine")
        say(f"it is up after {HilTest.bench.start():.0f} s")
        begun = time.monotonic()
        result = unittest.TextTestRunner(resultclass=Verdicts, verbosity=2).run(unittest.TestSuite(tests))
        say(f"{result.testsRun} tests in {time.monotonic() - begun:.0f} s; logs in {out}")
        passed = result.wasSuccessful()
    finally:
        if arguments.keep:
            print(HilTest.bench.how_to_enter())
        else:
            HilTest.bench.stop()
    return 0 if passed else 1


if __name__ == "__main__":
    sys.exit(main())
