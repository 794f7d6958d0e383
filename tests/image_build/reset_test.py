#!/usr/bin/python3
"""Back to the state of delivery, without a machine: the image's own script on made-up folders, and a service manager that only writes down
what it is asked for.

reset_test.py [unittest's arguments]
"""

import os
import pathlib
import subprocess
import tempfile
import time
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parent.parent.parent / "image_build/files/usr/lib/frustumscreen/reset"
KEPT = {"var/lib/systemd/random-seed": "x", "usr/share/frustumscreen/kiosk.toml": "shipped", "etc/machine-id": "1a2b3c"}
OWN = {"var/lib/frustumscreen/library/set.txt": "x", "var/lib/frustumscreen/library/packs/a.fspack": "x", "var/lib/frustumscreen/library/shown/verdict.json": "x",
       "var/lib/frustumscreen/calibration/calibration-0008.toml": "x", "var/lib/frustumscreen/counts/2026-11-27.json": "x",
       "var/lib/frustumscreen/counts/.hidden": "x", "var/lib/frustumscreen-watchdog/faults": "x", "var/cache/frustumscreen/crashes/1": "x",
       "etc/frustumscreen/kiosk.toml.before": "x", "etc/frustumscreen/kiosk.toml.serial": "9", "etc/frustumscreen/kiosk.toml.proved": "x"}
SETTINGS = "etc/frustumscreen/kiosk.toml"
ASKED = "run/frustumscreen-import/reset-asked"
PRESSED = "run/frustumscreen/reset"


class Reset(unittest.TestCase):
    def setUp(self):
        self.top = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        for name, text in {**KEPT, **OWN, SETTINGS: "own", ASKED: "", PRESSED: "", "bin/systemctl": '#!/bin/sh\necho "$*" >>"$ASKED"\n'}.items():
            (self.top / name).parent.mkdir(parents=True, exist_ok=True)
            (self.top / name).write_text(text, encoding="ascii")
        (self.top / "bin/systemctl").chmod(0o755)

    def reset(self):
        """The requests to the service manager."""
        asked = self.top / "asked"
        subprocess.run([SCRIPT], check=True, timeout=30, stdout=subprocess.DEVNULL,
                       env={**os.environ, "PATH": f"{self.top}/bin:{os.environ['PATH']}", "ASKED": str(asked), "RESET_RUN": str(self.top / "run"),
                            "RESET_TOP": str(self.top)})
        self.assertFalse((self.top / PRESSED).exists(), "the unit would start again and again")
        return asked.read_text(encoding="ascii").splitlines() if asked.exists() else []

    def there(self, names):
        return {name for name in names if (self.top / name).exists()}

    def test_both(self):
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
        self.assertFalse((self.top / ASKED).exists())

    def assert_nothing_done(self):
        self.assertEqual(self.reset(), [])
        self.assertEqual(self.there(OWN), set(OWN))
        self.assertEqual((self.top / SETTINGS).read_text(encoding="ascii"), "own")

    def test_a_button_without_a_stick(self):
        (self.top / ASKED).unlink()
        self.assert_nothing_done()

    def test_a_button_long_after_the_stick(self):
        old = time.time() - 16 * 60
        os.utime(self.top / ASKED, (old, old))
        self.assert_nothing_done()

    def test_interrupted_the_key_guards_the_kiosk(self):
        (self.top / "bin/cp").write_text("#!/bin/sh\nexit 1\n", encoding="ascii")
        (self.top / "bin/cp").chmod(0o755)
        with self.assertRaises(subprocess.CalledProcessError):
            self.reset()
        self.assertEqual((self.top / SETTINGS).read_text(encoding="ascii"), "own")
        (self.top / "bin/cp").unlink()
        (self.top / ASKED).touch()
        (self.top / PRESSED).touch()
        self.reset()
        self.assertEqual((self.top / SETTINGS).read_text(encoding="ascii"), "shipped")


if __name__ == "__main__":
    unittest.main()
