"""Tests updates of the system from a stick: a good one, refused ones, and those that fall back. Long: ./test image --all."""

import json
import os
import pathlib
import shutil
import subprocess
import time

from appliance import ESP, eventually
from bench import Patience
from image_test import ImageTest, long
from updates import AFTER_NEXT, NEXT, THIS, Updates, no_exhibit, no_init, no_root
import sticks  # from tests/hil, by appliance

NEXT_IMAGE = os.environ.get("FRUSTUMSCREEN_IMAGE_NEXT", "")  # the folder of an image with the version updates.NEXT
KEYS = os.environ.get("FRUSTUMSCREEN_IMAGE_KEYS", "")  # update.key, whose certificate the image has
REPORT = "/run/frustumscreen-import/report.json"
BOOT = "mount -o ro $(readlink -f /run/frustumscreen-boot/boot) /efi && ls /efi/EFI/Linux; umount /efi"
# Prints the sectors written to slot B, which the kernel counts for each partition (Documentation/admin-guide/iostats.rst).
WRITTEN_TO_B = "awk '{ print $7 }' $(dirname $(grep -lx PARTNAME=frustumscreen-b /sys/class/block/*/uevent))/stat"
CONFIG = "frustumscreen config --config /etc/frustumscreen/kiosk.toml --json"
CALIBRATION = "/var/lib/frustumscreen/calibration/calibration-0001.toml"
UPDATE_S = 600.0
RESTART_S = 300.0
TRY_S = 600.0


@long
class Update(ImageTest):
    def setUp(self):
        super().setUp()
        self.logs = self.pc.logs
        self.updates = Updates(pathlib.Path(NEXT_IMAGE), pathlib.Path(KEYS), self.logs / "bundles")
        self.addCleanup(shutil.rmtree, self.logs / "bundles")

    def start(self):
        self.begun = time.monotonic()
        self.pc.start()
        self.addCleanup(self.pc.stop)
        self.pc.may_start_anew()
        Patience.clock = self.pc.granted_s
        self.addCleanup(setattr, Patience, "clock", time.monotonic)

    def was_good(self):
        """Puts the disk into the state after a good start."""
        begin, _ = self.pc.partition(ESP)
        subprocess.run(["mren", "-i", f"{self.pc.disk}@@{begin}", f"::EFI/Linux/frustumscreen_{THIS}+3.efi",
                        f"::EFI/Linux/frustumscreen_{THIS}+5.efi"], check=True)

    def say(self, what):
        print(f"\n{time.monotonic() - self.begun:6.0f} s: {what}", flush=True)

    def wait_until_good(self):
        self.pc.wait_until_lit()
        eventually(lambda: self.pc.run("systemctl is-active systemd-bless-boot").output.strip() == "active", 600.0,
                   "the start is never marked as good")

    def stick(self, name, files, **options):
        image = sticks.file_system(self.logs / f"{name}.img", "vfat", files, 320, "UPDATE")
        self.addCleanup(image.unlink)
        self.pc.plug(name, image, **options)
        return name

    def told(self, timeout_s=UPDATE_S):
        """The final report on the stick's bundles."""
        seen = [None]

        def over():
            seen[0] = self.pc.read(REPORT)
            try:
                report = json.loads(seen[0] or "{}")
            except ValueError:
                return None
            return report if report.get("import_id", "").startswith("update-") and report["stage"] == "done" else None

        report = eventually(over, timeout_s, lambda: f"nothing is told of the update, at last {seen[0]}")
        self.say(report["packs"])
        return report["packs"]

    def refusal(self, name, bundle, file="update.raucb", **options):
        """(refusal, sentence) for the only bundle on a stick; checks that nothing changes on the disk."""
        before = self.images()
        self.stick(name, {file: bundle}, **options)
        pack, = self.told()
        self.assertEqual(pack["outcome"], "refused", pack)
        self.pc.pull(name)
        bundle.unlink()
        self.pc.check(f"rm {REPORT}")
        self.assertEqual(self.images(), before)
        return pack["refusal"], pack["reason"]

    def version(self):
        return self.pc.check("sed -n s/^IMAGE_VERSION=//p /usr/lib/os-release").strip()

    def slot(self):
        return self.pc.check("cat /run/frustumscreen-boot/slot").strip()

    def images(self):
        return self.pc.check(BOOT).split()

    def starts_again(self):
        self.assertTrue(self.pc.resets_within(RESTART_S), "the machine does not start again")
        self.pc.wait_for_start()

    def calibrate(self):
        """Writes a kept calibration that equals the settings, without our program."""
        settings = json.loads(self.pc.check(CONFIG))
        self.assertNotIn("used", settings["calibration"])
        text = 'version = 1\nmade = "2026-11-25 10:12 UTC"\nmethod = "touch"\nplaces = 9\n'
        for name, keys in (("projector", ("width", "height", "fx", "fy", "cx", "cy", "k1", "k2", "table_from_projector")),
                           ("tracker", ("table_from_tracker", "sensor_from_prop", "eye_in_sensor_m"))):
            text += f"[{name}]\n" + "".join(f"{key} = {json.dumps(settings[name][key])}\n" for key in keys)
        self.pc.write(CALIBRATION, text + "[residual]\nmean_mm = 0.3\nworst_mm = 0.9\nmean_px = 0.5\n")

    def calibration(self):
        """The calibration that the settings use: (file, time, places)."""
        used = json.loads(self.pc.check(CONFIG))["calibration"].get("used")
        return used and (used["file"], used["made"], used["places"])

    def test_good(self):
        """A good update is installed in the other slot, reported, started and marked as good; the same stick again changes nothing; the
        calibration stays."""
        self.start()
        self.wait_until_good()
        self.calibrate()
        self.pc.check(f"sync {CALIBRATION}")
        kept = self.calibration()
        self.assertEqual(kept, ("calibration-0001.toml", "2026-11-25 10:12 UTC", 9))
        self.assertEqual((self.version(), self.slot(), self.images()), (THIS, "frustumscreen-a", [f"frustumscreen_{THIS}+5.efi"]))
        self.stick("good", {f"frustumscreen-{NEXT}.raucb": self.updates.make()})
        pack, = self.told()
        self.assertEqual((pack["outcome"], pack["title"]), ("taken", f"FrustumScreen {NEXT}"), pack)
        self.starts_again()
        self.wait_until_good()
        self.say("lit again")
        self.assertEqual((self.version(), self.slot()), (NEXT, "frustumscreen-b"))
        self.assertEqual(self.calibration(), kept)
        self.assertEqual(self.images(), [f"frustumscreen_{THIS}+5.efi", f"frustumscreen_{NEXT}+5.efi"])
        self.assertEqual(self.pc.notes(), "")
        self.assertEqual(self.told()[0]["outcome"], "already_there")
        self.assertFalse(self.pc.resets_within(30.0), "the machine starts again, with nothing new")
        self.assertEqual(self.pc.check("systemctl --failed --no-legend").strip(), "")

    def test_refused(self):
        """Each bad bundle is refused with one plain sentence, and the running version goes on."""
        make = self.updates.make
        self.start()
        self.wait_until_good()  # this renames the kernel image once
        for name, bundle, refusal, words in (
                ("wrong-key", lambda: make(key="other"), "wrong_key", "not signed with the key"),
                ("cut-off", self.updates.truncated, "not_a_pack", "cut off or damaged"),
                ("older", lambda: make("0.0.9"), "older", f"version {THIS} runs"),
                ("altered", self.updates.altered, "altered", "changed after it was signed")):
            with self.subTest(name):
                told = self.refusal(name, bundle())
                self.assertEqual(told[0], refusal, told)
                self.assertIn(words, told[1])
        self.assertEqual(self.pc.check(WRITTEN_TO_B).strip(), "0", "something was written into the other slot")
        self.assertIsNotNone(self.pc.wait_until_lit())
        self.assertEqual(self.version(), THIS)
        self.assertFalse(self.pc.resets_within(20.0), "the machine starts again, with nothing new")

    def falls_back(self, change, between):
        """An update is installed and started, fails three times, and the machine falls back; the stick stays in all the time."""
        self.was_good()
        self.start()
        self.stick("bad", {"update.raucb": self.updates.make(AFTER_NEXT, change=change)})
        pack, = self.told()
        self.assertEqual(pack["outcome"], "taken", pack)
        self.assertTrue(self.pc.resets_within(RESTART_S), "the machine does not start again")
        begun = time.monotonic()
        for number in range(3):
            self.say(f"try {number + 1}")
            between()
            self.assertTrue(self.pc.resets_within(TRY_S), f"try {number + 1} does not end")
        self.pc.wait_for_start()
        self.wait_until_good()
        self.say(f"lit again, {time.monotonic() - begun:.0f} s after the update was first started")
        self.assertEqual((self.version(), self.slot()), (THIS, "frustumscreen-a"))
        self.assertEqual(self.pc.notes().strip(),
                         f"system: version {AFTER_NEXT} did not get the exhibit lit in 3 starts, so the one before runs")
        said = self.pc.run("frustumscreen status").output
        self.assertIn(f"version {THIS}, slot a; version {AFTER_NEXT} did not get the exhibit lit in 3 starts, so the one before runs", said)
        pack, = self.told()
        self.assertEqual((pack["outcome"], pack["refusal"]), ("refused", "not_a_pack"))
        self.assertIn("was tried here and did not start", pack["reason"])
        self.assertNotRegex((self.logs / "serial.log").read_text(errors="replace"), "frustumscreen-stick@.*Stopping timed out",
                            "a restart waited for the stick")
        self.assertFalse(self.pc.resets_within(30.0), "the machine starts again, with what failed")

    def test_does_not_boot(self):
        self.falls_back(no_init, lambda: None)

    def test_root_is_not_there(self):
        self.falls_back(no_root, lambda: None)

    def test_exhibit_does_not_start(self):
        def hurry():  # without waiting for the timer of five minutes
            self.pc.wait_for_start()
            self.pc.check("systemctl start --no-block frustumscreen-next-try.service")

        self.falls_back(no_exhibit, hurry)
