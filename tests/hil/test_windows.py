"""Tests a window on the table: the seventh button pins the view through the prop. On the screen it must be at the place where the same
program puts it on this machine without a screen, and equal `frustumscreen render --pin` within the tolerance. No frame waits for it, and
it ends with the visit."""

import json
import pathlib
import subprocess
import tempfile

import screen
from bench import EYE_M, UPRIGHT, USUAL, eventually
from hil_test import HilTest

ARTIFACT = "amphora"
WINDOW = 6  # button
RESTS_S = 25.0
SIDE_M = 0.10
WINDOWS = (USUAL.replace('lines = ["0", "1", "2"]', 'lines = ["0", "1", "2", "3", "4", "5", "6"]')
           .replace("rest_s = 3600.0", f"rest_s = {RESTS_S}") + f"\n[windows]\ncount = 2\nwidth_m = {SIDE_M}\ndepth_m = {SIDE_M}\n")
PROP = (-0.05, 0.02, 0.0, *UPRIGHT)
OTHER_PROP = (-0.16, 0.05, 0.0, *UPRIGHT)  # beside the place of the window
RUN_S, RUN_HZ, PINNED_S = 4.0, 30.0, 1.0
CHANGED = 6  # codes; as in test_torch.py
NEAR = 4  # pixels: the filtered pose comes to rest near to what was sent; as in test_torch.py
MAX_OUTSIDE = 0.01
APPEARS_S = 20.0
MOVED_S = 4.0


def run_here(bench, prop):
    """Pictures before and after the press, by the program on this machine, without a screen."""
    settings = (WINDOWS.replace('kind = "usb"', 'kind = "replay"\nposes = "poses.csv"').replace('kind = "gpio"', 'kind = "scripted"')
                .replace("/var/lib/frustumscreen/packs", str(bench.packs)))
    settings = "\n".join(f"script = [{{ at_s = {PINNED_S}, button = {WINDOW} }}]" if line.startswith("lines") else line
                         for line in settings.splitlines() if not line.startswith("chip"))
    rows = ["t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok"]
    for k in range(round(RUN_S * RUN_HZ)):
        for station, pose in ((1, prop), (2, (*EYE_M, *UPRIGHT))):
            rows.append(f"{round(1e6 * k / RUN_HZ)},{station}," + ",".join(str(value) for value in pose) + ",1")
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "poses.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
        (folder / "kiosk.toml").write_text(settings, encoding="utf-8")
        subprocess.run([bench.program, "run", "--config", folder / "kiosk.toml", "--headless", "--fast", "--seconds", f"{RUN_S}",
                        "--stills", "4", "--out", folder], check=True, capture_output=True)
        return [screen.read_png(folder / f"frame_{k:05}.png") for k in (0, 3)]


def rows_in(rows, box, width):
    """An outline (screen.py) of a box, (left, top, right, bottom)."""
    left, top, right, bottom = box
    columns = (1 << right - left) - 1 << width - right
    return [row & columns if top <= y < bottom else 0 for y, row in enumerate(rows)]


def on_table(bench, config, pixel):
    """The place on the table that a pixel of the projector lights."""
    told = subprocess.run([bench.program, "config", "--config", config, "--json"], check=True, capture_output=True, text=True)
    lens = json.loads(told.stdout)["projector"]
    pose = lens["table_from_projector"]  # column by column
    ray = ((pixel[0] - lens["cx"]) / lens["fx"], (pixel[1] - lens["cy"]) / lens["fy"], 1.0)
    along = [sum(pose[4 * k + row] * ray[k] for k in range(3)) for row in range(3)]
    return [pose[12 + row] - along[row] * pose[14] / along[2] for row in range(2)]


class Windows(HilTest):
    settings = WINDOWS

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        before_press, cls.after_press = run_here(cls.bench, PROP)
        cls.window = screen.changed(before_press, cls.after_press, CHANGED)
        cls.pinned = cls.render_pinned()

    def setUp(self):
        super().setUp()
        self.assertGreater(screen.count(self.window), 300, "no window is pinned on this machine: this proves nothing")
        self.bench.place(PROP[:3])
        self.bench.picture_of(PROP)  # a prop that has moved ends the turn of the artifacts
        self.show(ARTIFACT)

    def test_window_stays_where_pinned_until_the_visit_ends(self):
        dark = self.bench.resting_picture_of(PROP)
        self.bench.buttons.tell("press", WINDOW, "300ms")
        width = dark.width
        may = screen.grown(self.window, NEAR, width)
        said = ["nothing"]
        shown = [dark]

        def is_there():
            self.bench.place(PROP[:3])
            shown[0] = self.bench.picture_of(PROP)
            seen = screen.changed(dark, shown[0], CHANGED)
            outside = screen.share_outside(seen, may)
            missing = screen.share_outside(self.window, screen.grown(seen, NEAR, width))
            said[0] = f"{screen.count(seen)} pixels changed, {outside:.1%} of them outside; {missing:.1%} of the window is missing"
            return screen.count(seen) > 0 and outside <= MAX_OUTSIDE and missing <= MAX_OUTSIDE

        eventually(is_there, APPEARS_S, lambda: said[0])
        # That picture may be one of the window's fade, because the status that it followed was from before the press.
        picture = self.bench.picture_of(PROP, after=shown[0])
        # The artifact goes on in the prop, no picture stands, and the window stays where it is.
        self.bench.tracker.tell("pose", *OTHER_PROP, 1)
        self.watch(MOVED_S, rests=True)
        self.shows_what_render_pins(picture)
        moved = screen.lit(self.bench.picture_of(OTHER_PROP))
        meant = screen.lit(self.after_press)
        window_alone = [row & place for row, place in zip(meant, self.window)]
        self.assertLess(screen.share_outside(window_alone, screen.grown(moved, NEAR, width)), MAX_OUTSIDE, "the window has moved")
        # The visit ends, because the rests are longer than RESTS_S.
        eventually(lambda: screen.count([row & place for row, place in zip(screen.lit(self.bench.screendump()), window_alone)]) == 0,
                   4 * RESTS_S, "the window stays, though nobody is there")

    @classmethod
    def render_pinned(cls):
        """The picture with a window of `frustumscreen render --pin` at the window's place."""
        left, top, right, bottom = screen.box(cls.window, cls.after_press.width)
        with tempfile.TemporaryDirectory() as folder:
            config = pathlib.Path(folder) / "kiosk.toml"
            config.write_text(WINDOWS, encoding="utf-8")
            x, y = on_table(cls.bench, config, ((left + right) / 2, (top + bottom) / 2))
            return cls.bench.render([PROP], ARTIFACT, EYE_M, config, options=("--pin", f"{x:.4f},{y:.4f}"))[0]

    def shows_what_render_pins(self, picture):
        """Checks that the lit pixels within the window's frame are those that `frustumscreen render --pin` lights there."""
        left, top, right, bottom = box = screen.box(self.window, picture.width)
        inside = (left + NEAR, top + NEAR, right - NEAR, bottom - NEAR)
        seen, meant = (rows_in(screen.lit(each), inside, picture.width) for each in (picture, self.pinned))
        self.assertGreater(screen.count(meant), 200, f"nothing is pinned at {box}: this proves nothing")
        self.assertLess(screen.share_outside(seen, screen.grown(meant, NEAR, picture.width)), MAX_OUTSIDE)
        self.assertLess(screen.share_outside(meant, screen.grown(seen, NEAR, picture.width)), MAX_OUTSIDE)
