"""Set-up and tear-down of every test in the emulated machine."""

import math
import unittest

import screen
import watch
from bench import CONNECTOR, UNIT, UPRIGHT, USUAL, Bench

CENTRE_M = (0.0, 0.0, 0.0)
BUTTONS = 5
PIXELS = 2.0  # largest distance between the shown picture and the one rendered offline
LIT = r"is lit, \d+ x \d+ at "  # the display's state; no sentence about a dark projector has this
START_S = 60.0  # until the exhibit shows its first pictures: their shaders are compiled on a slow processor


def long(test):
    """A test, or a class of tests, that `./test hil` leaves out without --all."""
    test.is_long = True
    return test


def is_long(test):
    return getattr(test, "is_long", False) or getattr(getattr(test, test._testMethodName, None), "is_long", False)


class HilTest(unittest.TestCase):
    """All tests share one machine. Each test begins with all devices working, the first artifact, and the prop at the centre. The
    exhibit is restarted if a class has other settings than the class before it."""

    bench: Bench
    settings = USUAL  # the whole file
    unsigned = False  # whether its machine must take a kernel module without a signature
    before = after = "true"  # commands for the machine while the exhibit is stopped: before it gets these settings, after it had them
    broken_s = broken_uptime_s = None
    longest_s = 0.0  # the longest time that a picture stood in any test while it should move

    @classmethod
    def setUpClass(cls):
        cls.bench.configure(cls.settings, cls.before, cls.after)

    def setUp(self):
        bench = self.bench
        bench.tracker.tell("good")
        bench.buttons.tell("plug")
        for pin in range(BUTTONS):
            bench.buttons.tell("release", pin)
        bench.place(CENTRE_M)
        bench.place_head()
        bench.machine.run(f"rm -rf /run/hil; mkdir -m 777 /run/hil; echo detect > {CONNECTOR}")
        if not bench.status() and bench.machine.run(f"systemctl is-active {UNIT}").output.strip() != "active":
            bench.machine.check(f"systemctl reset-failed {UNIT}; systemctl start --no-block {UNIT}")
        bench.status_says("tracker", "is running", START_S, fresh=True)
        bench.status_says("panel", "buttons are there")
        bench.status_says("display", LIT)

    def broken(self):
        """Starts the measurement of the time until the screen is lit again."""
        self.broken_s, self.broken_uptime_s = self.bench.machine.granted_s(), self.bench.uptime_s()

    def tell_lit(self):
        """Prints the time until the screen was lit again, and, by the guest's own clock, the times until and of the exhibit's start."""
        if self.broken_s is None:
            return
        dark_s = self.bench.machine.granted_s() - self.broken_s
        began, ready = (1e-6 * int(self.bench.machine.check(f"systemctl show --value -p {name} {UNIT}"))
                        for name in ("ExecMainStartTimestampMonotonic", "ActiveEnterTimestampMonotonic"))
        restart = ""
        if began > self.broken_uptime_s:
            restart = (f"; by the guest's clock it was started again after {began - self.broken_uptime_s:.1f} s, "
                       f"and its start took {ready - began:.1f} s")
        print(f"  lit {dark_s:.1f} s after the fault{restart}", flush=True)

    def show(self, artifact):
        """Presses `next` if another of the two artifacts is shown."""
        if self.bench.status()["artifact"] != artifact:
            self.bench.buttons.tell("press", 1, "300ms")
            self.bench.status_says("artifact", artifact)

    def hang(self, what, ms=""):
        """Makes guest_hang.cpp delay the next call of this name: for `ms`, or for ever."""
        self.bench.machine.check(f"echo {ms} > /run/hil/new; mv /run/hil/new /run/hil/hang-{what}")

    def watch(self, seconds, rests=False):
        """Watches the screen for `seconds`; no picture may stand too long."""
        seen = watch.watch(self.bench, seconds)
        if not rests:
            HilTest.longest_s = max(HilTest.longest_s, seen.stood().granted_s)
        why = watch.froze(seen, rests)
        self.assertFalse(why, why)
        return seen

    def assert_at(self, place_m, rotation=UPRIGHT, artifact=None):
        """Compares the place of the exhibit's picture for this pose with that of `render`."""
        pose = (*place_m, *rotation)
        picture = self.bench.picture_of(pose)
        artifact = artifact or self.bench.status()["artifact"]
        self.assert_same_place(picture, self.bench.rendered([pose], artifact)[0])

    def assert_same_place(self, picture, truth):
        """The lit areas of both agree within PIXELS: centroid, box and outline."""
        self.assertEqual((picture.width, picture.height), (truth.width, truth.height))
        seen, meant = screen.lit(picture), screen.lit(truth)
        self.assertGreater(screen.count(meant), 300, "the offline picture is dark: this pose proves nothing")
        self.assertGreater(screen.count(seen), 0, "the picture that is shown is dark")
        for k, (a, b) in enumerate(zip(screen.centroid(seen, picture.width), screen.centroid(meant, truth.width))):
            self.assertAlmostEqual(a, b, delta=PIXELS, msg=f"centroid, {'xy'[k]}")
        for k, (a, b) in enumerate(zip(screen.box(seen, picture.width), screen.box(meant, truth.width))):
            self.assertAlmostEqual(a, b, delta=PIXELS, msg=("left", "top", "right", "bottom")[k])
        reach = math.ceil(PIXELS)
        self.assertLess(screen.share_outside(seen, screen.grown(meant, reach, truth.width)), 0.002)
        self.assertLess(screen.share_outside(meant, screen.grown(seen, reach, truth.width)), 0.002)
