#!/usr/bin/python3
"""Tests the return to the state of delivery without a machine: the image's own script runs on artificial folders, with a stub of the
service manager that only records requests.

reset_test.py [unittest's arguments]
"""

import os
import subprocess
import unittest

from pressed_script import PressedScript

KEPT = {"var/lib/systemd/random-seed": "x", "usr/share/frustumscreen/kiosk.toml": "shipped", "etc/machine-id": "1a2b3c"}
OWN = {"var/lib/frustumscreen/library/set.txt": "x", "var/lib/frustumscreen/library/packs/a.fspack": "x", "var/lib/frustumscreen/library/shown/verdict.json": "x",
       "var/lib/frustumscreen/calibration/calibration-0008.toml": "x", "var/lib/frustumscreen/counts/2026-11-27.json": "x",
       "var/lib/frustumscreen/counts/.hidden": "x", "var/lib/frustumscreen-watchdog/faults": "x", "var/cache/frustumscreen/crashes/1": "x",
       "etc/frustumscreen/kiosk.toml.before": "x", "etc/frustumscreen/kiosk.toml.serial": "9", "etc/frustumscreen/kiosk.toml.proved": "x"}
SETTINGS = "etc/frustumscreen/kiosk.toml"


class Reset(PressedScript, unittest.TestCase):
    name = "reset"

    def setUp(self):
        super().setUp()
        self.write({**KEPT, **OWN, SETTINGS: "own"})
        self.write_program("systemctl", 'echo "$*" >>"$SAID"')

    def reset(self):
        """Runs the script; returns its requests to the service manager."""
        return self.run_script(RESET_RUN=self.top / "run", RESET_TOP=self.top)

    def there(self, names):
        return {name for name in names if (self.top / name).exists()}

    def test_acts_after_mark_and_button(self):
        asked = self.reset()
        self.assertEqual([line.split()[0] for line in asked], ["stop", "--no-block"])
        self.assertEqual(asked[-1], "--no-block reboot")
        for unit in ("frustumscreen-watchdog.service", "frustumscreen.service"):
            self.assertIn(unit, asked[0])
        self.assertEqual(self.there(OWN), set())
        self.assertEqual(self.there(KEPT), set(KEPT))
        self.assertEqual((self.top / SETTINGS).read_text(encoding="ascii"), "shipped")
        self.assertEqual(os.listdir(self.top / "etc/frustumscreen"), ["kiosk.toml"])
        self.assertEqual(os.listdir(self.top / "var/lib/frustumscreen"), [])
        self.assertFalse(self.asked.exists())

    def assert_nothing_done(self):
        self.assertEqual(self.reset(), [])
        self.assertEqual(self.there(OWN), set(OWN))
        self.assertEqual((self.top / SETTINGS).read_text(encoding="ascii"), "own")

    def test_an_interrupted_reset_can_be_repeated(self):
        self.write_program("cp", "exit 1")
        with self.assertRaises(subprocess.CalledProcessError):
            self.reset()
        self.assertEqual((self.top / SETTINGS).read_text(encoding="ascii"), "own")
        (self.top / "bin/cp").unlink()
        self.write({self.asked: "", self.pressed: ""})
        self.reset()
        self.assertEqual((self.top / SETTINGS).read_text(encoding="ascii"), "shipped")


if __name__ == "__main__":
    unittest.main()
