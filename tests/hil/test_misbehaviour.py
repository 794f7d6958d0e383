"""The tracker misbehaves: the picture does not freeze, shows no pose that was not sent, and the state is told.

The prop goes to and fro on a straight line through the table's centre all the while, so that every pose that was sent
lies on a line, and whatever else is shown, lights pixels beside the band that the artifact sweeps. Where the poses stop, the
exhibit fades to an artifact that turns at the table's centre: inside the band too.
"""

import functools
import math
import operator

import screen
from bench import EYE_M, UPRIGHT
from hil_test import HilTest
from watch import watch

ARTIFACT = "amphora"
REACH_M = 0.12
STROKE_S = 3.0
PLAYED_HZ = 240
STEPS = 14
OVERSHOOT_M = 0.02  # of the prediction, where the prop turns back
TURNS = 24
BESIDE_PX = 6  # what is rendered is a sample of what may be shown
BESIDE_SHARE = 0.01  # of the lit pixels
LEAST_FREEZE_S = 0.25
FREEZE_FRAMES = 3
RESTING_S = 1.0  # where no poses come, the picture rests: a new code each second
BUSY_HOST_TRIES = 3  # a freeze of ours is there every time; one of a busy host's is not,
BUSY_HOST_FACTOR = 1.5  # or is there when nothing misbehaves, too
FAULT_S = 4.0
UNDISTURBED_S = 8.0

RUNNING = "is running"
# what the tracker does, what the status says of it (nothing: it does not matter), and whether poses still come
FAULTS = {
    "drop": (("drop 0.3",), RUNNING, True),
    "corrupt": (("corrupt 0.2",), RUNNING, True),
    "duplicate": (("duplicate 0.5",), RUNNING, True),
    "reorder": (("reorder 0.3",), RUNNING, True),
    "distortion": (("distortion 200",), "metal", True),
    "stall": (("stall",), "stopped sending", False),
    "hang": (("hang",), "", False),
    "nan": (("nan",), "can be used", False),
    "wrong_units": (("wrong-units",), "metric units", False),
    "nak": (("nak", "unplug 1s"), "refuses its set-up", False),
    "slow_boot": (("slow-boot",), "booting", False),
    "sensor_missing": (("sensor-missing 1",), "sensor is missing", False),
}


def position(share):
    """Along the line, 0 to 1."""
    return ((2.0 * share - 1.0) * REACH_M, 0.0, 0.0)


def write_strokes(path):
    """To and fro at constant speed, as a pose file; the mock plays its rows as they are."""
    rows = ["t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok"]
    samples = round(2 * STROKE_S * PLAYED_HZ)
    for number in range(samples):
        t_us = round(1e6 * number / PLAYED_HZ)
        phase = 2.0 * number / samples
        x, y, z = position(phase if phase < 1.0 else 2.0 - phase)
        rows.append(f"{t_us},1,{x:.5f},{y},{z},1,0,0,0,1")
        rows.append(f"{t_us},2,{EYE_M[0]},{EYE_M[1]},{EYE_M[2]},1,0,0,0,1")
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(rows) + "\n")


class Misbehaviour(HilTest):
    band = None  # the pixels that the artifact lights while the prop goes along the line, and where it turns
    usual_gap_s = None  # between two pictures, at most, while nothing misbehaves

    def setUp(self):
        super().setUp()
        self.show(ARTIFACT)
        if Misbehaviour.band is None:
            reach_m = REACH_M + OVERSHOOT_M
            poses = [((2.0 * k / STEPS - 1.0) * reach_m, 0.0, 0.0, *UPRIGHT) for k in range(STEPS + 1)]
            poses += [(0.0, 0.0, 0.0, math.cos(0.5 * angle), 0.0, 0.0, math.sin(0.5 * angle))
                      for angle in (2.0 * math.pi * k / TURNS for k in range(TURNS))]
            pictures = self.bench.rendered(poses, ARTIFACT)
            swept = [functools.reduce(operator.or_, rows) for rows in zip(*map(screen.lit, pictures))]
            Misbehaviour.band = screen.grown(swept, BESIDE_PX, pictures[0].width)
        strokes = self.bench.out / "strokes.csv"
        write_strokes(strokes)
        self.bench.tracker.tell("play", strokes)
        if Misbehaviour.usual_gap_s is None:
            watch(self.bench, 1.0)  # the estimator takes up the prop
            Misbehaviour.usual_gap_s = watch(self.bench, UNDISTURBED_S).longest_gap_s

    def misbehave(self, name):
        commands, says, poses_come = FAULTS[name]
        for command in commands:
            self.bench.tracker.tell(command)
        self.bench.status_says("tracker", says)
        self.look(poses_come)
        self.bench.tracker.tell("good")
        self.bench.status_says("tracker", RUNNING)
        self.look(True)

    def look(self, poses_come):
        for number in range(BUSY_HOST_TRIES):
            seen = watch(self.bench, FAULT_S)
            for look in seen.looks:
                if screen.share_outside(look.lit, self.band) > BESIDE_SHARE:
                    folder = self.bench.evidence_of(self)
                    folder.mkdir(exist_ok=True)
                    screen.write_png(folder / "not_sent.png", look.picture)
                    self.fail(f"a pose is shown that was not sent: {folder / 'not_sent.png'}")
            median_s = self.bench.status()["frame_ms"]["p50"] * 1e-3
            limit_s = max(LEAST_FREEZE_S, FREEZE_FRAMES * median_s, BUSY_HOST_FACTOR * self.usual_gap_s)
            limit_s += 0.0 if poses_come else RESTING_S
            if seen.longest_gap_s <= limit_s:
                return
            print(f"  the picture stood for {seen.longest_gap_s:.2f} s, try {number + 1}", flush=True)
        self.fail(f"the picture froze for {seen.longest_gap_s:.2f} s; {limit_s:.2f} s are allowed")


def _test(name):
    return lambda self: self.misbehave(name)


for _name in FAULTS:
    setattr(Misbehaviour, f"test_{_name}", _test(_name))
