"""The base of tests of the image's scripts that need both a stick's request and a button of the staff, on artificial folders."""

import os
import pathlib
import subprocess
import tempfile
import time

SCRIPTS = pathlib.Path(__file__).resolve().parent.parent.parent / "image_build/files/usr/lib/frustumscreen"


class PressedScript:
    """A mix-in, named before unittest.TestCase. `name`: that of the script, and of the files that button and stick leave."""
    name = ""

    @property
    def asked(self):
        return self.top / f"run/frustumscreen-import/{self.name}-asked"

    @property
    def pressed(self):
        return self.top / f"run/frustumscreen/{self.name}"

    def setUp(self):
        self.top = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.top / "bin").mkdir()
        self.write({self.asked: "", self.pressed: ""})

    def write(self, files):
        for path, text in files.items():
            (self.top / path).parent.mkdir(parents=True, exist_ok=True)
            (self.top / path).write_text(text, encoding="ascii")

    def write_program(self, name, text):
        (self.top / "bin" / name).write_text(f"#!/bin/sh\n{text}\n", encoding="ascii")
        (self.top / "bin" / name).chmod(0o755)

    def run_script(self, **environment):
        """Runs the script; returns the lines that the programs of `bin` write to the file $SAID."""
        said = self.top / "said"
        said.unlink(missing_ok=True)
        subprocess.run([SCRIPTS / self.name], check=True, stdout=subprocess.DEVNULL,
                       env={**os.environ, "PATH": f"{self.top}/bin:{os.environ['PATH']}", "SAID": str(said),
                            **{name: str(value) for name, value in environment.items()}})
        self.assertFalse(self.pressed.exists(), "the unit would start again and again")
        return said.read_text(encoding="ascii").splitlines() if said.exists() else []

    def assert_nothing_done(self):
        """Runs the script."""
        raise NotImplementedError

    def test_ignores_a_button_without_a_waiting_stick(self):
        self.asked.unlink()
        self.assert_nothing_done()

    def test_ignores_a_button_long_after_the_stick(self):
        old = time.time() - 16 * 60
        os.utime(self.asked, (old, old))
        self.assert_nothing_done()
