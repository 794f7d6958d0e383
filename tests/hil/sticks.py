"""Sticks: images of file systems with files in them, made without root, without mounting anything.

Units    bytes; names with _mib: MiB.
Errors   subprocess.CalledProcessError from the program that makes a file system.
Source   Microsoft's exFAT specification (files are written into what mkfs.exfat has made, since no program of Debian does
         that without mounting it); UEFI specification 2.10, 5.2.1 (MBR) and 5.3 (GPT).
"""

import os
import pathlib
import shutil
import struct
import subprocess
import tempfile
import uuid
import zlib

KINDS = ("vfat", "exfat", "ext4", "ntfs")
MIB = 1 << 20
SECTOR = 512
MBR_TYPES = {"vfat": 0x0C, "exfat": 0x07, "ext4": 0x83, "ntfs": 0x07}
GPT_LINUX = "0fc63daf-8483-4772-8e79-3d69d8477de4"
GPT_DATA = "ebd0a0a2-b9e5-4433-87c0-68b6b72699c7"
GPT_EFI = "c12a7328-f81f-11d2-ba4b-00a0c93ec93b"


def _run(*command, **options):
    subprocess.run([str(word) for word in command], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, **options)


def _blank(image, size_mib):
    image.unlink(missing_ok=True)
    with open(image, "wb") as file:
        file.truncate(size_mib * MIB)


def _vfat(image, label, tree):
    _run("mkfs.vfat", "-F", "32", "-n", label[:11], image)
    found = sorted(tree.iterdir())
    if found:
        _run("mcopy", "-s", "-Q", "-i", image, *found, "::/", env={**os.environ, "LC_ALL": "C.UTF-8"})


def _ext4(image, label, tree):
    entries = sum(len(folders) + len(files) for _, folders, files in os.walk(tree))
    _run("mkfs.ext4", "-q", "-F", "-L", label[:16], "-N", entries + 64, "-d", tree, image)


def _ntfs(image, label, tree):
    _run("mkntfs", "-q", "-F", "-L", label, image)
    for file in sorted(tree.iterdir()):  # ntfscp makes no folders
        _run("ntfscp", "-q", image, file, file.name)


def _rotate_sum(data, left_out=()):
    total = 0
    for place, byte in enumerate(data):
        if place not in left_out:
            total = ((total << 15 | total >> 1) + byte) & 0xFFFF
    return total


def _exfat_entries(name, size, cluster):
    """The directory entries of one file whose clusters are contiguous."""
    letters = name.encode("utf-16-le")
    names = [letters[at:at + 30].ljust(30, b"\0") for at in range(0, len(letters), 30)]
    then = 0x00210000  # 1980-01-01
    file = struct.pack("<BBHHHIIIBBBBB7x", 0x85, 1 + len(names), 0, 0x20, 0, then, then, then, 0, 0, 0x80, 0x80, 0x80)
    stream = struct.pack("<BBxBHHQ4xIQ", 0xC0, 0x03 if size else 0x01, len(name), _rotate_sum(name.upper().encode("utf-16-le")), 0,
                         size, cluster if size else 0, size)
    entries = bytearray(file + stream + b"".join(b"\xc1\0" + part for part in names))
    struct.pack_into("<H", entries, 2, _rotate_sum(entries, (2, 3)))
    return bytes(entries)


def _exfat(image, label, tree):
    _run("mkfs.exfat", "-L", label[:15], image)
    with open(image, "r+b") as disk:
        boot = disk.read(SECTOR)
        heap, clusters, root = struct.unpack_from("<III", boot, 88)
        sector_shift, cluster_shift = boot[108], boot[109]
        cluster_bytes = 1 << sector_shift + cluster_shift

        def place(cluster):
            return (heap << sector_shift) + (cluster - 2) * cluster_bytes

        disk.seek(place(root))
        folder = disk.read(cluster_bytes)
        entries = [folder[at:at + 32] for at in range(0, cluster_bytes, 32)]
        used = next(number for number, entry in enumerate(entries) if entry[0] == 0)
        bitmap_cluster, = struct.unpack_from("<I", next(entry for entry in entries if entry[0] == 0x81), 20)
        disk.seek(place(bitmap_cluster))
        bitmap = bytearray(disk.read((clusters + 7) // 8))
        free = next(number for number in range(clusters) if not bitmap[number // 8] >> number % 8 & 1)
        more = b""
        for file in sorted(tree.iterdir()):
            data = file.read_bytes()
            more += _exfat_entries(file.name, len(data), free + 2)
            disk.seek(place(free + 2))
            disk.write(data)
            for _ in range(-(-len(data) // cluster_bytes)):
                bitmap[free // 8] |= 1 << free % 8
                free += 1
        assert 32 * used + len(more) < cluster_bytes, "more files than one cluster of the folder has room for"
        disk.seek(place(root) + 32 * used)
        disk.write(more)
        disk.seek(place(bitmap_cluster))
        disk.write(bitmap)


_MAKERS = {"vfat": _vfat, "exfat": _exfat, "ext4": _ext4, "ntfs": _ntfs}


def file_system(image, kind, files, size_mib=40, label="PACKS"):
    """Makes a file system that fills the image, as on a stick without a partition table. `files`: name -> path or bytes, or a folder."""
    image = pathlib.Path(image)
    _blank(image, size_mib)
    if isinstance(files, pathlib.Path):
        _MAKERS[kind](image, label, files)
        return image
    with tempfile.TemporaryDirectory() as folder:
        tree = pathlib.Path(folder) / "stick"
        tree.mkdir(mode=0o755)
        for name, what in files.items():
            (tree / name).parent.mkdir(parents=True, exist_ok=True)
            if isinstance(what, bytes):
                (tree / name).write_bytes(what)
            else:
                shutil.copyfile(what, tree / name)
        _MAKERS[kind](image, label, tree)
    return image


def _places_to_damage(boot, kind):
    """(place, bytes) of the tables that locate folders and files; `boot`: the image's first bytes."""
    if kind == "vfat":  # the allocation tables without their first entries
        reserved, count, = struct.unpack_from("<HB", boot, 14)
        return reserved * SECTOR + 12, count * struct.unpack_from("<I", boot, 36)[0] * SECTOR - 12
    if kind == "exfat":  # the root folder without the label, and the data after it
        heap, _, root = struct.unpack_from("<III", boot, 88)
        return (heap << boot[108]) + (root - 2 << boot[108] + boot[109]) + 32, 4096
    if kind == "ext4":  # the inodes, from the first file's on
        block = 1024 << struct.unpack_from("<I", boot, 1024 + 24)[0]
        table, = struct.unpack_from("<I", boot, max(block, 2048) + 8)
        return table * block + 11 * struct.unpack_from("<H", boot, 1024 + 88)[0], 4096
    sector, per_cluster = struct.unpack_from("<HB", boot, 11)  # NTFS: the records of files, from the root folder's on
    return struct.unpack_from("<Q", boot, 48)[0] * sector * per_cluster + 5 * 1024, 123 * 1024


def damage(image, kind, chance):
    """Overwrites the tables that locate this file system's files with noise."""
    with open(image, "r+b") as disk:
        place, size = _places_to_damage(disk.read(1 << 13), kind)
        disk.seek(place)
        disk.write(chance.randbytes(size))


def _mbr(disk, partitions):
    disk.seek(446)
    for kind, begin, sectors in partitions:
        disk.write(struct.pack("<B3sB3sII", 0, b"\xfe\xff\xff", kind, b"\xfe\xff\xff", begin, sectors))
    disk.seek(510)
    disk.write(b"\x55\xaa")


def _gpt(disk, sectors, partitions):
    _mbr(disk, [(0xEE, 1, sectors - 1)])
    entries = b"".join(struct.pack("<16s16sQQQ72s", uuid.UUID(kind).bytes_le, uuid.uuid4().bytes_le, begin, begin + length - 1, 0,
                                   "part".encode("utf-16-le").ljust(72, b"\0"))
                       for kind, begin, length in partitions).ljust(128 * 128, b"\0")
    guid = uuid.uuid4().bytes_le
    for here, there, table in ((1, sectors - 1, 2), (sectors - 1, 1, sectors - 33)):
        def header(check, here=here, there=there, table=table):
            return struct.pack("<8sIII4xQQQQ16sQIII", b"EFI PART", 0x10000, 92, check, here, there, 34, sectors - 34, guid, table,
                               128, 128, zlib.crc32(entries))
        disk.seek(here * SECTOR)
        disk.write(header(zlib.crc32(header(0))))
        disk.seek(table * SECTOR)
        disk.write(entries)


def partitioned(image, parts, table="mbr"):
    """Makes a stick with a partition table. `parts`: (kind, image of a file system), in the order on the stick; a GPT begins with the
    small EFI partition that macOS makes."""
    image = pathlib.Path(image)
    begin, places = MIB // SECTOR, []
    if table == "gpt":
        efi = image.with_suffix(".efi")
        file_system(efi, "vfat", {}, 34, "EFI")
        parts = [("efi", efi), *parts]
    for kind, part in parts:
        places.append((kind, part, begin, part.stat().st_size // SECTOR))
        begin += places[-1][3]
    sectors = begin + MIB // SECTOR
    _blank(image, sectors * SECTOR // MIB)
    with open(image, "r+b") as disk:
        if table == "gpt":
            _gpt(disk, sectors, [({"efi": GPT_EFI, "ext4": GPT_LINUX}.get(kind, GPT_DATA), first, length)
                                 for kind, _, first, length in places])
        else:
            _mbr(disk, [(MBR_TYPES[kind], first, length) for kind, _, first, length in places])
        for _, part, first, _ in places:
            disk.seek(first * SECTOR)
            with open(part, "rb") as data:
                shutil.copyfileobj(data, disk)
    return image
