#!/usr/bin/python3
"""Hardware in the loop: makes the guest, starts it, and runs the tests in it. `./test hil` calls this."""

import argparse
import os
import pathlib
import shutil
import sys
import time
import unittest

import image
from bench import Bench
from family import Ended, Family
from hil_test import HilTest, is_long
from repeat import Load, Run, as_text

# in this order, because later tests rely on earlier ones
MODULES = ("boot", "pose", "watch", "trackers", "buttons", "unplug", "camera", "camera_uses", "misbehaviour", "storm", "latency", "stick", "stick_report",
           "stick_copy", "stick_hostile", "stick_storm", "settings", "missing", "table", "calibration", "guidance", "stereo", "display", "screen", "torch", "windows", "vblank", "restart", "safe",
           "status", "hours", "watchdog", "delivery", "kernel")
SLOWEST = 10  # so many of the slowest tests are listed at the end


def say(text):
    print(f"== {text}", flush=True)


def flat(suite):
    for test in suite:
        if isinstance(test, unittest.TestSuite):
            yield from flat(test)
        else:
            yield test


class Verdicts(unittest.TextTestResult):
    """Prints the time of each test, and notes it in `took`; keeps evidence of a failure before the next test begins."""

    def startTestRun(self):
        super().startTestRun()
        self.took = []  # (seconds, name)

    def startTest(self, test):
        self._begun, self._begun_s = time.monotonic(), HilTest.bench.machine.processor_s()
        super().startTest(test)

    def stopTest(self, test):
        super().stopTest(test)
        took_s, machine_s = time.monotonic() - self._begun, HilTest.bench.machine.processor_s() - self._begun_s
        self.took.append((took_s, test.id()))
        self.stream.writeln(f"    {took_s:.0f} s, {machine_s:.0f} s of processors for the machine")

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


def numbers(text):
    return [int(word) for word in text.split(",")]


def parse_arguments():
    parser = argparse.ArgumentParser(prog="./test hil", description=__doc__)
    parser.add_argument("--only", metavar="NAME[,NAME...]",
                        help="run the tests whose name contains NAME, also long ones")
    parser.add_argument("--all", action="store_true", help="run the long tests too")
    parser.add_argument("--list", action="store_true", help="only list the tests' names")
    parser.add_argument("--repeat", metavar="N", type=int, default=1,
                        help="run them N times, each time in a new machine; a table at the end")
    parser.add_argument("--load", metavar="N[,N...]", default="0", type=numbers,
                        help="run them with so many busy loops; several numbers: with each of them")
    parser.add_argument("--keep", action="store_true", help="leave the last machine up, and say how to get a shell in it")
    parser.add_argument("--out", type=pathlib.Path, default=image.CHECKOUT / "out" / "hil",
                        help="folder for logs and evidence; emptied first")
    return parser.parse_args()


def chosen(arguments, unsigned=None):
    """The tests to run, made again for each run, because unittest drops tests that it has run. `unsigned`: True: only tests whose machine
    takes a kernel module without a signature; False: only the others."""
    tests = flat(unittest.defaultTestLoader.loadTestsFromNames(f"test_{name}" for name in MODULES))
    tests = [test for test in tests if unsigned in (None, test.unsigned)]
    if arguments.only:
        return [test for test in tests if any(name in test.id() for name in arguments.only.split(","))]
    return [test for test in tests if arguments.all or not is_long(test)]


def made(out, unsigned):
    """The machine's parts: files, disk, packs. `unsigned`: with an unsigned module, which a locked-down kernel refuses."""
    packs = image.packs(say)
    image.start_files(out, image.vkms(say) if unsigned else None)
    return out, image.disk(packs, out / "disk.raw"), packs


def run(tests, bench, keep):
    """Runs the tests in a machine; returns the result."""
    HilTest.bench, HilTest.longest_s = bench, 0.0
    try:
        say("starting the machine")
        start_s = bench.start()
        say(f"it is up after {start_s:.0f} s")
        begun = time.monotonic()
        result = unittest.TextTestRunner(resultclass=Verdicts, verbosity=2).run(unittest.TestSuite(tests))
        took_s = time.monotonic() - begun
        for seconds, name in sorted([(start_s, "the machine's start"), *result.took], reverse=True)[:SLOWEST]:
            print(f"   {seconds:6.0f} s   {name}")
        say(f"{result.testsRun} tests in {took_s:.0f} s, the slowest above; logs in {bench.out}")
        wrong = [test.id() for test, _ in (*result.failures, *result.errors)]
        return Run(os.getloadavg()[1], took_s, HilTest.longest_s, wrong)
    finally:
        if keep:
            print(bench.how_to_enter())
        else:
            bench.stop()


def main(family):
    arguments = parse_arguments()
    tests = chosen(arguments)
    if arguments.list:
        print("\n".join(test.id() for test in tests))
        return 0
    if not tests:
        print(f"hil: no test's name contains '{arguments.only}'; --list shows them all", file=sys.stderr)
        return 2

    out = arguments.out.resolve()
    shutil.rmtree(out, ignore_errors=True)
    kinds = [unsigned for unsigned in (False, True) if chosen(arguments, unsigned)]
    runs = [(loops, number, unsigned) for loops in arguments.load for number in range(1, arguments.repeat + 1) for unsigned in kinds]
    table = []
    for loops, number, unsigned in runs:
        folder = out if len(runs) == 1 else out / f"load_{loops}_run_{number}{'_unsigned' if unsigned else ''}"
        files, disk, packs = made(folder / "machine", unsigned)
        family.keep = arguments.keep and (loops, number, unsigned) == runs[-1]
        with Load(loops):
            done = run(chosen(arguments, unsigned), Bench(files, disk, packs, folder), family.keep)
        table.append((loops, number, done))
        if len(runs) > 1:
            (out / "table.txt").write_text(as_text(table), encoding="utf-8")
            print(as_text(table), flush=True)
    return 1 if any(done.wrong for _, _, done in table) else 0


if __name__ == "__main__":
    try:
        with Family() as whole:
            status = main(whole)
    except Ended as ended:
        print(f"hil: ended by {ended}", file=sys.stderr, flush=True)
        os._exit(ended.status)  # at once, because a thread that waits for a program could start the next one
    sys.exit(status)
