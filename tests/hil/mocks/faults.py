"""The faults of a mocked device and what they do to its frames; the same seed gives the same faults.

A fault is written `NAME [VALUE] [DURATION]`, for example `drop 0.1`, `stall 2s`, `corrupt 0.05 10s`; `NAME off` ends it
and `good` ends all.
"""

import random
import re
import time
from typing import NamedTuple

_DURATION = re.compile(r"(\d+(?:\.\d+)?)(ms|s)$")
_PROBABILITY = (0.0, 1.0)


class Kind(NamedTuple):
    """usual: the value if none is given; None: the fault has no value. allowed: (minimum, maximum)."""

    usual: float | None
    allowed: tuple | None
    says: str


KINDS = {
    "drop": Kind(0.1, _PROBABILITY, "each frame is lost with this probability"),
    "corrupt": Kind(0.05, _PROBABILITY, "each frame is broken with this probability: bits flipped, or bytes missing"),
    "duplicate": Kind(0.1, _PROBABILITY, "each frame is sent twice with this probability"),
    "reorder": Kind(0.1, _PROBABILITY, "each frame comes after its successor with this probability"),
    "stall": Kind(None, None, "no frames; commands are still answered"),
    "hang": Kind(None, None, "sends and accepts nothing, though it stays connected"),
    "hang-until-reset": Kind(None, None, "as hang; a reset of its USB port, or switching it off, ends it"),
    "nan": Kind(None, None, "positions that are not numbers"),
    "wrong-units": Kind(None, None, "inches, whatever it is set to"),
    "filter-stays": Kind(None, None, "a VIPER's filters stay on, whatever it is told"),
    "nak": Kind(None, None, "commands are refused"),
    "warn": Kind(None, None, "a VIPER does what it is told and answers with a warning"),
    "nak-questions": Kind(None, None, "a VIPER refuses to say how it is set"),
    "built-in-test": Kind(3, (1, 15), "the device's own test has found this fault"),
    "slow-boot": Kind(None, None, "restarts: loses its settings and reports that it is still booting"),
    "unplug": Kind(None, None, "the USB cable is out; plugged in again, it restarts"),
    "sensor-missing": Kind(1, (1, 16), "the sensor of this station is not plugged in"),
    "rate": Kind(30, (0.5, 8000), "so many frames a second, whatever rate it reports; a VIPER's clock keeps pace with them"),
    "clock-stands": Kind(None, None, "its time stamps stand still; a VIPER has only its counter"),
    "replug": Kind(10, (0.1, 50), "the cable goes out and in so many times a second"),
    "burst": Kind(64, (1, 1024), "four times a second repeats the latest frame, so many KiB at once"),
    "false-preambles": Kind(None, None, "noise before each frame, which begins like a frame with a false size"),
    "no-endpoints": Kind(None, None, "its descriptors name no endpoint"),
    "absurd-endpoints": Kind(None, None, "its descriptors name endpoints of every kind and size, all of them wrong"),
    "absurd-lengths": Kind(None, None, "its descriptors have false lengths"),
    "wrong-configuration": Kind(None, None, "it refuses the only configuration that its descriptors name"),
    "distortion": Kind(200, (0, 255), "the device says that its field is distorted by metal"),
}


def parse_duration(text):
    """'2s', '300ms' -> seconds; None: not a duration."""
    match = _DURATION.match(text)
    return None if not match else float(match[1]) * (1.0 if match[2] == "s" else 0.001)


class Faults:
    """`kinds`: the faults of this device; a tracker's by default."""

    def __init__(self, seed=1, clock=time.monotonic, kinds=None):
        self._kinds = KINDS if kinds is None else kinds
        self.random = random.Random(seed)
        self._clock = clock
        self._active = {}  # name -> (value, end or None)

    def tell(self, name, words):
        """Begins or ends a fault; returns its duration in seconds, or None if it lasts until it is ended. Errors: ValueError."""
        kind = self._kinds[name]
        if words == ["off"]:
            self._active.pop(name, None)
            return None
        value, duration = kind.usual, None
        for word in words:
            seconds = parse_duration(word)
            if seconds is not None:
                duration = seconds
                continue
            if kind.allowed is None:
                raise ValueError(f"{name}: '{word}' is not a duration such as 2s or 300ms, nor 'off'")
            try:
                value = float(word)
            except ValueError:
                value = float("nan")
            if not kind.allowed[0] <= value <= kind.allowed[1]:
                raise ValueError(f"{name}: found '{word}'; allowed are {kind.allowed[0]:g} to {kind.allowed[1]:g}")
        self._active[name] = (value, None if duration is None else self._clock() + duration)
        return duration

    def clear(self):
        self._active.clear()

    def on(self, name):
        if name not in self._active:
            return False
        end = self._active[name][1]
        if end is not None and self._clock() >= end:
            del self._active[name]
            return False
        return True

    def value(self, name):
        return self._active[name][0] if self.on(name) else None

    def strikes(self, name):
        """Whether the fault affects this frame; uses seeded random numbers only while the fault is on."""
        return self.on(name) and self.random.random() < self._active[name][0]

    def active(self):
        """{name: value, or true}, for the status."""
        return {name: value if value is not None else True
                for name, (value, _) in list(self._active.items()) if self.on(name)}


class Frame(NamedTuple):
    data: bytes
    poses: dict  # station -> table_from_sensor or None
    intact: bool = True
    sequence: int = 0  # which of the host's counters counts it; a late frame comes after its successor of the same sequence


class FramePath:
    """The path of frames to the host, on which some are lost, broken, doubled or late."""

    def __init__(self, faults, break_bytes):
        """`break_bytes(data, random)` breaks a frame of this device so that a host can notice it."""
        self._faults = faults
        self._break_bytes = break_bytes
        self._held = {}  # by sequence
        self.counts = {"dropped": 0, "corrupted": 0, "duplicated": 0, "reordered": 0}

    def clear(self):
        self._held.clear()

    def send(self, frame):
        """The frames to send now in place of this one."""
        faults, counts = self._faults, self.counts
        if faults.strikes("drop"):
            counts["dropped"] += 1
            return self._with_held(frame, [])
        if faults.strikes("corrupt"):
            counts["corrupted"] += 1
            frame = frame._replace(data=self._break_bytes(frame.data, faults.random), intact=False)
        if frame.sequence not in self._held and faults.strikes("reorder"):
            counts["reordered"] += 1
            self._held[frame.sequence] = frame
            return []
        if faults.strikes("duplicate"):
            counts["duplicated"] += 1
            return self._with_held(frame, [frame, frame])
        return self._with_held(frame, [frame])

    def _with_held(self, frame, frames):
        held = self._held.pop(frame.sequence, None)
        return frames if held is None else [*frames, held]


def flip(data, random_, begin=0):
    """Flips up to four bits, from the byte `begin` on."""
    broken = bytearray(data)
    for bit in random_.sample(range(8 * begin, 8 * len(data)), random_.randint(1, 4)):
        broken[bit // 8] ^= 1 << bit % 8
    return bytes(broken)


def flip_or_cut(data, random_):
    """Flips some bits or cuts the frame short."""
    return flip(data, random_) if random_.random() < 0.5 else data[:random_.randrange(1, len(data))]
