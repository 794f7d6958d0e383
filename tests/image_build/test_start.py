"""The image from power on: its first start, the next one, and disks that are damaged in between."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from appliance import DATA, SLOT_A, SLOT_B, Appliance, eventually, tracker

IMAGE = pathlib.Path(os.environ["FRUSTUMSCREEN_IMAGE"])  # frustumscreen.raw of a test's image
LOGS = pathlib.Path(os.environ["FRUSTUMSCREEN_IMAGE_LOGS"])


def long(test):
    """A test that needs `./test image --all`."""
    return unittest.skipUnless(os.environ.get("FRUSTUMSCREEN_IMAGE_ALL"), "long: ./test image --all")(test)


class Start(unittest.TestCase):
    def setUp(self):
        name = self.id().rsplit(".", 1)[-1]
        self.sockets = pathlib.Path(tempfile.mkdtemp(prefix="image-"))
        self.addCleanup(shutil.rmtree, self.sockets)
        (LOGS / name).mkdir(parents=True, exist_ok=True)
        self.tracker = tracker(self.sockets, LOGS / name)
        self.addCleanup(self.tracker.stop)
        self.pc = Appliance(IMAGE, LOGS / name, self.sockets, {"tracker": self.tracker.usb})
        self.addCleanup((LOGS / name / "disk.raw").unlink)

    def start(self):
        self.pc.start()
        self.addCleanup(self.pc.stop)
        self.pc.wait_until_lit()

    def switch_off(self):
        """By the plug, not by a command."""
        self.pc.stop()

    def test_two_starts(self):
        """Unattended to a lit exhibit; the data partition grows; who it is stays; a byte that flips in the root is mended."""
        pc = self.pc
        small = pc.partition(DATA)[1]
        self.start()
        self.assertEqual(pc.notes(), "")
        machine_id = pc.check("cat /etc/machine-id").strip()
        self.assertRegex(machine_id, "^[0-9a-f]{32}$")
        self.assertEqual(pc.check("hostname").strip(), f"frustumscreen-{machine_id[:6]}")
        grown = eventually(lambda: pc.run("systemctl is-active frustumscreen-grow").output.strip() == "inactive"
                           and int(pc.check("stat -f -c %b /data")) * 4096, 60.0, "the data partition does not grow")
        self.assertGreater(grown, 8 * small)
        self.assertIn("integrity", pc.check("cat /sys/kernel/security/lockdown").split("[")[1].split("]")[0])
        self.assertEqual(pc.check("systemctl --failed --no-legend").strip(), "")
        eventually(lambda: pc.run("systemctl is-active systemd-bless-boot").output.strip() == "active", 120.0,
                   "the start is never marked as good")
        self.assertRegex(pc.check("mount -o ro $(readlink -f /run/frustumscreen-boot/boot) /efi && ls /efi/EFI/Linux; umount /efi"),
                         r"^frustumscreen_[0-9.]+\+5\.efi$")
        pc.check("echo kept > /var/lib/frustumscreen/kept; sync")
        self.switch_off()

        offset, _ = pc.partition(SLOT_A)
        self.assertGreater(pc.partition(DATA)[1], 8 * small)
        pc.flip(offset + 96)  # of the root's first block: its file system's own first bytes
        self.start()
        self.assertEqual(pc.check("cat /etc/machine-id").strip(), machine_id)
        self.assertEqual(pc.check("cat /var/lib/frustumscreen/kept").strip(), "kept")
        self.assertIn("FEC", pc.check("dmesg"), "nothing says that the byte was mended: was it read?")
        self.assertEqual(pc.notes(), "")

    def assert_lit_on_memory(self):
        """Lit, and it says that nothing is kept."""
        self.start()
        self.assertRegex(self.pc.notes(), "^data: .*until the machine is switched off")
        self.assertRegex(self.pc.check("cat /etc/machine-id"), "^[0-9a-f]{32}$")
        self.pc.check("touch /var/lib/frustumscreen/new /var/lib/frustumscreen-watchdog/new /etc/frustumscreen/new")

    @long
    def test_data_partition_overwritten(self):
        self.pc.fill(DATA, b"\xa5")
        self.assert_lit_on_memory()

    @long
    def test_data_partition_missing(self):
        subprocess.run(["sfdisk", "--quiet", "--delete", self.pc.disk, str(DATA)], check=True)
        self.assert_lit_on_memory()

    @long
    def test_disk_that_cannot_be_written(self):
        self.pc.read_only = True
        self.assert_lit_on_memory()

    @long
    def test_data_partition_damaged(self):
        """A file system that is damaged is mended, and what it held is there."""
        self.start()
        self.pc.check("echo kept > /var/lib/frustumscreen/kept; sync")
        self.switch_off()
        offset, _ = self.pc.partition(DATA)
        with open(self.pc.disk, "r+b") as disk:
            disk.seek(offset + 1024)  # the superblock; its copies are in later groups of blocks
            disk.write(bytes(1024))
        self.start()
        self.assertRegex(self.pc.notes(), "^data: the data partition was damaged and is mended")
        self.assertEqual(self.pc.check("cat /var/lib/frustumscreen/kept").strip(), "kept")

    @long
    def test_data_partition_full(self):
        self.start()
        eventually(lambda: "inactive" in self.pc.run("systemctl is-active frustumscreen-grow").output, 60.0, "it grows for ever")
        self.pc.run("dd if=/dev/zero of=/data/full bs=1M; echo > /data/more; sync", 300.0)
        self.switch_off()
        self.start()
        self.assertIn("100%", self.pc.check("df /data"))

    @long
    def test_root_in_the_other_slot(self):
        """Slot A has nothing of it; the same kernel image finds its root in B."""
        offset, size = self.pc.partition(SLOT_A)
        with open(self.pc.disk, "r+b") as disk:
            disk.seek(offset)
            slot = disk.read(size)
            disk.seek(self.pc.partition(SLOT_B)[0])
            disk.write(slot)
            disk.seek(offset)
            disk.write(bytes(size))
        self.start()
        self.assertEqual(self.pc.check("cat /run/frustumscreen-boot/slot").strip(), "frustumscreen-b")
