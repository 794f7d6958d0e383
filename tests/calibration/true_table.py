"""A table's truth for tests: a projector that hangs lower, aside and tilted, with lens shift and distortion, and a rotated tracker beside it.
The arithmetic is independent of the programs.

Frames   table, z = 0 on it, metres; tracker, its own; pixels, the centre of the top left one is (0.5, 0.5).
"""

import math

K1 = 0.05


def turn(axis, angle):
    """Rodrigues' formula; three rows."""
    x, y, z = (value / math.hypot(*axis) for value in axis)
    c, s = math.cos(angle), math.sin(angle)
    d = 1 - c
    return ((c + x * x * d, x * y * d - z * s, x * z * d + y * s),
            (y * x * d + z * s, c + y * y * d, y * z * d - x * s),
            (z * x * d - y * s, z * y * d + x * s, c + z * z * d))


def times(a, b):
    return tuple(tuple(sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)) for i in range(3))


def transposed(a):
    return tuple(zip(*a))


def apply(a, v):
    return tuple(sum(row[k] * v[k] for k in range(3)) for row in a)


def plus(a, b, share=1.0):
    return tuple(x + share * y for x, y in zip(a, b))


def quaternion(m):
    """The quaternion of a rotation by less than half a turn."""
    w = 0.5 * math.sqrt(1 + m[0][0] + m[1][1] + m[2][2])
    return w, (m[2][1] - m[1][2]) / (4 * w), (m[0][2] - m[2][0]) / (4 * w), (m[1][0] - m[0][1]) / (4 * w)


class TrueTable:
    """`width`: of the picture, whose height is 5/8 of it. `yaw`: of the tracker."""
    rotation = times(times(turn((0, 0, 1), 0.06), turn((1, 0.3, 0), 0.05)), ((1, 0, 0), (0, -1, 0), (0, 0, -1)))
    place = (0.06, -0.04, 1.44)
    tracker_place = (0.1, 0.2, -0.05)

    def __init__(self, width, yaw):
        self.width, self.height, self.yaw = width, width * 5 // 8, yaw
        self.f, self.cx, self.cy = (value / 1280 * width for value in (2350.0, 655.0, 470.0))
        self._tracker = turn((0, 0, 1), yaw)

    def light(self, u, v, height):
        """The place that a pixel lights at this height."""
        real = ((u - self.cx) / self.f, (v - self.cy) / self.f)
        x, y = real
        for _ in range(50):
            bend = 1 + K1 * (x * x + y * y)
            x, y = real[0] / bend, real[1] / bend
        ray = apply(self.rotation, (x, y, 1.0))
        return plus(self.place, ray, (height - self.place[2]) / ray[2])

    def pixel(self, point):
        x, y, z = apply(transposed(self.rotation), plus(point, self.place, -1.0))
        bend = 1 + K1 * (x * x + y * y) / (z * z)
        return self.f * bend * x / z + self.cx, self.f * bend * y / z + self.cy

    def in_tracker(self, point):
        return plus(apply(self._tracker, point), self.tracker_place)

    def report(self, place, yaw, sensor_m):
        """The tracker's report of a sensor at a height above this place: (x, y, z, qw, qx, qy, qz)."""
        half = 0.5 * (yaw + self.yaw)
        return (*self.in_tracker(plus(place, (0.0, 0.0, sensor_m))), math.cos(half), 0.0, 0.0, math.sin(half))

    def calibration(self, sensor_m):
        """The true table as a kept calibration in its own frame, TOML."""
        tracker = transposed(self._tracker)
        upright = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
        return (f'version = 1\nmade = "by hand"\nmethod = "touch"\nplaces = 9\n'
                f"[residual]\nmean_mm = 0.0\nworst_mm = 0.0\nmean_px = 0.0\n"
                f"[projector]\nwidth = {self.width}\nheight = {self.height}\n"
                f"fx = {self.f}\nfy = {self.f}\ncx = {self.cx}\ncy = {self.cy}\nk1 = {K1}\nk2 = 0.0\n"
                f"table_from_projector = {by_columns(self.rotation, self.place)}\n"
                f"[tracker]\ntable_from_tracker = {by_columns(tracker, apply(tracker, plus((0, 0, 0), self.tracker_place, -1.0)))}\n"
                f"sensor_from_prop = {by_columns(upright, (0.0, 0.0, -sensor_m))}\neye_in_sensor_m = [0.0, 0.0, 0.0]\n")


def by_columns(rotation, place):
    """The 16 numbers of a rigid transform, as in the settings."""
    columns = [(*column, 0.0) for column in transposed(rotation)] + [(*place, 1.0)]
    return [float(number) for column in columns for number in column]


def moved(numbers, point):
    """Applies the 16 numbers of a transform to a point."""
    return tuple(sum(numbers[4 * k + row] * (*point, 1.0)[k] for k in range(4)) for row in range(3))
