"""What every test in the emulated machine begins and ends with."""

import unittest

from bench import UNIT, Bench, eventually

CENTRE_M = (0.0, 0.0, 0.0)


class HilTest(unittest.TestCase):
    """All tests share one machine; each begins with every device well, the first artifact, the prop at the centre."""

    bench: Bench
    failures = frozenset()  # of kinds that unittest counts

    def setUp(self):
        bench = self.bench
        bench.tracker.tell("good")
        bench.buttons.tell("good")
        bench.place(CENTRE_M)
        bench.place_head()
        bench.machine.run("rm -rf /run/hil-hang; echo detect > /sys/class/drm/card0-Virtual-1/status")
        if bench.machine.run(f"systemctl is-active {UNIT}").output.strip() != "active":
            bench.machine.check(f"systemctl reset-failed {UNIT}; systemctl start {UNIT}")
        bench.status_says("tracker", "is running", 30.0)
        bench.status_says("panel", "", 30.0)

    def show(self, artifact):
        """Presses `next` until this artifact is shown."""
        for _ in range(3):
            if self.bench.status_says("artifact", "")["artifact"] == artifact:
                return
            self.bench.buttons.tell("press", 1, "300ms")
            eventually(lambda: True, 1.0, "")

    def picture_changes(self, before, timeout_s, what):
        eventually(lambda: self.bench.probe() not in (None, before), timeout_s, what)
