"""A Polhemus VIPER: frames of poses, commands and their answers. Little-endian throughout.

Frame: preamble, u32 size of the rest, body, u32 CRC of all bytes before it. 'VPRP' are poses: u32 serial,
u32 counter, u32 info, u32 sensor count, then 32 bytes each sensor. 'VPRC' are commands and answers: u32 serial,
u32 command, u32 action, u32 arg1, u32 arg2, payload.
"""

import math
import struct
import time

from .crc import crc16_arc
from .faults import Frame, flip_or_cut
from .pose import euler_deg
from .tracker import Tracker
from .usb_device import BULK, IN, Endpoint

HEMISPHERE, FILTER, FRAME_RATE, UNITS, SINGLE, CONTINUOUS, WHO_AM_I = 0, 1, 6, 7, 18, 19, 20
SET, GET, RESET, ACK, NAK, NAK_WARNING = range(6)
NAK_GENERAL, NAK_BOOTING, NAK_COMMAND = range(3)
BOTH, TURNS, PLACES = range(3)  # the target of a filter; BOTH can be set and reset, but not read
MEDIUM = 2  # one of the filters' levels
ALL_SENSORS = 0xFFFFFFFF  # can be set and reset, but not read
INCHES, FEET, CENTIMETRES, METRES = range(4)
DEGREES, RADIANS, QUATERNION = range(3)
SERIAL = 700001
_UNITS_IN_METRE = {INCHES: 1 / 0.0254, FEET: 1 / 0.3048, CENTIMETRES: 100.0, METRES: 1.0}
_FASTEST_RATE = 5  # 30 Hz << 5
_HEAD_BYTES, _CRC_BYTES, _COMMAND_BYTES = 8, 4, 20


def framed(preamble, body):
    whole = preamble + struct.pack("<I", len(body) + _CRC_BYTES) + body
    return whole + struct.pack("<I", crc16_arc(whole))


def sensor_record(station, position, orientation, units, distortion=0):
    info = station - 1 | units[0] << 8 | units[1] << 10 | distortion << 14
    return struct.pack("<I3f4f", info, *position, *orientation)


def pose_body(counter, records, fault=0):
    return struct.pack("<IIII", SERIAL, counter, fault << 4, len(records)) + b"".join(records)


def answer_frame(command, action, payload=b""):
    return framed(b"VPRC", struct.pack("<IIIII", SERIAL, command, action, 0, 0) + payload)


def nak_payload(code, text):
    return struct.pack("<I128s48x", code, text.encode())


def split_commands(stream):
    """Takes whole commands off a bytearray: a list of (command, action, arg1, arg2, payload); garbage is skipped."""
    found = []
    while True:
        start = stream.find(b"VPRC")
        if start < 0:
            del stream[:max(0, len(stream) - 3)]
            return found
        del stream[:start]
        if len(stream) < _HEAD_BYTES:
            return found
        size = struct.unpack_from("<I", stream, 4)[0]
        if not _COMMAND_BYTES + _CRC_BYTES <= size <= 1024:
            del stream[:4]
            continue
        whole = _HEAD_BYTES + size
        if len(stream) < whole:
            return found
        data = bytes(stream[:whole])
        if struct.unpack_from("<I", data, whole - _CRC_BYTES)[0] != crc16_arc(data[:-_CRC_BYTES]):
            del stream[:4]
            continue
        del stream[:whole]
        _, command, action, arg1, arg2 = struct.unpack_from("<IIIII", data, _HEAD_BYTES)
        found.append((command, action, arg1, arg2, data[_HEAD_BYTES + _COMMAND_BYTES:-_CRC_BYTES]))


class Viper(Tracker):
    name = "viper"
    vendor_id, product_id = 0x0F44, 0xBF01
    endpoints = (Endpoint(IN | 1, BULK, 64), Endpoint(2, BULK, 64))
    strings = ("", "Polhemus", "VIPER (mock)", "mock")
    break_bytes = staticmethod(flip_or_cut)

    # Settings after power-on, by command and filter target.
    _defaults = {
        (HEMISPHERE, 0): struct.pack("<I3f", 0, 1.0, 0.0, 0.0),
        (FILTER, TURNS): struct.pack("<I4f", MEDIUM, 0.0, 0.0, 0.0, 0.0),
        (FILTER, PLACES): struct.pack("<I4f", MEDIUM, 0.0, 0.0, 0.0, 0.0),
        (FRAME_RATE, 0): struct.pack("<I", 3),
        (UNITS, 0): struct.pack("<II", INCHES, DEGREES),
    }

    def __init__(self, *args, **kwargs):
        super().__init__(*args, **kwargs)
        self.start_anew()

    def start_anew(self):
        super().start_anew()
        self.settings = dict(self._defaults)
        self._stream = bytearray()

    @property
    def rate_hz(self):
        return 30.0 * (1 << struct.unpack("<I", self.settings[FRAME_RATE, 0])[0])

    @property
    def units(self):
        position, orientation = struct.unpack("<II", self.settings[UNITS, 0])
        return (INCHES if self.faults.on("wrong-units") else position, orientation)

    def status(self):
        levels = {name: struct.unpack_from("<I", self.settings[FILTER, which])[0]
                  for name, which in (("orientation", TURNS), ("position", PLACES))}
        return {**super().status(), "filter_levels": levels}

    def received(self, endpoint, data):
        self._stream += data
        for command in split_commands(self._stream):
            self.commands += 1
            self.answer(self._answer(*command))

    def _answer(self, command, action, sensor, target, payload):
        if self.faults.on("slow-boot"):
            return answer_frame(command, NAK, nak_payload(NAK_BOOTING, "the system is booting"))
        if self.faults.on("nak"):
            return answer_frame(command, NAK, nak_payload(NAK_COMMAND, "refused"))
        known = False
        answer = b""
        settings = [(command, which) for which in self._filters(target)] if command == FILTER else [(command, 0)]
        if action == GET and (self.faults.on("nak-questions") or command in (HEMISPHERE, FILTER)
                              and (sensor == ALL_SENSORS or len(settings) != 1)):
            return answer_frame(command, NAK, nak_payload(NAK_COMMAND, "refused"))
        if command == CONTINUOUS and action in (SET, RESET):
            known = True
            self.streaming = action == SET
        elif command == WHO_AM_I and action == GET:
            known = True
            answer = struct.pack("<64s32s32s32s32s", b"VIPER mock", b"700001", b"mock", b"mock", b"mock")
        elif command == SINGLE and action == GET:
            known = True
            answer = self._body(self.counter, self.poses(time.monotonic()))
        elif all(setting in self.settings for setting in settings):
            known = action in (GET, RESET) or action == SET and self._allowed(settings[0], payload)
            if known and action == GET:
                answer = self._in_use(settings[0])
            elif known:
                self.settings.update((setting, payload if action == SET else self._defaults[setting])
                                     for setting in settings)
        if known and action == SET and self.faults.on("warn"):
            return answer_frame(command, NAK_WARNING, nak_payload(NAK_GENERAL, "a warning"))
        if known:
            return answer_frame(command, ACK, answer)
        return answer_frame(command, NAK, nak_payload(NAK_COMMAND, "unknown command or payload"))

    @staticmethod
    def _filters(target):
        return (TURNS, PLACES) if target == BOTH else (target,)

    def _in_use(self, setting):
        if setting[0] == UNITS:
            return struct.pack("<II", *self.units)
        kept = self._defaults if setting[0] == FILTER and self.faults.on("filter-stays") else self.settings
        return kept[setting]

    def _allowed(self, setting, payload):
        command = setting[0]
        if len(payload) != len(self._defaults[setting]):
            return False
        if command == FRAME_RATE:
            return struct.unpack("<I", payload)[0] <= _FASTEST_RATE
        if command == UNITS:
            position, orientation = struct.unpack("<II", payload)
            return position <= METRES and orientation <= QUATERNION
        return True

    def frames(self, counter, time_s, poses):
        return [Frame(framed(b"VPRP", self._body(counter, poses)), poses)]

    @staticmethod
    def false_start(random_):
        """Noise with a header whose size fits its sensors, or is the largest of an answer, or is impossible."""
        count = random_.randrange(17)
        preamble, size = random_.choice(((b"VPRP", 20 + 32 * count), (b"VPRC", 1048), (b"VPRP", 0xFFFFFFFF),
                                         (b"VPRC", 0)))
        return preamble + struct.pack("<IIIII", size, SERIAL, 0, 0, count) + random_.randbytes(random_.randrange(40))

    def _body(self, counter, poses):
        return pose_body(counter, self._records(poses), int(self.faults.value("built-in-test") or 0))

    def _records(self, poses):
        distortion = int(self.faults.value("distortion") or 0)
        nan = self.faults.on("nan")
        return [self._record(station, pose, distortion, nan) for station, pose in poses.items() if pose]

    def _record(self, station, pose, distortion, nan):
        units = self.units
        place = self.in_tracker(pose)
        scale = _UNITS_IN_METRE[units[0]]
        position = [float("nan") if nan else c * scale for c in place.position]
        orientation = place.quaternion
        if units[1] != QUATERNION:
            turn = math.pi / 180 if units[1] == RADIANS else 1.0
            orientation = (*(angle * turn for angle in euler_deg(place.quaternion)), 0.0)
        return sensor_record(station, position, orientation, units, distortion)
