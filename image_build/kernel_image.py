#!/usr/bin/python3
"""Puts kernel, initrd, command line and os-release into one file that UEFI starts: sections behind systemd's stub.

Source   systemd-stub(7); PE format: sections lie at addresses of their own, one after another.
Errors   subprocess.CalledProcessError of objcopy and objdump.
"""

import argparse
import pathlib
import struct
import subprocess

ALIGNED = 4096


def end_of(stub):
    """The first address after the stub's sections."""
    listed = subprocess.run(["objdump", "--section-headers", "--wide", stub], check=True, capture_output=True, text=True).stdout
    rows = [line.split() for line in listed.splitlines() if line.strip()[:1].isdigit()]
    return max(int(row[3], 16) + int(row[2], 16) for row in rows)


def without_time(file):
    """Clears TimeDateStamp and the checksum. objcopy writes the current time there, so two builds would differ. UEFI reads neither."""
    with open(file, "r+b") as image:
        image.seek(0x3C)
        (header,) = struct.unpack("<I", image.read(4))
        image.seek(header + 8)
        image.write(bytes(4))
        image.seek(header + 88)
        image.write(bytes(4))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    sections = (("--os-release", ".osrel"), ("--command-line", ".cmdline"), ("--initrd", ".initrd"), ("--linux", ".linux"))
    parser.add_argument("--stub", required=True, type=pathlib.Path)
    for option, _ in sections:
        parser.add_argument(option, required=True, type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    arguments = parser.parse_args()

    command, address = ["objcopy"], end_of(arguments.stub)
    for option, section in sections:  # the kernel comes last: it is unpacked in place, upwards
        file = getattr(arguments, option[2:].replace("-", "_"))
        address = -(-address // ALIGNED) * ALIGNED
        command += ["--add-section", f"{section}={file}", "--change-section-vma", f"{section}={address:#x}",
                    "--set-section-flags", f"{section}=data,alloc,readonly,load"]
        address += file.stat().st_size
    subprocess.run([*command, arguments.stub, arguments.out], check=True)
    without_time(arguments.out)


if __name__ == "__main__":
    main()
