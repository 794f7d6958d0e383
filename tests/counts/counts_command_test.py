#!/usr/bin/python3
"""Tests `frustumscreen counts` on folders that an exhibit could have left, and on damaged ones. The sums are computed again from the files.

counts_command_test.py PROGRAM [unittest's arguments]
"""

import csv
import datetime
import json
import random
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

PROGRAM = ""


def tally(visits, ms):
    return {"visits": visits, "ms": ms}


def day_file(day, hours, artifacts):
    """`artifacts`: name -> (visits, ms); the ms add up to those of the hours."""
    ms = sum(each[1] for each in hours.values())
    return {"frustumscreen_counts": 1, "day": day,
            "hours": [{"hour": hour} | tally(*each) for hour, each in hours.items()],
            "artifacts": [{"name": name} | tally(*each) for name, each in artifacts.items()],
            "languages": [{"name": "en"} | tally(1, ms)]}


class Counts(unittest.TestCase):
    def setUp(self):
        self.out = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.folder = self.out / "counts"
        self.folder.mkdir()

    def write(self, name, content):
        text = content if isinstance(content, str) else json.dumps(content)
        (self.folder / name).write_text(text, encoding="utf-8")

    def run_counts(self, *options):
        return subprocess.run([PROGRAM, "counts", "--folder", self.folder, *options], capture_output=True, check=False,
                              encoding="utf-8")

    def a_year(self):
        """Writes counts from seeds; returns the sums."""
        drawn = random.Random(3)
        visits = 0
        minutes = {"Amphora": 0.0, "Cup, \"nautilus\"": 0.0}
        for k in range(365):
            day = str(datetime.date(2026, 1, 1) + datetime.timedelta(days=k))
            hours = {hour: (drawn.randrange(9), drawn.randrange(1, 3_000_000)) for hour in range(9, 18)}
            first = drawn.randrange(1000)
            names = list(minutes)
            all_ms = sum(each[1] for each in hours.values())
            self.write(f"{day}.json", day_file(day, hours, {names[0]: (1, first), names[1]: (2, all_ms - first)}))
            visits += sum(each[0] for each in hours.values())
            minutes[names[0]] += first / 60000
            minutes[names[1]] += (all_ms - first) / 60000
        return visits, minutes

    def test_prints_the_table_and_draws_a_year(self):
        visits, minutes = self.a_year()
        done = self.run_counts("--csv", self.out / "counts.csv", "--plot", self.out / "counts.svg")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertTrue(done.stdout.startswith("2026-01-01 to 2026-12-31, 365 days with numbers\n"), done.stdout)
        self.assertIn(f"{visits:,} visits".replace(",", " "), done.stdout)
        with open(self.out / "counts.csv", encoding="utf-8", newline="") as stream:
            rows = list(csv.DictReader(stream))
        self.assertEqual(sum(int(row["visits"]) for row in rows if row["kind"] == "hour"), visits)
        for name, expected in minutes.items():
            found = sum(float(row["minutes"]) for row in rows if row["kind"] == "artifact" and row["name"] == name)
            self.assertAlmostEqual(found, expected, delta=365 * 0.005)  # each row is rounded to hundredths
        picture = xml.etree.ElementTree.parse(self.out / "counts.svg").getroot()
        view = [float(number) for number in picture.get("viewBox").split()]
        boxes = picture.findall(".//{http://www.w3.org/2000/svg}rect")
        self.assertGreater(len(boxes), 365 * 10)
        for box in boxes:
            left, top, wide, high = (float(box.get(key, 0)) for key in ("x", "y", "width", "height"))
            self.assertTrue(0 <= left and left + wide <= view[2] and 0 <= top and top + high <= view[3], box.attrib)

    def test_selects_a_range_of_days(self):
        self.a_year()
        done = self.run_counts("--from", "2026-03-01", "--to", "2026-03-07", "--json")
        self.assertEqual([each["day"] for each in json.loads(done.stdout)["days"]], [f"2026-03-0{k}" for k in range(1, 8)])
        done = self.run_counts("--from", "2026-02-30")
        self.assertEqual(done.returncode, 1)
        self.assertIn("this is not a day; write it as 2026-11-27 [counts.day]", done.stderr)

    def test_reports_and_keeps_damaged_files(self):
        self.write("2026-11-26.json", day_file("2026-11-26", {10: (3, 60000)}, {"Amphora": (3, 60000)}))
        self.write("2026-11-27.json", day_file("2026-11-27", {10: (3, 60000)}, {"Amphora": (3, 60001)}))
        self.write("2026-11-28.json", "\x00\x1b[2J")
        done = self.run_counts()
        self.assertEqual(done.returncode, 1)
        self.assertEqual(len(done.stderr.splitlines()), 2, done.stderr)
        self.assertIn("2026-11-27.json: the times of hours, artifacts and languages have different sums", done.stderr)
        self.assertIn("3 visits, 1 minutes", done.stdout)
        self.assertEqual(len(list(self.folder.iterdir())), 3)

    def test_reports_a_folder_without_counts(self):
        self.assertEqual(self.run_counts().stdout, "No visits have been counted yet.\n")
        self.folder.rmdir()
        done = self.run_counts()
        self.assertEqual(done.returncode, 1)
        self.assertEqual(len(done.stderr.splitlines()), 1)
        self.assertIn("no counts can be read there", done.stderr)

    def test_rejects_wrong_options(self):
        done = self.run_counts("--no-such-option")
        self.assertEqual((done.returncode, done.stdout), (2, ""))


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
