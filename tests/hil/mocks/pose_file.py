"""Pose files: CSV with the header below, `#` comments; table coordinates, metres, times in microseconds."""

import bisect

from .pose import Pose, normalized

HEADER = "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok"


class PoseFile:
    """The rows of each station in ascending time; at any time the latest row holds, exactly as written."""

    def __init__(self, rows):
        """`rows`: (t_us, station, Pose or None where ok = 0)."""
        self._times = {}
        self._poses = {}
        for t_us, station, pose in sorted(rows, key=lambda row: row[0]):
            self._times.setdefault(station, []).append(t_us)
            self._poses.setdefault(station, []).append(pose)
        if not self._times:
            raise ValueError("the pose file has no rows")
        self.begin_us = min(times[0] for times in self._times.values())
        self.end_us = max(times[-1] for times in self._times.values())

    def at(self, t_us):
        """{station: Pose, or None where ok = 0}; a station appears from its first row on."""
        found = {}
        for station, times in self._times.items():
            index = bisect.bisect_right(times, t_us) - 1
            if index >= 0:
                found[station] = self._poses[station][index]
        return found


def parse(text, name):
    """Raises ValueError with the line's number."""
    lines = [(n, line.strip()) for n, line in enumerate(text.splitlines(), 1)]
    lines = [(n, line) for n, line in lines if line and not line.startswith("#")]
    if not lines or lines[0][1] != HEADER:
        raise ValueError(f"{name}: the first line is not the header; allowed is {HEADER}")
    rows = []
    for number, line in lines[1:]:
        fields = line.split(",")
        try:
            if len(fields) != 10:
                raise ValueError(f"the row has {len(fields)} fields; allowed are 10: {HEADER}")
            t_us, station, ok = int(fields[0]), int(fields[1]), int(fields[9])
            pose = None
            if ok:
                numbers = [float(field) for field in fields[2:9]]
                pose = Pose(tuple(numbers[:3]), normalized(numbers[3:]))
            rows.append((t_us, station, pose))
        except ValueError as error:
            raise ValueError(f"{name}:{number}: {error}") from None
    return PoseFile(rows)


def load(path):
    with open(path, encoding="utf-8") as file:
        return parse(file.read(), path)


def row(t_us, station, pose):
    """One line; pose None: ok = 0. Python writes the shortest decimals that read back as the same numbers."""
    shown = pose or Pose()
    numbers = ",".join(repr(float(c)) for c in (*shown.position, *shown.quaternion))
    return f"{t_us},{station},{numbers},{1 if pose else 0}\n"
