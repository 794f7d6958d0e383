"""Reads the parts of the image that are not in the root: the kernel image's sections, the initrd's files, the boot partition's files.

Source   PE format, the header of sections; cpio(5), "newc"; systemd-stub(7).
Errors   ValueError, in a sentence; subprocess.CalledProcessError of zstd, sfdisk and mtools.
"""

import json
import stat
import struct
import subprocess


def sections_of(path):
    """name -> bytes of each section of an EFI program."""
    data = path.read_bytes()
    (header,) = struct.unpack_from("<I", data, 0x3C) if data[:2] == b"MZ" else (len(data),)
    if data[header : header + 4] != b"PE\0\0":
        raise ValueError(f"{path} is not a program for EFI")
    count, optional = struct.unpack_from("<2xH12xH", data, header + 4)
    sections = {}
    for number in range(count):
        name, size, _, stored, place = struct.unpack_from("<8s4I", data, header + 24 + optional + 40 * number)
        sections[name.rstrip(b"\0").decode("ascii")] = data[place : place + min(size, stored)]
    return sections


def files_of_initrd(packed):
    """path -> (mode, bytes) of the files in all archives of the initrd, which follow one another and are packed with zstd."""
    data = subprocess.run(["zstd", "-qdc"], input=packed, check=True, capture_output=True).stdout
    files, at = {}, 0
    while at < len(data):
        if data[at] == 0:  # between archives
            at += 4
            continue
        if data[at : at + 6] != b"070701":
            raise ValueError("the initrd is not made of cpio archives")
        words = [int(data[at + 6 + 8 * number : at + 14 + 8 * number], 16) for number in range(13)]
        mode, size, length = words[1], words[6], words[11]
        name = data[at + 110 : at + 109 + length].decode("utf-8")
        begin = at + (110 + length + 3) // 4 * 4
        at = begin + (size + 3) // 4 * 4
        if name not in (".", "TRAILER!!!") and not stat.S_ISDIR(mode):
            files[name.removeprefix("./")] = (mode, data[begin : begin + size])
    return files


def files_of_boot_partition(disk):
    """path -> bytes, without the kernel images, which also lie beside the disk."""
    table = json.loads(subprocess.run(["sfdisk", "--json", disk], check=True, capture_output=True).stdout)["partitiontable"]
    starts = [part["start"] * table.get("sectorsize", 512) for part in table["partitions"] if part.get("name") == "frustumscreen-esp"]
    if len(starts) != 1:
        raise ValueError(f"{disk} has no partition frustumscreen-esp")
    partition = f"{disk}@@{starts[0]}"
    listed = subprocess.run(["mdir", "-/", "-b", "-i", partition, "::"], check=True, capture_output=True, text=True).stdout
    names = [line.removeprefix("::/") for line in listed.splitlines() if line and not line.endswith("/")]
    return {name: subprocess.run(["mcopy", "-i", partition, f"::{name}", "-"], check=True, capture_output=True).stdout
            for name in sorted(names) if not name.startswith("EFI/Linux/")}
