"""Compares the mocks with bytes that were made with the makers' headers; the driver's tests read the same files."""

import os
import unittest

from mock_tests.test_trackers import Talk
from mocks.patriot import LibertyHs, Patriot
from mocks.pose import Pose
from mocks.usb_device import Request
from mocks.viper import Viper, split_commands

_FOLDER = os.path.join(os.path.dirname(__file__), "..", "..", "tracker", "fixtures")
TURNED = (0.5, 0.5, -0.5, 0.5)


def fixtures(file):
    """{name: bytes}."""
    found, name = {}, None
    with open(os.path.join(_FOLDER, file), encoding="ascii") as lines:
        for line in lines:
            if line.startswith(" "):
                found[name] += bytes.fromhex(line)
            elif not line.startswith("#"):
                name = line.strip()
                found[name] = b""
    return found


class ViperFixtures(unittest.TestCase):
    def setUp(self):
        self.talk = Talk(Viper)
        self.bytes = fixtures("viper.txt")

    def answers(self, command, answer):
        self.assertEqual(self.talk.say(self.bytes[command]).hex(), self.bytes[answer].hex(), command)

    def set_up(self):
        for command, answer in (
                ("host.stop", "answer.continuous"), ("host.whoami", "answer.whoami"),
                ("host.units.set", "answer.units.set"), ("host.units.get", "answer.units.get"),
                ("host.hemisphere.set", "answer.hemisphere.set"), ("host.hemisphere.get", "answer.hemisphere.get"),
                ("host.filter.get.position", "answer.filter.get.medium"), ("host.filter.set", "answer.filter.set"),
                ("host.filter.get.orientation", "answer.filter.get"), ("host.filter.get.position", "answer.filter.get"),
                ("host.frame_rate.set", "answer.frame_rate.set"), ("host.frame_rate.get", "answer.frame_rate.get"),
                ("host.start", "answer.continuous")):
            self.answers(command, answer)

    def sends(self, counter, name):
        self.talk.device.counter = counter - 1
        self.talk.device.step(0.0)
        self.assertEqual(self.talk.heard().hex(), self.bytes[name].hex(), name)

    def place(self, *positions):
        for station in range(1, 17):
            self.talk.player.place(station, None)
        for station, position in enumerate(positions, 1):
            self.talk.player.place(station, Pose(position, TURNED))

    def test_answers_a_set_up_as_in_the_fixture(self):
        self.set_up()

    def test_sends_poses_as_in_the_fixture(self):
        self.set_up()
        self.place()
        self.sends(1, "pose.none")
        self.place((0.25, -0.5, 1.0))
        self.sends(2, "pose.one")
        self.talk.faults.tell("distortion", ["200"])
        self.place((0.0, 2.0, -0.125), (0.25, -0.5, 1.0))
        self.sends(3, "pose.two.distorted")
        self.talk.faults.clear()
        self.place(*((n / 16, -0.5, n / 32) for n in range(16)))
        self.sends(4, "pose.sixteen")
        self.talk.faults.tell("built-in-test", ["3"])
        self.place((0.25, -0.5, 1.0))
        self.sends(5, "pose.built_in_test")

    def test_without_a_set_up_it_sends_inches_and_degrees(self):
        self.talk.say(self.bytes["host.start"])
        self.talk.player.place(1, Pose((0.0254, 0.0, -0.0508), (0.7071067811865476, 0.0, 0.0, 0.7071067811865476)))
        self.sends(9, "pose.inches_degrees")

    def test_sends_refusals_and_warnings_as_in_the_fixture(self):
        for fault, command, answer in (("slow-boot", "host.units.set", "nak.booting"),
                                       ("nak", "host.filter.set", "nak.filter"),
                                       ("nak-questions", "host.hemisphere.get", "nak.hemisphere"),
                                       ("warn", "host.hemisphere.set", "warning.hemisphere.set")):
            self.talk.faults.tell(fault, [])
            self.answers(command, answer)
            self.talk.faults.clear()
        self.answers("host.hemisphere.get", "answer.hemisphere.get")  # a warning means that it was done


class Descriptors(unittest.TestCase):
    def setUp(self):
        self.talk = Talk(Viper)
        self.bytes = fixtures("descriptors.txt")

    def reads(self, name, value):
        found = self.talk.device.control(Request(0x80, 6, value, 0, 4096))
        self.assertEqual(found.hex(), self.bytes[name].hex(), name)

    def test_good_and_hostile_ones_equal_the_fixture(self):
        self.reads("device", 0x0100)
        self.reads("good", 0x0200)
        for name in ("no-endpoints", "absurd-endpoints", "absurd-lengths"):
            self.talk.faults.tell(name, [])
            self.reads(name, 0x0200)
            self.talk.faults.clear()
        self.reads("good", 0x0200)

    def test_a_configuration_is_taken_or_refused(self):
        request = Request(0, 9, 1, 0, 0)
        self.assertEqual(self.talk.device.control(request), b"")
        self.talk.faults.tell("wrong-configuration", [])
        self.assertIsNone(self.talk.device.control(request))


class Storms(unittest.TestCase):
    def setUp(self):
        self.talk = Talk(Viper)
        self.talk.device.streaming = True

    def sent(self, now):
        self.talk.device.step(now)
        return self.talk.heard()

    def test_a_burst_repeats_the_latest_frame_four_times_a_second(self):
        self.talk.faults.tell("burst", ["64"])
        frame = self.sent(10.0)
        whole = frame + b"".join(iter(self.talk.heard, None))
        self.assertEqual(whole, whole[:60] * (len(whole) // 60))
        self.assertEqual(len(whole) // 60, 1 + 65536 // 60)
        self.assertEqual(len(self.sent(10.1)), 60)
        self.assertGreater(len(self.sent(10.3)), 60000)

    def test_a_false_preamble_precedes_each_frame(self):
        self.talk.faults.tell("false-preambles", [])
        for _ in range(50):
            sent = self.sent(1.0)
            self.assertGreater(len(sent), 60)
            self.assertIn(sent[:4], (b"VPRP", b"VPRC"))
            self.assertEqual(split_commands(bytearray(sent[:-60])), [])

    def test_clock_stops_on_command(self):
        clock = self.talk.device.clock_s
        self.assertEqual(clock(1.0), 1.0)
        self.talk.faults.tell("clock-stands", [])
        self.assertEqual([clock(2.0), clock(3.0)], [1.0, 1.0])
        self.talk.faults.clear()
        self.assertEqual(clock(4.0), 4.0)


class LibertyFixtures(unittest.TestCase):
    def setUp(self):
        self.bytes = fixtures("liberty.txt")

    def streaming(self, kind, endpoint):
        talk = Talk(kind, endpoint)
        talk.say(b"U1\r" + b"".join(self.bytes[name] for name in ("host.stop", "host.binary", "host.fields")))
        talk.heard()
        talk.say(self.bytes["host.start"])
        talk.player.place(1, Pose((0.25, -0.5, 1.0), TURNED))
        return talk

    def sent(self, talk, seconds):
        talk.device.step(talk.device._clock_zero + seconds)
        return talk.heard().hex()

    def test_liberty_sends_poses_as_in_the_fixture(self):
        talk = self.streaming(LibertyHs, 4)
        talk.player.place(2, Pose((0.0625, 0.0, -0.125), TURNED))
        expected = self.bytes["pose.liberty"] + self.bytes["pose.liberty.second_sensor"]
        self.assertEqual(self.sent(talk, 1.5), expected.hex())

    def test_patriot_sends_poses_as_in_the_fixture(self):
        talk = self.streaming(Patriot, 2)
        self.assertEqual(self.sent(talk, 1.5), self.bytes["pose.patriot"].hex())
        talk.faults.tell("distortion", ["200"])
        self.assertEqual(self.sent(talk, 1.5165), self.bytes["pose.patriot.distorted"].hex())


if __name__ == "__main__":
    unittest.main()
