import math
import unittest

from mocks.pose import IDENTITY, Pose, compose, euler_deg, from_matrix, inverse, rotate

HALF = math.sqrt(0.5)
QUARTER_TURN_ABOUT_Z = (HALF, 0.0, 0.0, HALF)


class Poses(unittest.TestCase):
    def assert_close(self, found, expected):
        for a, b in zip(found, expected, strict=True):
            self.assertAlmostEqual(a, b, places=12)

    def test_a_quarter_turn_about_z_takes_x_to_y(self):
        self.assert_close(rotate(QUARTER_TURN_ABOUT_Z, (1, 0, 0)), (0, 1, 0))

    def test_a_matrix_is_read_column_by_column(self):
        pose = from_matrix([0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0.5, -0.25, 2, 1])
        self.assert_close(pose.quaternion, QUARTER_TURN_ABOUT_Z)
        self.assert_close(pose.position, (0.5, -0.25, 2))

    def test_half_turns_about_each_axis_are_read(self):
        for axis in range(3):
            diagonal = [1 if k == axis else -1 for k in range(3)]
            numbers = [diagonal[0], 0, 0, 0, 0, diagonal[1], 0, 0, 0, 0, diagonal[2], 0, 0, 0, 0, 1]
            found = [abs(c) for c in from_matrix(numbers).quaternion]
            self.assert_close(found, [0] + [int(k == axis) for k in range(3)])

    def test_a_matrix_that_is_not_rigid_is_refused(self):
        with self.assertRaisesRegex(ValueError, "no rigid transform"):
            from_matrix([2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])
        with self.assertRaisesRegex(ValueError, "no rigid transform"):  # a mirror
            from_matrix([-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])
        with self.assertRaisesRegex(ValueError, "16 numbers"):
            from_matrix([1, 2, 3])

    def test_inverse_undoes_a_pose(self):
        pose = Pose((0.3, -0.2, 0.7), QUARTER_TURN_ABOUT_Z)
        back = compose(inverse(pose), pose)
        self.assert_close(back.position, (0, 0, 0))
        self.assert_close(back.quaternion, (1, 0, 0, 0))

    def test_the_identity_changes_no_bit(self):
        pose = Pose((0.1, 0.2, 0.3), (0.1, 0.7, 0.1, 0.7))
        self.assertIs(compose(inverse(IDENTITY), pose), pose)

    def test_azimuth_elevation_roll(self):
        self.assert_close(euler_deg(QUARTER_TURN_ABOUT_Z), (90, 0, 0))
        self.assert_close(euler_deg((math.cos(0.25), math.sin(0.25), 0, 0)), (0, 0, math.degrees(0.5)))


if __name__ == "__main__":
    unittest.main()
