"""Tests the projector and the screen behind the table at two connectors of one card, virtio-gpu, with a viewer's window for each. One is
unplugged and plugged in again while the other goes on; both pictures are compared with those of `frustumscreen render`."""

import screen
from bench import EYE_M, HEIGHT, UNIT, UPRIGHT, USUAL, WIDTH, eventually
from hil_test import LIT, START_S, HilTest
from machine import SECOND_SLOT

ARTIFACT = "amphora"
CARD = f"/dev/dri/by-path/pci-0000:00:{SECOND_SLOT:02x}.0-card"
PROJECTOR, SCREEN = "Virtual-2", "Virtual-3"  # the machine's second and third connector
SCREEN_WIDTH, SCREEN_HEIGHT = WIDTH, HEIGHT  # a mode that the emulated card lists
PLACES_M = ((0.1, -0.05, 0.0), (-0.1, -0.05, 0.0))
EYES_M = (EYE_M, (0.25, -0.5, 0.55))
PACKS = "/var/lib/frustumscreen/packs"  # in the guest
ROOM = "/etc/frustumscreen/room.toml"
BACK_S = 30.0


def room(packs):
    """A room of two objects, which stay in it whatever artifact the prop shows."""
    return (f'[[object]]\npack = "{packs}/amphora.fspack"\nartifact = "elsewhere"\nplace_m = [-0.3, 1.1, 0.2]\nsize_m = 0.45\n'
            f'[[object]]\npack = "{packs}/nautilus-cup.fspack"\nartifact = "elsewhere"\nplace_m = [0.25, 0.6, 0.2]\nsize_m = 0.3\n')


def with_screen(settings, room_file):
    return (f'{settings}\n[display]\ncard = "{CARD}"\nconnector = "{PROJECTOR}"\n'
            f'[screen]\nroom = "{room_file}"\ncard = "{CARD}"\nconnector = "{SCREEN}"\n'
            f"width = {SCREEN_WIDTH}\nheight = {SCREEN_HEIGHT}\n")


class Screen(HilTest):
    settings = with_screen(USUAL, ROOM)
    before = "modprobe virtio_gpu"
    after = "modprobe -r virtio_gpu"

    @classmethod
    def setUpClass(cls):
        cls.bench.machine.write(ROOM, room(PACKS))
        cls.projector, cls.screen = cls.bench.second_viewer(), cls.bench.second_viewer(head=1)
        cls.bench.looked_at = "second"
        cls.projector.resize(WIDTH, HEIGHT)
        cls.screen.resize(SCREEN_WIDTH, SCREEN_HEIGHT)
        super().setUpClass()

    @classmethod
    def tearDownClass(cls):
        cls.screen.resize(0, 0)
        cls.projector.close()
        cls.screen.close()
        cls.bench.looked_at = "screen"
        cls.bench.machine.run(f"rm -f {ROOM}")

    def setUp(self):
        eventually(lambda: self.bench.machine.run(f"systemctl is-active {UNIT}").status == 0, START_S, "it does not start")
        super().setUp()
        self.bench.status_says("screen", LIT, START_S)
        self.show(ARTIFACT)
        self.process = self.bench.main_process()

    def tearDown(self):
        self.assertEqual(self.bench.main_process(), self.process, "the exhibit was restarted")

    def rendered_screen(self, eye_m):
        config, room_file = self.bench.out / "screen.toml", self.bench.out / "room.toml"
        config.write_text(with_screen(USUAL, room_file), encoding="utf-8")
        room_file.write_text(room(self.bench.packs), encoding="utf-8")
        return self.bench.render([(*PLACES_M[0], *UPRIGHT)], ARTIFACT, eye_m, config=config, options=("--output", "screen"))[0]

    def assert_screen(self, eye_m):
        """Waits until the screen shows the room as `render` draws it for this eye."""
        self.bench.place_head(eye_m)
        truth = self.rendered_screen(eye_m)
        why = ["it shows nothing"]

        def same():
            try:
                self.assert_same_place(self.bench.screendump(head=1), truth)
                return True
            except AssertionError as error:
                why[0] = error
                return False

        try:
            eventually(same, BACK_S, lambda: f"the screen's picture is not the room's: {why[0]}")
        except AssertionError:
            screen.write_png(self.bench.out / "screen_truth.png", truth)
            screen.write_png(self.bench.out / "screen_shown.png", self.bench.screendump(head=1))
            raise

    def assert_projector(self, place_m, eye_m=EYE_M):
        pose = (*place_m, *UPRIGHT)
        self.bench.place(place_m)
        self.bench.place_head(eye_m)
        self.assert_same_place(self.bench.picture_of(pose, eye_m), self.bench.rendered([pose], ARTIFACT, eye_m)[0])

    def test_both_are_lit_and_either_may_be_pulled(self):
        self.assert_projector(PLACES_M[0])
        self.assert_screen(EYES_M[0])
        self.screen.resize(0, 0)
        status = self.bench.status_says("screen", f"no screen is connected to {SCREEN}", BACK_S)
        self.assertFalse(status["devices"]["screen"]["ok"])
        self.assertTrue(status["devices"]["display"]["ok"])
        self.assert_projector(PLACES_M[1])
        self.screen.resize(SCREEN_WIDTH, SCREEN_HEIGHT)
        self.bench.status_says("screen", LIT, BACK_S)
        self.assert_screen(EYES_M[0])
        self.projector.resize(0, 0)
        self.bench.status_says("display", f"no projector is connected to {PROJECTOR}", BACK_S)
        self.assert_screen(EYES_M[1])
        self.projector.resize(WIDTH, HEIGHT)
        self.bench.status_says("display", LIT, BACK_S)
        self.assert_projector(PLACES_M[0], EYES_M[1])
        self.assert_screen(EYES_M[1])
        self.assertEqual(self.bench.status()["screen_picture"]["health"], "well")
