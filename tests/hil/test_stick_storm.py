"""Tests sticks and disks that fail: a stick pulled out a hundred times, the power of the library's disk cut twenty times, damaged file
systems, slow and changing sticks. In each case the old set or the new one is there, whole, the exhibit goes on, and the next stick is
taken."""

import os
import random
import shutil

import nbd
import sticks
from bench import eventually
from hil_test import long
from stick_bench import IMPORT_S, LIBRARY, QUIET, QUIET_S, REPORT_FILE, LongStickTest, pulled_packs

PULLS = int(os.environ.get("FRUSTUMSCREEN_HIL_PULLS", "100"))
CUTS = int(os.environ.get("FRUSTUMSCREEN_HIL_CUTS", "20"))
NEVER = 1 << 30  # writes
CHANGING_MIB = 2
DAMAGED_EACH = 5
SLOW_READ_S = 5.0
CHANGING_READ_S = 0.01  # slow enough for a second read before the import ends
GIVEN_UP_S = 180.0 + 60.0  # docs/technicians.md: after three minutes the system gives up a stick that answers too slowly
LIBRARY_MIB = 96  # of which the importer leaves 64 free
BY_HAND = "/run/frustumscreen-stick/cut"
IMPORT = "frustumscreen-import@cut.service"


@long
class StickStorm(LongStickTest):
    def take(self, serial, kind="vfat"):
        """Imports one stick from beginning to end."""
        self.forget()
        disk = nbd.Disk(self.folder / "whole", self.make("whole", kind, {"vase.fspack": self.signed("amphora", serial)}))
        try:
            self.plug("whole", disk.path)
            self.outcome()
            self.pull("whole")
        finally:
            disk.stop()
        self.assertIn(("amphora", serial), self.installed(QUIET))

    def pull_at(self, kind, serial, at_read):
        """Puts a stick in and pulls it out at this read, or after the import. Returns the installed set, the number of reads, and the
        reason of a refusal."""
        disk = nbd.Disk(self.folder / "disk", self.make("pulled", kind, {"vase.fspack": self.signed("amphora", serial)}), tell_at=at_read)
        self.forget()
        try:
            self.plug("pulled", disk.path)
            eventually(lambda: disk.is_reached.is_set() or (self.report() or {}).get("stage") in ("done", "failed"), IMPORT_S,
                       f"neither read {at_read} nor an end; reads: {disk.reads}")
            self.pull("pulled")
        finally:
            disk.stop()
        return self.installed(QUIET), disk.reads, (self.report() or {}).get("refusal")

    def test_pulled_out(self):
        chance = random.Random(1)
        reads = {}
        for serial, kind in enumerate(sticks.KINDS, 1):
            now, reads[kind], _ = self.pull_at(kind, serial, None)
            self.assertEqual(now, [("amphora", serial)])
        taken, told = 0, {}
        for number in range(PULLS):
            kind = chance.choice(sticks.KINDS)
            # Half of the pulls come at any read, half at the importer's own reads or after them. The last stick is pulled after its import.
            first, last = chance.choice(((0.0, 1.0), (0.7, 1.1))) if number + 1 < PULLS else (1.1, 1.1)
            at_read = 1 + round(chance.uniform(first, last) * reads[kind])
            now, _, refusal = self.pull_at(kind, serial + 1, at_read)
            self.assertIn(now, ([("amphora", serial)], [("amphora", serial + 1)]), f"pull {number}: {kind}, at read {at_read}")
            told[refusal] = told.get(refusal, 0) + 1
            if now == [("amphora", serial + 1)]:
                serial, taken = serial + 1, taken + 1
            self.goes_on()
        print(f"  {PULLS} pulls, in {taken} of them the new set was there already; told: {told}", flush=True)
        self.assertTrue(0 < taken < PULLS, "all came before, or all after the end: this proves nothing")
        self.assertGreater(told.get("unreadable", 0), 0)
        self.take(serial + 1)

    def plug_own(self, name, source, place, options):
        """Plugs in a disk of the kiosk itself, and mounts it by a command."""
        device = f"/dev/disk/by-id/usb-QEMU_QEMU_HARDDISK_own-{name}-0:0"
        self.bench.machine.plug(name, source, serial=f"own-{name}")
        self.bench.machine.check(f"until test -b {device}; do sleep 0.05; done; mkdir -p {place} && mount -o {options} {device} {place}")

    def pull_own(self, name, place):
        device = f"/dev/disk/by-id/usb-QEMU_QEMU_HARDDISK_own-{name}-0:0"
        self.bench.machine.run(f"sync -f {place}; umount {place} || umount --lazy {place}")
        self.bench.machine.pull(name)
        self.bench.machine.check(f"while test -b {device}; do sleep 0.05; done")

    def plug_library(self, source):
        self.plug_own("library", source, LIBRARY, "noatime")
        self.bench.machine.check("systemd-tmpfiles --create frustumscreen.conf")

    def import_by_hand(self):
        """Runs the importer's unit with a stick that stays in, because the work of udev and systemd before it is the same each time."""
        self.bench.machine.check(f"rm -f {REPORT_FILE}; systemctl start {IMPORT}")  # --wait needs a bus, and the image has none
        self.bench.machine.check(f"until systemctl show -P ActiveState {IMPORT} | grep -qx -e inactive -e failed; do sleep 0.1; done", QUIET_S)

    def cut_after(self, writes, old, survivor, seed):
        """Imports with a power cut of the library's disk after so many writes; returns the number of writes."""
        disk = nbd.Disk(self.folder / "disk", old, cut_after=NEVER, seed=seed)
        try:
            self.plug_library(disk.path)
            begun = disk.writes
            disk.cut_after = begun + writes
            self.import_by_hand()
            ended = disk.writes
            disk.cut()
            self.pull_own("library", LIBRARY)
            disk.survived(survivor)
            return ended - begun
        finally:
            disk.stop()

    def test_power_cut(self):
        old, survivor, check = self.image("library_old"), self.image("library_survivor"), self.image("library_check")
        sticks.file_system(old, "ext4", {}, LIBRARY_MIB, "LIBRARY")
        both = {"vase.fspack": self.signed("amphora", 2), "cup.fspack": self.signed("nautilus-cup", 2)}
        sets = ([("amphora", 1)], [("amphora", 2), ("nautilus-cup", 2)])
        self.plug_library(old)
        self.take(1)
        self.pull_own("library", LIBRARY)
        self.plug_own("stick", self.make("new", "vfat", both), BY_HAND, "ro,nosuid,nodev,noexec,nosymfollow,umask=0222,utf8")
        self.addCleanup(self.pull_own, "stick", BY_HAND)
        written = self.cut_after(NEVER, old, survivor, 0)
        chance = random.Random(2)
        new = 0
        for number in range(CUTS):
            # The import's writes are divided into CUTS parts, with a cut in each; the last cut comes after the import.
            writes = 1 + round((number + chance.random()) * written / CUTS) if number + 1 < CUTS else NEVER
            self.cut_after(writes, old, survivor, number)
            shutil.copyfile(survivor, check)
            self.plug_library(check)
            found = sorted(self.installed())
            self.assertIn(found, sets, f"cut {number}, after {writes} of {written} writes")
            new += found == sets[1]
            self.import_by_hand()
            self.assertEqual(sorted(self.installed()), sets[1], f"the stick again, after cut {number}")
            self.pull_own("library", LIBRARY)
            self.goes_on()
        print(f"  {CUTS} cuts in {written} writes; {new} times it was the new set", flush=True)
        self.assertTrue(0 < new < CUTS, "all came before, or all after the switch: this proves nothing")

    def test_damaged_file_systems(self):
        chance = random.Random(3)
        self.take(1)
        whole, told = {("amphora", 1), ("nautilus-cup", 1)}, {}
        for kind in sticks.KINDS:
            self.make("sound", kind, {"vase.fspack": self.signed("amphora", 1), "cup.fspack": self.signed("nautilus-cup", 1)})
            for _ in range(DAMAGED_EACH):
                damaged = self.image("damaged")
                shutil.copyfile(self.image("sound"), damaged)
                with open(damaged, "r+b") as file:
                    for _ in range(chance.choice((20, 200, 2000))):
                        file.seek(chance.randrange(512, 4 << 20))
                        file.write(chance.randbytes(chance.choice((1, 16, 64))))
                self.forget()
                self.plug("damaged", damaged)
                report = self.outcome(2 * IMPORT_S)
                told.setdefault(kind, []).append(f"{report['stage']} {report['refusal']}")
                self.pull("damaged")
                found = set(self.installed(QUIET))
                # The importer may take a pack that it could read completely in spite of the damage.
                self.assertTrue({("amphora", 1)} <= found <= whole, f"{kind}: {found}")
                self.assertTrue(report["stage"] == "done" or report["reason"])
                self.goes_on()
        print("".join(f"  {kind}: {', '.join(what)}\n" for kind, what in told.items()), end="", flush=True)
        self.take(9)

    def test_slow_reads(self):
        """Each read takes five seconds, so udev alone would need minutes to identify the stick. It is given up, and the exhibit goes on."""
        self.take(1)
        self.forget()
        given_up = "journalctl -b -o cat -u systemd-udevd | grep -c 'sd.*Worker.*killed' || true"
        before = int(self.bench.machine.check(given_up))
        disk = nbd.Disk(self.folder / "disk", self.make("slow", "vfat", {"vase.fspack": self.signed("amphora", 2)}), delay_s=SLOW_READ_S)
        try:
            self.plug("slow", disk.path)
            eventually(lambda: int(self.bench.machine.check(given_up)) > before, GIVEN_UP_S, "the stick is never given up")
            self.assertIsNone(self.report())
            self.goes_on()
            self.pull("slow")
        finally:
            disk.stop()
        self.assertEqual(self.installed(QUIET), [("amphora", 1)])
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
        self.assertEqual(self.installed(QUIET), [("amphora", 5)])

    def test_changing_contents(self):
        """A second read returns other data; the importer must use only the checked data."""
        self.take(1)
        pack = self.large(2, CHANGING_MIB)
        image = self.make("changing", "vfat", {"vase.fspack": pack})
        data = image.read_bytes()
        begins, size = data.index(pack.read_bytes()[:512]), pack.stat().st_size
        changes, refused = 0, []
        for seed in range(4):
            chance, seen = random.Random(seed), set()

            def change(now, place, length, chance=chance, seen=seen):
                nonlocal changes
                first, last = max(place, begins), min(place + length, begins + size)
                sectors = range(first // nbd.SECTOR, -(-last // nbd.SECTOR))
                again = seen.intersection(sectors)
                seen.update(sectors)
                if again:
                    changes += 1
                    now[chance.choice(sorted(again)) * nbd.SECTOR + chance.randrange(nbd.SECTOR)] ^= 1 << chance.randrange(8)

            disk = nbd.Disk(self.folder / "disk", image, change=change, delay_s=CHANGING_READ_S)
            self.forget()
            # The kernel drops its cache, so that it must read the stick again.
            drops = self.bench.machine.spawn("while sleep 0.02; do echo 1 > /proc/sys/vm/drop_caches; done")
            try:
                self.plug("changing", disk.path)
                report = self.outcome(2 * IMPORT_S)
                self.pull("changing")
            finally:
                self.bench.machine.check(f"kill {drops}")
                disk.stop()
            found = self.installed(QUIET)
            taken = pulled_packs(report).get("vase.fspack", (None,))[0] == "taken"
            self.assertEqual(found, [("amphora", 1), *([("Vase", 2)] if taken else [])])
            refused += [pack["refusal"] for pack in report["packs"] if pack["outcome"] == "refused"] or [report["refusal"]] * (not taken)
            for name in self.bench.machine.check(f"ls {LIBRARY}/packs").split():
                self.bench.machine.check(f"frustumscreen-pack verify {LIBRARY}/packs/{name}")
            self.clear_library()
            self.take(1)
        print(f"  {changes} changes; refused: {refused}", flush=True)
        self.assertGreater(changes, 0, "nothing was read twice: this proves nothing")
        self.assertTrue(refused, "no change was noticed")
