"""Compares the tracker's pose, through USB, filter, renderer and display, with the same pose rendered offline."""

import math

from hil_test import HilTest

ARTIFACT = "amphora"
POSES = (
    (0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0),
    (0.12, 0.05, 0.0, 1.0, 0.0, 0.0, 0.0),
    (-0.15, -0.08, 0.0, math.cos(math.pi / 8), 0.0, 0.0, math.sin(math.pi / 8)),
    (0.10, -0.10, 0.0, math.cos(-math.pi / 6), 0.0, 0.0, math.sin(-math.pi / 6)),
)


class Pose(HilTest):
    def test_picture_is_where_render_draws_it(self):
        self.bench.rendered(POSES, ARTIFACT)  # all at once
        self.show(ARTIFACT)
        for pose in POSES:
            with self.subTest(pose=pose):
                self.bench.place(pose[:3], pose[3:])
                self.assert_at(pose[:3], pose[3:], ARTIFACT)
