"""The image in an emulated PC with UEFI: QEMU and OVMF, the disk that ./image_build/build --test made, and a tracker's mock.

Frame    one machine for each start; the disk is a copy of the built image, and stays between starts.
Settings those of a museum with a small projector, on the disk's data partition. The class Shipped (shipped.py) has the shipped image,
         with its own settings and without an agent.
Time     as in tests/hil/machine.py.
Threads  one caller.
Errors   MachineError.
"""

import pathlib
import re
import shutil
import subprocess
import sys

HIL = pathlib.Path(__file__).resolve().parent.parent / "hil"
sys.path.insert(0, str(HIL))

# pylint: disable=wrong-import-position
import image as parts  # noqa: E402
import screen  # noqa: E402
from bench import Mock, eventually  # noqa: E402
from machine import Machine  # noqa: E402

FIRMWARE = pathlib.Path("/usr/share/OVMF")
WIDTH, HEIGHT = 640, 400
ESP, SLOT_A, SLOT_B, DATA = 1, 2, 3, 4  # partitions
PARTITIONS = {ESP: "frustumscreen-esp", SLOT_A: "frustumscreen-a", SLOT_B: "frustumscreen-b", DATA: parts.DATA_PARTITION}
LIT_S = 240.0  # from power on until the exhibit is lit; the firmware alone takes 15 to 20


class Appliance(Machine):
    """`image`: the disk; `folder`: for the disk's copy, the firmware's variables and logs; `secure`: the firmware starts only programs
    that are signed with Debian's test key (package ovmf); `card`: QEMU's name of the graphics card."""

    def __init__(self, image, folder, sockets, usb, secure=False, card="bochs-display"):
        super().__init__(folder, folder, sockets, folder, WIDTH, HEIGHT, usb)
        self.disk, self._secure, self.read_only = folder / "disk.raw", secure, False
        self._screen = f"{card},id=screen" + (f",edid=on,xres={WIDTH},yres={HEIGHT}" if card == "bochs-display" else "")
        folder.mkdir(parents=True, exist_ok=True)
        # A sparse copy, into which a test may write.
        subprocess.run(["cp", "--sparse=always", "--reflink=auto", image, self.disk], check=True)
        subprocess.run(["truncate", "-s", "2G", self.disk], check=True)
        self.give_settings()
        shutil.copy(FIRMWARE / ("OVMF_VARS_4M.snakeoil.fd" if secure else "OVMF_VARS_4M.fd"), folder / "variables.fd")

    def give_settings(self):
        """Puts settings on the data partition: a small picture, because the emulated processor is slow, and the image's own artifact."""
        settings = self.logs / "kiosk.toml"
        settings.write_text(re.sub(r"(?m)^packs = .*", 'packs = ["/usr/share/frustumscreen/built_in.fspack"]',
                                   parts.SETTINGS.read_text(encoding="utf-8")), encoding="utf-8")
        parts.write_data(self.disk, {"settings/kiosk.toml": settings})

    def _command(self):
        code = "OVMF_CODE_4M.secboot.fd" if self._secure else "OVMF_CODE_4M.fd"
        command = [
            "qemu-system-x86_64", "-name", "frustumscreen-image", "-machine", f"q35,smm={'on' if self._secure else 'off'}",
            "-accel", "tcg,thread=multi,tb-size=512", "-cpu", self.processor, "-smp", str(self.processors),
            "-m", f"{self.memory_mib}M", "-display", "none", "-no-user-config", "-nodefaults",
            "-global", f"driver=cfi.pflash01,property=secure,value={'on' if self._secure else 'off'}",
            "-drive", f"if=pflash,format=raw,unit=0,readonly=on,file={FIRMWARE / code}",
            "-drive", f"if=pflash,format=raw,unit=1,file={self.logs}/variables.fd",
            "-drive", f"if=none,id=disk,format=raw,file={self.disk},readonly={'on' if self.read_only else 'off'}",
            "-device", "virtio-blk-pci,drive=disk,serial=disk,bootindex=1",
            *self.lines(),
            "-vga", "none", "-device", self._screen,
            "-device", "qemu-xhci,id=usb,p2=12,p3=12",
            "-device", "i6300esb", "-action", "watchdog=reset",
        ]
        command += self.usb_devices()
        return [str(word) for word in command]

    def power_on(self):
        """Starts the machine without waiting; returns QEMU's process."""
        with open(self.logs / "qemu.log", "w", encoding="utf-8") as log:
            self._process = subprocess.Popen(self._command(), stdin=subprocess.DEVNULL, stdout=log, stderr=log)
        return self._process

    def stop(self):
        """Stops the machine as if it were unplugged."""
        super().stop()
        for line in (getattr(self, "_monitor", None), getattr(self, "_agent", None)):
            if line:
                line.close()

    # The disk, while the machine is off.

    def partition(self, number):
        """(offset, size) of a partition, in bytes."""
        return parts.partition(self.disk, PARTITIONS[number])

    def flip(self, offset):
        """Inverts all bits of one byte of the disk."""
        with open(self.disk, "r+b") as disk:
            disk.seek(offset)
            byte = disk.read(1)
            disk.seek(offset)
            disk.write(bytes([byte[0] ^ 0xFF]))

    def fill(self, number, byte=b"\0", size=8 << 20):
        """Overwrites the beginning of a partition."""
        with open(self.disk, "r+b") as disk:
            disk.seek(self.partition(number)[0])
            disk.write(byte * size)

    # While it runs.

    def let_disk_hang(self, hangs):
        """Makes the disk hang by a limit of one byte per second, so that requests wait; `hangs` False removes the limit."""
        limits = {name: 0 for name in ("bps", "bps_rd", "bps_wr", "iops", "iops_rd", "iops_wr")}
        self.monitor("block_set_io_throttle", device="disk", **{**limits, "bps": int(hangs)})

    def lit_picture(self):
        """The screen's picture, if the exhibit drew it (screen.probe) and a part of it is lit; otherwise None."""
        path = self.sockets / "screen.ppm"
        self.screendump(path)
        picture = screen.read_ppm(path)
        share = screen.count(screen.lit(picture)) / (picture.width * picture.height)
        return picture if screen.probe(picture) is not None and 0.005 < share < 0.5 else None

    def wait_until_lit(self, timeout_s=LIT_S):
        """Waits for a lit picture; returns it, and keeps it beside the logs."""
        picture = eventually(self.lit_picture, timeout_s, "the screen stays dark")
        screen.write_png(self.logs / "lit.png", picture)
        return picture

    def firmware_starts(self):
        """How often the firmware has started from the disk since power on, by its messages on the serial line."""
        return (self.logs / "serial.log").read_bytes().count(b"BdsDxe: starting Boot")

    def notes(self):
        """The start's notes on the disk; empty: no faults."""
        return self.run("cat /run/frustumscreen-boot/notes 2>/dev/null").output


def tracker(sockets, logs):
    """Starts the mock of a VIPER for the machine's USB port, a program of its own."""
    return Mock("mock_tracker", "tracker", sockets, logs)
