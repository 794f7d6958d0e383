"""Processes of a test run end with it, even if SIGTERM comes during a test or while the guest is made."""

import pathlib
import signal
import subprocess
import sys
import time
import unittest

HIL = pathlib.Path(__file__).resolve().parent.parent
# a process, one in its own session, and an orphan
STARTED = """
import subprocess, sys
from family import Ended, Family
def start():
    for command in ("exec sleep 1000", "setsid sleep 1001 & wait", "(sleep 1002 &)"):
        subprocess.Popen(["sh", "-c", command], start_new_session=True)
"""
IN_A_TEST = STARTED + """
import time, unittest
class Sleeps(unittest.TestCase):
    def test_sleeps(self):
        start()
        print("ready", flush=True)
        time.sleep(1000)
def work():
    unittest.main(argv=["x"])
"""
IN_A_THREAD = STARTED + """
from concurrent.futures import ThreadPoolExecutor
def work():
    start()
    def wait_for_it():
        program = subprocess.Popen(["sleep", "1003"])
        print("ready", flush=True)  # after the start, because the test would wait for a process that starts while all are ended
        program.wait()
    ThreadPoolExecutor().submit(wait_for_it).result()
"""
AT_ITS_END = STARTED + """
def work():
    start()
    print("ready", flush=True)
"""
RUN = """
try:
    with Family() as family:
        family.keep = "keep" in sys.argv
        work()
except Ended as ended:
    sys.exit(ended.status)
"""
SLEEPS = {"sleep 1000", "sleep 1001", "sleep 1002"}


def members(family):
    """The command lines of the living processes that belong to the family, by a variable of their environment."""
    mark = f"HIL_FAMILY={family}".encode()
    found = []
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            if mark in (folder / "environ").read_bytes() and b"Z" not in (folder / "stat").read_bytes().split()[2:3]:
                found.append((folder / "cmdline").read_bytes().decode().replace("\0", " ").strip())
        except OSError:
            continue
    return found


def wait_for_sleeps(process, family):
    """Waits until the shells have started their programs, which they may do after the test has printed `ready`."""
    while not SLEEPS <= set(members(family)):
        assert process.poll() is None, members(family)
        time.sleep(0.01)


class FamilyTest(unittest.TestCase):
    def started(self, program, *arguments):
        mark = f"{id(self)}-{self.id()}"
        process = subprocess.Popen([sys.executable, "-c", program + RUN, *arguments], cwd=HIL, text=True,
                                   env={"HIL_FAMILY": mark, "PATH": "/usr/bin:/bin"}, stdout=subprocess.PIPE,
                                   stderr=subprocess.DEVNULL)
        self.addCleanup(process.kill)
        self.addCleanup(process.stdout.close)
        self.assertEqual(process.stdout.readline(), "ready\n")
        return process, mark

    def assert_ended_by(self, number, program, *arguments):
        process, mark = self.started(program, *arguments)
        wait_for_sleeps(process, mark)
        process.send_signal(number)
        self.assertEqual(process.wait(), 128 + number)
        self.assertEqual(members(mark), [])

    def test_sigterm_in_a_test(self):
        self.assert_ended_by(signal.SIGTERM, IN_A_TEST)

    def test_sigterm_while_a_thread_waits_for_a_program(self):
        self.assert_ended_by(signal.SIGTERM, IN_A_THREAD)

    def test_a_signal_ends_kept_programs(self):
        self.assert_ended_by(signal.SIGINT, IN_A_TEST, "keep")

    def test_normal_exit_ends_all_programs(self):
        process, mark = self.started(AT_ITS_END)
        self.assertEqual(process.wait(), 0)
        self.assertEqual(members(mark), [])


if __name__ == "__main__":
    unittest.main()
