import unittest

from mocks import pose_file
from mocks.player import Player
from mocks.pose import Pose

TEXT = f"""# two stations
{pose_file.HEADER}
1000000,1,0.1,0.2,0.3,1,0,0,0,1
1000000,2,0,0,1,0,2,0,0,1
1500000,1,0.4,0.5,0.6,1,0,0,0,1
2000000,1,0,0,0,1,0,0,0,0
"""


class PoseFiles(unittest.TestCase):
    def test_uses_the_latest_row_unchanged(self):
        file = pose_file.parse(TEXT, "test")
        self.assertEqual(file.at(999_999), {})
        self.assertEqual(file.at(1_499_999)[1].position, (0.1, 0.2, 0.3))
        self.assertEqual(file.at(1_500_000)[1].position, (0.4, 0.5, 0.6))
        self.assertEqual(file.at(1_500_000)[2], Pose((0, 0, 1), (0, 1, 0, 0)))
        self.assertIsNone(file.at(2_000_000)[1])

    def test_reports_invalid_rows_with_their_line(self):
        for row, words in (("1,1,0,0,0,1,0,0,0", "9 fields"), ("1,1,0,0,0,0,0,0,0,1", "quaternion is zero"),
                           ("x,1,0,0,0,1,0,0,0,1", "invalid literal")):
            with self.assertRaisesRegex(ValueError, f"file:2: .*{words}"):
                pose_file.parse(pose_file.HEADER + "\n" + row, "file")
        with self.assertRaisesRegex(ValueError, "header"):
            pose_file.parse("t,station\n", "file")
        with self.assertRaisesRegex(ValueError, "no rows"):
            pose_file.parse(pose_file.HEADER, "file")

    def test_round_trip_of_a_row(self):
        pose = Pose((0.1, -1 / 3, 1e-9), (0.5, 0.5, -0.5, 0.5))
        file = pose_file.parse(pose_file.HEADER + "\n" + pose_file.row(7, 3, pose) + pose_file.row(8, 3, None), "test")
        self.assertEqual(file.at(7)[3], pose)
        self.assertIsNone(file.at(8)[3])


class Playing(unittest.TestCase):
    def test_a_file_plays_from_its_beginning_and_its_last_poses_stay(self):
        player = Player()
        self.assertEqual(player.poses(0.0), {1: Pose()})
        player.play(pose_file.parse(TEXT, "test"), 100.0)
        self.assertEqual(player.poses(100.0)[1].position, (0.1, 0.2, 0.3))
        self.assertEqual(player.poses(100.6)[1].position, (0.4, 0.5, 0.6))
        self.assertIsNone(player.poses(1000.0)[1])

    def test_loop_and_speed(self):
        player = Player(loop=True, speed=2.0)
        player.play(pose_file.parse(TEXT, "test"), 100.0)
        self.assertEqual(player.poses(100.3)[1].position, (0.4, 0.5, 0.6))
        self.assertEqual(player.poses(100.55)[1].position, (0.1, 0.2, 0.3))

    def test_a_manual_pose_overrides_the_file(self):
        player = Player()
        player.play(pose_file.parse(TEXT, "test"), 0.0)
        player.place(1, Pose((9, 9, 9)))
        self.assertEqual(player.poses(0.6)[1].position, (9, 9, 9))
        self.assertEqual(player.poses(0.6)[2].position, (0, 0, 1))

    def test_removes_a_station(self):
        player = Player()
        player.place(3, Pose((1, 2, 3)))
        self.assertEqual(list(player.poses(0.0)), [1, 3])
        player.take_away(3)
        player.take_away(2)
        self.assertEqual(list(player.poses(0.0)), [1])


if __name__ == "__main__":
    unittest.main()
