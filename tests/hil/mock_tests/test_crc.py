import unittest

from mocks.crc import crc16_arc


class Crc(unittest.TestCase):
    def test_check_value(self):
        self.assertEqual(crc16_arc(b"123456789"), 0xBB3D)

    def test_empty_input(self):
        self.assertEqual(crc16_arc(b""), 0)
