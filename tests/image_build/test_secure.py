"""Tests Secure Boot: a firmware that starts only programs signed with Debian's test key."""

from appliance import Appliance, eventually
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

        def said():
            self.assertIsNone(process.poll())
            return log.exists() and "Access Denied" in log.read_text(errors="replace")

        eventually(said, 120.0, "the firmware does not say that it refuses the disk")
        self.assertNotIn("EFI stub", log.read_text(errors="replace"))
