"""Cuts the power of a kiosk, in every phase of its life, on a disk with a volatile write cache, and checks the disk that is left.

A kiosk runs once through everything that it keeps, on a disk that records its writes in a log (kiosk.Session). For each cut, a random
moment of that log is chosen, and a random part of the bytes that were not flushed reaches the disk (write_log.Replay). Debian's tools check
each such disk (states.Checker). A sample of the disks is started in an emulated PC until the exhibit is lit; some of these starts are
recorded and cut again.
"""

import argparse
import collections
import copy
import functools
import json
import pathlib
import random
import shutil
import statistics
import sys
import time
from dataclasses import dataclass

from kiosk import KEPT, LIBRARY, SETTINGS, Lent, Recorded, Session, Tools
from appliance import Appliance
from bench import Patience
from direct import Direct
from states import Checker, Must, State, Version, kept_number
from updates import NEXT, THIS, Updates
from write_log import MARK, Replay, moments

MIB = 1 << 20
CHECKOUT = pathlib.Path(__file__).resolve().parent.parent.parent
PHASES = ("first start", "save", "import", "running", "update", "start")
# Cases that need a start with firmware and boot loader, which take most of a start's time
OF_THE_FIRMWARE = {"boot partition not clean", "boot partition marked as in use", "empty kernel image", "second partition table"}
AGAIN = "after a cut: "
CUTS_AGAIN = 40  # cuts of a start that follows a cut
KEPT_DISKS = 3  # faulty states of each recording, for debugging
ENOUGH = 40  # cuts while settings are saved: with so many, some must lose unsynced data, since one in eight does


class Row:
    """A row of the table: the results of a phase's cuts."""

    def __init__(self):
        self.states = self.faulty = self.boots = self.dark = 0
        self.unflushed, self.notes, self.checks_s, self.lit_s = [], collections.Counter(), [0.0], []


def table(rows):
    lines = ["| phase | cuts looked at | with lost bytes, kB (median, most) | repairs before the start | e2fsck, longest | faults | started | lit, median (longest) | dark or lost |",
             "|---|---|---|---|---|---|---|---|---|"]
    for phase, row in rows.items():
        notes = ", ".join(f"{words}: {count}" for words, count in sorted(row.notes.items())) or "none"
        lit = f"{statistics.median(row.lit_s):.0f} s ({max(row.lit_s):.0f})" if row.lit_s else ""
        lost = f"{statistics.median(row.unflushed) / 1e3:.0f}, {max(row.unflushed) / 1e3:.0f}" if row.unflushed else ""
        lines.append(f"| {phase} | {row.states} | {lost} | {notes} | {max(row.checks_s):.1f} s | {row.faulty} | {row.boots} | {lit} | {row.dark} |")
    return "\n".join(lines) + "\n"


@dataclass
class Cut:
    """A cut whose disk is started."""

    number: int
    phase: str
    state: State
    must: Must
    row: Row


class Cuts:
    """One run of the harness. `arguments`: those of the command line."""

    def __init__(self, arguments):
        self.work = arguments.out
        self.work.mkdir(parents=True, exist_ok=True)
        self.image, self.next = arguments.image, arguments.next
        self._begun = time.monotonic()
        self.tools = Tools(CHECKOUT / "build/release/bin", arguments.packs, self.work / "tools")
        self.versions = [Version.of(name, folder / f"frustumscreen_{name}.efi")
                         for name, folder in ((THIS, self.image.parent), (NEXT, self.next))]
        self.updates = Updates(self.next, arguments.keys, self.work / "bundles")
        self.rows, self.faults = {}, []

    def say(self, words):
        print(f"{time.monotonic() - self._begun:6.0f} s: {words}", flush=True)

    def write_table(self):
        (self.work / "table.md").write_text(table(self.rows), encoding="utf-8")

    def record(self, folder):
        """Records one kiosk's life."""
        shutil.rmtree(folder, ignore_errors=True)
        (self.work / f"bundles/update-{NEXT}.raucb").unlink(missing_ok=True)
        bundle = self.updates.make()
        with Lent(self.image, folder, Recorded) as pc:
            life = Session(pc, self.work, self.tools, bundle, self.say)
            life.first_start()
            life.save(4)
            life.take_packs("one", {"amphora.fspack": self.tools.signed("amphora", 1)})
            life.take_packs("two", {"amphora.fspack": self.tools.signed("amphora", 2), "cup.fspack": self.tools.signed("nautilus-cup", 1)})
            life.run_on(60.0)
            life.update()
            life.start_again()

    def look(self, folder, count, boots, chance, *, heeds_flushes=True, label="", must=None, cut_again=0):
        """Cuts a recording. In each phase it checks `count` states, starts `boots` of them, and records and cuts `cut_again` of these
        starts. Returns the number of states with a fault."""
        now = self.work / f"now-{label.strip(': ').replace(' ', '-')}.raw"
        replay = Replay(folder / "start.raw", folder / "writes.log", now, heeds_flushes)
        checker = Checker(self.work / f"check-{now.stem}", self.versions, self.tools, self.image, now.stat().st_size)
        for name, place in checker.slots(self.image).items():
            replay.watch(name, *place)
        must = must or Must()
        chosen = moments(replay, count, chance, (checker.data_begins(self.image), now.stat().st_size - MIB))
        started = self._sample(chosen, boots, chance)
        left_to_cut_again, faulty, known = dict.fromkeys(PHASES, cut_again), 0, {"unsafe file lost"}
        for number, (at, phase, seed) in enumerate(chosen):
            while replay.at < at:
                entry = replay.entries[replay.at]
                if entry.kind == MARK:
                    must.take(replay.words(entry))
                replay.advance(replay.at + 1)
            row = self.rows.setdefault(label + phase, Row())
            row.unflushed.append(replay.unflushed_bytes())
            replay.cut(random.Random(seed))
            state = checker.look(replay.path, replay.generation, must)
            row.states += 1
            row.notes.update(state.notes)
            row.checks_s.append(state.e2fsck_s)
            for fault in state.faults:
                self.faults.append(f"{label}{phase}, cut {number} (record {at}, seed {seed}): {fault}")
                if heeds_flushes:
                    self.say(self.faults[-1])
            if state.faults and heeds_flushes and faulty < KEPT_DISKS:
                replay.keep(self.work / f"faulty-{now.stem.removeprefix('now-')}{number}.raw")
            row.faulty += bool(state.faults)
            faulty += bool(state.faults)
            is_new, known = bool(boots and state.notes - known), known | state.notes  # the first state with a new note is started, too
            if (number in started or is_new) and state.kernel:
                left_to_cut_again[phase] -= 1
                self.start(Cut(number, phase, state, must, row), replay, left_to_cut_again[phase] >= 0, chance)
                self.write_table()
            replay.mend()
        replay.close()
        now.unlink()
        return faulty

    @staticmethod
    def _sample(chosen, count, chance):
        found = set()
        for phase in sorted({phase for _, phase, _ in chosen}):
            numbers = [number for number, (_, of, _) in enumerate(chosen) if of == phase]
            found.update(chance.sample(numbers, min(count, len(numbers))))
        return found

    def start(self, cut, replay, is_recorded, chance):
        """Starts a copy of the present disk. The exhibit must be lit after one start, and acknowledged data must be there."""
        folder = self.work / f"start-{cut.number}"
        disk = self.work / "cut.raw"
        replay.keep(disk)
        with_firmware = is_recorded or bool(OF_THE_FIRMWARE & cut.state.notes)
        direct = functools.partial(Direct, kernel_image=cut.state.kernel)
        cut.row.boots += 1
        wrong, lit_s, begun = [], 0.0, time.monotonic()
        with Lent(disk, folder, Recorded if is_recorded else Appliance if with_firmware else direct) as pc:
            disk.unlink()
            try:
                if is_recorded:
                    pc.recorded.mark(json.dumps({"phase": "start"}))
                pc.start()
                pc.may_start_anew()
                Patience.clock = pc.granted_s
                pc.wait_until_lit()
                lit_s = pc.granted_s()
                wrong = self._lost(pc, cut.must)
                if pc.resets_within(0.1):
                    wrong.append("it took more than one start")
            except Exception as error:  # pylint: disable=broad-except
                wrong = [f"not lit: {error}"]
        if wrong:
            cut.row.dark += 1
            self.faults.append(f"{cut.phase}, start of cut {cut.number}: {wrong}")
        else:
            cut.row.lit_s.append(lit_s)
        self.say(f"{cut.phase}, cut {cut.number} started {'with' if with_firmware else 'without'} the firmware: "
                 f"{wrong or f'lit after {lit_s:.0f} s'} ({time.monotonic() - begun:.0f} s)")
        if is_recorded and not wrong and self.look(folder, CUTS_AGAIN, 0, chance, label=AGAIN, must=copy.deepcopy(cut.must)):
            return  # the recording is kept
        shutil.rmtree(folder)

    @staticmethod
    def _lost(pc, must):
        """The acknowledged data that the started kiosk lacks, by its own report."""
        wrong = []
        if "machine-id" in must.min_value and pc.check("cat /etc/machine-id").strip() != must.min_value["machine-id"]:
            wrong.append("another machine-id")
        if "kept" in must.min_value and (kept_number(pc.read(KEPT) or "") or 0) < must.min_value["kept"]:
            wrong.append("the kept file is damaged or old")
        if "settings" in must.min_value and "# saved" not in (pc.read(SETTINGS) or ""):
            wrong.append("the settings are lost")
        if "set" in must.min_value:
            listed = pc.run(f"frustumscreen-import --list --into {LIBRARY} --json")
            if listed.status != 0 or json.loads(listed.output)["number"] < must.min_value["set"]:
                wrong.append(f"the set is lost: {listed.output.strip()}")
        notes = pc.notes().strip()
        if "until the machine is switched off" in notes:
            wrong.append(notes)
        return wrong


def parse_arguments():
    parser = argparse.ArgumentParser(prog="./test image --cuts", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("states", nargs="?", type=int, default=240, help="how many cuts are checked, in all phases together (240)")
    parser.add_argument("--boots", type=int, default=12, help="how many of them are started in the emulated PC (12)")
    parser.add_argument("--again", type=int, default=1, help="how many of these starts, of each phase, are cut again (1)")
    parser.add_argument("--seed", type=int, default=1, help="another seed chooses other cuts (1)")
    parser.add_argument("--recorded", type=pathlib.Path, help="the folder of an earlier recording, OUT/recorded, instead of a new one")
    parser.add_argument("--image", type=pathlib.Path, default=CHECKOUT / "out/image/test/frustumscreen.raw")
    parser.add_argument("--next", type=pathlib.Path, default=CHECKOUT / "out/image/next/test", help="folder of the update's image")
    parser.add_argument("--keys", type=pathlib.Path, default=CHECKOUT / "build/image/test_keys")
    parser.add_argument("--packs", type=pathlib.Path, default=CHECKOUT / "build/hil/packs")
    parser.add_argument("--out", type=pathlib.Path, default=CHECKOUT / "out/cuts")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    cuts = Cuts(arguments)
    recorded = arguments.recorded or arguments.out / "recorded"
    if not arguments.recorded:
        cuts.record(recorded)
    per_phase, boots = -(-arguments.states // len(PHASES)), -(-arguments.boots // len(PHASES))
    cuts.look(recorded, per_phase, boots, random.Random(arguments.seed), cut_again=min(arguments.again, boots))
    cuts.write_table()
    print(table(cuts.rows), "\n".join(cuts.faults), sep="\n")
    # The controls: the same harness must find damage where there is some.
    unsafe = sum(row.notes["unsafe file lost"] for row in cuts.rows.values())
    lying = Cuts(arguments)
    found = lying.look(recorded, min(per_phase, 20), 0, random.Random(arguments.seed), heeds_flushes=False)
    print(f"controls: a file that was written without a sync was lost by {unsafe} cuts; a disk that ignores flushes has faults after "
          f"{found} of {sum(row.states for row in lying.rows.values())} cuts")
    if not found or (not unsafe and per_phase >= ENOUGH):
        print("cuts: the harness finds no damage where there is some", file=sys.stderr)
        return 1
    return 1 if cuts.faults else 0


if __name__ == "__main__":
    sys.exit(main())
