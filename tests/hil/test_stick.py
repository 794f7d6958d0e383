"""Tests sticks with packs: artifacts change on the screen and in the status; unsigned packs, a stick pulled out half-way, two sticks."""

import kept_calibration
import sticks
from bench import UPRIGHT, eventually
from hil_test import CENTRE_M, long
from stick_bench import IMPORT_S, LIBRARY, ToldStickTest, pulled_packs

LARGE_MIB = 8
SLOW_BYTES_PER_S = 700_000  # the pack then takes a dozen seconds
STANDING_BYTES_PER_S = 1000  # and then hours
SHOWN_S = 90.0  # until the exhibit shows the new set, which it opens in the background and takes between two artifacts


class Stick(ToldStickTest):
    before, after = kept_calibration.KEEP, kept_calibration.FORGET

    def test_1_taken_and_shown(self):
        before = self.bench.main_process()
        self.bench.picture_of((*CENTRE_M, *UPRIGHT))  # the artifact that turned at the start is gone
        self.assertEqual(self.lit_beside_prop(), 0)
        pack = self.signed("nautilus-cup", 1)
        part = self.make("part", "vfat", {"nautilus-cup.fspack": pack, "._nautilus-cup.fspack": b"Mac OS X" * 100,
                                          "System Volume Information/IndexerVolumeGuid": b"x"})
        stick = sticks.partitioned(self.image("one"), [("vfat", part)])
        held = stick.read_bytes()
        self.plug("one", stick)
        report = self.outcome()
        self.assertEqual((report["stage"], pulled_packs(report)), ("done", {"nautilus-cup.fspack": ("taken", "none")}))
        self.assertEqual(self.installed(), [("nautilus-cup", 1)])
        eventually(lambda: not self.mounts(), 30.0, "the stick stays mounted")
        self.assertTrue(stick.read_bytes() == held, "something was written to the stick")
        # The screen shows the artifact from the stick, and the exhibit was not restarted.
        self.assert_told("stick_told", "done")
        self.bench.buttons.tell("press", 2, "300ms")  # this only ends the table's message on the stick
        eventually(lambda: self.lit_beside_prop() == 0, 20.0, "what the table says stays")
        self.bench.status_says("artifact", "^nautilus-cup$", SHOWN_S)
        self.assert_at(CENTRE_M, artifact="nautilus-cup")
        self.assertEqual(self.bench.main_process(), before, "the exhibit was restarted")
        self.assertEqual(self.bench.machine.read(kept_calibration.FILE), kept_calibration.TEXT, "new packs cost the table's calibration")

    def test_2_unsigned(self):
        self.plug("unsigned", self.make("unsigned", "ext4", {"packs/amphora.fspack": self.bench.packs / "amphora.fspack"}))
        report = self.outcome()
        self.assertEqual((report["stage"], pulled_packs(report)), ("done", {"amphora.fspack": ("refused", "unsigned")}))
        self.assertEqual(self.installed(), [("nautilus-cup", 1)])
        eventually(lambda: "amphora.fspack" in self.journal_of_imports(), 20.0, "the journal does not name the pack")

    def test_3_pulled_out_half_way(self):
        pack = self.large(2, LARGE_MIB)
        self.plug("slow", self.make("slow", "vfat", {"vase.fspack": pack}), bytes_per_s=SLOW_BYTES_PER_S)
        self.stage("copying")
        self.bench.machine.slow_down("stick-slow", STANDING_BYTES_PER_S)
        self.assert_told("stick_copying", "copying")
        self.assertEqual(self.report()["stage"], "copying", "the copy was over before it was told: this proves nothing")
        self.pull("slow")
        report = self.outcome()
        self.assertEqual((report["stage"], report["refusal"]), ("failed", "unreadable"))
        self.assertEqual(self.installed(), [("nautilus-cup", 1)])
        # The second time the stick stays in until the import ends.
        self.plug("again", self.image("slow"))
        self.assertEqual(pulled_packs(self.outcome()), {"vase.fspack": ("taken", "none")})
        self.assertEqual(self.installed(), [("nautilus-cup", 1), ("Vase", 2)])

    @long
    def test_4_two_at_once(self):
        part = self.make("part", "exfat", {"amphora.fspack": self.signed("amphora", 3)})
        first = sticks.partitioned(self.image("first"), [("exfat", part)], "gpt")
        second = self.make("second", "ntfs", {"nautilus-cup.fspack": self.signed("nautilus-cup", 4)})
        self.plug("first", first)
        self.plug("second", second)
        both = {("amphora", 3), ("nautilus-cup", 4)}
        eventually(lambda: both <= set(self.installed()), 2 * IMPORT_S, lambda: f"installed: {self.installed()}")
        self.outcome()

    @long
    def test_6_usb_attached_scsi(self):
        """Fast sticks and disks in enclosures use another protocol (UAS), for which the kernel has another driver."""
        self.plug("fast", self.make("fast", "exfat", {"amphora.fspack": self.signed("amphora", 7)}), driver="usb-uas")
        self.assertEqual(pulled_packs(self.outcome()), {"amphora.fspack": ("taken", "none")})
        self.assertIn("uas", self.bench.machine.check("cat /sys/bus/usb/drivers/uas/*:*/uevent"))
        self.assertIn(("amphora", 7), self.installed())

    @long
    def test_5_no_file_system(self):
        self.image("noise").write_bytes(b"no file system " * 100_000)
        self.plug("noise", self.image("noise"))
        report = self.outcome()
        self.assertEqual((report["stage"], report["refusal"]), ("failed", "unreadable"))
        packs = self.bench.machine.check(f"ls {LIBRARY}/packs 2>/dev/null || true").split()
        self.assertEqual(set(packs) & {"incoming"}, set(), "a file was left behind")
        self.assertGreaterEqual(len(packs), len(self.installed()))
