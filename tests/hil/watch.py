"""Looking at the screen for a while: when a new picture came, and where its lit part was.

A presented picture carries a code that differs from the one before (app/render/probe.h), so that two screendumps with
different codes are two pictures, even where nothing moves.

Time     seconds of the host's monotonic clock; a screendump is as old as the time it took.
"""

import time
from dataclasses import dataclass

import screen

LOOK_S = 0.02  # pause between two screendumps
MEASURE_S = 0.2  # pause between two whose lit part is measured


@dataclass
class Look:
    time: float
    centroid: tuple
    lit_pixels: int
    picture: screen.Picture


@dataclass
class Watch:
    longest_gap_s: float  # between two new pictures, or from the last one to the end
    pictures: int  # how many new ones were seen
    looks: list


def watch(bench, seconds):
    """The exhibit is left alone meanwhile."""
    begin = now = time.monotonic()
    changed, measured = begin, begin - MEASURE_S
    code, gap, pictures, looks = None, 0.0, 0, []
    while now - begin < seconds:
        picture = bench.screendump()
        now = time.monotonic()
        seen = screen.probe(picture)
        if seen is not None and seen != code:
            code, pictures = seen, pictures + 1
            gap, changed = max(gap, now - changed), now
        if now - measured >= MEASURE_S:
            measured = now
            rows = screen.lit(picture)
            looks.append(Look(now, screen.centroid(rows, picture.width), screen.count(rows), picture))
        time.sleep(LOOK_S)
    return Watch(max(gap, now - changed), pictures, looks)


def distance_to_path(point, path):
    """Pixels from a point to the nearest point of a polyline."""
    nearest = float("inf")
    for (ax, ay), (bx, by) in zip(path, path[1:]):
        dx, dy = bx - ax, by - ay
        length = dx * dx + dy * dy
        share = 0.0 if length == 0.0 else ((point[0] - ax) * dx + (point[1] - ay) * dy) / length
        share = min(1.0, max(0.0, share))
        nearest = min(nearest, ((point[0] - ax - share * dx) ** 2 + (point[1] - ay - share * dy) ** 2) ** 0.5)
    return nearest
