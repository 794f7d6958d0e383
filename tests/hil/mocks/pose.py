"""Rigid poses: position in metres, unit quaternion w, x, y, z (Hamilton)."""

import math
from typing import NamedTuple


class Pose(NamedTuple):
    """A transform named `to_from`: it maps coordinates of the sensor or prop into those of the table or tracker."""

    position: tuple = (0.0, 0.0, 0.0)
    quaternion: tuple = (1.0, 0.0, 0.0, 0.0)


IDENTITY = Pose()


def multiply(a, b):
    """The quaternion product a b."""
    aw, ax, ay, az = a
    bw, bx, by, bz = b
    return (
        aw * bw - ax * bx - ay * by - az * bz,
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
    )


def conjugate(q):
    return (q[0], -q[1], -q[2], -q[3])


def rotate(q, v):
    """The vector v turned by q."""
    return multiply(multiply(q, (0.0, *v)), conjugate(q))[1:]


def compose(a, b):
    """a_from_c of a_from_b and b_from_c; if one is the identity, the result is exactly the other."""
    if a == IDENTITY:
        return b
    turned = rotate(a.quaternion, b.position)
    position = tuple(t + p for t, p in zip(turned, a.position))
    return Pose(position, multiply(a.quaternion, b.quaternion))


def inverse(a):
    q = conjugate(a.quaternion)
    return Pose(tuple(-c for c in rotate(q, a.position)), q)


def normalized(quaternion):
    length = math.sqrt(sum(c * c for c in quaternion))
    if not length > 1e-6:
        raise ValueError("the quaternion is zero; allowed is a rotation, normally of length 1")
    return tuple(c / length for c in quaternion)


def from_matrix(numbers):
    """Makes a pose of 16 numbers, column by column, like `table_from_tracker` in the settings."""
    if len(numbers) != 16:
        raise ValueError(f"a rigid transform has 16 numbers, column by column; found {len(numbers)}")
    m = [numbers[0:3], numbers[4:7], numbers[8:11]]  # columns
    for a in range(3):
        for b in range(3):
            dot = sum(x * y for x, y in zip(m[a], m[b]))
            if abs(dot - (a == b)) > 1e-4:
                raise ValueError("the 16 numbers are no rigid transform: the columns are not unit and square")
    across = (m[0][1] * m[1][2] - m[0][2] * m[1][1], m[0][2] * m[1][0] - m[0][0] * m[1][2],
              m[0][0] * m[1][1] - m[0][1] * m[1][0])
    if sum(x * y for x, y in zip(across, m[2])) < 0:
        raise ValueError("the 16 numbers are no rigid transform: they mirror")
    # The largest of the four squares is safe to divide by (Shepperd 1978).
    trace = m[0][0] + m[1][1] + m[2][2]
    squares = [trace, m[0][0], m[1][1], m[2][2]]
    k = squares.index(max(squares))
    if k == 0:
        q = (1 + trace, m[1][2] - m[2][1], m[2][0] - m[0][2], m[0][1] - m[1][0])
    elif k == 1:
        q = (m[1][2] - m[2][1], 1 + 2 * m[0][0] - trace, m[0][1] + m[1][0], m[2][0] + m[0][2])
    elif k == 2:
        q = (m[2][0] - m[0][2], m[0][1] + m[1][0], 1 + 2 * m[1][1] - trace, m[1][2] + m[2][1])
    else:
        q = (m[0][1] - m[1][0], m[2][0] + m[0][2], m[1][2] + m[2][1], 1 + 2 * m[2][2] - trace)
    return Pose(tuple(numbers[12:15]), normalized(q))


def euler_deg(quaternion):
    """Azimuth, elevation, roll in degrees: rotations about Z, then Y, then X."""
    w, x, y, z = quaternion
    azimuth = math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    elevation = math.asin(max(-1.0, min(1.0, 2 * (w * y - x * z))))
    roll = math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    return tuple(math.degrees(angle) for angle in (azimuth, elevation, roll))
