"""Tests storms: devices that are plugged in and out faster than by hand, floods of frames and noise, false descriptors, contacts that
bounce without end. The exhibit must stay the same process, its picture must go on, and all must work afterwards."""

import time

from bench import UPRIGHT, eventually
from hil_test import HilTest, long

ARTIFACT = "amphora"
PLACE_M = (0.1, -0.05, 0.0)
REPLUGS, REPLUG_S = 100, 0.1
STORM_S = 10.0
# name: (the tracker's fault, the status's sentence during it, if it is always the same)
STORMS = {
    "replugged_100_times": ("replug 10", None),
    "8_khz": ("rate 8000", None),
    "64_kib_at_once": ("burst 64", None),
    "false_preambles": ("false-preambles", "is running"),
    "no_endpoints": ("no-endpoints", "cannot be opened|no tracker"),
    "absurd_endpoints": ("absurd-endpoints", None),
    "absurd_lengths": ("absurd-lengths", None),
    "wrong_configuration": ("wrong-configuration", None),
    "late_poses": ("rate 2", "its poses come late, or at another rate"),
}
DESCRIPTORS = ("no-endpoints", "absurd-endpoints", "absurd-lengths", "wrong-configuration")  # read when it is plugged in
CHATTER_S = 30.0  # by then the chatter must be noticed
BACK_S = 30.0


@long
class Storms(HilTest):
    def setUp(self):
        super().setUp()
        self.show(ARTIFACT)
        self.process = self.bench.main_process()

    def tearDown(self):
        self.assertEqual(self.bench.main_process(), self.process, "the exhibit was restarted")

    def assert_well(self):
        self.bench.status_says("tracker", "is running", BACK_S)
        self.bench.place(PLACE_M)
        self.assert_at(PLACE_M, UPRIGHT, ARTIFACT)

    def storm(self, name):
        command, says = STORMS[name]
        self.bench.tracker.tell(command)
        if command in DESCRIPTORS:
            self.bench.tracker.tell("unplug", "500ms")
        if says:
            self.bench.status_says("tracker", says, BACK_S)
        self.watch(STORM_S, rests=True)
        self.bench.tracker.tell("good")
        if command in DESCRIPTORS:
            self.bench.tracker.tell("unplug", "500ms")
        self.assert_well()

    def test_panel_replugged_100_times_in_10_s(self):
        for _ in range(REPLUGS):
            self.bench.buttons.tell("unplug", f"{round(500 * REPLUG_S)}ms")
            time.sleep(REPLUG_S)
        self.bench.status_says("panel", "buttons are there", BACK_S)
        self.assert_well()

    def test_button_that_chatters(self):
        """A chattering button is ignored and reported; the shown artifact stays; the button works again once it is quiet."""

        def chatter():
            for _ in range(15):
                self.bench.press(1, reads=8, duration="100ms")

        def chattered():
            chatter()
            return "chatters" in self.bench.status()["panel"]

        eventually(chattered, CHATTER_S, "nobody says that a button chatters")
        shown = self.bench.status()["artifact"]
        chatter()
        self.assertEqual(self.bench.status()["artifact"], shown, "a button that chatters still counts")
        self.bench.status_says("panel", "buttons are there", BACK_S)
        self.bench.buttons.tell("press", 1, "300ms")
        eventually(lambda: self.bench.status()["artifact"] != shown, BACK_S, "the quiet button does nothing")


def _test(name):
    return lambda self: self.storm(name)


for _name in STORMS:
    setattr(Storms, f"test_tracker_{_name}", _test(_name))
