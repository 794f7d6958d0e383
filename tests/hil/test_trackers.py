"""Tests the other trackers that a museum may have, through their own kernel drivers, in place of the VIPER."""

from bench import EYE_M, UPRIGHT, eventually
from hil_test import HilTest, long

ARTIFACT = "amphora"
PLACE_M = (0.1, -0.05, 0.0)
OTHER_PLACE_M = (-0.1, -0.05, 0.0)
FOUND_S = 20.0  # it must be found within 2 s; the kernel's own enumeration is slow here


class Trackers(HilTest):
    def take(self, device, place_m):
        tracker = self.bench.other_trackers[device]
        self.addCleanup(self.bench.status_says, "tracker", "no tracker is connected", FOUND_S)  # after the next one
        self.addCleanup(tracker.tell, "unplug")
        self.show(ARTIFACT)
        self.bench.tracker.tell("unplug")
        self.bench.status_says("tracker", "no tracker is connected", FOUND_S)
        tracker.tell("pose", *place_m, *UPRIGHT, 1)
        tracker.tell("pose", *EYE_M, *UPRIGHT, 2)
        tracker.tell("unplug", "off")
        self.bench.status_says("tracker", "is running", FOUND_S)
        self.assert_at(place_m, artifact=ARTIFACT)

    def test_viper_filters_are_switched_off(self):
        """The driver switches both of the tracker's own filters off when it finds the tracker."""
        self.show(ARTIFACT)
        eventually(lambda: not any(self.bench.tracker.tell("status")["filter_levels"].values()), FOUND_S,
                   "the VIPER filters by itself")

    @long
    def test_a_hanging_tracker_does_not_block_another(self):
        self.show(ARTIFACT)
        dead = self.bench.other_trackers["patriot"]
        self.addCleanup(dead.tell, "unplug")
        self.addCleanup(dead.tell, "good")
        self.bench.tracker.tell("unplug")
        dead.tell("hang")
        dead.tell("unplug", "off")
        self.bench.status_says("tracker", "refuses its set-up or does not answer", FOUND_S)
        self.bench.place(PLACE_M)
        self.bench.tracker.tell("unplug", "off")
        self.bench.status_says("tracker", "is running", 3 * FOUND_S)
        self.assert_at(PLACE_M, artifact=ARTIFACT)

    def test_patriot(self):
        self.take("patriot", PLACE_M)

    def test_hid_tracker(self):
        self.take("hid", OTHER_PLACE_M)
