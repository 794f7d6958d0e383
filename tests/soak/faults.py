"""The faults of a soak: each is injected into the kiosk and removed again; and the watchdog's steps that each may cause.

Threads  one caller, that of the kiosk.
"""

import json
import pathlib
import random
import subprocess
import sys
import time
from dataclasses import dataclass

from kiosk import CONNECTOR, EXHIBIT, HERE, SETTINGS

sys.path.insert(0, str(HERE.parent / "import"))
import sticks  # noqa: E402  from tests/hil, by kiosk
import plain_pack  # noqa: E402

REPORT = "/run/frustumscreen-import/report.json"
BACK_S, IMPORT_S = 60.0, 120.0


@dataclass
class Done:
    """A fault that was injected. `came_back`: the kiosk recovered in time."""

    kind: str
    begin_s: float
    end_s: float
    begin_uptime_s: float
    end_uptime_s: float
    came_back: bool


class Faults:
    """`packs`: a `Packs`, which makes signed and unsigned packs."""

    def __init__(self, kiosk, packs, seed):
        self.kiosk, self.packs, self.random = kiosk, packs, random.Random(seed)
        self._sticks = 0

    def do(self, kind):
        kiosk = self.kiosk
        begin_s, begin_uptime_s = kiosk.now_s(), kiosk.uptime_s()
        came_back = getattr(self, f"_{kind}")()
        came_back = kiosk.until(kiosk.is_lit, BACK_S) and came_back
        kiosk.count(f"fault: {kind}")
        return Done(kind, begin_s, kiosk.now_s(), begin_uptime_s, kiosk.uptime_s(), came_back)

    def _says(self, key, words, timeout_s=BACK_S):
        return self.kiosk.until(lambda: words in str(self.kiosk.status().get(key)), timeout_s)

    def _tracker_unplugged(self):
        self.kiosk.tracker.tell("unplug", "2s")
        told = self._says("tracker", "no tracker")
        self.kiosk.rest(2.0)
        self.kiosk.count("replugs of the tracker")
        return self._says("tracker", "is running") and told

    def _tracker_hangs(self):
        self.kiosk.tracker.tell("hang", f"{self.random.uniform(2.0, 6.0):.1f}s")
        told = self._says("tracker", "stopped sending")
        return self._says("tracker", "is running") and told

    def _tracker_hangs_until_reset(self):
        self.kiosk.tracker.tell("hang-until-reset")
        told = self._says("tracker_hangs", "True")
        return self._says("tracker", "is running", 2 * BACK_S) and told

    def _tracker_noise(self):
        for what in ("drop 0.1", "corrupt 0.05", "duplicate 0.1", "reorder 0.1"):
            self.kiosk.tracker.tell(*what.split(), "5s")
        self.kiosk.rest(6.0)
        return self._says("tracker", "is running")

    def _panel_unplugged(self):
        self.kiosk.buttons.tell("unplug", "2s")
        told = self._says("panel", "not there")
        self.kiosk.rest(2.0)
        self.kiosk.count("replugs of the buttons")
        return self._says("panel", "buttons are there") and told

    def _button_bounces(self):
        self.kiosk.buttons.tell("bounce", 1)
        self.kiosk.rest(1.0)
        return self._says("panel", "buttons are there")

    def _projector_unplugged(self):
        self.kiosk.machine.check(f"echo off > {CONNECTOR}")
        self.kiosk.rest(self.random.uniform(2.0, 4.0))
        self.kiosk.machine.check(f"echo detect > {CONNECTOR}")
        self.kiosk.count("replugs of the projector")
        return self._says("display", "is lit")

    def _killed(self):
        process = self.kiosk.process_of(EXHIBIT)
        self.kiosk.machine.check(f"kill -KILL {process}")
        return self.kiosk.until(lambda: self.kiosk.process_of(EXHIBIT) not in (0, process) and self.kiosk.is_lit(), BACK_S)

    def _disk_full(self):
        """Fills the partition with few written blocks: fallocate leaves 4 MiB, and a second writer fills these until no space is left."""
        machine = self.kiosk.machine
        free = "df -k /data | awk 'NR == 2 { print $4 }'"
        machine.check(f"fallocate -l $((($({free}) - 4096) * 1024)) /data/full; head -c 6291456 /dev/zero > /data/rest || true")
        is_full = int(machine.check(free)) == 0
        self.kiosk.rest(5.0)
        machine.check("rm -f /data/full /data/rest; sync")
        return is_full

    def _clock_leaps(self):
        leap = self.random.choice(("1 year", "-2 years"))
        before = time.monotonic()
        now = int(self.kiosk.machine.check("date +%s"))
        self.kiosk.machine.check(f"date -s @$(($(date +%s) {'+ 31536000' if leap[0] != '-' else '- 63072000'}))")
        self.kiosk.rest(4.0)
        self.kiosk.machine.check(f"date -s @{now + int(time.monotonic() - before)}")
        return True

    # Sticks.

    def _outcome(self, name, image, pull_at=None):
        """Puts a stick in, and takes it out when its import has ended or reaches the stage `pull_at`; returns the last report."""
        kiosk, seen = self.kiosk, [{}]
        before = kiosk.machine.read(REPORT) or ""

        def told(*stages):
            text = kiosk.machine.read(REPORT) or ""
            try:
                seen[0] = json.loads(text) if text else {}
            except ValueError:
                return False
            return text != before and seen[0].get("stage") in stages

        kiosk.machine.plug(name, image, **({"bytes_per_s": 1 << 20} if pull_at else {}))
        if pull_at:
            kiosk.until(lambda: told(pull_at), IMPORT_S)
            kiosk.rest(0.5)
            kiosk.machine.pull(name)
        kiosk.until(lambda: told("done", "failed"), IMPORT_S)
        if not pull_at:
            kiosk.machine.pull(name)
        kiosk.count("sticks")
        return seen[0]

    def _stick(self, pack, **options):
        self._sticks += 1
        image = self.packs.stick(self._sticks, pack)
        try:
            return self._outcome(f"stick-{self._sticks}", image, **options)
        finally:
            image.unlink()

    def _stick_good(self):
        before = (self.kiosk.status().get("set") or {}).get("number")
        report = self._stick(self.packs.good(self._sticks + 1))
        shown = self.kiosk.until(lambda: (self.kiosk.status().get("set") or {}).get("number") not in (None, before), BACK_S)
        self.kiosk.count("sets switched", 1 if shown else 0)
        return shown and report.get("stage") == "done"

    def _stick_unsigned(self):
        report = self._stick(self.packs.unsigned)
        return any(pack["outcome"] == "refused" for pack in report.get("packs", []))

    def _stick_pulled(self):
        self._stick(self.packs.large(self._sticks + 1), pull_at="copying")
        return True


KINDS = [name[1:] for name in vars(Faults) if name.startswith("_") and name.strip("_") in (
    "tracker_unplugged", "tracker_hangs", "tracker_hangs_until_reset", "tracker_noise", "panel_unplugged", "button_bounces",
    "projector_unplugged", "killed", "disk_full", "clock_leaps", "stick_good", "stick_unsigned", "stick_pulled")]
# The time after a fault until the recovery ladder begins at its first step again: ten minutes without a fault (app/watch/ladder.h), and as
# many again because other faults may come between.
RESTS_S = {"tracker_hangs_until_reset": 1200.0}
# Fault -> causes of the watchdog's steps that are no false alarms after it.
MAY_CAUSE = {"tracker_hangs_until_reset": {"device_silent"}, "killed": {"keeps_ending"}}
ENDS_EXHIBIT = {"killed"}


class Packs:
    """Makes packs that are signed with a key that the kiosk knows, and an unsigned one."""

    def __init__(self, program, built_in, folder):
        self.folder, self._program = folder, program
        folder.mkdir(parents=True)
        self._key = folder / "museum"
        self._run("keygen", "-o", self._key)
        self.unsigned = folder / "unsigned.fspack"
        self.unsigned.write_bytes(pathlib.Path(built_in).read_bytes())

    def _run(self, *words):
        subprocess.run([self._program, *(str(word) for word in words)], check=True, capture_output=True)

    def settings(self):
        """The settings that a kiosk needs to accept the signed packs."""
        public = self._key.with_suffix(".pub").read_text(encoding="utf-8").splitlines()[1]
        return f'\n[[exhibit.keys]]\nname = "Museum"\npublic_key = "{public}"\nuntil = "2099-12-31"\n'

    def _signed(self, path, serial):
        self._run("sign", path, "--key", self._key.with_suffix(".key"), "--serial", serial)
        return path

    def good(self, serial):
        path = self.folder / "good.fspack"
        path.write_bytes(self.unsigned.read_bytes())
        return self._signed(path, serial)

    def large(self, serial):
        """A pack that takes some seconds to copy."""
        path = self.folder / "large.fspack"
        description = plain_pack.manifest()
        description["sections"]["noise"] = {"parts": ["noise.bin"], "data": {}}
        path.write_bytes(plain_pack.pack(description=description,
                                         files={**plain_pack.parts(), "noise.bin": random.Random(serial).randbytes(8 << 20)}))
        return self._signed(path, serial)

    def stick(self, number, pack):
        kind = sticks.KINDS[number % len(sticks.KINDS)]
        return sticks.file_system(self.folder / f"stick-{number}.img", kind, {pack.name: pack})


def with_keys(machine, packs):
    """Adds the museum's key to the kiosk's settings; only the importer reads it, so the exhibit need not be restarted."""
    machine.write(SETTINGS, machine.read(SETTINGS) + packs.settings())
