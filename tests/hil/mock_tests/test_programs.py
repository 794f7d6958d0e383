import json
import os
import signal
import socket
import subprocess
import tempfile
import threading
import time
import unittest

from mocks import control, pose_file

FOLDER = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
TRACKER = os.path.join(FOLDER, "mock_tracker")
BUTTONS = os.path.join(FOLDER, "mock_buttons")
CAMERA = os.path.join(FOLDER, "mock_camera")


def whole_rows(log):
    """The poses of a log that is still written; its last row may be half written."""
    with open(log, encoding="ascii") as file:
        rows = file.read()
    return pose_file.parse(rows[:rows.rfind("\n") + 1], log)


def run(*arguments):
    return subprocess.run(arguments, capture_output=True, text=True)


class CommandLine(unittest.TestCase):
    def test_help_lists_the_commands(self):
        for program, word in ((TRACKER, "sensor-missing"), (BUTTONS, "bounce PIN"), (CAMERA, "garbage-headers")):
            found = run(program, "--help")
            self.assertEqual(found.returncode, 0)
            self.assertIn(word, found.stdout)

    def test_reports_wrong_use(self):
        for arguments, words in (((TRACKER,), "how the device is connected"),
                                 ((TRACKER, "--stdio", "--at", "soon"), "--at"),
                                 ((TRACKER, "--stdio", "--pty"), "not allowed with"),
                                 ((BUTTONS, "--tell", "x"), "--tell"),
                                 ((TRACKER, "--stdio", "--table-from-tracker", "[1, 2]"), "16 numbers"),
                                 ((TRACKER, "--usbip", "here"), "PORT")):
            found = run(*arguments)
            self.assertEqual(found.returncode, 2)
            self.assertIn(words, found.stderr)

    def test_reports_failures_in_one_line(self):
        for arguments in ((TRACKER, "--stdio", "--poses", "/nowhere.csv"), (TRACKER, "--tell", "/nowhere", "status"),
                          (TRACKER, "--usbredir", "/nowhere/socket"), (BUTTONS, "--socket", "/nowhere/socket")):
            found = run(*arguments)
            self.assertEqual(found.returncode, 1)
            self.assertEqual(len(found.stderr.splitlines()), 1)
        self.assertEqual(run(TRACKER, "--tell", "/nowhere", "status").stderr,
                         "mock_tracker: /nowhere: no mock listens there: No such file or directory\n")


class Telling(unittest.TestCase):
    def test_a_mock_that_ends_does_not_answer(self):
        with tempfile.TemporaryDirectory() as folder, socket.socket(socket.AF_UNIX) as listening:
            path = os.path.join(folder, "control")
            listening.bind(path)
            listening.listen()
            ends = threading.Thread(target=lambda: listening.accept()[0].close())
            ends.start()
            self.assertRaises(ConnectionError, control.tell, path, "status")
            ends.join()


class Running(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.control = os.path.join(self.folder.name, "control")
        self.process = None

    def tearDown(self):
        if self.process:
            self.process.send_signal(signal.SIGTERM)
            _, errors = self.process.communicate()
            self.assertEqual(self.process.returncode, 0, errors)
        self.folder.cleanup()

    def start(self, *arguments):
        self.process = subprocess.Popen([*arguments, "--control", self.control], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertIn(b"mock_", self.process.stderr.readline())

    def until(self, holds):
        while not holds():
            self.assertIsNone(self.process.poll())
            time.sleep(0.02)

    def test_a_tracker_obeys_commands_and_reports_its_status(self):
        log = os.path.join(self.folder.name, "log.csv")
        self.start(TRACKER, "--device", "patriot", "--stdio", "--log", log)
        self.process.stdin.write(b"U1\rF1\rC\r")
        self.process.stdin.flush()
        placed = control.tell(self.control, "pose 0.5 0.25 0 1 0 0 0")
        self.assertTrue(placed["ok"])
        self.until(lambda: (control.tell(self.control, "status")["changed"] or {}).get("t_ns", 0) > placed["t_ns"])
        status = control.tell(self.control, "status")
        self.assertEqual(status["last"]["poses"]["1"]["position_m"], [0.5, 0.25, 0.0])
        self.assertTrue(status["connected"])
        self.assertFalse(control.tell(self.control, "drop 7")["ok"])
        self.assertIn("unknown command", control.tell(self.control, "dance")["error"])
        self.assertTrue(control.tell(self.control, "drop 0.5 60s")["ok"])
        self.assertEqual(control.tell(self.control, "status")["faults"], {"drop": 0.5})
        self.assertTrue(control.tell(self.control, "good")["ok"])
        self.assertEqual(control.tell(self.control, "status")["faults"], {})
        self.until(lambda: whole_rows(log).at(1 << 60)[1].position == (0.5, 0.25, 0.0))

    def test_the_program_sends_commands(self):
        self.start(BUTTONS, "--usbredir", os.path.join(self.folder.name, "buttons"), "--at", "0s hold 3")
        told = run(BUTTONS, "--tell", self.control, "press", "1", "50ms")
        self.assertEqual(told.returncode, 0)
        self.assertEqual(run(BUTTONS, "--tell", self.control, "press", "8").returncode, 1)
        self.until(lambda: control.tell(self.control, "status")["pins"] == 0xFF & ~(1 << 3))
        control.tell(self.control, "release 3")
        answer = json.loads(run(BUTTONS, "--tell", self.control, "status").stdout)
        self.assertEqual(answer["pins"], 0xFF)
        self.assertFalse(answer["connected"])


if __name__ == "__main__":
    unittest.main()
