"""Tests the artifacts' pictures on the table: the prop is slid onto the other artifact's picture, at its place on the screen, and rests
there."""

import screen
from bench import HEIGHT, UPRIGHT, USUAL, WIDTH, eventually
from hil_test import CENTRE_M, HilTest

METRES_PER_PIXEL = 0.8 / WIDTH  # the picture covers the table
TITLE_SHARE = 0.25  # of the height of a picture and its title
CHOSEN_S = 50.0


class Table(HilTest):
    settings = USUAL.replace("table_pictures = false", "table_pictures = true")

    def outline(self, artifact, pose):
        return screen.lit(self.bench.rendered([pose], artifact)[0])

    def picture_beside(self, outline):
        """The middle of the lit area beside the artifact, metres on the table; None: nothing is lit there."""
        shot = self.bench.screendump()
        around = screen.grown(outline, 8, shot.width)
        beside = [row & ~near for row, near in zip(screen.lit(shot), around)]
        if screen.count(beside) < 100:
            return None
        left, top, right, bottom = screen.box(beside, shot.width)
        u, v = 0.5 * (left + right), top + 0.5 * (1.0 - TITLE_SHARE) * (bottom - top)
        return ((u - 0.5 * WIDTH) * METRES_PER_PIXEL, (0.5 * HEIGHT - v) * METRES_PER_PIXEL, 0.0)

    def test_resting_on_a_picture_chooses_it(self):
        self.show("amphora")
        pose = (*CENTRE_M, *UPRIGHT)
        amphora = self.outline("amphora", pose)
        self.bench.picture_of(pose)
        there = eventually(lambda: self.picture_beside(amphora), 20.0, "no picture lies on the table")
        self.bench.place(there)
        self.bench.status_says("artifact", "nautilus-cup", CHOSEN_S)  # no button is pressed
        self.bench.place(CENTRE_M)
        nautilus = self.outline("nautilus-cup", pose)

        def shown():
            shot = self.bench.screendump()
            return screen.share_outside(nautilus, screen.grown(screen.lit(shot), 2, shot.width)) < 0.01

        eventually(shown, 20.0, "the screen does not show the artifact that was chosen")
        other = self.picture_beside(nautilus)
        self.assertIsNotNone(other, "the artifact before does not lie on the table")
