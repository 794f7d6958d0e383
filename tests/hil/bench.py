"""The test bench: the emulated kiosk, the mocked devices at its USB ports, and the functions that tests call.

Frame    poses: table; pixels: the picture, the top left pixel's centre at (0.5, 0.5).
Time     time-outs: seconds that the host granted the guest (Machine.granted_s), multiplied by how slow the guest is.
Threads  one caller.
"""

import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

import image
import screen
from machine import Machine, MachineError
from mocks import control
from vnc_viewer import VncViewer

HERE = pathlib.Path(__file__).resolve().parent
CONFIG = image.SETTINGS
USUAL = CONFIG.read_text(encoding="utf-8")
WIDTH, HEIGHT = 640, 400  # as in CONFIG
SETTINGS = "/etc/frustumscreen/kiosk.toml"  # in the guest
STATUS_FILE = "/run/frustumscreen/status.json"
UNIT = "frustumscreen.service"
CONNECTOR = "/sys/class/drm/card0-Virtual-1/status"  # takes the words off (unplugged) and detect (the real state)
# Instead of the prop on the table, a cube in the hand.
PACKS = '["/var/lib/frustumscreen/packs/amphora.fspack", "/var/lib/frustumscreen/packs/nautilus-cup.fspack"]'
CUBE_ARTIFACT = "amphora-cube"
CUBE = '\n[prop]\nkind = "cube"\nbase_m = 0.12\nzone = "hand"\n'
UPRIGHT = (1.0, 0.0, 0.0, 0.0)
EYE_M = (0.0, -0.55, 0.50)
PLACE_TOLERANCE_M = 0.0005  # presented poses are filtered, and come to rest within this distance of those that were sent
TURN_TOLERANCE = math.radians(0.2)
OTHER_TRACKERS = ("patriot", "hid")  # besides the VIPER that most tests use; unplugged until a test needs them
MAX_RESTS = 4  # pauses of 50 ms between two evaluations of a condition
RELEASED_S = 1.0  # after which the exhibit has noticed that a button was released
RELEASED_READS = 32  # of the pins; as RELEASED_S, if the host stands still meanwhile


class Mock:
    """A mocked USB device: a separate program that takes commands through a socket."""

    def __init__(self, program, name, sockets, logs, *options):
        self.usb = sockets / name
        self._control = sockets / f"{name}.control"
        with open(logs / f"{name}.log", "w", encoding="utf-8") as log:
            self.process = subprocess.Popen(
                [HERE / program, "--usbredir", self.usb, "--control", self._control, *options],
                stdin=subprocess.DEVNULL, stdout=log, stderr=log, start_new_session=True)
        eventually(lambda: self.usb.exists() and self._control.exists(), 60.0, f"{program} does not start")

    def tell(self, *words):
        answer = control.tell(str(self._control), " ".join(str(word) for word in words), timeout_s=60.0)
        if not answer["ok"]:
            raise ValueError(answer["error"])
        return answer

    def stop(self):
        self.process.terminate()
        self.process.wait(60.0)


class Patience:
    """How long tests wait: in time that the host granted the guest, and longer if the guest started slowly."""

    usual_start_s = 30.0
    factor = 1.0
    clock = time.monotonic


def eventually(condition, timeout_s, otherwise):
    """Waits until `condition()` is true and returns its result; after the time-out raises AssertionError with a sentence. The pauses
    between two evaluations grow, because frequent queries took a seventh of the machine's time. Its clock is still read every 50 ms
    (Machine.given)."""
    timeout_s *= Patience.factor
    deadline = Patience.clock() + timeout_s
    rests = 1
    while True:
        is_last = Patience.clock() > deadline  # what is seen before the host stops is not judged after it
        found = condition()
        if found:
            return found
        if is_last:
            raise AssertionError(f"{otherwise() if callable(otherwise) else otherwise} (after {timeout_s:.0f} s)")
        for _ in range(rests):
            time.sleep(0.05)
            Patience.clock()
        rests = min(rests + 1, MAX_RESTS)


def about(x, y, z, degrees):
    """The quaternion of a rotation about an axis of length 1."""
    half = math.radians(degrees) / 2
    return (math.cos(half), *(math.sin(half) * each for each in (x, y, z)))


def with_cube(settings):
    """The settings for a cube in the hand, with its artifact."""
    return settings.replace(PACKS, f'["/var/lib/frustumscreen/packs/{CUBE_ARTIFACT}.fspack"]') + CUBE


def both_turns(second, first):
    """The quaternion of two rotations, `first` and then `second`."""
    (a, b, c, d), (e, f, g, h) = second, first
    return (a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g, a * g - b * h + c * e + d * f, a * h + b * g - c * f + d * e)


def near(placed, pose, eye_m):
    """Whether the status file's `presented` was drawn for this pose, (x, y, z, qw, qx, qy, qz), and this eye."""
    turned = 2.0 * math.acos(min(1.0, abs(sum(a * b for a, b in zip(placed["prop_wxyz"], pose[3:])))))
    return (math.dist(placed["prop_m"], pose[:3]) < PLACE_TOLERANCE_M and turned < TURN_TOLERANCE
            and math.dist(placed["eye_m"], eye_m) < PLACE_TOLERANCE_M)


class Bench:
    """`files`, `disk`, `packs`: from image.py; `out`: an empty folder for the results."""

    def __init__(self, files, disk, packs, out):
        self.out = out
        self.program = image.BUILD / "bin" / "frustumscreen"
        self.packs = packs
        self._rendered = {}
        self._settings, self._after = USUAL, "true"
        self._sockets = pathlib.Path(tempfile.mkdtemp(prefix="hil-"))
        self._shot = self._sockets / "screen.ppm"
        self.looked_at = "screen"  # or "second"
        self.tracker = Mock("mock_tracker", "tracker", self._sockets, out, "--loop", "--log", out / "poses_sent.csv")
        self.other_trackers = {device: Mock("mock_tracker", device, self._sockets, out, "--device", device,
                                            "--at", "0s unplug") for device in OTHER_TRACKERS}
        self.buttons = Mock("mock_buttons", "buttons", self._sockets, out)
        self.camera = Mock("mock_camera", "camera", self._sockets, out, "--at", "0s unplug")
        self.machine = Machine(files, disk, self._sockets, out, WIDTH, HEIGHT,
                               {mock.usb.name: mock.usb for mock in self._mocks()},
                               device_processes=tuple(mock.process.pid for mock in self._mocks()))

    def _mocks(self):
        return (self.tracker, self.buttons, self.camera, *self.other_trackers.values())

    def start(self):
        """Starts the machine; returns the seconds that this took."""
        begun = time.monotonic()
        self.machine.start()
        Patience.clock = self.machine.granted_s
        Patience.factor = max(1.0, self.machine.granted_s() / Patience.usual_start_s)
        return time.monotonic() - begun

    def stop(self):
        Patience.clock = time.monotonic
        self.machine.stop()
        for mock in self._mocks():
            mock.stop()
        shutil.rmtree(self._sockets)

    def how_to_enter(self):
        return (f"the machine stays up: process {self.machine.pid}; a shell on its serial line:\n"
                f"    {HERE / 'shell'} {self._sockets / 'serial'}\n"
                f"the devices: {HERE / 'mock_tracker'} --tell {self._sockets / 'tracker.control'} help\n"
                f"to end it: kill {self.machine.pid} {' '.join(str(mock.process.pid) for mock in self._mocks())}")

    # The exhibit's settings, status and journal.

    def configure(self, settings, before, after):
        """Restarts the exhibit with these settings, unless it has them. `before`: a command for the guest while the exhibit is stopped;
        `after`: a command for the time when it is stopped to get other settings."""
        if settings == self._settings:
            return
        # Stop, then start: a restart could cut off a handshake with the tracker in the middle.
        self.machine.check(f"systemctl stop {UNIT}; {self._after}")
        self.machine.write(SETTINGS, settings)
        self.machine.check(f"{before}; systemctl start --no-block {UNIT}")
        self._settings, self._after = settings, after

    def status(self):
        """The contents of the status file; None: the file does not exist."""
        text = self.machine.read(STATUS_FILE)
        try:
            return json.loads(text) if text else None
        except ValueError:
            return None

    def uptime_s(self):
        """The guest's clock, which the members `monotonic_ns` of the status files are of."""
        return float(self.machine.read("/proc/uptime").split()[0])

    def status_says(self, key, pattern, timeout_s=20.0, fresh=False):
        """Waits until this member of the status file matches the regular expression; returns the status. `fresh`: ignores a
        status that was written before the call. The file is up to a second old, and the end of the exhibit does not remove it."""
        found = [None]
        since_ns = 1e9 * self.uptime_s() if fresh else 0.0

        def said():
            found[0] = self.status()
            return (found[0] is not None and found[0]["monotonic_ns"] > since_ns
                    and re.search(pattern, str(found[0].get(key))))

        eventually(said, timeout_s, lambda: f"'{key}' never says '{pattern}', at last "
                                            f"'{found[0] and found[0].get(key)}'")
        return found[0]

    def journal(self):
        """The exhibit's output since the machine started."""
        return self.machine.run(f"journalctl -b -o cat --no-pager -u {UNIT}").output

    def main_process(self):
        """The exhibit's process number; 0: it does not run."""
        return int(self.machine.check(f"systemctl show --value -p MainPID {UNIT}"))

    # The screen's picture.

    def screendump(self, head=0):
        """The present picture of the card `looked_at`. `head`: the card's output."""
        self.machine.screendump(self._shot, self.looked_at, head)
        return screen.read_ppm(self._shot)

    def second_viewer(self, head=0):
        """Opens a viewer's window at an output of the second card."""
        return VncViewer(self._sockets / ("second" if head == 0 else f"second-{head}"))

    def probe(self):
        return screen.probe(self.screendump())

    def picture_of(self, pose, eye_m=EYE_M, timeout_s=20.0, after=None):
        """Waits until the exhibit reports that it presented this pose without a fade; returns that picture or a
        later one from the screen. `after`: a picture; what faded in it has ended."""
        return self.picture_where(lambda placed: near(placed, pose, eye_m), pose, timeout_s, after)

    def resting_picture_of(self, pose):
        """Places the prop upright; returns the picture once its filtered pose rests: two pictures, a second apart, are equal. Their codes
        differ, otherwise they are the same picture."""
        self.place(pose[:3])
        seen = [self.picture_of(pose)]

        def rests():
            self.machine.let_run(1.0)
            seen.append(self.picture_of(pose))
            is_new = screen.probe(seen[-1]) != screen.probe(seen[-2])
            return seen[-1] if is_new and screen.count(screen.changed(*seen[-2:], 0)) == 0 else None

        return eventually(rests, 30.0, "the picture does not come to rest")

    def picture_where(self, is_it, what, timeout_s=20.0, after=None):
        """As picture_of, for a presented picture that is_it() accepts."""
        first = screen.probe(after) if after else None
        last = [None]

        def presented():
            last[0] = (self.status() or {}).get("presented")
            found = (last[0] and last[0]["settled"] and last[0]["code"] is not None and is_it(last[0])
                     and (first is None or screen.not_before(last[0]["code"], first)))
            return last[0] if found else None

        code = eventually(presented, timeout_s, lambda: f"no picture is presented of {what}, at last {last[0]}")["code"]

        def shown():
            picture = self.screendump()
            seen = screen.probe(picture)
            return picture if seen is not None and screen.not_before(seen, code) else None

        return eventually(shown, timeout_s, f"picture {code} was presented, but neither it nor a later one is shown")

    def rendered(self, poses, artifact, eye_m=EYE_M):
        """The pictures that `frustumscreen render` draws on this machine for the poses: (x, y, z, qw, qx, qy, qz)."""
        missing = [pose for pose in poses if (pose, artifact, eye_m) not in self._rendered]
        for pose, picture in zip(missing, self.render(missing, artifact, eye_m) if missing else []):
            self._rendered[pose, artifact, eye_m] = picture
        return [self._rendered[pose, artifact, eye_m] for pose in poses]

    def render(self, poses, artifact, eye_m, config=CONFIG, head=UPRIGHT, options=(), torches=None):
        """As `rendered`, with other settings, another rotation of the head and options of `render`; draws each time. `torches`: for each
        pose, the torch's pose."""
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            lines = ["t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok"]
            for number, pose in enumerate(poses):
                for station, placed in ((1, pose), (2, (*eye_m, *head)), *([(3, torches[number])] if torches else [])):
                    lines.append(",".join(str(value) for value in (1000 * number, station, *placed, 1)))
            (folder / "poses.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
            subprocess.run(
                [self.program, "render", "--config", config, "--pack", self.packs / f"{artifact}.fspack",
                 "--poses", folder / "poses.csv", "--out", folder / "out", *(str(option) for option in options)],
                check=True, stdout=subprocess.DEVNULL)
            return [screen.read_png(folder / "out" / f"frame_{number:05}.png") for number in range(len(poses))]

    # The devices.

    def hold(self, buttons, until):
        """Holds buttons until the table reacts, as a person does, because a slow machine notices the buttons late."""
        for button in buttons:
            self.buttons.tell("hold", button)
        try:
            until()
        finally:
            for button in buttons:
                self.buttons.tell("release", button)
        self.machine.let_run(RELEASED_S)

    def press(self, button, reads=RELEASED_READS, duration="300ms"):
        """Presses a button, and waits until the guest has read it as released so many times."""
        self.buttons.tell("press", button, duration)
        eventually(lambda: self.buttons.tell("status")["pins"] >> button & 1, 20.0, f"button {button} stays down")
        until = self.buttons.tell("status")["reads"] + reads
        eventually(lambda: self.buttons.tell("status")["reads"] >= until, 20.0, "nothing reads the buttons")

    def place(self, position_m, rotation=UPRIGHT):
        self.tracker.tell("pose", *position_m, *rotation, 1)

    def place_head(self, position_m=EYE_M):
        self.tracker.tell("pose", *position_m, *UPRIGHT, 2)

    # Evidence.

    def evidence_of(self, test):
        """The folder for the evidence of a failed test."""
        return self.out / test.id().split(".")[-1]

    def keep_evidence(self, folder):
        """Keeps the machine's present pictures and messages in the folder, as far as the machine still answers."""
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
