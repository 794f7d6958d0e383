"""Tests the return to the state of delivery: a signed stick requests it, a button on the staff's picture confirms it, and the machine
restarts without any data of the museum."""

import kept_calibration
from bench import SETTINGS, UNIT, eventually
from hil_test import LIT, START_S, long
from stick_bench import LIBRARY, StickTest, pulled_packs
from test_calibration import FIRST, LAST
from test_missing import SYSTEM_BACK_S
from test_stick_copy import DAY, REQUEST, VISITS

ASKS = b'reset = true\nuntil = "2099-12-31"\n'
DELIVERED = "/usr/share/frustumscreen/kiosk.toml"
DATA, KEPT = "/var/lib/frustumscreen", "/var/lib/hil-kept"  # packs and words of the other tests are moved away and restored
PRESSED_S = 4.0  # a button must be held for two seconds; a slow machine notices it late


@long
class Delivery(StickTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        machine = cls.bench.machine
        machine.check(f"rm -rf {KEPT}; cp -a {DATA} {KEPT}; {kept_calibration.KEEP}")
        machine.write(DAY, VISITS)
        cls.request = cls.folder / REQUEST
        cls.request.write_bytes(ASKS)

    @classmethod
    def tearDownClass(cls):
        machine = cls.bench.machine
        machine.check(f"systemctl stop {UNIT}; {kept_calibration.FORGET}; rm -rf {DAY} {SETTINGS}.*; cp -a {KEPT}/. {DATA}; rm -rf {KEPT}")
        super().tearDownClass()  # writes the usual settings
        machine.check(f"systemctl start --no-block {UNIT}")

    def asked(self, name, files):
        """Puts in a stick with these files, pulls it out again, and returns the report on it."""
        self.plug(name, self.make(name, "vfat", files))
        told = pulled_packs(self.outcome())
        eventually(lambda: not self.mounts(), 30.0, "the stick stays mounted")
        self.pull(name)
        return told

    def confirm(self, until):
        """Shows the staff's picture, and holds the first button on its first page until then."""
        self.bench.hold((FIRST, LAST), lambda: self.bench.status_says("state", "staff"))
        self.bench.hold((FIRST,), until)

    def boot(self):
        return self.bench.machine.read("/proc/sys/kernel/random/boot_id")

    def listed(self, folder):
        return self.bench.machine.check(f"ls -A {folder}").split()

    def test_1_without_a_signature_the_button_does_nothing(self):
        boot = self.boot()
        self.assertEqual(self.asked("unsigned", {REQUEST: ASKS}), {REQUEST: ("not_written", "unsigned")})
        self.confirm(lambda: self.bench.machine.let_run(PRESSED_S))
        self.bench.hold((FIRST, LAST), lambda: self.bench.status_says("state", "^(?!staff)"))
        self.assertEqual(self.boot(), boot)
        self.assertIn("places = 9", self.bench.machine.read(kept_calibration.FILE))
        self.assertIn("184000", self.bench.machine.read(DAY))

    def test_2_signed_and_confirmed(self):
        machine = self.bench.machine
        boot = self.boot()
        self.sign(self.request, 1)
        signature = self.request.with_name(f"{REQUEST}.minisig")
        told = self.asked("asks", {REQUEST: ASKS, signature.name: signature})
        self.assertEqual(told, {REQUEST: ("pending", "none")})
        machine.may_start_anew()
        self.confirm(lambda: self.assertTrue(machine.resets_within(SYSTEM_BACK_S), "the machine does not start again"))
        machine.wait_for_start()
        self.bench.status_says("display", LIT, SYSTEM_BACK_S)  # by then its folders are made again
        self.assertNotEqual(self.boot(), boot)
        self.assertEqual(machine.read(SETTINGS), machine.read(DELIVERED))
        for folder in (kept_calibration.FOLDER, f"{DATA}/counts", f"{DATA}/packs"):
            self.assertEqual(self.listed(folder), [], folder)
        self.assertNotIn("set.txt", self.listed(LIBRARY))
        kept = set(self.listed("/etc/frustumscreen")) & {"kiosk.toml.before", "kiosk.toml.serial", "kiosk.toml.proved"}
        self.assertEqual(kept, set())  # kiosk.toml.proved.new is of this start
        self.bench.status_says("artifact", "^(?!amphora|nautilus-cup).", START_S)
