"""Tests stereo with a cube in the hand; the tracker's mock plays the sensors of cube and glasses. Each half of the screen has one eye's
picture; with glasses that lie still both halves have the same picture; the alignment pattern shows which eye sees which half.
"""

import pathlib
import tempfile

import screen
from bench import CUBE_ARTIFACT, HEIGHT, RELEASED_S, UPRIGHT, USUAL, WIDTH, about, eventually, with_cube
from hil_test import HilTest

FIRST, NEXT, LAST = 0, 1, 2
HALF = WIDTH // 2
IN_HAND = with_cube(USUAL)
STEREO = IN_HAND.replace("[eye]", '[eye]\nstereo = "side_by_side"\ninterocular_mm = 63.0')
ONE_EYE = IN_HAND.replace("[projector]", '[projector]\nstereo = "off"')


# (the prop's pose, the head's): the cube lifted and turned in all directions, the head turned to it
LOOKS = (
    ((0.0, 0.0, 0.10, *UPRIGHT), (0.0, -0.50, 0.50, *UPRIGHT)),
    ((0.05, 0.03, 0.15, *about(0.6, 0.0, 0.8, 35)), (0.15, -0.45, 0.45, *about(0, 0, 1, 25))),
    ((-0.06, 0.0, 0.12, *about(1, 0, 0, -40)), (-0.12, -0.45, 0.50, *about(0, 0.6, 0.8, -20))),
)
MIN_APART = 0.02  # share of an eye's lit pixels that the other's picture lacks; it is small, because the pictures are some pixels apart
NODDED_M = 0.004  # a head that moves wears the glasses
NOD_S = 0.4
SETTLED_S = 1.0  # until the filter rests and the second eye's picture comes
WORN_S = 60.0
BESIDE_THE_LETTERS = (-0.2, 0.0, 0.0)  # the prop's edges are drawn over them
MAX_ROUNDED = 20  # pixels: a driver may round differently in another part of the screen; the pictures of two eyes differ in hundreds
LYING_S = 30.0  # glasses count as lying after six seconds


def half_of(picture, eye):
    """The left (0) or the right (1) half."""
    rows = (picture.rgb[3 * (WIDTH * y + HALF * eye):3 * (WIDTH * y + HALF * (eye + 1))] for y in range(HEIGHT))
    return screen.Picture(HALF, HEIGHT, b"".join(rows))


def without_code(picture):
    """All rows but the first, which has the watchdog's code."""
    return picture.rgb[3 * picture.width:]


def differing(one, other):
    """The number of pixels that differ."""
    first, second = without_code(one), without_code(other)
    return sum(first[k:k + 3] != second[k:k + 3] for k in range(0, len(first), 3))


def quadrant(rows, box, right, below):
    """The lit pixels in a quarter of the box."""
    left, top, end, bottom = box
    middle, level = (left + end) // 2, (top + bottom) // 2
    mask = sum(1 << (HALF - 1 - x) for x in (range(middle + 1, end) if right else range(left, middle)))
    return screen.count([row & mask for row in (rows[level + 1:bottom] if below else rows[top:level])])


class Stereo(HilTest):
    settings = STEREO

    def setUp(self):
        super().setUp()
        self.show(CUBE_ARTIFACT)

    def render(self, settings, pose, head, *options):
        with tempfile.TemporaryDirectory() as folder:
            config = pathlib.Path(folder) / "kiosk.toml"
            config.write_text(settings, encoding="utf-8")
            return self.bench.render([pose], CUBE_ARTIFACT, head[:3], config, head[3:],
                                     ("--width", HALF, "--height", HEIGHT, *options))[0]

    def place_head_at(self, head):
        self.bench.tracker.tell("pose", *head, 2)

    def test_each_half_shows_the_picture_of_one_eye(self):
        for pose, head in LOOKS:
            with self.subTest(pose=pose):
                self.bench.place(pose[:3], pose[3:])
                eyes = [self.render(STEREO, pose, head, "--eye", eye) for eye in ("left", "right")]
                left, right = (screen.lit(eye) for eye in eyes)
                self.assertGreater(screen.share_outside(left, right) + screen.share_outside(right, left), MIN_APART,
                                   "both eyes see the same: this pose proves nothing")
                self.shows_worn(pose, head, eyes)
                self.shows_lying(pose, head)

    def shows_worn(self, pose, head, eyes):
        """Checks that each half is its eye's picture while the head nods from time to time."""
        why = [""]

        def are_shown():
            self.place_head_at((head[0], head[1], head[2] + NODDED_M, *head[3:]))
            self.bench.machine.let_run(NOD_S)
            self.place_head_at(head)
            self.bench.machine.let_run(SETTLED_S)
            picture = self.bench.picture_of(pose, head[:3])
            try:
                for number, eye in enumerate(eyes):
                    self.assert_same_place(half_of(picture, number), eye)
                self.assertNotEqual(without_code(half_of(picture, 0)), without_code(half_of(picture, 1)))
            except AssertionError as error:
                why[0] = str(error)
                return False
            return True

        eventually(are_shown, WORN_S, lambda: f"a half is not its eye's picture: {why[0]}")

    def shows_lying(self, pose, head):
        """When the head's sensor stops moving, both halves become the picture of the point between the eyes."""
        truth, why = self.render(ONE_EYE, pose, head), [""]

        def are_equal():
            picture = self.bench.picture_of(pose, head[:3])
            left, right = (half_of(picture, eye) for eye in (0, 1))
            try:
                self.assertLessEqual(differing(left, right), MAX_ROUNDED, "pixels differ")
                self.assert_same_place(left, truth)
            except AssertionError as error:
                why[0] = str(error)
                return False
            return True

        eventually(are_equal, LYING_S, lambda: f"glasses that lie keep two pictures, or another one: {why[0]}")

    def test_the_alignment_pattern_tells_the_eyes_apart(self):
        self.bench.place(BESIDE_THE_LETTERS)
        self.bench.hold((FIRST, LAST), lambda: self.bench.status_says("state", "staff"))
        try:
            self.bench.buttons.tell("press", NEXT, "300ms")
            eventually(self.has_letters, 20.0, "no L for the left eye and R for the right are on the pattern")
        finally:
            self.bench.machine.let_run(RELEASED_S)
            self.bench.hold((FIRST, LAST), lambda: self.bench.status_says("state", "^(?!staff)"))

    def has_letters(self):
        """Whether the halves differ only in two letters: one of the left half only, and to its right one of the right half only."""
        left, right = (screen.lit(half_of(self.bench.screendump(), eye)) for eye in (0, 1))
        letters = [[row & ~other for row, other in zip(mine, others)] for mine, others in ((left, right), (right, left))]
        boxes = [screen.box(letter, HALF) for letter in letters]
        if None in boxes or any(box[3] - box[1] > HEIGHT // 8 or box[2] - box[0] > HALF // 8 for box in boxes):
            return False
        (l, r), (l_box, r_box) = letters, boxes
        return (l_box[2] < r_box[0] and min(box[3] - box[1] for box in boxes) >= HEIGHT // 40
                and quadrant(l, l_box, right=True, below=False) == 0 and quadrant(l, l_box, right=True, below=True) > 0
                and quadrant(r, r_box, right=True, below=False) > 0)
