"""The plots of frustumscreen-bench ldi; `rows` are those of the table at `path`. The plot is an SVG beside it."""
from panels import Panel, Series, save_column

LOOK = {"ours": (0, "o", 2.5), "multi_ldi_paper": (1, "s", 2.0), "geometry": (4, "x", 2.0), "patch_relief": (6, "D", 1.5),
        "patch_relief_2px": (6, "^", 1.5), "patch_relief_4px": (6, "v", 1.5), "geometry_lod": (5, "D", 1.5),
        "relief_pack": (6, "o", 1.5), "single_ldi": (3, "s", 1.5), "ibo": (7, "s", 1.5), "cube_depth": (2, "^", 1.5),
        "view_depth": (2, "v", 1.5), "points": (7, "^", 1.5)}
# The multi-LDI report, Fig. 8, 630'799 triangles: seconds a frame with 0 to 4 windows.
REPORT = {"geometry": (0.72708, 1.45416, 2.18624, 2.91304, 3.636),
          "multi LDI": (0.72708, 0.77736, 0.82796, 0.87896, 0.93096)}
REPORT_TRIANGLES = 630799


def different(values):
    return list(dict.fromkeys(values))


def times_alone(rows, triangles, technique):
    """Points (windows, time / that of the scene alone)."""
    own = sorted((int(row["windows"]), float(row["ms_p50"])) for row in rows
                 if row["triangles"] == triangles and row["technique"] == technique)
    alone = own[0][1]
    return [(windows, ms / alone) for windows, ms in own]


def window_cost(rows, triangles, technique):
    """Milliseconds that one more window costs."""
    own = {int(row["windows"]): float(row["ms_p50"]) for row in rows
           if row["triangles"] == triangles and row["technique"] == technique}
    max_windows = max(own)
    return (own[max_windows] - own[0]) / max_windows


def windows_panel(rows, triangles):
    panel = Panel(f"Frames with windows, {triangles} triangles", "windows", "times the scene alone", log=False)
    for technique in different(row["technique"] for row in rows):
        panel.series.append(Series(technique, times_alone(rows, triangles, technique), *LOOK[technique]))
    if int(triangles) == REPORT_TRIANGLES:
        for (name, seconds), colour in zip(REPORT.items(), (4, 1)):
            points = [(windows, each / seconds[0]) for windows, each in enumerate(seconds)]
            panel.series.append(Series(f"{name}, the report's", points, colour, "ring", 1.2, dashed=True))
    return panel


def cheaper_panel(rows):
    panel = Panel("A window more: how much cheaper than geometry", "triangles of the scene",
                  "geometry's time / the technique's", corner="better ↖")
    for technique in different(row["technique"] for row in rows if row["technique"] != "geometry"):
        points = []
        for triangles in different(row["triangles"] for row in rows):
            cost = window_cost(rows, triangles, technique)
            if cost > 0:
                points.append((int(triangles), window_cost(rows, triangles, "geometry") / cost))
        panel.series.append(Series(technique, points, *LOOK[technique]))
    panel.series.append(Series("multi LDI, the report's", [(126790, 4.04), (264247, 6.68), (630799, 14.26)], 1, "ring",
                               1.2, dashed=True))
    return panel


def error_panel(rows, triangles, column, words):
    panel = Panel(f"{words[0]}, {triangles} triangles", "a window more, ms", words[1], corner="better ↙")
    for technique in different(row["technique"] for row in rows):
        own = [row for row in rows if row["triangles"] == triangles and row["technique"] == technique]
        error = float(max(own, key=lambda row: int(row["windows"]))[column])
        panel.series.append(Series(technique, [(window_cost(rows, triangles, technique), error)], *LOOK[technique]))
    return panel


def draw_ldi(path, rows):
    largest = max(different(row["triangles"] for row in rows), key=int)
    save_column(path.with_suffix(".svg"), [
        windows_panel(rows, largest), cheaper_panel(rows),
        error_panel(rows, largest, "silhouette_pct", ("Silhouette error", "% of the pixels that show the town")),
        error_panel(rows, largest, "error_mm_mean", ("Geometric error", "mean distance, mm"))])


def draw_ldi_error(path, rows):
    """The error over the number of pixels along the window's side: the mean of all patches."""
    panels = []
    for column, words in (("silhouette_pct", "silhouette, %"), ("error_mm_mean", "mean distance, mm"),
                          ("rmse", "RMSE, 8-bit codes")):
        panel = Panel(f"Error by resolution: {words}", "pixels along the window's side", words)
        for technique in different(row["technique"] for row in rows):
            points = []
            for pixels in different(row["pixels"] for row in rows):
                own = [float(row[column]) for row in rows
                       if row["technique"] == technique and row["pixels"] == pixels]
                points.append((int(pixels), sum(own) / len(own)))
            panel.series.append(Series(technique, points, *LOOK[technique]))
        panels.append(panel)
    save_column(path.with_suffix(".svg"), panels)
