"""Tests a torch in the hand, the third sensor of the tracker's mock. Its light sweeps over the artifact; the pixels that
`frustumscreen render --torch` lights change, and no others beyond the tolerance. Its beam rises, so that it never meets the table, where a lamp's own
light is shown."""

import math
import pathlib
import tempfile

import screen
from bench import EYE_M, UPRIGHT, USUAL, about, both_turns, eventually
from hil_test import HilTest

ARTIFACT = "amphora"
PLACES_M = ((0.0, 0.0, 0.0), (0.08, 0.04, 0.0))
TORCH_STATION = 3
OPENING_DEG = 10.0
TORCH = USUAL + f'\n[torch]\nsource = "tracker"\nopening_deg = {OPENING_DEG}\nattenuation = "none"\n'
FROM_M = (-0.15, -0.36, 0.025)  # of the prop's foot
AIMS_M = ((-0.02, 0.0, 0.075), (0.0, 0.0, 0.075), (0.02, 0.0, 0.085))  # where the middle of the light passes the prop
TREMBLE_M = 0.02  # a torch that lies is off until it is moved by more than 15 mm
SETTLED_S = 1.0
SWEEP_S = 60.0
GONE_S = 30.0
CHANGED = 6  # codes; the filtered pose changes a surface's shade by less
NEAR = 4  # pixels, tolerance at an edge of the light: the filtered pose comes to rest near the one that was sent
MAX_OUTSIDE = 0.01  # share of the changed pixels, and of those that should


def pointing(from_m, at_m):
    """The pose of a torch whose +Z points to a place and whose +Y points down."""
    along = [b - a for a, b in zip(from_m, at_m)]
    azimuth = math.degrees(math.atan2(along[1], along[0]))
    elevation = math.degrees(math.atan2(along[2], math.hypot(*along[:2])))
    level = both_turns(about(0, 0, 1, azimuth - 90), about(1, 0, 0, -90))  # +Z to +Y of the table is turned about the vertical
    return (*from_m, *both_turns(level, about(1, 0, 0, elevation)))


def shrunk(rows, pixels, width):
    full = (1 << width) - 1
    return [~row & full for row in screen.grown([~row & full for row in rows], pixels, width)]


class Torch(HilTest):
    settings = TORCH

    def setUp(self):
        super().setUp()
        self.addCleanup(self.bench.tracker.tell, "away", TORCH_STATION)
        self.bench.tracker.tell("away", TORCH_STATION)
        self.show(ARTIFACT)

    def place_torch(self, pose):
        self.bench.tracker.tell("pose", *pose, TORCH_STATION)

    def tremble(self, torch):
        """Moves the torch away and back."""
        self.place_torch((*torch[:2], torch[2] + TREMBLE_M, *torch[3:]))
        self.bench.machine.let_run(SETTLED_S / 2)
        self.place_torch(torch)

    def render(self, prop, torch):
        with tempfile.TemporaryDirectory() as folder:
            config = pathlib.Path(folder) / "kiosk.toml"
            config.write_text(TORCH, encoding="utf-8")
            return [self.bench.render([prop], ARTIFACT, EYE_M, config, options=options, torches=[torch])[0]
                    for options in ((), ("--torch", "white"))]

    def changes_as_rendered(self, prop, torch, dark):
        """Waits until the pixels that differ from the picture without a torch are those that differ between the rendered pictures."""
        meant = screen.changed(*self.render(prop, torch), CHANGED)
        self.assertGreater(screen.count(meant), 200, "the torch lights nothing: this pose proves nothing")
        may = screen.grown(meant, NEAR, dark.width)
        must = shrunk(meant, NEAR, dark.width)
        said = ["nothing"]

        def is_so():
            self.tremble(torch)
            until_s = self.bench.machine.granted_s() + SETTLED_S
            while not (found := is_seen()) and self.bench.machine.granted_s() < until_s:
                pass
            return found

        def is_seen():
            seen = screen.changed(dark, self.bench.picture_of(prop), CHANGED)
            outside = screen.share_outside(seen, may)
            missing = screen.share_outside(must, seen)
            said[0] = f"{screen.count(seen)} pixels changed, {outside:.1%} of them outside; {missing:.1%} of the light is missing"
            return outside <= MAX_OUTSIDE and missing <= MAX_OUTSIDE

        eventually(is_so, SWEEP_S, lambda: said[0])

    def status_says(self, state, meanwhile=lambda: None):
        """Waits until the status says so; calls `meanwhile` before each look."""
        def said():
            meanwhile()
            return (self.bench.status() or {}).get("torch", {}).get("state") == state

        eventually(said, GONE_S, lambda: f"not {state}: {(self.bench.status() or {}).get('torch')}")

    def is_as_without(self, prop, dark):
        eventually(lambda: screen.count(screen.changed(dark, self.bench.picture_of(prop), CHANGED)) == 0, GONE_S,
                   "the light stays, though the torch is gone")

    def test_the_light_sweeps_over_the_artifact(self):
        for place in PLACES_M:
            prop = (*place, *UPRIGHT)
            dark = self.bench.resting_picture_of(prop)
            for aim in AIMS_M:
                with self.subTest(prop=place, aim=aim):
                    torch = pointing(*([a + b for a, b in zip(place, point)] for point in (FROM_M, aim)))
                    self.changes_as_rendered(prop, torch, dark)
            self.status_says("lit", lambda torch=torch: self.tremble(torch))
            self.bench.tracker.tell("away", TORCH_STATION)
            self.status_says("lost")
            self.is_as_without(prop, dark)

    def test_light_stays_while_the_prop_moves(self):
        """The third station moves nothing else, and the first does not move the light."""
        torch = pointing(FROM_M, AIMS_M[1])
        for place in ((0.0, 0.0, 0.0), (0.02, 0.0, 0.0)):
            prop = (*place, *UPRIGHT)
            self.bench.tracker.tell("away", TORCH_STATION)
            dark = self.bench.resting_picture_of(prop)
            self.changes_as_rendered(prop, torch, dark)
