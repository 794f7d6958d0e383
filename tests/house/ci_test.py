"""Tests what a run of continuous integration says of its parts, with artificial parts and the output of artificial tests."""

import pathlib
import subprocess
import tempfile
import unittest

CI = pathlib.Path(__file__).resolve().parents[2] / ".ci"


class Parts(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.logs = folder.name

    def run_parts(self, script):
        """(exit status, lines after the table's heading)"""
        ran = subprocess.run(["bash", "-c", f"set -euo pipefail; . {CI}/parts.sh {self.logs}; {script}; summary"], capture_output=True,
                             text=True, check=False)
        self.assertEqual(ran.stderr, "")
        return ran.returncode, ran.stdout.partition("== part")[2].splitlines()[1:]

    def test_prints_only_the_table_if_all_parts_pass(self):
        status, lines = self.run_parts("part one 85 86 true; part two 85 86 echo done")
        self.assertEqual((status, len(lines)), (0, 2))
        self.assertTrue(all(line.endswith("passed") for line in lines), lines)

    def test_prints_a_failed_part_with_its_log(self):
        status, lines = self.run_parts("part one 85 86 bash -c 'echo reason; exit 3'; part two 85 86 true")
        self.assertEqual(status, 1)
        self.assertEqual(lines[2:], [f"== one failed; its whole output is in {self.logs}/one.log", "   reason"])

    def test_a_part_without_time_fails(self):
        status, lines = self.run_parts("part one 0 86 true")
        self.assertEqual(status, 1)
        self.assertRegex("\n".join(lines), "(?s)left out: it would begin at minute 0; run true by hand.*== one failed.*left out")
        status, lines = self.run_parts("SECONDS=59; part one 85 1 sleep 30")
        self.assertEqual(status, 1)
        self.assertIn("ended at minute 1; run sleep 30 by hand", lines[0])

    def test_tolerates_a_part_that_may_lack_time(self):
        status, lines = self.run_parts("may_lack_time=true part one 0 86 true; SECONDS=59; may_lack_time=true part two 85 1 sleep 30")
        self.assertEqual((status, len(lines)), (0, 2))
        status, lines = self.run_parts("may_lack_time=true part one 85 86 bash -c 'exit 124'")  # not of timeout
        self.assertEqual(status, 1)
        self.assertTrue(lines[0].endswith("FAILED"), lines)
        status, _ = self.run_parts("may_lack_time=true part one 0 86 true; part two 0 86 true")  # set for one part alone
        self.assertEqual(status, 1)

    def test_prints_all_failures_in_the_last_ten_lines(self):
        for count in range(1, 8):
            parts = "; ".join(f"part number_{k} 85 86 bash -c 'seq 50; false'" for k in range(count))
            _, lines = self.run_parts(parts)
            for k in range(count):
                self.assertTrue(any(f"number_{k}.log" in line for line in lines[-10:]), lines)


class WhyFailed(unittest.TestCase):
    def said(self, text, lines=9):
        with tempfile.NamedTemporaryFile("w", suffix=".log") as log:
            log.write(text)
            log.flush()
            ran = subprocess.run([CI / "why_failed", log.name, str(lines)], capture_output=True, text=True, check=True)
        return [line.strip() for line in ran.stdout.splitlines()]

    def test_extracts_failures_of_googletest(self):
        self.assertEqual(self.said("[ RUN      ] Pack.Opens\n/house/tests/pack_test.cpp:53: Failure\nExpected equality:\n  1\n  2\n\n"
                                   "[  FAILED  ] Pack.Opens (2 ms)\n\t113 - pack_test (Failed)\n\t7 - cluster_test (Skipped)\n"),
                         ["pack_test.cpp:53: Failure | Expected equality: | 1 | 2", "pack_test (Failed)"])

    def test_extracts_failures_of_unittest(self):
        self.assertEqual(self.said("ERROR: test_seen (test_screen.Screen)\nIt is seen.\n----\nTraceback (most recent call last):\n"
                                   "  File \"x.py\", line 3\n    see()\n    ^^^^^\nTypeError: no object\n\nFAIL: test_stop (a.B)\n"
                                   "Traceback (most recent call last):\nmachine.MachineError: no answer\n"),
                         ["ERROR: test_seen (test_screen.Screen): TypeError: no object",
                          "FAIL: test_stop (a.B): machine.MachineError: no answer"])

    def test_extracts_files_that_were_left_behind(self):
        self.assertEqual(self.said("bake_test left these in the temporary folder:\n./pulse\n./pulse/native\n 54/165 Test #1: ok\n1 passed\n"),
                         ["bake_test left these in the temporary folder: | ./pulse | ./pulse/native"])

    def test_extracts_failures_of_scripts_pages_and_units(self):
        self.assertEqual(self.said("\nIn ./run line 3:\necho $x\n     ^-- SC2086: quote it\n\nx.cpp:3:1: error: no\ntests/x.py:1:1: 'os' imported\n"
                                   "docs/packs.md:7: frustumscreen-pack x\nfailed: frustumscreen.service\ntests/a.sh: line 3: no\nfine\n"),
                         ["In ./run line 3: | echo $x | ^-- SC2086: quote it", "x.cpp:3:1: error: no", "tests/x.py:1:1: 'os' imported",
                          "docs/packs.md:7: frustumscreen-pack x", "failed: frustumscreen.service", "tests/a.sh: line 3: no"])

    def test_falls_back_to_the_last_lines(self):
        self.assertEqual(self.said("".join(f"{k}\n" for k in range(30)), 3), ["27", "28", "29"])
        self.assertEqual(self.said("one\n", 3), ["one"])
        self.assertEqual(self.said("one\n", 0), [])

    def test_prints_at_most_the_requested_lines(self):
        self.assertEqual(len(self.said("failed: a\n" * 30, 4)), 4)


class Skipped(unittest.TestCase):
    def test_lists_skipped_googletest_and_unittest_cases(self):
        log = ("a_test.cpp:7: Skipped\nno GPU\n\n[  SKIPPED ] A.Draws (2 ms)\ntest_units (b.Units) ... ok\ntest_one (b.Units.test_one)\n"
               "It has a description. ... skipped 'no lintian'\ntest_two (b.Units.test_two) ... skipped 'why'\n")
        with tempfile.NamedTemporaryFile("w", suffix=".log") as file:
            file.write(log)
            file.flush()
            said = subprocess.run([CI.parent / "tests/house/list_skipped.sh", file.name], capture_output=True, text=True, check=True).stdout
        self.assertEqual(said, "== 3 tests were skipped\n   A.Draws: no GPU\n   test_one: no lintian\n   test_two: why\n")


if __name__ == "__main__":
    unittest.main()
