"""Tests that a cold start leads to a lit picture."""

import screen
from bench import eventually
from hil_test import HilTest


class Boot(HilTest):
    def test_boot_lights_the_picture(self):
        picture = eventually(lambda: self.lit_picture(), 60.0, "the screen stays dark")
        share = screen.count(screen.lit(picture)) / (picture.width * picture.height)
        self.assertGreater(share, 0.005, "of the picture is lit")
        self.assertLess(share, 0.5)
        self.assertIsNotNone(screen.probe(picture), "the picture has no reserved code: not ours, or not right way up")

    def lit_picture(self):
        picture = self.bench.screendump()
        return picture if screen.count(screen.lit(picture)) > 0.005 * picture.width * picture.height else None
