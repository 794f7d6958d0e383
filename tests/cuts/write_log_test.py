"""Tests the log of a disk's writes and its replay, on examples made by hand and with safe and unsafe writers."""

import pathlib
import random
import subprocess
import tempfile
import unittest

from client import Client
from states import TOOLS, partitions
from write_log import FLUSH, MARK, SECTOR, WRITE, RecordedDisk, Replay, copy_part, moments

SEEDS = range(300)


def sector(letter):
    return letter.encode() * SECTOR


class Recorded(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.image, self.log = self.folder / "image", self.folder / "log"
        self.image.write_bytes(sector(".") * 8)
        (self.folder / "disk").write_bytes(self.image.read_bytes())

    def record(self, machine):
        """`machine(client, disk)` writes."""
        disk = RecordedDisk(self.folder / "socket", self.folder / "disk", self.log)
        client = Client(self.folder / "socket")
        machine(client, disk)
        client.close()
        disk.stop()

    def left(self, at, heeds_flushes=True):
        """All disks that cuts before record `at` leave: one letter for each sector, or the whole sector if it has different letters."""
        replay = Replay(self.image, self.log, self.folder / "now", heeds_flushes)
        replay.advance(at)
        found = set()
        for seed in SEEDS:
            replay.cut(random.Random(seed))
            data = (self.folder / "now").read_bytes()
            parts = [data[begin:begin + SECTOR] for begin in range(0, len(data), SECTOR)]
            self.assertTrue(all(part == part[:1] * SECTOR for part in parts), "a sector is torn")
            found.add("".join(chr(part[0]) for part in parts))
            replay.mend()
        replay.close()
        return found


class Log(Recorded):
    def test_records_and_cuts_a_hand_made_log(self):
        def machine(client, disk):
            client.write(0, sector("a") * 2)
            client.flush()
            disk.mark("first")
            client.write(SECTOR, sector("b") * 2)
            client.write(4 * SECTOR, sector("c"), through=True)
            client.write(SECTOR, sector("d"))
            self.assertEqual(client.read(0, 5 * SECTOR), sector("a") + sector("d") + sector("b") + sector(".") + sector("c"))

        self.record(machine)
        replay = Replay(self.image, self.log, self.folder / "now")
        self.assertEqual([(entry.kind, entry.through, entry.place, entry.length) for entry in replay.entries],
                         [(WRITE, False, 0, 1024), (FLUSH, False, 0, 0), (MARK, False, 0, 5), (WRITE, False, 512, 1024),
                          (WRITE, True, 2048, 512), (WRITE, False, 512, 512)])
        self.assertEqual(replay.words(replay.entries[2]), "first")
        replay.close()
        self.assertEqual(self.left(0), {"........"})
        self.assertEqual(self.left(1), {"........", "a.......", ".a......", "aa......"})
        self.assertEqual(self.left(2), {"aa......"})
        self.assertEqual(self.left(4), {"aa......", "ab......", "aab.....", "abb....."})
        with_fua = {first + second + ".c..." for first in ("aa", "ab", "ad") for second in (".", "b")}
        self.assertEqual(self.left(6), with_fua, "FUA has not arrived, or something else has")
        self.assertLess({"aa......"}, self.left(2, heeds_flushes=False), "a disk that lies loses nothing")

    def test_writes_may_be_torn_or_reordered(self):
        """A command of many sectors is there, not there, or torn; later ones may be there without earlier ones."""
        def machine(client, _disk):
            client.write(0, sector("x") * 4)
            client.write(4 * SECTOR, sector("y") * 4)

        self.record(machine)
        found = self.left(2)
        self.assertLessEqual({"........", "xxxxyyyy", "xxxx....", "....yyyy"}, found)
        self.assertGreater(len(found), 30)

    def test_moments(self):
        """Each phase has as many cuts as requested, all within it, half of them at the few writes outside the data; a seed repeats them."""
        def machine(client, disk):
            for phase in ("one", "two"):
                disk.mark('{"phase": "%s"}' % phase)
                for number in range(20):
                    client.write(4 * SECTOR, sector("d"))
                    client.flush()
                    if number == 7:
                        client.write(0, sector("e"))
                        client.flush()

        self.record(machine)
        replay = Replay(self.image, self.log, self.folder / "now")
        chosen = moments(replay, 200, random.Random(3), (SECTOR, 8 * SECTOR))
        self.assertEqual(chosen, moments(replay, 200, random.Random(3), (SECTOR, 8 * SECTOR)))
        self.assertNotEqual(chosen, moments(replay, 200, random.Random(4), (SECTOR, 8 * SECTOR)))
        for phase, begin in (("one", 0), ("two", 43)):
            found = [at for at, of, _ in chosen if of == phase]
            self.assertEqual(len(found), 200)
            self.assertTrue(all(begin < at <= begin + 43 and replay.entries[at - 1].kind == WRITE for at in found))
            rare = [at for at in found if replay.entries[at - 1].place == 0]
            self.assertTrue(100 <= len(rare) < 130, len(rare))
        replay.close()

    def test_a_part_with_holes(self):
        sparse = self.folder / "sparse"
        with open(sparse, "wb") as file:
            file.truncate(4 << 20)
            file.seek((1 << 20) + 5)
            file.write(b"here")
        copy_part(sparse, 1 << 20, 2 << 20, self.folder / "part")
        part = (self.folder / "part").read_bytes()
        self.assertEqual((len(part), part[5:9], part.count(0)), (2 << 20, b"here", (2 << 20) - 4))


class Writers(Recorded):
    """Writers that repeatedly put a record of two sectors on the disk, and mark when it is kept. The first sector of the disk has the place
    of the newest record."""

    def keep(self, flushes_data, flushes_name):
        def machine(client, disk):
            for number, letter in enumerate("ABCDEFGH"):
                place = 1 + 2 * (number % 2)
                client.write(place * SECTOR, sector(letter) * 2)
                if flushes_data:
                    client.flush()
                client.write(0, sector("12"[number % 2]))
                if flushes_name:
                    client.flush()
                disk.mark(letter)

        self.record(machine)

    def damage(self, heeds_flushes=True):
        """(torn, lost): on how many of the disks that cuts leave the newest record is incomplete, and on how many it is older than kept."""
        replay = Replay(self.image, self.log, self.folder / "now", heeds_flushes)
        torn = lost = 0
        kept = ""
        for at, entry in enumerate(replay.entries):
            replay.advance(at)
            for seed in range(20):
                replay.cut(random.Random(1000 * at + seed))
                data = (self.folder / "now").read_bytes()
                if data[:1] != b".":
                    place = SECTOR * (1 + 2 * (int(data[:1]) - 1))
                    record = data[place:place + 2 * SECTOR]
                    torn += record != record[:1] * 2 * SECTOR or record[:1] == b"."
                    lost += record[:1].decode() < kept
                else:
                    lost += kept != ""
                replay.mend()
            if entry.kind == MARK:
                kept = replay.words(entry)
        replay.close()
        return torn, lost

    def test_safe(self):
        self.keep(True, True)
        self.assertEqual(self.damage(), (0, 0))

    def test_loses_data_on_a_disk_that_ignores_flushes(self):
        self.keep(True, True)
        torn, lost = self.damage(heeds_flushes=False)
        self.assertGreater(torn, 0)
        self.assertGreater(lost, 0)

    def test_without_a_flush_before_the_name(self):
        self.keep(False, True)
        self.assertGreater(self.damage()[0], 0)

    def test_without_a_flush_after_the_name(self):
        self.keep(True, False)
        self.assertGreater(self.damage()[1], 0)


class Table(unittest.TestCase):
    """Compares the reader of partition tables with sfdisk, which writes them."""

    def test_uses_the_second_table_if_the_first_is_damaged(self):
        with tempfile.TemporaryDirectory() as folder:
            disk = pathlib.Path(folder) / "disk"
            with open(disk, "wb") as file:
                file.truncate(8 << 20)
            subprocess.run(["sfdisk", "--quiet", disk], check=True, text=True, input="label: gpt\nstart=1MiB, size=2MiB, name=one\n"
                           "start=3MiB, size=1MiB, name=two\n", env=TOOLS)
            wanted = {"one": (1 << 20, 2 << 20), "two": (3 << 20, 1 << 20)}
            size = disk.stat().st_size
            self.assertEqual(partitions(disk, size), (wanted, "first"))
            for place in (SECTOR + 40, 2 * SECTOR + 128 + 33):  # of the first table: header, then the second entry
                data = bytearray(disk.read_bytes())
                data[place] ^= 1
                (pathlib.Path(folder) / "damaged").write_bytes(data)
                self.assertEqual(partitions(pathlib.Path(folder) / "damaged", size), (wanted, "second"))
                data[-SECTOR + 16] ^= 1
                (pathlib.Path(folder) / "damaged").write_bytes(data)
                self.assertEqual(partitions(pathlib.Path(folder) / "damaged", size), (None, "second"))


if __name__ == "__main__":
    unittest.main()
