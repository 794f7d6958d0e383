"""The plots of frustumscreen-bench torch; `rows` are those of the table at `path`. The plot is an SVG beside it."""
import numpy
from matplotlib.collections import LineCollection
from matplotlib.path import Path as MplPath

from panels import Panel, Series, new_figure, save, save_column, save_sheet

LOOK = {"ours": (0, "o", 2.5), "ours_no_shadow": (6, "o", 2.0), "paper": (1, "s", 1.5),
        "paper_curvature": (2, "^", 1.5), "paper_steered": (3, "D", 1.5), "paper_fixed": (5, "D", 1.5)}
SCENES = {"mesh": "polygons", "relief": "cast relief", "cells": "cells of both"}


def family(technique):
    return "paper_curvature" if technique.startswith("paper_curvature") else technique


def different(values):
    return list(dict.fromkeys(values))


def draw_torch(path, rows):
    """Error over cost, in units of a frame without a torch."""
    panels = []
    for scene in different(row["scene"] for row in rows):
        own = [row for row in rows if row["scene"] == scene]
        none = next(float(row["ms_p50"]) for row in own if row["technique"] == "none")
        panel = Panel(f"A torch on {SCENES[scene]}", "times the frame without a torch",
                      "RMSE of the intensity, % of the full one", log=False, corner="better ↙")
        for name in different(family(row["technique"]) for row in own if row["technique"] != "none"):
            points = sorted((float(row["ms_p50"]) / none, float(row["intensity_rmse"])) for row in own
                            if family(row["technique"]) == name)
            panel.series.append(Series(name, points, *LOOK[name]))
        panels.append(panel)
    save_column(path.with_suffix(".svg"), panels)


def tens(values):
    return [sum(values[k:k + 10]) / 10 for k in range(0, len(values) - 9, 10)]


def draw_torch_frames(path, rows):
    """The mean frame rate of each ten frames, as the paper's Fig. 4: with a steered and with a fixed tolerance, equal on average.
    Spread: the rate of the fastest ten frames, divided by that of the slowest."""
    panels = []
    for scene in different(row["scene"] for row in rows):
        of_scene = [row for row in rows if row["scene"] == scene]
        mean_mm = next((float(row["tolerance_mm"]) for row in of_scene if row["technique"] == "paper_fixed"), 0.0)
        panel = Panel(f"Mean rate of 10 frames, {SCENES[scene]}; paper: edges up to {mean_mm:.2g} mm on average", "frame",
                      "frames a second of processor time", log=False)
        for name in ("paper_steered", "paper_fixed", "ours_no_shadow", "ours"):
            rates = [1e3 / mean for mean in tens([float(row["ms"]) for row in of_scene if row["technique"] == name])]
            points = [(10 * k + 5, rate) for k, rate in enumerate(rates)]
            spread = f", spread {max(rates) / min(rates):.2f}" if rates else ""
            panel.series.append(Series(name + spread, points, *LOOK[name]))
        panels.append(panel)
    save_column(path.with_suffix(".svg"), panels)


def draw_torch_wall(path, rows):
    """The error over the number of triangles, for each attenuation."""
    panels = []
    for attenuation in different(row["attenuation"] for row in rows):
        for column, words in (("intensity_rmse", "RMSE"), ("intensity_max", "largest error")):
            panel = Panel(f"A wall of two triangles: {attenuation.replace('_', ' ')}", "triangles after splitting",
                          f"{words} of the intensity, % of the full one", corner="better ↙")
            for heuristic, words_of, look in (("length", "by edge length (paper)", LOOK["paper"]),
                                              ("curvature", "by the bound (ours)", LOOK["paper_curvature"])):
                points = sorted((float(row["triangles"]), float(row[column])) for row in rows
                                if row["attenuation"] == attenuation and row["heuristic"] == heuristic)
                panel.series.append(Series(words_of, points, *look))
            panels.append(panel)
    save_sheet(path.with_suffix(".svg"), "Splitting by edge length and by the bound of the error", panels, 2, [])


SIZE = 300  # side of a wall's picture, pixels
EXTENT = 0.6  # half of that side on the wall, metres
MIDDLE = 0.12  # x of the picture's middle on the wall, metres
PANEL, GAP, ABOVE = 300, 16, 76  # sizes in the figure, pixels


def wall_picture(triangles):
    """Codes of the interpolated intensity in the round beam, and which pixels lie in it. A corner: x, y, intensity, s, t, q."""
    y, x = numpy.mgrid[0:SIZE, 0:SIZE]
    x = ((x + 0.5) / SIZE * 2 - 1) * EXTENT + MIDDLE
    y = (1 - (y + 0.5) / SIZE * 2) * EXTENT
    light = numpy.zeros((SIZE, SIZE))
    in_beam = numpy.zeros((SIZE, SIZE), bool)
    for a, b, c in triangles:
        area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
        u = ((x - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (y - a[1])) / area
        v = ((b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1])) / area
        value = [(1 - u - v) * a[k] + u * b[k] + v * c[k] for k in range(2, 6)]
        inside = (u >= 0) & (v >= 0) & (u + v <= 1) & (value[1]**2 + value[2]**2 <= value[3]**2)
        light[inside] = value[0][inside]
        in_beam |= inside
    return numpy.clip(light, 0, 1)**(1 / 2.2), in_beam


def draw_wall(axes, triangles):
    """Draws the light, and the triangles' edges: opaque inside the beam, faint outside."""
    light, in_beam = wall_picture(triangles)
    frame = (MIDDLE - EXTENT, MIDDLE + EXTENT, -EXTENT, EXTENT)
    axes.imshow(light, cmap="gray", vmin=0, vmax=1, extent=frame, interpolation="nearest")
    edges = dict.fromkeys(tuple(sorted((a[:2], b[:2]))) for corners in triangles
                          for a, b in zip(corners, corners[1:] + corners[:1]))
    at = (numpy.arange(SIZE) + 0.5) / SIZE * 2 * EXTENT - EXTENT
    beam = axes.contour(at + MIDDLE, at, in_beam[::-1].astype(float), levels=[0.5], linewidths=0)
    rim = MplPath(max(beam.allsegs[0], key=len))
    axes.add_collection(LineCollection(edges, colors="#e02020", linewidths=0.4, alpha=0.35))
    whole = LineCollection(edges, colors="#e02020", linewidths=0.7)
    axes.add_collection(whole)
    whole.set_clip_path(rim, axes.transData)
    axes.set_axis_off()
    axes.set_xlim(frame[:2])
    axes.set_ylim(frame[2:])


def draw_torch_triangles(path, rows):
    """The light, and the triangles' edges in red, as the paper's Fig. 3."""
    panels = different((row["heuristic"], row["tolerance"]) for row in rows)
    width, height = len(panels) * (PANEL + GAP) + GAP, PANEL + ABOVE + 20
    figure = new_figure(width, height)
    figure.text(GAP / width, 1 - 28 / height, "Attenuation at corners alone: a torch before a wall", fontsize=17,
                fontweight="bold")
    for k, (heuristic, tolerance) in enumerate(panels):
        corners = [tuple(float(row[column]) for column in ("x_m", "y_m", "intensity", "s", "t", "q")) for row in rows
                   if (row["heuristic"], row["tolerance"]) == (heuristic, tolerance)]
        triangles = [corners[first:first + 3] for first in range(0, len(corners), 3)]
        axes = figure.add_axes(((GAP + k * (PANEL + GAP)) / width, 20 / height, PANEL / width, PANEL / height))
        draw_wall(axes, triangles)
        words = (f"edges up to {float(tolerance):g} mm" if heuristic == "length" else
                 f"bound of the error {float(tolerance):g} %")
        axes.set_title(f"{words}: {len(triangles)} triangles", fontsize=11.5, fontweight="normal", pad=6)
    save(path.with_suffix(".svg"), figure)
