"""The events of a soak and their times, from a seed, so that a soak can be repeated.

Time     hours and seconds of the exhibit's time; a soak runs `pace` times faster than a museum (docs/soak.md).
"""

import math
import random
from dataclasses import dataclass

PRESSES_PER_H = 60  # of the buttons, at a busy museum


@dataclass
class Event:
    at_s: float
    kind: str  # "press", or a kind of fault


def plan(hours, kinds, seed, once=(), every_h=None):
    """Presses at random times, and each kind of fault once in every whole hour, at least once in all; sorted by time. Kinds in `once` come
    only in the first hour; kinds in `every_h` (kind -> hours) come in the first hour and then with at least so many hours between."""
    every_h = every_h or {}
    dice = random.Random(seed)
    events = [Event(dice.uniform(0.0, 3600.0 * hours), "press") for _ in range(round(PRESSES_PER_H * hours))]
    spans = max(1, round(hours))
    for number in range(spans):
        order = [kind for kind in dice.sample(kinds, len(kinds))
                 if number == 0 or (kind not in once and number % math.ceil(every_h.get(kind, 1)) == 0)]
        if not order:
            break
        length_s = 3600.0 * hours / spans
        for place, kind in enumerate(order):  # each has a part of the hour, and a random time in the first half of it
            part_s = length_s / len(order)
            events.append(Event(number * length_s + (place + dice.uniform(0.0, 0.5)) * part_s, kind))
    return sorted(events, key=lambda event: event.at_s)
