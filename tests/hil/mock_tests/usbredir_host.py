"""A host for the other end of a mock's usbredir link, and a minimal device."""

import asyncio
import os
import tempfile
import unittest

from mocks.usb_device import BULK, IN, Endpoint, UsbDevice
from mocks.usbredir import UsbredirLink

HELLO_64_BIT = bytes.fromhex("00000000 44000000 00000000") + b"test".ljust(64, b"\0") + bytes.fromhex("7A000000")


class Echo(UsbDevice):
    vendor_id, product_id = 0x1234, 0x5678
    endpoints = (Endpoint(IN | 1, BULK, 64), Endpoint(2, BULK, 64))

    def received(self, endpoint, data):
        self.send(IN | 1, data[::-1])


class UsbredirHost(unittest.IsolatedAsyncioTestCase):
    device_kind = Echo  # subclasses may have another

    async def asyncSetUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = os.path.join(self.folder.name, "usbredir")
        self.device = self.device_kind()
        self.link = UsbredirLink(self.device, self.path)
        await self.link.open()
        self.reader, self.writer = await asyncio.open_unix_connection(self.path)

    async def asyncTearDown(self):
        self.writer.close()
        self.link.close()
        self.folder.cleanup()

    async def hears(self, hex_or_bytes):
        expected = bytes.fromhex(hex_or_bytes) if isinstance(hex_or_bytes, str) else hex_or_bytes
        async with asyncio.timeout(30):
            self.assertEqual((await self.reader.readexactly(len(expected))).hex(" "), expected.hex(" "))

    async def skips(self, count):
        async with asyncio.timeout(30):
            await self.reader.readexactly(count)

    def says(self, hex_or_bytes):
        self.writer.write(bytes.fromhex(hex_or_bytes) if isinstance(hex_or_bytes, str) else hex_or_bytes)

    async def connects(self):
        self.says(HELLO_64_BIT)
        await self.skips(12 + 68 + 16 + 132 + 16 + 160 + 16 + 10)
