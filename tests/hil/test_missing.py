"""Tests starts of the machine without some of its devices: the exhibit is lit, names the missing device, and uses it when it appears. For a
projector that is missing or late see test_restart.py and test_display.py."""

import json

import screen
from bench import USUAL, eventually
from hil_test import START_S, LIT, HilTest, long
from stick_bench import StickTest, pulled_packs

SYSTEM_BACK_S = 120.0
LATE_S = 20.0  # a device must be taken within 2 s; the kernel's own enumeration is slow here
LIT_PIXELS = 300
NO_TRACKER, NO_PANEL, NO_SOUND = "no tracker is connected", "it is not there", "is it plugged in"


class Anew(HilTest):
    """Tests that restart the machine; the data on its disk stay."""

    def start_anew(self, before_reset=lambda: None):
        self.bench.machine.check("sync")  # a reset loses data that are not yet on the disk, such as the settings of this class
        self.bench.machine.may_start_anew()
        before_reset()
        self.bench.machine.monitor("system_reset")
        self.assertTrue(self.bench.machine.resets_within(SYSTEM_BACK_S), "the machine does not start anew")
        self.bench.machine.wait_for_start()
        self.bench.status_says("display", LIT, SYSTEM_BACK_S)
        eventually(self.is_lit, START_S, "the screen stays dark")

    def is_lit(self):
        picture = self.bench.screendump()
        return screen.probe(picture) is not None and screen.count(screen.lit(picture)) > LIT_PIXELS


@long
class Missing(Anew):
    # This machine's second sound card is a USB device that a test plugs in.
    settings = USUAL + '\n[sound]\ndevice = "plughw:1,0"\n'

    def setUp(self):
        super().setUp()
        self.addCleanup(self.bench.buttons.tell, "plug")
        self.addCleanup(self.bench.tracker.tell, "unplug", "off")

    def assert_not_well(self, device, sentence):
        """Checks that the status file names the missing device, and that the first line of `frustumscreen status` does so too."""
        self.bench.status_says(device, sentence)
        ran = self.bench.machine.run("frustumscreen status --json")
        verdict = json.loads(ran.output)
        self.assertEqual((ran.status, verdict["well"], verdict["runs"]), (1, False, True), verdict["sentence"])
        missing = self.bench.status()[device].split("; ")[0]
        self.assertTrue(verdict["sentence"].startswith("The exhibit runs, but: "), verdict["sentence"])
        self.assertIn(missing, verdict["sentence"])
        return verdict

    def assert_well(self):
        ran = self.bench.machine.run("frustumscreen status --json")
        self.assertEqual((ran.status, json.loads(ran.output)["well"]), (0, True), ran.output)

    def plug_tracker(self):
        self.bench.tracker.tell("unplug", "off")
        self.bench.status_says("tracker", "is running", LATE_S)
        self.bench.place((0.1, 0.0, 0.0))
        self.assert_at((0.1, 0.0, 0.0))

    def plug_panel(self):
        self.bench.buttons.tell("plug")
        self.bench.status_says("panel", "buttons are there", LATE_S)
        if self.bench.status()["state"] == "attract":  # the artifacts come in turn until the first press
            self.bench.press(1)
        before = self.bench.status_says("state", "^(?!attract)")["artifact"]
        self.bench.buttons.tell("press", 1, "300ms")
        eventually(lambda: self.bench.status()["artifact"] != before, LATE_S, "its buttons do nothing")

    def plug_sound(self):
        self.bench.machine.monitor("device_add", driver="usb-audio", id="late-sound", audiodev="heard", bus="usb.0")
        self.addCleanup(self.bench.machine.monitor, "device_del", id="late-sound")
        self.bench.status_says("sound", "its sound goes to", LATE_S)

    def test_all_missing_and_late(self):
        self.bench.tracker.tell("unplug")
        self.bench.buttons.tell("unplug")
        self.start_anew()
        process = self.bench.main_process()
        for device, sentence in (("tracker", NO_TRACKER), ("panel", NO_PANEL), ("sound", NO_SOUND)):
            self.assert_not_well(device, sentence)
        for plug in (self.plug_sound, self.plug_panel, self.plug_tracker):
            plug()
        self.assert_well()
        self.assertEqual(self.bench.main_process(), process, "the exhibit was restarted")

    def test_tracker_missing_and_late(self):
        self.bench.tracker.tell("unplug")
        self.start_anew()
        self.assertRegex(self.assert_not_well("tracker", NO_TRACKER)["id"], "^tracker\\.")
        self.bench.status_says("panel", "buttons are there")
        self.plug_tracker()

    def test_panel_missing_and_late(self):
        self.bench.buttons.tell("unplug")
        self.start_anew()
        self.assertRegex(self.assert_not_well("panel", NO_PANEL)["id"], "^panel\\.")
        self.bench.status_says("tracker", "is running", START_S)
        self.plug_panel()


@long
class StickAtTheStart(StickTest, Anew):
    def test_stick_is_in_from_the_start(self):
        """A stick that is in from the start is imported like a later one, and its artifact is still there after another start."""
        stick = self.make("early", "vfat", {"nautilus-cup.fspack": self.signed("nautilus-cup", 1)})
        self.start_anew(lambda: self.plug("early", stick))  # no import can end before the reset
        self.last = None
        self.assertEqual(pulled_packs(self.outcome(SYSTEM_BACK_S)), {"nautilus-cup.fspack": ("taken", "none")})
        self.pull("early")
        self.bench.status_says("artifact", "^nautilus-cup$", SYSTEM_BACK_S)
        self.start_anew()
        self.bench.status_says("artifact", "^nautilus-cup$", SYSTEM_BACK_S)
        self.assertEqual(self.installed(), [("nautilus-cup", 1)])
