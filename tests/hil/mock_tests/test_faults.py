import unittest

from mocks.faults import Faults, Frame, FramePath, flip_or_cut, parse_duration


class Clock:
    now = 0.0

    def __call__(self):
        return self.now


class Telling(unittest.TestCase):
    def setUp(self):
        self.clock = Clock()
        self.faults = Faults(seed=1, clock=self.clock)

    def test_durations(self):
        self.assertEqual(parse_duration("2s"), 2.0)
        self.assertEqual(parse_duration("300ms"), 0.3)
        for text in ("2", "s", "-1s", "2m", "1e3s"):
            self.assertIsNone(parse_duration(text))

    def test_a_fault_ends_after_its_duration_or_on_command(self):
        self.assertEqual(self.faults.tell("stall", ["2s"]), 2.0)
        self.assertTrue(self.faults.on("stall"))
        self.clock.now = 2.0
        self.assertFalse(self.faults.on("stall"))
        self.assertIsNone(self.faults.tell("stall", []))
        self.clock.now = 1e9
        self.assertTrue(self.faults.on("stall"))
        self.faults.tell("stall", ["off"])
        self.assertFalse(self.faults.on("stall"))

    def test_values(self):
        self.faults.tell("distortion", ["7", "2s"])
        self.assertEqual(self.faults.value("distortion"), 7)
        self.assertEqual(self.faults.active(), {"distortion": 7})
        self.clock.now = 3.0
        self.assertIsNone(self.faults.value("distortion"))

    def test_rejects_invalid_values(self):
        for name, words in (("drop", ["2"]), ("drop", ["x"]), ("distortion", ["256"]), ("stall", ["0.5"]),
                            ("drop", ["nan"])):
            with self.assertRaisesRegex(ValueError, name):
                self.faults.tell(name, words)


class Frames(unittest.TestCase):
    def path(self, seed=1):
        faults = Faults(seed)
        return faults, FramePath(faults, flip_or_cut)

    @staticmethod
    def frame(number, sequence=0):
        return Frame(bytes([number]) * 40, {}, sequence=sequence)

    def run_path(self, seed, *told):
        faults, path = self.path(seed)
        for name, *words in told:
            faults.tell(name, words)
        return [[(f.data, f.intact) for f in path.send(self.frame(k))] for k in range(200)]

    def test_without_faults_everything_passes(self):
        self.assertEqual(self.run_path(1), [[(bytes([k]) * 40, True)] for k in range(200)])

    def test_equal_seeds_give_equal_faults(self):
        told = [("drop", "0.2"), ("corrupt", "0.2"), ("duplicate", "0.2"), ("reorder", "0.2")]
        self.assertEqual(self.run_path(3, *told), self.run_path(3, *told))
        self.assertNotEqual(self.run_path(3, *told), self.run_path(4, *told))

    def test_reorder_swaps_with_the_successor_of_its_sequence(self):
        faults, path = self.path()
        faults.tell("reorder", ["1"])
        self.assertEqual(path.send(self.frame(1, sequence=1)), [])
        self.assertEqual(path.send(self.frame(2, sequence=2)), [])
        self.assertEqual([f.data[0] for f in path.send(self.frame(3, sequence=1))], [3, 1])
        self.assertEqual([f.data[0] for f in path.send(self.frame(4, sequence=2))], [4, 2])

    def test_counts(self):
        faults, path = self.path()
        for name in ("drop", "duplicate", "corrupt"):
            faults.tell(name, ["0.5"])
        sent = sum(len(path.send(self.frame(k))) for k in range(200))
        self.assertEqual(sent, 200 - path.counts["dropped"] + path.counts["duplicated"])
        self.assertTrue(40 < path.counts["dropped"] < 160)

    def test_a_corrupt_frame_differs_from_the_original(self):
        for frame in self.run_path(5, ("corrupt", "1")):
            self.assertFalse(frame[0][1])
        self.assertTrue(all(sent[0][0] != bytes([k]) * 40 for k, sent in enumerate(self.run_path(5, ("corrupt", "1")))))


if __name__ == "__main__":
    unittest.main()
