"""Tests frustumscreen-calibrate eye on the table from beginning to end, without a person. A recording of two sensors stands for the person,
whose head moves so that the prop's corners lie over the shown crosses, and a script presses Next.

    eye_table_program.py BIN        BIN: the folder with the programs

The truth's arithmetic is in true_table.py and in this file. The recording has no noise: the eyes are found within 0.2 mm.
"""

import json
import math
import pathlib
import subprocess
import sys
import tempfile
import tomllib
import unittest

from true_table import TrueTable, apply, plus, quaternion, times, turn

PROGRAMS = pathlib.Path(sys.argv.pop(1))
PROGRAM = PROGRAMS / "frustumscreen-calibrate"
BACK, NEXT = 0, 1
SENSOR_M = 0.085
LEFT, RIGHT = (-0.02, 0.05, -0.07), (0.04, 0.046, -0.066)  # the eyes, in the head's sensor
USUAL_EYE = (0.0, -0.55, 0.5)
BEGIN_S, SHUT_S, EACH_S, AIM_S, PRESS_S = 0.3, 2.6, 2.4, 0.6, 0.9
POSTURES = {"chin up": (0.3, 0.0), "chin down": (-0.3, 0.0), "left": (0.0, 0.4), "right": (0.0, -0.4)}
ASKED = ("chin up", "left", "chin down", "right", "chin up", "chin down")

SETTINGS = """
[projector]
width = 1280
height = 800
[tracker]
kind = "{tracker}"
poses = "poses.csv"
[panel]
kind = "scripted"
script = [{script}]
[exhibit]
library = "none"
[calibration]
folder = "kept"
"""


class Eyes(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.config = self.folder / "kiosk.toml"
        self.kept = self.folder / "kept"
        self.truth = TrueTable(1280, 0.4)
        self.rows = ["t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok"]

    def write(self, presses, tracker="replay"):
        script = ", ".join(f"{{ at_s = {at:.2f}, button = {button} }}" for at, button in presses)
        self.config.write_text(SETTINGS.replace("{script}", script).replace("{tracker}", tracker))

    def keep(self):
        self.kept.mkdir()
        (self.kept / "calibration-0001.toml").write_text(self.truth.calibration(SENSOR_M))
        (self.kept / "drift.json").write_text("a camera's reference, which is of the projector")

    def run_program(self, *words):
        return subprocess.run([PROGRAM, *words], capture_output=True, text=True, timeout=120, check=False)

    def eye(self, *words):
        return self.run_program("eye", "--config", self.config, *words)

    def record(self, until_s, prop, head):
        """Records both sensors at rest, from the recording's current end to the given time."""
        done = (len(self.rows) - 1) // 2
        for k in range(done, int(50 * until_s)):
            for station, report in ((1, prop), (2, head)):
                self.rows.append(f"{k * 20000},{station}," + ",".join(f"{value:.9f}" for value in report) + ",1")
        (self.folder / "poses.csv").write_text("\n".join(self.rows) + "\n")

    def head(self, eye, in_sensor, nod, aside):
        """The tracker's report of the sensor on a head that looks down at the table, with the given eye at the given place."""
        rotation = times(turn((0, 0, 1), aside), turn((1, 0, 0), nod - 0.45))
        place = plus(eye, apply(rotation, in_sensor), -1.0)
        return (*self.truth.in_tracker(place), *quaternion(times(turn((0, 0, 1), self.truth.yaw), rotation)))

    def at_first(self):
        """The sensor of a head at the visitors' usual place, for which the printed crosses are planned."""
        return self.head(USUAL_EYE, (0.0, 0.0, 0.0), 0.0, 0.0)

    def sight(self, cross, in_sensor, posture):
        tip = cross["tip_m"]
        lit = self.truth.light(cross["u_px"], cross["v_px"], 0.0)
        way = plus(tip, lit, -1.0)
        eye = plus(tip, way, 0.45 / math.hypot(way[0], way[1]))
        self.assertTrue(0.3 < eye[2] < 0.8 and eye[1] < -0.25, eye)
        return self.head(eye, in_sensor, *POSTURES[posture])

    def whole(self, printed):
        """The recording and the presses."""
        place = printed["table_from_prop"][12:15]
        corners = [(place[0] + x, place[1] + y, 0.155) for x in (-0.04, 0.04) for y in (-0.04, 0.04)]
        prop = self.truth.report(place, 0.0, SENSOR_M)
        presses = [(BEGIN_S, NEXT), (SHUT_S, NEXT)]
        at = SHUT_S + 0.4
        self.record(at, prop, self.at_first())
        for in_sensor in (LEFT, RIGHT):
            if in_sensor == RIGHT:
                presses.append((at + 0.3, NEXT))
                at += AIM_S
            for cross, posture in zip(printed["crosses"], ASKED):
                self.assertLess(min(math.dist(cross["tip_m"], corner) for corner in corners), 1e-6)
                presses.append((at + PRESS_S, NEXT))
                at += EACH_S
                self.record(at, prop, self.sight(cross, in_sensor, posture))
        presses.append((at + 1.5, NEXT))
        self.record(at + 8.0, prop, self.at_first())
        return presses

    def test_measures_and_keeps_the_eyes(self):
        self.write([])
        self.record(0.1, self.truth.report((0, 0, 0), 0, SENSOR_M), self.at_first())
        self.rows = self.rows[:1]
        self.keep()
        printed = self.eye("--json")
        self.assertEqual(printed.returncode, 0, printed.stderr)
        printed = json.loads(printed.stdout)
        self.assertGreaterEqual(len(printed["crosses"]), 6)
        self.write(self.whole(printed))
        sights = self.folder / "sights.csv"
        done = self.eye("--headless", "--out", sights)
        self.assertEqual(done.returncode, 0, done.stderr)
        for said in ("Staff: where are the eyes?", "Shut your right eye", "Sighting 1 of 12: chin up", "Shut your left eye", "Sighting 12 of 12",
                     "The eyes' place is: ", "The eyes' place is kept."):
            self.assertIn(said, done.stderr)
        self.assertEqual(len(sights.read_text().splitlines()), 13)
        before = tomllib.loads((self.kept / "calibration-0001.toml").read_text())
        after = tomllib.loads((self.kept / "calibration-0002.toml").read_text())
        true_middle = [(a + b) / 2 for a, b in zip(LEFT, RIGHT)]
        off = math.dist(after["tracker"]["eye_in_sensor_m"], true_middle)
        print(f"the eye is off by {1e3 * off:.3f} mm")
        self.assertLess(off, 2e-4)
        self.assertEqual(after["projector"]["fx"], before["projector"]["fx"])
        for key in ("table_from_tracker", "sensor_from_prop"):
            self.assertLess(math.dist(after["tracker"][key], before["tracker"][key]), 1e-9)
        self.assertIn("camera's reference", (self.kept / "drift.json").read_text())
        again = json.loads(self.eye("--from", sights, "--json").stdout)
        self.assertLess(math.dist(again["eye_in_sensor_m"], after["tracker"]["eye_in_sensor_m"]), 1e-9)

    def test_reports_missing_calibration_and_tracker(self):
        self.record(0.1, self.truth.report((0, 0, 0), 0, SENSOR_M), self.at_first())
        self.write([(0.2, NEXT), (1.0, BACK)])
        none = self.eye("--headless")
        self.assertEqual(none.returncode, 1)
        self.assertIn("The eyes cannot be measured No calibration is kept", none.stderr)
        self.keep()
        self.write([(0.3, BACK)])
        left = self.eye("--headless")
        self.assertEqual(left.returncode, 1)
        self.assertIn("Nothing was changed.", left.stderr)
        self.assertIn("it ended before a calibration was kept; the previous one is still used", left.stderr)
        self.assertEqual(sorted(each.name for each in self.kept.iterdir()), ["calibration-0001.toml", "drift.json"])
        self.write([(0.3, BACK)], tracker="none")
        failed = self.eye("--headless")
        self.assertEqual(failed.returncode, 1)
        self.assertIn("needs a tracker and two buttons", failed.stderr)

    def test_rejects_wrong_use(self):
        self.write([])
        for words in (["eye"], ["eye", "--config", self.config, "--keep"], ["eye", "--config", self.config, "--from", "a", "--out", "b"],
                      ["eye", "--config", self.config, "--from", "a", "--headless"]):
            self.assertEqual(self.run_program(*words).returncode, 2, words)


if __name__ == "__main__":
    unittest.main()
