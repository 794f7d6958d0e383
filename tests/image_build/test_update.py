"""Updates of the system from a stick: one that is good, those that are refused, those that fall back. Long: ./test image --all."""

import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import time
import unittest

from appliance import Appliance, eventually, tracker
import sticks  # from tests/hil, by appliance

IMAGE = pathlib.Path(os.environ["FRUSTUMSCREEN_IMAGE"])  # frustumscreen.raw of a test's image
LOGS = pathlib.Path(os.environ["FRUSTUMSCREEN_IMAGE_LOGS"])
UPDATES = pathlib.Path(os.environ.get("FRUSTUMSCREEN_IMAGE_UPDATES", ""))  # make_updates.sh's folder
REPORT = "/run/frustumscreen-import/report.json"
BOOT = "mount -o ro $(readlink -f /run/frustumscreen-boot/boot) /efi && ls /efi/EFI/Linux; umount /efi"
UPDATE_S = 300.0
RESTART_S = 120.0


@unittest.skipUnless(os.environ.get("FRUSTUMSCREEN_IMAGE_ALL"), "long: ./test image --all")
class Update(unittest.TestCase):
    def setUp(self):
        name = self.id().rsplit(".", 1)[-1]
        self.logs = LOGS / name
        self.sockets = pathlib.Path(tempfile.mkdtemp(prefix="image-"))
        self.addCleanup(shutil.rmtree, self.sockets)
        self.logs.mkdir(parents=True, exist_ok=True)
        self.tracker = tracker(self.sockets, self.logs)
        self.addCleanup(self.tracker.stop)
        self.pc = Appliance(IMAGE, self.logs, self.sockets, {"tracker": self.tracker.usb})
        self.addCleanup((self.logs / "disk.raw").unlink)
        self.pc.start()
        self.addCleanup(self.pc.stop)
        self.pc.may_start_anew()
        self.begun = time.monotonic()
        self.wait_until_good()

    def say(self, what):
        print(f"\n{time.monotonic() - self.begun:6.0f} s: {what}", flush=True)

    def wait_until_good(self):
        self.pc.wait_until_lit()
        eventually(lambda: self.pc.run("systemctl is-active systemd-bless-boot").output.strip() == "active", 180.0,
                   "the start is never marked as good")

    def stick(self, name, files, **options):
        image = sticks.file_system(self.logs / f"{name}.img", "vfat", files, 320, "UPDATE")
        self.addCleanup(image.unlink)
        self.pc.plug(name, image, **options)
        return name

    def told(self, timeout_s=UPDATE_S):
        """What the table is told of the stick's bundles at the end: their parts of the report."""
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

    def refusal(self, name, files, **options):
        self.stick(name, files, **options)
        packs = self.told()
        self.pc.pull(name)
        self.pc.check(f"rm {REPORT}")
        return packs

    def version(self):
        return self.pc.check("sed -n s/^IMAGE_VERSION=//p /usr/lib/os-release").strip()

    def slot(self):
        return self.pc.check("cat /run/frustumscreen-boot/slot").strip()

    def images(self):
        return self.pc.check(BOOT).split()

    def starts_again(self):
        self.assertTrue(self.pc.resets_within(RESTART_S), "the machine does not start again")
        self.pc.wait_for_start()

    def test_good(self):
        """Installed in the other slot, told, started, marked as good; the same stick again changes nothing."""
        self.assertEqual((self.version(), self.slot(), self.images()), ("0.1.0", "frustumscreen-a", ["frustumscreen_0.1.0+5.efi"]))
        self.stick("good", {"frustumscreen-0.2.0.raucb": UPDATES / "frustumscreen-0.2.0.raucb"})
        pack, = self.told()
        self.assertEqual((pack["outcome"], pack["title"]), ("taken", "FrustumScreen 0.2.0"), pack)
        self.starts_again()
        self.wait_until_good()
        self.say("lit again")
        self.assertEqual((self.version(), self.slot()), ("0.2.0", "frustumscreen-b"))
        self.assertEqual(self.images(), ["frustumscreen_0.1.0+5.efi", "frustumscreen_0.2.0+5.efi"])
        self.assertEqual(self.pc.notes(), "")
        self.assertEqual(self.told()[0]["outcome"], "already_there")
        self.assertFalse(self.pc.resets_within(30.0), "the machine starts again, with nothing new")
        self.assertEqual(self.pc.check("systemctl --failed --no-legend").strip(), "")


if __name__ == "__main__":
    unittest.main()
