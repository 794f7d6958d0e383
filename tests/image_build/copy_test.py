#!/usr/bin/python3
"""Tests a copy onto a waiting stick without a machine: the image's own script runs on artificial folders, with a stub of the service
manager that knows one stick and records its requests.

copy_test.py [unittest's arguments]
"""

import json
import unittest

from pressed_script import PressedScript

REPORT = "run/frustumscreen-import/report.json"
STICK = "stick7p1"
# The units that $ACTIVE names are active. It starts no other program, because the script asks it sixty times.
SYSTEMCTL = """echo "$*" >>"$SAID"
[ "$1" = is-active ] || exit 0
for unit in "$@"; do case " $ACTIVE " in *" $unit "*) exit 0 ;; esac; done
exit 3"""
DEVICE = f"dev-frustumscreen-{STICK}.device"
IMPORT = f"frustumscreen-import@{STICK}.service"


class Copy(PressedScript, unittest.TestCase):
    name = "copy"

    def setUp(self):
        super().setUp()
        self.write({self.asked: STICK, REPORT: "", "mounts": ""})
        self.active = DEVICE
        (self.top / "run/frustumscreen-report").mkdir()
        self.write_program("systemctl", SYSTEMCTL)
        self.write_program("sleep", "")

    def copy(self):
        """Runs the script; returns its requests to the service manager."""
        lines = self.run_script(ACTIVE=self.active, COPY_RUN=self.top / "run", COPY_MOUNTS=self.top / "mounts")
        return [line for line in lines if not line.startswith("is-active")]

    def confirmed(self):
        return sorted(path.name for path in (self.top / "run/frustumscreen-report").iterdir())

    def assert_nothing_done(self):
        self.assertEqual(self.copy(), [])
        self.assertEqual(self.confirmed(), [])
        self.assertEqual((self.top / REPORT).read_text(encoding="ascii"), "")

    def test_acts_after_mark_and_button(self):
        self.assertEqual(self.copy(), [f"start --no-block frustumscreen-stick@{STICK}.service"])
        self.assertEqual(self.confirmed(), [f"{STICK}.confirm"])
        self.assertEqual((self.top / REPORT).read_text(encoding="ascii"), "", "the writer and the importer tell")

    def test_ignores_a_mark_without_a_valid_stick(self):
        for text in ("", "../stick7", "stick7 stick8", "stick7\nstick8", "-.mount", "STICK7", "stick7@"):
            with self.subTest(text):
                self.write({self.asked: text, self.pressed: ""})
                self.assert_nothing_done()

    def test_waits_until_the_stick_is_unmounted(self):
        self.write({"mounts": f"/dev/sda1 {self.top}/run/frustumscreen-stick/{STICK} vfat ro 0 0\n"})
        self.write_program("sleep", f": >{self.top}/mounts\necho sleep >>\"$SAID\"")
        self.assertEqual(self.copy(), ["sleep", f"start --no-block frustumscreen-stick@{STICK}.service"])

    def test_stops_waiting_for_an_import_that_does_not_end(self):
        self.active = f"{DEVICE} {IMPORT}"
        self.assertEqual(self.copy(), [f"start --no-block frustumscreen-stick@{STICK}.service"])

    def test_reports_a_stick_that_was_pulled_out(self):
        self.active = ""
        self.assertEqual(self.copy(), [])
        self.assertEqual(self.confirmed(), [])
        report = json.loads((self.top / REPORT).read_text(encoding="ascii"))
        self.assertEqual((report["import_id"], report["stage"]), (f"{STICK}.staff", "done"))
        line, = report["packs"]
        self.assertEqual((line["file"], line["outcome"], line["refusal"]), ("frustumscreen-request.toml", "not_written", "unreadable"))
        self.assertNotIn("?", line["reason"])


if __name__ == "__main__":
    unittest.main()
