"""The image as it is shipped, from power on to the living exhibit: no agent, no other settings, no tracker, no buttons."""

import pathlib
import shutil
import tempfile
import time
import unittest

from image_test import IMAGE, LOGS, long
from shipped import PROCESSOR, Patience, Shipped

AS_SHIPPED = IMAGE.parent / "as_shipped" / IMAGE.name


class AsShipped(unittest.TestCase):
    def assert_lives_on(self, width, height, processor=PROCESSOR):
        name = f"shipped_{width}x{height}" + ("" if processor == PROCESSOR else "_avx2")
        sockets = pathlib.Path(tempfile.mkdtemp(prefix="image-"))
        self.addCleanup(shutil.rmtree, sockets)
        (LOGS / name).mkdir(parents=True, exist_ok=True)
        pc = Shipped(AS_SHIPPED, LOGS / name, sockets, width, height, processor)
        self.addCleanup((LOGS / name / "disk.raw").unlink)
        pc.start()
        self.addCleanup(pc.stop)
        self.addCleanup(setattr, Patience, "clock", time.monotonic)
        seen = pc.lives_within()
        print(f"\n{width} x {height}: {len(seen.codes)} pictures seen within {pc.granted_s():.0f} s of power on", flush=True)
        self.assertIsNone(seen.safe, f"the safe picture came: {LOGS / name}/safe.png")
        self.assertGreaterEqual(len(seen.lit), 2, f"no picture that changes came; {len(seen.codes)} codes, logs in {LOGS / name}")
        self.assertEqual((seen.picture.width, seen.picture.height), (width, height), "the screen is not driven at what it prefers")
        self.assertEqual(pc.firmware_starts(), 1, "it started more than once")

    def test_at_the_pictures_own_size(self):
        self.assert_lives_on(1920, 1200)

    @long
    def test_driver_that_crashes(self):
        """QEMU 7.2 emulates AVX2's gather wrongly, and llvmpipe ends with SIGSEGV at each start; the watchdog finds the way around."""
        self.assert_lives_on(1920, 1200, "max")

    @long
    def test_smaller(self):
        self.assert_lives_on(1280, 800)

    @long
    def test_of_another_shape(self):
        self.assert_lives_on(1920, 1080)

    @long
    def test_larger(self):
        self.assert_lives_on(3840, 2160)


