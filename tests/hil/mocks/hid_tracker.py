"""The HID tracker that anybody can build; docs/hid_tracker.md has every byte. Little-endian."""

import asyncio
import struct

from .crc import crc16_arc
from .faults import Frame, flip
from .tracker import Tracker
from .usb_device import IN, INTERRUPT, Endpoint

POSE_REPORT, DEVICE_REPORT = 1, 2
_SENSOR_MISSING, _STARTING, _FAULT = 1, 2, 4  # bits of the status
_FEATURE_KIND = 3
_VERSION = 1
_UNIT_UM, _WRONG_UNIT_UM = 10, 25
_REPLUG_S = 0.5

_REPORT_DESCRIPTOR = bytes.fromhex(
    "06 46 FF 09 53 A1 01"                                 # usage page 0xFF46, usage 0x53, collection: application
    "85 01 15 00 26 FF 00 75 08 95 03 09 01 81 02"         # report 1: station, status, distortion
    "17 00 00 00 80 27 FF FF FF 7F 75 20 95 02 09 02 81 02"  # counter, time
    "65 11 55 0D 95 03 09 03 81 02"                        # position, centimetres times 10^-3
    "65 00 55 00 16 01 80 26 FF 7F 75 10 95 04 09 04 81 02"  # quaternion
    "16 00 80 95 01 09 05 81 02"                           # CRC
    "85 02 15 00 26 FF 00 75 08 95 09 09 06 B1 02 C0")     # report 2: the device


def with_crc(report):
    return report + struct.pack("<H", crc16_arc(report))


def pose_report(station, counter, time_us, position, quaternion, status=0, distortion=0):
    """The position is in units of the device, the quaternion times 32767."""
    return with_crc(struct.pack("<BBBBII3i4h", POSE_REPORT, station, status, distortion, counter, time_us & 0xFFFFFFFF,
                                *position, *quaternion))


def device_report(unit_um, rate_hz, stations):
    return with_crc(struct.pack("<BBHHBB", DEVICE_REPORT, _VERSION, unit_um, rate_hz, stations, 0))


class HidTracker(Tracker):
    name = "hid"
    vendor_id, product_id = 0x1209, 0x0001  # pid.codes' id for trials
    interface_class = (3, 0, 0)
    endpoints = (Endpoint(IN | 1, INTERRUPT, 64, 1),)
    strings = ("", "FrustumScreen", "HID tracker for FrustumScreen (mock)", "mock")
    report_descriptor = _REPORT_DESCRIPTOR
    max_waiting = 8
    rate_hz = 120.0

    def __init__(self, *args, **kwargs):
        super().__init__(*args, **kwargs)
        self.streaming = True  # it streams without a command, as soon as it has power

    def start_anew(self):
        super().start_anew()
        self.streaming = True

    def lose_units(self):
        """The host asks for the units when it opens the device, so the device starts again."""
        self.start_anew()
        self.link.unplug()
        asyncio.get_running_loop().call_later(_REPLUG_S, self.link.plug)

    @staticmethod
    def break_bytes(data, random_):
        """USB carries a whole report or none, so only its content breaks."""
        return flip(data, random_, begin=1)

    @staticmethod
    def false_start(random_):
        return bytes([POSE_REPORT]) + random_.randbytes(33)

    def get_report(self, kind, number, length):
        self.commands += 1
        if kind != _FEATURE_KIND or number != DEVICE_REPORT or self.faults.on("nak"):
            return None
        return device_report(self._unit_um, int(self.rate_hz), 2)

    def greet(self):
        report = self.get_report(_FEATURE_KIND, DEVICE_REPORT, 64)
        if report:
            self.waiting[IN | 1].clear()
            self.answer(report)

    def poses(self, now):
        """A station without a sensor still reports, like a station without a pose."""
        missing = self.faults.value("sensor-missing")
        return {station: None if station == missing else pose for station, pose in self.player.poses(now).items()}

    @property
    def _unit_um(self):
        return _WRONG_UNIT_UM if self.faults.on("wrong-units") else _UNIT_UM

    def frames(self, counter, time_s, poses):
        return [Frame(self._report(counter, time_s, station, pose), {station: pose}, sequence=station)
                for station, pose in poses.items()]

    def _report(self, counter, time_s, station, table_from_sensor):
        status = (_STARTING if self.faults.on("slow-boot") else 0) | (_FAULT if self.faults.on("built-in-test") else 0)
        position, quaternion = (0, 0, 0), (0, 0, 0, 0)
        if table_from_sensor is None:
            status |= _SENSOR_MISSING
        else:
            place = self.in_tracker(table_from_sensor)
            position = [round(c * 1e6 / self._unit_um) for c in place.position]
            if not self.faults.on("nan"):  # integers are always numbers, so the rotation gets length 0
                quaternion = [round(c * 32767) for c in place.quaternion]
        distortion = int(self.faults.value("distortion") or 0)
        return pose_report(station, counter, round(self.clock_s(time_s) * 1e6), position, quaternion, status, distortion)
