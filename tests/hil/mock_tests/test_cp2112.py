import asyncio
import os
import time
import types
import unittest

from mocks.buttons_console import ButtonsConsole
from mocks.cp2112 import PINS, Cp2112
from mocks.usb_device import Request

REPORTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "cp2112_reports.txt")


def lines(*verbs):
    with open(REPORTS, encoding="utf-8") as file:
        for line in file:
            verb, _, rest = line.partition("#")[0].strip().partition(" ")
            if verb in verbs:
                given, _, found = rest.partition("=")
                yield verb, given, found


def get(device, number, length):
    return device.control(Request(0xA1, 1, 3 << 8 | number, 0, length))


def set_report(device, report):
    return device.control(Request(0x21, 9, 3 << 8 | report[0], 0, len(report)), report)


class Reports(unittest.TestCase):
    def test_match_those_of_the_linux_driver(self):
        device = Cp2112()
        count = 0
        for verb, given, found in lines("get", "set"):
            count += 1
            if verb == "set":
                self.assertEqual(set_report(device, bytes.fromhex(given)), b"", given)
                continue
            number, length = given.split()
            answer = get(device, int(number, 16), int(length))
            self.assertEqual(len(answer), int(length), given)
            self.assertEqual(answer[0], int(number, 16))
            if found:
                self.assertEqual(answer, bytes.fromhex(found), given)
        self.assertGreater(count, 10)

    def test_special_functions_take_pins_from_buttons(self):
        count = 0
        for _, given, found in lines("functions"):
            count += 1
            device = Cp2112()
            self.assertEqual(set_report(device, bytes.fromhex(given)), b"")
            special = sum(1 << int(pin) for pin in found.split())
            self.assertEqual(device.special_pins(), special, given)
            for pin in range(8):
                device.hold(pin, True)
            self.assertEqual(get(device, 3, 2), bytes([3, special]), "no button pulls it down")
        self.assertEqual(count, 5)


class SpecialCommand(unittest.TestCase):
    def setUp(self):
        self.device = Cp2112()
        self.console = ButtonsConsole(self.device)

    def test_enables_a_special_function_until_power_off(self):
        for pin, byte in ((7, 1), (0, 3), (1, 7)):
            self.console.execute(f"special {pin}")
            self.assertEqual(get(self.device, 2, 5), bytes([2, 0, 0, byte, 0]))
        self.assertEqual(set_report(self.device, b"\x02\x04\xff\x07\x00"), b"")  # as the driver writes: it stays on
        self.assertEqual(self.device.special_pins(), 0x83)
        self.device.start_anew()
        self.assertEqual(get(self.device, 2, 5), bytes([2, 0, 0, 0, 0]))
        self.console.execute("special 1")
        self.console.execute("special off")
        self.assertEqual(self.device.special_pins(), 0)

    def test_rejects_pins_without_a_special_function(self):
        for word in ("2", "8", "all"):
            with self.assertRaises(ValueError) as refused:
                self.console.execute(f"special {word}")
            self.assertIn("0, 1, 7 or off", str(refused.exception))


class PressCommand(unittest.IsolatedAsyncioTestCase):
    async def test_lasts_until_the_host_has_read_it(self):
        device = Cp2112()
        device.link = types.SimpleNamespace(connected=True)
        ButtonsConsole(device).execute("press 1 10ms")
        await asyncio.sleep(0.1)
        self.assertEqual(device.pins(), 0xFD, "it ended before anybody read it")
        before_s, after_s = [], []
        while True:
            asked_s = time.monotonic()
            if get(device, 3, 2) != bytes([3, 0xFD]):
                break
            before_s.append(asked_s)
            after_s.append(time.monotonic())
            await asyncio.sleep(0.005)
        self.assertGreater(after_s[-PINS] - before_s[1], 0.05)

    async def test_outlasts_a_look_at_all_pins_that_begins_late(self):
        device = Cp2112()
        device.link = types.SimpleNamespace(connected=True)
        ButtonsConsole(device).execute("press 1 10ms")
        for _ in range(2):
            get(device, 3, 2)
        await asyncio.sleep(0.2)  # the host gave the guest no time
        for number in range(PINS):
            self.assertEqual(get(device, 3, 2), bytes([3, 0xFD]), f"it ended before read {number} of the look")
            await asyncio.sleep(0.02)
        self.assertEqual(device.pins(), 0xFF)

    async def test_ends_in_time_without_a_host(self):
        device = Cp2112()
        device.link = types.SimpleNamespace(connected=False)
        ButtonsConsole(device).execute("press 1 10ms")
        self.assertEqual(device.pins(), 0xFD)
        while device.pins() == 0xFD:
            await asyncio.sleep(0.005)


if __name__ == "__main__":
    unittest.main()
