"""frustumscreen-calibrate auto on the table, without a camera that it could find: what it says, and how it ends; and the sheet of its board.

    camera_program.py BIN        BIN: the folder with the programs
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

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
script = [{ at_s = 0.3, button = 1 }, { at_s = 1.2, button = 0 }, { at_s = 1.5, button = 0 }]
repeat_s = 100.0
[exhibit]
library = "none"
[calibration]
folder = "kept"
"""


class Camera(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.config = self.folder / "kiosk.toml"

    def run_program(self, *words, camera="v4l2", base=0.30):
        self.config.write_text(SETTINGS.replace("{camera}", camera).replace("{base}", str(base)))
        return subprocess.run([PROGRAM, *words], capture_output=True, text=True, timeout=120, check=False)

    def test_no_camera_is_found(self):
        done = self.run_program("auto", "--config", self.config, "--headless")
        self.assertEqual(done.returncode, 1)
        self.assertIn("You need the prop on its printed board (3 mm thick)", done.stderr)
        self.assertIn("camera: no camera is connected; check its USB cable", done.stderr)
        self.assertIn("Light and dark follow each other. Back returns. No camera is connected; check its USB cable", done.stderr)
        self.assertTrue(done.stderr.endswith("it ended before a calibration was kept; the one before counts\n"), done.stderr)
        self.assertFalse((self.folder / "kept").exists())

    def test_wrong_use(self):
        none = self.run_program("auto", "--config", self.config, camera="none")
        self.assertEqual(none.returncode, 1)
        self.assertIn('the settings have no camera; set camera.kind = "v4l2"', none.stderr)
        for words in (["auto"], ["auto", "--config", self.config, "--json"], ["auto", "--config", self.config, "--from", "a", "--rests", "8"]):
            self.assertEqual(self.run_program(*words).returncode, 2, words)

    def test_sheet(self):
        sheet = self.folder / "board.svg"
        for base in (0.30, 0.16):
            done = self.run_program("sheet", "--config", self.config, "-o", sheet, base=base)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            root = xml.etree.ElementTree.parse(sheet).getroot()
            self.assertEqual((root.get("width"), root.get("height")), ("420mm", "297mm"))
            self.assertTrue(any(f"{1000 * base:g} x {1000 * base:g}" in (text.text or "") for text in root.iter(f"{SVG}text")))
        large = self.run_program("sheet", "--config", self.config, "-o", sheet, base=0.36)
        self.assertEqual(large.returncode, 1)
        self.assertIn("leaves no room for tags on a sheet of A3; up to 339 mm are allowed", large.stderr)


if __name__ == "__main__":
    unittest.main()
