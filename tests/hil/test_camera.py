"""Tests a camera on USB: the kernel refuses it until the settings have a camera; then `frustumscreen camera` sets it up, reads and judges
it through the kernel's own uvcvideo, and reports each fault in a sentence. No picture leaves that process."""

import json
import re
import time

from bench import SETTINGS, Patience, eventually
from hil_test import HilTest, long

RATE_HZ = 15
CAMERA = f"""
[camera]
kind = "v4l2"
width = 160
height = 120
rate_hz = {RATE_HZ}.0
exposure_ms = 8.0
"""
WELL = "the camera is running"
FAULTS = (  # the mock's fault, words of the report
    ("dark", "sees only darkness"), ("blind", "is blinded"), ("freeze", "the same picture again and again"),
    (f"slow {RATE_HZ / 3:g}", "less than half of its frames"), ("stall", "has stopped sending"),
    ("short-frames", "has stopped sending"), ("garbage-headers", "has stopped sending"))
TOLD_S = 10.0
BACK_S = 2.0  # from the time that the kernel has the camera to good frames
SAID, FOUND = "/run/hil/camera.err", "/run/hil/camera.json"
MAX_WRITTEN = 20_000  # bytes: the report, and a line for each change


class Watching:
    """`frustumscreen camera` in the guest, as the exhibit's user, until `report` ends it."""

    def __init__(self, bench, settings=SETTINGS):
        self._machine = bench.machine
        command = f"exec frustumscreen camera --config {settings} --json --seconds 3600 > {FOUND} 2> {SAID}"
        user = "setpriv --reuid=frustumscreen --regid=frustumscreen --init-groups"
        self._machine.check(f"rm -f {FOUND} {SAID}; ({user} sh -c '{command}' > /dev/null 2>&1 &)")
        eventually(self.process, 20.0, "frustumscreen camera does not start")

    def process(self):
        """The process number of `frustumscreen camera`; None: it does not run."""
        found = self._machine.run("grep -lzx '[c]amera' /proc/[0-9]*/cmdline 2>/dev/null").output.split()  # the only program with this argument
        return int(found[-1].split("/")[2]) if found else None

    def said(self):
        """All states that the exhibit has reported so far."""
        return [line.removeprefix("frustumscreen: ") for line in (self._machine.read(SAID) or "").splitlines()]

    def says(self, words, after=0):
        """Waits until a state after the first `after` ones has these words; returns the number of states then."""
        def heard():
            states = self.said()
            return next((after + k for k, state in enumerate(states[after:], 1) if words in state), None)

        return eventually(heard, TOLD_S, lambda: f"it never says '{words}', at last {self.said()[-3:]}")

    def is_well(self):
        """Waits until the latest state says so: frames are late for a moment when the host withholds its processors."""
        eventually(lambda: self.said()[-1] == WELL, TOLD_S, lambda: f"it is not well, at last {self.said()[-3:]}")

    def report(self):
        """The report at its end."""
        self._machine.check(f"kill {self.process()}")
        eventually(lambda: not self.process(), 10.0, "it does not end")
        return json.loads(self._machine.read(FOUND))


class Camera(HilTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.usual = cls.bench.machine.read(SETTINGS)

    @classmethod
    def tearDownClass(cls):
        cls.bench.camera.tell("unplug")
        cls.bench.machine.write(SETTINGS, cls.usual)
        super().tearDownClass()

    def setUp(self):
        super().setUp()
        self.bench.machine.check("chmod 777 /run/hil")
        self.bench.camera.tell("good")

    def plug(self, settings=CAMERA):
        """Plugs the camera in again after adding these settings; the exhibit keeps running."""
        self.bench.camera.tell("unplug")
        eventually(lambda: not self.is_there(), 20.0, "the kernel keeps a camera that is unplugged")
        self.bench.machine.write(SETTINGS, self.usual + settings)
        self.bench.camera.tell("unplug", "off")

    def is_there(self):
        return self.bench.machine.run("test -e /dev/video0").status == 0

    def connected(self):
        eventually(self.is_there, 30.0, "the kernel has no /dev/video0")

    def test_1_refused_without_settings(self):
        self.plug("")
        refused = ("cd /sys/bus/usb/devices; for d in *-*; do [ ! -e $d/idProduct ] || [ $(cat $d/idVendor):$(cat $d/idProduct) != "
                   "1d6b:0102 ] || cat $d/authorized; done")
        eventually(lambda: self.bench.machine.run(refused).output.strip() == "0", 30.0, "the kernel takes a camera that nobody wants")
        self.bench.machine.check("udevadm settle")  # the kernel authorizes no device before udev has decided
        self.bench.machine.let_run(2.0)
        self.assertFalse(self.is_there())
        self.plug()
        self.connected()

    def test_2_set_up_read_and_judged(self):
        self.plug()
        self.connected()
        watching = Watching(self.bench)
        watching.says(WELL)
        self.bench.machine.let_run(3.0)
        process = watching.process()
        with self.subTest("nothing leaves the process"):
            self.assert_keeps_nothing(process)
        before = self.bench.camera.tell("status")
        watching.is_well()
        report = watching.report()
        self.assertEqual(report["health"], "well")
        self.assertEqual(report["set_up"]["name"].split(":")[0], "Mock Camera")
        self.assertEqual(report["set_up"]["mode"], {"format": "YUYV", "width": 160, "height": 120, "rate_hz": RATE_HZ})
        self.assertEqual([(control["name"], control["lock"], control["value"]) for control in report["set_up"]["controls"]],
                         [("exposure", "locked", 8.0), ("gain", "locked", 32.0), ("white balance", "locked", 4600.0)])
        # Controls that the device received; exposure in tenths of a millisecond, its mode 1 manual
        self.assertEqual([before[key] for key in ("auto_exposure", "exposure", "auto_white_balance")], [1, 80, 0])
        # The ramp's ends and middle show that the bytes were read correctly.
        self.assertAlmostEqual(report["brightness"]["median"], 120, delta=6)
        self.assertLess(report["brightness"]["darkest"], 45)
        self.assertGreater(report["brightness"]["brightest"], 195)
        self.assertEqual(report["counts"]["broken"], 0)
        print(f"  {report['counts']['frames']} frames, {report['rate_hz']:.1f} a second of {RATE_HZ}", flush=True)

    def assert_keeps_nothing(self, process):
        """Checks with the kernel's data: the process has no file open for writing except the camera and the report, no socket and no
        writable shared memory, and it has written no more bytes than a report has."""
        files = self.bench.machine.check(f"cd /proc/{process}/fd; for f in *; do echo $(grep flags ../fdinfo/$f) $(readlink $f); done")
        opened = re.findall(r"flags: (\d+) (.+)", files)
        self.assertTrue(any(path == "/dev/video0" for _, path in opened), f"it has no camera open: {opened}")
        for flags, path in opened:
            if path not in ("/dev/video0", SAID, FOUND):
                self.assertEqual(int(flags, 8) & 3, 0, f"{path} is open for writing")
            self.assertNotIn("socket:", path)
        mapped = self.bench.machine.check(f"grep -E ' .w.s ' /proc/{process}/maps || true")
        self.assertEqual(mapped.strip(), "")
        books = dict(line.split(": ") for line in self.bench.machine.check(f"cat /proc/{process}/io").splitlines())
        self.assertLess(int(books["wchar"]), MAX_WRITTEN)

    @long
    def test_3_faults_are_reported(self):
        self.plug()
        self.connected()
        watching = Watching(self.bench)
        heard = watching.says(WELL)
        for fault, words in FAULTS:
            with self.subTest(fault):
                self.bench.camera.tell(fault)
                heard = watching.says(words, heard)
                self.bench.camera.tell("good")
                heard = watching.says(WELL, heard)
        self.assertEqual(watching.report()["health"], "well")

    @long
    def test_4_unplugged_and_back(self, times=1):
        self.plug()
        self.connected()
        watching = Watching(self.bench)
        heard = watching.says(WELL)
        held_up_s = []  # by a busy host
        for _ in range(times):
            self.bench.camera.tell("unplug")
            heard = watching.says("no camera is connected", heard)
            begun_s, granted_s = time.monotonic(), self.bench.machine.granted_s()
            self.bench.camera.tell("unplug", "off")
            heard = watching.says(WELL, heard)
            held_up_s.append(time.monotonic() - begun_s - (self.bench.machine.granted_s() - granted_s))
        report = watching.report()
        well = [change["at_s"] for change in report["changes"] if change["sentence"] == WELL]
        found = [float(second) for second in re.findall(r"\[ *([\d.]+)\].*Found UVC", self.bench.machine.check("dmesg"))]
        self.assertEqual(len(well), 1 + times)
        took = [at - max(second for second in found if second < at) - held for at, held in zip(well[1:], held_up_s)]
        print(f"  well {max(took):.2f} s after the kernel has the camera", flush=True)
        self.assertLess(max(took), BACK_S * Patience.factor)
        self.assertEqual(report["counts"]["connections"], 1 + times)

    @long
    def test_5_unplugged_ten_times(self):
        self.test_4_unplugged_and_back(10)

    @long
    def test_6_mjpeg_and_a_camera_that_hangs(self):
        self.plug(CAMERA.replace("160", "320").replace("120", "240"))
        self.connected()
        watching = Watching(self.bench)
        heard = watching.says(WELL)
        self.bench.camera.tell("hang", "8s")
        heard = watching.says("has stopped sending", heard)
        watching.says(WELL, heard)
        watching.is_well()
        report = watching.report()
        self.assertEqual(report["health"], "well")
        self.assertEqual([control["lock"] for control in report["set_up"]["controls"]], ["locked", "locked", "locked"])
