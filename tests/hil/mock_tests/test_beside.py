"""Work beside other work: what each says stays together, and one that fails or ends leaves the others alone. Which tests share a machine."""

import pathlib
import signal
import subprocess
import sys
import unittest

HIL = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(HIL))

# pylint: disable=wrong-import-position
import run_tests  # noqa: E402
from repeat import Run, together  # noqa: E402

MEET = """
import os, sys, time
from beside import beside, end_block
def meet(mine, other):
    '''Both have printed before either goes on.'''
    os.write(mine, b"x")
    os.read(other, 1)
(a, to_a), (b, to_b) = os.pipe(), os.pipe()
def first():
    print("one begins")
    meet(to_b, a)
    print("one ends", file=sys.stderr)
    end_block()
    print("one more")
    return 1
def second():
    print("two begins")
    meet(to_a, b)
    print("two ends")
    return 2
"""


def state(process):
    """A letter of proc(5), Z of a process that ended and that nobody has asked yet; empty: there is none."""
    try:
        return pathlib.Path(f"/proc/{process}/stat").read_text(encoding="ascii").rpartition(")")[2].split()[0]
    except OSError:
        return ""


class BesideTest(unittest.TestCase):
    def ran(self, program):
        return subprocess.run([sys.executable, "-c", MEET + program], cwd=HIL, text=True, timeout=60.0, capture_output=True, check=True).stdout

    def test_each_block_is_whole_and_says_whose_it_is(self):
        said = self.ran("print(beside([first, second]))")
        for block in ("[1] one begins\none ends\n", "[1] one more\n", "[2] two begins\ntwo ends\n"):
            self.assertEqual(said.count(block), 1, said)
        self.assertTrue(said.endswith("[1, 2]\n"), said)

    def test_one_that_ends_leaves_the_other_alone(self):
        said = self.ran("""
def killed():
    print("never told")
    os.kill(os.getpid(), 9)
def wrong():
    raise ValueError("so it is told")
print(beside([killed, lambda: 2, wrong]))
""")
        self.assertNotIn("never told", said)
        self.assertIn("so it is told", said)
        self.assertTrue(said.endswith("[None, 2, None]\n"), said)

    def test_a_block_alone_is_printed_at_once(self):
        self.assertEqual(self.ran("print('alone'); end_block(); sys.stdout.flush(); os._exit(0)"), "alone\n")

    def test_a_signal_ends_them_all(self):
        program = MEET + """
from family import Ended, Family
def sleeps(name):
    import shutil, subprocess, tempfile
    folder = tempfile.mkdtemp()
    try:
        program = subprocess.Popen(["sleep", "1000"], start_new_session=True)
        print(program.pid, folder)
        end_block()
        program.wait()
    finally:
        time.sleep(0.5) # the signal comes again meanwhile
        shutil.rmtree(folder)
try:
    with Family():
        beside([lambda: sleeps("one"), lambda: sleeps("two")])
except Ended as ended:
    os._exit(ended.status)
"""
        with subprocess.Popen([sys.executable, "-c", program], cwd=HIL, text=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as process:
            said = [process.stdout.readline().split() for _ in range(2)]
            process.send_signal(signal.SIGTERM)
            self.assertEqual(process.wait(30.0), 128 + signal.SIGTERM)
        for _, sleeper, folder in said:
            self.assertIn(state(int(sleeper)), "Z", "a program outlives the run")
            self.assertFalse(pathlib.Path(folder).exists(), "a piece of work could not tidy up")


class MachinesTest(unittest.TestCase):
    def test_each_module_is_in_one_machine(self):
        named = [module for each in run_tests.modules(2) for module in each]
        files = {file.stem.removeprefix("test_") for file in HIL.glob("test_*.py")}
        self.assertEqual(set(named), files)
        self.assertEqual(sorted(named), sorted([*files, run_tests.LAST]), "one module is in both machines")
        self.assertEqual(sorted(run_tests.modules(1)[0]), sorted(files))

    def test_two_runs_count_as_one(self):
        both = together([Run(1.0, 60.0, 0.2, ["a"], [(1.0, "a")]), Run(2.0, 50.0, 0.3, ["b"], [(2.0, "b")])])
        self.assertEqual(both, Run(2.0, 60.0, 0.3, ["a", "b"], [(1.0, "a"), (2.0, "b")]))


if __name__ == "__main__":
    unittest.main()
