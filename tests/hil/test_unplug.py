"""Tests that tracker, panel and projector can be unplugged and plugged in: the picture goes on, the status says so, all works again."""


import screen
from bench import CONNECTOR, eventually
from hil_test import HilTest, LIT

ARTIFACT = "amphora"
BACK_S = 15.0  # a device must be back within 2 s; the kernel's own enumeration is slow here


class Unplug(HilTest):
    def setUp(self):
        super().setUp()
        self.process = self.bench.main_process()

    def tearDown(self):
        self.assertEqual(self.bench.main_process(), self.process, "the exhibit was restarted")

    def test_tracker_unplugged_and_back(self):
        self.show(ARTIFACT)
        for number in range(2):
            x = 0.1 if number == 0 else -0.1
            self.bench.tracker.tell("unplug")
            self.bench.status_says("tracker", "no tracker is connected")
            self.watch(3.0, rests=True)
            self.bench.place((x, 0.0, 0.0))
            self.bench.tracker.tell("unplug", "off")
            plugged_s = self.bench.machine.granted_s()
            self.bench.status_says("tracker", "is running", BACK_S)
            print(f"  runs {self.bench.machine.granted_s() - plugged_s:.1f} s after it was plugged in", flush=True)
            self.assert_at((x, 0.0, 0.0), artifact=ARTIFACT)

    def test_panel_unplugged_and_back(self):
        self.show(ARTIFACT)
        self.bench.buttons.tell("unplug")
        self.bench.status_says("panel", "it is not there")
        self.watch(3.0, rests=True)
        self.bench.buttons.tell("plug")
        self.bench.status_says("panel", "buttons are there", BACK_S)
        before = self.bench.status()["artifact"]
        self.bench.buttons.tell("press", 1, "300ms")
        eventually(lambda: self.bench.status()["artifact"] != before, 10.0, "its buttons do nothing")

    def test_display_connector_unplugged_and_back(self):
        for _ in range(2):
            self.bench.machine.check(f"echo off > {CONNECTOR}")
            self.bench.status_says("display", "no projector is connected", BACK_S)
            self.bench.machine.let_run(1.0)
            self.bench.machine.check(f"echo detect > {CONNECTOR}")
            self.bench.status_says("display", LIT, BACK_S)
            eventually(self.is_lit, BACK_S, "the projector is back, but dark")
            self.watch(4.0, rests=True)

    def is_lit(self):
        picture = self.bench.screendump()
        return screen.probe(picture) is not None and screen.count(screen.lit(picture)) > 300
