#!/usr/bin/python3
"""Tests updates of the kiosk's system without a machine: RAUC itself reads the bundles of ./image_build/bundle; boot-slots runs on a
folder, and trim-boot-folder on a boot partition.

bundle_test.py [unittest's arguments]
"""

import hashlib
import os
import pathlib
import struct
import subprocess
import tempfile
import unittest

TOP = pathlib.Path(__file__).resolve().parent.parent.parent
BUNDLE = TOP / "image_build/bundle"
BOOT_SLOTS = TOP / "image_build/files/usr/lib/frustumscreen/boot-slots"
TRIM = TOP / "image_build/files/usr/lib/frustumscreen/trim-boot-folder"
RUNNING, OTHER = "aa" * 32, "bb" * 32  # hashes of roots


def run(*command, env=None):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, timeout=120,
                          env={**os.environ, "LC_ALL": "C", **(env or {})})


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))


class Bundle(Folder):
    """An image of noise replaces a real one; nothing reads its contents."""

    def setUp(self):
        super().setUp()
        self.files = {}
        for name, size in (("frustumscreen_1.2.0.slot", 3 << 20), ("frustumscreen_1.2.0.efi", 1 << 20)):
            self.files[name] = os.urandom(size)
            (self.folder / name).write_bytes(self.files[name])
        for name in ("ours", "theirs"):
            done = run("openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes",
                       "-subj", f"/CN={name}", "-days", "7300", "-keyout", self.folder / f"{name}.key",
                       "-out", self.folder / f"{name}.crt")
            self.assertEqual(done.returncode, 0, done.stderr)
        self.out = self.folder / "update.raucb"

    def make(self, *options):
        return run(BUNDLE, "--image", self.folder, "--key", self.folder / "ours.key", "--cert", self.folder / "ours.crt",
                   "-o", self.out, *options)

    def info(self, keyring="ours"):
        return run("rauc", "info", f"--keyring={self.folder / keyring}.crt", "--output-format=shell", self.out)

    def test_rauc_reads_the_bundle(self):
        done = self.make()
        self.assertEqual(done.returncode, 0, done.stderr)
        told = self.info()
        self.assertEqual(told.returncode, 0, told.stderr)
        lines = dict(line.split("=", 1) for line in told.stdout.splitlines() if "=" in line)
        self.assertEqual(lines["RAUC_MF_COMPATIBLE"], "'frustumscreen'")
        self.assertEqual(lines["RAUC_MF_VERSION"], "'1.2.0'")
        self.assertEqual(lines["RAUC_IMAGE_CLASS_0"], "'system'")
        self.assertEqual(lines["RAUC_IMAGE_SIZE_0"], str(3 << 20))
        self.assertEqual(lines["RAUC_IMAGE_DIGEST_0"].strip("'"), hashlib.sha256(self.files["frustumscreen_1.2.0.slot"]).hexdigest())
        inside = self.folder / "inside"
        done = run("unsquashfs", "-q", "-n", "-d", inside, self.out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((inside / "system.img").read_bytes(), self.files["frustumscreen_1.2.0.slot"])
        self.assertEqual((inside / "frustumscreen_1.2.0.efi").read_bytes(), self.files["frustumscreen_1.2.0.efi"])
        self.assertIn("format=verity", (inside / "manifest.raucm").read_text(encoding="ascii"))

    def test_contents_are_reproducible(self):
        insides = []
        for _ in range(2):
            self.assertEqual(self.make().returncode, 0)
            made = self.out.read_bytes()
            used, = struct.unpack_from("<Q", made, 40)  # squashfs' superblock: bytes_used
            insides.append(hashlib.sha256(made[:used]).hexdigest())
        self.assertEqual(insides[0], insides[1])

    def test_rejects_another_key_and_damaged_bundles(self):
        self.assertEqual(self.make().returncode, 0)
        self.assertIn("signature verification failed", self.info("theirs").stderr)
        whole = self.out.read_bytes()
        self.out.write_bytes(whole[:len(whole) // 2])
        self.assertNotEqual(self.info().returncode, 0)
        changed = bytearray(whole)
        changed[-200] ^= 1  # in the signature
        self.out.write_bytes(changed)
        self.assertNotEqual(self.info().returncode, 0)
        self.out.write_bytes(whole)
        self.assertEqual(self.info().returncode, 0)

    def test_reports_wrong_use_in_one_line(self):
        for options, words in ((("--version", "9"), "has no version '9'"), (("-o", self.folder / "x"), "does not end with .raucb"),
                               (("--key", "/nowhere"), "cannot be read"), (("--speed",), "there is no option"), (("-o",), "needs a value")):
            done = self.make(*options)
            self.assertIn(done.returncode, (1, 2), options)
            self.assertIn(words, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)


class BootSlots(Folder):
    """Slot a runs."""

    def setUp(self):
        super().setUp()
        self.linux = self.folder / "esp/EFI/Linux"
        self.linux.mkdir(parents=True)
        (self.folder / "bundle").mkdir()
        (self.folder / "slot").write_text("frustumscreen-a\n", encoding="ascii")
        (self.folder / "cmdline").write_text(f"quiet frustumscreen.root_hash={RUNNING} x=1\n", encoding="ascii")

    def image(self, name, root_hash, folder=None):
        (folder or self.linux).joinpath(name).write_bytes(b"MZ\0\xff" + f"a=1 frustumscreen.root_hash={root_hash} b".encode() + b"\0")

    def images(self):
        return sorted(path.name for path in self.linux.iterdir())

    def boot_slots(self, *words):
        return run(BOOT_SLOTS, *words, env={
            "BOOT_SLOTS_ESP": self.folder / "esp", "BOOT_SLOTS_BUNDLE": self.folder / "bundle",
            "BOOT_SLOTS_COMMAND_LINE": self.folder / "cmdline", "BOOT_SLOTS_RUNNING": self.folder / "slot"})

    def says(self, *words):
        done = self.boot_slots(*words)
        self.assertEqual((done.returncode, done.stderr), (0, ""), words)
        return done.stdout.strip()

    def refuses(self, *words):
        before = self.images()
        done = self.boot_slots(*words)
        self.assertNotEqual(done.returncode, 0, words)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertEqual(self.images(), before)

    def test_primary_slot_has_the_newest_version_with_tries(self):
        """The primary slot is that of the newest version with tries left, in systemd-boot's own order."""
        for ours, other, primary, state in (
                ("1.2.0+5", "1.3.0+3", "b", "good"), ("1.2.0+4-1", "1.3.0+0-3", "a", "bad"), ("1.2.0", "1.10.0+1-2", "b", "good"),
                ("1.10.0+5", "1.9.0", "a", "good"), ("1.2.0+0-5", "1.1.0+5", "b", "good"), ("1.2.0+0-5", "1.3.0+0-3", "b", "bad"),
                ("1.2.0+5", "1.2.0~rc1+3", "a", "good")):
            for path in self.linux.iterdir():
                path.unlink()
            self.image(f"frustumscreen_{ours}.efi", RUNNING)
            self.image(f"frustumscreen_{other}.efi", OTHER)
            self.assertEqual(self.says("get-primary"), primary, (ours, other))
            self.assertEqual(self.says("get-state", "b"), state, (ours, other))

    def test_a_slot_without_a_kernel_image_is_bad(self):
        self.image("frustumscreen_1.2.0+5.efi", RUNNING)
        self.assertEqual((self.says("get-state", "a"), self.says("get-state", "b"), self.says("get-primary")), ("good", "bad", "a"))

    def test_a_whole_update(self):
        self.image("frustumscreen_1.2.0+5.efi", RUNNING)
        self.image("frustumscreen_1.1.0+5.efi", OTHER)
        self.image("new.part", OTHER)  # a power cut left it
        self.says("set-state", "b", "bad")
        self.assertEqual(self.images(), ["frustumscreen_1.2.0+5.efi"])
        self.image("frustumscreen_1.3.0.efi", "cc" * 32, self.folder / "bundle")
        self.says("set-primary", "b")
        self.assertEqual(self.images(), ["frustumscreen_1.2.0+5.efi", "frustumscreen_1.3.0+3.efi"])
        self.assertEqual(self.says("get-primary"), "b")

    def test_a_good_start_restores_the_tries(self):
        for name in ("1.2.0+2-1", "1.2.0", "1.2.0+0-5", "1.2.0+5"):
            for path in self.linux.iterdir():
                path.unlink()
            self.image(f"frustumscreen_{name}.efi", RUNNING)
            self.says("set-state", "a", "good")
            self.assertEqual(self.images(), ["frustumscreen_1.2.0+5.efi"])

    def test_cleans_up_a_rename_after_a_power_cut(self):
        """An empty new name is removed; of two names of one file none is, because that would free the other's blocks."""
        self.image("frustumscreen_1.2.0+4-1.efi", RUNNING)
        (self.linux / "frustumscreen_1.2.0+5.efi").touch()
        (self.linux / "frustumscreen_1.3.0+3.efi").touch()
        self.assertEqual((self.says("get-primary"), self.says("get-state", "b")), ("a", "bad"))
        self.says("set-state", "a", "good")
        self.assertEqual(self.images(), ["frustumscreen_1.2.0+5.efi"])
        for twin in ("frustumscreen_1.2.0+3-2.efi", "frustumscreen_1.2.0.part"):
            os.link(self.linux / "frustumscreen_1.2.0+5.efi", self.linux / twin)
        both = self.images()
        self.image("frustumscreen_1.3.0.part", OTHER)
        for words in (("set-state", "a", "good"), ("set-state", "b", "bad")):
            self.says(*words)
            self.assertEqual(self.images(), both)

    def test_never_removes_the_running_version(self):
        self.image("frustumscreen_1.2.0+5.efi", RUNNING)
        self.image("frustumscreen_1.3.0.efi", OTHER, self.folder / "bundle")
        for words in (("set-state", "a", "bad"), ("set-primary", "a"), ("set-state", "b", "good"), ("set-state", "b", "so-so"),
                      ("get-state", "c"), ("get-primary", "a"), ("explode",), ()):
            self.refuses(*words)

    def test_rejects_a_bundle_without_exactly_one_kernel_image(self):
        self.image("frustumscreen_1.2.0+5.efi", RUNNING)
        self.refuses("set-primary", "b")
        for version in ("1.3.0", "1.4.0"):
            self.image(f"frustumscreen_{version}.efi", OTHER, self.folder / "bundle")
        self.refuses("set-primary", "b")


class TrimBootFolder(Folder):
    """mkfs.fat and mtools make the boot partition; the test reads the bytes of its folder."""

    def setUp(self):
        super().setUp()
        self.disk = self.folder / "esp.img"
        self.made("mkfs.fat", "-C", "-F", "32", "-s", "1", self.disk, 40960)
        for name in ("EFI", "EFI/Linux"):
            self.made("mmd", "-i", self.disk, f"::{name}")

    def made(self, *command):
        done = run(*command, env={"PATH": os.environ["PATH"] + ":/usr/sbin:/sbin", "MTOOLS_SKIP_CHECK": "1"})
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def put(self, *names):
        for name in names:
            (self.folder / "file").write_text(name, encoding="ascii")
            self.made("mcopy", "-i", self.disk, self.folder / "file", f"::EFI/Linux/{name}")

    def remove(self, *names):
        for name in names:
            self.made("mdel", "-i", self.disk, f"::EFI/Linux/{name}")

    def images(self):
        listed = self.made("mdir", "-b", "-i", self.disk, "::EFI/Linux").split()
        names = [path.rpartition("/")[2] for path in listed]
        for name in names:
            self.assertEqual(self.made("mtype", "-i", self.disk, f"::EFI/Linux/{name}"), name)
        self.made("fsck.fat", "-n", self.disk)
        return names

    def kinds(self):
        """The first byte of each name of the folder, except "."; e5: a removed name; 0: the end."""
        data = self.disk.read_bytes()
        place = data.index(b".          ")
        while data[place + 32:place + 34] != b".." or data[place - 512:place - 511] != b".":  # EFI/Linux follows EFI
            place = data.index(b".          ", place + 1)
        return [data[at] for at in range(place + 64, place + 512, 32)]

    def trim(self):
        return run(TRIM, self.disk)

    def test_trims_removed_names_at_the_end(self):
        self.put("frustumscreen_0.1.0+5.efi", "frustumscreen_0.2.0+3.efi", "frustumscreen_0.2.0+2-1.efi")
        self.remove("frustumscreen_0.2.0+3.efi", "frustumscreen_0.2.0+2-1.efi")
        self.assertEqual(self.kinds().count(0xE5), 7)
        self.assertEqual((self.trim().returncode, self.kinds()[3:]), (0, [0] * 11))
        self.assertEqual(self.images(), ["frustumscreen_0.1.0+5.efi"])

    def test_keeps_removed_names_before_others(self):
        self.put("frustumscreen_0.1.0+5.efi", "frustumscreen_0.2.0+3.efi", "frustumscreen_0.2.0+2-1.efi")
        self.remove("frustumscreen_0.1.0+5.efi")
        before = self.disk.read_bytes()
        self.assertEqual((self.trim().returncode, self.disk.read_bytes() == before), (0, True))
        self.assertEqual(self.images(), ["frustumscreen_0.2.0+3.efi", "frustumscreen_0.2.0+2-1.efi"])

    def test_a_folder_of_many_sectors(self):
        names = [f"frustumscreen_0.{number}.0+5.efi" for number in range(40)]
        self.put(*names)
        self.remove(*names[2:])
        self.assertEqual((self.trim().returncode, self.kinds()[6:]), (0, [0] * 8))
        self.put("frustumscreen_1.0.0+3.efi")  # no removed name comes back
        self.assertEqual(self.images(), [*names[:2], "frustumscreen_1.0.0+3.efi"])

    def test_rejects_other_partitions(self):
        for disk, words in ((bytes(1 << 20), "no FAT32"), (None, "no folder EFI/Linux")):
            if disk is None:
                self.made("mdeltree", "-i", self.disk, "::EFI/Linux")
            else:
                self.disk, whole = self.folder / "other.img", self.disk
                self.disk.write_bytes(disk)
            before = self.disk.read_bytes()
            done = self.trim()
            self.assertEqual((done.returncode, self.disk.read_bytes() == before), (1, True))
            self.assertIn(words, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.disk = whole


if __name__ == "__main__":
    unittest.main()
