"""Tests faults of the tracker: the picture does not freeze, no pose is shown that was not sent, and the fault is reported.

The prop moves to and fro on a straight line through the table's centre. So every picture must be one of those that `render` draws along
this line, or, while no poses come, the artifact that turns at the table's centre.
"""

import bisect
import functools
import math
import operator

import screen
from bench import EYE_M, UPRIGHT, eventually
from hil_test import HilTest, long

ARTIFACT = "amphora"
REACH_M = 0.12
STROKE_S = 3.0
PLAYED_HZ = 240
OVERSHOOT_M = 0.02  # of the predicted place when the prop turns back
STEP_M = 0.002  # between two pictures along the line: 1.6 pixels
TURNS = 24
BESIDE_PX = 2  # largest distance between the shown picture and the nearest allowed one
FOLLOWING_PX = 10  # between two pictures of a prop that is followed, at least; it moves by more in a fifth of a second
BESIDE_SHARE = 0.01  # the share of the lit pixels that may be further away
FAULT_S = 4.0
AFTER_S = 2.0
CALM_S = 1.5

RUNNING = "is running"
# name: (commands to the tracker, the status's words about it, whether poses still come)
FAULTS = {
    "noise": (("drop 0.2", "corrupt 0.15", "duplicate 0.3", "reorder 0.2"), RUNNING, True),
    "drop": (("drop 0.3",), RUNNING, True),
    "corrupt": (("corrupt 0.2",), RUNNING, True),
    "duplicate": (("duplicate 0.5",), RUNNING, True),
    "reorder": (("reorder 0.3",), RUNNING, True),
    "distortion": (("distortion 200",), "metal", True),
    "warn": (("warn", "unplug 1s"), "warned while it was set up", True),
    "nak_questions": (("nak-questions", "unplug 1s"), "does not say how it is set", True),
    "filter_stays": (("filter-stays", "unplug 1s"), "own filter cannot be switched off", True),
    "built_in_test": (("built-in-test",), "a fault of its own", True),
    "stall": (("stall",), "stopped sending", False),
    "hang": (("hang",), "stopped sending|refuses its set-up", False),
    "nan": (("nan",), "can be used", False),
    "wrong_units": (("wrong-units",), "metric units", False),
    "nak": (("nak", "unplug 1s"), "refuses its set-up", False),
    "slow_boot": (("slow-boot",), "booting", False),
    "sensor_missing": (("sensor-missing 1",), "sensor is missing", False),
}
# "noise" combines the first four. The tests of the drivers cover all of these faults, too.
LONG = ("drop", "corrupt", "duplicate", "reorder", "warn", "nak_questions", "filter_stays", "wrong_units", "distortion", "nak",
        "sensor_missing", "built_in_test", "slow_boot", "stall")


def write_strokes(path):
    """Writes a pose file that goes to and fro at constant speed; the mock plays its rows as they are."""
    rows = ["t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok"]
    samples = round(2 * STROKE_S * PLAYED_HZ)
    for number in range(samples):
        t_us = round(1e6 * number / PLAYED_HZ)
        phase = 2.0 * number / samples
        x = (2.0 * min(phase, 2.0 - phase) - 1.0) * REACH_M
        rows.append(f"{t_us},1,{x:.5f},0,0,1,0,0,0,1")
        rows.append(f"{t_us},2,{EYE_M[0]},{EYE_M[1]},{EYE_M[2]},1,0,0,0,1")
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(rows) + "\n")


def united(outlines):
    return [functools.reduce(operator.or_, rows) for rows in zip(*outlines)]


class Allowed:
    """The allowed pictures: the artifact along the line, and turning at the centre."""

    def __init__(self, bench):
        steps = round((REACH_M + OVERSHOOT_M) / STEP_M)
        line = bench.rendered([(k * STEP_M, 0.0, 0.0, *UPRIGHT) for k in range(-steps, steps + 1)], ARTIFACT)
        turns = bench.rendered([(0.0, 0.0, 0.0, math.cos(0.5 * angle), 0.0, 0.0, math.sin(0.5 * angle))
                                for angle in (2.0 * math.pi * k / TURNS for k in range(TURNS))], ARTIFACT)
        self._width = line[0].width
        self._line = sorted(((screen.centroid(rows, self._width)[0], rows, self._grown(rows))
                             for rows in map(screen.lit, line)), key=lambda placed: placed[0])
        self._turning = self._grown(united(map(screen.lit, turns)))
        self._anywhere = self._grown(united([self._turning, *(rows for _, rows, _ in self._line)]))

    def _grown(self, rows):
        return screen.grown(rows, BESIDE_PX, self._width)

    def _inside(self, rows, allowed):
        return screen.count(rows) > 0 and screen.share_outside(rows, allowed) <= BESIDE_SHARE

    def sent(self, rows):
        """True if the picture is that of a place on the line."""
        if not any(rows):
            return False
        x = screen.centroid(rows, self._width)[0]
        at = bisect.bisect(self._line, x, key=lambda placed: placed[0])
        return any(self._inside(rows, grown) and self._inside(outline, self._grown(rows))
                   for _, outline, grown in self._line[max(0, at - 1) : at + 1])

    def turning(self, rows):
        return self._inside(rows, self._turning)

    def fading(self, rows):
        """True if the picture is of one of the two kinds, or a darker version of one."""
        return screen.share_outside(rows, self._anywhere) <= BESIDE_SHARE


class Misbehaviour(HilTest):
    allowed = None

    def setUp(self):
        super().setUp()
        self.show(ARTIFACT)
        if Misbehaviour.allowed is None:
            Misbehaviour.allowed = Allowed(self.bench)
        strokes = self.bench.out / "strokes.csv"
        write_strokes(strokes)
        self.bench.tracker.tell("play", strokes)
        self.settle_following("the prop is not followed")

    def misbehave(self, name):
        commands, says, poses_come = FAULTS[name]
        for command in commands:
            self.bench.tracker.tell(command)
        self.bench.status_says("tracker", says)
        if poses_come:
            self.settle_following("the prop is not followed")
            self.look(FAULT_S, self.allowed.sent)
        else:
            self.look(FAULT_S, self.allowed.fading, rests=True)
            self.settle(self.allowed.turning, "without poses the artifact does not turn at the table's centre")
            self.look(CALM_S, self.allowed.turning)
        self.bench.tracker.tell("good")
        if "unplug 1s" in commands:  # a message about its set-up stays until it is plugged in again
            self.bench.tracker.tell("unplug", "1s")
        self.bench.status_says("tracker", RUNNING)
        self.settle_following("the prop is not followed again")
        self.look(AFTER_S, self.allowed.sent)

    def settle(self, is_right, otherwise):
        eventually(lambda: is_right(screen.lit(self.bench.screendump())), 10.0, otherwise)

    def settle_following(self, otherwise):
        """Waits for pictures of two places on the line, with no other picture between them. One is not enough, because the artifact that
        turns at the centre looks like the prop there."""
        places = []

        def is_following():
            picture = self.bench.screendump()
            rows = screen.lit(picture)
            if not self.allowed.sent(rows):
                places.clear()
                return False
            places.append(screen.centroid(rows, picture.width)[0])
            return max(places) - min(places) > FOLLOWING_PX

        eventually(is_following, 10.0, otherwise)

    def look(self, seconds, is_right, rests=False):
        """Watches for `seconds`: no picture may freeze, and each must be allowed."""
        for picture in self.watch(seconds, rests).pictures:
            if not is_right(screen.lit(picture)):
                folder = self.bench.evidence_of(self)
                folder.mkdir(exist_ok=True)
                screen.write_png(folder / "not_sent.png", picture)
                self.fail(f"a pose is shown that was not sent: {folder / 'not_sent.png'}")


def _test(name):
    return lambda self: self.misbehave(name)


for _name in FAULTS:
    setattr(Misbehaviour, f"test_{_name}", long(_test(_name)) if _name in LONG else _test(_name))
