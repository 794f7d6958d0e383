"""A Polhemus PATRIOT or LIBERTY: commands and answers are text; frames of one sensor each are text or, after F1, binary.

Frame: 'PA' or 'LY', u8 station, u8 command, u8 error (space: good), u8 0, u16 size of the rest; then the chosen
fields, little-endian. The family has no checksum. It answers questions and wrong commands, but not a command that it accepts.
"""

import struct
import time

from .faults import Frame
from .tracker import Tracker
from .usb_device import BULK, IN, Endpoint

POSITION, QUATERNION, TIMESTAMP, FRAME_COUNT, DISTORTION = 3, 7, 8, 9, 11
_KNOWN_FIELDS = (POSITION, QUATERNION, TIMESTAMP, FRAME_COUNT, DISTORTION)
_REMEMBERED = "HXY@"  # hemisphere, position and orientation filters, buffering: accepted, without effect here
_CENTIMETRES_IN_METRE, _INCHES_IN_METRE = 100.0, 1 / 0.0254
_CONTROL_U, _CONTROL_V, _CONTROL_Y = "\x15", "\x16", "\x19"


def binary_frame(tag, station, command, payload, error=" "):
    head = struct.pack("<2sBccBH", tag, station, command.encode(), error.encode(), 0, len(payload))
    return head + payload


def split_commands(stream):
    """Takes whole commands off a bytearray: 'P' by itself, all others end with a carriage return."""
    found = []
    while stream:
        if stream[0] in b"\r\n":
            del stream[:1]
        elif stream[:1] == b"P":
            found.append("P")
            del stream[:1]
        else:
            end = stream.find(b"\r")
            if end < 0:
                return found
            found.append(stream[:end].decode("latin-1"))
            del stream[:end + 1]
    return found


class Patriot(Tracker):
    name = "patriot"
    tag = b"PA"
    vendor_id, product_id = 0x0F44, 0xEF12
    endpoints = (Endpoint(IN | 2, BULK, 64), Endpoint(2, BULK, 64))
    strings = ("", "Polhemus", "PATRIOT (mock)", "mock")
    rate_hz = 60.0

    def __init__(self, *args, **kwargs):
        super().__init__(*args, **kwargs)
        self.start_anew()

    def start_anew(self):
        super().start_anew()
        self.settings = {}
        self._stream = bytearray()
        self._binary = False
        self._metric = False
        self._fields = (POSITION, QUATERNION)
        self._clock_zero = time.monotonic()

    def lose_units(self):
        """Its frames do not say their units, so the device starts again and is set up again."""
        self.start_anew()

    @staticmethod
    def break_bytes(data, random_):
        """Without a checksum a host can notice only a broken header: a flipped bit, or the frame cut within it."""
        if random_.random() < 0.5:
            return data[:random_.randrange(1, 8)]
        broken = bytearray(data)
        broken[random_.choice((0, 1, 3, 6, 7))] ^= 1 << random_.randrange(8)
        return bytes(broken)

    @classmethod
    def false_start(cls, random_):
        """A whole frame with an invalid quaternion: without a checksum a host can notice no more."""
        return binary_frame(cls.tag, random_.randint(1, 16), "C", random_.randbytes(24) + b"\xFF" * 16)

    def received(self, endpoint, data):
        if self.faults.on("slow-boot"):
            return
        self._stream += data
        for command in split_commands(self._stream):
            self.commands += 1
            if self.faults.on("nak") or not self._carry_out(command):
                self.answer(b"00E*ERROR* not understood\r\n")

    def _carry_out(self, command):
        name, rest = command[0], command[1:]
        if command == "P":
            self._single_or_stop()
        elif command == "C":
            self.streaming = True
        elif command in ("F0", "F1"):
            self._binary = command == "F1"
        elif command in ("U0", "U1"):
            self._metric = command == "U1"
        elif command == "U":
            self.answer(f"00U {int(self._in_centimetres)}\r\n".encode())
        elif command == _CONTROL_V:
            self.answer(f"00V {self.strings[2]}\r\n".encode())
        elif command == _CONTROL_U + "0":
            self.answer(f"00{_CONTROL_U}{len(self.poses(time.monotonic()))}\r\n".encode())
        elif command == _CONTROL_Y:
            self.start_anew()
        elif command == "Q0":
            self.counter = 0
            self._clock_zero = time.monotonic()
        elif name == "O":
            return self._choose_fields(rest)
        elif name in _REMEMBERED:
            self.settings[name] = rest
        else:
            return False
        return True

    def _choose_fields(self, rest):
        try:
            fields = tuple(int(field) for field in rest.split(",")[1:])
        except ValueError:
            return False
        if not fields or any(field not in _KNOWN_FIELDS for field in fields):
            return False
        self._fields = fields
        return True

    def _single_or_stop(self):
        if self.streaming:
            self.streaming = False
            return
        now = time.monotonic()
        for frame in self._frames("P", self.counter, now, self.poses(now)):
            self.answer(frame.data)

    @property
    def _in_centimetres(self):
        return self._metric and not self.faults.on("wrong-units")

    def frames(self, counter, time_s, poses):
        return self._frames("C", counter, time_s, poses)

    def _frames(self, command, counter, time_s, poses):
        return [Frame(self._frame(command, counter, time_s, station, pose), {station: pose}, sequence=station)
                for station, pose in poses.items()]

    def _frame(self, command, counter, time_s, station, table_from_sensor):
        good = table_from_sensor is not None
        place = self.in_tracker(table_from_sensor) if good else None
        scale = _CENTIMETRES_IN_METRE if self._in_centimetres else _INCHES_IN_METRE
        position = [float("nan") if self.faults.on("nan") else c * scale for c in place.position] if good else [0.0] * 3
        values = {
            POSITION: position,
            QUATERNION: place.quaternion if good else (1.0, 0.0, 0.0, 0.0),
            TIMESTAMP: (int((self.clock_s(time_s) - self._clock_zero) * 1000) & 0xFFFFFFFF,),
            FRAME_COUNT: (counter,),
            DISTORTION: (int(self.faults.value("distortion") or 0),),
        }
        if not self._binary:
            numbers = " ".join(f"{number:.4f}" for field in self._fields for number in values[field])
            return f"{station:02d}{' ' if good else 'I'} {numbers}\r\n".encode()
        formats = {POSITION: "<3f", QUATERNION: "<4f", TIMESTAMP: "<I", FRAME_COUNT: "<I", DISTORTION: "<i"}
        payload = b"".join(struct.pack(formats[field], *values[field]) for field in self._fields)
        return binary_frame(self.tag, station, command, payload, " " if good else "I")


class PatriotHs(Patriot):
    name = "patriot-hs"
    product_id = 0xEF20
    endpoints = (Endpoint(IN | 8, BULK, 64), Endpoint(4, BULK, 64))
    strings = ("", "Polhemus", "PATRIOT HS (mock)", "mock")


class LibertyHs(PatriotHs):
    name = "liberty-hs"
    tag = b"LY"
    product_id = 0xFF20
    strings = ("", "Polhemus", "LIBERTY HS (mock)", "mock")
    rate_hz = 240.0


class PatriotUnloaded(Patriot):
    """A device before its firmware is loaded: another product id, and no answer."""

    name = "patriot-unloaded"
    product_id = 0xEF11

    def received(self, endpoint, data):
        self.commands += 1
