#!/usr/bin/python3
"""Tests the step that makes a folder for a report on a stick, without a machine: its own script runs with a file system in memory, which is
mounted like a stick in an artificial /run. Files of this test replace the kernel's data on the stick's device.

report_folder_test.py [unittest's arguments]
"""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

OWN = pathlib.Path(__file__).resolve().parent.parent.parent / "image_build/files/usr/lib/frustumscreen"
REQUEST = "frustumscreen-report.toml"
COPY = "frustumscreen-request.toml"  # the script does not check its signature
# Runs in a user namespace as root, with its own mounts. $1: the artificial folder; $2: a shell command that makes the stick's files.
ENTER = """set -e
cd "$1"
mount -t tmpfs -o size=1m,nosuid,nodev none run/frustumscreen-stick/stick1
(cd run/frustumscreen-stick/stick1 && eval "$2")
mount -o remount,ro,nosuid,nodev,noexec run/frustumscreen-stick/stick1
"$3" open stick1 && status=0 || status=$?
echo "open $status"
grep -E 'frustumscreen-(stick|report)' /proc/self/mounts | cut -d ' ' -f 2,4 | sed "s#$1/run/##" || true
echo ---
"""
CONFIRMED = "run/frustumscreen-report/stick1.confirmed"
PLACES = ("frustumscreen-stick/", "frustumscreen-report/")
FLAGS = "nosuid,nodev,noexec"


def fat32(state=0):
    """A FAT32 boot sector by Microsoft's specification: the 16-bit length of the table is 0, and the state is at 65."""
    sector = bytearray(512)
    sector[36:38] = b"\xff\x01"
    sector[65] = state
    return bytes(sector)


def fat16(state=0):
    sector = bytearray(512)
    sector[22:24] = b"\x10\x00"
    sector[37] = state
    sector[65] = 0xFF
    return bytes(sector)


def exfat(flags=0):
    sector = bytearray(512)
    sector[106:108] = flags.to_bytes(2, "little")
    return bytes(sector)


class ReportFolder(unittest.TestCase):
    def setUp(self):
        self.top = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        for folder in ("run/frustumscreen-stick/stick1", "run/frustumscreen-report", "run/frustumscreen-import", "sticks", "sys/class/block/sda1", "bin"):
            (self.top / folder).mkdir(parents=True)
        (self.top / "sticks/stick1").symlink_to(self.top / "sda1")
        self.write("sys/class/block/sda1/ro", b"0\n")
        self.stick("vfat", fat32())
        self.write("bin/date", b"#!/bin/sh\necho 2031-05-04-120000\n")
        (self.top / "bin/date").chmod(0o755)
        self.write("machine", b"frustumscreen-1a2b3c\n")

    def write(self, name, content):
        (self.top / name).write_bytes(content)

    def stick(self, kind, sector):
        self.write("sda1", sector)
        self.write("mounts", f"/dev/sda1 {self.top}/run/frustumscreen-stick/stick1 {kind} ro 0 0\n".encode())

    def run_in(self, files, then="", **environment):
        """The script's status, the lines of mounts, and the output of the commands after it."""
        done = subprocess.run(["unshare", "--mount", "--map-root-user", "sh", "-c", ENTER + then, "sh", self.top, files, OWN / "report-folder"],
                              capture_output=True, text=True, check=False,
                              env={**os.environ, "PATH": f"{self.top}/bin:{os.environ['PATH']}", "REPORT_RUN": str(self.top / "run"),
                                   "REPORT_STICKS": str(self.top / "sticks"), "REPORT_SYS": str(self.top / "sys"),
                                   "REPORT_MOUNTS": str(self.top / "mounts"), "REPORT_MACHINE": str(self.top / "machine"), **environment})
        self.assertEqual(done.returncode, 0, done.stderr)
        said, _, after = done.stdout.partition("---\n")
        status = next(line for line in said.splitlines() if line.startswith("open "))
        return int(status.split()[1]), [line for line in said.splitlines() if line.startswith(PLACES)], after

    def told(self, request=REQUEST):
        """(refusal, sentence) of the report that is left for the importer."""
        outcome = self.top / "run/frustumscreen-import/stick-report-stick1.json"
        if not outcome.exists():
            return None
        report = json.loads(outcome.read_text(encoding="ascii"))
        self.assertEqual((report["import_id"], report["stage"]), ("stick1", "done"))
        line, = report["packs"]
        self.assertEqual((line["file"], line["outcome"]), (request, "not_written"))
        self.assertNotIn("?", line["reason"])
        return line["refusal"], line["reason"]

    def assert_left_alone(self, status, mounted):
        self.assertEqual(status, 1)
        self.assertEqual([line.split()[0] for line in mounted], ["frustumscreen-stick/stick1"])
        self.assertRegex(mounted[0], " ro,")

    def test_only_the_new_folder_is_writable(self):
        status, mounted, after = self.run_in(
            f"touch {REQUEST}; echo mine >mine.txt",
            """cd run
touch frustumscreen-stick/stick1/no 2>/dev/null || echo stick read-only
echo status >frustumscreen-report/stick1/status.txt
cat frustumscreen-report/stick1.name
"$3" close stick1
find frustumscreen-report -mindepth 1
cut -d ' ' -f 2,4 /proc/self/mounts | grep -F "$1" | sed "s#$1/run/##"
cd frustumscreen-stick/stick1 && find . -type f | LC_ALL=C sort && cat mine.txt ./*/status.txt""")
        self.assertEqual(status, 0)
        self.assertEqual(sorted(line.split()[0] for line in mounted), ["frustumscreen-report/stick1", "frustumscreen-stick/stick1"])
        for line in mounted:
            self.assertIn(FLAGS, line)
            self.assertRegex(line, " rw," if "report" in line else " ro,")
        lines = after.splitlines()
        self.assertEqual(lines[:2], ["stick read-only", "NAME=frustumscreen-report-2031-05-04-120000"])
        self.assertEqual(len([line for line in lines if line.startswith(PLACES)]), 1, "something stays mounted, or a folder is left")
        self.assertEqual(lines[-5:], ["./frustumscreen-report-2031-05-04-120000/status.txt", f"./{REQUEST}", "./mine.txt", "mine", "status"])
        self.assertIsNone(self.told())

    def test_removes_a_folder_without_a_report(self):
        _, _, after = self.run_in(f"touch {REQUEST}", '"$3" close stick1; cd run/frustumscreen-stick/stick1 && ls; touch no 2>/dev/null || echo read-only')
        self.assertEqual(after.split(), [REQUEST, "read-only"])

    def test_numbers_folders_of_the_same_second(self):
        _, _, after = self.run_in(f"touch {REQUEST}; mkdir frustumscreen-report-2031-05-04-120000; touch frustumscreen-report-2031-05-04-120000-2",
                                  "cat run/frustumscreen-report/stick1.name")
        self.assertEqual(after.strip(), "NAME=frustumscreen-report-2031-05-04-120000-3")

    def test_a_request_for_a_copy(self):
        for files in (f"echo what >{COPY}", f"echo what >{COPY}; touch {REQUEST}", f"echo what >{COPY}; mkdir {REQUEST}"):
            with self.subTest(files):
                status, _, after = self.run_in(files, 'cat run/frustumscreen-report/stick1.name; "$3" close stick1')
                self.assertEqual((status, after.strip()), (0, "NAME=frustumscreen-1a2b3c-2031-05-04-120000"))
        self.write("sys/class/block/sda1/ro", b"1\n")
        self.assert_left_alone(*self.run_in(f"echo what >{COPY}")[:2])
        self.assertIn("write-protected", self.told(COPY)[1])

    def confirm(self):
        self.write("run/frustumscreen-report/stick1.confirm", b"")

    def test_a_request_that_waits_for_the_staff_has_no_folder(self):
        for files in (f"touch {COPY}", f"touch {COPY}; mkdir {REQUEST}"):
            with self.subTest(files):
                self.assert_left_alone(*self.run_in(files)[:2])
                self.assertIsNone(self.told())
        status, _, after = self.run_in(f"touch {COPY} {REQUEST}", 'cat run/frustumscreen-report/stick1.name; "$3" close stick1')
        self.assertEqual((status, after.strip()), (0, "NAME=frustumscreen-report-2031-05-04-120000"), "a report goes to any stick")
        self.assertFalse((self.top / CONFIRMED).exists())

    def test_a_confirmation_counts_once(self):
        self.confirm()
        status, _, after = self.run_in(f"touch {COPY} {REQUEST}", f'cat run/frustumscreen-report/stick1.name {CONFIRMED}; "$3" close stick1')
        self.assertEqual((status, after.split()), (0, ["NAME=frustumscreen-1a2b3c-2031-05-04-120000", "CONFIRMED=--confirmed"]))
        self.assertTrue((self.top / CONFIRMED).exists(), "the importer is told too")
        self.assert_left_alone(*self.run_in(f"touch {COPY}")[:2])
        self.assertFalse((self.top / CONFIRMED).exists(), "it is over")

    def test_a_signed_empty_request_needs_no_confirmation(self):
        for more in (f"touch {COPY}.minisig", f"ln -s {COPY} {COPY}.minisig"):
            with self.subTest(more):
                status, _, after = self.run_in(f"touch {COPY}; {more}", 'cat run/frustumscreen-report/stick1.name; "$3" close stick1')
                self.assertEqual((status, after.strip()), (0, "NAME=frustumscreen-1a2b3c-2031-05-04-120000"))

    def test_reports_write_protection_before_the_confirmation(self):
        self.write("sys/class/block/sda1/ro", b"1\n")
        for confirmed in (False, True):
            with self.subTest(confirmed=confirmed):
                if confirmed:
                    self.confirm()
                self.assert_left_alone(*self.run_in(f"touch {COPY}")[:2])
                self.assertIn("write-protected", self.told(COPY)[1])

    def test_ignores_sticks_without_a_valid_request(self):
        for files in ("true", f"mkdir {REQUEST}", f"ln -s mine {REQUEST}; touch mine", f"head -c 4097 /dev/zero >{REQUEST}", "touch frustumscreen-report.toml.txt",
                      f"ln -s mine {COPY}; touch mine", f"head -c 4097 /dev/zero >{COPY}"):
            with self.subTest(files):
                self.assert_left_alone(*self.run_in(files)[:2])
                self.assertIsNone(self.told())

    def test_accepts_a_request_of_the_largest_size(self):
        self.assertEqual(self.run_in(f"head -c 4096 /dev/zero >{REQUEST}")[0], 0)

    def test_other_file_systems(self):
        for kind in ("fuseblk", "ext4"):
            with self.subTest(kind):
                self.stick(kind, fat32())
                self.assert_left_alone(*self.run_in(f"touch {REQUEST}")[:2])
                self.assertIn("only be written to FAT32 or exFAT", self.told()[1])

    def test_write_protected(self):
        self.write("sys/class/block/sda1/ro", b"1\n")
        self.assert_left_alone(*self.run_in(f"touch {REQUEST}")[:2])
        self.assertEqual(self.told()[0], "unwritable")
        self.assertIn("write-protected", self.told()[1])

    def test_not_removed_safely(self):
        for kind, sector, clean in (("vfat", fat32(1), False), ("vfat", fat16(1), False), ("exfat", exfat(2), False), ("vfat", fat16(), True),
                                    ("exfat", exfat(), True), ("exfat", exfat(1), True), ("vfat", fat32(2), True)):
            with self.subTest(kind=kind, clean=clean):
                self.stick(kind, sector)
                status, mounted, _ = self.run_in(f"touch {REQUEST}")
                if clean:
                    self.assertEqual(status, 0)
                else:
                    self.assert_left_alone(status, mounted)
                    self.assertIn("pulled out of a computer too early", self.told()[1])

    def test_reports_a_full_stick(self):
        # A tmpfs with few inodes has none left.
        status, mounted, _ = self.run_in(f"touch {REQUEST}; mount -o remount,nr_inodes=2 .")
        self.assert_left_alone(status, mounted)
        self.assertEqual(self.told()[0], "no_room")

    def test_reports_a_stick_that_stays_read_only(self):
        self.write("bin/mount", b'#!/bin/sh\ncase $* in *remount,rw*) exit 32 ;; esac\nexec /usr/bin/mount "$@"\n')
        (self.top / "bin/mount").chmod(0o755)
        self.assert_left_alone(*self.run_in(f"touch {REQUEST}")[:2])
        self.assertIn("cannot be written", self.told()[1])


if __name__ == "__main__":
    unittest.main()
