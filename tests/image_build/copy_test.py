#!/usr/bin/python3
"""A copy onto a stick that waits, without a machine: the image's own script on made-up folders, and a service manager that knows one stick
and writes down what it is asked for.

copy_test.py [unittest's arguments]
"""

import json
import os
import pathlib
import subprocess
import tempfile
import time
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parent.parent.parent / "image_build/files/usr/lib/frustumscreen/copy"
ASKED = "run/frustumscreen-import/copy-asked"
PRESSED = "run/frustumscreen/copy"
REPORT = "run/frustumscreen-import/report.json"
STICK = "stick7p1"
# Active are the units that are named in the file.
SYSTEMCTL = """#!/bin/sh
echo "$*" >>"$SAID"
[ "$1" = is-active ] || exit 0
for unit in "$@"; do if grep -qx -e "$unit" "$ACTIVE"; then exit 0; fi; done
exit 3
"""
DEVICE = f"dev-frustumscreen-{STICK}.device"
IMPORT = f"frustumscreen-import@{STICK}.service"


class Copy(unittest.TestCase):
    def setUp(self):
        self.top = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        for name, text in {ASKED: STICK, PRESSED: "", REPORT: "", "mounts": "", "active": f"{DEVICE}\n", "bin/systemctl": SYSTEMCTL,
                           "bin/sleep": "#!/bin/sh\n"}.items():
            (self.top / name).parent.mkdir(parents=True, exist_ok=True)
            (self.top / name).write_text(text, encoding="ascii")
        (self.top / "run/frustumscreen-report").mkdir()
        for program in ("systemctl", "sleep"):
            (self.top / "bin" / program).chmod(0o755)

    def copy(self):
        """The orders to the service manager."""
        said = self.top / "said"
        said.unlink(missing_ok=True)
        subprocess.run([SCRIPT], check=True, timeout=30, stdout=subprocess.DEVNULL,
                       env={**os.environ, "PATH": f"{self.top}/bin:{os.environ['PATH']}", "SAID": str(said), "ACTIVE": str(self.top / "active"),
                            "COPY_RUN": str(self.top / "run"), "COPY_MOUNTS": str(self.top / "mounts")})
        self.assertFalse((self.top / PRESSED).exists(), "the unit would start again and again")
        lines = said.read_text(encoding="ascii").splitlines() if said.exists() else []
        return [line for line in lines if not line.startswith("is-active")]

    def confirmed(self):
        return sorted(path.name for path in (self.top / "run/frustumscreen-report").iterdir())

    def assert_nothing_done(self):
        self.assertEqual(self.copy(), [])
        self.assertEqual(self.confirmed(), [])
        self.assertEqual((self.top / REPORT).read_text(encoding="ascii"), "")

    def test_both(self):
        self.assertEqual(self.copy(), [f"start --no-block frustumscreen-stick@{STICK}.service"])
        self.assertEqual(self.confirmed(), [f"{STICK}.confirm"])
        self.assertEqual((self.top / REPORT).read_text(encoding="ascii"), "", "the writer and the importer tell")

    def test_a_button_without_a_stick_that_waits(self):
        (self.top / ASKED).unlink()
        self.assert_nothing_done()

    def test_a_button_long_after_the_stick(self):
        old = time.time() - 16 * 60
        os.utime(self.top / ASKED, (old, old))
        self.assert_nothing_done()

    def test_a_mark_that_names_no_stick(self):
        for text in ("", "../stick7", "stick7 stick8", "stick7\nstick8", "-.mount", "STICK7", "stick7@"):
            with self.subTest(text):
                (self.top / ASKED).write_text(text, encoding="ascii")
                (self.top / PRESSED).touch()
                self.assert_nothing_done()

    def test_the_first_look_at_the_stick_ends_before(self):
        (self.top / "mounts").write_text(f"/dev/sda1 {self.top}/run/frustumscreen-stick/{STICK} vfat ro 0 0\n", encoding="ascii")
        (self.top / "bin/sleep").write_text(f"#!/bin/sh\n: >{self.top}/mounts\necho sleep >>\"$SAID\"\n", encoding="ascii")
        self.assertEqual(self.copy(), ["sleep", f"start --no-block frustumscreen-stick@{STICK}.service"])

    def test_one_that_does_not_end_is_not_waited_for_for_ever(self):
        (self.top / "active").write_text(f"{DEVICE}\n{IMPORT}\n", encoding="ascii")
        self.assertEqual(self.copy(), [f"start --no-block frustumscreen-stick@{STICK}.service"])

    def test_a_stick_that_was_pulled_out_is_told(self):
        (self.top / "active").write_text("", encoding="ascii")
        self.assertEqual(self.copy(), [])
        self.assertEqual(self.confirmed(), [])
        report = json.loads((self.top / REPORT).read_text(encoding="ascii"))
        self.assertEqual((report["import_id"], report["stage"]), (f"{STICK}.staff", "done"))
        line, = report["packs"]
        self.assertEqual((line["file"], line["outcome"], line["refusal"]), ("frustumscreen-request.toml", "not_written", "unreadable"))
        self.assertNotIn("?", line["reason"])


if __name__ == "__main__":
    unittest.main()
