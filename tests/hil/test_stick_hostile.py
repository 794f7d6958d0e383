"""Tests hostile sticks in the emulated machine: the kiosk's importer, in its sandbox and within its memory, refuses each in one line, and
takes a good stick afterwards. tests/import has more of them, without the machine."""

import random
import re
import shutil
import subprocess

import sticks
from hil_test import long
from stick_bench import IMPORT_S, QUIET, LongStickTest, pulled_packs

import hostile_cases  # isort: skip; stick_bench adds its folder to the path
import plain_pack  # isort: skip

MAX_MIB = 64.0
MAX_WORK_S = 2.0
REFERENCE_STEPS = 300_000  # of a loop in the shell, which runs here and in the image, to compare the processors
MEASURED = "/run/measured"
# The maximum memory and the processor time of each unit that handles a stick, sampled until the unit ends.
MEASURE = f"""while sleep 0.2; do
    for unit in /sys/fs/cgroup/system.slice/system-frustumscreen*.slice/*@*; do
        {{ read -r peak <$unit/memory.peak && read -r _ used <$unit/cpu.stat; }} 2>/dev/null && echo $unit $peak $used
    done >>{MEASURED}
done"""


def many_files(folder, _):
    """More files than the importer accepts, in several folders, because mkfs.ext4 is slow with large folders."""
    for number in range(100):
        (folder / f"{number}").mkdir()
        for file in range(300):
            (folder / f"{number}/{file}.fspack").touch()


CASES = {
    "lying ZIP directories": ("vfat", hostile_cases.zip_directories), "zip bombs": ("exfat", hostile_cases.bombs),
    "65,535 parts": ("ntfs", hostile_cases.many_parts), "links, pipes, devices": ("ext4", hostile_cases.no_files),
    "30,000 files": ("ext4", many_files), "a set file too much": ("vfat", hostile_cases.set_files),
}


@long
class HostileSticks(LongStickTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.signer = plain_pack.Signer(cls.folder)
        public = cls.signer.public.read_text(encoding="utf-8").splitlines()[1]
        cls.add_key("Hostile", public)
        cls.measure = cls.bench.machine.spawn(MEASURE)
        cls.slowdown = cls.processor_slowdown()

    @classmethod
    def tearDownClass(cls):
        cls.bench.machine.check(f"kill {cls.measure}")
        super().tearDownClass()

    @classmethod
    def processor_slowdown(cls):
        """The factor by which the emulated processor is slower now, measured by a program that only computes."""
        command = f"k=0; while [ $k -lt {REFERENCE_STEPS} ]; do k=$((k + 1)); done; times"

        def work_s(said):
            return sum(60.0 * float(minutes) + float(seconds) for minutes, seconds in re.findall(r"(\d+)m([\d.]+)s", said.splitlines()[0]))

        here = subprocess.run(["sh", "-c", command], check=True, capture_output=True, text=True).stdout
        return work_s(cls.bench.machine.check(command)) / work_s(here)

    def told_of(self, image):
        """The report on this stick, the set after it, the peak memory of its units in MiB, and their processor seconds together."""
        self.forget()
        self.bench.machine.check(f"rm -f {MEASURED}")
        self.plug("hostile", image)
        report = self.outcome(3 * IMPORT_S)
        self.pull("hostile")
        now = self.installed(QUIET)
        taken = {}
        for line in self.bench.machine.check(f"cat {MEASURED}").splitlines():
            unit, peak, used = line.split()
            taken[unit] = (int(peak) / (1 << 20), int(used) / 1e6)
        # The cost of systemd's sandbox for the importer is the same for each stick.
        return report, now, max(mib for mib, _ in taken.values()), sum(work_s for _, work_s in taken.values())

    def test_refused(self):
        self.good_s = self.good(1)
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
        self.assertNotIn("Memory cgroup out of memory", self.bench.machine.check("dmesg"))

    def refused(self, name, image):
        report, now, mib, work_s = self.told_of(image)
        self.slowdown = max(self.slowdown, self.processor_slowdown())  # the host may have become busy meanwhile
        with self.subTest(name):
            self.assertEqual(now, [("amphora", 1)])
            told = [pack for pack in report["packs"] if pack["outcome"] == "refused"]
            self.assertTrue(report["stage"] == "failed" or told, f"nothing is refused: {report}")
            lines = [pack["reason"] for pack in told] + ([report["reason"]] if report["stage"] == "failed" else [])
            self.assertTrue(all(line and "\n" not in line for line in lines), lines)
            self.assertLessEqual(mib, MAX_MIB)
            self.assertLessEqual(work_s, self.good_s + MAX_WORK_S * self.slowdown)
        return name, mib, work_s, lines[-1]

    def good(self, serial):
        report, now, mib, work_s = self.told_of(self.make("good", "vfat", {"vase.fspack": self.signed("amphora", serial)}))
        self.assertEqual(pulled_packs(report), {"vase.fspack": ("taken", "none")})
        self.assertEqual(now, [("amphora", serial)])
        print(f"  a good stick: {mib:.0f} MiB, {work_s:.1f} s of a processor {self.slowdown:.1f} times slower", flush=True)
        return work_s
