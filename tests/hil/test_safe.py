"""Tests the safe picture: it takes the screen from the exhibit, follows the projector and its reason, and gives the screen back."""

import pathlib
import subprocess
import tempfile

import screen
from bench import CONNECTOR, HEIGHT, UNIT, WIDTH, eventually
from hil_test import START_S, HilTest, LIT, long

SAFE = "frustumscreen-safe.service"
REASON = "/run/frustumscreen-watchdog/reason"
ALIVE = "/run/frustumscreen-safe/alive"
SHOWN_S = 15.0
ASKED_S = 25.0  # it asks the projector for its modes every ten seconds
WATCHDOG_S = 40.0  # WatchdogSec= and a start on a slow processor
MAX_KIB = 16 * 1024
FIRST, SECOND = "The exhibit ended five times: größer – “as a test”.", "The disk is full."


class Safe(HilTest):
    def setUp(self):
        super().setUp()
        self.addCleanup(self.bench.machine.run, f"rm -f {REASON}; echo detect > {CONNECTOR}; systemctl start --no-block {UNIT}")
        # The watchdog would bring the exhibit back. It starts again together with the exhibit.
        self.bench.machine.check("systemctl stop frustumscreen-watchdog.service")
        self.bench.machine.check(f"mkdir -p {REASON.rsplit('/', 1)[0]}")
        self.bench.machine.write(REASON, FIRST)
        self.bench.machine.check(f"systemctl start {SAFE}")

    def drawn(self, reason, width=WIDTH, height=HEIGHT):
        """The picture that the program draws on this machine, without the last line, which has the computer's uptime."""
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "reason").write_text(reason, encoding="utf-8")
            subprocess.run([self.bench.program.parent / "frustumscreen-safe", "--png", f"{folder}/safe.png",
                            "--size", f"{width}x{height}", "--reason", f"{folder}/reason"], check=True)
            picture = screen.read_png(f"{folder}/safe.png")
        rows = screen.lit(picture)
        last = max(y for y, row in enumerate(rows) if row)
        while rows[last]:
            last -= 1
        return picture.rgb[3 * width : 3 * width * last]

    def assert_shown(self, reason, width=WIDTH, height=HEIGHT, within_s=SHOWN_S):
        meant = self.drawn(reason, width, height)

        def shown():
            picture = self.bench.screendump()
            begin = 3 * width  # the first row has the code
            return (picture.width, picture.height) == (width, height) and picture.rgb[begin : begin + len(meant)] == meant

        eventually(shown, within_s, "its words are not on the screen as the program draws them")
        first = screen.safe_probe(self.bench.screendump())
        self.assertIsNotNone(first, "the corner has not the safe picture's code")
        eventually(lambda: screen.safe_probe(self.bench.screendump()) not in (None, first), SHOWN_S, "its code stands")

    def alive(self):
        """The number of pictures that it reports as shown."""
        text = self.bench.machine.read(ALIVE)
        return int(text.split()[0]) if text else 0

    def says(self, words, within_s=SHOWN_S):
        shown = f"systemctl show --value -p StatusText {SAFE}"
        eventually(lambda: words in self.bench.machine.run(shown).output, within_s, f"it does not say '{words}'")

    def process(self):
        return int(self.bench.machine.check(f"systemctl show --value -p MainPID {SAFE}"))

    def test_words_projector_and_back_to_the_exhibit(self):
        machine = self.bench.machine
        self.assertNotEqual(machine.run(f"systemctl is-active {UNIT}").output.strip(), "active")
        self.assert_shown(FIRST)
        process = self.process()
        machine.write(REASON, SECOND)
        self.assert_shown(SECOND)

        machine.check(f"echo off > {CONNECTOR}")
        self.says("no projector is connected")
        before = self.alive()
        self.assertGreater(before, 0)
        machine.check(f"echo detect > {CONNECTOR}")
        self.says("is lit")
        self.assert_shown(SECOND)
        eventually(lambda: self.alive() > before, SHOWN_S, "it does not tell of its pictures")
        self.assertEqual(self.process(), process, "it was restarted")
        peak_kib = int(machine.check(f"sed -n 's/^VmHWM:[^0-9]*\\([0-9]*\\).*/\\1/p' /proc/{process}/status"))
        print(f"  at most {peak_kib} KiB resident", flush=True)
        self.assertLessEqual(peak_kib, MAX_KIB)

        machine.check(f"systemctl start --no-block {UNIT}")
        self.bench.status_says("display", LIT, START_S)
        self.assertNotEqual(machine.run(f"systemctl is-active {SAFE}").output.strip(), "active")
        self.bench.picture_of((0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0), timeout_s=START_S)

    @long
    def test_stopped(self):
        self.assert_shown(FIRST)
        process = self.process()
        self.bench.machine.check(f"kill -STOP {process}")
        eventually(lambda: self.process() not in (0, process), WATCHDOG_S, "systemd does not restart it")
        self.assert_shown(FIRST)

    @long
    def test_projector_at_another_card_and_its_modes(self):
        machine = self.bench.machine
        self.assert_shown(FIRST)
        viewer = self.bench.second_viewer()
        self.addCleanup(setattr, self.bench, "looked_at", "screen")
        self.addCleanup(machine.run, f"systemctl stop {SAFE}; modprobe -r virtio_gpu")
        self.addCleanup(viewer.close)
        machine.check(f"echo off > {CONNECTOR}; modprobe virtio_gpu")
        self.bench.looked_at = "second"
        self.assert_shown(FIRST)
        process = self.process()
        for width, height in ((800, 600), (600, 800), (WIDTH, HEIGHT)):
            viewer.resize(width, height)
            self.assert_shown(FIRST, width, height, ASKED_S)
        viewer.resize(0, 0)
        self.says("no projector is connected", ASKED_S)
        viewer.resize(WIDTH, HEIGHT)
        self.assert_shown(FIRST)
        self.assertEqual(self.process(), process, "it was restarted")
