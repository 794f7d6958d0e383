"""Tests break-outs: attacks with a keyboard, a stick, a device that types or a network cable, from power on. Long:
./test image --all. At the end of each test the agent makes real break-ins, which `intruders` must detect."""

import base64
import json
import shutil
import socket
import struct
import subprocess
import time

import intruders
from appliance import ESP, Appliance, eventually
from image_test import IMAGE, ImageTest, long
import hostile_stick  # it needs tests/hil, by appliance

FUNCTION_KEYS = [f"f{number}" for number in range(1, 13)]
COMBINATIONS = [
    *(("ctrl", "alt", key) for key in FUNCTION_KEYS), *(("alt", key) for key in FUNCTION_KEYS), *((key,) for key in FUNCTION_KEYS),
    *(("alt", key) for key in ("left", "right", "up")), *(("alt", "sysrq", key) for key in "bceirostukghvf"),
    *(("ctrl", "alt", "delete"),) * 7, ("ctrl", "alt", "backspace"), ("ctrl", "alt", "esc"), ("ctrl", "alt", "pause"),
    *(("ctrl", key) for key in ("c", "d", "z", "backslash", "s", "q", "scroll_lock", "pause")), ("alt_r", "scroll_lock"),
    ("shift", "scroll_lock"), ("shift", "pgup"), ("scroll_lock",), ("pause",), ("print",), ("esc",), ("esc",), ("menu",), ("meta_l", "r"),
    ("sleep",), ("wake",), ("num_lock",), ("insert",), ("delete",), ("power",), *((key,) for key in "root"), ("ret",), ("ret",)]
NETWORK = ("e1000e", "virtio-net-pci")
SETTINGS = "/etc/frustumscreen/kiosk.toml"
REPORT = "/run/frustumscreen-import/report.json"
KEY = base64.b64encode(b"Ed" + bytes(range(40))).decode()  # a public key without a private one
LOOKED_THROUGH_S = 90.0  # time in which a stick of many partitions is searched
MENU_S = 60.0
MENU_STAYS_S = 330.0  # longer than the firmware's watchdog, five minutes
LOADER_VARIABLES = "ls /sys/firmware/efi/efivars | grep -e ^LoaderEntryDefault -e ^LoaderConfig -e ^LoaderEntryOneShot"


class Attacked(Appliance):
    """A PC with `more` devices; `at_power_on` is a function that attacks it from power on."""

    more = ()
    at_power_on = None

    def _command(self):
        return super()._command() + [str(word) for word in self.more]

    def _connect_agent(self):
        attack, self.at_power_on = self.at_power_on, None
        if attack:
            attack()
        super()._connect_agent()

    def press(self, *keys, pause_s=0.12):
        self.monitor("send-key", keys=[{"type": "qcode", "data": key} for key in keys], **{"hold-time": 50})
        self.rest(pause_s)

    def rest(self, granted_s):
        """Lets the guest run for this time, so that it has read one key before the next comes, also on a busy host."""
        end_s = self.granted_s() + granted_s
        while self.granted_s() < end_s:
            time.sleep(0.05)

    def said(self):
        """The output of firmware and boot loader on the serial line, which is also their console."""
        log = self.logs / "serial.log"
        return log.read_text(errors="replace") if log.exists() else ""


@long
class BreakOut(ImageTest):
    def setUp(self):
        super().setUp()
        self.pc = Attacked(IMAGE, self.pc.logs, self.sockets, self.pc.usb)

    def start(self):
        super().start()
        self.pc.may_start_anew()
        eventually(lambda: "inactive" in self.pc.run("systemctl is-active frustumscreen-grow").output, 120.0, "it grows for ever")
        self.before = intruders.facts(self.pc)
        self.assertEqual(intruders.wrong(self.before, self.before), [], "something is strange before anybody did anything")
        keymap = self.pc.check("dumpkmap | tail -c +264 | od -An -v -t x2").split()
        self.assertGreater(len(keymap), 7 * 127)
        self.assertLessEqual(set(keymap), {"0200", "027f"}, "a key means something to the kernel")  # K_HOLE, K_NOSUCHMAP

    def assert_nobody_is_in(self, **options):
        """Waits until no sign of a break-in is left, and checks that the machine has not restarted and the exhibit is lit."""
        said = [None]

        def rests():
            said[0] = intruders.wrong(self.before, intruders.facts(self.pc), **options)
            return not said[0]

        eventually(rests, 60.0, lambda: f"somebody is in: {said[0]}")
        self.assertFalse(self.pc.resets_within(1.0), "the machine started again")
        self.pc.wait_until_lit()

    def assert_seen(self, command, words):
        """Lets the agent make a real break-in by this command; `intruders` must report it in these words."""
        self.pc.run(command)
        eventually(lambda: any(words in line for line in intruders.wrong(self.before, intruders.facts(self.pc))), 60.0,
                   f"the judge does not see it: {command}")

    # The boot loader.

    def call_menu(self, key):
        """Holds a key from power on until the boot loader's menu appears."""
        deadline = self.pc.granted_s() + 4 * MENU_S
        known = len(self.pc.said())
        while "(h)elp" not in self.pc.said()[known:]:
            self.assertLess(self.pc.granted_s(), deadline, "the boot loader's menu does not come: does this test hold the key well?")
            self.pc.press(key, pause_s=0.05)
            if key != "h":
                self.pc.press("h", pause_s=0.05)

    def signed_command_line(self):
        """The command line in the kernel image on the disk."""
        begin, _ = self.pc.partition(ESP)
        image = self.sockets / "kernel.efi"
        listed = subprocess.run(["mdir", "-b", "-i", f"{self.pc.disk}@@{begin}", "::EFI/Linux"], check=True, capture_output=True,
                                text=True).stdout.split()
        subprocess.run(["mcopy", "-i", f"{self.pc.disk}@@{begin}", listed[0], image], check=True)
        words = subprocess.run(["objcopy", "-O", "binary", "--only-section=.cmdline", image, "/dev/stdout"], check=True,
                               capture_output=True).stdout
        return words.rstrip(b"\0").decode().strip()

    def in_the_menu(self):
        """Presses each key that the menu knows, and types a command line as if there were an editor."""
        self.call_menu("h")
        known = len(self.pc.said())
        for key in ("e", "e", "up", "down", "home", "end", "pgup", "pgdn", "minus"):
            self.pc.press(key, pause_s=0.3)
        self.assertNotIn("root_hash", self.pc.said()[known:], "the editor opened")
        for keys in (("d",), ("t",), ("t",), ("t",), ("r",), ("w",), ("v",), ("f",), ("l",), ("ctrl", "l"), ("esc",), ("f2",), ("home",), ("e",)):
            self.pc.press(*keys, pause_s=0.5)
        self.assertRegex(self.pc.said()[known:], "Default boot entry|default boot entry", "d, t: did these keys come?")
        for key in ("spc", *"init", "equal", "slash", *"bin", "slash", *"sh", "spc"):
            self.pc.press(key)
        self.pc.press("home")
        self.pc.press("ret", pause_s=0.0)
        self.while_it_starts()

    def while_it_starts(self):
        """Presses keys while kernel and initrd start. It waits until the instruction pointer is the kernel's, because firmware and boot
        loader obey Ctrl+Alt+Del."""
        eventually(lambda: "RIP=ffffffff" in self.pc.monitor("human-monitor-command", **{"command-line": "info registers"}), 4 * MENU_S,
                   "no kernel starts")
        for _ in range(6):
            for keys in (("ctrl", "alt", "delete"), ("alt", "sysrq", "b"), ("ctrl", "alt", "f2"), ("ctrl", "c"), ("ret",), ("esc",)):
                self.pc.press(*keys, pause_s=0.2)

    def test_keyboard(self):
        """A keyboard on USB and PS/2, from power on."""
        self.pc.more = ("-device", "usb-kbd,id=keyboard,bus=usb.0,port=9")
        command_line = self.signed_command_line()
        self.pc.at_power_on = self.in_the_menu
        self.start()
        self.assertEqual(self.pc.check("cat /proc/cmdline").strip(), command_line)
        self.assertEqual(self.pc.run(LOADER_VARIABLES).output, "", "what was chosen in the menu outlives this start")
        self.assertNotIn("Keyboard", str(self.before.get("keyboards")))

        with self.subTest("PS/2"):  # QEMU sends keys to the USB keyboard while there is one
            self.pc.monitor("device_del", id="keyboard")
            self.press_everything()
        with self.subTest("USB, not authorised"):
            self.pc.monitor("device_add", driver="usb-kbd", id="typing", bus="usb.0", port="9")
            self.pc.rest(5.0)
            self.press_everything()
        with self.subTest("USB, as if it had said that it is a tracker"):
            # udev is stopped, because it would refuse the keyboard again at once.
            self.pc.check("udevadm control --stop-exec-queue; for d in /sys/bus/usb/devices/*; do grep -qs 0627 $d/idVendor && echo 1 > $d/authorized; done; "
                          "modprobe usbhid; modprobe hid-generic; modprobe evdev")
            eventually(lambda: "Keyboard" in self.pc.check("cat /proc/bus/input/devices"), 30.0, "it is no keyboard")
            self.before = intruders.facts(self.pc)
            self.assert_keys_come()
            self.press_everything()
        with self.subTest("serial line"):
            self.type_on_serial_line()
        with self.subTest("the judge sees a console that was switched"):
            self.pc.write("/run/map.hex", KEYMAP.hex())
            self.pc.check("xxd -r -p /run/map.hex | loadkmap; : > /dev/tty2")  # the kernel switches only to a console that was opened
            self.pc.press("ctrl", "alt", "f2", pause_s=2.0)
            self.assert_seen("true", "the console shows ['tty2']")

    def press_everything(self):
        for keys in COMBINATIONS:
            self.pc.press(*keys)
        self.pc.rest(3.0)
        self.assert_nobody_is_in()

    def assert_keys_come(self):
        """The kernel counts them."""
        event = self.pc.check("sed -n '/Keyboard/,/^$/s/.*\\(event[0-9]*\\).*/\\1/p' /proc/bus/input/devices").split()[0]
        self.pc.check(f"cat /dev/input/{event} > /run/typed 2> /dev/null & sleep 1")
        self.pc.press("a")
        eventually(lambda: int(self.pc.check("stat -c %s /run/typed")) > 0, 10.0, "no key comes")
        self.pc.check("kill $(pidof cat); rm /run/typed")

    def type_on_serial_line(self):
        with socket.socket(socket.AF_UNIX) as port:
            port.connect(str(self.sockets / "serial"))
            for words in (b"\r\n", b"root\r\n", b"\x03\x04\x1a\x1c", b"\r\nid > /run/typed\r\n", b"$3#33", b"~.", b"+++ATH\r\n"):
                port.sendall(words)
                self.pc.rest(0.5)
            self.pc.monitor("chardev-send-break", id="serial")
            port.sendall(b"b")
            self.pc.rest(2.0)
        self.assert_nobody_is_in()

    def test_menu_is_left_alone(self):
        """A person holds a key at power on and goes away. The menu stays, because systemd-boot stops the firmware's watchdog for it.
        Return, or the power switch, ends it."""
        self.pc.more = ("-device", "usb-kbd,id=keyboard,bus=usb.0,port=9")

        def hold():
            self.call_menu("x")
            self.pc.may_start_anew()
            self.assertFalse(self.pc.resets_within(MENU_STAYS_S), "the menu ends by itself: docs/security.md says that it does not")
            self.pc.press("ret")

        self.pc.at_power_on = hold
        self.start()
        self.assert_nobody_is_in()

    def test_firmware_from_the_menu(self):
        """Q leaves the boot loader for the firmware and its own menus. The choices made in the menu are kept, here that the menu is always
        shown. So the menu also appears at the next power on, until Return; after that the machine starts as usual."""
        self.pc.more = ("-device", "usb-kbd,id=keyboard,bus=usb.0,port=9")

        def leave():
            self.call_menu("h")
            known = len(self.pc.said())
            self.pc.press("t", pause_s=1.0)
            self.assertIn("menu will always be shown", self.pc.said()[known:])
            known = len(self.pc.said())
            self.pc.press("shift", "q", pause_s=20.0)
            shown = self.pc.said()[known:]
            self.assertNotIn("Linux", shown)
            (self.pc.logs / "after_q.txt").write_text(shown, encoding="utf-8")
            self.pc.monitor("system_reset")
            self.pc.rest(MENU_S)
            known = len(self.pc.said())
            self.pc.press("h", pause_s=2.0)
            self.assertIn("(h)elp", self.pc.said()[known:], "the menu does not stand: docs/security.md says that it does")
            self.pc.press("ret")

        self.pc.at_power_on = leave
        self.start()
        self.assertEqual(self.pc.run(LOADER_VARIABLES).output, "", "what was chosen in the menu outlives this start")
        self.assert_nobody_is_in()

    # USB.

    def test_hostile_stick(self):
        """None of its programs is run, and a partition is mounted only while the importer reads it."""
        boot_loader = subprocess.run(["mtype", "-i", f"{self.pc.disk}@@{self.pc.partition(ESP)[0]}", "::EFI/BOOT/BOOTX64.EFI"], check=True,
                                     capture_output=True).stdout
        folder = self.pc.logs / "stick"
        self.addCleanup(shutil.rmtree, folder)
        stick = hostile_stick.make(folder, boot_loader)
        self.start()
        # A kiosk that visitors use has a key; without one it would take the stick's kiosk.toml (docs/security.md).
        self.pc.check(f"printf '\\n[[exhibit.keys]]\\nname = \"museum\"\\npublic_key = \"{KEY}\"\\n' >> {SETTINGS}")
        settings = self.pc.read(SETTINGS)
        self.pc.plug("hostile", stick)
        seen, told, deadline = set(), set(), self.pc.granted_s() + LOOKED_THROUGH_S
        while self.pc.granted_s() < deadline:
            report = json.loads(self.pc.read(REPORT) or "{}")
            told |= {(one["outcome"], one["refusal"]) for one in report.get("packs", []) if one["file"] == "kiosk.toml"}
            now = intruders.facts(self.pc)
            seen |= {line.partition(" ")[0] for line in now["mounted"]}
            self.assertEqual(intruders.wrong(self.before, now, mounted=r"/run/frustumscreen-stick/stick\d+p\d+"), [])
        self.assertIn("/run/frustumscreen-stick", {place.rpartition("/")[0] for place in seen}, "was the stick looked at at all?")
        self.assert_not_marked()
        self.assertEqual(told, {("refused", "unsigned")}, "its kiosk.toml")
        self.assertEqual(self.pc.read(SETTINGS), settings)
        eventually(lambda: not [row for row in intruders.facts(self.pc)["mounted"] if "stick" in row], 240.0, "it stays mounted")
        self.assert_nobody_is_in()
        with self.subTest("in a PC that is switched on"):
            version = self.pc.check("cat /run/frustumscreen-boot/slot /etc/machine-id")
            self.pc.monitor("system_reset")
            self.assertTrue(self.pc.resets_within(10.0))
            self.pc.wait_for_start()
            self.pc.wait_until_lit()
            self.assertEqual(self.pc.check("cat /run/frustumscreen-boot/slot /etc/machine-id"), version)
            self.assertEqual(self.pc.notes(), "")
            self.assert_not_marked()
        with self.subTest("the judge sees a mount and a program"):
            self.assert_seen("mkdir -p /run/m && mount -t tmpfs m /run/m && cp /usr/bin/busybox /run/m/sleep", "/run/m is mounted")
            self.assert_seen("setsid /run/m/sleep 600 > /dev/null 2>&1 & sleep 1", "/run/m/sleep runs")

    def assert_not_marked(self):
        self.assertEqual(self.pc.run(f"ls {hostile_stick.MARK}").status, 1, "something of the stick was run")

    def test_devices_that_type_and_networks(self):
        """A hub with a keyboard, mice, a card reader, a camera, a serial port and a network card; and network cables with a peer."""
        self.pc.more = [word for number, card in enumerate((*NETWORK, "usb")) for word in (
            "-netdev", f"user,id=net{number}", "-object", f"filter-dump,id=dump{number},netdev=net{number},file={self.pc.logs}/net{number}.pcap",
            *(("-device", f"{card},netdev=net{number},mac=52:54:00:00:00:0{number},romfile=") if card != "usb" else ()))]
        self.pc.more += ["-chardev", "null,id=port"]
        shared = self.sockets / "shared"
        shared.mkdir()
        self.start()
        self.pc.monitor("device_add", driver="usb-hub", id="hub", bus="usb.0", port="9")
        for number, (driver, options) in enumerate((
                ("usb-kbd", {}), ("usb-mouse", {}), ("usb-tablet", {}), ("usb-wacom-tablet", {}), ("usb-ccid", {}),
                ("usb-mtp", {"rootdir": str(shared)}), ("usb-serial", {"chardev": "port", "always-plugged": True}),
                ("usb-net", {"netdev": "net2", "mac": "52:54:00:00:00:02"})), 1):
            self.pc.monitor("device_add", driver=driver, id=f"bad{number}", bus="usb.0", port=f"9.{number}", **options)
        eventually(lambda: len(self.usb("0")) >= 8, 60.0, lambda: f"not all are refused: {self.usb('0')}, used: {self.usb('1')}")
        for device in self.usb("0"):
            self.assertEqual(self.pc.run(f"ls -d /sys/bus/usb/devices/{device}:*").status, 1, f"{device} has interfaces")
        self.press_everything()
        self.pc.monitor("device_del", id="hub")
        self.pc.check("sleep 20")
        self.assert_nobody_is_in()
        with self.subTest("the judge sees an open port"):
            self.assert_seen("setsid nc -l -p 4444 > /dev/null 2>&1 & sleep 1", "somebody may be spoken to")
        self.pc.stop()
        for number in range(3):
            dump = (self.pc.logs / f"net{number}.pcap").read_bytes()
            self.assertEqual(sent_by(dump, bytes((0x52, 0x54, 0, 0, 0, number))), [], f"net{number}: a packet left the machine")

    def usb(self, authorised):
        """The names of the devices that are authorised (1) or not (0)."""
        return self.pc.check(f"cd /sys/bus/usb/devices; for d in *-*; do case $d in *:*) ;; *) "
                             f"[ $(cat $d/authorized) != {authorised} ] || echo $d ;; esac; done").split()


def sent_by(dump, address):
    """The packets of a libpcap file whose sender is `address`."""
    magic, = struct.unpack_from("<I", dump)
    assert magic == 0xA1B2C3D4, "not libpcap's format"
    place, found = 24, []
    while place < len(dump):
        length, = struct.unpack_from("<I", dump, place + 8)
        packet = dump[place + 16:place + 16 + length]
        if packet[6:12] == address:
            found.append(packet)
        place += 16 + length
    return found


def _keymap(keys):
    """A keymap for busybox' loadkmap. `keys`: (map, key) -> the key's function."""
    maps = sorted({0, *(number for number, _ in keys)})
    return b"bkeymap" + bytes(number in maps for number in range(256)) + b"".join(
        struct.pack("<128H", *(keys.get((number, key), 0x0200) for key in range(128))) for number in maps)


# Ctrl and Alt as modifiers, and with both, F2 switches to the second console (linux/keyboard.h: KT_SHIFT, KT_CONS)
KEYMAP = _keymap({(number, key): what for number in (0, 4, 8, 12) for key, what in ((29, 0x0702), (56, 0x0703), (60, 0x0501))})
