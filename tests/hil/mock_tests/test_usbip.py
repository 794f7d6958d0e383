import asyncio
import struct
import unittest

from mock_tests.usbredir_host import Echo
from mocks.usbip import UsbipServerLink


class Usbip(unittest.IsolatedAsyncioTestCase):
    async def asyncSetUp(self):
        self.device = Echo()
        self.link = UsbipServerLink(self.device, "127.0.0.1", 0)
        await self.link.open()

    async def asyncTearDown(self):
        self.link.close()

    async def opens(self):
        return await asyncio.open_connection("127.0.0.1", self.link.port)

    async def hears(self, reader, text):
        expected = bytes.fromhex(text)
        async with asyncio.timeout(30):
            self.assertEqual((await reader.readexactly(len(expected))).hex(" "), expected.hex(" "))

    async def imports(self):
        reader, writer = await self.opens()
        writer.write(bytes.fromhex("0111 8003 00000000") + b"1-1".ljust(32, b"\0"))
        await self.hears(reader, "0111 0003 00000000")
        record = await reader.readexactly(312)
        self.assertEqual(record[256:288].rstrip(b"\0"), b"1-1")
        self.assertEqual(record[288:], bytes.fromhex("00000001 00000002 00000002 1234 5678 0100 000000 01 01 01"))
        return reader, writer

    async def test_lists_the_device(self):
        reader, writer = await self.opens()
        writer.write(bytes.fromhex("0111 8005 00000000"))
        await self.hears(reader, "0111 0005 00000000 00000001")
        self.assertEqual((await reader.read())[-4:].hex(), "ff000000")
        writer.close()

    async def test_an_unknown_device_is_refused(self):
        reader, writer = await self.opens()
        writer.write(bytes.fromhex("0111 8003 00000000") + b"9-9".ljust(32, b"\0"))
        await self.hears(reader, "0111 0003 00000001")
        writer.close()

    async def test_answers_hand_made_transfers(self):
        reader, writer = await self.imports()
        head = "{:08X} {:08X} 00010002 {:08X} {:08X} 00000000 {:08X} 00000000 FFFFFFFF 00000000 "
        answer = "{:08X} {:08X} 00000000 00000000 00000000 {:08X} {:08X} 00000000 00000000 00000000 0000000000000000 "
        writer.write(bytes.fromhex(head.format(1, 10, 1, 0, 18) + "80 06 0001 0000 0800"))
        await self.hears(reader, answer.format(3, 10, 0, 8) + "12 01 0002 00 00 00 40")
        writer.write(bytes.fromhex(head.format(1, 11, 1, 0, 18) + "80 06 0006 0000 0A00"))
        await self.hears(reader, answer.format(3, 11, 0xFFFFFFE0, 0))  # -EPIPE
        writer.write(bytes.fromhex(head.format(1, 12, 1, 1, 4096) + "0000000000000000"))
        writer.write(bytes.fromhex(head.format(1, 13, 0, 2, 3) + "0000000000000000 010203"))
        await self.hears(reader, answer.format(3, 13, 0, 3))
        await self.hears(reader, answer.format(3, 12, 0, 3) + "030201")
        writer.write(bytes.fromhex(head.format(1, 14, 1, 1, 4096) + "0000000000000000"))
        unlink = "00000002 {:08X} 00010002 00000000 00000000 {:08X}" + "00" * 24
        for number, status in ((15, "FFFFFF98"), (16, "00000000")):  # -ECONNRESET; the second time it is already done
            writer.write(bytes.fromhex(unlink.format(number, 14)))
            await self.hears(reader, f"00000004 {number:08X} 00000000 00000000 00000000 {status}" + "00" * 24)
        writer.close()

    async def test_unplugging_closes_the_connection(self):
        reader, writer = await self.imports()
        self.assertTrue(self.link.connected)
        self.link.unplug()
        async with asyncio.timeout(30):
            self.assertEqual(await reader.read(), b"")
        writer.close()
        reader, writer = await self.opens()
        writer.write(bytes.fromhex("0111 8005 00000000"))
        self.assertEqual(await reader.read(), struct.pack(">HHII", 0x0111, 5, 0, 0))
        writer.close()
        self.link.plug()
        _, writer = await self.imports()
        writer.close()


if __name__ == "__main__":
    unittest.main()
