"""Looking at the screen for a while: which pictures came, how long one of them stood, and what some of them lit.

A presented picture carries a code that differs from the one before (app/render/probe.h), so that two screendumps with
different codes are two pictures, even where nothing moves.

Time     seconds that the host granted the guest (Machine.granted_s), so that a busy host is not the exhibit's freeze: a
         guest that is frozen waits for nothing, and nothing is taken off. A picture stood at least from the end of the
         first look that saw it to the beginning of the last one, however slow the looks themselves are.
"""

import time
from dataclasses import dataclass

import screen

LOOK_S = 0.02  # pause between two screendumps
KEPT_S = 0.2  # pause between two that are kept to be measured
RESTING_S = 1.0  # where nothing moves, a picture comes after so long, with another code
FROZEN_S = 0.25


@dataclass
class Look:
    time_s: float  # by the monotonic clock, at its end
    begin_s: float  # granted
    end_s: float
    code: int  # None: none can be read


@dataclass
class Watch:
    looks: list
    pictures: list  # some of those seen

    def stood_s(self, rests=False):
        """How long one picture stood; `rests`: how much longer than a picture may while nothing moves."""
        longest, first, since = 0.0, None, None
        for look in self.looks:
            if first is None or look.code not in (first.code, None):
                first, since = look, None
            if since is None and look.time_s >= first.time_s + (RESTING_S if rests else 0.0):
                since = look  # the next picture is due
            if since is not None:
                longest = max(longest, look.begin_s - since.end_s)
        return longest

    def codes(self):
        """How many different pictures were seen, one after another."""
        seen = [look.code for look in self.looks if look.code is not None]
        return sum(a != b for a, b in zip(seen, [None, *seen]))


def watch(bench, seconds):
    """The exhibit is left alone meanwhile."""
    looks, pictures, granted_s = [], [], bench.machine.granted_s
    begun = time.monotonic()
    kept = begun - KEPT_S
    while time.monotonic() - begun < seconds:
        begin_s = granted_s()
        picture = bench.screendump()
        looks.append(Look(time.monotonic(), begin_s, granted_s(), screen.probe(picture)))
        if time.monotonic() - kept >= KEPT_S:
            kept = time.monotonic()
            pictures.append(picture)
        time.sleep(LOOK_S)
    return Watch(looks, pictures)
