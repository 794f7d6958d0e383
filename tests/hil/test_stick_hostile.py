"""Sticks that mean harm, plugged in: refused in one line each by the importer as the kiosk runs it, locked in and within its memory,
and a good stick is taken afterwards. tests/import has more of them, without the machine."""

import random
import shutil

import hostile_sticks
import plain_pack
import sticks
from hil_test import long
from stick_bench import IMPORT_S, QUIET, LongStickTest, pulled_packs

MOST_MIB = 64.0
MOST_WORK_S = 2.0
REFERENCE_MIB = 64  # hashed, to compare the processors
MEASURED = "/run/measured"
MEASURED_UNITS = ("frustumscreen-import", "frustumscreen-import-refused", "frustumscreen-ntfs")
MEASURE = f"""g=/sys/fs/cgroup$(sed s/^0::// /proc/self/cgroup)
echo $(cat $g/memory.peak) $(sed -n 's/^usage_usec //p' $g/cpu.stat) $(sed -n 's/^oom_kill //p' $g/memory.events) >>{MEASURED}
"""


def many_files(folder, _):
    """More than are looked through, in folders, because mkfs.ext4 is slow in large ones."""
    for number in range(100):
        (folder / f"{number}").mkdir()
        for file in range(300):
            (folder / f"{number}/{file}.fspack").touch()


CASES = {
    "lying ZIP directories": ("vfat", hostile_sticks.zip_directories), "zip bombs": ("exfat", hostile_sticks.bombs),
    "65,535 parts": ("ntfs", hostile_sticks.many_parts), "links, pipes, devices": ("ext4", hostile_sticks.no_files),
    "30,000 files": ("ext4", many_files), "a set file too much": ("vfat", hostile_sticks.set_files),
}


@long
class HostileSticks(LongStickTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.signer = plain_pack.Signer(cls.folder)
        public = cls.signer.public.read_text(encoding="utf-8").splitlines()[1]
        machine = cls.bench.machine
        cls.add_key("Hostile", public)
        machine.write("/run/measure.sh", MEASURE)
        for unit in MEASURED_UNITS:
            machine.check(f"mkdir -p /run/systemd/system/{unit}@.service.d")
            machine.write(f"/run/systemd/system/{unit}@.service.d/measure.conf", "[Service]\nExecStopPost=+/bin/sh /run/measure.sh\n")
        machine.check("systemctl daemon-reload")

    @classmethod
    def tearDownClass(cls):
        for unit in MEASURED_UNITS:
            cls.bench.machine.check(f"rm -r /run/systemd/system/{unit}@.service.d")
        cls.bench.machine.check("systemctl daemon-reload")
        super().tearDownClass()

    def told_of(self, image):
        """The report on this stick, the set after it, and what its units took at most: MiB, seconds of the processor together."""
        self.forget()
        self.bench.machine.check(f"rm -f {MEASURED}")
        self.plug("hostile", image)
        report = self.outcome(3 * IMPORT_S)
        self.pull("hostile")
        now = self.installed(QUIET)
        rows = [[int(word) for word in line.split()] for line in self.bench.machine.check(f"cat {MEASURED}").splitlines()]
        self.assertEqual(sum(killed for _, _, killed in rows), 0, "a process was killed for its memory")
        return report, now, max(row[0] for row in rows) / (1 << 20), sum(row[1] for row in rows) / 1e6

    def test_refused(self):
        self.good(1)
        rows = []
        for name, (kind, fill) in CASES.items():
            folder = self.folder / "hostile"
            folder.mkdir()
            fill(folder, self.signer)
            image = sticks.file_system(self.image("hostile"), kind, folder, 64)
            shutil.rmtree(folder)
            rows.append(self.refused(name, image))
        chance = random.Random(4)
        for kind in sticks.KINDS:
            image = self.make("hostile", kind, {f"{number}.fspack": self.signed("nautilus-cup", 2) for number in range(8)})
            sticks.damage(image, kind, chance)
            rows.append(self.refused(f"damaged {kind}", image))
        print("".join(f"  {name}: {mib:.0f} MiB, {work_s:.1f} s of the emulated processor; {told}\n" for name, mib, work_s, told in rows), end="")
        self.good(3)

    def refused(self, name, image):
        report, now, mib, work_s = self.told_of(image)
        with self.subTest(name):
            self.assertEqual(now, [("amphora", 1)])
            told = [pack for pack in report["packs"] if pack["outcome"] == "refused"]
            self.assertTrue(report["stage"] == "failed" or told, f"nothing is refused: {report}")
            lines = [pack["reason"] for pack in told] + ([report["reason"]] if report["stage"] == "failed" else [])
            self.assertTrue(all(line and "\n" not in line for line in lines), lines)
            self.assertLessEqual(mib, MOST_MIB)
        return name, mib, work_s, lines[-1]

    def good(self, serial):
        report, now, mib, work_s = self.told_of(self.make("good", "vfat", {"vase.fspack": self.signed("amphora", serial)}))
        self.assertEqual(pulled_packs(report), {"vase.fspack": ("taken", "none")})
        self.assertEqual(now, [("amphora", serial)])
        print(f"  a good stick: {mib:.0f} MiB, {work_s:.1f} s of the emulated processor", flush=True)
