#!/usr/bin/python3
"""Draws what frustumscreen-bench has measured: tables (CSV) as SVG files beside them.

usage: draw_plots.py TABLE.csv...
       draw_plots.py --overall OUT.svg FOLDER...    error_time.csv of several artifacts on one sheet

The bench calls it. The name of a table determines its plot; equal tables give equal bytes. Exit status 1
and one line on standard error if something is missing or broken.
"""
import csv
import json
import math
import sys
import textwrap
from contextlib import contextmanager
from pathlib import Path

import ldi_plots
import room_plots
import torch_plots
from panels import Failure, Panel, Series, save_column, save_sheet

COST = "median frame time / that of the floor"
FAINT = 0.3
LONGEST_TITLE = 40  # of an artifact, letters
WORST_POSE_COLOUR = 6


class Family:
    """Techniques that one line joins; the line's colour, mark and width are the same in every plot."""

    def __init__(self, name, colour, mark, width=1.5):
        self.name = name
        self.look = {"colour": colour, "mark": mark, "width": width}


FAMILIES = {  # by the tables' column `kind`
    "pack level": Family("pack's levels", 0, "o", 2.5),
    "pack relief": Family("pack's reliefs", 6, "o", 2.5),
    "relief on GPU": Family("pack's reliefs on the GPU", 6, "^"),
    "two-pass": Family("two-pass, full mesh", 1, "s"),
    "two-pass LOD": Family("two-pass, LODs", 3, "s"),
    "full mesh": Family("one pass, full mesh", 5, "D"),
    "LOD": Family("one pass, LODs", 2, "^"),
    "relief": Family("relief images", 7, "D"),
    "ray cast": Family("ray cast (reference)", 4, "x"),
}
# Title; label of the axis; column of mean and worst; lower end of the axis, below which no visitor sees an error; column of the limit.
ERRORS = (
    ("Silhouette error", "% of the artifact's pixels", "silhouette_percent", 0.01, "silhouette_percent"),
    ("Geometric error", "mean distance, mm", "geometric_mean_mm", 0.001, "geometric_mean_mm"),
    ("Colour error", "RMSE against 16 rays, 8-bit codes", "rmse_16_rays", 1.0, "colour_rmse"),
)
DRAWN_LIMITS = ("default level", "finest level")


def read_table(path):
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
    except OSError as error:
        raise Failure(f"{path}: {error.strerror}") from error
    if not rows:
        raise Failure(f"{path}: holds no rows")
    return rows


def different(values):
    """The distinct values, in the order of their first occurrence."""
    return list(dict.fromkeys(values))


# Error over cost


def pareto_front(points):
    """The Pareto-optimal points (less cost and less error are better), by ascending cost; of equal points, the first."""
    front = []
    for point in sorted(points, key=lambda point: point[:2]):
        if not front or point[1] < front[-1][1]:
            front.append(point)
    return front


def median_attainment(artifacts):
    """(cost, error) wherever the least error changes that at least half of the artifacts reach at no more than that cost.

    `artifacts` has a list of (cost, error) for each artifact; an empty list reaches nothing. Source: Grunert da Fonseca, Fonseca &
    Hall 2001, 'Inferential performance assessment of stochastic optimisers and the attainment function'.
    """
    median = []
    for cost in sorted(point[0] for points in artifacts for point in points):
        reached = sorted(
            min((error for at, error in points if at <= cost), default=math.inf) for points in artifacts)
        half = reached[(len(reached) - 1) // 2]
        if half < math.inf and (not median or half < median[-1][1]):
            median.append((cost, half))
    return median


def label_of(row):
    return f"{float(row['triangles']) / 1000:.0f}k" if row["kind"] in ("LOD", "two-pass LOD") else row["technique"]


def points_of(rows, kind, column):
    """(cost, error, label) of a family; of the two-pass pictures of one mesh only that of the best eye image."""
    return [(float(row["times_floor"]), float(row[column]), label_of(row))
            for row in rows if row["kind"] == kind and row["best_eye_image"] == "1"]


def family_series(rows, kind, error):
    """The family's front as a line, and its other points as faint marks."""
    family = FAMILIES[kind]
    points = points_of(rows, kind, f"mean_{error}")
    front = pareto_front(points)
    beside = [point for point in points if point not in front]
    series = [Series(family.name, front, **family.look),
              Series(family.name, beside, joined=False, opacity=FAINT, in_legend=False, **family.look)]
    if kind == "pack level":
        worst = [point[:2] for point in points_of(rows, kind, f"worst_{error}")]
        series.insert(1, Series("the same, worst pose", sorted(worst), WORST_POSE_COLOUR, "ring", 1.0, dashed=True))
    return [one for one in series if one.points]


def error_time_panels(rows, title, limits):
    set_up = rows[0]["set_up"]
    title = textwrap.shorten(title, LONGEST_TITLE, placeholder=" ...")
    panels = []
    for name, unit, error, min_error, limit in ERRORS:
        panel = Panel(f"{name}: {title}, {set_up} set-up", COST, unit, y_min=min_error)
        panel.series = [series for kind in FAMILIES for series in family_series(rows, kind, error)]
        panel.limits = [(float(row[limit]), f"{row['level']}'s limit")
                        for row in limits if row["level"] in DRAWN_LIMITS]
        panels.append(panel)
    return panels


def limits_beside(path):
    file = path.with_name("limits.csv")
    return read_table(file) if file.exists() else []


def pack_title(folder):
    file = folder / "error_time.json"
    try:
        return json.loads(file.read_text(encoding="utf-8"))["pack"]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise Failure(f"{file}: does not say the pack's title; measure again") from error


def draw_error_time(path):
    rows = read_table(path)
    title = pack_title(path.parent)
    for set_up in different(row["set_up"] for row in rows):
        own = [row for row in rows if row["set_up"] == set_up]
        save_column(path.with_name(f"error_time_{set_up}.svg"),
                    error_time_panels(own, title, limits_beside(path)))


def draw_two_pass(path):
    title = f"Built-in amphora, {path.stem.rsplit('_', 1)[1]} triangles"
    save_column(path.with_suffix(".svg"), error_time_panels(read_table(path), title, limits_beside(path)))


def overall_panel(artifacts, set_up, measure):
    name, unit, error, min_error, _ = measure
    panel = Panel(f"{name}, {set_up} set-up", COST, unit, corner="better ↙", y_min=min_error)
    lines, members = [], []
    for kind, family in FAMILIES.items():
        found = [[point[:2] for point in points_of(rows, kind, f"mean_{error}")] for rows in artifacts]
        found = [points for points in found if points]  # a small mesh has no LODs: nothing to be counted against
        look = family.look | {"width": 3.5 if kind == "pack level" else 2.0}
        lines.append(Series(family.name, median_attainment(found), stepped=True, **look))
        members.append(Series(family.name, sum(found, []), joined=False, opacity=FAINT, in_legend=False, **look))
    panel.series = [series for series in lines + members if series.points]
    return panel


def draw_overall(out, folders):
    tables = [read_table(folder / "error_time.csv") for folder in folders]
    titles = [pack_title(folder) for folder in folders]
    panels = []
    for set_up in different(row["set_up"] for rows in tables for row in rows):
        own = [[row for row in rows if row["set_up"] == set_up] for rows in tables]
        panels += [overall_panel(own, set_up, measure) for measure in ERRORS]
    save_sheet(out, f"Error against cost, {len(titles)} artifact{'s' if len(titles) != 1 else ''}", panels, 3, [
        "Lines: the error that at least half of the artifacts reach at that cost. Faint marks: each technique on each "
        "artifact, mean of all poses. Two-pass at its best eye image; peers take one sample a pixel.",
        f"Artifacts: {', '.join(titles)}."])


# Everything else


def draw_scaling(path):
    rows = read_table(path)
    names = ("default level", "finest level", "finest relief", "two-pass, full mesh")  # in this order for each count of triangles
    panels = []
    for title, unit, column, label in (
            ("Cost against the source's size: built-in amphora", "median frame time / floor", "times_floor",
             "{:.2f} x"),
            ("Geometric error of the same pictures", "mean distance, mm", "mean_geometric_mm", "{:.3f}")):
        panel = Panel(title, "source triangles", unit)
        for k, name in enumerate(names):
            points = [(float(row["source_triangles"]), float(row[column])) for row in rows[k::len(names)]]
            panel.series.append(Series(name, [(x, y, label.format(y)) for x, y in points], k))
        panels.append(panel)
    save_column(path.with_suffix(".svg"), panels)


def draw_latency(path):
    rows = [row for row in read_table(path) if row["motion"] == "latency"]
    panels = []
    for tracker in different(row["source"] for row in rows):
        own = [row for row in rows if row["source"] == tracker]
        panel = Panel(f"{tracker}, strokes at {float(own[0]['speed_m_s']):g} m/s",
                      "latency of tracker and display, ms", "RMS slip of the picture on the prop, mm", log=False)
        marks = {}  # of the filters
        for k, name in enumerate(different(row["contestant"] for row in own)):
            points = [(float(row["latency_ms"]), float(row["rms_mm"])) for row in own if row["contestant"] == name]
            filtered, _, predicted = name.partition(", ")  # 'exhibit', 'exhibit, predicted', 'exhibit, as shown'
            marks.setdefault(filtered, "os^D"[len(marks) % 4])
            mark = "ring" if predicted == "as shown" else marks[filtered]
            panel.series.append(Series(name, points, k, mark, dashed=not predicted))
        panels.append(panel)
    save_column(path.with_suffix(".svg"), panels)


def draw_step_error(path):
    rows = read_table(path)
    min_error = 1e-18  # an exact zero has no place on a logarithmic axis
    smoothers = Panel("A smoother's error against its step (no error at all: 1e-18)", "step / time constant",
                      "error of the step response, of 1", limits=[(1.0, "all of it")])
    program = Panel("The program's dynamics against the step between frames", "step, s", "error")
    for panel, unit in ((smoothers, "time constants"), (program, "s")):
        own = [row for row in rows if row["step_unit"] == unit]
        for k, what in enumerate(different(row["what"] for row in own)):
            points = [(float(row["step"]), max(float(row["error"]), min_error)) for row in own if row["what"] == what]
            panel.series.append(Series(what, points, k))
    save_column(path.with_suffix(".svg"), [smoothers, program])


def draw_guidance(path):
    rows = read_table(path)
    panels = []
    for prop in different(row["prop"] for row in rows):
        panel = Panel(f"{prop}: until the picture is whole again", "seconds", "share of the losses mended, %",
                      log=False, limits=[])
        for k, adviser in enumerate(different(row["adviser"] for row in rows)):
            own = [row for row in rows if row["prop"] == prop and row["adviser"] == adviser]
            whole = 100.0 * float(own[0]["whole_share"])
            points = [(float(row["mended_s"]), 100.0 * float(row["quantile"])) for row in own]
            panel.series.append(Series(f"{adviser}: whole for {whole:.0f} % of the time", points, k, ""))
        panels.append(panel)
    save_column(path.with_suffix(".svg"), panels)


def draw_setup(path):
    rows = read_table(path)
    now, choices = rows[0], rows[1:]
    looks = (("evenness", "Evenness", "darkest face / brightest, the worst pose"),
             ("pixels", "Projector pixels on the artifact", "pixels"),
             ("reach_y_m", "How far the prop can be pulled", "from the table's middle, m"),
             ("reference_light", "Light that the artifact sends back", "of a white surface 1 m below the lens"),
             ("frame_times_now", "What a frame costs", "frame time / that of the set-up as it is"))
    panels = []
    kinds = different((row["choice"], row["lens_side_m"]) for row in choices)
    for column, title, label in looks:
        if not now[column]:
            continue  # not requested
        panel = Panel(f"{title}: the best prop for each place of the lens", "lens over the table, m", label, log=False,
                      limits=[(float(now[column]), "as it is")])
        for k, (mount, side) in enumerate(kinds):
            points = [(float(row["lens_height_m"]), float(row[column])) for row in choices
                      if row[column] and (row["choice"], row["lens_side_m"]) == (mount, side)]
            name = "above the middle" if float(side) == 0.0 else f"{abs(float(side)):g} m {'behind' if float(side) > 0.0 else 'before'} it, {mount}"
            if points:
                panel.series.append(Series(name, points, k))
        panels.append(panel)
    save_column(path.with_suffix(".svg"), panels)


def draw_ladder(path):
    rows = read_table(path)
    panel = Panel("How long the table is dark, and how often", "at least so many seconds", "times a year")
    for k, policy in enumerate(different(row["policy"] for row in rows)):
        points = [(float(row["longer_than_s"]), float(row["times_a_year"])) for row in rows if row["policy"] == policy]
        panel.series.append(Series(policy, points, k, "", stepped=True))
    save_column(path.with_suffix(".svg"), [panel])


CHOICES = {"ours": (0, "o"), "paper": (1, "s")}  # of mixed: colour and mark


def draw_mixed(path):
    rows = read_table(path)
    panels = []
    for title, unit, column in (("Geometric error at each budget", "mean distance, mm", "error_mm_mean"),
                                ("Silhouette error at each budget", "% of the artifact's pixels", "silhouette_pct"),
                                ("Popping at each budget", "largest of the walk, RMSE in 8-bit codes", "pop_codes")):
        panel = Panel(f"{title}: cells of polygons or relief", "processor time of a frame, 99th percentile, ms", unit,
                      log=False, corner="better ↙")
        for name, (colour, mark) in CHOICES.items():
            own = sorted((float(row["ms_p99"]), float(row[column])) for row in rows if row["technique"] == name)
            panel.series.append(Series(name, own, colour, mark))
        panels.append(panel)
    save_column(path.with_suffix(".svg"), panels)


def draw_mixed_frames(path):
    """The frame rate over the walk, as Kim 2008, Fig. 9, and below it the popping."""
    rows = read_table(path)
    panels = []
    budgets = different(row["budget_us"] for row in rows)
    for budget in different((budgets[0], budgets[len(budgets) // 2], budgets[-1])):
        for title, unit, value in (
                ("Frame rate over the walk", "frames a second of processor time",
                 lambda row: 1e3 / float(row["ms"])),
                ("Popping over the walk", "RMSE in 8-bit codes", lambda row: float(row["pop_codes"]))):
            panel = Panel(f"{title}, at {float(budget) / 1e3:.1f} ms", "frame", unit, log=False)
            for name, (colour, _) in CHOICES.items():
                own = [(float(row["frame"]), value(row)) for row in rows
                       if row["technique"] == name and row["budget_us"] == budget]
                panel.series.append(Series(name, own, colour, ""))
            if title.startswith("Frame rate"):
                panel.limits = [(1e6 / float(budget), "the budget")]
            panels.append(panel)
    save_column(path.with_suffix(".svg"), panels)


def of_rows(drawn):
    return lambda path: drawn(path, read_table(path))


TABLES = {"error_time": draw_error_time, "two_pass_": draw_two_pass, "scaling_": draw_scaling,
          "latency": draw_latency, "step_error": draw_step_error, "setup": draw_setup,
          "guidance": draw_guidance, "ladder": draw_ladder, "mixed": draw_mixed, "mixed_frames": draw_mixed_frames,
          "room": of_rows(room_plots.draw_room), "room_frames": of_rows(room_plots.draw_room_frames),
          "room_paper": of_rows(room_plots.draw_room_paper), "torch": of_rows(torch_plots.draw_torch),
          "ldi": of_rows(ldi_plots.draw_ldi), "ldi_error": of_rows(ldi_plots.draw_ldi_error),
          "torch_frames": of_rows(torch_plots.draw_torch_frames), "torch_wall": of_rows(torch_plots.draw_torch_wall),
          "torch_triangles": of_rows(torch_plots.draw_torch_triangles)}


@contextmanager
def tables_of(where):
    """Says in one line that a table is not what is read here."""
    try:
        yield
    except (KeyError, ValueError, TypeError) as error:
        raise Failure(f"{where}: is not what this frustumscreen-bench writes ({error}); measure again") from error


def draw(path):
    for start, drawn in TABLES.items():
        if path.stem == start or start.endswith("_") and path.stem.startswith(start):
            with tables_of(path):
                return drawn(path)
    raise Failure(f"{path}: no table that is drawn")


def main(arguments):
    if "--help" in arguments or "-h" in arguments:
        print(__doc__.strip())
    elif len(arguments) > 2 and arguments[0] == "--overall":
        with tables_of("a table of " + ", ".join(arguments[2:])):
            draw_overall(Path(arguments[1]), [Path(folder) for folder in arguments[2:]])
    else:
        for path in arguments:
            draw(Path(path))


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except Failure as failure:
        sys.exit(str(failure))
