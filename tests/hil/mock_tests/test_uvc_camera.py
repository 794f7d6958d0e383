import ctypes
import pathlib
import random
import struct
import tempfile
import unittest

from mock_tests.usbredir_host import UsbredirHost
from mocks import pgm, test_picture
from mocks.camera_console import CameraConsole
from mocks.usb_device import Request
from mocks.uvc_camera import AUTO_EXPOSURE, EXPOSURE, PAYLOAD_BYTES, STREAM, UvcCamera

GET_CUR, SET_CUR, PROBE, COMMIT = 0x81, 1, 1, 2
SMALL = (160, 120)


def decoded(jpeg, width, height):
    """By libjpeg-turbo: luma."""
    turbo = ctypes.CDLL("libturbojpeg.so.0")
    turbo.tjInitDecompress.restype = ctypes.c_void_p
    handle = ctypes.c_void_p(turbo.tjInitDecompress())
    luma = ctypes.create_string_buffer(width * height)
    grey, stop_on_warning = 6, 8192
    status = turbo.tjDecompress2(handle, jpeg, ctypes.c_ulong(len(jpeg)), luma, width, width, height, grey, stop_on_warning)
    turbo.tjDestroy(handle)
    return luma.raw if status == 0 else None


class Picture(unittest.TestCase):
    def test_contains_its_number_and_brightness(self):
        for number in (0, 1, 0x5A5A, 0xFFFF):
            luma = test_picture.luma(*SMALL, number)
            self.assertEqual(len(luma), SMALL[0] * SMALL[1])
            self.assertEqual(test_picture.number_in(luma, SMALL[0]), number)
        codes = sorted(test_picture.luma(*SMALL, 7)[8 * SMALL[0]:])
        self.assertAlmostEqual(codes[len(codes) // 2], 120, delta=4)
        self.assertLess(max(test_picture.luma(*SMALL, 7, "dark")), 20)
        self.assertGreater(min(test_picture.luma(*SMALL, 7, "blind")), 250)

    def test_moves_and_has_noise(self):
        pictures = [bytes(test_picture.luma(*SMALL, number)) for number in range(16)]
        self.assertEqual(len(set(pictures)), 16)
        for light in ("dark", "blind"):
            self.assertNotEqual(test_picture.luma(*SMALL, 0, light), test_picture.luma(*SMALL, 1, light))

    def test_as_yuyv_has_no_colour(self):
        luma = test_picture.luma(*SMALL, 3)
        data = test_picture.yuyv(*SMALL, luma)
        self.assertEqual(data[0::2], bytes(luma))
        self.assertEqual(set(data[1::2]), {128})

    def test_jpeg_decodes_with_libjpeg(self):
        for number, light in ((0, "usual"), (0x1234, "usual"), (5, "dark"), (6, "blind")):
            meant = test_picture.luma(*SMALL, number, light)
            found = decoded(test_picture.jpeg(*SMALL, meant), *SMALL)
            self.assertIsNotNone(found)
            for left, top in ((0, 0), (80, 64), (152, 112)):
                block = [(meant[y * SMALL[0] + x], found[y * SMALL[0] + x]) for y in range(top, top + 8) for x in range(left, left + 8)]
                mean = sum(code for code, _ in block) / 64
                for _, code in block:
                    self.assertAlmostEqual(code, mean, delta=1.0)


def split(descriptors):
    while descriptors:
        yield descriptors[:descriptors[0]]
        descriptors = descriptors[descriptors[0]:]


class Descriptors(unittest.TestCase):
    def test_their_lengths_add_up(self):
        whole = UvcCamera().configuration_descriptor()
        self.assertEqual(struct.unpack_from("<H", whole, 2)[0], len(whole))
        parts = list(split(whole))
        self.assertEqual(b"".join(parts), whole)
        totals = []  # of the class's part of each interface
        for part in parts:
            if part[1] == 4:
                totals.append(0)
            elif part[1] == 0x24 and totals:
                totals[-1] += len(part)
        headers = [part for part in parts if part[1:3] == b"\x24\x01"]
        self.assertEqual([struct.unpack_from("<H", headers[0], 5)[0], struct.unpack_from("<H", headers[1], 4)[0]], totals)


class Camera(UsbredirHost):
    device_kind = UvcCamera

    async def asyncSetUp(self):
        await super().asyncSetUp()
        self.console = CameraConsole(self.device)
        self.link.connected = True  # the host's side is not played here

    def stream(self, kind, selector, data=b""):
        return self.device.control(Request(0xA1 if kind & 0x80 else 0x21, kind, selector << 8, 1, 34 if kind & 0x80 else len(data)), data)

    def commit(self, format_=1, size=1, interval=333333):
        probe = struct.pack("<HBBI", 1, format_, size, interval).ljust(34, b"\0")
        self.assertEqual(self.stream(SET_CUR, PROBE, probe), b"")
        answer = self.stream(GET_CUR, PROBE)
        self.assertEqual(self.stream(SET_CUR, COMMIT, answer), b"")
        return answer

    def frame(self):
        """The payloads of the next frame."""
        before = self.device.number
        self.device.send_frame()
        self.assertEqual(self.device.number, before + 1)
        payloads = []
        while (payload := self.device.take(STREAM, PAYLOAD_BYTES)) is not None:
            payloads.append(payload)
        return payloads

    async def test_negotiates_available_formats(self):
        answer = self.commit(format_=9, size=2, interval=700_000)
        self.assertEqual(struct.unpack_from("<HBBI", answer), (1, 2, 2, 666_666))
        self.assertEqual(struct.unpack_from("<II", answer, 18), (2 * 320 * 240, PAYLOAD_BYTES))
        self.assertEqual(self.console.execute("status")["format"], "mjpeg")

    async def test_marks_the_last_payload_of_a_frame(self):
        self.commit()
        first, second = self.frame(), self.frame()
        self.assertEqual([len(payload) for payload in first], [PAYLOAD_BYTES, PAYLOAD_BYTES, 38400 - 2 * (PAYLOAD_BYTES - 2) + 2])
        self.assertEqual(b"".join(payload[2:] for payload in first), test_picture.yuyv(*SMALL, test_picture.luma(*SMALL, 1)))
        self.assertEqual([payload[1] & 2 for payload in first], [0, 0, 2])
        self.assertEqual({payload[1] & 1 for payload in first}, {1})
        self.assertEqual({payload[1] & 1 for payload in second}, {0})

    async def test_streams_from_commit_to_clear_halt(self):
        self.assertFalse(self.device.streams)
        self.commit()
        self.device.send_frame()
        self.device.send_frame()
        self.assertEqual(self.device.counts, {"sent": 1, "skipped": 1})
        self.assertEqual(self.device.control(Request(2, 1, 0, STREAM, 0)), b"")
        self.assertFalse(self.device.streams)
        self.assertIsNone(self.device.take(STREAM, PAYLOAD_BYTES))

    async def test_controls_keep_their_values(self):
        def control(kind, key, data=b"", length=4):
            return self.device.control(Request(0xA1 if kind & 0x80 else 0x21, kind, key[1] << 8, key[0] << 8, length), data)

        self.assertEqual(control(GET_CUR, AUTO_EXPOSURE), b"\x08")
        self.assertEqual(control(SET_CUR, AUTO_EXPOSURE, b"\x01"), b"")
        self.assertEqual(control(SET_CUR, EXPOSURE, struct.pack("<I", 80)), b"")
        self.assertEqual(control(GET_CUR, EXPOSURE), struct.pack("<I", 80))
        self.assertEqual(control(GET_CUR, AUTO_EXPOSURE), b"\x01")
        self.assertIsNone(control(GET_CUR, (1, 9)))
        self.console.execute("stubborn")
        self.assertEqual(control(SET_CUR, AUTO_EXPOSURE, b"\x08"), b"")
        self.assertEqual(control(GET_CUR, AUTO_EXPOSURE), b"\x01")

    async def test_faults_change_the_stream(self):
        self.commit()
        self.console.execute("freeze")
        self.assertEqual([payload[2:] for payload in self.frame()], [payload[2:] for payload in self.frame()])
        self.console.execute("good")
        self.console.execute("short-frames")
        self.assertEqual(sum(len(payload) - 2 for payload in self.frame()), 38400 - 3840)
        self.console.execute("good")
        self.console.execute("dark")
        self.assertLess(max(b"".join(payload[2:] for payload in self.frame())[0::2]), 20)
        self.console.execute("good")
        self.console.execute("garbage-headers")
        self.assertNotEqual(self.frame()[0][:2], b"\x02\x80")
        self.console.execute("slow 2")
        self.assertEqual(self.device.rate_hz(), 2)
        with self.assertRaises(ValueError):
            self.console.execute("slow 1000")
        with self.assertRaises(ValueError):
            self.console.execute("drop 0.1")  # a tracker's

    async def test_plays_a_picture_only_at_its_size(self):
        meant = bytes(random.Random(1).choices(range(253), k=SMALL[0] * SMALL[1]))
        with tempfile.TemporaryDirectory() as folder:
            file = f"{folder}/a picture.pgm"
            pgm.write(file, *SMALL, meant)
            self.console.execute(f"play {file}")
        self.commit()
        first, second = (b"".join(payload[2:] for payload in self.frame())[0::2] for _ in range(2))
        self.assertNotEqual(first, second)
        for sent in (first, second):
            self.assertEqual({code - of for code, of in zip(sent, meant)}, {0, 1, 2, 3})
        self.commit(size=2)
        self.assertEqual(test_picture.number_in(b"".join(payload[2:] for payload in self.frame())[0::2], 320), 3)
        self.commit()
        self.console.execute("dark")
        self.assertLess(max(b"".join(payload[2:] for payload in self.frame())[0::2]), 20)
        self.console.execute("good")
        self.console.execute("play off")
        self.assertEqual(b"".join(payload[2:] for payload in self.frame()), test_picture.yuyv(*SMALL, test_picture.luma(*SMALL, 5)))

    async def test_noise_does_not_overflow_a_white_picture(self):
        self.assertGreaterEqual(min(test_picture.with_noise(b"\xff" * 999, 1)), 252)

    async def test_reports_pictures_that_it_cannot_play(self):
        with tempfile.TemporaryDirectory() as folder:
            for content, words in ((b"P5 32 20 255\n" + bytes(640), "160 x 120, 320 x 240"), (b"P5 160 120 255\n" + bytes(9), "found 9"),
                                   (b"P6 1 1 255\n123", "not a binary PGM")):
                file = pathlib.Path(folder) / "wrong.pgm"
                file.write_bytes(content)
                with self.assertRaisesRegex(ValueError, words):
                    self.console.execute(f"play {file}")
            with self.assertRaisesRegex(ValueError, "No such file"):
                self.console.execute(f"play {folder}/none.pgm")
        self.assertFalse(self.console.execute("status")["plays"])


if __name__ == "__main__":
    unittest.main()
