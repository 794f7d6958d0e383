#!/usr/bin/python3
"""Prints the times at which something is open, in seconds since 1970: opening_times.py ZONE 10:00-18:00[,...] YEAR YEARS

It uses only zoneinfo's conversion from UTC to local time, and searches the seconds of UTC: a span begins with the first second whose local
time is not before the opening, and ends after the last second whose local time is before the closing.
"""

import bisect
import datetime
import sys
import zoneinfo

DAY_S = 86400
REACH_S = 30 * 3600
UTC = datetime.timezone.utc


def local_of(zone, second):
    """Local time in seconds, computed as if the local clock showed UTC."""
    there = datetime.datetime.fromtimestamp(second, UTC).astimezone(zone)
    return second + int(there.utcoffset().total_seconds())


class Zone:
    def __init__(self, name):
        self.zone = zoneinfo.ZoneInfo(name)
        self.local = {}

    def at(self, second):
        """Local time at a whole minute, cached; the zones of our time change only at whole minutes."""
        if second not in self.local:
            self.local[second] = local_of(self.zone, second)
        return self.local[second]

    def edge(self, local, closes):
        """The times nearby at which the offset changes, searched in steps of a quarter of an hour."""
        offset = self.at(local - REACH_S) - (local - REACH_S)
        if self.at(local + REACH_S) - (local + REACH_S) == offset:
            return local - offset
        quarters = range(local - REACH_S, local + REACH_S, 900)
        before = [self.at(second) < local for second in quarters]
        index = len(before) - before[::-1].index(True) if closes else before.index(False)
        low, high = quarters[index - 1], quarters[index]
        if high - low - (self.at(high) - self.at(low)) == 0:
            return low + (local - self.at(low))
        return bisect.bisect_left(range(high), 1, low, key=lambda second: self.at(second) >= local)


def spans(texts, day_s):
    for text in texts.split(","):
        from_s, to_s = (60 * (60 * int(part[:2]) + int(part[3:])) for part in text.split("-"))
        yield day_s + from_s, day_s + (to_s if to_s > from_s else to_s + DAY_S)


def main():
    zone, times, year, years = Zone(sys.argv[1]), sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
    first, last = (int(datetime.datetime(each, 1, 1, tzinfo=UTC).timestamp()) for each in (year, year + years))
    opened = []
    for day_s in range(first, last, DAY_S):
        for opens, closes in sorted(spans(times, day_s)):
            begin, end = zone.edge(opens, False), zone.edge(closes, True)
            if opened and begin <= opened[-1][1]:
                opened[-1][1] = max(end, opened[-1][1])  # adjacent spans are one
            elif begin < end:
                opened.append([begin, end])
    for begin, end in opened:
        print(begin, end)


main()
