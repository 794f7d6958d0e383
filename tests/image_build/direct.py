"""The image in an emulated PC without firmware: QEMU itself loads kernel, initrd and command line of the kernel image on the disk.

The firmware and the boot loader take 15 to 20 s of each start, and what is tested with this has nothing to do with them.

Frame, time, threads, errors   as in appliance.py.
Source   sections .linux, .initrd, .cmdline: systemd-stub(7).
"""

import subprocess

from appliance import Appliance


def parts_of(kernel_image, folder):
    """Kernel, initrd and command line of a kernel image, as files in `folder`, and the last as text."""
    files = {name: folder / name for name in ("linux", "initrd", "cmdline")}
    dumps = [f"--dump-section=.{name}={file}" for name, file in files.items()]  # objcopy also wants to write a copy
    subprocess.run(["objcopy", *dumps, kernel_image, folder / "copy.efi"], check=True)
    return files["linux"], files["initrd"], files["cmdline"].read_text(encoding="ascii").strip("\0 \n")


class Direct(Appliance):
    """`image`: frustumscreen.raw, beside which lies its one kernel image."""

    def __init__(self, image, folder, sockets, usb):
        super().__init__(image, folder, sockets, usb)
        (kernel_image,) = image.parent.glob("frustumscreen_*.efi")
        self._linux, self._initrd, self.command_line = parts_of(kernel_image, folder)
        self.more_words = ""  # on the kernel's command line, of the next start

    def is_running(self):
        return getattr(self, "_process", None) is not None and self._process.poll() is None

    def _command(self):
        return [str(word) for word in (
            "qemu-system-x86_64", "-name", "frustumscreen-image", "-machine", "q35", "-accel", "tcg,thread=multi,tb-size=512",
            "-cpu", "max", "-smp", self.processors, "-m", f"{self.memory_mib}M", "-display", "none", "-no-user-config", "-nodefaults",
            "-kernel", self._linux, "-initrd", self._initrd, "-append", f"{self.command_line} {self.more_words}".strip(),
            "-drive", f"if=none,id=disk,format=raw,file={self.disk},readonly={'on' if self.read_only else 'off'}",
            "-device", "virtio-blk-pci,drive=disk,serial=disk",
            *self.lines(),
            "-vga", "none", "-device", self._screen,
            "-device", "qemu-xhci,id=usb,p2=12,p3=12",
            "-device", "i6300esb", "-action", "watchdog=reset",
            *self.usb_devices())]
