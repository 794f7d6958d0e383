"""Computes the findings of a soak: availability, slopes of memory, writes, ends, steps; and whether the limits hold.

Units    MiB, seconds and hours as named; `pace`: the exhibit's hours in each hour that passed.
Threads  any.
Source   Theil (1950) and Sen (1968): the slope is the median of those between all pairs of samples, its confidence interval from the
         distribution of Kendall's S. Both samples of a pair are of one process, so that a restart is no slope.
"""

import math
import statistics

LIMITS = {"memory_mb_per_h": 1.0, "longest_dark_s": 60.0, "false_alarms": 0, "not_back": 0, "unexpected_ends": 0}
WARM_UP_S = 60.0  # in which a process loads and fills its caches; not counted
MIN_SPAN_S = 1200.0  # of one process after that; in a shorter span, a single step (a language's texts are loaded) looks like a slope
LATER_S = 90.0  # so long after a fault, an event may still be due to it
Z95 = 1.96


def theil_sen(runs):
    """(slope, low, high) of several runs [(x, y)...] with a common slope; low and high bound 95 %. None: fewer than eight samples."""
    slopes, variance = [], 0.0
    for run in runs:
        n = len(run)
        variance += n * (n - 1) * (2 * n + 5) / 18.0
        slopes += [(b[1] - a[1]) / (b[0] - a[0]) for i, a in enumerate(run) for b in run[i + 1:] if b[0] > a[0]]
    if len(slopes) < 28:
        return None
    slopes.sort()
    half = Z95 * math.sqrt(variance) / 2.0
    middle = (len(slopes) - 1) / 2.0
    at = [min(max(0, place), len(slopes) - 1) for place in (math.floor(middle - half), math.ceil(middle + half))]
    return statistics.median(slopes), slopes[at[0]], slopes[at[1]]


def runs_of(samples, value, pid=None):
    """(hours, MB) of each process, without its first minute; of the system, which is not restarted, without the soak's first minute."""
    runs, first = {}, {}
    for sample in samples:
        key = sample[pid] if pid else 0
        found = sample[value]
        if found is None or (pid and not key):
            continue
        begin = first.setdefault(key, sample["at_s"])
        if sample["at_s"] - begin >= WARM_UP_S:
            runs.setdefault(key, []).append((sample["at_s"] / 3600.0, found * 1.048576))
    return [run for run in runs.values() if len(run) > 1]


def slope(samples, value, pid, pace):
    runs = runs_of(samples, value, pid)
    found = theil_sen(runs)
    if found is None:
        return {"verdict": "too few samples"}
    per_h = [number / pace for number in found]
    verdict = "holds" if per_h[2] <= LIMITS["memory_mb_per_h"] else "missed" if per_h[1] > LIMITS["memory_mb_per_h"] else "too short to say"
    if max(3600.0 * (run[-1][0] - run[0][0]) for run in runs) < MIN_SPAN_S:
        verdict = "too short to say"
    return {"mb_per_exhibit_h": per_h[0], "low": per_h[1], "high": per_h[2], "mb_per_h_passed": found[0], "verdict": verdict}


def dark(looks):
    """(share of the time in which the screen was lit, the longest dark time in seconds)."""
    total = lit = longest = current = 0.0
    for (before, was_lit), (at, is_lit) in zip(looks, looks[1:]):
        step = at - before
        total += step
        if was_lit and is_lit:
            lit += step
            current = 0.0
        else:
            current += step
            longest = max(longest, current)
    return (lit / total if total else 0.0), longest


def within(uptime_s, faults, kinds):
    return any(fault["begin_uptime_s"] - 2.0 <= uptime_s <= fault["end_uptime_s"] + LATER_S for fault in faults if fault["kind"] in kinds)


def due_to(uptime_s, faults):
    """The kind of the latest fault before this time."""
    before = [fault["kind"] for fault in faults if fault["begin_uptime_s"] - 2.0 <= uptime_s]
    return before[-1] if before else "nothing"


def totals(samples, value, pid):
    """The increase since the first sample of a count that restarts with each process."""
    total, last, process = 0, None, None
    for sample in samples:
        if sample[pid] != process or last is None or sample[value] < last:
            total += 0 if last is None else sample[value]
        else:
            total += sample[value] - last
        last, process = sample[value], sample[pid]
    return total


def written(samples, faults, hours):
    """Bytes and writes to the data partition: in all, and outside the times of sticks and of the full disk."""
    busy = [(fault["begin_s"] - 1.0, fault["end_s"] + 30.0) for fault in faults
            if fault["kind"] == "disk_full" or fault["kind"].startswith("stick_")]
    quiet_bytes = quiet_writes = quiet_s = 0
    for before, after in zip(samples, samples[1:]):
        if not any(begin < after["at_s"] and before["at_s"] < end for begin, end in busy):
            quiet_bytes += after["written_bytes"] - before["written_bytes"]
            quiet_writes += after["writes"] - before["writes"]
            quiet_s += after["at_s"] - before["at_s"]
    quiet_h = quiet_s / 3600.0
    return {"bytes": samples[-1]["written_bytes"] - samples[0]["written_bytes"], "writes": samples[-1]["writes"] - samples[0]["writes"],
            "bytes_per_h_passed": (samples[-1]["written_bytes"] - samples[0]["written_bytes"]) / hours,
            "without_sticks": {"s": quiet_s, "bytes_per_h_passed": quiet_bytes / quiet_h if quiet_h else None,
                               "writes_per_h_passed": quiet_writes / quiet_h if quiet_h else None}}


def judged(found, may_cause, ends_exhibit):
    """The report. `found`: samples, looks, steps, ends, faults, pace, events, as run_soak.py collects them."""
    samples, faults, pace = found["samples"], found["faults"], found["pace"]
    hours = (found["looks"][-1][0] - found["looks"][0][0]) / 3600.0
    share, longest = dark(found["looks"])
    memory = {name: slope(samples, value, pid, pace) for name, value, pid in (
        ("exhibit", "exhibit_mib", "exhibit_pid"), ("exhibit, without pages of files", "exhibit_own_mib", "exhibit_pid"),
        ("watchdog", "watchdog_mib", "watchdog_pid"), ("system", "system_mib", None))}
    steps = [{**step, "fault": due_to(step["awake_s"], faults),
              "false_alarm": not within(step["awake_s"], faults, [kind for kind, causes in may_cause.items() if step["cause"] in causes])}
             for step in found["steps"]]
    ends = [{"uptime_s": at, "result": result, "fault": due_to(at, faults), "expected": within(at, faults, ends_exhibit)}
            for at, result in found["ends"]]
    report = {
        "seed": found["seed"], "pace": pace, "hours_passed": hours, "exhibit_hours": hours * pace,
        "availability": share, "longest_dark_s": longest, "restarts": ends, "steps": steps,
        "false_alarms": sum(step["false_alarm"] for step in steps), "unexpected_ends": sum(not end["expected"] for end in ends),
        "faults": {}, "not_back": [fault["kind"] for fault in faults if not fault["came_back"]],
        "memory": memory, "written": written(samples, faults, hours),
        "events": {**found["events"], "frames": totals(samples, "frames", "exhibit_pid"),
                   "pictures drawn": totals(samples, "drawn", "exhibit_pid"), "tracker packets": totals(samples, "packets", "exhibit_pid")}}
    for fault in faults:
        report["faults"].setdefault(fault["kind"], []).append(round(fault["end_s"] - fault["begin_s"], 1))
    report["missed"] = missed(report)
    return report


def missed(report):
    """A sentence for each limit that is missed."""
    found = [f"memory of the {name} grows by {slope['low']:.2f} MB/h at least; {LIMITS['memory_mb_per_h']} is allowed"
             for name, slope in report["memory"].items() if slope["verdict"] == "missed"]
    if report["longest_dark_s"] > LIMITS["longest_dark_s"]:
        found.append(f"dark for {report['longest_dark_s']:.0f} s; {LIMITS['longest_dark_s']:.0f} are allowed")
    if report["false_alarms"]:
        found.append(f"{report['false_alarms']} steps of the watchdog without a fault")
    if report["unexpected_ends"]:
        found.append(f"{report['unexpected_ends']} ends of the exhibit without a fault")
    if report["not_back"]:
        found.append(f"not well again in time after: {', '.join(report['not_back'])}")
    return found
