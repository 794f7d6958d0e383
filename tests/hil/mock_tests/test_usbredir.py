import asyncio
import struct
import unittest

from mock_tests.usbredir_host import HELLO_64_BIT, UsbredirHost
from mocks.cp2112 import Cp2112


class Bulk(UsbredirHost):
    async def test_announcement_equals_a_hand_made_one(self):
        await self.hears("00000000 44000000 00000000")
        await self.skips(64)
        await self.hears("7A000000")
        self.says(HELLO_64_BIT)
        zeros = bytes(31)
        await self.hears(bytes.fromhex("04000000 84000000 0000000000000000 01000000 00") + zeros +
                         b"\xff" + zeros + b"\0" + zeros + b"\0" + zeros)
        kinds = bytes([0, 255, 2]) + bytes([255] * 13) + bytes([0, 2]) + bytes([255] * 14)
        sizes = struct.pack("<32H", 64, 0, 64, *[0] * 13, 64, 64, *[0] * 14)
        await self.hears(bytes.fromhex("05000000 A0000000 0000000000000000") + kinds + bytes(64) + sizes)
        await self.hears("01000000 0A000000 0000000000000000 01 00 00 00 3412 7856 0001")

    async def test_an_old_host_gets_short_headers(self):
        await self.skips(12 + 68)
        self.says(bytes.fromhex("00000000 40000000 00000000") + b"old".ljust(64, b"\0"))
        await self.skips(12 + 132 + 12 + 96)
        await self.hears("01000000 08000000 00000000 01 00 00 00 3412 7856")

    async def test_a_control_transfer(self):
        await self.connects()
        self.says("64000000 0A000000 0700000000000000 80 06 80 00 0001 0000 0800")
        await self.hears("64000000 12000000 0700000000000000 80 06 80 00 0001 0000 0800 12 01 0002 00 00 00 40")
        self.says("64000000 0A000000 0800000000000000 80 06 80 00 0006 0000 0A00")  # refused: stalled
        await self.hears("64000000 0A000000 0800000000000000 80 06 80 04 0006 0000 0000")
        self.says("06000000 01000000 0900000000000000 01")
        await self.hears("08000000 02000000 0900000000000000 00 01")

    async def test_bulk_round_trip(self):
        await self.connects()
        self.says("65000000 0A000000 0500000000000000 81 00 0010 00000000 0000")  # read 4096 bytes
        self.says("65000000 0D000000 0600000000000000 02 00 0300 00000000 0000 010203")
        await self.hears("65000000 0A000000 0600000000000000 02 00 0300 00000000 0000")
        await self.hears("65000000 0D000000 0500000000000000 81 00 0300 00000000 0000 030201")

    async def test_a_read_that_is_cancelled_is_answered_once(self):
        await self.connects()
        self.says("65000000 0A000000 0500000000000000 81 00 0010 00000000 0000")
        self.says("15000000 00000000 0500000000000000")
        await self.hears("65000000 0A000000 0500000000000000 81 01 0000 00000000 0000")
        self.says("15000000 00000000 0500000000000000")  # cancels one that is done: no answer
        self.says("65000000 0B000000 0600000000000000 02 00 0100 00000000 0000 09")
        await self.hears("65000000 0A000000 0600000000000000 02 00 0100 00000000 0000")
        self.says("65000000 0A000000 0800000000000000 81 00 0010 00000000 0000")
        await self.hears("65000000 0B000000 0800000000000000 81 00 0100 00000000 0000 09")

    async def test_unplugged_and_back(self):
        await self.connects()
        self.says("65000000 0A000000 0500000000000000 81 00 0010 00000000 0000")
        await asyncio.sleep(0)
        self.link.unplug()
        await self.hears("02000000 00000000 0000000000000000")
        self.says("18000000 00000000 0000000000000000")  # QEMU acknowledges
        self.link.plug()
        await self.skips(16 + 132 + 16 + 160)
        await self.hears("01000000 0A000000 0000000000000000 01 00 00 00 3412 7856 0001")

    async def test_a_device_that_hangs_completes_nothing_until_it_wakes(self):
        await self.connects()
        self.device.hang(True)
        self.says("65000000 0B000000 0600000000000000 02 00 0100 00000000 0000 09")
        self.says("64000000 0A000000 0700000000000000 80 00 80 00 0000 0000 0200")  # endpoint 0 still answers
        await self.hears("64000000 0C000000 0700000000000000 80 00 80 00 0000 0000 0200 0000")
        self.device.hang(False)
        await self.hears("65000000 0A000000 0600000000000000 02 00 0100 00000000 0000")

    async def test_a_port_reset_reaches_the_device(self):
        await self.connects()
        resets = []
        self.device.was_reset = lambda: resets.append(True)
        self.says("03000000 00000000 0000000000000000")
        self.says("64000000 0A000000 0700000000000000 80 00 80 00 0000 0000 0200")
        await self.skips(16 + 12)
        self.assertEqual(resets, [True])

    async def test_a_second_virtual_machine_can_connect(self):
        await self.connects()
        self.writer.close()
        await self.writer.wait_closed()
        while self.link.connected:
            await asyncio.sleep(0.01)
        self.reader, self.writer = await asyncio.open_unix_connection(self.path)
        await self.connects()


class Buttons(UsbredirHost):
    """Interrupt endpoints, feature reports."""

    device_kind = Cp2112

    async def test_a_pressed_button_pulls_its_pin_low(self):
        await self.connects()
        read_pins = "64000000 0A000000 0700000000000000 80 01 A1 00 0303 0000 0200"
        answer = "64000000 0C000000 0700000000000000 80 01 A1 00 0303 0000 0200 03 "
        self.says(read_pins)
        await self.hears(answer + "FF")
        self.device.hold(1, True)
        self.says(read_pins)
        await self.hears(answer + "FD")

    async def test_lamps_follow_the_outputs(self):
        await self.connects()
        self.says("64000000 0F000000 0100000000000000 00 09 21 00 0203 0000 0500 02 80 FF 00 00")  # pin 7 is an output
        await self.hears("64000000 0A000000 0100000000000000 00 09 21 00 0203 0000 0500")
        self.says("64000000 0D000000 0200000000000000 00 09 21 00 0403 0000 0300 04 FF 80")
        await self.hears("64000000 0A000000 0200000000000000 00 09 21 00 0403 0000 0300")
        self.assertEqual(self.device.lamps, 0x80)
        self.assertEqual(self.device.pins(), 0xFF)

    async def test_interrupts_are_sent_once_they_are_asked_for(self):
        await self.connects()
        self.says("0F000000 01000000 0000000000000000 81")
        await self.hears("11000000 02000000 0000000000000000 00 81")
        self.says("67000000 06000000 0300000000000000 01 00 0200 15 01")  # a status request, answered on endpoint 0x81
        await self.hears("67000000 0B000000 0000000000000000 81 00 0700 16 03 00 00 00 00 00")
        await self.hears("67000000 04000000 0300000000000000 01 00 0200")


if __name__ == "__main__":
    unittest.main()
