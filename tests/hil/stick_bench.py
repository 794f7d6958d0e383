"""The common part of tests of sticks: a museum's key, signed packs, sticks that are put in and pulled out, and their reports.

Threads  one caller.
"""

import json
import pathlib
import random
import shutil
import subprocess
import sys

import screen
import sticks
from bench import HERE, SETTINGS, UNIT, UPRIGHT, USUAL, WIDTH, eventually
from hil_test import CENTRE_M, HilTest

sys.path.insert(0, str(HERE.parent / "import"))
import plain_pack  # noqa: E402

LIBRARY = "/var/lib/frustumscreen/library"
REPORT_FILE = "/run/frustumscreen-import/report.json"
IMPORT_S = 60.0  # for a small pack: udev, three starts of services and a copy, on a slow processor
UNITS = "'frustumscreen-import@*' 'frustumscreen-stick@*' 'frustumscreen-ntfs@*' 'frustumscreen-import-refused@*' 'frustumscreen-report@*' 'frustumscreen-report-open@*' 'frustumscreen-report-close@*'"
# Waits until a stick has left no process, mount or unit: first by cheap checks, which almost always suffice, then by systemd.
QUIET = ("udevadm settle; while cat /sys/fs/cgroup/system.slice/system-frustumscreen*.slice/*/cgroup.procs 2>/dev/null | grep -q . "
         "|| grep -q /run/frustumscreen-stick/stick /proc/mounts; do sleep 0.1; done; "
         f"while systemctl list-units --no-legend --plain {UNITS} | grep -q .; do sleep 0.2; done")
# Prints the installed set, and checks that each pack's SHA-256 equals its name, except for a pack that an import removes meanwhile.
LIST = (f"frustumscreen-import --list --into {LIBRARY} --json || exit 1; cd {LIBRARY}/packs 2>/dev/null && ls | grep -q fspack$ || exit 0; "
        'for pack in *.fspack; do sum=$(sha256sum "$pack" 2>&1) && [ "${sum%% *}" = "${pack%.fspack}" ] || [ ! -e "$pack" ] || { echo "$sum"; exit 1; }; done')
QUIET_S = 240.0
LIT_PIXELS = 300
TOLD_PIXELS = 300  # two short lines of words


class StickTest(HilTest):
    """Gives the kiosk a key, and removes the installed packs at the end of a class."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.folder = cls.bench.out / "sticks"
        cls.folder.mkdir(exist_ok=True)
        cls.pack_program = cls.bench.program.with_name("frustumscreen-pack")
        cls.key = cls.folder / "museum"
        if not cls.key.with_suffix(".key").exists():
            subprocess.run([cls.pack_program, "keygen", "-o", cls.key], check=True, capture_output=True)
        public = cls.key.with_suffix(".pub").read_text(encoding="utf-8").splitlines()[1]
        cls.keys = ""
        cls.add_key("Museum", public)

    @classmethod
    def add_key(cls, name, public):
        """Adds a key to the settings. The exhibit need not restart, because only the importer uses the keys."""
        cls.keys += f'\n[[exhibit.keys]]\nname = "{name}"\npublic_key = "{public}"\nuntil = "2099-12-31"\n'
        cls.bench.machine.write(SETTINGS, cls.settings + cls.keys)

    @classmethod
    def tearDownClass(cls):
        cls.clear_library()
        cls.bench.machine.write(SETTINGS, cls.settings)
        shutil.rmtree(cls.folder)

    def setUp(self):
        super().setUp()
        self.put_in = []
        self.last = (self.report() or {}).get("import_id")

    def tearDown(self):
        for name in list(self.put_in):
            self.pull(name)
        eventually(lambda: not self.units(), 60.0, lambda: f"units of a stick stay: {self.units()}")

    @classmethod
    def large(cls, serial, mib):
        """The path of a signed pack, named Vase, whose import takes a while: it has a large part of noise, which no reader knows."""
        pack = cls.folder / f"large-{serial}.fspack"
        description = plain_pack.manifest()
        description["sections"]["noise"] = {"parts": ["noise.bin"], "data": {}}
        files = {**plain_pack.parts(), "noise.bin": random.Random(serial).randbytes(mib << 20)}
        pack.write_bytes(plain_pack.pack(description=description, files=files))
        return cls.sign(pack, serial)

    @classmethod
    def signed(cls, artifact, serial):
        """The path of a signed copy of one of the guest's packs."""
        pack = cls.folder / f"{artifact}-{serial}.fspack"
        shutil.copyfile(cls.bench.packs / f"{artifact}.fspack", pack)
        return cls.sign(pack, serial)

    @classmethod
    def sign(cls, pack, serial):
        subprocess.run([cls.pack_program, "sign", pack, "--key", cls.key.with_suffix(".key"), "--serial", str(serial)], check=True,
                       capture_output=True)
        return pack

    @classmethod
    def clear_library(cls):
        """Resets the library to its state before any import; the exhibit goes on with its artifacts."""
        cls.bench.machine.check(f"rm -rf {LIBRARY}/set.txt {LIBRARY}/packs {LIBRARY}/shown/* {REPORT_FILE}")

    def image(self, name):
        return self.folder / f"{name}.img"

    def plug(self, name, source, **options):
        self.bench.machine.plug(f"stick-{name}", source, **options)
        self.put_in.append(name)

    def pull(self, name):
        self.put_in.remove(name)
        self.bench.machine.pull(f"stick-{name}")

    def report(self):
        """The importer's current report; None: there is none."""
        text = self.bench.machine.read(REPORT_FILE)
        try:
            return json.loads(text) if text else None
        except ValueError:
            return None

    def stage(self, *stages, timeout_s=IMPORT_S):
        """Waits until an import that began after the last reported one is at one of these stages."""
        seen = [None]

        def reached():
            seen[0] = self.report()
            return seen[0] and seen[0]["import_id"] != self.last and seen[0]["stage"] in stages

        eventually(reached, timeout_s, lambda: f"no import comes to {stages}; told at last: {seen[0]}")
        return seen[0]

    def outcome(self, timeout_s=IMPORT_S):
        """Waits for the outcome of the next stick, and returns it."""
        report = self.stage("done", "failed", timeout_s=timeout_s)
        self.last = report["import_id"]
        return report

    def units(self):
        return self.bench.machine.run(f"systemctl list-units --no-legend --plain {UNITS}").output.strip()

    def installed(self, after="true"):
        """The packs of the installed set after this command has ended in the guest: (title, serial). Each pack must be whole."""
        said = self.bench.machine.check(f"{after}; {LIST}", QUIET_S)
        listed, _ = json.JSONDecoder().raw_decode(said)
        for pack in listed["packs"]:
            self.assertEqual(pack["file"], f"packs/{pack['sha256']}.fspack")
        return [(pack["title"], pack["serial"]) for pack in listed["packs"]]

    def journal_of_imports(self):
        return self.bench.machine.run("journalctl -b -o cat --no-pager -u 'frustumscreen-import*'").output

    def make(self, name, kind, files, **options):
        return sticks.file_system(self.image(name), kind, files, **options)

    def mounts(self):
        return self.bench.machine.run("grep frustumscreen-stick /proc/mounts").output


class ToldStickTest(StickTest):
    """Tests with the exhibit's words, so that the table reports on a stick."""

    settings = USUAL.replace("captions = false", 'captions = false\nwords = "/var/lib/frustumscreen/words.fswords"')

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        both = [screen.lit(cls.bench.rendered([(*CENTRE_M, *UPRIGHT)], artifact)[0]) for artifact in ("amphora", "nautilus-cup")]
        cls.prop = screen.grown([a | b for a, b in zip(*both)], 8, WIDTH)

    def plug(self, name, source, **options):
        self.lit_before = self.beside_prop(self.bench.screendump())
        super().plug(name, source, **options)

    def beside_prop(self, picture):
        """The lit pixels beside the prop."""
        return [row & ~prop for row, prop in zip(screen.lit(picture), self.prop)]

    def lit_beside_prop(self):
        """Their number in the present picture."""
        return screen.count(self.beside_prop(self.bench.screendump()))

    def assert_told(self, name, stage):
        """Waits until the table tells of the last import at this stage: the exhibit's status has it, nothing in the picture fades any more,
        and words are lit that were not there when the stick came. The picture is kept under this name."""
        told = [None]

        def is_known():
            told[0] = (self.bench.status() or {}).get("import") or {}
            return told[0].get("import_id") == self.report()["import_id"] and told[0].get("stage") == stage

        eventually(is_known, 20.0, lambda: f"the exhibit does not know that the stick is at '{stage}', but {told[0]}")
        known = self.bench.screendump()

        def is_lit():
            picture = self.bench.picture_of((*CENTRE_M, *UPRIGHT), after=known)
            screen.write_png(self.bench.out / f"{name}.png", picture)
            return screen.count([row & ~before for row, before in zip(self.beside_prop(picture), self.lit_before)]) > TOLD_PIXELS

        eventually(is_lit, 20.0, f"the table does not tell that the stick is at '{stage}'")


class LongStickTest(StickTest):
    """Each test begins with an empty library. The exhibit must survive all of it: the same process, a lit picture."""

    def setUp(self):
        super().setUp()
        self.clear_library()
        # The kernel need not wait for a stick to spin up.
        self.bench.machine.check("echo 0 > /sys/module/usb_storage/parameters/delay_use || true")
        self.process, self.frames = self.life(), -1

    def tearDown(self):
        super().tearDown()
        self.goes_on()

    def life(self):
        return self.bench.machine.check(f"systemctl show -p MainPID -p NRestarts {UNIT}")

    def goes_on(self):
        """Checks that the exhibit is the same process, reports no fault, draws further frames, and lights the prop."""
        self.assertEqual(self.life(), self.process, "the exhibit was restarted")

        def is_well():
            status = self.bench.status() or {}
            return status.get("health") == "well" and status["frames"] > self.frames and status["frames"]

        self.frames = eventually(is_well, 20.0, lambda: f"the exhibit is not well: {self.bench.status()}")
        eventually(lambda: screen.count(screen.lit(self.bench.screendump())) > LIT_PIXELS, 20.0, "the table is dark")

    def forget(self):
        """Removes the last report, so that the next import does not wait for its readers."""
        self.bench.machine.check(f"rm -f {REPORT_FILE}")
        self.last = None


def pulled_packs(report):
    return {pathlib.PurePath(pack["file"]).name: (pack["outcome"], pack["refusal"]) for pack in report["packs"]}
