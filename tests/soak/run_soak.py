#!/usr/bin/python3
"""The soak: hours of a museum on the kiosk's own image, in an emulated PC, with visitors and faults. `./test soak` calls this.

Exit status   1: limits are missed, with a sentence for each; 2: wrong use.
"""

import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
from dataclasses import asdict

from kiosk import HERE, Kiosk, walk
import day
import faults as fault_module
import judge
import memory  # from tests/image_build, by kiosk
import write_report
from family import Ended, Family  # from tests/hil, by kiosk

CHECKOUT = HERE.parent.parent
VISIT_S = 120.0  # length of the pose file, which repeats
LIT_S, SETTLE_S = 400.0, 10.0


def say(text):
    print(f"== {text}", flush=True)


def parse_arguments():
    parser = argparse.ArgumentParser(prog="./test soak", description=__doc__)
    parser.add_argument("--all", action="store_true", help="eight hours of the exhibit's time, in one hour")
    parser.add_argument("--hours", type=float, help="hours of the exhibit's time (0.4; with --all 8)")
    parser.add_argument("--pace", type=float, default=8.0, help="hours of the exhibit's time in an hour (8); 1: real time")
    parser.add_argument("--seed", type=int, default=1, help="of visitors and faults (1)")
    parser.add_argument("--faults", help="only these kinds, separated by commas")
    parser.add_argument("--out", type=pathlib.Path, default=CHECKOUT / "out" / "soak")
    arguments = parser.parse_args()
    arguments.hours = arguments.hours or (8.0 if arguments.all else 0.4)
    return arguments


def soak(kiosk, doer, events, length_s, pace):
    """Carries out the planned events in order; a late event follows as soon as possible."""
    done = []
    for event in events:
        kiosk.rest(max(0.0, event.at_s / pace - kiosk.now_s()))
        if event.kind == "press":
            kiosk.buttons.tell("press", doer.random.choice((0, 1, 2)), "200ms")
            kiosk.count("presses of buttons")
        else:
            done.append(doer.do(event.kind))
            say(f"{kiosk.now_s():6.0f} s: {event.kind}{'' if done[-1].came_back else ': NOT WELL AGAIN'}")
    kiosk.rest(max(SETTLE_S, length_s / pace - kiosk.now_s()))
    kiosk.log.samples.append(kiosk.sample())
    return done


def main():
    arguments = parse_arguments()
    kinds = arguments.faults.split(",") if arguments.faults else fault_module.KINDS
    unknown = [kind for kind in kinds if kind not in fault_module.KINDS]
    if unknown:
        print(f"soak: there is no fault '{unknown[0]}'; there are {', '.join(fault_module.KINDS)}", file=sys.stderr)
        return 2
    out = arguments.out.resolve()
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    image, binaries = pathlib.Path(os.environ["FRUSTUMSCREEN_IMAGE"]), CHECKOUT / "build" / "release" / "bin"
    rests_h = {kind: rest_s * arguments.pace / 3600.0 for kind, rest_s in fault_module.RESTS_S.items()}
    events = day.plan(arguments.hours, kinds, arguments.seed, fault_module.ENDS_EXHIBIT, rests_h)
    sockets = pathlib.Path(tempfile.mkdtemp(prefix="soak-"))
    packs = fault_module.Packs(binaries / "frustumscreen-pack", CHECKOUT / "build" / "release" / "kiosk" / "built_in.fspack", out / "packs")
    poses = walk(binaries / "frustumscreen-poses", HERE.parent / "hil/guest/etc/frustumscreen/kiosk.toml", arguments.seed, VISIT_S,
                 out / "visit.csv")
    kiosk = Kiosk(image, out, sockets, poses)
    try:
        say("starting the kiosk")
        kiosk.start(LIT_S)
        fault_module.with_keys(kiosk.machine, packs)
        kiosk.begin()
        kiosk.rest(SETTLE_S)
        ends_before = len(kiosk.ends())
        say(f"the whole system takes {memory.used_mb(kiosk.machine):.0f} MB, without the test's agent")
        doer = fault_module.Faults(kiosk, packs, arguments.seed)
        say(f"{arguments.hours:g} hours of the exhibit's time in {60 * arguments.hours / arguments.pace:.0f} minutes, {len(events)} events")
        done = soak(kiosk, doer, events, 3600.0 * arguments.hours, arguments.pace)
        found = {"seed": arguments.seed, "pace": arguments.pace, "samples": [asdict(sample) for sample in kiosk.log.samples if sample],
                 "looks": kiosk.log.looks, "steps": kiosk.log.steps, "ends": kiosk.ends()[ends_before:],
                 "faults": [asdict(fault) for fault in done], "events": kiosk.log.events}
        (out / "journal.txt").write_text(kiosk.machine.run("journalctl -b -o short-monotonic --no-pager -n 3000").output, encoding="utf-8")
    finally:
        kiosk.stop()
        shutil.rmtree(sockets)
        shutil.rmtree(out / "packs", ignore_errors=True)
    (out / "measured.json").write_text(json.dumps(found), encoding="utf-8")
    report = judge.judged(found, fault_module.MAY_CAUSE, fault_module.ENDS_EXHIBIT)
    (out / "report.json").write_text(json.dumps(report, indent=1), encoding="utf-8")
    (out / "report.md").write_text(write_report.text(report), encoding="utf-8")
    print(write_report.text(report))
    subprocess.run(["/usr/bin/python3", HERE / "draw_soak.py", out / "measured.json", out / "soak.svg"], check=False)
    say(f"the report is {out / 'report.md'}")
    for sentence in report["missed"]:
        print(f"soak: {sentence}", file=sys.stderr)
    return 1 if report["missed"] else 0


if __name__ == "__main__":
    try:
        with Family():
            status = main()
    except Ended as ended:
        print(f"soak: ended by {ended}", file=sys.stderr, flush=True)
        os._exit(ended.status)
    sys.exit(status)
