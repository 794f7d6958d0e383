"""Tests the watch itself: it notices a picture that freezes, moving and at rest, also on a busy machine."""

from hil_test import HilTest, long
from test_misbehaviour import write_strokes
from watch import froze, watch

ARTIFACT = "amphora"
MOVING_MS, RESTING_MS = 1000, 2500
LOOK_S = 4.0


@long
class Freezes(HilTest):
    def setUp(self):
        super().setUp()
        self.show(ARTIFACT)

    def assert_noticed(self, ms, rests):
        self.watch(LOOK_S, rests)
        self.hang("gl", ms)
        self.assertTrue(froze(watch(self.bench, LOOK_S), rests), f"nobody noticed that the picture froze for {ms} ms")

    def test_noticed_while_it_moves(self):
        strokes = self.bench.out / "strokes.csv"
        write_strokes(strokes)
        self.bench.tracker.tell("play", strokes)
        for _ in range(3):
            self.assert_noticed(MOVING_MS, rests=False)

    def test_noticed_at_rest(self):
        self.bench.picture_of((0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0))
        for _ in range(3):
            self.assert_noticed(RESTING_MS, rests=True)
