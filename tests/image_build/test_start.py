"""Tests starts of the image from power on: the first one, the next one, and starts with a damaged disk."""

import subprocess

from appliance import DATA, SLOT_A, SLOT_B, Appliance, eventually, screen
from image_test import IMAGE, ImageTest, long
import memory

HANGS_S = 300.0  # for which the disk does not answer


class Start(ImageTest):
    def test_first_start(self):
        """The first start leads, unattended, to a lit exhibit although a byte of the root is flipped; the data partition grows; the kiosk
        gets its identity."""
        pc = self.pc
        small = pc.partition(DATA)[1]
        pc.flip(pc.partition(SLOT_A)[0] + 96)  # in the root's first block, which has the file system's superblock
        self.start()
        self.assertIn("FEC", pc.check("dmesg"), "nothing says that the byte was mended: was it read?")
        self.assertEqual(pc.notes(), "")
        machine_id = self.machine_id()
        self.assertEqual(pc.check("hostname").strip(), f"frustumscreen-{machine_id[:6]}")
        self.assertIn("[integrity]", pc.check("cat /sys/kernel/security/lockdown"))
        self.assert_keyboard_is_not_used()
        self.assert_nothing_is_read_ahead_in_vain()
        self.assertLess(memory.used_mb(pc), memory.LIMIT_MB, "the system takes too much memory")
        eventually(lambda: int(pc.check("stat -f -c %b /data")) * 4096 > 4 * small, 120.0, "the data partition does not grow")
        self.assertEqual(pc.check("systemctl --failed --no-legend").strip(), "")
        self.switch_off()
        self.assertGreater(pc.partition(DATA)[1], 4 * small)

    @long
    def test_second_start(self):
        """Kept data are there, and the good start has reset the tries."""
        pc = self.pc
        self.start()
        machine_id = self.machine_id()
        eventually(lambda: pc.run("systemctl is-active systemd-bless-boot").output.strip() == "active", 240.0,
                   "the start is never marked as good")
        self.assertRegex(pc.check("mount -o ro $(readlink -f /run/frustumscreen-boot/boot) /efi && ls /efi/EFI/Linux; umount /efi"),
                         r"^frustumscreen_[0-9.]+\+5\.efi$")
        pc.check("echo kept > /var/lib/frustumscreen/kept; sync")
        self.switch_off()
        self.start()
        self.assertEqual(self.machine_id(), machine_id)
        self.assertEqual(pc.check("cat /var/lib/frustumscreen/kept").strip(), "kept")
        self.assertEqual(pc.notes(), "")

    @long
    def test_restart_that_hangs(self):
        """The kernel stops instead of restarting the machine; the hardware's watchdog still runs, and restarts it."""
        self.start()
        self.pc.may_start_anew()
        self.pc.spawn("busybox halt -f")
        self.assertTrue(self.pc.resets_within(120.0), "the machine hangs for ever")
        self.pc.wait_for_start()
        self.pc.wait_until_lit()

    @long
    def test_no_system_output_appears_on_the_table(self):
        """From the command to restart until the reset, each picture is the exhibit's or dark."""
        self.start()
        self.pc.may_start_anew()
        self.pc.spawn("systemctl reboot --force")
        path, looks = self.sockets / "screen.ppm", 0
        while not self.pc.resets_within(0.0):
            self.pc.screendump(path)
            picture, looks = screen.read_ppm(path), looks + 1
            if screen.probe(picture) is None and screen.count(screen.lit(picture)) > 0:
                screen.write_png(self.pc.logs / "words.png", picture)
                self.fail(f"something that the exhibit did not draw lies on the table: {self.pc.logs}/words.png")
        self.assertGreater(looks, 5)

    @long
    def test_two_kiosks_have_different_identities(self):
        """A kiosk makes its own keys at its first start; the image contains no key that two kiosks would share."""
        own = ("cat /etc/machine-id", "cat /proc/sys/kernel/hostname", "sha256sum /var/lib/systemd/random-seed")

        def made():
            self.assertEqual(self.pc.run("grep -rl 'PRIVATE KEY' /etc /var /data").output, "")
            return [self.pc.check(command).strip() for command in own]

        self.start()
        first = made()
        self.switch_off()
        self.pc = Appliance(IMAGE, self.pc.logs, self.sockets, self.pc.usb)
        self.start()
        for command, one, other in zip(own, first, made()):
            self.assertNotEqual(one, other, command)

    def assert_nothing_is_read_ahead_in_vain(self):
        """Checks that the exhibit has mapped each library that the initrd reads ahead, except drivers, which have many names."""
        mapped = {line.rsplit("/", 1)[-1] for line in
                  self.pc.check("cat /proc/$(systemctl show -P MainPID frustumscreen.service)/maps").splitlines() if "/" in line}
        ahead = [line.rsplit("/", 1)[-1] for line in self.pc.check("cat /usr/share/frustumscreen/read_ahead").splitlines()
                 if ".so" in line and "/dri/" not in line]
        self.assertGreater(len(ahead), 5)
        self.assertEqual([name for name in ahead if not any(file.startswith(name) for file in mapped)], [])

    def machine_id(self):
        found = self.pc.check("cat /etc/machine-id").strip()
        self.assertRegex(found, "^[0-9a-f]{32}$")
        return found

    def assert_keyboard_is_not_used(self):
        """Checks that a tracker is used and a keyboard gets no driver."""
        used = "cd /sys/bus/usb/devices; for d in *-*; do [ ! -e $d/idVendor ] || echo $(cat $d/idVendor) $(cat $d/authorized); done"
        self.assertIn("0f44 1", self.pc.check(used))
        self.pc.monitor("device_add", driver="usb-kbd", id="typing", bus="usb.0")
        eventually(lambda: "0627 0" in self.pc.check(used), 30.0, lambda: f"a keyboard may be used: {self.pc.check(used)}")
        for keys in (("ctrl", "alt", "f2"), ("alt", "right"), ("ctrl", "alt", "delete")):  # by PS/2, which an emulated PC also has
            self.pc.monitor("send-key", keys=[{"type": "qcode", "data": key} for key in keys])
        self.pc.check("sleep 2")
        self.assertNotIn("eyboard", self.pc.check("cat /proc/bus/input/devices"))
        self.assertEqual(self.pc.check("cat /sys/class/tty/tty0/active").strip(), "tty1")

    def assert_lit_on_memory(self):
        """Checks that the exhibit is lit and that a note says that no data are kept."""
        self.start()
        self.assertRegex(self.pc.notes(), "^data: .*until the machine is switched off")
        self.machine_id()
        self.pc.check("touch /var/lib/frustumscreen/new /var/lib/frustumscreen-watchdog/new /etc/frustumscreen/new")

    @long
    def test_data_partition_overwritten(self):
        """The whole partition is overwritten, so it cannot be repaired."""
        self.pc.fill(DATA, b"\xa5", self.pc.partition(DATA)[1])
        self.assert_lit_on_memory()

    @long
    def test_data_partition_overwritten_at_its_beginning(self):
        """The copies of the superblock are after the overwritten part, so the repair gives a file system, but an empty one."""
        self.pc.fill(DATA, b"\xa5")
        self.start()
        self.assertRegex(self.pc.notes(), "^data: the data partition was damaged and is mended")
        self.machine_id()
        self.pc.check("touch /var/lib/frustumscreen/new /etc/frustumscreen/new")
        self.assertIn(" /data ext4 rw", self.pc.check("cat /proc/mounts"))

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
        """A damaged file system is repaired, and its data are there."""
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
    def test_disk_that_hangs(self):
        """The disk stops answering, as a worn one does, until the machine restarts. It restarts at most once, and is lit at the end."""
        self.start()
        self.pc.may_start_anew()
        self.pc.check("sync")
        self.pc.let_disk_hang(True)
        begun = self.pc.granted_s()
        self.pc.spawn("echo 3 > /proc/sys/vm/drop_caches; cat /usr/bin/* > /dev/null; touch /data/hung; sync")
        dark, restart_s = [], None
        while restart_s is None and self.pc.granted_s() < begun + HANGS_S:
            if self.pc.resets_within(5.0):
                restart_s = self.pc.granted_s() - begun
            elif self.pc.lit_picture() is None:
                dark.append(round(self.pc.granted_s() - begun))
        self.pc.let_disk_hang(False)
        print(f"\nthe disk hangs: restart after {restart_s} s, dark seen at {dark} s", flush=True)
        if restart_s:
            self.pc.wait_for_start()  # the card shows the old picture for a while
        self.pc.wait_until_lit()
        print(f"lit {self.pc.granted_s() - begun:.0f} s after the disk hung", flush=True)
        self.assertTrue(restart_s or not dark, "dark, and nothing starts the machine again")
        self.assertFalse(self.pc.resets_within(60.0), "it starts more than once")
        self.pc.wait_until_lit()

    @long
    def test_root_in_the_other_slot(self):
        """Slot A is empty; the same kernel image finds its root in slot B."""
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

    @long
    def test_card_without_driver(self):
        """The console shows a message about this, and nothing else."""
        self.pc = Appliance(IMAGE, self.pc.logs, self.sockets, {"tracker": self.tracker.usb}, card="ramfb")
        self.pc.start()
        self.addCleanup(self.pc.stop)
        path = self.sockets / "screen.ppm"

        def words():
            self.pc.screendump(path)
            picture = screen.read_ppm(path)
            return screen.count(screen.lit(picture)) / (picture.width * picture.height) > 0.005

        eventually(lambda: self.pc.run("systemctl show -P ExecMainStatus frustumscreen-no-card; systemctl show -P Result "
                                       "frustumscreen-no-card").output == "0\nsuccess\n" and words(), 120.0, "the screen is dark")
        screen.write_png(self.pc.logs / "words.png", screen.read_ppm(path))
