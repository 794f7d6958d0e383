"""The plots of frustumscreen-bench room; `rows` are those of the table at `path`. The plot is an SVG beside it."""
from panels import Panel, Series, save_column

ROOM = {"ours": (0, "o", 2.5), "polygons": (5, "D", 1.5), "relief": (6, "^", 1.5), "lod": (2, "s", 1.5),
        "paper": (1, "s", 1.5)}  # of room: colour, mark and width


def paper_limit(points):
    """The limit as a series with an entry in the legend, because curves would cross a label on the line."""
    ends = [point[0] for point in points]
    return Series("Kim 2008: 10 frames/s", [(min(ends), 10.0), (max(ends), 10.0)], 4, "", 1.0, dashed=True)


def draw_room(path, rows):
    """Each technique at its median frame, with a line to its 99th percentile."""
    panel = Panel(f"A room of {rows[0]['objects']} objects, {float(rows[0]['triangles']) / 1e6:.1f} million source triangles",
                  "processor time of a frame, ms: median, and the 99th percentile (ring)", "mean distance, mm",
                  corner="better ↙")
    for row in rows:
        colour, mark, width = ROOM[row["technique"]]
        error, median, p99 = (float(row[column]) for column in ("error_mm_mean", "ms_p50", "ms_p99"))
        panel.series.append(Series(row["technique"], [(median, error, row["technique"])], colour, mark, width))
        panel.series.append(Series(f"{row['technique']}, p99", [(median, error), (p99, error)], colour, "", 1.0,
                                   in_legend=False))
        panel.series.append(Series(f"{row['technique']}, p99 mark", [(p99, error)], colour, "ring", 1.0,
                                   in_legend=False))
    save_column(path.with_suffix(".svg"), [panel])


WALKS = {"paper": "Along the screen, as Kim 2008, Fig. 9", "visitor": "A visitor before the table",
         "bends": "A visitor who comes near and bends aside"}


def draw_room_frames(path, rows):
    """The frame rate over each walk, as Kim 2008, Fig. 9; the lowest rate of each technique is marked."""
    panels = []
    for walk in dict.fromkeys(row["walk"] for row in rows):
        panel = Panel(WALKS[walk], "seconds", "frames a second of processor time", log=False)
        for technique in dict.fromkeys(row["technique"] for row in rows):
            colour, _, width = ROOM[technique]
            points = [(float(row["seconds"]), 1e3 / float(row["ms"])) for row in rows
                      if row["technique"] == technique and row["walk"] == walk]
            slowest = min(points, key=lambda point: point[1])
            panel.series.append(Series(technique, points, colour, "", width))
            panel.series.append(Series(f"{technique}, least", [(*slowest, f"{slowest[1]:.1f}")], colour, "ring",
                                       joined=False, in_legend=False))
        panel.series.append(paper_limit([point for series in panel.series for point in series.points]))
        panels.append(panel)
    save_column(path.with_suffix(".svg"), panels)


def draw_room_paper(path, rows):
    """The experiment of Kim 2008: error and frame rate on a machine that draws a given number of polygons a second."""
    panels = []
    for title, unit, column in (
            ("The paper's way at its 5,000 polygons a second, and at more", "mean distance, mm", "error_mm_mean"),
            ("Its frame rate today, objects of 10,000 polygons", "least frames a second of processor time", "fps_min")):
        paper = [(float(row["polygons_s"]), float(row[column])) for row in rows
                 if row["technique"] == "paper" and float(row["polygons_s"]) > 0]
        ours = next(float(row[column]) for row in rows if row["technique"] == "ours")
        all_polygons = next(float(row[column]) for row in rows
                            if row["technique"] == "paper" and float(row["polygons_s"]) == 0)
        ends = (min(x for x, _ in paper), max(x for x, _ in paper))
        panel = Panel(title, "polygons a second that the machine is said to draw", unit)
        panel.series = [Series("paper", paper, *ROOM["paper"]),
                        Series("paper, no limit", [(x, all_polygons) for x in ends], ROOM["paper"][0], "", dashed=True),
                        Series("ours, today", [(x, ours) for x in ends], ROOM["ours"][0], "", ROOM["ours"][2])]
        if column == "fps_min":
            panel.series.append(paper_limit(paper))
        panels.append(panel)
    save_column(path.with_suffix(".svg"), panels)
