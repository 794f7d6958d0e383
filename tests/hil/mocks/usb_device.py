"""A USB device as its host sees it: descriptors, requests on endpoint 0, bytes in and out of the others.

It knows no transport: a link (usbredir, USB/IP, raw bytes) carries its endpoints to a host. One thread, asyncio's.
"""

import collections
import struct
from typing import NamedTuple

IN = 0x80
BULK, INTERRUPT = 2, 3
LOW_SPEED, FULL_SPEED, HIGH_SPEED = 0, 1, 2

_GET_STATUS, _CLEAR_FEATURE, _SET_FEATURE, _GET_DESCRIPTOR = 0, 1, 3, 6
_GET_CONFIGURATION, _SET_CONFIGURATION, _GET_INTERFACE, _SET_INTERFACE = 8, 9, 10, 11
_DEVICE, _CONFIGURATION, _STRING, _HID, _REPORT = 1, 2, 3, 0x21, 0x22
_HID_GET_REPORT, _HID_SET_REPORT, _HID_SET_IDLE, _HID_SET_PROTOCOL = 1, 9, 10, 11


class Endpoint(NamedTuple):
    address: int  # 0x80 and above: to the host
    kind: int
    packet_bytes: int
    interval: int = 0  # of interrupt endpoints, milliseconds


class Request(NamedTuple):
    """The set-up packet of a control transfer."""

    kind: int
    request: int
    value: int
    index: int
    length: int

    @staticmethod
    def parse(data):
        return Request(*struct.unpack("<BBHHH", data))


class UsbDevice:
    """The common part of devices; subclasses add their own part, and a subclass with several interfaces also their descriptors."""

    vendor_id = product_id = 0
    version_bcd = 0x0100
    speed = FULL_SPEED
    interface_class = (0xFF, 0, 0)  # class, subclass, protocol
    endpoints = ()
    strings = ("", "", "", "")  # by index: none, maker, product, serial number
    report_descriptor = b""  # HID only
    max_waiting = 32  # transfers that are kept for a host that does not read; beyond that the oldest are lost

    def __init__(self):
        self.link = None
        self.hung = False
        self.discarded = 0
        self.waiting = {e.address: collections.deque() for e in self.endpoints if e.address & IN}
        self._streams = {e.address for e in self.endpoints if e.kind == BULK}

    @property
    def interfaces(self):
        """(number, class, subclass, protocol) of each interface."""
        return ((0, *self.interface_class),)

    # For subclasses to override.

    def interface_of(self, endpoint):
        """The number of the interface to which an endpoint belongs."""
        return 0

    def received(self, endpoint, data):
        """Called when the host has sent bytes to an OUT endpoint."""

    def get_report(self, kind, number, length):
        """HID: the report's bytes, the number first; None refuses."""

    def set_report(self, kind, number, data):
        """HID: takes a report from the host; returns whether it is accepted."""
        return False

    def start_anew(self):
        """Restarts the device as if it were switched off and on: all settings are lost."""
        for queue in self.waiting.values():
            queue.clear()

    def was_reset(self):
        """Called when the host has reset the device's port."""

    def greet(self):
        """On a link without endpoint 0: sends what a host would ask for when it opens the device."""

    # Used by links.

    def send(self, endpoint, data):
        """Sends to the host, as one transfer."""
        queue = self.waiting[endpoint]
        if len(queue) >= self.max_waiting:
            queue.popleft()
            self.discarded += 1
        queue.append(data)
        if self.link and not self.hung:
            self.link.data_waiting(endpoint)

    def take(self, endpoint, length):
        """At most `length` bytes for the host, or None.

        An interrupt endpoint gives one report; a bulk endpoint gives all waiting bytes, so that a slow host catches up.
        """
        queue = self.waiting[endpoint]
        if not queue or self.hung:
            return None
        data = queue.popleft()
        while endpoint in self._streams and queue and len(data) < length:
            data += queue.popleft()
        if endpoint in self._streams and len(data) > length:
            queue.appendleft(data[length:])
        return data[:length]

    def hang(self, hung):
        self.hung = hung
        if not hung and self.link:
            self.link.woke_up()

    def control(self, request, data=b""):
        """A control transfer: returns the bytes of an IN request, b'' for an accepted OUT request, None: stalled."""
        kind = request.kind
        if kind & 0x60 == 0:
            answer = self._standard(request)
        elif kind == 0xA1 and request.request == _HID_GET_REPORT:
            answer = self.get_report(request.value >> 8, request.value & 0xFF, request.length)
        elif kind == 0x21 and request.request == _HID_SET_REPORT:
            answer = b"" if self.set_report(request.value >> 8, request.value & 0xFF, data) else None
        elif kind == 0x21 and request.request in (_HID_SET_IDLE, _HID_SET_PROTOCOL) and self.report_descriptor:
            answer = b""
        else:
            answer = None
        return answer if answer is None else answer[:request.length]

    def _standard(self, request):
        if request.request == _GET_DESCRIPTOR:
            return self._descriptor(request.value >> 8, request.value & 0xFF)
        if request.request == _GET_STATUS:
            return b"\0\0"
        if request.request == _GET_CONFIGURATION:
            return b"\1"
        if request.request == _GET_INTERFACE:
            return b"\0"
        if request.request in (_CLEAR_FEATURE, _SET_FEATURE, _SET_CONFIGURATION, _SET_INTERFACE):
            return b""
        return None

    def _descriptor(self, kind, index):
        if kind == _DEVICE:
            return self.device_descriptor()
        if kind == _CONFIGURATION:
            return self.configuration_descriptor()
        if kind == _STRING and index == 0:
            return b"\x04\x03\x09\x04"  # English
        if kind == _STRING and index < len(self.strings):
            text = self.strings[index].encode("utf-16-le")
            return bytes([2 + len(text), _STRING]) + text
        if kind == _HID and self.report_descriptor:
            return self._hid_descriptor()
        if kind == _REPORT and self.report_descriptor:
            return self.report_descriptor
        return None

    def device_descriptor(self):
        return struct.pack("<BBHBBBBHHHBBBB", 18, _DEVICE, 0x0200, 0, 0, 0, 64, self.vendor_id, self.product_id,
                           self.version_bcd, 1, 2, 3, 1)

    @property
    def described_endpoints(self):
        return self.endpoints

    def configuration_descriptor(self):
        body = struct.pack("<BBBBBBBBB", 9, 4, 0, 0, len(self.described_endpoints), *self.interface_class, 0)
        if self.report_descriptor:
            body += self._hid_descriptor()
        for e in self.described_endpoints:
            body += struct.pack("<BBBBHB", 7, 5, e.address, e.kind, e.packet_bytes, e.interval)
        return struct.pack("<BBHBBBBB", 9, _CONFIGURATION, 9 + len(body), 1, 1, 0, 0x80, 50) + body

    def _hid_descriptor(self):
        return struct.pack("<BBHBBBH", 9, _HID, 0x0111, 0, 1, _REPORT, len(self.report_descriptor))


class Transfers:
    """A host's transfers that wait for the device, by endpoint; each has the host's own identifier."""

    def __init__(self, device):
        self._device = device
        self.clear()

    def clear(self):
        self._reads = {}  # endpoint -> (identifier, length)
        self._writes = collections.deque()

    def read(self, endpoint, identifier, length):
        self._reads.setdefault(endpoint, collections.deque()).append((identifier, length))

    def write(self, endpoint, identifier, data):
        self._writes.append((endpoint, identifier, data))

    def cancel(self, identifier):
        """Cancels a transfer; returns the endpoint at which it waited, or None if it is already done."""
        for endpoint, queue in self._reads.items():
            for item in queue:
                if item[0] == identifier:
                    queue.remove(item)
                    return endpoint
        for item in self._writes:
            if item[1] == identifier:
                self._writes.remove(item)
                return item[0]
        return None

    def ready_reads(self, endpoint):
        """(identifier, data) of reads that the device can serve now."""
        queue = self._reads.get(endpoint, ())
        while queue and (data := self._device.take(endpoint, queue[0][1])) is not None:
            yield queue.popleft()[0], data

    def ready_writes(self):
        """(endpoint, identifier, data) of writes that the device takes; a hung device takes none."""
        while self._writes and not self._device.hung:
            yield self._writes.popleft()
