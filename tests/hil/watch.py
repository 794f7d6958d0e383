"""Watches the screen for a while: which pictures came, how long one of them stood, and which pixels some of them lit.

A presented picture has a code that differs from that of the picture before (app/render/probe.h). So two screendumps with
different codes are two pictures, even if nothing moves.

Freeze   a picture that stands while the guest rests for some time, or while the guest is granted the time of several pictures. Both
         times are of clocks (Machine.given) that stop while a busy host lets the guest wait, so that the host's load does not count as
         a freeze. The first does not depend on how slow the guest is. A picture stood at least from the end of the first look
         that saw it to the beginning of the last one, however slow the looks themselves are.
Pause    if the host stops as a whole (a virtual machine that gets no processor from its own host), these clocks do not stop. Such a
         pause is one long step between two looks. No step counts for more than SURE_S, so that a freeze counts only if several
         looks saw it.
"""

import statistics
import time
from dataclasses import dataclass

import screen
from machine import Given
from screen import CODES

LOOK_S = 0.02  # pause between two screendumps
KEPT_S = 0.2  # pause between two screendumps that are kept for measurements
SURE_S = 0.1  # the largest step between two looks that counts in full
RESTING_S = 1.0  # while nothing moves, a picture with another code comes after this time
FROZEN_S = 0.25
FROZEN_PACES = 4.0


@dataclass
class Look:
    time_s: float  # monotonic clock at the end of the look
    begin: Given
    end: Given
    code: int  # None: the picture has no readable code


def plus(stood, before, now):
    """`stood` plus the time granted from one look to the next."""
    return Given(stood.granted_s + min(SURE_S, now.granted_s - before.granted_s),
                 stood.rested_s + min(SURE_S, now.rested_s - before.rested_s))


@dataclass
class Watch:
    looks: list
    pictures: list  # some of those seen

    def stood(self, rests=False):
        """The longest time for which one picture stood; `rests`: beyond the time that is allowed while nothing moves."""
        longest, first, stands, seen = Given(0.0, 0.0), None, None, None
        for look in self.looks:
            if first is None or look.code not in (first.code, None):
                first, stands = look, None
            if stands is not None:
                stands = plus(stands, seen, look.begin)
                longest = Given(max(longest.granted_s, stands.granted_s), max(longest.rested_s, stands.rested_s))
                seen = look.begin
            elif look.time_s >= first.time_s + (RESTING_S if rests else 0.0):
                stands, seen = Given(0.0, 0.0), look.end  # the next picture is due
        return longest

    def as_text(self):
        """A line for each look."""
        begun = self.looks[0].time_s
        return "\n".join(f"{look.time_s - begun:.3f} {look.code} {look.end.granted_s:.3f} {look.end.rested_s:.3f}"
                         for look in self.looks)

    def pace_s(self):
        """The guest's median time for a picture; 0: there were too few pictures."""
        coded = [look for look in self.looks if look.code is not None]
        first = [look for before, look in zip(coded, coded[1:]) if look.code != before.code]
        paces = [(b.end.granted_s - a.end.granted_s) / ((b.code - a.code) % CODES) for a, b in zip(first, first[1:])]
        return statistics.median(paces) if paces else 0.0


def watch(bench, seconds):
    """Watches for `seconds`, and does nothing else to the exhibit."""
    looks, pictures, given = [], [], bench.machine.given
    begun = time.monotonic()
    kept = begun - KEPT_S
    while time.monotonic() - begun < seconds:
        begin = given()
        picture = bench.screendump()
        looks.append(Look(time.monotonic(), begin, given(), screen.probe(picture)))
        if time.monotonic() - kept >= KEPT_S:
            kept = time.monotonic()
            pictures.append(picture)
        time.sleep(LOOK_S)
    return Watch(looks, pictures)


def froze(seen, rests=False):
    """Returns why a picture counts as frozen; empty: no picture does. Prints the figures."""
    stood, pace_s = seen.stood(rests), seen.pace_s()
    figures = (f"{'at rest' if rests else 'moving'}: a picture each {1e3 * pace_s:.0f} ms; one stood for "
               f"{1e3 * stood.granted_s:.0f} ms, while the guest rested for {1e3 * stood.rested_s:.0f}; "
               f"{len(seen.looks)} looks")
    print(f"  {figures}", flush=True)
    in_a_circle = not rests and pace_s > 0.0 and stood.granted_s > max(FROZEN_S, FROZEN_PACES * pace_s)
    if stood.rested_s <= FROZEN_S and not in_a_circle:
        return ""
    return f"the picture froze; {figures}; time, code, granted, rested of each:\n{seen.as_text()}"
