#!/usr/bin/python3
"""Measures how long a start takes: from the kernel's first instant to the exhibit's first picture, and, with the same image without the
exhibit, to multi-user.target. Starts of both kinds alternate; the results are their medians. `./test image --start-time` calls this.

Frame    one disk for all starts. The very first start is not counted, because only that one grows the data partition and fills the
         exhibit's cache of shaders; its time is printed separately.
Time     the guest's CLOCK_MONOTONIC, which begins with its kernel and runs on while a busy host makes the guest wait. So each start's row
         has the share of its time in which no processor of the guest waited ("granted"), and the ratio is printed twice: of the times, and
         of the times multiplied by this share. On an idle host both are the same; on a busy one the second is nearer the truth.
Threads  one.
Errors   exit status 1: the ratio is above the limit (--limit).
Source   systemd's own time stamps. frustumscreen.service becomes active with its first picture (READY=1, app/show/run_watch.h); the
         screen is checked too.
"""

import argparse
import json
import os
import pathlib
import shutil
import statistics
import sys
import tempfile
import time

from appliance import eventually, tracker
from bench import Patience
from direct import Direct
WITHOUT_EXHIBIT = "frustumscreen.test_without=frustumscreen.service"  # test_agent/lay_over.sh

TARGET, EXHIBIT = "multi-user.target", "frustumscreen.service"
STEPS = ("sysinit.target", "basic.target", EXHIBIT, TARGET)
START_S = 180.0


def stamp_s(pc, unit, name="ActiveEnterTimestampMonotonic"):
    return 1e-6 * int(pc.check(f"systemctl show -P {name} {unit}").strip() or 0)


def one_start(pc, exhibit, rests_s=0.0):
    """The times of one start from its kernel's first instant, seconds. `rests_s`: the machine stays on for so long afterwards."""
    pc.more_words = "" if exhibit else WITHOUT_EXHIBIT
    begun = time.monotonic()
    pc.start()
    Patience.clock = pc.granted_s
    eventually(lambda: pc.run(f"systemctl is-active {TARGET}").output.strip() == "active", START_S, "multi-user.target is never reached")
    share = pc.granted_s() / (time.monotonic() - begun)
    found = {"exhibit": exhibit, "granted_share": round(share, 3), "systemd_s": stamp_s(pc, "", "UserspaceTimestampMonotonic")}
    found |= {unit.split(".")[0] + "_s": stamp_s(pc, unit) for unit in STEPS}
    if exhibit:
        found["exhibit_begins_s"] = stamp_s(pc, EXHIBIT, "ExecMainStartTimestampMonotonic")
        eventually(pc.lit_picture, START_S, "the exhibit says that it is lit, and the screen is dark")
    elif found["frustumscreen_s"]:
        raise AssertionError("the exhibit was not left out")
    time.sleep(rests_s)
    pc.check("sync")
    pc.stop()
    Patience.clock = time.monotonic
    return found


def medians(starts, granted):
    """(first picture, multi-user.target without the exhibit), s; `granted`: count only the time in which the guest did not wait."""
    def median(exhibit, key):
        return statistics.median(start[key] * (start["granted_share"] if granted else 1.0) for start in starts if start["exhibit"] == exhibit)
    return median(True, "frustumscreen_s"), median(False, "multi-user_s")


def table(starts, first):
    lines = [f"{'':<18}{'systemd':>9}{'basic':>9}{'exhibit':>9}{'picture':>9}{'multi-user':>12}{'granted':>9}"]
    for name, start in [("first of all", first), *((("with exhibit" if s["exhibit"] else "without"), s) for s in starts)]:
        lines.append(f"{name:<18}{start['systemd_s']:>9.2f}{start['basic_s']:>9.2f}{start.get('exhibit_begins_s', 0):>9.2f}"
                     f"{start['frustumscreen_s']:>9.2f}{start['multi-user_s']:>12.2f}{start['granted_share']:>9.2f}")
    for granted, name in ((False, "medians"), (True, "medians of the time granted")):
        lit, without = medians(starts, granted)
        lines.append(f"{name}: {lit:.1f} s to the first picture, {without:.1f} s to {TARGET} without the exhibit, ratio {lit / without:.2f}")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(prog="./test image --start-time", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--starts", type=int, default=5, help="number of starts of each kind (5)")
    parser.add_argument("--limit", type=float, help="exit status 1 above this ratio")
    arguments = parser.parse_args()
    logs = pathlib.Path(os.environ["FRUSTUMSCREEN_IMAGE_LOGS"]) / "start_time"
    logs.mkdir(parents=True, exist_ok=True)
    sockets = pathlib.Path(tempfile.mkdtemp(prefix="start-"))
    mock = tracker(sockets, logs)
    pc = Direct(pathlib.Path(os.environ["FRUSTUMSCREEN_IMAGE"]), logs, sockets, {"tracker": mock.usb})
    starts = []
    try:
        first = one_start(pc, True, rests_s=20.0)
        for _ in range(arguments.starts):
            for exhibit in (True, False):
                starts.append(one_start(pc, exhibit))
                print(starts[-1], flush=True)
    finally:
        mock.stop()
        if pc.is_running():
            pc.stop()
        pc.disk.unlink()
        shutil.rmtree(sockets)
    text = table(starts, first)
    lit, without = medians(starts, granted=True)
    print(text)
    (logs / "start_time.txt").write_text(text + "\n", encoding="utf-8")
    (logs / "start_time.json").write_text(json.dumps({"ratio": lit / without, "first": first, "starts": starts}, indent=1), encoding="utf-8")
    return 1 if arguments.limit and lit / without > arguments.limit else 0


if __name__ == "__main__":
    sys.exit(main())
