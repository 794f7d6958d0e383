"""The test bench: the emulated kiosk, the mocked devices at its USB ports, and what a test asks of them.

Frame    poses are of the table; pixels of the picture, the top left pixel's centre at (0.5, 0.5).
Time     seconds of the host's monotonic clock.
Threads  one caller.
"""

import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

import screen
from machine import Machine, MachineError
from mocks import control
from vnc_viewer import VncViewer

HERE = pathlib.Path(__file__).resolve().parent
CONFIG = HERE / "guest/etc/frustumscreen/kiosk.toml"
WIDTH, HEIGHT = 640, 400  # as in CONFIG
STATUS_FILE = "/run/frustumscreen/status.json"
UNIT = "frustumscreen.service"
CONNECTOR = "/sys/class/drm/card0-Virtual-1/status"  # write off: unplugged; detect: as it is
UPRIGHT = (1.0, 0.0, 0.0, 0.0)
EYE_M = (0.0, -0.55, 0.50)
OTHER_TRACKERS = ("patriot", "hid")  # beside the VIPER that most tests use; unplugged until a test wants them


class Mock:
    """A mocked USB device: a program of its own, told what to do through a socket."""

    def __init__(self, program, name, sockets, logs, *options):
        self.usb = sockets / name
        self._control = sockets / f"{name}.control"
        with open(logs / f"{name}.log", "w", encoding="utf-8") as log:
            self.process = subprocess.Popen(
                [HERE / program, "--usbredir", self.usb, "--control", self._control, *options],
                stdin=subprocess.DEVNULL, stdout=log, stderr=log, start_new_session=True)
        eventually(lambda: self.usb.exists() and self._control.exists(), 10.0, f"{program} does not start")

    def tell(self, *words):
        answer = control.tell(str(self._control), " ".join(str(word) for word in words))
        if not answer["ok"]:
            raise ValueError(answer["error"])
        return answer

    def stop(self):
        self.process.terminate()
        self.process.wait(10.0)


class Patience:
    """How much longer than on an idle machine of two cores everything takes here: from the time of the guest's start."""

    usual_start_s = 30.0
    factor = 1.0


def eventually(condition, timeout_s, otherwise):
    """Waits until `condition()` is true and returns what it returned; else AssertionError with a sentence."""
    timeout_s *= Patience.factor
    deadline = time.monotonic() + timeout_s
    while True:
        found = condition()
        if found:
            return found
        if time.monotonic() > deadline:
            raise AssertionError(f"{otherwise() if callable(otherwise) else otherwise} (after {timeout_s:.0f} s)")
        time.sleep(0.05)


class Bench:
    """`root`, `payload`: from image.py; `build`: where the programs are; `out`: an empty folder for what is found."""

    def __init__(self, root, payload, build, packs, out):
        self.out = out
        self._program = build / "bin" / "frustumscreen"
        self._packs = packs
        self._sockets = pathlib.Path(tempfile.mkdtemp(prefix="hil-"))
        self._shot = self._sockets / "screen.ppm"
        self.looked_at = "screen"  # or "second"
        self.tracker = Mock("mock_tracker", "tracker", self._sockets, out, "--loop", "--log", out / "poses_sent.csv")
        self.other_trackers = {device: Mock("mock_tracker", device, self._sockets, out, "--device", device,
                                            "--at", "0s unplug") for device in OTHER_TRACKERS}
        self.buttons = Mock("mock_buttons", "buttons", self._sockets, out)
        self.machine = Machine(root, payload, self._sockets, out, WIDTH, HEIGHT,
                               {mock.usb.name: mock.usb for mock in self._mocks()})

    def _mocks(self):
        return (self.tracker, self.buttons, *self.other_trackers.values())

    def start(self):
        begun = time.monotonic()
        self.machine.start()
        took_s = time.monotonic() - begun
        Patience.factor = max(1.0, took_s / Patience.usual_start_s)
        return took_s

    def stop(self):
        self.machine.stop()
        for mock in self._mocks():
            mock.stop()
        shutil.rmtree(self._sockets)

    def how_to_enter(self):
        return (f"the machine stays up: process {self.machine.pid}; a shell on its serial line:\n"
                f"    {HERE / 'shell'} {self._sockets / 'serial'}\n"
                f"the devices: {HERE / 'mock_tracker'} --tell {self._sockets / 'tracker.control'} help\n"
                f"to end it: kill {self.machine.pid} {' '.join(str(mock.process.pid) for mock in self._mocks())}")

    # The exhibit's own words.

    def status(self):
        """The status file; None: there is none, or not now."""
        ran = self.machine.run(f"cat {STATUS_FILE}")
        try:
            return json.loads(ran.output) if ran.status == 0 else None
        except ValueError:
            return None

    def status_says(self, key, pattern, timeout_s=20.0):
        """Waits for a sentence in the status file in which this regular expression is found."""
        found = [None]

        def said():
            found[0] = self.status()
            return found[0] is not None and re.search(pattern, str(found[0].get(key)))

        eventually(said, timeout_s, lambda: f"'{key}' never says '{pattern}', at last "
                                            f"'{found[0] and found[0].get(key)}'")
        return found[0]

    def main_process(self):
        """The exhibit's process number; 0: it does not run."""
        return int(self.machine.check(f"systemctl show --value -p MainPID {UNIT}"))

    # What is on the screen.

    def screendump(self):
        self.machine.screendump(self._shot, self.looked_at)
        return screen.read_ppm(self._shot)

    def second_viewer(self):
        return VncViewer(self._sockets / "second")

    def probe(self):
        return screen.probe(self.screendump())

    def steady_picture(self, timeout_s=20.0):
        """The picture once nothing but its probe changes for a second, or what is as long for this machine."""
        last = [screen.lit(self.screendump()), time.monotonic()]
        rest_s = 1.0 * Patience.factor

        def steady():
            picture = self.screendump()
            rows = screen.lit(picture)
            if rows != last[0]:
                last[:] = [rows, time.monotonic()]
            return picture if time.monotonic() - last[1] > rest_s else None

        return eventually(steady, timeout_s, "the picture does not come to rest")

    def rendered(self, poses, artifact, eye_m=EYE_M):
        """What `frustumscreen render` draws on this machine for each of the poses: (x, y, z, qw, qx, qy, qz)."""
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            lines = ["t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok"]
            for number, pose in enumerate(poses):
                for station, placed in ((1, pose), (2, (*eye_m, *UPRIGHT))):
                    lines.append(",".join(str(value) for value in (1000 * number, station, *placed, 1)))
            (folder / "poses.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
            subprocess.run(
                [self._program, "render", "--config", CONFIG, "--pack", self._packs / f"{artifact}.fspack",
                 "--poses", folder / "poses.csv", "--out", folder / "out"], check=True, stdout=subprocess.DEVNULL)
            return [screen.read_png(folder / "out" / f"frame_{number:05}.png") for number in range(len(poses))]

    # The devices.

    def place(self, position_m, rotation=UPRIGHT):
        self.tracker.tell("pose", *position_m, *rotation, 1)

    def place_head(self, position_m=EYE_M):
        self.tracker.tell("pose", *position_m, *UPRIGHT, 2)

    # Evidence.

    def evidence_of(self, test):
        """The folder for what a test that fails has seen."""
        return self.out / test.id().split(".")[-1]

    def keep_evidence(self, folder):
        """What the machine shows and says now, as far as it still answers."""
        shutil.copy(self.out / "serial.log", folder)
        try:
            for number in range(3):
                screen.write_png(folder / f"screen_{number}.png", self.screendump())
                time.sleep(0.3)
            for name, command in (("journal.txt", "journalctl -b -o short-precise --no-pager | grep -v qemu-ga"),
                                  ("service.txt", f"systemctl status --no-pager {UNIT}"),
                                  ("status.json", f"cat {STATUS_FILE}"),
                                  ("dmesg.txt", "dmesg")):
                (folder / name).write_text(self.machine.run(command).output, encoding="utf-8")
            for mock in self._mocks():
                (folder / f"{mock.usb.name}.json").write_text(json.dumps(mock.tell("status"), indent=1), encoding="utf-8")
        except (MachineError, OSError, EOFError) as error:
            print(f"hil: not all evidence could be kept: {error}", file=sys.stderr)
