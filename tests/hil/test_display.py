"""Tests another graphics card, virtio-gpu: its driver is loaded late, and its projector, a viewer's window, is plugged in, unplugged
and changes its mode. The kernel reports this by uevent."""


import screen
from bench import CONNECTOR, HEIGHT, UNIT, UPRIGHT, USUAL, WIDTH, eventually
from hil_test import PIXELS, START_S, HilTest, long
from machine import SECOND_SLOT

ARTIFACT = "amphora"
PLACE_M = (0.1, -0.05, 0.0)
CARD = f"/dev/dri/by-path/pci-0000:00:{SECOND_SLOT:02x}.0-card"
WAITED_S = 4.0  # how long it waits for a driver without giving up
BACK_S = 15.0
LARGER, SCALE, ABOVE = (800, 600), 1.25, 50  # a larger mode, with the picture scaled to fit


@long
class OtherCard(HilTest):
    def test_projector_moves_to_the_other_card(self):
        machine = self.bench.machine
        self.show(ARTIFACT)
        machine.check(f"echo off > {CONNECTOR}")
        self.bench.status_says("display", "no projector is connected", BACK_S)
        self.addCleanup(self.back_to_the_first)
        self.bench.looked_at = "second"
        machine.check("modprobe virtio_gpu")
        self.bench.status_says("display", f"is lit, {WIDTH} x {HEIGHT}", START_S)
        self.bench.place(PLACE_M)
        self.assert_at(PLACE_M)

    def back_to_the_first(self):
        self.bench.looked_at = "screen"
        self.bench.machine.run(f"systemctl stop {UNIT}; modprobe -r virtio_gpu; echo detect > {CONNECTOR}; "
                               f"systemctl start --no-block {UNIT}")


class Display(HilTest):
    settings = f'{USUAL}\n[display]\ncard = "{CARD}"\n'
    after = "modprobe -r virtio_gpu"

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.bench.looked_at = "second"
        cls.viewer = cls.bench.second_viewer()

    @classmethod
    def tearDownClass(cls):
        cls.viewer.close()
        cls.bench.looked_at = "screen"

    def setUp(self):
        if self.bench.machine.run("test -e " + CARD).status != 0:
            self.wait_without_driver()
            self.bench.machine.check("modprobe virtio_gpu")
            eventually(lambda: self.bench.machine.run(f"systemctl is-active {UNIT}").status == 0, START_S,
                       "it is not ready once its card is there")
        super().setUp()
        self.show(ARTIFACT)
        self.bench.place(PLACE_M)
        self.process = self.bench.main_process()

    def tearDown(self):
        self.assertEqual(self.bench.main_process(), self.process, "the exhibit was restarted")

    def wait_without_driver(self):
        shown = f"systemctl show --value -p StatusText {UNIT}"
        eventually(lambda: "its driver loaded?" in self.bench.machine.run(shown).output, 20.0,
                   "it does not say that it waits for its card")
        process = self.bench.main_process()
        self.bench.machine.let_run(WAITED_S)
        self.assertEqual(self.bench.main_process(), process, "it gave up waiting for its card")
        self.assertNotEqual(process, 0)

    def test_driver_that_loads_late(self):
        self.assert_at(PLACE_M, artifact=ARTIFACT)

    def test_mode_change(self):
        truth = self.bench.rendered([(*PLACE_M, *UPRIGHT)], ARTIFACT)[0]
        for _ in range(2):
            self.resize(*LARGER)
            picture = self.bench.picture_of((*PLACE_M, *UPRIGHT))
            seen = screen.centroid(screen.lit(picture), picture.width)
            x, y = screen.centroid(screen.lit(truth), truth.width)
            self.assertAlmostEqual(seen[0], SCALE * x, delta=PIXELS)
            self.assertAlmostEqual(seen[1], SCALE * y + ABOVE, delta=PIXELS)
            self.resize(WIDTH, HEIGHT)
            self.assert_at(PLACE_M, artifact=ARTIFACT)

    def resize(self, width, height):
        self.viewer.resize(width, height)

        def lit():
            picture = self.bench.screendump()
            return (picture.width, picture.height) == (width, height) and any(screen.lit(picture))

        eventually(lit, BACK_S, f"no picture of {width} x {height}")
        self.bench.status_says("display", f"is lit, {width} x {height}")

    def test_unplugged_and_back(self):
        for x in (-PLACE_M[0], PLACE_M[0]):
            place = (x, *PLACE_M[1:])
            self.viewer.resize(0, 0)
            self.bench.status_says("display", "no projector is connected", BACK_S)
            self.bench.place(place)
            self.resize(WIDTH, HEIGHT)
            self.assert_at(place, artifact=ARTIFACT)
