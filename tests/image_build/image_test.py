"""Set-up and tear-down of every test of the image."""

import os
import pathlib
import shutil
import tempfile
import time
import unittest

from appliance import Appliance, tracker
from bench import Patience

IMAGE = pathlib.Path(os.environ["FRUSTUMSCREEN_IMAGE"])  # frustumscreen.raw of a test's image
LOGS = pathlib.Path(os.environ["FRUSTUMSCREEN_IMAGE_LOGS"])


def long(test):
    """Marks a test, or a class of tests, that runs only with `./test image --all`."""
    return unittest.skipUnless(os.environ.get("FRUSTUMSCREEN_IMAGE_ALL"), "long: ./test image --all")(test)


class ImageTest(unittest.TestCase):
    """Each test has a PC with a disk that has never been started."""

    def setUp(self):
        name = self.id().rsplit(".", 1)[-1]
        self.sockets = pathlib.Path(tempfile.mkdtemp(prefix="image-"))
        self.addCleanup(shutil.rmtree, self.sockets)
        (LOGS / name).mkdir(parents=True, exist_ok=True)
        self.tracker = tracker(self.sockets, LOGS / name)
        self.addCleanup(self.tracker.stop)
        self.pc = Appliance(IMAGE, LOGS / name, self.sockets, {"tracker": self.tracker.usb})
        self.addCleanup((LOGS / name / "disk.raw").unlink)

    def start(self):
        self.pc.start()
        self.addCleanup(self.pc.stop)
        Patience.clock = self.pc.granted_s
        self.addCleanup(setattr, Patience, "clock", time.monotonic)
        self.pc.wait_until_lit()
        self.say_lit()

    def say_lit(self):
        """Prints, for the tables in docs/, the guest's seconds since power on and the number of starts since then."""
        print(f"\n{self.id().rsplit('.', 1)[-1]}: lit {self.pc.granted_s():.0f} s after power on, {self.pc.firmware_starts()} starts; "
              f"{self.pc.notes()}", flush=True)

    def switch_off(self):
        """Switches the PC off as if it were unplugged, without a command."""
        Patience.clock = time.monotonic
        self.pc.stop()
