"""Tests a stick that requests a report: the files on it afterwards, read on the host by mtools, and the message if it cannot be written."""

import json
import pathlib
import random
import subprocess
import tempfile

from bench import eventually
from hil_test import long
from stick_bench import ToldStickTest, pulled_packs

REQUEST = "frustumscreen-report.toml"
REPORT_S = 150.0  # for an import, and for reading the journal with a slow processor
SLOW_BYTES_PER_S = 20_000  # the journal then takes some ten seconds
FILES = {"version.txt", "status.txt", "status.json", "settings.txt", "faults.txt", "journal.txt"}  # counts.csv if there were visits


def files_on(image):
    """path: bytes of each file of a FAT without a partition table."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["mcopy", "-s", "-n", "-Q", "-i", image, "::/", folder], check=True, capture_output=True)
        top = pathlib.Path(folder)
        return {str(file.relative_to(top)): file.read_bytes() for file in top.rglob("*") if file.is_file()}


def file_on(image, path):
    return subprocess.run(["mtype", "-i", image, f"::/{path}"], check=True, capture_output=True).stdout


class StickReport(ToldStickTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        noise = random.Random(9)
        cls.own = {"letter.txt": b"mine\n", "photos/vase.jpg": noise.randbytes(300_000), "photos/cup.jpg": noise.randbytes(70_000)}

    def setUp(self):
        super().setUp()
        self.process = self.bench.main_process()

    def tearDown(self):
        super().tearDown()
        self.assertEqual(self.bench.main_process(), self.process, "the exhibit was restarted")

    def asking(self, name, kind="vfat", more=None):
        """The image of a stick that requests a report."""
        return self.make(name, kind, {REQUEST: b"", **self.own, **(more or {})})

    def assert_own_files(self, image):
        """Checks that every other file is unchanged, and returns the report's files."""
        found = files_on(image)
        for name, content in {REQUEST: b"", **self.own}.items():
            self.assertTrue(found.pop(name, None) == content, f"{name} is not as it was")
        return found

    def not_written(self, image, untouched=True, **how):
        """The importer's report on a stick: (refusal, sentence). `untouched`: the stick's bytes must not change."""
        held = image.read_bytes()
        self.plug("refused", image, **how)
        report = self.outcome(REPORT_S)
        self.assertEqual(report["stage"], "done")
        line, = report["packs"]
        self.assertEqual((line["file"], line["outcome"]), (REQUEST, "not_written"))
        eventually(lambda: not self.mounts(), 30.0, "the stick stays mounted")
        self.pull("refused")
        self.assertTrue(not untouched or image.read_bytes() == held, "something was written to the stick")
        return line["refusal"], line["reason"]

    def test_1_written(self):
        stick = self.asking("one")
        self.plug("one", stick)
        report = self.outcome(REPORT_S)
        (folder, outcome), = pulled_packs(report).items()
        self.assertEqual((report["stage"], outcome), ("done", ("written", "none")))
        self.assertRegex(folder, r"^frustumscreen-report-\d{4}-\d\d-\d\d-\d{6}$")
        self.assert_told("stick_report", "done")
        eventually(lambda: not self.mounts(), 30.0, "the stick stays mounted")
        self.pull("one")
        written = {pathlib.PurePath(name): content.decode() for name, content in self.assert_own_files(stick).items()}
        self.assertEqual({str(name.parent) for name in written}, {folder})
        files = {name.name: content for name, content in written.items()}
        self.assertEqual(set(files) - {"counts.csv"}, FILES)
        self.assertTrue(files["status.txt"].startswith("The exhibit"), files["status.txt"])
        self.assertEqual(json.loads(files["status.json"])["runs"], True)
        self.assertIn("frustumscreen", files["journal.txt"])
        self.assertIn("kernel", files["journal.txt"])
        self.assertIn("FrustumScreen", files["version.txt"])
        self.assertIn("[exhibit]", files["settings.txt"])
        for name, content in files.items():
            for private in ("public_key", "SerialNumber: ", "PACKS"):  # the label of the stick
                self.assertNotIn(private, content, name)
        checked = subprocess.run(["fsck.vfat", "-n", stick], check=False, capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stdout)

    def test_2_again_beside_a_pack(self):
        stick = self.asking("both", more={"nautilus-cup.fspack": self.signed("nautilus-cup", 1), "frustumscreen-report-old/status.txt": b"old"})
        self.plug("both", stick)
        told = pulled_packs(self.outcome(REPORT_S))
        self.assertEqual(told.pop("nautilus-cup.fspack"), ("taken", "none"))
        self.assertEqual(list(told.values()), [("written", "none")])
        eventually(lambda: not self.mounts(), 30.0, "the stick stays mounted")
        self.pull("both")
        self.assertEqual(self.assert_own_files(stick)["frustumscreen-report-old/status.txt"], b"old")

    def test_3_write_protected(self):
        refusal, reason = self.not_written(self.asking("protected"), protected=True)
        self.assertEqual(refusal, "unwritable")
        self.assertIn("write-protected", reason)
        self.assert_told("stick_report_protected", "done")

    def test_4_pulled_out_while_it_is_written(self):
        stick = self.asking("slow")
        self.plug("slow", stick, written_per_s=SLOW_BYTES_PER_S)
        eventually(lambda: self.bench.machine.run("ls /run/frustumscreen-report/*/faults.txt").status == 0, REPORT_S, "no report is begun")
        self.pull("slow")
        report = self.outcome(REPORT_S)
        self.assertEqual((report["stage"], report["refusal"]), ("failed", "unreadable"))
        self.assert_told("stick_report_pulled", "failed")
        eventually(lambda: "frustumscreen-report/" not in self.bench.machine.run("cat /proc/mounts").output, 60.0, "the folder stays mounted")
        for name, content in {REQUEST: b"", **self.own}.items():
            self.assertTrue(file_on(stick, name) == content, f"{name} is not as it was")
        # The stick was pulled out while this file was written: mtools reports it as cut off.
        listed = subprocess.run(["mdir", "-b", "-/", "-i", stick, "::/"], check=False, capture_output=True, text=True).stdout
        self.assertIn("/photos/cup.jpg", listed)
        self.assertNotIn("/journal.txt", listed, "all was written before: this proves nothing")

    @long
    def test_5_full(self):
        stick = self.asking("full", more={"film.mp4": bytes(38 << 20)})
        film = files_on(stick).pop("film.mp4")
        refusal, reason = self.not_written(stick, untouched=False)
        self.assertEqual(refusal, "no_room", reason)
        self.assertEqual(self.assert_own_files(stick), {"film.mp4": film})

    @long
    def test_6_not_removed_safely(self):
        stick = self.asking("dirty")
        with open(stick, "r+b") as disk:
            disk.seek(65)  # of a FAT32's boot sector: the driver's state
            disk.write(b"\x01")
        self.assertIn("too early", self.not_written(stick)[1])

    @long
    def test_7_ntfs(self):
        stick = self.make("ntfs", "ntfs", {REQUEST: b"", "letter.txt": b"mine\n"})
        self.assertIn("only be written to FAT32 or exFAT", self.not_written(stick)[1])

    @long
    def test_8_exfat(self):
        own = random.Random(3).randbytes(5000)
        stick = self.make("exfat", "exfat", {REQUEST: b"", "letter.txt": own})
        self.plug("exfat", stick)
        self.assertEqual(list(pulled_packs(self.outcome(REPORT_S)).values()), [("written", "none")])
        eventually(lambda: not self.mounts(), 30.0, "the stick stays mounted")
        self.pull("exfat")
        held = stick.read_bytes()
        self.assertIn(own, held)
        self.assertIn(b"FrustumScreen ", held)
        checked = subprocess.run(["fsck.exfat", "-n", stick], check=False, capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)
