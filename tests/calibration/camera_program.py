"""Tests frustumscreen-calibrate auto on the table without a camera: its messages and how it ends; and the printed tag sheet.

    camera_program.py BIN        BIN: the folder with the programs
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

from true_table import TrueTable

PROGRAM = pathlib.Path(sys.argv.pop(1)) / "frustumscreen-calibrate"
SVG = "{http://www.w3.org/2000/svg}"

SETTINGS = """
[projector]
width = 640
height = 400
[prop]
base_m = {base}
[tracker]
kind = "simulated"
[camera]
kind = "{camera}"
device = "/dev/video-that-is-not-there"
[panel]
kind = "scripted"
script = [{script}]
repeat_s = {repeat_s}
[exhibit]
library = "none"
[calibration]
folder = "kept"
sensor_height_m = 0.085
"""
BACK, NEXT = 0, 1
ALWAYS_BACK = {"presses": ((1.0, BACK),), "repeat_s": 1.5}  # until it ends


class Camera(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.config = self.folder / "kiosk.toml"

    def run_program(self, *words, camera="v4l2", base=0.30, presses=((0.3, NEXT), (6.0, BACK), (9.0, BACK)), repeat_s=100.0):
        script = ", ".join(f"{{ at_s = {at}, button = {button} }}" for at, button in presses)
        text = SETTINGS.replace("{script}", script).replace("{camera}", camera).replace("{base}", str(base))
        self.config.write_text(text.replace("{repeat_s}", str(repeat_s)))
        return subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=False)

    def test_reports_a_missing_camera(self):
        done = self.run_program("auto", "--config", self.config, "--headless")
        self.assertEqual(done.returncode, 1)
        self.assertIn("You need the prop on its printed board (3 mm thick)", done.stderr)
        self.assertIn("camera: no camera is connected; check its USB cable", done.stderr)
        self.assertIn("Light and dark follow each other. Back returns. No camera is connected; check its USB cable", done.stderr)
        self.assertTrue(done.stderr.endswith("the previous one is still used [calibrate.ended_early]\n"), done.stderr)
        self.assertFalse((self.folder / "kept").exists())

    def assert_said_in_turn(self, done, *sentences):
        at = 0
        for sentence in sentences:
            found = done.stderr.find(sentence, at)
            self.assertGreaterEqual(found, 0, f"'{sentence}' is not said, or not then: {done.stderr}")
            at = found + len(sentence)

    def test_buttons_offer_the_camera_then_the_crosses(self):
        table = ("table", "--config", self.config, "--headless")
        done = self.run_program(*table, **ALWAYS_BACK)
        self.assertEqual(done.returncode, 1)
        self.assert_said_in_turn(done, "Staff: measure the table with the camera", "Back goes on to measuring it with crosses.",
                                 "Staff: measure the whole table", "Nothing was changed.", "it ended before a calibration was kept")
        # Next does nothing if there is no camera.
        done = self.run_program(*table, presses=((5.0, NEXT), (8.0, BACK), (11.0, BACK), (14.0, BACK)))
        self.assertEqual(done.returncode, 1)
        self.assert_said_in_turn(done, "Staff: measure the table with the camera", "The camera cannot be used now No camera is connected",
                                 "press Back to measure the table with crosses.", "Staff: measure the whole table", "Nothing was changed.")
        self.assertNotIn("The camera looks at the light", done.stderr)
        # If Next comes at once, the fault is reported there.
        done = self.run_program(*table, presses=((0.5, NEXT), (3.5, BACK), (6.5, BACK), (9.5, BACK)))
        self.assert_said_in_turn(done, "The camera looks at the light", "Back goes on to the crosses. No camera is connected",
                                 "Staff: measure the whole table", "Nothing was changed.")
        self.assertFalse((self.folder / "kept").exists())

    def test_back_from_the_touch_up_offers_the_camera(self):
        (self.folder / "kept").mkdir()
        (self.folder / "kept/calibration-0001.toml").write_text(TrueTable(640, 0.4).calibration(0.085))
        done = self.run_program("table", "--config", self.config, "--headless", **ALWAYS_BACK)
        self.assertEqual(done.returncode, 1)
        self.assert_said_in_turn(done, "Staff: put the picture right", "Staff: measure the table with the camera",
                                 "Staff: measure the whole table", "Nothing was changed.")

    def test_offers_crosses_first_without_camera_or_board(self):
        for camera, base, said in (("none", 0.30, ""), ("v4l2", 0.36, "leaves no room for tags on a sheet of A3")):
            done = self.run_program("table", "--config", self.config, "--headless", camera=camera, base=base, **ALWAYS_BACK)
            self.assertEqual(done.returncode, 1)
            self.assert_said_in_turn(done, said, "Staff: measure the whole table", "Nothing was changed.")
            self.assertNotIn("with the camera", done.stderr)

    def test_rejects_wrong_use(self):
        none = self.run_program("auto", "--config", self.config, camera="none")
        self.assertEqual(none.returncode, 1)
        self.assertIn('the settings have no camera; set camera.kind = "v4l2"', none.stderr)
        for words in (["auto"], ["auto", "--config", self.config, "--json"], ["auto", "--config", self.config, "--from", "a", "--rests", "8"]):
            self.assertEqual(self.run_program(*words).returncode, 2, words)

    def test_writes_the_board_sheet(self):
        sheet = self.folder / "board.svg"
        for base in (0.30, 0.16):
            done = self.run_program("sheet", "--config", self.config, "-o", sheet, base=base)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            root = xml.etree.ElementTree.parse(sheet).getroot()
            self.assertEqual((root.get("width"), root.get("height")), ("420mm", "297mm"))
            self.assertTrue(any(f"{1000 * base:g} x {1000 * base:g}" in (text.text or "") for text in root.iter(f"{SVG}text")))
        large = self.run_program("sheet", "--config", self.config, "-o", sheet, base=0.36)
        self.assertEqual(large.returncode, 1)
        self.assertIn("leaves no room for tags on a sheet of A3; allowed are at most 339 mm", large.stderr)


if __name__ == "__main__":
    unittest.main()
