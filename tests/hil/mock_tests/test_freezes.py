"""Tests the definition of a freeze in watch.py, with artificial looks: no machine, no clock."""

import unittest

from machine import Given
from watch import Look, Watch

STEP_S = 0.05


def looks(pictures, pause_at_s=None, pause_s=0.0):
    """`pictures`: (code, seconds for which it stands). The guest always rests; the host stops once."""
    made, now_s, end_s = [], 0.0, 0.0
    for code, stands_s in pictures:
        end_s += stands_s
        while now_s < end_s:
            if pause_at_s is not None and now_s >= pause_at_s:
                now_s, end_s, pause_at_s = now_s + pause_s, end_s + pause_s, None
            made.append(Look(now_s + 0.01, Given(now_s, now_s), Given(now_s + 0.01, now_s + 0.01), code))
            now_s += STEP_S
    return Watch(made, [])


class Freezes(unittest.TestCase):
    def test_steady_pictures_are_no_freeze(self):
        self.assertLess(looks([(1, 1.0), (2, 1.0), (3, 1.0)]).stood(rests=True).rested_s, 0.1)

    def test_measures_a_standing_picture(self):
        for late_s in (0.4, 1.5, 5.0):
            stood = looks([(1, 1.0), (2, 1.0 + late_s), (3, 1.0)]).stood(rests=True)
            self.assertAlmostEqual(stood.rested_s, late_s, delta=2.0 * STEP_S)
            stood = looks([(1, 0.05), (2, late_s), (3, 0.05)]).stood()
            self.assertAlmostEqual(stood.granted_s, late_s, delta=2.0 * STEP_S)

    def test_a_pause_of_the_host_is_no_freeze(self):
        for pause_s in (0.3, 1.0, 30.0):
            stood = looks([(1, 1.0), (2, 1.0), (3, 1.0)], pause_at_s=1.9, pause_s=pause_s).stood(rests=True)
            self.assertLess(stood.rested_s, 0.25)
            stood = looks([(1, 0.1), (2, 0.1), (3, 0.1)], pause_at_s=0.14, pause_s=pause_s).stood()
            self.assertLess(stood.granted_s, 0.25)

    def test_a_device_waiting_for_the_host_is_no_freeze(self):
        stood = Given(1.0, 1.0).after(0.5, processors=[(0.0, 0.0), (0.1, 0.0)], devices=[(0.0, 0.4), (0.01, 0.0)])
        self.assertAlmostEqual(stood.granted_s, 1.1)
        self.assertAlmostEqual(stood.rested_s, 1.0)
        rested = Given(1.0, 1.0).after(0.5, processors=[(0.0, 0.0), (0.1, 0.05)], devices=[])
        self.assertAlmostEqual(rested.granted_s, 1.45)
        self.assertAlmostEqual(rested.rested_s, 1.35)

    def test_a_look_without_a_code_is_not_another_picture(self):
        stood = looks([(1, 1.0), (None, 0.5), (1, 0.5)]).stood(rests=True)
        self.assertAlmostEqual(stood.rested_s, 1.0, delta=2.0 * STEP_S)
