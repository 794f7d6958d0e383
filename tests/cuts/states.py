"""Checks, without starting it, whether a disk that a cut has left is a kiosk that starts at once and has kept all acknowledged data.
It uses sfdisk's rules and Debian's own tools: fsck.vfat, mtools, veritysetup, e2fsck and debugfs.

Threads  one caller.
Errors   a fault of the disk is a sentence in the result of `look`; any other error raises.
"""

import hashlib
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import time
import tomllib
import zlib
from dataclasses import dataclass, field

from write_log import SECTOR, copy_part

TOOLS = {**os.environ, "PATH": os.environ["PATH"] + ":/usr/sbin:/sbin", "MTOOLS_SKIP_CHECK": "1"}
ESP, SLOT_A, SLOT_B, DATA = "frustumscreen-esp", "frustumscreen-a", "frustumscreen-b", "frustumscreen-data"


def _run(*words, **options):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False, errors="replace", env=TOOLS, **options)


def kept_text(number):
    """The text of a file that stands for a calibration; its words show whether it is complete."""
    return "".join(f"{number} {line}\n" for line in range(400)) + f"end {number}\n"


def kept_number(text):
    """The number of a complete text; None: the text is incomplete."""
    found = re.search(r"end (\d+)\n$", text)
    return int(found[1]) if found and text == kept_text(int(found[1])) else None


# The partition table, as Linux and the firmware read it: UEFI specification 2.10, 5.3.


def _table(disk, place, sectors):
    """{name: (place, length)} of a GPT whose header is at this sector; None: a checksum of header or entries does not match."""
    disk.seek(place * SECTOR)
    header = disk.read(SECTOR)
    if header[:8] != b"EFI PART":
        return None
    size, check = struct.unpack_from("<II", header, 12)
    here, = struct.unpack_from("<Q", header, 24)
    entries_at, count, entry_size, entries_check = struct.unpack_from("<QIII", header, 72)
    if not 92 <= size <= SECTOR or here != place or zlib.crc32(header[:16] + bytes(4) + header[20:size]) != check or count > 4096:
        return None
    disk.seek(entries_at * SECTOR)
    entries = disk.read(count * entry_size)
    if zlib.crc32(entries) != entries_check:
        return None
    found = {}
    for at in range(0, len(entries), entry_size):
        first, last = struct.unpack_from("<QQ", entries, at + 32)
        if entries[at:at + 16] != bytes(16) and last < sectors:
            name = entries[at + 56:at + 128].decode("utf-16-le").rstrip("\0")
            found[name] = (first * SECTOR, (last - first + 1) * SECTOR)
    return found


def partitions(path, size):
    """(partitions, which table). If the first table is damaged, the firmware always reads the second one, at the disk's end, and Linux does
    so if its command line has `gpt`."""
    with open(path, "rb") as disk:
        first = _table(disk, 1, size // SECTOR)
        if first is not None:
            return first, "first"
        return _table(disk, size // SECTOR - 1, size // SECTOR), "second"


# The boot partition.


@dataclass
class Version:
    """One version of the system: the hash of its kernel image, and the data by which its root is found."""

    name: str
    sha256: str
    words: dict  # values of the command line whose names begin with `frustumscreen.`
    reads_second_table: bool

    @staticmethod
    def of(name, kernel):
        data = kernel.read_bytes()
        words = dict(re.findall(rb"frustumscreen\.([a-z_]+)=([0-9a-f]+)", data))
        return Version(name, hashlib.sha256(data).hexdigest(), {key.decode(): value.decode() for key, value in words.items()},
                       re.search(rb" gpt [^\0]*frustumscreen\.root_hash=", data) is not None)


@dataclass
class State:
    """The findings."""

    faults: list = field(default_factory=list)
    notes: set = field(default_factory=set)  # findings that are no faults, such as repairs
    version: str = ""
    kernel: pathlib.Path = None
    e2fsck_s: float = 0.0


def _tries(name):
    """(version, tries left or None) of a kernel image's name; None: it has another name."""
    found = re.fullmatch(r"frustumscreen_([0-9][^+]*)(?:\+(\d+)(?:-(\d+))?)?\.efi", name)
    return found and (found[1], int(found[2]) if found[2] else None)


def _order(name):
    """The order of systemd-boot: versions with tries left come first, then the newest."""
    version, left = _tries(name)
    return left == 0, [-int(part) for part in version.split(".")]


def _read(path):
    """The file's bytes; None: the file does not exist. A folder of that name is damage, so its bytes fail every check."""
    return path.read_bytes() if path.is_file() else b"\xff" if path.exists() else None


class Checker:
    """`folder`: for its own files; `versions`: those that may be on the disk; `tools`: kiosk.Tools; `image`: the disk as built."""

    def __init__(self, folder, versions, tools, image, size):
        self.folder, self._tools, self._size = folder, tools, size
        self._versions = {version.sha256: version for version in versions}
        folder.mkdir(parents=True, exist_ok=True)
        self._verified, self._packs = {}, {}
        found, _ = partitions(image, image.stat().st_size)
        self._boot_files = {name: self._file(image, found[ESP], name) for name in ("EFI/BOOT/BOOTX64.EFI", "loader/loader.conf")}
        assert all(self._boot_files.values())

    @staticmethod
    def slots(disk):
        """{name: (place, length)} of the two slots."""
        found, _ = partitions(disk, disk.stat().st_size)
        return {name: found[name] for name in (SLOT_A, SLOT_B)}

    @staticmethod
    def data_begins(disk):
        found, _ = partitions(disk, disk.stat().st_size)
        return found[DATA][0]

    @staticmethod
    def _file(disk, esp, name):
        """A file's SHA-256; None: it cannot be read."""
        done = subprocess.run(["mtype", "-i", f"{disk}@@{esp[0]}", f"::{name}"], capture_output=True, check=False, env=TOOLS)
        return hashlib.sha256(done.stdout).hexdigest() if done.returncode == 0 else None

    def look(self, disk, generation, must):
        """`generation`: that of the slots' contents (Replay); `must`: the data that were acknowledged before the cut."""
        state = State()
        found, table = partitions(disk, self._size)
        if not found or {ESP, SLOT_A, SLOT_B, DATA} - found.keys():
            state.faults.append(f"no partition table is whole ({table})")
            return state
        if table == "second":
            state.notes.add("second partition table")
        self._look_at_boot(disk, found, generation, state)
        if table == "second" and not all(version.reads_second_table for version in self._versions.values() if version.name == state.version):
            state.faults.append("the first partition table is torn, and this kernel reads no other")
        if "version" in must.min_value and state.version != must.min_value["version"]:
            state.faults.append(f"version {state.version} would start, though {must.min_value['version']} was told as taken")
        self._look_at_data(disk, found[DATA], must, state)
        return state

    def _look_at_boot(self, disk, found, generation, state):
        esp = self.folder / "esp.img"
        copy_part(disk, *found[ESP], esp)
        checked = _run("fsck.vfat", "-n", esp)
        if checked.returncode != 0:
            state.notes.add("boot partition not clean")
        elif "irty bit" in checked.stdout:
            state.notes.add("boot partition marked as in use")
        for name, sha256 in self._boot_files.items():
            if self._file(esp, (0, 0), name) != sha256:
                state.faults.append(f"{name} is not what it was")
        self._choose(esp, disk, found, generation, state)

    def _choose(self, esp, disk, found, generation, state):
        """The boot loader's first choice must be complete, and so must its root."""
        listed = _run("mdir", "-b", "-i", esp, "::EFI/Linux").stdout.split()
        names = sorted((name for name in (path.rpartition("/")[2] for path in listed) if _tries(name)), key=_order)
        state.kernel = self.folder / "kernel.efi"
        for name in names:
            state.kernel.unlink(missing_ok=True)
            _run("mcopy", "-n", "-i", esp, f"::EFI/Linux/{name}", state.kernel)
            data = state.kernel.read_bytes() if state.kernel.exists() else b"unreadable"
            if data:
                break
            state.notes.add("empty kernel image")  # systemd-boot ignores a file without sections
        else:
            state.faults.append(f"there is no kernel image, of {names}")
            state.kernel = None
            return
        version = self._versions.get(hashlib.sha256(data).hexdigest())
        if version is None:
            state.faults.append(f"the kernel image {name} is damaged, of {names}")
            return
        state.version = version.name
        if _tries(name)[1] == 0:
            state.faults.append(f"no kernel image has a try left: {names}")
        if not any(self._verifies(disk, slot, found[slot], generation[slot], version) for slot in (SLOT_A, SLOT_B)):
            state.faults.append(f"{name} would start, and no slot has its root")

    def _verifies(self, disk, slot, place, generation, version):
        key = slot, generation, version.name
        if key not in self._verified:
            part = self.folder / "slot.img"
            copy_part(disk, *place, part)
            blocks = int(version.words["root_blocks"])
            self._verified[key] = _run("veritysetup", "verify", part, part, version.words["root_hash"],
                                       f"--hash-offset={4096 * blocks}").returncode == 0
        return self._verified[key]

    # The data partition, as the initrd treats it.

    def _look_at_data(self, disk, place, must, state):
        image = self.folder / "data.img"
        copy_part(disk, *place, image)
        begun = time.monotonic()
        status = _run("e2fsck", "-f", "-p", image).returncode
        if status & 3:
            state.notes.add("e2fsck -p mended")
        for _ in range(3):
            if status & ~3:
                state.notes.add("e2fsck -y needed")
                status = _run("e2fsck", "-f", "-y", image).returncode
        state.e2fsck_s = time.monotonic() - begun
        if status & ~3:
            state.faults.append(f"e2fsck cannot mend the data partition, status {status}")
            return
        whole = _run("e2fsck", "-f", "-n", image)
        if whole.returncode != 0:
            state.faults.append(f"what e2fsck has passed is damaged: {whole.stdout.strip().splitlines()[1:4]}")
        tree = self.folder / "tree"
        shutil.rmtree(tree, ignore_errors=True)
        tree.mkdir()
        _run("debugfs", "-R", f"rdump / {tree}", image)
        self._look_at_files(tree, must, state)

    def _look_at_files(self, tree, must, state):
        if "machine-id" in must.min_value:
            found = _read(tree / "machine-id")
            if (found or b"").decode(errors="replace").strip() != must.min_value["machine-id"]:
                state.faults.append(f"the machine-id was {must.min_value['machine-id']}, and is {found}")
        for what, name, number_of in (("settings", "kiosk.toml", _saved_number), ("kept", "kept.txt", kept_number),
                                      ("unsafe", "unsafe.txt", kept_number)):
            data = _read(tree / "settings" / name)
            found = number_of(data.decode(errors="replace")) if data is not None else 0
            min_number, max_number = must.min_value.get(what, 0), must.max_value.get(what, 0)
            if found is None or not min_number <= found <= max_number:
                fault = f"{name} is damaged" if found is None else f"{name} has number {found}, not {min_number} to {max_number}"
                if what == "unsafe":
                    state.notes.add("unsafe file lost")
                else:
                    state.faults.append(fault)
        self._look_at_library(tree / "lib/frustumscreen/library", must, state)
        for path in sorted([*tree.rglob("lib/**/*.json"), *tree.rglob("cache/**/*.json"), *tree.rglob("cache/**/*.toml")]):
            try:
                text = _read(path).decode()
                json.loads(text) if path.suffix == ".json" else tomllib.loads(text)
            except ValueError:
                state.faults.append(f"{path.relative_to(tree)} is torn")

        watchdog = tree / "lib/frustumscreen-watchdog"
        memory, faults = _read(watchdog / "memory"), _read(watchdog / "faults")
        if memory is not None and not _has_memory(memory):
            state.faults.append("of the watchdog's memory both slots are torn")
        if faults is not None and not _are_lines(faults):
            state.faults.append("the watchdog's faults are torn")

    def _look_at_library(self, library, must, state):
        min_number, max_number = must.min_value.get("set", 0), must.max_value.get("set", 0)
        found = 0
        if (library / "set.txt").exists():
            done = self._tools.run("import", "--list", "--into", library, "--json")
            if done.returncode != 0:
                state.faults.append(f"the library is damaged: {done.stderr.strip()}")
                return
            listed = json.loads(done.stdout)
            found = listed["number"]
            for pack in listed["packs"]:
                self._look_at_pack(library / pack["file"], pack["sha256"], state)
        if not min_number <= found <= max_number:
            state.faults.append(f"the set is number {found}, not {min_number} to {max_number}")

    def _look_at_pack(self, path, sha256, state):
        if hashlib.sha256(_read(path) or b"").hexdigest() != sha256:
            state.faults.append(f"the pack {path.name} of the set is missing or damaged")
        elif sha256 not in self._packs:
            self._packs[sha256] = self._tools.run("pack", "verify", path).returncode == 0
        if not self._packs.get(sha256, True):
            state.faults.append(f"the pack {path.name} is not sound")


def _saved_number(text):
    """The number of the museum's settings; 0: the shipped ones; None: incomplete."""
    found = re.search(r"# saved (\d+)\n$", text)
    if found:
        return int(found[1])
    return 0 if text.endswith("\n") and "[exhibit]" in text and "# saved" not in text else None


def _has_memory(data):
    """Whether the watchdog's memory is whole. Writes alternate between two slots, each a line with a checksum (app/watch/ladder_memory.h).
    One slot must be whole, except before the first write is on the disk: it goes to the second slot, and the first slot is still blank."""
    def is_whole(slot):
        found = re.fullmatch(rb"frustumscreen-ladder-2 ([0-9a-f]{16}) ((?:-?\d+ )+) *\n", slot)
        checksum = 0xCBF29CE484222325  # FNV-1a
        for byte in found[2] if found else b"":
            checksum = (checksum ^ byte) * 0x100000001B3 % (1 << 64)
        return found is not None and int(found[1], 16) == checksum

    slots = [data[:4096], data[4096:]]
    return any(map(is_whole, slots)) or not slots[0].strip(b" \0")


def _are_lines(data):
    """Whether the data are lines of 256 bytes, each with its number (app/programs/watchdog/fault_book.h)."""
    lines = [data[at:at + 256] for at in range(0, len(data), 256)]
    return all(re.fullmatch(rb"%d [^\0\n]*\n" % (number + 1), line) and len(line) == 256 for number, line in enumerate(lines))


class Must:
    """The marks of a log. `min_value`: of the last write that was acknowledged; `max_value`: of the last write that began."""

    def __init__(self):
        self.phase, self.min_value, self.max_value = "", {}, {}

    def take(self, words):
        mark = json.loads(words)
        if "phase" in mark:
            self.phase = mark["phase"]
        if "begun" in mark and mark["begun"] != "version":
            self.max_value[mark["begun"]] = mark["value"]
        if "kept" in mark and mark["kept"] != "grown":
            self.min_value[mark["kept"]] = mark["value"]
