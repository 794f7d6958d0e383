"""A camera's view: AprilTags on the table, and a person at it. Drawn by ray casting, with arithmetic independent of the exhibit's.

Frame    table T, metres; pixels, the centre of the top left one is (0.5, 0.5).
Shape    luma[height][width], row 0 at the top, one byte a pixel.
Source   the tags' modules: libapriltag, by its own drawing of a tag. Measures of heads: ANSUR II, 2012.
"""

import ctypes
import functools
import math
import sys
import pathlib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "calibration"))
from true_table import apply, by_columns, plus, transposed, turn  # pylint: disable=wrong-import-position

MODULES, BLACK_MODULES = 10, 8  # in a row, with and without the white ones around
PAPER, INK, WOOD = 205, 30, 110  # codes


class View:
    """An ideal pinhole. `rotation`: the rows of table_from_camera's; its +X is right in the picture, +Y down, +Z ahead."""

    def __init__(self, width, height, focal_px, rotation, place):
        self.width, self.height, self.focal_px, self.rotation, self.place = width, height, focal_px, rotation, place

    def settings(self):
        """This camera as settings of the exhibit."""
        return (f"width = {self.width}\nheight = {self.height}\nfx = {self.focal_px}\n"
                f"table_from_camera = {by_columns(self.rotation, self.place)}\n")

    def ray(self, u, v):
        return apply(self.rotation, ((u - 0.5 * self.width) / self.focal_px, (v - 0.5 * self.height) / self.focal_px, 1.0))

    def on_table(self, u, v):
        ray = self.ray(u, v)
        return plus(self.place, ray, -self.place[2] / ray[2])

    def pixel(self, point):
        x, y, z = apply(transposed(self.rotation), plus(point, self.place, -1.0))
        return 0.5 * self.width + self.focal_px * x / z, 0.5 * self.height + self.focal_px * y / z


def looks(pitch, yaw):
    """A camera tilted up from the table's plane by this angle, its picture's top up. `yaw`: 0 looks along +Y."""
    ahead = (-math.sin(yaw) * math.cos(pitch), math.cos(yaw) * math.cos(pitch), math.sin(pitch))
    right = (math.cos(yaw), math.sin(yaw), 0.0)
    down = (ahead[1] * right[2] - ahead[2] * right[1], ahead[2] * right[0] - ahead[0] * right[2], ahead[0] * right[1] - ahead[1] * right[0])
    return transposed((right, down, ahead))


# Tags.

class _Image(ctypes.Structure):
    _fields_ = [("width", ctypes.c_int32), ("height", ctypes.c_int32), ("stride", ctypes.c_int32), ("buf", ctypes.POINTER(ctypes.c_uint8))]


@functools.lru_cache(None)
def modules(number):
    """[row][column] of the tag as it is printed; True: white."""
    library = ctypes.CDLL("libapriltag.so.3")
    library.tag36h11_create.restype = ctypes.c_void_p
    library.apriltag_to_image.restype = ctypes.POINTER(_Image)
    image = library.apriltag_to_image(ctypes.c_void_p(library.tag36h11_create()), number).contents
    assert (image.width, image.height) == (MODULES, MODULES)
    return tuple(tuple(image.buf[row * image.stride + column] > 127 for column in range(MODULES)) for row in range(MODULES))


class Tag:
    """A tag that lies face up in the plane of the prop's foot. `turn_deg`: 0: the tag's top points to the prop's +Y."""

    def __init__(self, number, size_m, middle, turn_deg):
        self.number, self.size_m, self.middle, self.turn_deg = number, size_m, middle, turn_deg

    def settings(self):
        return (f"{{ id = {self.number}, size_m = {self.size_m}, centre_m = [{self.middle[0]}, {self.middle[1]}, 0.0], "
                f"turn_deg = {self.turn_deg} }}")


def skirt(side_m, size_m, sides):
    """A tag at the middle of each of `count` sides of a square foot, from the front counter-clockwise, the white margins at the edge."""
    out = 0.5 * side_m + 0.625 * size_m
    middles = [apply(turn((0, 0, 1), 0.5 * math.pi * side), (0.0, -out, 0.0)) for side in range(sides)]
    return [Tag(side, size_m, (round(x, 6), round(y, 6)), 90.0 * side) for side, (x, y, _) in enumerate(middles)]


def tags_seen(view, tags, place, yaw, samples=3):
    """The picture of the prop's tags with the prop at this place of the table; each pixel is the mean of samples x samples rays."""
    luma = bytearray([WOOD]) * (view.width * view.height)
    for tag in tags:
        _draw(view, tag, place, yaw, samples, luma)
    return bytes(luma)


def _draw(view, tag, place, yaw, samples, luma):
    table_from_tag = turn((0, 0, 1), yaw + math.radians(tag.turn_deg))
    middle = plus(place, apply(turn((0, 0, 1), yaw), (*tag.middle, 0.0)))
    module_m = tag.size_m / BLACK_MODULES
    half = 0.5 * MODULES * module_m
    corners = [view.pixel(plus(middle, apply(table_from_tag, (x, y, 0.0)))) for x in (-half, half) for y in (-half, half)]
    # The camera in the tag's frame: where it is, and the ray of a pixel, (u, v, 1) times three columns.
    tag_from_table = transposed(table_from_tag)
    ox, oy, oz = apply(tag_from_table, plus(view.place, middle, -1.0))
    first = view.ray(0.0, 0.0)
    columns = [apply(tag_from_table, column) for column in (plus(view.ray(1.0, 0.0), first, -1.0), plus(view.ray(0.0, 1.0), first, -1.0), first)]
    (ux, uy, uz), (vx, vy, vz), (fx, fy, fz) = columns
    white = modules(tag.number)
    steps = [((k % samples + 0.5) / samples, (k // samples + 0.5) / samples) for k in range(samples * samples)]
    for row in range(max(0, int(min(y for _, y in corners))), min(view.height, int(max(y for _, y in corners)) + 1)):
        for column in range(max(0, int(min(x for x, _ in corners))), min(view.width, int(max(x for x, _ in corners)) + 1)):
            total = 0
            for du, dv in steps:
                u, v = column + du, row + dv
                away = -oz / (u * uz + v * vz + fz)
                x, y = ox + away * (u * ux + v * vx + fx), oy + away * (u * uy + v * vy + fy)
                if max(abs(x), abs(y)) >= half:
                    total += WOOD
                else:
                    total += PAPER if white[int((half - y) / module_m)][int((x + half) / module_m)] else INK
            luma[row * view.width + column] = total // len(steps)


# A visitor.

BREADTH_M, LENGTH_M, HEIGHT_M = 0.152, 0.193, 0.230  # of a head: at the temples, brow to back, crown to chin
HAIR_M = 0.015
EYES_BEHIND_FACE_M = 0.01
HAIR, SKIN, CLOTHES = 45, 170, 65  # codes


class _Ball:
    """An ellipsoid. `axes`: three rows, unit; `half`: its half lengths along them."""

    def __init__(self, middle, axes, half, code):
        self._middle, self.code = middle, code
        self._form = [[sum(axis[i] * axis[k] / size ** 2 for axis, size in zip(axes, half)) for k in range(3)] for i in range(3)]

    def seen_from(self, origin):
        """The distance to the surface along a ray from that point; None if the ray misses."""
        o = plus(origin, self._middle, -1.0)
        (xx, xy, xz), (_, yy, yz), (_, _, zz) = self._form
        bx, by, bz = apply(self._form, o)
        c = bx * o[0] + by * o[1] + bz * o[2] - 1.0

        def meets(x, y, z):
            a = x * (xx * x + 2.0 * (xy * y + xz * z)) + y * (yy * y + 2.0 * yz * z) + zz * z * z
            b = bx * x + by * y + bz * z
            root = b * b - a * c
            return (-b - math.sqrt(root)) / a if root > 0.0 and b < 0.0 else None

        return meets


def body(eye, looked_at):
    """A person with the point between the eyes at this place, the head bent half of the way down."""
    x, y, z = plus(looked_at, eye, -1.0)
    pitch = 0.5 * math.atan2(-z, math.hypot(x, y))
    ahead = (x * math.cos(pitch) / math.hypot(x, y), y * math.cos(pitch) / math.hypot(x, y), -math.sin(pitch))
    right = (y / math.hypot(x, y), -x / math.hypot(x, y), 0.0)
    up = (right[1] * ahead[2] - right[2] * ahead[1], right[2] * ahead[0] - right[0] * ahead[2], right[0] * ahead[1] - right[1] * ahead[0])
    axes, upright = (right, ahead, up), (right, (-right[1], right[0], 0.0), (0.0, 0.0, 1.0))
    skull = plus(eye, ahead, EYES_BEHIND_FACE_M - 0.5 * LENGTH_M)
    hair = plus(plus(skull, up, 0.02), ahead, -0.012)
    neck = plus(plus(skull, upright[1], -0.03), (0.0, 0.0, -0.15))
    trunk = plus(neck, (0.0, 0.0, -0.33))
    return [_Ball(skull, axes, (0.5 * BREADTH_M, 0.5 * LENGTH_M, 0.5 * HEIGHT_M), SKIN),
            _Ball(hair, axes, (0.5 * BREADTH_M + HAIR_M, 0.5 * LENGTH_M, 0.5 * HEIGHT_M - 0.005), HAIR),
            _Ball(neck, upright, (0.06, 0.06, 0.12), SKIN),
            _Ball(trunk, upright, (0.22, 0.13, 0.30), CLOTHES)]


def room_seen(view, people=()):
    """A room with a patterned wall, the table in front of it, and people made of the balls of `body`."""
    luma = bytearray()
    balls = [(ball.seen_from(view.place), ball.code) for ball in people]
    for v in range(view.height):
        for u in range(view.width):
            x, y, z = view.ray(u + 0.5, v + 0.5)
            met = [(away, code) for meets, code in balls if (away := meets(x, y, z)) is not None]
            luma.append(min(met)[1] if met else WOOD - 20 if z < 0.0 else _wall(x, y, z))
    return bytes(luma)


def _wall(x, y, z):
    return 115 + round(12 * math.sin(9.0 * math.atan2(x, -y)) + 12 * math.sin(13.0 * z / math.hypot(x, y)))
