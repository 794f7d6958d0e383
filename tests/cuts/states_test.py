"""Tests the checks of a disk after a power cut: a small kiosk's disk is sound, and each damage to it is found."""

import pathlib
import shutil
import subprocess
import tempfile
import unittest

import states
from states import DATA, ESP, SLOT_A, SLOT_B, TOOLS, Checker, Must, Version, kept_number, kept_text, partitions

MIB = 1 << 20
SECTOR = 512
MACHINE_ID = "0123456789abcdef" * 2
TABLE = f"""label: gpt
start=1MiB, size=34MiB, name={ESP}
size=1MiB, name={SLOT_A}
size=1MiB, name={SLOT_B}
size=16MiB, name={DATA}
"""


def run(*words, **options):
    return subprocess.run([str(word) for word in words], check=True, capture_output=True, text=True, env=TOOLS, **options).stdout


def slot(path, letter):
    """Makes a root of four blocks followed by its hashes; returns the command line of a kernel image for it."""
    path.write_bytes(letter * 4096 * 4)
    said = run("veritysetup", "format", path, path, "--data-blocks=4", "--hash-offset=16384", "--salt=" + "ab" * 32)
    root_hash = said.partition("Root hash:")[2].split()[0]
    return f"quiet gpt frustumscreen.root_hash={root_hash} frustumscreen.root_blocks=4".encode()


@unittest.skipUnless(shutil.which("veritysetup", path=TOOLS["PATH"]), "veritysetup is not on this machine (cryptsetup-bin)")
class States(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.versions = []
        for name, part, letter in (("0.1.0", "a", b"1"), ("0.2.0", "b", b"2")):
            kernel = cls.folder / f"{name}.efi"
            kernel.write_bytes(bytes(70000) + slot(cls.folder / part, letter) + bytes(70000))
            cls.versions.append(Version.of(name, kernel))
        cls.image = cls.folder / "image"
        with open(cls.image, "wb") as file:
            file.truncate(54 * MIB)
        run("sfdisk", "--quiet", cls.image, input=TABLE)
        cls.parts, _ = partitions(cls.image, 54 * MIB)
        cls.put(cls.image, SLOT_A, (cls.folder / "a").read_bytes())
        cls.put(cls.image, SLOT_B, (cls.folder / "b").read_bytes())
        cls.put(cls.image, ESP, cls.boot().read_bytes())
        cls.put(cls.image, DATA, cls.data().read_bytes())

    @classmethod
    def boot(cls):
        esp = cls.folder / "esp"
        with open(esp, "wb") as file:
            file.truncate(34 * MIB)
        run("mkfs.vfat", "-F", "32", esp)
        run("mmd", "-i", esp, "::EFI", "::EFI/BOOT", "::EFI/Linux", "::loader")
        for name, to in (("a", "EFI/BOOT/BOOTX64.EFI"), ("b", "loader/loader.conf"), ("0.1.0.efi", "EFI/Linux/frustumscreen_0.1.0+5.efi"),
                         ("0.2.0.efi", "EFI/Linux/frustumscreen_0.2.0+3.efi")):
            run("mcopy", "-i", esp, cls.folder / name, f"::{to}")
        return esp

    @classmethod
    def data(cls):
        tree, data = cls.folder / "tree", cls.folder / "data"
        (tree / "settings").mkdir(parents=True)
        (tree / "lib/frustumscreen-watchdog").mkdir(parents=True)
        (tree / "lib/frustumscreen-watchdog/faults.json").write_text('{"faults": 7}', encoding="ascii")
        (tree / "machine-id").write_text(MACHINE_ID + "\n", encoding="ascii")
        (tree / "settings/kept.txt").write_text(kept_text(3), encoding="ascii")
        (tree / "settings/kiosk.toml").write_text("[exhibit]\n# saved 3\n", encoding="ascii")
        run("mke2fs", "-q", "-t", "ext4", "-b", "4096", "-O", "metadata_csum,64bit", "-d", tree, data, "16M")
        return data

    @classmethod
    def put(cls, disk, part, data, at=0):
        with open(disk, "r+b") as file:
            file.seek(cls.parts[part][0] + at)
            file.write(data)

    def setUp(self):
        self.disk = self.folder / "disk"
        shutil.copyfile(self.image, self.disk)
        self.must = Must()
        for words in ('{"kept": "machine-id", "value": "%s"}' % MACHINE_ID, '{"kept": "kept", "value": 3}', '{"begun": "kept", "value": 4}',
                      '{"kept": "settings", "value": 3}', '{"begun": "settings", "value": 3}'):
            self.must.take(words)

    def look(self):
        checker = Checker(self.folder / "check", self.versions, None, self.image, 54 * MIB)
        return checker.look(self.disk, {SLOT_A: 0, SLOT_B: 0}, self.must)

    def assert_fault(self, words):
        faults = self.look().faults
        self.assertTrue(any(words in fault for fault in faults), faults)

    def boot_place(self, data):
        """The offset of these bytes on the boot partition."""
        place = (self.disk.read_bytes()[self.parts[ESP][0]:self.parts[ESP][0] + 34 * MIB]).find(data)
        self.assertGreater(place, 0)
        return place

    def test_accepts_a_sound_disk(self):
        state = self.look()
        self.assertEqual((state.faults, state.notes, state.version), ([], set(), "0.2.0"))

    def test_newest_kernel_image_is_damaged(self):
        self.put(self.disk, ESP, b"x", self.boot_place((self.folder / "0.2.0.efi").read_bytes()[69900:70100]))
        self.assert_fault("the kernel image frustumscreen_0.2.0+3.efi is damaged")

    def test_no_kernel_image(self):
        run("mdel", "-i", f"{self.disk}@@{self.parts[ESP][0]}", "::EFI/Linux/frustumscreen_0.1.0+5.efi", "::EFI/Linux/frustumscreen_0.2.0+3.efi")
        self.assert_fault("there is no kernel image")

    def test_no_tries_left(self):
        for version in ("0.1.0+5", "0.2.0+3"):
            run("mren", "-i", f"{self.disk}@@{self.parts[ESP][0]}", f"::EFI/Linux/frustumscreen_{version}.efi", f"frustumscreen_{version[:5]}+0-5.efi")
        self.assert_fault("no kernel image has a try left")

    def test_prefers_a_version_with_tries_left(self):
        run("mren", "-i", f"{self.disk}@@{self.parts[ESP][0]}", "::EFI/Linux/frustumscreen_0.2.0+3.efi", "frustumscreen_0.2.0+0-3.efi")
        state = self.look()
        self.assertEqual((state.faults, state.version), ([], "0.1.0"))

    def test_ignores_an_empty_kernel_image(self):
        empty = self.folder / "empty"
        empty.touch()
        run("mcopy", "-i", f"{self.disk}@@{self.parts[ESP][0]}", empty, "::EFI/Linux/frustumscreen_0.3.0+3.efi")
        state = self.look()
        self.assertEqual((state.faults, state.notes, state.version), ([], {"empty kernel image"}, "0.2.0"))

    def test_root_half_written(self):
        self.put(self.disk, SLOT_B, b"x", 9000)
        self.assert_fault("frustumscreen_0.2.0+3.efi would start, and no slot has its root")

    def test_boot_loader_damaged(self):
        self.put(self.disk, ESP, b"x", self.boot_place((self.folder / "a").read_bytes()[:8192]))
        self.assert_fault("EFI/BOOT/BOOTX64.EFI is not what it was")

    def test_first_table_torn(self):
        with open(self.disk, "r+b") as disk:
            disk.seek(2 * SECTOR)
            disk.write(bytes(SECTOR))
        self.assertEqual((self.look().faults, self.look().notes), ([], {"second partition table"}))
        for version in self.versions:
            version.reads_second_table = False
        self.addCleanup(lambda: [setattr(version, "reads_second_table", True) for version in self.versions])
        self.assert_fault("this kernel reads no other")

    def test_both_tables_torn(self):
        with open(self.disk, "r+b") as disk:
            for place in (2 * SECTOR, 54 * MIB - 33 * SECTOR):
                disk.seek(place)
                disk.write(bytes(SECTOR))
        self.assert_fault("no partition table is whole")

    def test_superblock_torn(self):
        self.put(self.disk, DATA, bytes(SECTOR), 1024 + SECTOR)
        state = self.look()
        self.assertIn("e2fsck -y needed", state.notes)

    def test_damage_that_a_clean_mark_hides(self):
        """With -f the whole file system is checked, so the damage is found and repaired; e2fsck -p alone trusts the mark "clean"."""
        said = run("dumpe2fs", self.folder / "data")
        block = int(said.partition("Inode bitmap at ")[2].split()[0])
        self.put(self.disk, DATA, b"\x12\x34", 4096 * block + 100)
        state = self.look()
        self.assertEqual((state.faults, state.notes), ([], {"e2fsck -p mended"}))

    def test_reports_contents_older_than_kept(self):
        for what, words in (("kept", "kept.txt has number 3, not 4 to 4"), ("settings", "kiosk.toml has number 3, not 5 to 5"),
                            ("set", "the set is number 0, not 1 to 1")):
            with self.subTest(what):
                for kind in ("begun", "kept"):
                    self.must.take('{"%s": "%s", "value": %d}' % (kind, what, {"kept": 4, "settings": 5, "set": 1}[what]))
                self.assert_fault(words)

    def test_torn_file(self):
        place = self.disk.read_bytes().find(b"3 200\n")
        with open(self.disk, "r+b") as disk:
            disk.seek(place)
            disk.write(bytes(6))
        self.assert_fault("kept.txt is damaged")

    def test_torn_json(self):
        place = self.disk.read_bytes().find(b'{"faults": 7}')
        with open(self.disk, "r+b") as disk:
            disk.seek(place)
            disk.write(bytes(13))
        self.assert_fault("lib/frustumscreen-watchdog/faults.json is torn")

    def test_folder_in_place_of_a_file(self):
        data = self.folder / "with_folder"
        names = {"settings/kept.txt": "kept.txt is damaged", "lib/frustumscreen-watchdog/memory": "memory both slots are torn",
                 "lib/frustumscreen-watchdog/faults": "the watchdog's faults are torn", "machine-id": "the machine-id was",
                 "lib/frustumscreen-watchdog/faults.json": "faults.json is torn"}
        shutil.copyfile(self.folder / "data", data)
        for name in names:
            subprocess.run(["debugfs", "-w", "-f", "-", data], input=f"rm /{name}\nmkdir /{name}\n", text=True, check=True, capture_output=True,
                           env=TOOLS)
        self.put(self.disk, DATA, data.read_bytes())
        faults = self.look().faults
        for words in names.values():
            self.assertTrue(any(words in fault for fault in faults), (words, faults))

    def test_another_machine(self):
        self.must.take('{"kept": "machine-id", "value": "%s"}' % ("f" * 32))
        self.assert_fault("the machine-id was")

    def test_watchdog(self):
        """Tests with a line that frustumscreen-watchdog has written."""
        slot = (b"frustumscreen-ladder-2 a860832fbef0bb75 2 2089103435194244904 236287 236187 0 1 0 1 0 2 0 236187" + b" -1" * 12 +
                b" ").ljust(4095) + b"\n"
        blank = b" " * 4096
        torn, first = slot.replace(b" 2 ", b" 3 ", 1), slot[:512] + blank[512:]
        for memory, is_right in ((blank * 2, True), (slot + blank, True), (blank + slot, True), (torn + slot, True), (blank + first, True),
                                 (torn + blank, False), (torn * 2, False), (slot[:512] + bytes(3584) + blank, False)):
            self.assertEqual(states._has_memory(memory), is_right)
        line = b"1 2026-11-23T19:15:26Z awake 236 s: no_picture -> restart_exhibit".ljust(255) + b"\n"
        for faults, is_right in ((b"", True), (line, True), (line + line.replace(b"1", b"2", 1), True), (line + line, False), (line[:-1], False),
                                 (line + bytes(256), False)):
            self.assertEqual(states._are_lines(faults), is_right)

    def test_kept_text(self):
        self.assertEqual(kept_number(kept_text(17)), 17)
        for text in ("", kept_text(17)[:-1], kept_text(17).replace("17 5\n", "16 5\n"), kept_text(17)[100:]):
            self.assertIsNone(kept_number(text))


if __name__ == "__main__":
    unittest.main(verbosity=2)
