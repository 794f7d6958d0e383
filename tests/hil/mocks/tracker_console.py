"""The commands that a mocked tracker understands, from its control socket or at a time."""

import asyncio
import time

from . import pose_file
from .faults import KINDS
from .pose import Pose, normalized

_COMMANDS = """\
pose X Y Z QW QX QY QZ [STATION]  the sensor is put there (table, metres); station 1 unless said
play FILE                         a pose file from its beginning
good                              ends every fault
status                            counters, settings, the last pose sent and when
help                              this"""


def help_text():
    rows = []
    for name, kind in KINDS.items():
        value = f" [{kind.allowed[0]:g}..{kind.allowed[1]:g}]" if kind.allowed else ""
        rows.append(f"{name + value + ' [DURATION]':33} {kind.says}")
    return "\n".join(rows) + "\nNAME off                          ends it; a DURATION is 2s or 300ms\n" + _COMMANDS


class TrackerConsole:
    def __init__(self, tracker):
        self._tracker = tracker
        self._alarms = {}

    def execute(self, line):
        name, *words = line.split() or [""]
        if name in KINDS:
            return self._fault(name, words)
        if name == "pose":
            return self._pose(words)
        if name == "play" and len(words) == 1:
            return self._play(words[0])
        if name == "good" and not words:
            return self._good()
        if name == "status" and not words:
            return self._tracker.status()
        if name == "help":
            return {"help": help_text()}
        raise ValueError(f"unknown command '{line}'; 'help' lists them")

    def _pose(self, words):
        try:
            numbers = [float(word) for word in words[:7]]
            station = int(words[7]) if len(words) == 8 else 1
            if len(numbers) != 7 or len(words) > 8:
                raise ValueError
        except ValueError:
            raise ValueError("pose: 7 numbers X Y Z QW QX QY QZ, then perhaps the station") from None
        if not 1 <= station <= 16:
            raise ValueError(f"pose: found station {station}; allowed are 1 to 16")
        self._tracker.player.place(station, Pose(tuple(numbers[:3]), normalized(numbers[3:])))
        return {"t_ns": time.monotonic_ns()}

    def _play(self, path):
        try:
            file = pose_file.load(path)
        except OSError as error:
            raise ValueError(f"play: {path} cannot be read: {error.strerror}") from None
        self._tracker.player.play(file, time.monotonic())
        return {"t_ns": time.monotonic_ns(), "seconds": (file.end_us - file.begin_us) * 1e-6}

    def _fault(self, name, words):
        ends = words == ["off"]
        duration = self._tracker.faults.tell(name, words)
        self._disarm(name)
        self._begin_or_end(name, not ends)
        if duration is not None and name in ("unplug", "hang", "hang-until-reset"):
            loop = asyncio.get_running_loop()
            self._alarms[name] = loop.call_later(duration, self._begin_or_end, name, False)
        return {"t_ns": time.monotonic_ns()}

    def _good(self):
        for name in ("unplug", "hang", "hang-until-reset", "replug"):
            if self._tracker.faults.on(name):
                self._begin_or_end(name, False)
        for name in list(self._alarms):
            self._disarm(name)
        self._tracker.faults.clear()
        return {"t_ns": time.monotonic_ns()}

    def _disarm(self, name):
        alarm = self._alarms.pop(name, None)
        if alarm:
            alarm.cancel()

    def _begin_or_end(self, name, begins):
        tracker = self._tracker
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
        """The cable is out for half of the time; at the end it is in."""
        tracker = self._tracker
        per_s = tracker.faults.value("replug") if goes_on else None
        if per_s is None:
            self._disarm("replug")
            tracker.link.plug()
            return
        if plugged:
            tracker.link.unplug()
            tracker.start_anew()
        else:
            tracker.link.plug()
        self._alarms["replug"] = asyncio.get_running_loop().call_later(
            0.5 / per_s, self._replug, True, not plugged)
