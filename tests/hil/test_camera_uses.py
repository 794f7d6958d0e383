"""Tests the uses of a camera in the emulated machine: the prop's tags replace a lost tracker, the picture turns to the person at the table,
and a picture that lies beside its place is reported. The camera's mock plays the picture that a camera would see there."""

import math
import pathlib
import shutil
import tempfile
import threading
import time

import kept_calibration
import screen
from bench import EYE_M, HEIGHT, UPRIGHT, USUAL, WIDTH, Patience, eventually
from camera_view import View, body, looks, room_seen, skirt, tags_seen
from hil_test import CENTRE_M, PIXELS, HilTest, long
from mocks import pgm

CAMERA = """
[camera]
kind = "v4l2"
rate_hz = 15.0
exposure_ms = 8.0
"""
SMALL = (160, 120)  # small, because an emulated processor searches it for tags and heads
ARTIFACT = "amphora"
TOLD_S = 30.0
RESTS_M = 0.002  # of an eye from status to status


def pose_of(place_m, yaw):
    return (*place_m, math.cos(0.5 * yaw), 0.0, 0.0, math.sin(0.5 * yaw))


class CameraUse(HilTest):
    """The exhibit with a camera of the view `view`, which sees `at_first()` at the start."""

    view: View

    @classmethod
    def at_first(cls):
        raise NotImplementedError

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="hil-seen-"))
        cls.bench.camera.tell("unplug")
        cls.sees(cls.at_first())
        super().setUpClass()
        cls.bench.camera.tell("good")

    @classmethod
    def tearDownClass(cls):
        cls.bench.camera.tell("play", "off")
        cls.bench.camera.tell("unplug")
        shutil.rmtree(cls.folder)
        super().tearDownClass()

    def setUp(self):
        super().setUp()
        self.bench.status_says("camera", "the camera is running")

    @classmethod
    def sees(cls, luma):
        pgm.write(cls.folder / "seen.pgm", cls.view.width, cls.view.height, luma)
        cls.bench.camera.tell("play", cls.folder / "seen.pgm")

    def middle(self):
        """The centre of the lit area on the screen now, pixels."""
        return screen.centroid(screen.lit(self.bench.screendump()), self.bench.machine.width)


@long
class Tags(CameraUse):
    """A camera above the table that looks at it obliquely."""

    view = View(*SMALL, 210.0, looks(math.radians(-81.0), 0.1), (0.02, -0.17, 1.1))
    tags = skirt(0.30, 0.09, 4)
    settings = (USUAL + CAMERA + "tags = true\n" + view.settings()
                + "tag = [" + ", ".join(tag.settings() for tag in tags) + "]\n")
    first, second = ((0.02, 0.02, 0.0), 0.3), ((-0.05, -0.02, 0.0), -0.2)  # places and turns
    beside_m = 0.012  # distance between the tracker's place of the prop and the tags' one
    near_m, near_turn = 0.004, math.radians(1.0)

    @classmethod
    def at_first(cls):
        return tags_seen(cls.view, cls.tags, *cls.first)

    def test_replace_a_lost_tracker_until_it_returns(self):
        bench = self.bench
        pose = pose_of((self.second[0][0] + self.beside_m, *self.second[0][1:]), self.second[1])
        # Drawn first, before the machine needs the host's processors.
        *_, meant = bench.rendered([pose_of(*self.first), pose_of(*self.second), pose], ARTIFACT)
        seen_there = tags_seen(self.view, self.tags, *self.second)
        self.show(ARTIFACT)
        bench.place(self.first[0], pose_of(*self.first)[3:])
        self.assert_at(self.first[0], pose_of(*self.first)[3:], ARTIFACT)
        before = self.warm_up()
        self.assertEqual(before["camera_for"], "the prop's tags")
        self.assert_at(self.first[0], pose_of(*self.first)[3:], ARTIFACT)

        at = self.middle()
        bench.tracker.tell("unplug")
        bench.status_says("prop_by", "tags")
        self.assertLess(math.dist(self.middle(), at), PIXELS, "the picture jumps when the tags take over")
        self.sees(seen_there)
        self.assert_shown_near(self.second)
        self.assertIn("no tracker is connected", bench.status()["tracker"])

        bench.place(pose[:3], pose[3:])
        self.assert_glides(self.middle(), screen.centroid(screen.lit(meant), meant.width))
        self.assert_at(pose[:3], pose[3:], ARTIFACT)
        after = bench.status_says("prop_by", "tracker")
        self.assertGreaterEqual(after["hand_overs"] - before["hand_overs"], 2)  # more if the emulated tracker pauses for 150 ms

    def warm_up(self):
        """Waits until tags are found in each frame; returns the status then. The first frame takes an emulated processor so long that the camera's thread, which has
        a limited share of a core, then rests for some seconds."""
        self.bench.tracker.tell("unplug")
        self.bench.status_says("prop_by", "tags")
        self.bench.tracker.tell("unplug", "off")
        return self.bench.status_says("prop_by", "tracker")

    def assert_shown_near(self, where):
        """Checks that the picture lies where `render` draws it for the true pose. The exhibit knows this pose only from the tags."""
        pose = pose_of(*where)

        def is_near(placed):
            turned = 2.0 * math.acos(min(1.0, abs(sum(a * b for a, b in zip(placed["prop_wxyz"], pose[3:])))))
            return math.dist(placed["prop_m"], pose[:3]) < self.near_m and turned < self.near_turn

        picture = self.bench.picture_where(is_near, where)
        self.assert_same_place(picture, self.bench.rendered([pose], ARTIFACT)[0])
        found = self.bench.status()["presented"]["prop_m"]
        print(f"  by the tags: {1e3 * math.dist(found, pose[:3]):.2f} mm from the truth", flush=True)

    def assert_glides(self, begin, end):
        """Plugs the tracker in, and checks that the picture passes places between `begin` and `end`."""
        whole = math.dist(begin, end)
        self.assertGreater(whole, 2 * PIXELS)
        self.bench.tracker.tell("unplug", "off")
        shares, deadline = [], self.bench.machine.granted_s() + TOLD_S * Patience.factor
        while self.bench.machine.granted_s() < deadline and (not shares or shares[-1] < 0.95):
            middle = self.middle()
            shares.append(sum((m - b) * (e - b) for m, b, e in zip(middle, begin, end)) / whole ** 2)
        between = [share for share in shares if 0.1 < share < 0.9]
        farthest = max((b - a for a, b in zip(shares, shares[1:])), default=1.0)
        print(f"  the picture goes over {whole:.1f} pixels, by {farthest * whole:.1f} at most from look to look, {len(between)} between", flush=True)
        self.assertGreaterEqual(len(between), 2, shares)
        self.assertLess(farthest, 0.6, shares)


@long
class Visitor(CameraUse):
    """A camera at the table's far edge that looks up at the people in front of the table."""

    view = View(*SMALL, 80.0, looks(math.radians(20.0), math.pi), (0.0, 0.28, 0.12))
    settings = USUAL + CAMERA + "visitor = true\n" + view.settings()
    eye_m = (0.33, -0.52, 0.48)
    looked_at_m = (0.0, 0.0, 0.07)
    max_across_m = 0.05  # docs/visitor_eye.md: 30 mm at the 95th percentile

    @classmethod
    def at_first(cls):
        return room_seen(cls.view)

    def test_picture_turns_to_an_arriving_visitor(self):
        bench, pose = self.bench, (*CENTRE_M, *UPRIGHT)
        bench.tracker.tell("sensor-missing", 2)  # no one wears a sensor on the head
        self.show(ARTIFACT)
        self.assert_at(CENTRE_M)
        bench.status_says("eye_by", "settings")

        self.sees(room_seen(self.view, body(self.eye_m, self.looked_at_m)))
        bench.status_says("eye_by", "camera")
        status = self.status_at_rest()
        picture = bench.picture_where(lambda placed: self.across_m(placed["eye_m"]) < self.max_across_m, "the visitor")
        eye = tuple(status["presented"]["eye_m"])
        print(f"  eye off by {1e3 * self.across_m(eye):.0f} mm across, {1e3 * math.dist(eye, self.eye_m):.0f} mm in all, said {status['eye_sd_mm']}",
              flush=True)
        self.assertGreater(status["eye_sd_mm"], 0.0)
        of_default, of_truth = (bench.rendered([pose], ARTIFACT, eye_m)[0] for eye_m in (EYE_M, self.eye_m))
        self.assert_same_place(picture, bench.render([pose], ARTIFACT, eye)[0])
        turned, off = (self.apart_px(picture, other) for other in (of_default, of_truth))
        print(f"  {off:.1f} pixels from the true eye's picture, {turned:.1f} from that of the usual eye", flush=True)
        self.assertLess(3 * off, turned)

        self.sees(self.at_first())
        bench.status_says("eye_by", "settings")
        self.assert_at(CENTRE_M)

    def status_at_rest(self):
        """The status once the eye rests: in two pictures of different statuses it has moved by RESTS_M at most."""
        seen = [self.bench.status()["presented"]]

        def rests():
            status = self.bench.status()
            if status["presented"]["code"] == seen[-1]["code"]:
                return None
            seen.append(status["presented"])
            return status if math.dist(*(each["eye_m"] for each in seen[-2:])) < RESTS_M else None

        return eventually(rests, TOLD_S, "the eye does not come to rest")

    def across_m(self, eye):
        """The error of an eye's position across the true eye's line to the prop."""
        line = [a - b for a, b in zip(self.looked_at_m, self.eye_m)]
        off = [a - b for a, b in zip(eye, self.eye_m)]
        along = sum(a * b for a, b in zip(line, off)) / math.hypot(*line)
        return math.sqrt(max(0.0, math.hypot(*off) ** 2 - along ** 2))

    @staticmethod
    def apart_px(one, other):
        """The largest distance of the middles and edges of the two lit areas."""
        a, b = screen.lit(one), screen.lit(other)
        return max(abs(x - y) for x, y in zip((*screen.centroid(a, one.width), *screen.box(a, one.width)),
                                              (*screen.centroid(b, other.width), *screen.box(b, other.width))))


class ScreenCamera:
    """While it is open, the camera sees the guest's own present screen, on a table of wood; the test must not request a screendump.

    `shift_px`: distance of the picture to the right of its place, in the screen's pixels."""

    pause_s = 0.04

    def __init__(self, test):
        self._test, self._ends = test, threading.Event()
        self.shift_px, self.looks = 0, 0
        self._thread = threading.Thread(target=self._run)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._ends.set()
        self._thread.join()

    def _run(self):
        while not self._ends.wait(self.pause_s):
            self._test.sees(seen_on_wood(self._test.bench.screendump(), self.shift_px))
            self.looks += 1


def seen_on_wood(picture, shift_px):
    """Every fourth pixel of a picture of the screen, moved to the right by `shift_px` of the screen's pixels, with bare table above and
    below."""
    green, width = picture.rgb[1::3], picture.width
    rows = (bytes(shift_px) + green[width * y:width * (y + 1) - shift_px] for y in range(0, picture.height, 4))
    lit = b"".join(row[::4] for row in rows)
    bare = bytes((SMALL[0] * SMALL[1] - len(lit)) // 2)
    return (bare + lit + bare).translate(ON_WOOD)


ON_WOOD = bytes(70 + 120 * code // 255 for code in range(256))


@long
class Drift(CameraUse):
    """A camera that looks straight down and is used only for drift and tags. The check is slow: it looks once a minute, and needs three
    looks to learn, five to report drift, and five to report its end."""

    before, after = kept_calibration.KEEP, kept_calibration.FORGET
    view = View(*SMALL, 200.0, kept_calibration.DOWN, (0.0, 0.0, 1.0))
    settings = (USUAL.replace("rest_s = 3600.0", "rest_s = 10.0") + CAMERA + "drift = true\ntags = true\n" + view.settings()
                + "tag = [" + ", ".join(tag.settings() for tag in Tags.tags) + "]\n")
    shift_px = 4
    shift_mm = 1e3 * shift_px * kept_calibration.ABOVE_M / kept_calibration.FOCAL_PX
    look_s = 60.0

    @classmethod
    def at_first(cls):
        return seen_on_wood(screen.Picture(WIDTH, HEIGHT, bytes(3 * WIDTH * HEIGHT)), 0)

    def test_reports_a_moved_picture_and_its_return(self):
        with ScreenCamera(self) as camera:
            status = self.drift_says("the camera looks whether", 3)
            self.assertEqual(status["camera_for"], "the prop's tags, the picture's place")
            self.assertFalse(status["drifted"])
            self.assertIn("camera_px", self.bench.machine.read(f"{kept_calibration.FOLDER}/drift.json"))
            camera.shift_px = self.shift_px
            status = self.drift_says("moved by 5 mm", 5)
            self.assertTrue(status["drifted"])
            self.assertAlmostEqual(status["drift_mm"], self.shift_mm, delta=0.5)
            # `frustumscreen status` has the same lines as the staff's picture.
            for said in (self.bench.journal(), self.bench.machine.run("frustumscreen status").output):
                self.assertIn("moved by 5 mm since the calibration", said)
            camera.shift_px = 0
            status = self.drift_says("the picture lies where it was calibrated", 5)
            self.assertFalse(status["drifted"])

    def drift_says(self, words, looks):
        """Waits for this many looks. It reads the status seldom, because each read delays the guest."""
        begun = self.bench.machine.granted_s()
        deadline = begun + (looks + 2) * self.look_s * Patience.factor
        status = None
        while self.bench.machine.granted_s() < deadline:
            status = self.bench.status()
            if status and words in status["drift"]:
                print(f"  '{words}' after {self.bench.machine.granted_s() - begun:.0f} s", flush=True)
                return status
            for _ in range(40):
                time.sleep(0.05)
                self.bench.machine.given()
        self.fail(f"'drift' never says '{words}', at last '{status and status['drift']}' in state '{status and status['state']}'")
