#!/usr/bin/python3
"""Tests the soak's judge on artificial soaks with known truth."""

import random
import unittest

import day
import judge

PACE = 8.0


def fault(kind, begin_s, end_s, came_back=True):
    return {"kind": kind, "begin_s": begin_s, "end_s": end_s, "begin_uptime_s": begin_s + 100.0, "end_uptime_s": end_s + 100.0,
            "came_back": came_back}


def samples(leak_mib_per_h, seed=1, restart_at_s=1800.0, length_s=3600.0):
    """Samples every 5 s, with noise of 0.3 MiB and some peaks; after the restart another process, 40 MiB larger."""
    dice = random.Random(seed)
    found = []
    for at in range(0, int(length_s), 5):
        process, since = (1, at) if at < restart_at_s else (2, at - restart_at_s)
        noise = dice.gauss(0.0, 0.3) + (25.0 if dice.random() < 0.03 else 0.0)
        found.append({"at_s": float(at), "system_mib": 200.0 + noise, "exhibit_mib": 40.0 * process + leak_mib_per_h * since / 3600.0 + noise,
                      "exhibit_own_mib": 20.0 * process, "watchdog_mib": 3.0, "exhibit_pid": process, "watchdog_pid": 9, "written_bytes": 1000 * at, "writes": at,
                      "frames": int(30 * since), "drawn": int(10 * since), "packets": int(240 * since)})
    return found


def soak(**changes):
    found = {"seed": 1, "pace": PACE, "samples": samples(0.0), "looks": [(0.25 * k, True) for k in range(4 * 3600)], "steps": [], "ends": [],
             "faults": [], "events": {}}
    found.update(changes)
    return judge.judged(found, {"hangs": {"device_silent"}}, {"killed"})


class Slopes(unittest.TestCase):
    def test_finds_the_slope_of_a_line(self):
        slope, low, high = judge.theil_sen([[(float(x), 3.0 + 2.5 * x) for x in range(20)]])
        self.assertAlmostEqual(slope, 2.5)
        self.assertAlmostEqual(low, 2.5)
        self.assertAlmostEqual(high, 2.5)

    def test_tolerates_one_outlier_in_five(self):
        run = [(float(x), 2.5 * x if x % 5 else 1e6) for x in range(40)]
        self.assertAlmostEqual(judge.theil_sen([run])[0], 2.5, delta=0.01)

    def test_interval_contains_the_true_slope(self):
        """The interval contains the true slope in 95 % of soaks; the test demands 86 of 100 (by chance, 1 in 10 000 tests finds fewer)."""
        held = 0
        for seed in range(100):
            dice = random.Random(seed)
            _, low, high = judge.theil_sen([[(x / 60.0, x / 60.0 + dice.gauss(0.0, 1.0)) for x in range(60)]])
            held += low <= 1.0 <= high
        self.assertGreaterEqual(held, 86)
        self.assertLess(held, 100)

    def test_a_restart_is_no_slope(self):
        memory = soak()["memory"]["exhibit"]
        self.assertLess(abs(memory["mb_per_exhibit_h"]), 0.1)
        self.assertEqual(memory["verdict"], "holds")

    def test_reports_a_leak(self):
        """20 MiB in an hour that passed are 2.6 MB in an hour of the exhibit's time."""
        report = soak(samples=samples(20.0))
        self.assertAlmostEqual(report["memory"]["exhibit"]["mb_per_exhibit_h"], 20.0 * 1.048576 / PACE, delta=0.3)
        self.assertEqual(report["memory"]["exhibit"]["verdict"], "missed")
        self.assertEqual(len(report["missed"]), 1)

    def test_reports_soaks_that_are_too_short(self):
        """Nineteen minutes after the first minute are too short for a slope, whatever the samples are."""
        self.assertEqual(soak(samples=samples(60.0, length_s=1200.0))["memory"]["exhibit"]["verdict"], "too short to say")
        self.assertEqual(soak(samples=samples(0.0, length_s=120.0))["memory"]["exhibit"]["verdict"], "too short to say")
        self.assertEqual(soak(samples=samples(0.0, length_s=70.0))["memory"]["exhibit"]["verdict"], "too few samples")


class Counts(unittest.TestCase):
    def test_nothing_wrong(self):
        report = soak()
        self.assertEqual((report["availability"], report["longest_dark_s"], report["missed"]), (1.0, 0.0, []))
        self.assertAlmostEqual(report["exhibit_hours"], 8.0, delta=0.01)

    def test_reports_dark_time(self):
        looks = [(0.25 * k, not 400 <= k < 800) for k in range(4000)]  # 100 s of 1000
        report = soak(looks=looks)
        self.assertAlmostEqual(report["availability"], 0.9, delta=0.002)
        self.assertAlmostEqual(report["longest_dark_s"], 100.0, delta=0.6)
        self.assertIn("dark for", report["missed"][0])

    def test_finds_false_alarms(self):
        """A step that the fault explains, a step of another cause, and a step long after the fault."""
        steps = [{"awake_s": 230.0, "cause": "device_silent", "step": "reset_device"},
                 {"awake_s": 230.0, "cause": "memory_short", "step": "restart"},
                 {"awake_s": 900.0, "cause": "device_silent", "step": "reset_device"}]
        report = soak(steps=steps, faults=[fault("hangs", 120.0, 140.0)])
        self.assertEqual([step["false_alarm"] for step in report["steps"]], [False, True, True])
        self.assertEqual(report["false_alarms"], 2)
        self.assertEqual(len(report["missed"]), 1)

    def test_finds_unexpected_ends(self):
        report = soak(ends=[(205.0, "signal killed KILL"), (1500.0, "exit-code exited 1")], faults=[fault("killed", 103.0, 110.0)])
        self.assertEqual([end["expected"] for end in report["restarts"]], [True, False])
        self.assertIn("1 ends", report["missed"][0])

    def test_reports_a_fault_without_recovery(self):
        report = soak(faults=[fault("unplugged", 10.0, 70.0, came_back=False)])
        self.assertIn("unplugged", report["missed"][0])

    def test_adds_counts_across_a_restart(self):
        """30 a second, except between the last sample of one process and the first sample of the next."""
        self.assertAlmostEqual(soak()["events"]["frames"], 30 * 3590, delta=30 * 10)

    def test_writes_without_sticks(self):
        """1000 bytes a second, also if the time of a stick is left out."""
        written = soak(faults=[fault("stick_good", 1000.0, 1100.0)])["written"]
        self.assertAlmostEqual(written["without_sticks"]["bytes_per_h_passed"], 3.6e6, delta=1.0)
        self.assertAlmostEqual(written["without_sticks"]["s"], 3595.0 - 135.0, delta=10.0)
        self.assertEqual(written["bytes"], 3595000)


class Plan(unittest.TestCase):
    KINDS = [f"kind {number}" for number in range(13)]

    def test_each_kind_once_an_hour(self):
        events = day.plan(8.0, self.KINDS, 3)
        for kind in self.KINDS:
            hours = [int(event.at_s // 3600) for event in events if event.kind == kind]
            self.assertEqual(sorted(hours), list(range(8)))
        self.assertEqual(sum(event.kind == "press" for event in events), 480)
        self.assertEqual(events, sorted(events, key=lambda event: event.at_s))

    def test_plans_a_kind_once(self):
        times = [event.at_s for event in day.plan(8.0, self.KINDS, 3, {"kind 4"}) if event.kind == "kind 4"]
        self.assertEqual(len(times), 1)
        self.assertLess(times[0], 3600.0)

    def test_leaves_time_between_repetitions(self):
        """3.2 hours are rounded up to four: the fault comes in the first and in the fifth hour."""
        times = [event.at_s for event in day.plan(8.0, self.KINDS, 3, (), {"kind 4": 3.2}) if event.kind == "kind 4"]
        self.assertEqual([int(at // 3600.0) for at in times], [0, 4])

    def test_plans_each_kind_once_in_a_short_soak(self):
        self.assertEqual(sorted(event.kind for event in day.plan(0.4, self.KINDS, 1) if event.kind != "press"), sorted(self.KINDS))

    def test_seeds(self):
        self.assertEqual(day.plan(2.0, self.KINDS, 5), day.plan(2.0, self.KINDS, 5))
        self.assertNotEqual(day.plan(2.0, self.KINDS, 5), day.plan(2.0, self.KINDS, 6))


if __name__ == "__main__":
    unittest.main()
