"""Makes a small image with artificial packages, in the form of ./image_build/build and by the tools that make the real one.

Source   the root by mksquashfs, the initrd by cpio and zstd, the boot partition by sfdisk, mkfs.vfat and mtools.
"""

import pathlib
import random
import struct
import subprocess

TOOLS = ("mksquashfs", "unsquashfs", "zstd", "cpio", "sfdisk", "mkfs.vfat", "mcopy", "mdir")
TIME_S = 1700000000
ELF = b"\x7fELF"
DEP5 = "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/\n"


def noise(size, seed):
    """Data that cannot be compressed."""
    return random.Random(seed).randbytes(size)


def run(*command, **options):
    subprocess.run([str(word) for word in command], check=True, capture_output=True, **options)


def write(path, data):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data if isinstance(data, bytes) else data.encode("utf-8"))


# Path, contents, reason in kept.tsv. None: the build makes the file, and reasons.list has the reason.
LLVM = "usr/lib/x86_64-linux-gnu/libLLVM-15.so.1"
ROOT = [
    ("usr/bin/frustumscreen", ELF + noise(700000, 1), "the exhibit"),
    (LLVM, ELF + noise(300000, 2) + bytes(900000), "graphics: the processor draws"),
    ("usr/lib/x86_64-linux-gnu/libc.so.6", ELF + noise(5000, 3), "the exhibit"),
    ("usr/lib/modules/6.1/kernel/drivers/gpu/drm/i915.ko", ELF + noise(9000, 4), "Intel's graphics"),
    ("usr/lib/modules/6.1/modules.dep", "nothing\n", None),
    ("usr/share/zoneinfo/UTC", noise(118, 5), "opening hours"),
    ("usr/share/zoneinfo/Zulu", noise(118, 5), "opening hours"),
    ("usr/share/zoneinfo/empty", b"", "opening hours"),
    ("usr/lib/os-release", "VERSION_ID=12\n", "the version"),
]
INITRD = [("init", "#!/bin/sh\n"), ("bin/busybox", ELF + noise(20000, 6)), ("lib/x86_64-linux-gnu/libc.so.6", ELF + noise(5000, 3))]
SECTIONS = {".linux": noise(40000, 7), ".cmdline": b"quiet", ".osrel": b"VERSION_ID=12\n"}
# Tree, package, further fields, files, copyright file.
PACKAGES = [
    ("ours", "frustumscreen", {}, ["/usr/bin/frustumscreen"], DEP5 + "\nFiles: *\nCopyright: us\nLicense: Apache-2.0\n see /usr/share/common-licenses/Apache-2.0\n"),
    ("debian", "libllvm15", {"Source": "llvm-toolchain-15 (1:15.0.6-4)", "Version": "1:15.0.6-4+b1",
                              "Depends": "libc6 (>= 2.36), perl:any | tzdata, libfrog1"}, [f"/{LLVM}"],
     DEP5 + "\nFiles: *\nCopyright: them\nLicense: Expat and BSD-3-clause, or Frog\n"),
    ("debian", "libc6", {"Source": "glibc", "Architecture-of-list": "amd64"}, ["/lib/x86_64-linux-gnu/libc.so.6"],
     "Freely written. See /usr/share/common-licenses/LGPL-2.1.\n"),
    ("debian", "tzdata", {"Architecture": "all"}, ["/usr/share/zoneinfo/UTC", "/usr/share/zoneinfo/Zulu", "/usr/share/zoneinfo/empty"],
     "Freely written. See /usr/share/common-licenses/LGPL-2.1.\n"),
    ("debian", "base-files", {}, ["/usr/lib/os-release"], "Anything.\n"),
    ("debian", "perl", {}, ["/usr/bin/perl"], "Cut out.\n"),
    ("unpacked", "linux-image-6.1", {"Source": "linux-signed"}, ["/lib/modules/6.1/kernel/drivers/gpu/drm/i915.ko"],
     DEP5 + "\nFiles: *\nCopyright: them\nLicense: GPL-2\n\nFiles: debian/*\nCopyright: them\nLicense: Zlib\n"),
    ("unpacked", "systemd-boot-efi", {"Source": "systemd"}, [], "Boot.\n"),
    ("unpacked", "busybox-static", {"Source": "busybox", "Built-Using": "glibc (= 2.36-9)"}, ["/bin/busybox"], "Box.\n"),
]


def make_packages(provenance, compiled_in):
    rows = PACKAGES + [("compiled_in", name, {}, [], DEP5 + "\nFiles: *\nCopyright: them\nLicense: Expat\n") for name in compiled_in]
    for tree, name, fields, files, licence in rows:
        place = provenance / tree / "var/lib/dpkg"
        (place / "info").mkdir(parents=True, exist_ok=True)
        fields = {"Package": name, "Status": "install ok installed", "Architecture": "amd64", "Version": "1.0-1",
                  "Description": f"{name} in short\n at length", **fields}
        of_list = fields.pop("Architecture-of-list", None)
        with open(place / "status", "a", encoding="utf-8") as status:
            status.write("".join(f"{field}: {value}\n" for field, value in fields.items()) + "\n")
        write(place / "info" / f"{name}{':' + of_list if of_list else ''}.list", "".join(f"{path}\n" for path in ["/.", "/lib", *files]))
        write(provenance / tree / "usr/share/doc" / name / "copyright", licence)
    for name in ("Apache-2.0", "LGPL-2.1"):
        write(provenance / "debian/usr/share/common-licenses" / name, f"the text of {name}\n")


def efi_program(sections):
    """Headers and sections, one after another, as objdump reads them."""
    place, table, data = 0x400, b"", b""
    for name, contents in sections.items():
        padded = contents + bytes(-len(contents) % 512)
        table += struct.pack("<8s6I2HI", name.encode(), len(contents), place, len(padded), place, 0, 0, 0, 0, 0x40000040)
        data += padded
        place += len(padded)
    head = b"MZ" + bytes(0x3A) + struct.pack("<I", 0x40) + b"PE\0\0"
    head += struct.pack("<HHIIIHH", 0x8664, len(sections), 0, 0, 0, 0, 0x22) + table
    return head.ljust(0x400, b"\0") + data


def make_initrd(work):
    tree = work / "initrd"
    for path, data in INITRD:
        write(tree / path, data)
    names = "".join(f"{path.relative_to(tree)}\n" for path in sorted(tree.rglob("*")))
    archive = subprocess.run(["cpio", "--quiet", "-o", "-H", "newc"], input=names.encode(), cwd=tree, check=True, capture_output=True).stdout
    return subprocess.run(["zstd", "-qc"], input=archive, check=True, capture_output=True).stdout


def make_disk(work, disk):
    write(work / "loader.conf", "timeout 0\n")
    write(work / "boot.efi", noise(3000, 8))
    with open(disk, "wb") as file:
        file.truncate(8 << 20)
    run("sfdisk", "--quiet", disk, input=b"label: gpt\nstart=1MiB, size=4MiB, name=frustumscreen-esp\n")
    with open(work / "esp", "wb") as file:
        file.truncate(4 << 20)
    run("mkfs.vfat", work / "esp")
    run("mmd", "-i", work / "esp", "::EFI", "::EFI/BOOT", "::EFI/Linux", "::loader")
    run("mcopy", "-i", work / "esp", work / "boot.efi", "::EFI/BOOT/BOOTX64.EFI")
    run("mcopy", "-i", work / "esp", work / "loader.conf", "::loader/loader.conf")
    run("dd", f"if={work / 'esp'}", f"of={disk}", "bs=1M", "seek=1", "conv=notrunc")


def make(work, compiled_in, more=()):
    """Makes the folder of an image with the files of ROOT and of `more`: (path, contents, reason or None)."""
    out, root = work / "out", work / "root"
    out.mkdir(parents=True)
    kept = []
    for path, data, reason in [*ROOT, *more]:
        write(root / path, data)
        if reason:
            kept.append(f"{len(data)}\t{reason}\t{path}\n")
    (root / "lib").symlink_to("usr/lib")
    write(out / "kept.tsv", "".join(kept))
    slot = out / "frustumscreen_1.2.slot"
    run("mksquashfs", root, slot, "-quiet", "-no-progress", "-comp", "zstd", "-b", "256K", "-all-root", "-no-xattrs", "-mkfs-time", TIME_S,
        "-all-time", TIME_S, "-reproducible")
    with open(slot, "ab") as file:
        file.write(bytes(12345))  # in place of verity's hashes
    write(out / "frustumscreen_1.2.efi", efi_program({**SECTIONS, ".initrd": make_initrd(work)}))
    make_disk(work, out / "frustumscreen.raw")
    make_packages(out / "provenance", compiled_in)
    return pathlib.Path(out)
