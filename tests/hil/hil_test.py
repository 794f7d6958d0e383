"""What every test in the emulated machine begins and ends with."""

import unittest

from bench import CONNECTOR, UNIT, Bench

CENTRE_M = (0.0, 0.0, 0.0)
START_S = 60.0  # until the exhibit shows its first pictures: their shaders are compiled on a slow processor


class HilTest(unittest.TestCase):
    """All tests share one machine; each begins with every device well, the first artifact, the prop at the centre."""

    bench: Bench

    def setUp(self):
        bench = self.bench
        bench.tracker.tell("good")
        bench.buttons.tell("plug")
        for pin in range(3):
            bench.buttons.tell("release", pin)
        bench.place(CENTRE_M)
        bench.place_head()
        bench.machine.run(f"rm -rf /run/hil; echo detect > {CONNECTOR}")
        if bench.machine.run(f"systemctl is-active {UNIT}").output.strip() != "active":
            bench.machine.check(f"systemctl reset-failed {UNIT}; systemctl start --no-block {UNIT}")
        bench.status_says("tracker", "is running", START_S)
        bench.status_says("panel", "buttons are there")
        bench.status_says("display", "is lit")

    def show(self, artifact):
        """Presses `next` if another of the two artifacts is shown."""
        if self.bench.status()["artifact"] != artifact:
            self.bench.buttons.tell("press", 1, "300ms")
            self.bench.status_says("artifact", artifact)
