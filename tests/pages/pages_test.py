"""Tests that documented_commands_test.py finds the commands, and reports a wrong one with page and line.

    pages_test.py SOURCE BUILD
"""

import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import accepted
from checks import Checks
from commands import commands_of, examples_of

BUILD, SOURCE = (pathlib.Path(sys.argv.pop()).resolve() for _ in range(2))

PAGE = """# A page

```
program one  # a comment
FOO=1 sudo program two \\
    --three "#4" && other >file
```
```text
not a command
```
- in a list: `./test hil`, `run --out`, `--seed`, and `a name`
  ```
  $ indented [--option A | --other] [FILE]
  ```
A span over two lines: `frustumscreen
status --json`.
"""


def texts(commands):
    return [(command.line, command.text) for command in commands]


class Extraction(unittest.TestCase):
    def setUp(self):
        self.commands = commands_of("page.md", PAGE, ("run",))

    def test_each_command_has_its_line(self):
        self.assertEqual(texts(self.commands), [
            (4, "program one"), (5, 'FOO=1 sudo program two --three "#4" && other >file'), (13, "indented [--option A | --other] [FILE]"),
            (11, "./test hil"), (11, "run --out"), (11, "--seed"), (15, "frustumscreen status --json")])

    def test_splits_a_line_into_simple_commands(self):
        self.assertEqual(self.commands[1].simple_commands(), [["program", "two", "--three", "#4"], ["other"]])

    def test_bracketed_words_are_checked_but_not_required(self):
        self.assertEqual(self.commands[2].simple_commands(), [["indented", "--option", "A", "--other", "FILE"]])
        self.assertEqual(self.commands[2].required, "indented")

    def test_finds_the_examples_of_a_help(self):
        self.assertEqual(texts(examples_of("x --help", "usage: x\n\nexamples:\n  x --a\n  x --b\n\nmore:\n  y\n")), [(4, "x --a"), (5, "x --b")])


class Teeth(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.checks = Checks(SOURCE, BUILD, ["cp"], ())

    def wrong(self, line):
        """(place, objections) for a page with this line after a correct one."""
        page = f"```\nfrustumscreen states --dot\n{line}\n```\n"
        return [(command.place, wrong) for command in commands_of("docs/page.md", page) for wrong in self.checks.objections(command)]

    def test_rejects_unknown_options_and_programs(self):
        for line, said in (("frustumscreen run --confg kiosk.toml", "frustumscreen has no option --confg here"),
                           ("frustumscreen rnu", "frustumscreen has no subcommand 'rnu'"),
                           ("frustumscreen-bake --batch DIR --preview x.html", "frustumscreen-bake has no option --preview here"),
                           ("frustumscreen render --view eye", "frustumscreen takes for --view one of projector, visitor, room, not 'eye'"),
                           ("./test image --cut", "test has no option --cut here"),
                           ("./tset", "there is no program ./tset"),
                           ("cmake/build.sh release no_such_test", "there is no target no_such_test"),
                           ("ctest --test-dir build/release -R '^no_such_test$'", "ctest finds no test so")):
            self.assertEqual(self.wrong(line), [("docs/page.md:3", said)])

    def test_keeps_the_log_of_ctest(self):
        log = BUILD / "Testing/Temporary/LastTest.log"
        before = log.stat() if log.exists() else None
        self.assertEqual(self.wrong("ctest --test-dir build/release -C long -R one_definition"), [])
        after = log.stat() if log.exists() else None
        self.assertEqual(before and before.st_ino, after and after.st_ino)

    def test_rejects_an_unknown_option_in_a_sentence(self):
        command, = commands_of("page.md", "\nwith `--no-such-option`")
        self.assertEqual((command.place, self.checks.objections(command)), ("page.md:2", ["no program has an option --no-such-option"]))

    def test_accepts_valid_commands(self):
        for line in ("frustumscreen-bake --up -z FILE", "frustumscreen run --config FILE --seconds 8", "cd x && ./test hil --only pose"):
            self.assertEqual(self.wrong(line), [])

    def test_decides_which_commands_may_run(self):
        for line, may in (("frustumscreen states && cp a b", True), ("sudo frustumscreen states", False), ("rm -r /", False), ("./run", False)):
            command, = commands_of("page.md", f"```\n{line}\n```\n")
            self.assertEqual(self.checks.may_run(command), may, line)

    def test_build_script_knows_every_preset(self):
        presets = json.loads((SOURCE / "CMakePresets.json").read_text(encoding="utf-8"))["buildPresets"]
        for preset in presets:
            ran = subprocess.run([SOURCE / "cmake/build.sh", preset["name"], "--without", "nothing"], capture_output=True, text=True, check=False)
            self.assertIn("there is no part 'nothing'", ran.stderr, preset["name"])

    def test_detects_incomplete_commands(self):
        program = BUILD / "bin/frustumscreen"
        self.assertFalse(accepted.is_complete(program, ["run", "--headless"]))
        self.assertTrue(accepted.is_complete(program, ["run", "--config", "FILE"]))


class Zone(unittest.TestCase):
    """The zones in the pages' text equal those that follow from the settings."""

    def lit_zone(self, settings):
        ran = subprocess.run([BUILD / "bin/frustumscreen", "config", "--config", SOURCE / "config" / settings, "--json"],
                             capture_output=True, text=True, check=True)
        return json.loads(ran.stdout)["lit_zone"]

    def size_cm(self, settings):
        return " x ".join(f"{200 * half:.0f}" for half in self.lit_zone(settings)["whole"]["all_eyes"]["rectangle_half_m"]) + " cm"

    def test_wide_zone_is_as_wide_as_documented(self):
        whole = self.lit_zone("wide.toml")["whole"]
        for half, min_m in zip(whole["all_eyes"]["rectangle_half_m"], (0.5, 0.25)):
            self.assertGreaterEqual(2 * half, min_m)
        self.assertGreaterEqual(whole["artifact_m"][2], 0.12)
        shipped, wide = self.size_cm("kiosk.toml"), self.size_cm("wide.toml")
        for name, promised in (("docs/guide/build.md", f"| {shipped} | {wide} |"), ("docs/designers.md", f"the first is {wide} "),
                               ("docs/measurements.md", f"| 1.55 | 97 x 60 | {wide[:-3]} |"),
                               ("config/wide.toml", f"{wide}, in place of {shipped[:-3]},")):
            self.assertIn(promised, (SOURCE / name).read_text(encoding="utf-8"), name)

    def test_amphora_is_whole_in_the_wide_zone(self):
        lines = ["t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok"]
        for step in range(1200):
            x, y = (step % 5 - 2) * 0.125, (step // 5 % 5 - 2) * 0.0625  # up to the edges of 50 x 25 cm
            half_yaw, azimuth, elevation = 0.7 * step, 2.4 * step, math.radians(15 + 60 * (step % 4) / 3)
            away = 0.35 + 0.5 * (step % 3)
            eye = (x + away * math.cos(elevation) * math.cos(azimuth), y + away * math.cos(elevation) * math.sin(azimuth),
                   away * math.sin(elevation))
            for station, numbers in ((1, (x, y, 0, math.cos(half_yaw), 0, 0, math.sin(half_yaw))), (2, (*eye, 1, 0, 0, 0))):
                lines.append(",".join([f"{100000 * step}", f"{station}", *(f"{number:.6f}" for number in numbers), "1"]))
        with tempfile.TemporaryDirectory() as folder:
            poses = pathlib.Path(folder) / "poses.csv"
            poses.write_text("\n".join(lines) + "\n", encoding="utf-8")
            losing = {}
            for settings in ("wide.toml", "kiosk.toml"):
                ran = subprocess.run([BUILD / "bin/frustumscreen", "guide", "--config", SOURCE / "config" / settings, "--pack",
                                      BUILD / "kiosk/built_in.fspack", "--poses", poses, "--json"], capture_output=True, text=True, check=True)
                told = [json.loads(line) for line in ran.stdout.splitlines()]
                self.assertEqual(len(told), 1200)
                losing[settings] = [line for line in told if not line["whole"]]
        self.assertEqual(losing["wide.toml"], [])
        self.assertGreater(len(losing["kiosk.toml"]), 20)

    def test_documented_zone_equals_the_computed_one(self):
        lit = self.lit_zone("kiosk.toml")
        page = (SOURCE / "docs/designers.md").read_text(encoding="utf-8")
        rows = (("for all eyes", lit["whole"]["all_eyes"]), ("for eyes as high as", lit["whole"]["eyes_like_default"]),
                ("so that every face", lit["any_eye"]))
        for begins, zone in rows:
            promised = re.search(rf"^\| {begins}.*\| ([\d.]+) x ([\d.]+) cm \|$", page, re.MULTILINE)
            self.assertIsNotNone(promised, begins)
            for said, half in zip(promised.groups(), zone["rectangle_half_m"]):
                digits = len(said.partition(".")[2])
                self.assertEqual(said, f"{200 * half:.{digits}f}", begins)


class Version(unittest.TestCase):
    def test_changelog_and_every_program_have_the_same(self):
        newest = re.search(r"^## (\d+\.\d+\.\d+), \d{4}-\d\d-\d\d$", (SOURCE / "CHANGELOG.md").read_text(encoding="utf-8"), re.MULTILINE)
        self.assertIsNotNone(newest, "CHANGELOG.md has no release")
        programs = sorted(path for path in (BUILD / "bin").glob("frustumscreen*") if path.name != "frustumscreen-safe-words")
        self.assertGreater(len(programs), 9)
        for program in programs:
            printed = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
            self.assertEqual(printed, f"{program.name} {newest.group(1)}\n")


if __name__ == "__main__":
    unittest.main()
