"""The commands that a mocked tracker understands, from its control socket or at a time."""

import time

from . import pose_file
from .fault_console import FaultConsole
from .faults import KINDS
from .pose import Pose, normalized

MAX_STATION = 16


class TrackerConsole(FaultConsole):
    kinds = KINDS
    ended_by_time = ("unplug", "hang", "hang-until-reset")
    commands = """\
pose X Y Z QW QX QY QZ [STATION]  puts the sensor there (table, metres); default: station 1
away STATION                      unplugs the station's sensor from the device
play FILE                         plays a pose file from its beginning
good                              ends every fault
status                            counters, settings, the last pose that was sent and its time
help                              this text"""

    def answer(self, name, words):
        if name == "pose":
            return self._pose(words)
        if name == "away" and len(words) == 1:
            return self._away(words[0])
        if name == "play" and len(words) == 1:
            return self._play(words[0])
        return None

    def _away(self, word):
        if not word.isdecimal() or not 1 <= int(word) <= MAX_STATION:
            raise ValueError(f"away: found station {word}; allowed are 1 to {MAX_STATION}")
        self._device.player.take_away(int(word))
        return {"t_ns": time.monotonic_ns()}

    def _pose(self, words):
        try:
            numbers = [float(word) for word in words[:7]]
            station = int(words[7]) if len(words) == 8 else 1
            if len(numbers) != 7 or len(words) > 8:
                raise ValueError
        except ValueError:
            raise ValueError("pose: 7 numbers X Y Z QW QX QY QZ, then perhaps the station") from None
        if not 1 <= station <= MAX_STATION:
            raise ValueError(f"pose: found station {station}; allowed are 1 to {MAX_STATION}")
        self._device.player.place(station, Pose(tuple(numbers[:3]), normalized(numbers[3:])))
        return {"t_ns": time.monotonic_ns()}

    def _play(self, path):
        try:
            file = pose_file.load(path)
        except OSError as error:
            raise ValueError(f"play: {path} cannot be read: {error.strerror}") from None
        self._device.player.play(file, time.monotonic())
        return {"t_ns": time.monotonic_ns(), "seconds": (file.end_us - file.begin_us) * 1e-6}

    def begin_or_end(self, name, begins):
        tracker = self._device
        if name == "unplug":
            if begins:
                tracker.link.unplug()
                tracker.start_anew()
            else:
                tracker.link.plug()
        elif name in ("hang", "hang-until-reset"):
            tracker.hang(begins)
        elif name == "replug":
            self._replug(begins)
        elif name == "slow-boot" and begins:
            tracker.start_anew()
        elif name == "wrong-units" and begins:
            tracker.lose_units()

    def _replug(self, goes_on, plugged=True):
        """Unplugs and plugs in the cable, each for half of a period; at the end it is plugged in."""
        tracker = self._device
        per_s = tracker.faults.value("replug") if goes_on else None
        if per_s is None:
            self.disarm("replug")
            tracker.link.plug()
            return
        if plugged:
            tracker.link.unplug()
            tracker.start_anew()
        else:
            tracker.link.plug()
        self.arm("replug", 0.5 / per_s, self._replug, True, not plugged)
