"""Tests that the exhibit sleeps and wakes by its timetable. The test sets the guest's clock, and checks the connector's DPMS state in the
kernel and the screen."""

import re

import screen
from bench import CONNECTOR, USUAL, eventually
from hil_test import HilTest, LIT, START_S

# The prop lies still. A prop in use would keep the exhibit awake for two minutes.
TIMED = USUAL.replace('kind = "usb"', 'kind = "none"') + "\n[hours]\n" + "".join(
    f'{day} = ["10:00-18:00"]\n'
    for day in ("monday", "tuesday", "wednesday", "thursday", "friday", "saturday", "sunday"))
DPMS = CONNECTOR.replace("/status", "/dpms")
BUTTON = 1
LIT_PIXELS = 300
WAKES_S = 2.0


class Hours(HilTest):
    settings = TIMED
    before = "date -s '2026-11-23 12:00:00'"
    after = "date -s @$(cat /sys/class/rtc/rtc0/since_epoch)"

    def setUp(self):  # without a tracker
        self.bench.buttons.tell("plug")
        self.bench.buttons.tell("release", BUTTON)
        self.bench.status_says("panel", "buttons are there", START_S)
        self.bench.status_says("display", LIT)

    def set_clock(self, text):
        self.bench.machine.check(f"date -s '{text}'")

    def dpms(self):
        return self.bench.machine.read(DPMS).strip()

    def hours(self):
        status = self.bench.status()
        return status["hours"] if status else {}

    def is_lit(self):
        picture = self.bench.screendump()
        return screen.probe(picture) is not None and screen.count(screen.lit(picture)) >= LIT_PIXELS

    def assert_falls_asleep(self):
        eventually(lambda: self.dpms() == "Off", 20.0, lambda: f"the projector stays lit: {self.hours()}")
        status = self.bench.status_says("state", "^asleep$")
        self.assertTrue(status["asleep"])
        self.assertEqual(status["health"], "well")
        self.assertEqual(status["hours"]["state"], "closed")
        self.assertFalse(self.is_lit(), "the screen is not dark")

    def assert_wakes(self, why):
        eventually(lambda: self.dpms() == "On" and self.is_lit(), 20.0, "no picture comes back")
        status = self.bench.status_says("hours", why)
        self.assertFalse(status["asleep"])
        self.assertEqual(status["health"], "well")

    def test_sleeps_and_wakes(self):
        bench = self.bench
        process = bench.main_process()
        eventually(self.is_lit, START_S, "it is not lit while it is open")
        bench.status_says("hours", "2026-11-23T18:00:00\\+00:00")
        self.set_clock("2026-11-23 18:30:00")
        self.assert_falls_asleep()
        drawn = bench.status()["drawn"]

        for state in ("off", "detect"):  # the projector's cable
            bench.machine.check(f"echo {state} > {CONNECTOR}")
            bench.machine.let_run(2.0)
            self.assertEqual(self.dpms(), "Off")
        self.assertEqual(bench.status()["drawn"], drawn, "something was drawn in the dark")

        begun = bench.machine.granted_s()
        bench.buttons.tell("press", BUTTON, "300ms")
        eventually(lambda: self.dpms() == "On", WAKES_S, "the button does not wake it in time")
        eventually(self.is_lit, WAKES_S, "no picture comes in time")
        print(f"  awake {bench.machine.granted_s() - begun:.1f} s after the press", flush=True)
        self.assert_wakes("a button was pressed")

        self.set_clock("2026-11-24 11:00:00")
        self.assert_wakes("open until Tue 2026-11-24 18:00")
        self.assertRegex(self.hours()["clock"], "set forward by [0-9]+ s")
        self.set_clock("2026-11-24 19:00:00")
        self.assert_falls_asleep()
        self.set_clock("1970-01-02 03:00:00")
        self.assert_wakes("was never set")
        self.assertEqual(self.hours()["state"], "clock_wrong")
        self.assertEqual(bench.main_process(), process, "it was restarted")
        self.assertTrue(re.search("clock: the clock was set", bench.journal()), "the journal does not tell of the clock")
