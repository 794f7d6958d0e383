"""Tests frustumscreen-calibrate table from beginning to end, without a person: a recording in which the prop is laid on each shown cross, under a
projector whose pose differs from the settings, and a script that presses Next.

The truth's arithmetic is in true_table.py. The recording has no noise: each place is then lit within two pixels of its true pixel.
"""

import json
import math
import pathlib
import struct
import subprocess
import sys
import tempfile
import tomllib
import unittest

import numpy as np
from true_table import TrueTable

PROGRAMS = pathlib.Path(sys.argv.pop(1))
PROGRAM = PROGRAMS / "frustumscreen-calibrate"
EACH_S, PRESS_S, BEGIN_S = 2.4, 0.9, 0.3
SENSOR_M = 0.085

SETTINGS = """
[projector]
width = 1280
height = 800
throw_ratio = 1.875
position_m = [0.0, 0.0, 1.5]
[tracker]
kind = "replay"
poses = "poses.csv"
[panel]
kind = "scripted"
script = [{script}]
[exhibit]
library = "none"
[calibration]
folder = "kept"
sensor_height_m = {sensor_m}
touches = 15
"""


def matrix(numbers):
    return np.array(numbers).reshape(4, 4).T


class Table(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.config = self.folder / "kiosk.toml"

    def write(self, presses_s, back_s=None):
        presses = [(at, 1) for at in presses_s] + ([(back_s, 0)] if back_s else [])
        script = ", ".join(f"{{ at_s = {at:.2f}, button = {button} }}" for at, button in presses)
        self.config.write_text(SETTINGS.replace("{script}", script).replace("{sensor_m}", str(SENSOR_M)))

    def run_program(self, *words):
        return subprocess.run([PROGRAM, *words], capture_output=True, text=True, timeout=120, check=False)

    def record(self, crosses, truth, head=None):
        """Records the prop on one cross after the other; the tracker's frame is the table's, rotated and shifted."""
        rows = ["t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok"]
        end_s = EACH_S * len(crosses) + 12.0
        for k in range(int(50 * end_s)):
            cross = crosses[min(int(k / 50 / EACH_S), len(crosses) - 1)]
            place = truth.light(cross["u_px"], cross["v_px"], cross["block_m"])
            report = truth.report(place, math.radians(cross["turn_deg"]), SENSOR_M)
            for station, report in ((1, report), (2, head)):
                if report:
                    rows.append(f"{k * 20000},{station}," + ",".join(f"{value:.9f}" for value in report) + ",1")
        (self.folder / "poses.csv").write_text("\n".join(rows) + "\n")

    def test_calibrates_and_keeps_the_file(self):
        self.write([])
        self.record([{"u_px": 640, "v_px": 400, "block_m": 0, "turn_deg": 0}], TrueTable(1280, 0.0))
        self.assertEqual(json.loads(self.run_program("kept", "--config", self.config, "--json").stdout), {"kept": []})
        printed = self.run_program("table", "--config", self.config, "--json")
        self.assertEqual(printed.returncode, 0, printed.stderr)
        crosses = json.loads(printed.stdout)["crosses"]
        self.assertEqual(len(crosses), 15)
        self.assertEqual({cross["block_m"] for cross in crosses}, {0.0, 0.12})
        for cross in crosses:  # the prop, 30 cm wide, stands on the table of 80 x 50 cm, by the settings' own projector
            height = 1.5 - cross["block_m"]
            x, y = (cross["u_px"] - 640) / 2400 * height, (400 - cross["v_px"]) / 2400 * height
            self.assertLessEqual(abs(x), 0.25, cross)
            self.assertLessEqual(abs(y), 0.10, cross)
        self.record(crosses, TrueTable(1280, 0.4))
        self.write([BEGIN_S] + [EACH_S * k + PRESS_S for k in range(15)] + [EACH_S * 15 + 2.0])
        done = self.run_program("table", "--config", self.config, "--headless", "--out", self.folder / "touches.csv")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len((self.folder / "touches.csv").read_text().splitlines()), 16)
        self.assertNotIn("where are the eyes", done.stderr)  # no sensor on a head
        self.check_kept(0.4)
        self.check_listed()

    def check_kept(self, yaw_of_tracker):
        kept = tomllib.loads((self.folder / "kept/calibration-0001.toml").read_text())
        self.assertEqual((kept["method"], kept["places"]), ("touch", 15))
        self.check_picture(kept, TrueTable(1280, yaw_of_tracker))
        self.assertAlmostEqual(kept["tracker"]["sensor_from_prop"][14], -SENSOR_M, delta=1e-3)

    def check_picture(self, kept, truth):
        p = kept["projector"]
        pixel_from_tracker = np.linalg.inv(matrix(p["table_from_projector"])) @ matrix(kept["tracker"]["table_from_tracker"])
        worst = 0.0
        for height in (0.0, 0.06, 0.12):
            for u in range(100, 1281, 180):
                for v in range(100, 801, 150):
                    place = truth.light(u, v, height)
                    x, y, z, _ = pixel_from_tracker @ np.array([*truth.in_tracker(place), 1.0])
                    r2 = (x * x + y * y) / (z * z)
                    bend = 1 + p["k1"] * r2 + p["k2"] * r2 * r2
                    found = np.array([p["fx"] * bend * x / z + p["cx"], p["fy"] * bend * y / z + p["cy"]])
                    worst = max(worst, np.linalg.norm(found - np.array(truth.pixel(place))))
        print(f"{worst:.2f} pixels at the worst place")
        self.assertLess(worst, 2.0)

    def check_listed(self):
        """The settings include the kept calibration until it is undone."""
        config = [PROGRAMS / "frustumscreen", "config", "--config", self.config, "--json"]
        used = json.loads(subprocess.run(config, capture_output=True, text=True, check=True).stdout)
        self.assertEqual(used["calibration"]["used"]["file"], "calibration-0001.toml")
        run = [PROGRAMS / "frustumscreen", "run", "--config", self.config, "--headless", "--pattern", "--seconds", "0.2"]
        ran = subprocess.run(run, capture_output=True, text=True, check=True)
        self.assertIn("calibration: calibration-0001.toml is used", ran.stderr)
        self.assertNotEqual(used["projector"]["fx"], 2400.0)
        listed = self.run_program("kept", "--config", self.config, "--json")
        self.assertEqual([each["file"] for each in json.loads(listed.stdout)["kept"]], ["calibration-0001.toml"])
        undone = self.run_program("kept", "--config", self.config, "--undo")
        self.assertEqual((undone.returncode, undone.stdout), (0, "No calibration is kept; the set-up is as the settings describe it.\n"))
        again = self.run_program("kept", "--config", self.config, "--undo")
        self.assertEqual(again.returncode, 1)
        self.assertIn("there is no calibration to undo", again.stderr)
        used = json.loads(subprocess.run(config, capture_output=True, text=True, check=True).stdout)
        self.assertNotIn("used", used["calibration"])
        self.assertEqual(used["projector"]["fx"], 2400.0)

    def touch_up(self, truth, crosses, *words):
        rows = ["tx_m,ty_m,tz_m,qw,qx,qy,qz,u_px,v_px,block_m"]
        for k, (u, v, block) in enumerate(crosses):
            report = truth.report(truth.light(u, v, block), 0.5 * math.pi * k, SENSOR_M)
            rows.append(",".join(f"{value:.9f}" for value in (*report, u, v, block)))
        (self.folder / "few.csv").write_text("\n".join(rows) + "\n")
        return self.run_program("touch", "--touch-up", "--from", self.folder / "few.csv", "--config", self.config, *words)

    def test_touches_up_a_kept_calibration(self):
        self.write([])
        self.record([{"u_px": 640, "v_px": 400, "block_m": 0, "turn_deg": 0}], TrueTable(1280, 0.0))
        crosses = [(90, 60, 0), (1190, 160, .12), (640, 740, 0), (1190, 740, 0), (90, 740, .12), (1190, 60, 0), (640, 60, .12)]
        truth = TrueTable(1280, 0.4)
        none = self.touch_up(truth, crosses)
        self.assertEqual(none.returncode, 1)
        self.assertIn("no calibration is kept there, so there is nothing to touch up", none.stderr)
        kept = self.folder / "kept"
        kept.mkdir()
        (kept / "calibration-0001.toml").write_text(truth.calibration(SENSOR_M))
        (kept / "drift.json").write_text("{}")  # a camera reported drift, but only the camera moved
        same = self.touch_up(truth, crosses[:3], "--keep")
        self.assertEqual((same.returncode, [each.name for each in kept.iterdir()]), (0, ["calibration-0001.toml"]), same.stderr)
        self.assertIn("nothing moved", same.stdout)
        truth.tracker_place = (0.112, 0.192, -0.042)  # 8 mm lower, and aside
        three = self.touch_up(truth, crosses[:3], "--keep")
        self.assertEqual((three.returncode, len(list(kept.iterdir()))), (1, 1))
        self.assertIn("touch two more crosses", three.stderr)
        line = self.touch_up(truth, [(90, 60, 0), (640, 400, 0), (1190, 740, 0.12)])
        self.assertEqual(line.returncode, 1)
        self.assertIn("in one line", line.stderr)
        found = self.touch_up(truth, crosses, "--keep", "--json")
        self.assertEqual(found.returncode, 0, found.stderr)
        found = json.loads(found.stdout)
        self.assertEqual((found["moved"], found["verdict"]), ("tracker", "good"))
        self.assertAlmostEqual(found["off_mm"], 15.5, delta=2.0)
        self.check_picture(tomllib.loads((kept / "calibration-0002.toml").read_text()), truth)
        drawn = self.touch_up(truth, crosses, "--map", self.folder / "map.png")  # of the kept calibration: nothing moves
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        self.assertIn("nothing moved", drawn.stdout)
        self.assertEqual(struct.unpack(">II", (self.folder / "map.png").read_bytes()[16:24]), (1600, 900))

    def test_offers_the_touch_up_and_corrects_the_picture(self):
        self.write([])
        truth = TrueTable(1280, 0.4)
        self.record([{"u_px": 640, "v_px": 400, "block_m": 0, "turn_deg": 0}], truth)
        none = self.run_program("table", "--touch-up", "--config", self.config, "--headless")
        self.assertEqual(none.returncode, 1)
        self.assertIn("no calibration is kept there, so there is nothing to touch up", none.stderr)
        kept = self.folder / "kept"
        kept.mkdir()
        (kept / "calibration-0001.toml").write_text(truth.calibration(SENSOR_M))
        crosses = json.loads(self.run_program("table", "--touch-up", "--config", self.config, "--json").stdout)["crosses"][:7]
        truth.place = (0.066, -0.034, 1.445)  # the projector was bumped by 10 mm
        self.record(crosses, truth, truth.report((0.0, -0.5, 0.5), 0.0, 0.0))
        touched_s = EACH_S * 7
        self.write([BEGIN_S] + [EACH_S * k + PRESS_S for k in range(7)] + [touched_s + 2.0], touched_s + 8.0)
        done = self.run_program("table", "--config", self.config, "--headless", "--out", self.folder / "touches.csv")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("Staff: where are the eyes?", done.stderr)  # a sensor on a head is seen, and its eyes are unknown
        self.assertEqual(len((self.folder / "touches.csv").read_text().splitlines()), 8)
        self.assertIn("Staff: put the picture right", done.stderr)
        self.assertIn("Touch 7 of 7", done.stderr)
        self.assertRegex(done.stderr, r"The projector moved.* The picture was (8|9|10) mm off\.")
        self.assertIn("The calibration is kept.", done.stderr)
        self.check_picture(tomllib.loads((kept / "calibration-0002.toml").read_text()), truth)

    def test_back_from_the_touch_up_offers_the_full_calibration(self):
        self.write([])
        truth = TrueTable(1280, 0.4)
        self.record([{"u_px": 640, "v_px": 400, "block_m": 0, "turn_deg": 0}], truth)
        (self.folder / "kept").mkdir()
        (self.folder / "kept/calibration-0001.toml").write_text(truth.calibration(SENSOR_M))
        presses = ", ".join(f"{{ at_s = {at}, button = 0 }}" for at in (0.3, 3.0))
        self.config.write_text(self.config.read_text().replace("script = []", f"script = [{presses}]"))
        left = self.run_program("table", "--config", self.config, "--headless")
        self.assertEqual(left.returncode, 1)
        self.assertRegex(left.stderr, r"(?s)Staff: put the picture right.*Staff: measure the whole table.*Nothing was changed")
        self.assertEqual([each.name for each in (self.folder / "kept").iterdir()], ["calibration-0001.toml"])

    def test_from_start_offers_no_touch_up(self):
        self.write([])
        self.record([{"u_px": 640, "v_px": 400, "block_m": 0, "turn_deg": 0}], TrueTable(1280, 0.4))
        (self.folder / "kept").mkdir()
        (self.folder / "kept/calibration-0001.toml").write_text(TrueTable(1280, 0.4).calibration(SENSOR_M))
        self.config.write_text(self.config.read_text().replace("script = []", "script = [{ at_s = 0.3, button = 0 }]"))
        note = "--anew is the old name of --from-start; use --from-start instead"
        for option, is_old in (("--from-start", False), ("--anew", True)):
            left = self.run_program("table", option, "--config", self.config, "--headless")
            self.assertEqual(left.returncode, 1)
            self.assertIn("Staff: measure the whole table", left.stderr)
            self.assertNotIn("Staff: put the picture right", left.stderr)
            self.assertEqual(left.stderr.count(note), int(is_old))
        self.assertNotIn("--anew", self.run_program("table", "--help").stdout)
        both = self.run_program("table", "--from-start", "--touch-up", "--config", self.config)
        self.assertEqual(both.returncode, 2)

    def test_back_leaves_without_changes(self):
        self.write([])
        self.record([{"u_px": 640, "v_px": 400, "block_m": 0, "turn_deg": 0}], TrueTable(1280, 0.0))
        self.config.write_text(self.config.read_text().replace("script = []", "script = [{ at_s = 0.3, button = 0 }]"))
        left = self.run_program("table", "--config", self.config, "--headless")
        self.assertEqual(left.returncode, 1)
        self.assertIn("Next begins. Back returns to the exhibit", left.stderr)
        self.assertRegex(left.stderr, "boards that make 120 mm")
        self.assertIn("it ended before a calibration was kept; the previous one is still used", left.stderr)
        self.assertFalse((self.folder / "kept").exists())
        # Missing requirements are shown on the table, and Next does nothing.
        text = self.config.read_text().replace(f"sensor_height_m = {SENSOR_M}", "")
        self.config.write_text(text.replace("script = [", "script = [{ at_s = 0.1, button = 1 }, "))
        left = self.run_program("table", "--config", self.config, "--headless")
        self.assertEqual(left.returncode, 1)
        self.assertIn("The table cannot be measured The sensor's height above the prop's bottom is not known", left.stderr)
        self.assertIn("set calibration.sensor_height_m", left.stderr)

    def test_rejects_settings_without_a_tracker(self):
        self.write([1.0])
        self.config.write_text(self.config.read_text().replace('kind = "replay"\nposes = "poses.csv"', 'kind = "none"'))
        failed = self.run_program("table", "--config", self.config, "--headless")
        self.assertEqual(failed.returncode, 1)
        self.assertIn("needs a tracker and two buttons", failed.stderr)

    def test_rejects_stereo_before_it_begins(self):
        """The projector stretches a half of the picture, or alternates two; an anaglyph is shown pixel for pixel."""
        self.write([1.0])
        usual = self.config.read_text()
        for command in ("table", "eye"):
            for stereo in ("side_by_side", "top_bottom", "frame_sequential"):
                self.config.write_text(f'[eye]\nstereo = "{stereo}"\n' + usual)
                failed = self.run_program(command, "--config", self.config, "--headless")
                self.assertEqual(failed.returncode, 1)
                self.assertIn(f'"{stereo}"', failed.stderr)
                self.assertIn("[calibrate.stereo]", failed.stderr)
                self.assertEqual(len(failed.stderr.splitlines()), 1, "nothing has begun")
        self.record([{"u_px": 640, "v_px": 400, "block_m": 0, "turn_deg": 0}], TrueTable(1280, 0.0))
        for plain in ('[eye]\nstereo = "side_by_side"\n' + usual.replace("[projector]", '[projector]\nstereo = "off"'),
                      '[eye]\nstereo = "anaglyph"\n' + usual):
            self.config.write_text(plain.replace("script = [", "script = [{ at_s = 0.5, button = 0 }, "))
            left = self.run_program("table", "--config", self.config, "--headless")
            self.assertIn("Staff: measure the whole table", left.stderr)


if __name__ == "__main__":
    unittest.main()
