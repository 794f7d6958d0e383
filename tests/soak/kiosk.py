"""The soak's kiosk: the product image in the emulated PC with a tracker, buttons and sticks, observed all the time.

Time     seconds that the host granted the guest since the soak began (tests/hil/machine.py), unless a comment says otherwise.
Threads  one caller. Wait only by `rest` or `until`: they check the screen four times a second, and take a sample of memory, disk and
         programs every few seconds.
Errors   MachineError: the machine itself fails. Faults of the exhibit raise nothing; they are counted.
"""

import json
import pathlib
import re
import subprocess
import sys
import time
from dataclasses import dataclass, field

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "image_build"))
from direct import Direct  # noqa: E402

import screen  # noqa: E402  from tests/hil, by appliance
from bench import Mock  # noqa: E402
from machine import MachineError  # noqa: E402

EXHIBIT, WATCHDOG = "frustumscreen.service", "frustumscreen-watchdog.service"
CONNECTOR = "/sys/class/drm/card0-Virtual-1/status"
SETTINGS = "/etc/frustumscreen/kiosk.toml"
LOOK_S, SAMPLE_S = 0.25, 5.0
LIT_PIXELS = 300
STANDS_S = 3.0  # even the picture of a resting exhibit changes its code every second; one that keeps it longer is not live


@dataclass
class Sample:
    """One sample of memory, disk and programs. Memory in MiB; counts since the machine started."""

    at_s: float
    uptime_s: float  # the guest's own
    system_mib: float  # MemTotal - MemAvailable
    exhibit_mib: float = None  # its process's own memory and its share of common pages (PSS); None: no process runs
    watchdog_mib: float = None
    exhibit_pid: int = 0
    watchdog_pid: int = 0
    tmpfs_mib: float = 0.0  # Shmem
    written_bytes: int = 0  # to the data partition
    writes: int = 0
    frames: int = 0  # of this process
    drawn: int = 0
    packets: int = 0
    exhibit_own_mib: float = None  # the part of exhibit_mib that is not pages of files; a leak shows here


@dataclass
class Log:
    """The samples and events of a soak."""

    samples: list = field(default_factory=list)
    looks: list = field(default_factory=list)  # (at_s, lit)
    steps: list = field(default_factory=list)  # the watchdog's, from its status
    events: dict = field(default_factory=dict)  # name -> count


class Kiosk:
    def __init__(self, image, out, sockets, poses):
        self.out, self.log = out, Log()
        self.tracker = Mock("mock_tracker", "tracker", sockets, out, "--poses", poses, "--loop")
        self.buttons = Mock("mock_buttons", "buttons", sockets, out)
        self.machine = Direct(image, out, sockets, {"tracker": self.tracker.usb, "buttons": self.buttons.usb})
        self._picture = sockets / "screen.ppm"
        self._begun_s = self._looked_s = self._sampled_s = 0.0
        self._code, self._code_since_s = None, 0.0
        self._data = None

    def start(self, lit_s):
        self.machine.start()
        deadline = self.machine.granted_s() + lit_s
        while not self.is_lit():
            if self.machine.granted_s() > deadline:
                raise MachineError(f"the exhibit is not lit within {lit_s:.0f} s")
            time.sleep(0.5)
        device = self.machine.check("sed -n 's#^/dev/\\([^ ]*\\) /data .*#\\1#p' /proc/mounts").split()[0]
        self._data = f"/sys/class/block/{device}/stat"

    def begin(self):
        """Starts the measurement."""
        self.log = Log()
        self._begun_s = self.machine.granted_s()
        self._looked_s, self._sampled_s = -LOOK_S, -SAMPLE_S
        self._code, self._code_since_s = None, 0.0
        self.look()

    def stop(self):
        self.machine.stop()
        self.machine.disk.unlink()
        self.tracker.stop()
        self.buttons.stop()

    def now_s(self):
        return self.machine.granted_s() - self._begun_s

    def count(self, event, times=1):
        self.log.events[event] = self.log.events.get(event, 0) + times

    # Waiting.

    def look(self):
        """Looks at the screen, and samples memory and disk when they are due."""
        now = self.now_s()
        if now - self._looked_s >= LOOK_S:
            self._looked_s = now
            self.log.looks.append((now, self.is_lit()))
        if now - self._sampled_s >= SAMPLE_S:
            self._sampled_s = now
            sample = self.sample()
            if sample:
                self.log.samples.append(sample)
        time.sleep(0.05)

    def rest(self, seconds):
        end = self.now_s() + seconds
        while self.now_s() < end:
            self.look()

    def until(self, condition, timeout_s):
        """True if the condition became true within this time."""
        end = self.now_s() + timeout_s
        while self.now_s() < end:
            if condition():
                return True
            self.look()
        return False

    # Looking.

    def is_lit(self):
        """True if the picture is live (its code changes) and enough of it is lit."""
        self.machine.screendump(self._picture)
        picture = screen.read_ppm(self._picture)
        code, now = screen.probe(picture), self.now_s()
        if code != self._code:
            self._code, self._code_since_s = code, now
        return code is not None and now - self._code_since_s < STANDS_S and screen.count(screen.lit(picture)) >= LIT_PIXELS

    def status(self):
        try:
            return json.loads(self.machine.read("/run/frustumscreen/status.json") or "null") or {}
        except ValueError:
            return {}

    def process_of(self, unit):
        words = (self.machine.read(f"/sys/fs/cgroup/system.slice/{unit}/cgroup.procs") or "").split()
        return int(words[0]) if words else 0

    def _memory(self, pid):
        """(PSS, its part that is not pages of files), MiB"""
        rows = dict(re.findall(r"^(\w+):\s+(\d+) kB", self.machine.read(f"/proc/{pid}/smaps_rollup") or "", re.M)) if pid else {}
        return (int(rows["Pss"]) / 1024, int(rows["Pss_Anon"]) / 1024) if rows else (None, None)

    def sample(self):
        machine, at_s = self.machine, self.now_s()
        memory = dict(re.findall(r"^(\w+):\s+(\d+)", machine.read("/proc/meminfo") or "", re.M))
        uptime = (machine.read("/proc/uptime") or "").split()
        if not memory or not uptime:
            return None
        disk = [int(word) for word in (machine.read(self._data) or "").split()] or [0] * 11
        exhibit, watchdog, status = self.process_of(EXHIBIT), self.process_of(WATCHDOG), self.status()
        try:
            steps = json.loads(machine.read("/run/frustumscreen-watchdog/status.json") or "{}").get("faults", [])
        except ValueError:
            steps = []
        for step in steps:
            key = {name: step[name] for name in ("awake_s", "cause", "step")}
            if key not in self.log.steps:
                self.log.steps.append(key)
        whole, own = self._memory(exhibit)
        return Sample(
            at_s, float(uptime[0]), (int(memory["MemTotal"]) - int(memory["MemAvailable"])) / 1024, whole,
            self._memory(watchdog)[0], exhibit, watchdog, int(memory["Shmem"]) / 1024, 512 * disk[6], disk[4],
            status.get("frames", 0), status.get("drawn", 0), (status.get("tracker_counts") or {}).get("frames", 0), own)

    def ends(self):
        """Each end of the exhibit's process: (uptime in seconds, result)."""
        lines = (self.machine.read("/run/frustumscreen/ends") or "").splitlines()
        return [(float(line.split()[0]), " ".join(line.split()[1:])) for line in lines if line.split()]

    def uptime_s(self):
        return float(self.machine.read("/proc/uptime").split()[0])


def walk(program, settings, seed, seconds, path):
    """A visitor's walk as a pose file."""
    subprocess.run([program, "simulate", "--config", settings, "--seed", str(seed), "--seconds", str(seconds), "-o", path], check=True,
                   stdout=subprocess.DEVNULL)
    return path
