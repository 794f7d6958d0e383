import struct
import unittest

from mocks.faults import Faults
from mocks.hid_tracker import HidTracker
from mocks.patriot import LibertyHs, Patriot, PatriotUnloaded
from mocks.player import Player
from mocks.pose import Pose
from mocks.usb_device import IN, Request
from mocks.viper import Viper, split_commands

# Put together by hand; the CRCs come from long division over the bits.
CONTINUOUS_SET = bytes.fromhex("56505243 18000000 FFFFFFFF 13000000 00000000 FFFFFFFF 00000000 761D0000")
UNITS_SET = bytes.fromhex("56505243 20000000 FFFFFFFF 07000000 00000000 FFFFFFFF 00000000 03000000 02000000 AB820000")


def long_division(data):
    remainder = 0
    for byte in data:
        for bit in range(8):
            one = (remainder ^ byte >> bit) & 1
            remainder = remainder >> 1 ^ 0xA001 if one else remainder >> 1
    return struct.pack("<I", remainder)


def command(number, action, payload=b"", arg1=0, arg2=0):
    whole = struct.pack("<4sIIIIII", b"VPRC", 24 + len(payload), 0xFFFFFFFF, number, action, arg1, arg2) + payload
    return whole + long_division(whole)


class Talk:
    """A device without a link: the bytes that it sends stay in its queue."""

    def __init__(self, kind, endpoint_out=2):
        self.player = Player()
        self.faults = Faults()
        self.device = kind(self.player, self.faults)
        self._out = endpoint_out
        self._in = next(iter(self.device.waiting))

    def say(self, data):
        self.device.received(self._out, data)
        return self.heard()

    def heard(self):
        return self.device.take(self._in, 65536)


class ViperBytes(unittest.TestCase):
    def setUp(self):
        self.talk = Talk(Viper)

    def set_up(self):
        for number, payload in ((7, struct.pack("<II", 3, 2)), (6, struct.pack("<I", 2))):
            self.talk.say(command(number, 0, payload))
        self.talk.say(command(19, 0))

    def test_parses_hand_made_commands(self):
        for data, number in ((CONTINUOUS_SET, 19), (UNITS_SET, 7)):
            self.assertEqual(long_division(data[:-4]), data[-4:])
            self.assertEqual([found[:2] for found in split_commands(bytearray(data))], [(number, 0)])

    def test_a_pose_frame_equals_a_hand_made_one(self):
        self.set_up()
        self.talk.player.place(2, Pose((0.25, -0.5, 1.0), (0.5, 0.5, -0.5, 0.5)))
        self.talk.player.place(1, Pose((0.0, 2.0, -0.125)))
        self.talk.faults.tell("distortion", ["200"])
        self.talk.device.step(0.0)
        expected = bytes.fromhex(
            "56505250 54000000 61AE0A00 01000000 00000000 02000000"
            "000B3200 00000000 00000040 000000BE 0000803F 00000000 00000000 00000000"
            "010B3200 0000803E 000000BF 0000803F 0000003F 0000003F 000000BF 0000003F")
        self.assertEqual(self.talk.heard(), expected + long_division(expected))

    def test_an_answer_equals_a_hand_made_one(self):
        expected = bytes.fromhex("56505243 18000000 61AE0A00 13000000 03000000 00000000 00000000")
        self.assertEqual(self.talk.say(CONTINUOUS_SET), expected + long_division(expected))

    def test_settings_are_kept_until_power_off(self):
        self.talk.say(UNITS_SET)
        self.assertEqual(self.talk.say(command(7, 1))[28:36], struct.pack("<II", 3, 2))
        self.talk.device.start_anew()
        self.assertEqual(self.talk.say(command(7, 1))[28:36], struct.pack("<II", 0, 0))

    def test_switches_off_each_filter_and_reads_it_back(self):
        def filters():
            return [struct.unpack("<I", self.talk.say(command(1, 1, arg2=which))[28:32])[0] for which in (1, 2)]

        off = bytes(20)
        self.assertEqual(filters(), [2, 2])
        self.talk.say(command(1, 0, off, arg2=1))
        self.assertEqual(filters(), [0, 2])
        self.talk.say(command(1, 0, off))
        self.assertEqual(filters(), [0, 0])
        self.talk.faults.tell("filter-stays", [])
        self.assertEqual(filters(), [2, 2])

    def test_without_a_set_up_it_sends_inches_and_angles(self):
        self.talk.say(CONTINUOUS_SET)
        self.talk.player.place(1, Pose((0.0254, 0.0, -0.0508), (0.7071067811865476, 0.0, 0.0, 0.7071067811865476)))
        self.talk.device.step(0.0)
        record = struct.unpack("<I7f", self.talk.heard()[24:56])
        self.assertEqual(record[0], 0)
        for found, expected in zip(record[1:], (1.0, 0.0, -2.0, 90.0, 0.0, 0.0, 0.0)):
            self.assertAlmostEqual(found, expected, places=4)

    def test_parses_split_commands_after_garbage(self):
        self.assertIsNone(self.talk.say(b"VPRxVPRC" + CONTINUOUS_SET[:10]))
        self.assertIsNone(self.talk.say(CONTINUOUS_SET[10:20]))
        self.assertIsNotNone(self.talk.say(CONTINUOUS_SET[20:]))
        self.assertTrue(self.talk.device.streaming)

    def test_ignores_corrupt_commands(self):
        for at in range(4, len(CONTINUOUS_SET)):
            broken = bytearray(CONTINUOUS_SET)
            broken[at] ^= 4
            self.talk.say(bytes(broken))
        self.assertFalse(self.talk.device.streaming)

    def test_rejects_invalid_commands(self):
        for bad in (command(6, 0, struct.pack("<I", 6)), command(7, 0, b"\0"), command(99, 0), command(7, 3),
                    command(1, 1), command(1, 1, arg2=3), command(1, 0, bytes(16)), command(0, 1, arg1=0xFFFFFFFF)):
            answer = self.talk.say(bad)
            self.assertEqual(struct.unpack("<I", answer[16:20]), (4,))
            self.assertEqual(struct.unpack("<I", answer[28:32]), (2,))
            self.assertEqual(len(answer), 32 + 180)

    def test_reports_that_it_boots(self):
        self.talk.faults.tell("slow-boot", [])
        self.assertEqual(struct.unpack("<I", self.talk.say(CONTINUOUS_SET)[28:32]), (1,))

    def test_whoami_answer_has_its_length(self):
        self.assertEqual(len(self.talk.say(command(20, 1))), 32 + 192)

    def test_a_single_pose_has_its_count_at_40_and_its_record_at_44(self):
        self.set_up()
        answer = self.talk.say(command(18, 1))
        self.assertEqual(answer[:4], b"VPRC")
        self.assertEqual(struct.unpack("<I", answer[40:44]), (1,))
        self.assertEqual(len(answer), 44 + 32 + 4)


class PatriotBytes(unittest.TestCase):
    def setUp(self):
        self.talk = Talk(Patriot)

    def test_answers_text_commands(self):
        self.assertEqual(self.talk.say(b"U\r"), b"00U 0\r\n")
        self.assertIsNone(self.talk.say(b"U1\rX0,1,0,0\r@B0\rH*,1,0,0\r"))
        self.assertEqual(self.talk.say(b"U\r"), b"00U 1\r\n")
        self.assertIn(b"PATRIOT", self.talk.say(b"\x16\r"))
        self.assertIn(b"ERROR", self.talk.say(b"?\r"))
        self.assertIn(b"ERROR", self.talk.say(b"O*,2,4\r"))

    def test_a_frame_equals_a_hand_made_one(self):
        self.assertIsNone(self.talk.say(b"U1\rO*,8,9,11,3,7\rF1\rC\r"))
        self.talk.player.place(1, Pose((0.25, -0.5, 1.0), (0.5, 0.5, -0.5, 0.5)))
        self.talk.device.step(self.talk.device._clock_zero + 1.5)
        self.assertEqual(self.talk.heard(), bytes.fromhex(
            "5041 01 43 20 00 2800 DC050000 01000000 00000000"
            "0000C841 000048C2 0000C842 0000003F 0000003F 000000BF 0000003F"))

    def test_p_stops_streaming_or_requests_one_pose(self):
        self.talk.say(b"F1\rC\r")
        self.assertIsNone(self.talk.say(b"P"))
        self.assertFalse(self.talk.device.streaming)
        self.assertEqual(self.talk.say(b"P")[:4], b"PA\x01P")

    def test_a_missing_pose_has_an_error_code(self):
        self.talk.say(b"F1\rC\r")
        self.talk.player.place(1, None)
        self.talk.device.step(0.0)
        self.assertNotEqual(self.talk.heard()[4:5], b" ")

    def test_a_liberty_frame_begins_with_its_name(self):
        talk = Talk(LibertyHs, 4)
        talk.say(b"F1\rC\r")
        talk.device.step(0.0)
        self.assertEqual(talk.heard()[:2], b"LY")

    def test_is_silent_without_firmware(self):
        self.assertIsNone(Talk(PatriotUnloaded).say(b"\x16\rP"))
        self.assertEqual(PatriotUnloaded.product_id, 0xEF11)


class HidBytes(unittest.TestCase):
    """The two examples of docs/hid_tracker.md."""

    def setUp(self):
        self.talk = Talk(HidTracker)

    def test_the_pose_report(self):
        half = 0.7071067811865476
        self.talk.player.place(1, Pose((0.1, -0.05, 0.12), (half, 0.0, 0.0, half)))
        self.talk.device.counter = 999
        self.talk.device.step(2.0)
        self.assertEqual(self.talk.heard(), bytes.fromhex(
            "01 01 00 00 E8 03 00 00 80 84 1E 00 10 27 00 00 78 EC FF FF E0 2E 00 00 82 5A 00 00 00 00 82 5A 4C 2F"))

    def test_the_device_report(self):
        request = Request(0xA1, 1, 0x0302, 0, 64)
        self.assertEqual(self.talk.device.control(request), bytes.fromhex("02 01 0A 00 78 00 02 00 88 73"))

    def test_a_missing_sensor_still_reports(self):
        self.talk.faults.tell("sensor-missing", ["1"])
        self.talk.device.step(0.0)
        self.assertEqual(self.talk.heard()[2], 1)


class Descriptors(unittest.TestCase):
    def test_viper_descriptors_equal_hand_made_ones(self):
        device = Talk(Viper).device
        self.assertEqual(device.control(Request(0x80, 6, 0x0100, 0, 18)), bytes.fromhex(
            "12 01 0002 00 00 00 40 440F 01BF 0001 01 02 03 01"))
        whole = device.control(Request(0x80, 6, 0x0200, 0, 255))
        self.assertEqual(whole, bytes.fromhex(
            "09 02 2000 01 01 00 80 32 09 04 00 00 02 FF 00 00 00 07 05 81 02 4000 00 07 05 02 02 4000 00"))
        self.assertEqual(device.control(Request(0x80, 6, 0x0200, 0, 9)), whole[:9])
        self.assertEqual(device.control(Request(0x80, 6, 0x0301, 0x0409, 255)), b"\x12\x03P\0o\0l\0h\0e\0m\0u\0s\0")
        self.assertIsNone(device.control(Request(0x80, 6, 0x0600, 0, 10)))  # device qualifier: full speed only

    def test_a_slow_host_catches_up_in_one_transfer(self):
        device = Talk(Viper).device
        for k in range(5):
            device.send(IN | 1, bytes([k]) * 3)
        self.assertEqual(device.take(IN | 1, 7), b"\0\0\0\1\1\1\2")
        self.assertEqual(device.take(IN | 1, 64), b"\2\2\3\3\3\4\4\4")
        self.assertIsNone(device.take(IN | 1, 64))

    def test_a_report_is_a_transfer_of_its_own(self):
        device = Talk(HidTracker).device
        device.send(IN | 1, b"one")
        device.send(IN | 1, b"two")
        self.assertEqual(device.take(IN | 1, 64), b"one")

    def test_discards_the_oldest_unread_reports(self):
        device = Talk(HidTracker).device
        for k in range(20):
            device.send(IN | 1, bytes([k]))
        self.assertEqual(device.take(IN | 1, 64), bytes([12]))
        self.assertEqual(device.discarded, 12)


if __name__ == "__main__":
    unittest.main()
