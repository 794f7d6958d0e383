"""A camera of the USB Video Class, like a webcam: it sends a test picture, or a picture given by `play`, by bulk transfers.

Source   USB Device Class Definition for Video Devices, revision 1.1: chapters 3 (descriptors), 4.2 (controls), 4.3.1 (probe and
         commit), 2.4.3.3 (payload headers); its payload specifications for uncompressed video and Motion-JPEG. Written only from
         these; the kernel's uvcvideo is the test.
Bulk     a payload is one transfer, so that a short one ends it; uvcvideo takes at most 16384 bytes at once.
"""

import asyncio
import struct
import time

from . import test_picture
from .faults import Faults, Kind
from .usb_device import BULK, HIGH_SPEED, IN, Endpoint, UsbDevice

KINDS = {
    "freeze": Kind(None, None, "repeats the same picture"),
    "slow": Kind(5, (0.2, 120), "so many frames a second, whatever rate was negotiated"),
    "dark": Kind(None, None, "its lens is covered: black with a sensor's noise"),
    "blind": Kind(None, None, "light shines into it: white"),
    "short-frames": Kind(None, None, "each frame lacks its last tenth"),
    "garbage-headers": Kind(None, None, "payload headers of random bytes"),
    "stall": Kind(None, None, "no frames; requests are answered"),
    "hang": Kind(None, None, "sends and accepts nothing, though the cable is in"),
    "stubborn": Kind(None, None, "its exposure stays automatic, whatever it is set to"),
    "unplug": Kind(None, None, "the USB cable is out; plugged in again, it restarts"),
}

STREAM = IN | 1
PAYLOAD_BYTES = 16384
FORMATS = ("yuyv", "mjpeg")  # by their numbers in the descriptors, from 1
SIZES = ((160, 120), (320, 240))  # also by their numbers, from 1
RATES_HZ = {("yuyv", SIZES[0]): (30, 15, 5), ("yuyv", SIZES[1]): (5,), ("mjpeg", SIZES[0]): (30, 15, 5), ("mjpeg", SIZES[1]): (30, 15)}
# As with webcams, a large picture has a high rate only as JPEG.

_CONTROL_INTERFACE, _STREAM_INTERFACE = 0, 1
_TERMINAL, _UNIT, _OUTPUT = 1, 2, 3  # entities
_SET_CUR, _GET_CUR, _GET_MIN, _GET_MAX, _GET_RES, _GET_LEN, _GET_INFO, _GET_DEF = 1, 0x81, 0x82, 0x83, 0x84, 0x85, 0x86, 0x87
_PROBE, _COMMIT = 1, 2
_CLEAR_FEATURE, _SET_INTERFACE = 1, 11
_FID, _EOF, _EOH = 0x01, 0x02, 0x80  # bits of a payload header
_MANUAL, _APERTURE_PRIORITY = 1, 8  # auto exposure modes
AUTO_EXPOSURE, EXPOSURE = (_TERMINAL, 2), (_TERMINAL, 4)  # exposure in 0.1 ms
GAIN, WHITE_BALANCE, AUTO_WHITE_BALANCE = (_UNIT, 4), (_UNIT, 0x0A), (_UNIT, 0x0B)


def _intervals(format_, size):
    """The intervals between frames that this format and size allow, units of 100 ns."""
    return tuple(10_000_000 // rate for rate in RATES_HZ[FORMATS[format_ - 1], SIZES[size - 1]])


class _Control:
    """length, minimum, maximum, step, default."""

    def __init__(self, length, min_value, max_value, step, default):
        self.length, self.default = length, default
        self.answers = {_GET_MIN: min_value, _GET_MAX: max_value, _GET_RES: step, _GET_DEF: default}


_CONTROLS = {
    AUTO_EXPOSURE: _Control(1, 0, 0, _MANUAL | _APERTURE_PRIORITY, _APERTURE_PRIORITY),
    EXPOSURE: _Control(4, 1, 10000, 1, 333),
    GAIN: _Control(2, 0, 255, 1, 32),
    WHITE_BALANCE: _Control(2, 2800, 6500, 10, 4600),
    AUTO_WHITE_BALANCE: _Control(1, 0, 1, 1, 1),
}


def _class_descriptor(subtype, body):
    return struct.pack("<BBB", 3 + len(body), 0x24, subtype) + body


def _control_descriptors():
    body = (_class_descriptor(2, struct.pack("<BHBBHHHB", _TERMINAL, 0x0201, 0, 0, 0, 0, 0, 3) + b"\x0a\x00\x00")
            # auto exposure mode, exposure time
            + _class_descriptor(5, struct.pack("<BBHBHBB", _UNIT, _TERMINAL, 0, 2, 1 << 6 | 1 << 9 | 1 << 12, 0, 0))
            # white balance temperature, gain, white balance temperature auto
            + _class_descriptor(3, struct.pack("<BHBBB", _OUTPUT, 0x0101, 0, _UNIT, 0)))
    header = struct.pack("<HHIBB", 0x0110, 13 + len(body), 48_000_000, 1, _STREAM_INTERFACE)
    return _class_descriptor(1, header) + body


def frame_bytes(size):
    width, height = SIZES[size - 1]
    return 2 * width * height


def _frame_descriptors(subtype, format_):
    body = b""
    for number, (width, height) in enumerate(SIZES, 1):
        intervals = _intervals(format_, number)
        slowest, fastest = (8 * frame_bytes(number) * 10_000_000 // interval for interval in (max(intervals), min(intervals)))
        body += _class_descriptor(subtype, struct.pack(
            "<BBHHIIIIB", number, 0, width, height, slowest, fastest, frame_bytes(number), intervals[0], len(intervals))
            + struct.pack(f"<{len(intervals)}I", *intervals))
    return body


def _stream_descriptors():
    yuy2 = b"YUY2" + bytes.fromhex("0000 1000 8000 00AA00389B71")
    colour = _class_descriptor(0x0D, b"\1\1\4")
    body = (_class_descriptor(4, struct.pack("<BB", 1, len(SIZES)) + yuy2 + struct.pack("<BBBBBB", 16, 1, 0, 0, 0, 0))
            + _frame_descriptors(5, 1) + colour
            + _class_descriptor(6, struct.pack("<BBBBBBBB", 2, len(SIZES), 1, 1, 0, 0, 0, 0)) + _frame_descriptors(7, 2) + colour)
    header_bytes = 13 + len(FORMATS)
    header = struct.pack("<BHBBBBBBB", len(FORMATS), header_bytes + len(body), STREAM, 0, _OUTPUT, 0, 0, 0, 1) + bytes(len(FORMATS))
    return _class_descriptor(1, header) + body


class UvcCamera(UsbDevice):
    vendor_id, product_id = 0x1D6B, 0x0102  # the Linux Foundation's, for a webcam that is a gadget
    version_bcd = 0x0010
    speed = HIGH_SPEED
    interface_class = (0x0E, 1, 0)
    interfaces = ((_CONTROL_INTERFACE, 0x0E, 1, 0), (_STREAM_INTERFACE, 0x0E, 2, 0))
    endpoints = (Endpoint(STREAM, BULK, 512),)
    strings = ("", "FrustumScreen mock", "Mock Camera", "mock")
    max_waiting = 64

    def __init__(self, seed=1):
        super().__init__()
        self.faults = Faults(seed, kinds=KINDS)
        self.counts = {"sent": 0, "skipped": 0}  # frames; skipped: because the host had not yet read the frame before
        self.number = 0  # of the latest frame
        self.played = None  # a picture in place of the test picture: (width, height, luma)
        self.start_anew()

    def start_anew(self):
        super().start_anew()
        self.values = {key: control.default for key, control in _CONTROLS.items()}
        self.probed = self.committed = (1, 1, _intervals(1, 1)[0])  # format, size, interval
        self.streams = False
        self._toggle = 0
        self._frozen = None

    def interface_of(self, endpoint):
        return _STREAM_INTERFACE

    def take(self, endpoint, length):
        """One payload a transfer."""
        queue = self.waiting[endpoint]
        return queue.popleft() if queue and not self.hung and self.link.connected else None

    # Descriptors and requests.

    def device_descriptor(self):
        return struct.pack("<BBHBBBBHHHBBBB", 18, 1, 0x0200, 0xEF, 2, 1, 64, self.vendor_id, self.product_id, self.version_bcd,
                           1, 2, 3, 1)  # "each interface says what it is", with an association

    def configuration_descriptor(self):
        body = (struct.pack("<BBBBBBBB", 8, 0x0B, _CONTROL_INTERFACE, 2, 0x0E, 3, 0, 0)
                + struct.pack("<BBBBBBBBB", 9, 4, _CONTROL_INTERFACE, 0, 0, 0x0E, 1, 0, 0) + _control_descriptors()
                + struct.pack("<BBBBBBBBB", 9, 4, _STREAM_INTERFACE, 0, 1, 0x0E, 2, 0, 0) + _stream_descriptors()
                + struct.pack("<BBBBHB", 7, 5, STREAM, BULK, 512, 0))
        return struct.pack("<BBHBBBBB", 9, 2, 9 + len(body), 2, 1, 0, 0x80, 250) + body

    def control(self, request, data=b""):
        kind = request.kind
        if kind in (0x21, 0xA1):
            interface, entity = request.index & 0xFF, request.index >> 8
            selector = request.value >> 8
            if interface == _STREAM_INTERFACE and entity == 0:
                answer = self._stream_request(request.request, selector, data)
            elif interface == _CONTROL_INTERFACE:
                answer = self._control_request(request.request, (entity, selector), data)
            else:
                answer = None
            return answer if answer is None else answer[:request.length]
        if (kind, request.request) in ((0x02, _CLEAR_FEATURE), (0x01, _SET_INTERFACE)):
            self._stop()  # the host's way to stop a bulk stream
        return super().control(request, data)

    def _control_request(self, request, key, data):
        control = _CONTROLS.get(key)
        if control is None:
            return None
        if request == _SET_CUR and len(data) >= control.length:
            if not (self.faults.on("stubborn") and key == AUTO_EXPOSURE):
                self.values[key] = int.from_bytes(data[:control.length], "little")
            return b""
        if request == _GET_CUR:
            return self.values[key].to_bytes(control.length, "little")
        if request == _GET_LEN:
            return struct.pack("<H", control.length)
        if request == _GET_INFO:
            return b"\3"  # can be read and written
        return control.answers[request].to_bytes(control.length, "little") if request in control.answers else None

    def _stream_request(self, request, selector, data):
        if selector not in (_PROBE, _COMMIT):
            return None
        if request == _SET_CUR and len(data) >= 26:
            self._agree(data)
            if selector == _COMMIT:
                self._begin()
            return b""
        if request == _GET_LEN:
            return struct.pack("<H", 34)
        if request == _GET_INFO:
            return b"\3"
        if request in (_GET_CUR, _GET_MIN, _GET_MAX, _GET_DEF):
            format_, size, interval = self.probed
            offered = _intervals(format_, size)
            interval = {_GET_MIN: min(offered), _GET_MAX: max(offered)}.get(request, interval)
            return struct.pack("<HBBIHHHHHIIIBBBB", 1, format_, size, interval, 0, 0, 0, 0, 0, frame_bytes(size), PAYLOAD_BYTES,
                               48_000_000, 3, 1, 1, 1)
        return None

    def _agree(self, data):
        _, format_, size, interval = struct.unpack_from("<HBBI", data)
        format_, size = min(max(format_, 1), len(FORMATS)), min(max(size, 1), len(SIZES))
        self.probed = (format_, size, min(_intervals(format_, size), key=lambda offered: abs(offered - interval)))

    def _begin(self):
        self.committed, self.streams, self._toggle = self.probed, True, 0
        self.waiting[STREAM].clear()

    def _stop(self):
        self.streams = False
        self.waiting[STREAM].clear()

    # Frames.

    def rate_hz(self):
        return self.faults.value("slow") or 10_000_000 / self.committed[2]

    async def live(self):
        """Sends frames while the host reads them."""
        due = time.monotonic()
        while True:
            due = max(due + 1.0 / self.rate_hz(), time.monotonic() - 0.5)
            await asyncio.sleep(max(0.0, due - time.monotonic()))
            if self.streams and not self.hung and not self.faults.on("stall"):
                self.send_frame()

    def send_frame(self):
        if self.waiting[STREAM]:
            self.counts["skipped"] += 1
            return
        self.number += 1
        self.counts["sent"] += 1
        for payload in self.payloads(self.frame()):
            self.send(STREAM, payload)

    def frame(self):
        """The bytes of the frame of this number, in the agreed format."""
        format_, size, _ = self.committed
        if not self.faults.on("freeze"):
            self._frozen = None
        elif self._frozen is None or self._frozen[0] != self.committed:
            self._frozen = (self.committed, self.number)
        number = self._frozen[1] if self._frozen else self.number
        light = "dark" if self.faults.on("dark") else "blind" if self.faults.on("blind") else "usual"
        if light == "usual" and self.played is not None and self.played[:2] == SIZES[size - 1]:
            luma = test_picture.with_noise(self.played[2], number)
        else:
            luma = test_picture.luma(*SIZES[size - 1], number, light)
        make = test_picture.yuyv if FORMATS[format_ - 1] == "yuyv" else test_picture.jpeg
        data = make(*SIZES[size - 1], luma)
        return data[:len(data) - len(data) // 10] if self.faults.on("short-frames") else data

    def play(self, width, height, luma):
        """Plays this picture from the next frame on, if its size is the negotiated one. Errors: ValueError."""
        if (width, height) not in SIZES:
            sizes = ", ".join(f"{allowed[0]} x {allowed[1]}" for allowed in SIZES)
            raise ValueError(f"the picture is {width} x {height} pixels; allowed are {sizes}")
        self.played = (width, height, luma)

    def payloads(self, data):
        self._toggle ^= _FID
        room = PAYLOAD_BYTES - 2
        parts = [data[begin:begin + room] for begin in range(0, len(data), room)]
        for number, part in enumerate(parts, 1):
            if self.faults.on("garbage-headers"):
                yield self.faults.random.randbytes(12) + part[:room - 10]
            else:
                yield bytes([2, _EOH | self._toggle | (_EOF if number == len(parts) else 0)]) + part

    def status(self):
        format_, size, interval = self.committed
        return {"device": "uvc", "t_ns": time.monotonic_ns(), "connected": self.link.connected, "streams": self.streams,
                "format": FORMATS[format_ - 1], "size": SIZES[size - 1], "rate_hz": 10_000_000 / interval, "number": self.number,
                **self.counts, "plays": self.played is not None, "discarded": self.discarded, "faults": self.faults.active(),
                "auto_exposure": self.values[AUTO_EXPOSURE], "exposure": self.values[EXPOSURE], "gain": self.values[GAIN],
                "auto_white_balance": self.values[AUTO_WHITE_BALANCE], "white_balance": self.values[WHITE_BALANCE]}
