"""A soak's report as Markdown."""

# How often each event is assumed to happen at a museum, in a day of eight hours. None: it is too rare for a rate.
USUAL_PER_DAY = {"presses of buttons": 480, "replugs of the tracker": 1, "replugs of the buttons": 0.2, "replugs of the projector": 1,
                 "sticks": 0.1, "sets switched": 0.05, "frames": 30 * 8 * 3600, "tracker packets": 240 * 8 * 3600}


def days(event, count):
    usual = USUAL_PER_DAY.get(event)
    return f"{count / usual:.3g}" if usual else ""


def memory_row(name, slope):
    if "low" not in slope:
        return f"| memory of the {name} | {slope['verdict']} |"
    return (f"| memory of the {name}, MB per hour of the exhibit's | {slope['mb_per_exhibit_h']:+.2f} ({slope['low']:+.2f} to {slope['high']:+.2f}): "
            f"{slope['verdict']} |")


def megabytes(count):
    return "" if count is None else f"{count / 1e6:.2f} MB"


def text(report):
    written = report["written"]
    quiet = written["without_sticks"]
    lines = [
        "| what | seen |", "|---|---|",
        f"| the exhibit's time; ours | {report['exhibit_hours']:.2f} h; {60 * report['hours_passed']:.1f} min |",
        f"| lit | {100 * report['availability']:.2f} % |",
        f"| longest dark | {report['longest_dark_s']:.1f} s |",
        f"| ends of the exhibit; without a seeded fault | {len(report['restarts'])}; {report['unexpected_ends']} |",
        f"| steps of the watchdog; without a seeded fault | {len(report['steps'])}; {report['false_alarms']} |",
        *(memory_row(name, slope) for name, slope in report["memory"].items()),
        f"| written to the data partition | {megabytes(written['bytes'])}, {written['writes']} writes |",
        f"| of it without sticks and the full disk, an hour of ours | {megabytes(quiet['bytes_per_h_passed'])}, "
        f"{'' if quiet['writes_per_h_passed'] is None else round(quiet['writes_per_h_passed'])} writes |",
        "", "| event | times | days of a museum |", "|---|---|---|",
        *(f"| {event} | {count} | {days(event, count)} |" for event, count in sorted(report["events"].items()) if not event.startswith("fault")),
        "", "| fault | times | until all was well, s | well again |", "|---|---|---|---|",
        *(f"| {kind} | {len(took)} | {', '.join(f'{seconds:.0f}' for seconds in took)} | "
          f"{'no' if kind in report['not_back'] else 'yes'} |" for kind, took in sorted(report["faults"].items())),
        ""]
    if report["restarts"]:
        lines += ["| end of the exhibit, guest's s | how | after |", "|---|---|---|",
                  *(f"| {end['uptime_s']:.0f} | {end['result']} | {end['fault']} |" for end in report["restarts"]), ""]
    if report["steps"]:
        lines += ["| the watchdog's step, guest's s | cause | step | after |", "|---|---|---|---|",
                  *(f"| {step['awake_s']:.0f} | {step['cause']} | {step['step']} | {step['fault']} |" for step in report["steps"]), ""]
    lines += ["No limit is missed." if not report["missed"] else "Missed: " + "; ".join(report["missed"]) + "."]
    return "\n".join(lines) + "\n"
