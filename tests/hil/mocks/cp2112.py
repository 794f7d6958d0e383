"""A Silicon Labs CP2112: a USB bridge whose eight pins hid-cp2112 makes a GPIO chip. Buttons pull pins low.

Reports (Silicon Labs AN495), the number first: 0x02 pin directions and modes, 0x03 pins read, 0x04 pins written, 0x05
part and version, 0x06 SMBus settings, 0x20 strings that may still be written. No SMBus device answers. Pins 0, 1 and 7
have a special function; while it is on, they are no GPIO. Like all settings of 0x02 it is in RAM, and off after a start.
"""

import time

from .usb_device import IN, INTERRUPT, Endpoint, UsbDevice

PINS = 8
SPECIAL = {7: 1, 0: 2, 1: 4}  # pins and their bits in report 0x02: clock output, TX toggle, RX toggle
_DIRECTIONS, _READ_PINS, _WRITE_PINS, _VERSION, _SMBUS, _LOCK, _USB_SETTINGS = 0x02, 0x03, 0x04, 0x05, 0x06, 0x20, 0x21
_STATUS_REQUEST, _STATUS = 0x15, 0x16
_FEATURE, _INPUT, _OUTPUT = 0xB1, 0x81, 0x91  # items of a report descriptor, with one byte of data
_FEATURE_KIND = 3
_REPORTS = (  # number, bytes after it, item
    (_DIRECTIONS, 4, _FEATURE), (_READ_PINS, 1, _FEATURE), (_WRITE_PINS, 2, _FEATURE), (_VERSION, 2, _FEATURE),
    (_SMBUS, 13, _FEATURE), (_LOCK, 1, _FEATURE), (_USB_SETTINGS, 9, _FEATURE),
    (0x10, 3, _OUTPUT), (0x11, 20, _OUTPUT), (0x12, 2, _OUTPUT), (0x13, 62, _INPUT), (0x14, 62, _OUTPUT),
    (_STATUS_REQUEST, 1, _OUTPUT), (_STATUS, 6, _INPUT), (0x17, 1, _OUTPUT))


def report_descriptor():
    described = b"\x06\x00\xff\x09\x01\xa1\x01"  # usage page: vendor's, usage 1, collection: application
    for number, size, item in _REPORTS:
        described += bytes([0x85, number, 0x09, number, 0x15, 0x00, 0x26, 0xFF, 0x00, 0x75, 8, 0x95, size, item, 0x02])
    return described + b"\xc0"


class Cp2112(UsbDevice):
    vendor_id, product_id = 0x10C4, 0xEA90
    interface_class = (3, 0, 0)
    endpoints = (Endpoint(IN | 1, INTERRUPT, 64, 1), Endpoint(1, INTERRUPT, 64, 1))
    strings = ("", "Silicon Laboratories", "CP2112 HID USB-to-SMBus Bridge", "mock")
    report_descriptor = report_descriptor()

    def __init__(self):
        super().__init__()
        self.reads = 0  # how often the host read the pins
        self.lamps = 0  # the levels of pins that the host drives
        self._pressed = 0
        self._read_down_s = [[] for _ in range(PINS)]  # for each pressed pin, when the host read it: the first two times, the last PINS
        self.start_anew()

    def start_anew(self):
        super().start_anew()
        self._features = {
            _DIRECTIONS: bytes(4), _WRITE_PINS: bytes(2), _VERSION: b"\x0c\x02", _LOCK: b"\xff",
            _USB_SETTINGS: bytes(9),
            _SMBUS: b"\x00\x01\x86\xa0\x02\x00\x00\x00\x00\x00\x00\x00\x00"}  # 100 kHz, address 2

    def hold(self, pin, down):
        self._pressed = self._pressed | 1 << pin if down else self._pressed & ~(1 << pin)
        self._read_down_s[pin].clear()

    def noticed_for_s(self, pin):
        """How long the host's driver has known at least that this pin is down. The driver has received a read's answer when it asks for
        the next one. It reads all pins for each line that it is asked for, so that a look at all lines takes up to PINS reads. So this is the
        time from the second read to the one after which a whole look has ended."""
        times_s = self._read_down_s[pin]
        return times_s[2] - times_s[1] if len(times_s) == 2 + PINS else 0.0

    def set_special(self, bits):
        outputs, push_pull, _, divider = self._features[_DIRECTIONS]
        self._features[_DIRECTIONS] = bytes([outputs, push_pull, bits, divider])

    def special_bits(self):
        return self._features[_DIRECTIONS][2]

    def special_pins(self):
        return sum(1 << pin for pin, bit in SPECIAL.items() if self.special_bits() & bit)

    def pins(self):
        """One bit for each pin: inputs are pulled up, and buttons pull them down; outputs have the levels that were written."""
        outputs = self._features[_DIRECTIONS][0]
        gpio = (self.lamps & outputs) | (~self._pressed & ~outputs & 0xFF)
        return gpio | self.special_pins()

    def get_report(self, kind, number, length):
        if kind != _FEATURE_KIND:
            return None
        if number == _READ_PINS:
            self.reads += 1
            for pin, times_s in enumerate(self._read_down_s):
                if self._pressed >> pin & 1:
                    times_s.append(time.monotonic())
                    del times_s[2:-PINS]
            return bytes([number, self.pins()])
        data = self._features.get(number)
        return None if data is None else bytes([number]) + data

    def set_report(self, kind, number, data):
        known = self._features.get(number)
        if kind != _FEATURE_KIND or known is None or len(data) != len(known) + 1:
            return False
        if number == _WRITE_PINS:
            values, mask = data[1], data[2]
            self.lamps = self.lamps & ~mask | values & mask
        self._features[number] = bytes(data[1:])
        return True

    def received(self, endpoint, data):
        if data[:1] == bytes([_STATUS_REQUEST]):
            self.send(IN | 1, bytes([_STATUS, 3, 0, 0, 0, 0, 0]))  # error: no answer
