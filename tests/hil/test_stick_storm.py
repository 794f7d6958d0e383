"""Sticks and disks that fail: pulled out a hundred times, the power of the library's disk cut twenty times, damaged file systems,
slow and changing sticks. Whatever happens, the set is the old one or the new one, whole, and the next stick is taken."""

import os
import random
import shutil
import time

import nbd
import sticks
from bench import eventually
from hil_test import long
from stick_bench import IMPORT_S, LIBRARY, StickTest

PULLS = int(os.environ.get("FRUSTUMSCREEN_HIL_PULLS", "100"))
CUTS = int(os.environ.get("FRUSTUMSCREEN_HIL_CUTS", "20"))
DAMAGED_EACH = 5
SLOW_READ_S = 5.0
LIBRARY_MIB = 160
DISK = "/dev/disk/by-id/usb-QEMU_QEMU_HARDDISK_library-0:0"


@long
class StickStorm(StickTest):
    def ends(self):
        """Waits until nothing of a stick runs any more."""
        eventually(lambda: not self.units(), 2 * IMPORT_S, lambda: f"units of a stick stay: {self.units()}")

    def take(self, serial, kind="vfat"):
        """A whole import; the seconds that it took."""
        self.plug("whole", self.make("whole", kind, {"vase.fspack": self.signed("amphora", serial)}))
        begun = time.monotonic()
        self.outcome()
        took = time.monotonic() - begun
        self.pull("whole")
        self.ends()
        self.assertEqual(self.installed(), [("amphora", serial)])
        return took

    def test_pulled_out(self):
        chance = random.Random(1)
        took_s = self.take(1)
        serial, was_taken = 1, 0
        for number in range(PULLS):
            self.plug("pulled", self.make("pulled", chance.choice(sticks.KINDS), {"vase.fspack": self.signed("amphora", serial + 1)}))
            time.sleep(chance.uniform(0.2, 1.2) * took_s)
            self.pull("pulled")
            self.ends()
            now = self.installed()
            self.assertIn(now, ([("amphora", serial)], [("amphora", serial + 1)]), f"after pull {number}")
            if now == [("amphora", serial + 1)]:
                serial, was_taken = serial + 1, was_taken + 1
        print(f"  {PULLS} pulls, in {was_taken} of them the new set was there already", flush=True)
        self.take(serial + 1)

    def mount_library(self, source):
        self.bench.machine.plug("library", source, serial="library")
        eventually(lambda: self.bench.machine.run(f"test -b {DISK}").status == 0, 60.0, "the library's disk does not come")
        self.bench.machine.check(f"udevadm settle; mount -o noatime {DISK} {LIBRARY} && systemd-tmpfiles --create frustumscreen.conf")

    def unmount_library(self):
        self.bench.machine.run(f"umount {LIBRARY} || umount --lazy {LIBRARY}")
        self.bench.machine.pull("library")
        eventually(lambda: self.bench.machine.run(f"test -b {DISK}").status != 0, 60.0, "the library's disk does not go")

    def cut_after(self, writes, old, survivor, seed):
        """Imports with a power cut of the library's disk; how many writes it had until then."""
        disk = nbd.Disk(self.folder / "disk", old, cut_after=writes, seed=seed)
        try:
            self.mount_library(disk.path)
            begun = disk.writes
            self.plug("new", self.image("new"))
            eventually(lambda: disk.is_cut.is_set() or (self.report() or {}).get("stage") == "done"
                       and self.report()["import_id"] != self.last, 2 * IMPORT_S, "neither a cut nor an import")
            self.ends()
            self.last = (self.report() or {}).get("import_id", self.last)
            self.pull("new")
            disk.cut()
            self.unmount_library()
            disk.survived(survivor)
            return begun, disk.writes
        finally:
            disk.stop()

    def test_power_cut(self):
        old, survivor = self.image("library_old"), self.image("library_survivor")
        sticks.file_system(old, "ext4", {}, LIBRARY_MIB, "LIBRARY")
        self.make("old", "vfat", {"vase.fspack": self.signed("amphora", 1)})
        self.make("new", "vfat", {"vase.fspack": self.signed("amphora", 2), "cup.fspack": self.signed("nautilus-cup", 2)})
        sets = ([("amphora", 1)], [("amphora", 2), ("nautilus-cup", 2)])
        self.mount_library(old)
        self.plug("old", self.image("old"))
        self.outcome()
        self.pull("old")
        self.ends()
        self.unmount_library()
        begun, ended = self.cut_after(1 << 30, old, survivor, 0)
        chance = random.Random(2)
        new = 0
        for number in range(CUTS):
            writes = chance.randint(begun + 1, ended)
            self.cut_after(writes, old, survivor, number)
            shutil.copyfile(survivor, self.image("library_check"))
            self.mount_library(self.image("library_check"))
            found = sorted(self.installed())
            self.assertIn(found, sets, f"cut {number}, after {writes} of {ended} writes")
            new += found == sets[1]
            self.plug("new", self.image("new"))
            self.outcome()
            self.pull("new")
            self.ends()
            self.assertEqual(sorted(self.installed()), sets[1], f"the stick again, after cut {number}")
            self.unmount_library()
        print(f"  {CUTS} cuts in {ended - begun} writes; {new} times it was the new set", flush=True)

    def test_damaged_file_systems(self):
        chance = random.Random(3)
        self.take(1)
        told = {}
        for kind in sticks.KINDS:
            self.make("sound", kind, {"vase.fspack": self.signed("amphora", 1), "cup.fspack": self.signed("nautilus-cup", 1)})
            for _ in range(DAMAGED_EACH):
                damaged = self.image("damaged")
                shutil.copyfile(self.image("sound"), damaged)
                with open(damaged, "r+b") as file:
                    for _ in range(chance.choice((20, 200, 2000))):
                        file.seek(chance.randrange(512, 4 << 20))
                        file.write(chance.randbytes(chance.choice((1, 16, 64))))
                self.plug("damaged", damaged)
                report = self.outcome(2 * IMPORT_S)
                told.setdefault(kind, []).append(f"{report['stage']} {report['refusal']}")
                self.pull("damaged")
                self.ends()
                self.installed()
        print("".join(f"  {kind}: {', '.join(what)}\n" for kind, what in told.items()), end="", flush=True)
        self.take(9)

    def test_slow_reads(self):
        """Each read takes five seconds: the kernel and udev alone need minutes."""
        self.take(1)
        disk = nbd.Disk(self.folder / "disk", self.make("slow", "vfat", {"vase.fspack": self.signed("amphora", 2)}), delay_s=SLOW_READ_S)
        try:
            self.plug("slow", disk.path)
            begun = time.monotonic()
            while time.monotonic() - begun < 300.0 and (self.report() or {}).get("import_id") == self.last:
                time.sleep(1.0)
            report = self.report() or {}
            print(f"  {disk.reads} reads in {time.monotonic() - begun:.0f} s; {report.get('stage')} {report.get('refusal')}", flush=True)
            self.pull("slow")
        finally:
            disk.stop()
        self.ends()
        self.last = (self.report() or {}).get("import_id")
        self.assertIn(self.installed(), ([("amphora", 1)], [("amphora", 2)]))
        self.take(3)

    def test_two_terabytes(self):
        image = self.make("small", "vfat", {"vase.fspack": self.signed("amphora", 5)})
        disk = nbd.Disk(self.folder / "disk", image, size=2 << 40)
        try:
            self.plug("large", disk.path)
            self.assertEqual(self.outcome()["stage"], "done")
            self.pull("large")
            self.assertEqual(disk.writes, 0, "something was written to the stick")
        finally:
            disk.stop()
        self.ends()
        self.assertEqual(self.installed(), [("amphora", 5)])

    def test_changing_contents(self):
        """What is read a second time is something else: what was checked is what is used."""
        self.take(1)
        image = self.make("changing", "vfat", {"vase.fspack": self.signed("amphora", 2)})
        data = image.read_bytes()
        pack = self.signed("amphora", 2).read_bytes()
        begins = data.index(pack[:512])
        for seed in range(4):
            chance, seen = random.Random(seed), set()

            def change(now, place, chance=chance, seen=seen):
                if place in seen:
                    for _ in range(8):
                        now[begins + chance.randrange(len(pack))] = chance.randrange(256)
                seen.add(place)

            disk = nbd.Disk(self.folder / "disk", image, change=change)
            try:
                self.plug("changing", disk.path)
                self.outcome()
                self.bench.machine.run("echo 3 > /proc/sys/vm/drop_caches")
                self.pull("changing")
            finally:
                disk.stop()
            self.ends()
            self.assertIn(self.installed(), ([("amphora", 1)], [("amphora", 2)]))
            for name in self.bench.machine.check(f"ls {LIBRARY}/packs").split():
                self.bench.machine.check(f"frustumscreen-pack verify {LIBRARY}/packs/{name}")
