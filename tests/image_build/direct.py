"""The image in an emulated PC without firmware: QEMU itself loads kernel, initrd and command line of the kernel image on the disk.

It is for tests that do not concern the firmware and the boot loader, which take 15 to 20 s of each start.

Frame, time, threads, errors   as in appliance.py.
Source   sections .linux, .initrd, .cmdline: systemd-stub(7).
"""

from appliance import Appliance
import image as parts  # from tests/hil, by appliance


class Direct(Appliance):
    """`image`: the disk; `kernel_image`: default: the one beside it, where ./image_build/build has left both."""

    def __init__(self, image, folder, sockets, usb, kernel_image=None):
        super().__init__(image, folder, sockets, usb)
        if kernel_image is None:
            (kernel_image,) = image.parent.glob("frustumscreen_*.efi")
        parts.kernel_image_parts(kernel_image, folder)
        self.command_line = (folder / "cmdline").read_text(encoding="ascii").strip("\0 \n")
        self.more_words = ""  # added to the kernel's command line of the next start

    def is_running(self):
        return getattr(self, "_process", None) is not None and self._process.poll() is None

    def _command(self):
        return [str(word) for word in (
            "qemu-system-x86_64", "-name", "frustumscreen-image", "-machine", "q35", "-accel", "tcg,thread=multi,tb-size=512",
            "-cpu", self.processor, "-smp", self.processors, "-m", f"{self.memory_mib}M", "-display", "none", "-no-user-config", "-nodefaults",
            "-kernel", self.logs / "linux", "-initrd", self.logs / "initrd", "-append", f"{self.command_line} {self.more_words}".strip(),
            "-drive", f"if=none,id=disk,format=raw,file={self.disk},readonly={'on' if self.read_only else 'off'}",
            "-device", "virtio-blk-pci,drive=disk,serial=disk",
            *self.lines(),
            "-vga", "none", "-device", self._screen,
            "-device", "qemu-xhci,id=usb,p2=12,p3=12",
            "-device", "i6300esb", "-action", "watchdog=reset",
            *self.usb_devices())]
