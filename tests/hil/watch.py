"""Looking at the screen for a while: when a new picture came, and what it lit.

A presented picture carries a code that differs from the one before (app/render/probe.h), so that two screendumps with
different codes are two pictures, even where nothing moves.

Time     seconds of the host's monotonic clock; a screendump is as old as the time it took. A gap is without what the
         guest's processors waited for the host's meanwhile (Machine.waited_s): nothing in the guest could end it sooner.
"""

import time
from dataclasses import dataclass

import screen

LOOK_S = 0.02  # pause between two screendumps
MEASURE_S = 0.2  # pause between two whose lit part is measured


@dataclass
class Look:
    picture: screen.Picture
    lit: list  # as screen.lit


@dataclass
class Watch:
    longest_gap_s: float  # between two new pictures, or from the last one to the end; see above
    pictures: int  # how many new ones were seen
    looks: list


def watch(bench, seconds):
    """The exhibit is left alone meanwhile."""
    begin = now = time.monotonic()
    changed, measured = (begin, bench.machine.waited_s()), begin - MEASURE_S
    code, gap, pictures, looks = None, 0.0, 0, []

    def gap_until_now():
        return now - changed[0] - max(b - a for a, b in zip(changed[1], bench.machine.waited_s()))

    while now - begin < seconds:
        picture = bench.screendump()
        now = time.monotonic()
        seen = screen.probe(picture)
        if seen is not None and seen != code:
            gap = max(gap, gap_until_now())
            code, pictures, changed = seen, pictures + 1, (now, bench.machine.waited_s())
        if now - measured >= MEASURE_S:
            measured = now
            looks.append(Look(picture, screen.lit(picture)))
        time.sleep(LOOK_S)
    return Watch(max(gap, gap_until_now()), pictures, looks)
