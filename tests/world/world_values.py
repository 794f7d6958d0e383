"""Tests curves and springs of app/world against SciPy: Slerp, CubicHermiteSpline, and the exponential of the spring's matrix.

    world_values.py PROGRAM

PROGRAM is tests/world/world_values.cpp, compiled. All input numbers are exact as 32-bit floats, so both sides read the same curve.
"""

import subprocess
import sys
import unittest

try:
    import numpy as np
    from scipy.interpolate import CubicHermiteSpline
    from scipy.linalg import expm
    from scipy.spatial.transform import Rotation, Slerp
except ImportError:
    print("SciPy is missing on this machine")
    sys.exit(77)

PROGRAM = sys.argv.pop(1)
LINEAR, CUBIC = 1, 2
TRANSLATION, ROTATION = 0, 1


def answers(lines):
    run = subprocess.run([PROGRAM], input="\n".join(lines) + "\n", capture_output=True, text=True, check=True)
    return np.array([[float(word) for word in line.split()] for line in run.stdout.splitlines()])


def words(numbers):
    return " ".join(repr(float(number)) for number in np.ravel(numbers))


def floats(numbers):
    return np.asarray(numbers, dtype=np.float32).astype(float)


def key_times(random, count):
    return floats(np.cumsum(random.uniform(0.01, 1.5, count)))


def some_seconds(random, times):
    return np.concatenate([random.uniform(times[0], times[-1], 40), times])


def curve_lines(interpolation, path, times, values, seconds):
    return [f"curve {interpolation} {path} {len(times)} {words(times)} {words(values)} {float(second)!r}" for second in seconds]


def rotations_off(ours, theirs):
    """Angles between pairs of rotations, by their matrices: both signs of a quaternion are one rotation."""
    return np.linalg.norm((Rotation.from_quat(ours).inv() * theirs).as_rotvec(), axis=1).max()


class Curves(unittest.TestCase):
    def test_linear_rotations_are_slerp(self):
        random = np.random.default_rng(1)
        for _ in range(30):
            times = key_times(random, random.integers(2, 9))
            quaternions = floats(Rotation.random(len(times), random_state=random.integers(1 << 30)).as_quat())
            quaternions *= random.choice([-1.0, 1.0], len(times))[:, None]
            seconds = some_seconds(random, times)
            ours = answers(curve_lines(LINEAR, ROTATION, times, quaternions, seconds))
            np.testing.assert_allclose(np.linalg.norm(ours, axis=1), 1.0, atol=1e-14)
            self.assertLess(rotations_off(ours, Slerp(times, Rotation.from_quat(quaternions))(seconds)), 1e-7)

    def test_linear_values_are_interpolated(self):
        random = np.random.default_rng(2)
        for _ in range(30):
            times = key_times(random, random.integers(1, 9))
            values = floats(random.normal(size=(len(times), 4)) * 10.0 ** random.integers(-6, 6))
            seconds = np.concatenate([some_seconds(random, times), [times[0] - 1.0, times[-1] + 1.0]])
            ours = answers(curve_lines(LINEAR, TRANSLATION, times, values, seconds))
            theirs = np.array([np.interp(seconds, times, column) for column in values.T]).T
            np.testing.assert_allclose(ours, theirs, rtol=1e-12, atol=1e-14 * np.abs(values).max())

    def test_cubic_splines_are_hermite(self):
        random = np.random.default_rng(3)
        for _ in range(30):
            times = key_times(random, random.integers(2, 9))
            # A Hermite spline of SciPy has one slope at a key. Each interval has two slopes of its own, so it becomes a spline of its own.
            values = floats(random.normal(size=(len(times), 3, 4)))
            for k in range(len(times) - 1):
                spline = CubicHermiteSpline(times[k:k + 2], [values[k, 1], values[k + 1, 1]], [values[k, 2], values[k + 1, 0]])
                seconds = random.uniform(times[k], times[k + 1], 20)
                ours = answers(curve_lines(CUBIC, TRANSLATION, times, values, seconds))
                np.testing.assert_allclose(ours, spline(seconds), rtol=1e-12, atol=1e-12)

    def test_cubic_rotations_are_hermite_and_unit(self):
        random = np.random.default_rng(4)
        for _ in range(30):
            times = key_times(random, 2)
            values = floats(random.normal(size=(2, 3, 4)))
            ends = [values[k, 1] / np.linalg.norm(values[k, 1]) for k in range(2)]
            spline = CubicHermiteSpline(times, ends, [values[0, 2], values[1, 0]])
            seconds = random.uniform(times[0], times[1], 40)
            theirs = spline(seconds)
            theirs /= np.linalg.norm(theirs, axis=1)[:, None]
            np.testing.assert_allclose(answers(curve_lines(CUBIC, ROTATION, times, values, seconds)), theirs, atol=1e-10)


class Springs(unittest.TestCase):
    def test_motions_are_the_matrix_exponential(self):
        random = np.random.default_rng(5)
        lines, theirs, scales = [], [], []
        for trial in range(600):
            stiffness = 10.0 ** random.uniform(-3, 9)
            rate = np.sqrt(stiffness)
            ratio = [1.0, 0.0, 10.0 ** random.uniform(-3, 2), 1.0 + 10.0 ** random.uniform(-15, -1)][trial % 4]
            damping = 2.0 * ratio * rate
            start = np.array([random.normal(), random.normal() * rate])
            seconds = 10.0 ** random.uniform(-3, 1) / rate
            lines.append(f"spring {stiffness!r} {damping!r} {start[0]!r} {start[1]!r} {seconds!r}")
            # In units of the spring's own time, which keep the exponential's entries near 1.
            matrix = np.array([[0.0, 1.0], [-1.0, -damping / rate]])
            x, v = expm(matrix * seconds * rate) @ [start[0], start[1] / rate]
            theirs.append([x, v])
            scales.append([1.0, rate])
        ours = answers(lines) / np.array(scales)
        np.testing.assert_allclose(ours, theirs, rtol=1e-9, atol=1e-11)


if __name__ == "__main__":
    unittest.main()
