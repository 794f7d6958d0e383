"""Tests a kiosk's copy: written onto a stick by a signed request or the staff's buttons, and imported into a kiosk without museum data."""

import pathlib
import subprocess
import tomllib

import kept_calibration
from bench import SETTINGS, eventually
from stick_bench import LIBRARY, StickTest, pulled_packs
from test_calibration import FIRST, LAST, NEXT
from test_stick_report import REPORT_S, files_on

REQUEST = "frustumscreen-request.toml"
ASKS = b'what = ["settings", "calibration", "counts", "packs"]\nuntil = "2099-12-31"\n'
COPY = "kiosk.fsk"
DAY = "/var/lib/frustumscreen/counts/2026-01-05.json"
VISITS = ('{"frustumscreen_counts": 1, "day": "2026-01-05", "hours": [{"hour": 10, "visits": 3, "ms": 184000}], '
          '"artifacts": [{"name": "Amphora", "visits": 3, "ms": 184000}], "languages": [{"name": "en", "visits": 3, "ms": 184000}]}\n')
CALIBRATION = f"cat {kept_calibration.FOLDER}/calibration-*.toml"
# The table's sentences need the words file, so tests/exhibit checks them. test_delivery.py checks the state of delivery.
FORGET = f"{kept_calibration.FORGET}; rm -f {DAY} {SETTINGS}.* {LIBRARY}/set.txt; rm -rf {LIBRARY}/packs"
RESTART_S = 90.0
PAGES_TO_COPY = 6  # of the staff's picture, from the first page to the copy's
STAGES = ("found", "copying", "may_take_out", "done", "failed")


class StickCopy(StickTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.bench.machine.check(kept_calibration.KEEP)
        cls.bench.machine.write(DAY, VISITS)
        cls.request = cls.folder / REQUEST
        cls.request.write_bytes(ASKS)
        cls.written = None  # path: bytes of each file of the copy, once there is one

    @classmethod
    def tearDownClass(cls):
        cls.bench.machine.check(FORGET)
        super().tearDownClass()

    @classmethod
    def sign(cls, pack, serial):
        """Signs a file that is not a pack; the signature is a file beside it."""
        super().sign(pack, serial)
        return pack.with_name(pack.name + ".minisig") if pack.suffix != ".fspack" else pack

    def put(self, name, files, timeout_s=REPORT_S):
        """Puts in a stick with these files; returns the report, and the stick's contents afterwards."""
        stick = self.make(name, "vfat", files)
        self.plug(name, stick)
        told = pulled_packs(self.outcome(timeout_s))
        eventually(lambda: not self.mounts(), 30.0, "the stick stays mounted")
        self.pull(name)
        checked = subprocess.run(["fsck.vfat", "-n", stick], check=False, capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stdout)
        return told, files_on(stick)

    def test_1_without_a_signature_nothing_is_given(self):
        told, found = self.put("unsigned", {REQUEST: ASKS, "letter.txt": b"mine\n"})
        self.assertEqual(told, {REQUEST: ("not_written", "unsigned")})
        self.assertEqual(found, {REQUEST: ASKS, "letter.txt": b"mine\n"})

    def test_2_out(self):
        pack = self.signed("nautilus-cup", 1)
        told, _ = self.put("packs", {pack.name: pack})
        self.assertEqual(told, {pack.name: ("taken", "none")})
        own = {REQUEST: ASKS, f"{REQUEST}.minisig": self.sign(self.request, 1).read_bytes(), "letter.txt": b"mine\n"}
        told, found = self.put("asks", own)
        folder = next(name for name, outcome in told.items() if outcome == ("written", "none"))
        self.assertRegex(folder, r"^frustumscreen-[0-9a-f]{6}-\d{4}-\d\d-\d\d-\d{6}$")
        for name, content in own.items():
            self.assertEqual(found.pop(name), content, f"{name} is not as it was")
        self.assertEqual({pathlib.PurePath(name).parent.name for name in found}, {folder})
        type(self).written = {pathlib.PurePath(name).name: content for name, content in found.items()}
        self.assertEqual(set(self.written), {"settings.toml", "calibration.toml", "counts.csv", COPY, "001-nautilus-cup.fspack"})
        self.assertEqual(self.written["settings.toml"].decode(), self.settings + self.keys)
        self.assertIn(b"Amphora", self.written["counts.csv"])
        self.assertEqual(self.written["001-nautilus-cup.fspack"], pack.read_bytes())

    def test_3_out_by_the_staffs_buttons(self):
        self.assertIsNotNone(self.written, "there is no copy")
        own = {REQUEST: b"", "letter.txt": b"mine\n"}
        stick = self.make("waits", "vfat", own)
        self.plug("waits", stick)
        self.assertEqual(pulled_packs(self.outcome()), {REQUEST: ("pending", "unsigned")})
        eventually(lambda: not self.mounts(), 30.0, "the stick stays mounted")
        self.assertEqual(files_on(stick), own, "before the button nothing is written")
        self.bench.hold((FIRST, LAST), lambda: self.bench.status_says("state", "staff"))
        for _ in range(PAGES_TO_COPY):
            self.bench.press(NEXT)
        self.bench.hold((FIRST,), lambda: self.stage(*STAGES, timeout_s=REPORT_S))
        told = pulled_packs(self.outcome(REPORT_S))
        self.bench.hold((FIRST, LAST), lambda: self.bench.status_says("state", "^(?!staff)"))
        eventually(lambda: not self.mounts(), 30.0, "the stick stays mounted")
        self.pull("waits")
        folder = next(name for name, outcome in told.items() if outcome == ("written", "none"))
        self.assertTrue(self.last.endswith(".staff"), self.last)
        self.assertNotIn(REQUEST, told, "it is offered once")
        found = files_on(stick)
        for name, content in own.items():
            self.assertEqual(found.pop(name), content, f"{name} is not as it was")
        self.assertEqual({pathlib.PurePath(name).parent.name for name in found}, {folder})
        written = {pathlib.PurePath(name).name: content for name, content in found.items()}
        self.assertEqual(set(written), set(self.written))
        for name in set(written) - {"settings.toml", "counts.csv", COPY}:  # visits are still counted
            self.assertEqual(written[name], self.written[name], name)
        # Comments are left out.
        self.assertEqual(*(tomllib.loads(files["settings.toml"].decode()) for files in (written, self.written)))

    def test_4_in(self):
        self.assertIsNotNone(self.written, "there is no copy")
        before = self.bench.main_process()
        self.bench.machine.check(FORGET)
        self.bench.machine.write(SETTINGS, self.settings)  # without a key
        copy = self.folder / COPY
        copy.write_bytes(self.written[COPY])
        files = {COPY: copy, f"{COPY}.minisig": self.sign(copy, 2),
                 "old/001-nautilus-cup.fspack": self.written["001-nautilus-cup.fspack"]}
        told, _ = self.put("in", files)
        self.assertEqual(told, {COPY: ("taken", "none"), "001-nautilus-cup.fspack": ("taken", "none")})
        eventually(lambda: self.bench.main_process() not in (before, 0), RESTART_S, "the exhibit is not started again")
        self.assertEqual(self.bench.machine.read(SETTINGS), self.settings + self.keys)
        self.assertIn("places = 9", self.bench.machine.check(CALIBRATION))
        self.assertIn("184000", self.bench.machine.read(DAY))
        self.bench.status_says("display", "is lit", RESTART_S)

    def test_5_in_again(self):
        before = self.bench.main_process()
        copy = self.folder / COPY
        told, _ = self.put("again", {COPY: copy, f"{COPY}.minisig": copy.with_name(f"{COPY}.minisig")})
        self.assertEqual(told, {COPY: ("already_there", "none")})
        told, _ = self.put("naked", {COPY: copy})
        self.assertEqual(told, {COPY: ("refused", "unsigned")})
        self.assertEqual(self.bench.main_process(), before, "the exhibit was started again")
