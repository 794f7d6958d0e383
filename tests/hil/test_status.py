"""Tests the staff's access to a kiosk: its picture over the local socket, only for the staff's group."""

import base64
import pathlib
import tempfile

import screen
from hil_test import CENTRE_M, HilTest, UPRIGHT

PROGRAM = "frustumscreen status"
STAFF = "hil-staff"
USERS = f"u {STAFF} -\\nm {STAFF} frustumscreen-staff\\nu hil-visitor -\\n"


class Status(HilTest):
    def setUp(self):
        super().setUp()
        self.bench.machine.check(f"printf '{USERS}' | systemd-sysusers -; install -d -m 777 /run/hil/pictures")

    def run_as(self, user, options):
        return self.bench.machine.run(f"setpriv --reuid={user} --regid={user} --init-groups {PROGRAM} {options}")

    def test_screenshot_for_the_staff(self):
        """The screenshot equals the picture on the screen, to the pixel, except for the code in its corner."""
        on_screen = self.bench.resting_picture_of((*CENTRE_M, *UPRIGHT))
        complaint = self.run_as(STAFF, "--screenshot /run/hil/pictures/now.png >/dev/null").output
        self.assertEqual(complaint, "")
        encoded = self.bench.machine.check("base64 -w 0 /run/hil/pictures/now.png")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "now.png"
            path.write_bytes(base64.b64decode(encoded))
            taken = screen.read_png(path)
        self.assertEqual((taken.width, taken.height), (on_screen.width, on_screen.height))
        others = [(x, y) for y in range(taken.height) for x in range(taken.width)
                  if (y > 0 or x >= screen.PROBE_PIXELS) and taken.pixel(x, y) != on_screen.pixel(x, y)]
        self.assertEqual(others, [], "pixels differ")

    def test_screenshot_is_refused_to_others(self):
        ran = self.run_as("hil-visitor", "--screenshot /run/hil/pictures/stolen.png >/dev/null")
        self.assertEqual(ran.status, 1)
        self.assertIn("only root and the staff's group may ask", ran.output)
        self.assertEqual(len(ran.output.splitlines()), 1, ran.output)
        self.assertNotEqual(self.bench.machine.run("test -e /run/hil/pictures/stolen.png").status, 0)

    def test_visitors_can_read_the_status(self):
        """A user without access to the picture can still read the status."""
        said = self.run_as("hil-visitor", "").output
        self.assertIn(self.bench.status()["artifact"], said)
        self.assertIn("tracker", said)
