"""The kiosks whose power is cut: the image in an emulated PC, on a disk that records its writes or on one that a cut has left.

Threads  one caller.
Errors   MachineError, AssertionError.
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "image_build"))
# pylint: disable=wrong-import-position
from appliance import Appliance, tracker  # noqa: E402
from bench import Patience, eventually  # noqa: E402
import sticks  # noqa: E402
from states import kept_text  # noqa: E402
from updates import NEXT  # noqa: E402
from write_log import RecordedDisk, sparse_copy  # noqa: E402

KEPT, UNSAFE, SETTINGS = "/data/settings/kept.txt", "/data/settings/unsafe.txt", "/data/settings/kiosk.toml"
LIBRARY = "/var/lib/frustumscreen/library"
REPORT = "/run/frustumscreen-import/report.json"
GOOD_S, UPDATE_S, IMPORT_S = 600.0, 900.0, 240.0


class Lent:
    """A tracker, sockets and a folder for one start; `with Lent(...) as pc`. `image`: the disk before the start."""

    def __init__(self, image, folder, make=Appliance):
        self.folder = folder
        folder.mkdir(parents=True, exist_ok=True)
        self.sockets = pathlib.Path(tempfile.mkdtemp(prefix="cuts-"))
        self._tracker = tracker(self.sockets, folder)
        self.pc = make(image, folder, self.sockets, {"tracker": self._tracker.usb})

    def __enter__(self):
        return self.pc

    def __exit__(self, *_):
        Patience.clock = time.monotonic
        if getattr(self.pc, "_process", None):
            self.pc.stop()
        self._tracker.stop()
        shutil.rmtree(self.sockets)
        (self.folder / "disk.raw").unlink()


class Recorded(Appliance):
    """A RecordedDisk serves the disk; `folder` gets start.raw, the disk before the start, and writes.log."""

    def __init__(self, image, folder, sockets, usb):
        super().__init__(image, folder, sockets, usb)
        self.disk_file = self.disk
        sparse_copy(self.disk, folder / "start.raw")
        self.recorded = RecordedDisk(sockets / "disk", self.disk, folder / "writes.log")
        self.disk = f"nbd:unix:{sockets}/disk"

    def stop(self):
        super().stop()
        self.recorded.stop()


class Session:
    """One recorded run through everything that a kiosk keeps. Each mark in the log is a JSON object. `phase` names the phase that begins;
    `begun` names a value that may be on the disk from then on, `kept` one that must be there."""

    def __init__(self, pc, work, tools, bundle, say):
        self.pc, self.work, self.tools, self.bundle, self._say = pc, work, tools, bundle, say
        self._number = self._sets = 0

    def mark(self, **what):
        self.pc.recorded.mark(json.dumps(what))
        self._say(f"{self.pc.recorded.records:7} writes: {what}")

    def start(self):
        self.pc.start()
        self.pc.may_start_anew()
        Patience.clock = self.pc.granted_s

    def wait_until_good(self):
        self.pc.wait_until_lit()
        self._say("lit")
        eventually(lambda: self.pc.run("systemctl is-active systemd-bless-boot").output.strip() == "active", GOOD_S,
                   "the start is never marked as good")

    def first_start(self):
        self.mark(phase="first start")
        self.start()
        self.mark(kept="machine-id", value=self.pc.check("cat /etc/machine-id").strip())
        self.wait_until_good()
        eventually(lambda: "inactive" in self.pc.run("systemctl is-active frustumscreen-grow").output, 120.0, "it grows for ever")
        self.mark(kept="grown", value=int(self.pc.check("stat -f -c %b /data")))

    def write_safely(self, path, text):
        """Writes a file as programs should: syncs the bytes, renames the file, syncs the folder."""
        self.pc.write("/tmp/new", text)
        self.pc.check(f"cp /tmp/new {path}.new && sync {path}.new && mv {path}.new {path} && sync $(dirname {path})")

    def save(self, rounds):
        self.mark(phase="save")
        settings = self.pc.check(f"cat {SETTINGS}")
        key = self.tools.public_key()
        settings += f'\n[[exhibit.keys]]\nname = "Museum"\npublic_key = "{key}"\nuntil = "2099-12-31"\n'
        for _ in range(rounds):
            self._number += 1
            number = self._number
            for what, path, text in (("settings", SETTINGS, settings + f"# saved {number}\n"), ("kept", KEPT, kept_text(number))):
                self.mark(begun=what, value=number)
                self.write_safely(path, text)
                self.mark(kept=what, value=number)
            # The control: a file written in place, without a sync. The harness must find that cuts lose it.
            self.mark(begun="unsafe", value=number)
            self.pc.write(UNSAFE, kept_text(number))
            self.mark(kept="unsafe", value=number)
            self.pc.run("kill -9 $(systemctl show -P MainPID frustumscreen)")  # the watchdog records this in its faults
            time.sleep(12.0)
        self.pc.wait_until_lit()

    def stick(self, name, files, size_mib):
        image = sticks.file_system(self.work / f"{name}.img", "vfat", files, size_mib, name.upper())
        self.pc.plug(name, image)
        return image

    def told(self, of_update, timeout_s):
        def over():
            try:
                report = json.loads(self.pc.read(REPORT) or "{}")
            except ValueError:
                return None
            right = report.get("import_id", "").startswith("update-") == of_update
            return report if right and report.get("stage") == "done" else None

        return eventually(over, timeout_s, lambda: f"nothing is told of the stick, at last {self.pc.read(REPORT)}")

    def take_packs(self, name, packs):
        """Imports a stick with `packs` (name -> file), which gives the next set."""
        self.mark(phase="import")
        self._sets += 1
        self.mark(begun="set", value=self._sets)
        self.pc.run(f"rm -f {REPORT}")
        self.stick(name, packs, 40)
        report = self.told(False, IMPORT_S)
        outcomes = [pack["outcome"] for pack in report["packs"]]
        self.mark(kept="set", value=report["set_number"], outcomes=outcomes)
        assert outcomes.count("taken") > 0, report
        time.sleep(5.0)  # until the exhibit has written its verdict on the new set
        self.pc.pull(name)

    def run_on(self, seconds):
        self.mark(phase="running")
        time.sleep(seconds)

    def update(self):
        self.mark(phase="update")
        self.pc.run(f"rm -f {REPORT}")
        self.mark(begun="version", value=NEXT)
        self.stick("update", {f"frustumscreen-{NEXT}.raucb": self.bundle}, 320)
        pack, = self.told(True, UPDATE_S)["packs"]
        self.mark(kept="version", value=NEXT, outcome=pack)
        assert pack["outcome"] == "taken", pack
        assert self.pc.resets_within(300.0), "the machine does not start again"

    def start_again(self):
        self.mark(phase="start")
        self.pc.wait_for_start()
        self.wait_until_good()
        time.sleep(30.0)
        self.mark(phase="end")


class Tools:
    """The programs of the host that make packs and read libraries. `programs`: their folder; `packs`: the folder of baked packs."""

    def __init__(self, programs, packs, work):
        self.programs, self._packs, self._work = programs, packs, work
        work.mkdir(parents=True, exist_ok=True)
        self._key = work / "museum"

    def run(self, name, *words):
        return subprocess.run([self.programs / f"frustumscreen-{name}", *map(os.fspath, words)], capture_output=True, text=True, check=False)

    def public_key(self):
        if not self._key.with_suffix(".key").exists():
            assert self.run("pack", "keygen", "-o", self._key).returncode == 0
        return self._key.with_suffix(".pub").read_text(encoding="utf-8").splitlines()[1]

    def signed(self, artifact, serial):
        self.public_key()
        pack = self._work / f"{artifact}-{serial}.fspack"
        shutil.copyfile(self._packs / f"{artifact}.fspack", pack)
        done = self.run("pack", "sign", pack, "--key", self._key.with_suffix(".key"), "--serial", str(serial))
        assert done.returncode == 0, done.stderr
        return pack
