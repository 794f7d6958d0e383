"""The tracker's pose, through USB, filter, renderer and display, against the same pose rendered offline."""

import math

import screen
from hil_test import HilTest

ARTIFACT = "amphora"
POSES = (
    (0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0),
    (0.12, 0.05, 0.0, 1.0, 0.0, 0.0, 0.0),
    (-0.15, -0.08, 0.0, math.cos(math.pi / 8), 0.0, 0.0, math.sin(math.pi / 8)),
    (0.10, -0.10, 0.0, math.cos(-math.pi / 6), 0.0, 0.0, math.sin(-math.pi / 6)),
)
PIXELS = 2.0


class Pose(HilTest):
    def test_picture_is_where_render_draws_it(self):
        truths = self.bench.rendered(POSES, ARTIFACT)
        self.show(ARTIFACT)
        for pose, truth in zip(POSES, truths):
            with self.subTest(pose=pose):
                self.bench.place(pose[:3], pose[3:])
                self.compare(self.bench.steady_picture(), truth)

    def compare(self, picture, truth):
        self.assertEqual((picture.width, picture.height), (truth.width, truth.height))
        seen, meant = screen.lit(picture), screen.lit(truth)
        self.assertGreater(screen.count(meant), 300, "the offline picture is dark: this pose proves nothing")
        for k, (a, b) in enumerate(zip(screen.centroid(seen, picture.width), screen.centroid(meant, truth.width))):
            self.assertAlmostEqual(a, b, delta=PIXELS, msg=f"centroid, {'xy'[k]}")
        for k, (a, b) in enumerate(zip(screen.box(seen, picture.width), screen.box(meant, truth.width))):
            self.assertAlmostEqual(a, b, delta=PIXELS, msg=("left", "top", "right", "bottom")[k])
        reach = math.ceil(PIXELS)
        self.assertLess(screen.share_outside(seen, screen.grown(meant, reach, truth.width)), 0.002)
        self.assertLess(screen.share_outside(meant, screen.grown(seen, reach, truth.width)), 0.002)
