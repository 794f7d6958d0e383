"""Makes a hostile stick, with a partition for each kind of data that some system starts, mounts or opens automatically.

Units    sizes in MiB.
Errors   subprocess.CalledProcessError of the programs that make file systems.
Source   types of partitions: UAPI Group, Discoverable Partitions Specification; signatures, by which blkid recognizes a format:
         cryptsetup's LUKS1 header, LVM2's label, Linux' md superblock 1.2, btrfs' and XFS' superblocks.
"""

import struct
import subprocess

import sticks  # from tests/hil, by appliance

MARK = "/run/somebody-was-here"  # the file that each script on the stick would make
SCRIPT = f"#!/bin/sh\ntouch {MARK}\n".encode()
UNIT = f"[Service]\nExecStart=/bin/sh -c 'touch {MARK}'\n[Install]\nWantedBy=multi-user.target\n".encode()
AUTORUN = {
    "autorun.inf": b"[autorun]\r\nopen=autorun.sh\r\n", "autorun.sh": SCRIPT, ".autorun": SCRIPT, "autorun": SCRIPT,
    "autorun.exe": b"MZ" + bytes(510), "AutoRun.desktop": b"[Desktop Entry]\nType=Application\nExec=/bin/sh autorun.sh\n",
    "kiosk.toml": b"[exhibit]\npacks = []\n", "frustumscreen.service": UNIT, "machine-id": b"0" * 32 + b"\n",
}
SYSTEM = {"sbin/init": SCRIPT, "usr/lib/systemd/systemd": SCRIPT, "usr/lib/os-release": b"ID=somebody\nVERSION_ID=9\n",
          "etc/systemd/system/evil.service": UNIT, "etc/udev/rules.d/00-evil.rules": f'RUN+="/bin/touch {MARK}"\n'.encode()}
ROOT, USR = "4f68bce3-e8cd-4db1-96e7-fbcaf984b709", "8484680c-9521-48c6-9c11-b0720656f69e"
HOME, VAR = "933ac7e1-2eb4-4f13-b844-0e14e2aef915", "4d21b016-b534-45c2-a9fb-5c16e091fd2d"
SWAP, LVM = "0657fd6d-a4ab-43c4-84e5-0933c84b4f4f", "e6d6d379-f507-44c2-a23c-238f2a3df928"
RAID, LUKS = "a19d880f-05fc-4d3b-a006-743f0f84911e", "ca7d7ccb-63ed-4c53-861c-1742536059cc"


def _signed_as(image, place, signature, size_mib=1):
    """A disk with only the signature of a format."""
    with open(image, "wb") as file:
        file.truncate(size_mib << 20)
        file.seek(place)
        file.write(signature)
    return image


def _squashfs(image, files):
    folder = image.with_suffix(".tree")
    for name, data in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(data)
        (folder / name).chmod(0o755)
    subprocess.run(["mksquashfs", folder, image, "-quiet", "-no-progress", "-noappend"], check=True, stdout=subprocess.DEVNULL)
    return image


def _swap(image):
    with open(image, "wb") as file:
        file.truncate(4 << 20)
    subprocess.run(["mkswap", "-q", image], check=True, stdout=subprocess.DEVNULL)
    return image


def make(folder, boot_loader):
    """Makes the image of the stick. `boot_loader`: an EFI program, which is copied onto it."""
    folder.mkdir(parents=True, exist_ok=True)
    system = sticks.file_system(folder / "root", "ext4", SYSTEM, 8, "root")
    parts = [  # (type, name, image)
        (sticks.GPT_EFI, "EFI", sticks.file_system(folder / "esp", "vfat", {
            "EFI/BOOT/BOOTX64.EFI": boot_loader, "loader/loader.conf": b"timeout 60\neditor yes\n"}, 40, "ESP")),
        (ROOT, "root", system),
        (ROOT, "frustumscreen-a", system),
        (sticks.GPT_LINUX, "frustumscreen-data", system),
        (USR, "usr", _squashfs(folder / "usr", SYSTEM)),
        (HOME, "home", sticks.file_system(folder / "home", "ext4", AUTORUN, 8, "home")),
        (VAR, "var", system),
        (SWAP, "swap", _swap(folder / "swap")),
        (LVM, "lvm", _signed_as(folder / "lvm", 512, b"LABELONE" + struct.pack("<QII8s", 1, 0, 32, b"LVM2 001"))),
        (RAID, "raid", _signed_as(folder / "raid", 4096, struct.pack("<II", 0xA92B4EFC, 1))),
        (LUKS, "luks", _signed_as(folder / "luks", 0, b"LUKS\xba\xbe\0\1aes".ljust(592, b"\0"))),
        (sticks.GPT_LINUX, "btrfs", _signed_as(folder / "btrfs", 0x10040, b"_BHRfS_M")),
        (sticks.GPT_LINUX, "xfs", _signed_as(folder / "xfs", 0, b"XFSB" + struct.pack(">I", 4096))),
        (sticks.GPT_DATA, "files", sticks.file_system(folder / "files", "vfat", AUTORUN, 40, "AUTORUN")),
    ]
    disk, begin_mib, table, places = folder / "disk", 1, "label: gpt\n", []
    for kind, name, image in parts:
        size_mib = -(-image.stat().st_size >> 20)
        table += f"start={begin_mib}MiB, size={size_mib}MiB, type={kind}, name={name}\n"
        places.append((image, begin_mib))
        begin_mib += size_mib
    with open(disk, "wb") as file:
        file.truncate(begin_mib + 1 << 20)
    subprocess.run(["sfdisk", "--quiet", disk], input=table, text=True, check=True, stdout=subprocess.DEVNULL)
    for image, place_mib in places:
        subprocess.run(["dd", f"if={image}", f"of={disk}", "bs=1M", f"seek={place_mib}", "conv=notrunc,sparse", "status=none"], check=True)
    return disk
