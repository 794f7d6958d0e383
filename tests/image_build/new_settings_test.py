#!/usr/bin/python3
"""Tests how a kiosk handles settings that the importer has taken, without a machine: its own script runs with a stub of the service manager
that only records requests.

new_settings_test.py [unittest's arguments]
"""

import json
import os
import pathlib
import subprocess
import tempfile
import time
import unittest

SCRIPTS = pathlib.Path(__file__).resolve().parent.parent.parent / "image_build/files/usr/lib/frustumscreen"
# `restart` fails as often as the file $FAILS has lines.
SYSTEMCTL = """#!/bin/sh
echo "$*" >>"$ASKED"
[ "$*" = "restart frustumscreen.service" ] && [ -s "$FAILS" ] || exit 0
sed -i 1d "$FAILS"
exit 1
"""
RESTART = "restart frustumscreen.service"
PROVE = "restart --no-block frustumscreen-settings-proved.service"
SLEEP = "#!/bin/sh\necho >>\"$SLEPT\"\n"
LIT = '{"lit": true, "trouble": null, "mode": "normal"}\n'


class NewSettings(unittest.TestCase):
    def setUp(self):
        self.top = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        for folder in ("bin", "settings", "run/frustumscreen-import", "run/frustumscreen-watchdog", "run/frustumscreen-update"):
            (self.top / folder).mkdir(parents=True)
        for name, text in {"settings/kiosk.toml": "new", "settings/kiosk.toml.before": "before", "run/frustumscreen-import/settings-taken": "",
                           "run/frustumscreen-watchdog/mode": "normal\n", "memory": "x", "fails": "", "asked": "", "slept": "",
                           "bin/systemctl": SYSTEMCTL, "bin/sleep": SLEEP, "bin/sync": "#!/bin/sh\n"}.items():
            self.write(name, text)
        for program in (self.top / "bin").iterdir():
            program.chmod(0o755)

    def write(self, name, text):
        (self.top / name).write_text(text, encoding="ascii")

    def read(self, name):
        return (self.top / name).read_text(encoding="ascii")

    def start(self):
        """The requests to the service manager."""
        subprocess.run([SCRIPTS / "new-settings"], check=True, env=self.environment())
        self.assertFalse((self.top / "run/frustumscreen-import/settings-taken").exists())
        return self.read("asked").splitlines()

    def environment(self, seconds="2"):
        return {**os.environ, "PATH": f"{self.top}/bin:{os.environ['PATH']}", "ASKED": str(self.top / "asked"), "FAILS": str(self.top / "fails"), "SLEPT": str(self.top / "slept"),
                "SETTINGS_FOLDER": str(self.top / "settings"), "SETTINGS_RUN": str(self.top / "run"), "SETTINGS_MEMORY": str(self.top / "memory"),
                "SETTINGS_SECONDS": seconds, "WATCHDOG_STATUS": str(self.top / "watchdog.json")}

    def prove(self, seconds="2"):
        proving = subprocess.Popen([SCRIPTS / "prove-settings"], env=self.environment(seconds))
        self.addCleanup(proving.kill)
        return proving

    def assert_waits(self, proving):
        """It has read the settings, and goes on waiting for the exhibit after the seconds that this must be lit."""
        while proving.poll() is None and len(self.read("slept")) <= 2:
            time.sleep(0.01)
        self.assertIsNone(proving.poll())
        self.assertEqual(self.read("settings/kiosk.toml.proved.new"), "new")

    def test_keeps_good_settings(self):
        self.assertEqual(self.start(), [RESTART, PROVE])
        self.assertEqual((self.read("settings/kiosk.toml"), self.read("memory")), ("new", "x"))
        self.assertFalse((self.top / "run/frustumscreen-import/report.json").exists(), "what the importer told is overwritten")

    def test_restores_settings_when_the_exhibit_does_not_start(self):
        self.write("fails", "1\n")
        self.assertEqual(self.start(), [RESTART, RESTART])
        self.assertEqual(self.read("settings/kiosk.toml"), "before")
        report = json.loads(self.read("run/frustumscreen-import/report.json"))
        self.assertEqual([(pack["file"], pack["outcome"], pack["refusal"]) for pack in report["packs"]], [("kiosk.toml", "refused", "not_a_pack")])

    def test_resets_the_watchdog_after_a_fault(self):
        self.write("run/frustumscreen-watchdog/mode", "safe\n")
        self.assertEqual([line.split()[0] for line in self.start()], ["stop", "start", "restart", "restart"])
        self.assertFalse((self.top / "memory").exists())

    def test_leaves_the_restart_to_an_update(self):
        self.write("run/frustumscreen-update/installed-stick1", "")
        self.assertEqual(self.start(), [])

    def test_settings_are_proved_once_the_exhibit_was_lit_with_them(self):
        proving = self.prove()
        self.assert_waits(proving)
        self.assertFalse((self.top / "settings/kiosk.toml.proved").exists())
        self.write("watchdog.json", LIT)
        self.assertEqual(proving.wait(), 0)
        self.assertEqual(self.read("settings/kiosk.toml.proved"), "new")
        self.assertEqual(self.prove(seconds="1000").wait(), 0, "what is proved is not proved again")

    def test_settings_that_change_meanwhile_are_not_proved(self):
        proving = self.prove()
        self.assert_waits(proving)
        self.write("settings/kiosk.toml", "others")
        self.write("watchdog.json", LIT)
        self.assertEqual(proving.wait(), 0)
        self.assertEqual(sorted(path.name for path in (self.top / "settings").iterdir()), ["kiosk.toml", "kiosk.toml.before"])


if __name__ == "__main__":
    unittest.main()
