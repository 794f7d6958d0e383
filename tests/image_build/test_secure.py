"""Secure Boot: a firmware that starts nothing but what Debian's test key has signed."""

import time

from appliance import Appliance
from test_build import build, keys_in
from image_test import IMAGE, ImageTest, long


class Secure(ImageTest):
    @long
    def test_signed_image_starts(self):
        done = build("--keys", keys_in(self.sockets), "--out", self.sockets)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.pc = Appliance(self.sockets / "test" / IMAGE.name, self.pc.logs, self.sockets, self.pc.usb, secure=True)
        self.start()
        self.assertIn("Secure boot enabled", self.pc.check("dmesg"))

    @long
    def test_unsigned_image_does_not_start(self):
        self.pc = Appliance(IMAGE, self.pc.logs, self.sockets, self.pc.usb, secure=True)
        process = self.pc.power_on()
        self.addCleanup(self.pc.stop)
        log = self.pc.logs / "serial.log"
        deadline = time.monotonic() + 120.0
        while "Access Denied" not in log.read_text(errors="replace") and time.monotonic() < deadline:
            self.assertIsNone(process.poll())
            time.sleep(1.0)
        self.assertIn("Access Denied", log.read_text(errors="replace"))
        self.assertNotIn("Linux", log.read_text(errors="replace"))
