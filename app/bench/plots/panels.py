"""Panels of points and lines over linear or logarithmic axes, dark on white, as SVG by matplotlib.

A label stands at the nearest free place beside its point and is left out where there is none. Points that an axis
cannot show (not finite, not positive on a logarithmic axis) are left out. The same panels give the same bytes.
Units: the data's own; places in points.
"""
import math
import os
import sys
import textwrap
from dataclasses import dataclass, field, replace

try:
    import matplotlib
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D
    from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullLocator
    from matplotlib.transforms import Bbox
except ImportError:
    sys.exit("no plots: Debian's package python3-matplotlib is missing; the tables are written")

# Dark on white, and distinct for every kind of colour vision (Okabe & Ito 2008, darkened).
COLOURS = ("#00507f", "#b34700", "#00694d", "#8a3d6d", "#1f1f1f", "#7a6200", "#2f7fb0", "#d0308f")
LIMIT_COLOUR = "#a00000"
WIDER_FONT = 1.15  # the file has words as text; a reader's font may be this much wider
LEGEND_GAP = 12
NOTE_LETTER = 7.0  # width of a note's letter, an upper bound of the average, points
DOT = 72  # dots an inch, so that a pixel of the canvas is a point of the file
matplotlib.rcParams.update({
    "svg.hashsalt": "frustumscreen", "svg.fonttype": "none", "figure.dpi": DOT, "savefig.dpi": DOT,
    "font.family": ["DejaVu Sans", "sans-serif"], "font.size": 12, "text.parse_math": False, "text.color": "#1a1a1a",
    "axes.labelcolor": "#1a1a1a", "axes.edgecolor": "#606060", "axes.linewidth": 0.8, "axes.axisbelow": True,
    "axes.titlesize": 15, "axes.titleweight": "bold", "axes.titlelocation": "left", "axes.titlepad": 12,
    "grid.color": "#e3e3e3", "grid.linewidth": 0.8, "xtick.color": "#606060", "ytick.color": "#606060",
    "xtick.labelcolor": "#1a1a1a", "ytick.labelcolor": "#1a1a1a", "xtick.labelsize": 11.5, "ytick.labelsize": 11.5,
    "legend.fontsize": 11.5, "legend.frameon": False, "legend.handlelength": 1.8, "legend.labelspacing": 0.55})


class Failure(Exception):
    """A sentence for the person who asked for the plot."""


@dataclass
class Series:
    name: str
    points: list  # (x, y) or (x, y, label)
    colour: int = 0  # index in COLOURS
    mark: str = "o"  # matplotlib's marker, or 'ring'
    width: float = 1.5  # of the line, points
    joined: bool = True  # by a line, in order
    dashed: bool = False
    stepped: bool = False  # the line keeps its y until the next point's x
    opacity: float = 1.0  # of the marks
    in_legend: bool = True  # False: it belongs to another series


@dataclass
class Panel:
    title: str
    x_label: str
    y_label: str
    series: list = field(default_factory=list)
    limits: list = field(default_factory=list)  # (y, label): a horizontal line that values should not pass
    log: bool = True  # both axes
    corner: str = ""  # words in the lower left corner
    y_min: float = 0.0  # if above 0, the lower end of the axis; points below it are drawn at that end


@dataclass(frozen=True)
class Frame:
    """Size and margins of one panel."""
    width: int
    height: int
    left: int
    right: int
    above: int = 44
    below: int = 58


ALONE = Frame(654, 460, 76, 0)  # its legend stands beside it, as wide as its words are
ON_SHEET = Frame(520, 430, 72, 18)


def number(value):
    """The text of a number beside a tick."""
    for min_size, size, unit in ((1e6, 1e6, "M"), (1e4, 1e3, "k")):
        if abs(value) >= min_size:
            return f"{value / size:g}{unit}"
    if 0 < abs(value) < 1e-3:
        exponent = math.floor(math.log10(abs(value)) + 1e-9)
        return f"{value / 10.0**exponent:g}e{exponent}"
    return f"{value:g}"


def shown(series, panel):
    """The points that the axes can show: [(x, y, label)]."""
    points = []
    for x, y, *label in series.points:
        y = max(y, panel.y_min) if panel.y_min > 0 and not math.isnan(y) else y
        if math.isfinite(x) and math.isfinite(y) and (not panel.log or x > 0 and y > 0):
            points.append((x, y, label[0] if label else ""))
    return points


def log_ticks(decades):
    """A locator that gives at least three ticks over any range."""
    if decades < 0.5:
        return MaxNLocator(6, steps=(1, 2, 2.5, 5, 10))
    digits = (1, 1.5, 2, 3, 4, 5, 6, 8) if decades < 0.9 else (1, 2, 5) if decades < 3.2 else (1,)
    return LogLocator(10, digits, numticks=15)


def settle(axis, values, log, min_value):
    """Sets the ticks of an axis and their texts, and returns the ends of the axis, a little beyond the values."""
    low, high = (min(values), max(values)) if values else (1.0, 10.0)
    if log:
        low, high = math.log10(low), math.log10(high)
        room = max(0.06 * (high - low), 0.02) if high > low else 0.3
        low = max(low - room, math.log10(min_value)) if min_value > 0 else low - room
        ends = 10**low, 10**(high + room)
        axis.set_major_locator(log_ticks(high + room - low))
    else:
        ends = min(low, 0.0), high + (0.06 * (high - min(low, 0.0)) or 1.0)
        axis.set_major_locator(MaxNLocator(6, steps=(1, 2, 5, 10)))
    axis.set_minor_locator(NullLocator())
    ends_at_min = min_value > 0 and ends[0] <= min_value * (1 + 1e-9)
    axis.set_major_formatter(FuncFormatter(
        lambda value, _: ("≤ " if ends_at_min and value <= min_value * (1 + 1e-9) else "") + number(value)))
    return ends


class Drawing:
    """Draws one panel; keeps the boxes of what is drawn, so that no label is written over it."""

    def __init__(self, figure, panel, frame, left, top, name):
        width, height = figure.get_size_inches() * DOT
        self.panel, self.name = panel, name
        self.renderer = figure.canvas.get_renderer()
        self.axes = figure.add_axes((
            (left + frame.left) / width, 1 - (top + frame.height - frame.below) / height,
            (frame.width - frame.left - frame.right) / width, (frame.height - frame.above - frame.below) / height))
        self.taken = []
        self.scale()
        for k, series in enumerate(panel.series):
            self.draw_series(series, 3 + 0.1 * (len(panel.series) - k))  # the first on top
        for y, words in panel.limits:
            self.draw_limit(y, words)
        for series in panel.series:
            self.draw_labels(series)

    def scale(self):
        axes, panel = self.axes, self.panel
        points = [point for series in panel.series for point in shown(series, panel)]
        if panel.log:
            axes.set_xscale("log")
            axes.set_yscale("log")
        axes.set_xlim(settle(axes.xaxis, [x for x, _, _ in points], panel.log, 0.0))
        limits = [y for y, _ in panel.limits]
        axes.set_ylim(settle(axes.yaxis, [y for _, y, _ in points] + limits, panel.log, panel.y_min))
        axes.grid(True)
        axes.tick_params(length=3, pad=5)
        axes.set_title(panel.title)
        axes.set_xlabel(panel.x_label, labelpad=6)
        axes.set_ylabel(panel.y_label)
        axes.yaxis.set_label_coords(-54 / axes.bbox.width, 0.5)
        if panel.corner:
            axes.annotate(panel.corner, (0, 0), (8, 8), xycoords="axes fraction", textcoords="offset points",
                          color="#808080", style="italic")

    def pixels(self, points):
        return self.axes.transData.transform([(x, y) for x, y, _ in points]) if points else []

    def keep_clear(self, x, y, reach):
        self.taken.append(Bbox.from_extents(x - reach, y - reach, x + reach, y + reach))

    def keep_line_clear(self, start, end):
        steps = int(math.dist(start, end) / 5) + 1
        for k in range(steps + 1):
            self.keep_clear(*(a + (b - a) * k / steps for a, b in zip(start, end)), 1)

    def draw_series(self, series, order):
        points = shown(series, self.panel)
        line = line_of(series, zorder=order, clip_on=False)
        line.set_data([x for x, _, _ in points], [y for _, y, _ in points])
        line.set_gid(f"{self.name}/{series.name}{'' if series.in_legend else '/more'}")
        self.axes.add_line(line)
        places = self.pixels(points)
        for x, y in places:
            self.keep_clear(x, y, 5)
        if series.joined:
            for start, end in zip(places, places[1:]):
                corner = (end[0], start[1]) if series.stepped else start
                self.keep_line_clear(start, corner)
                self.keep_line_clear(corner, end)

    def draw_limit(self, y, words):
        """Puts the words over the line, at the place where they hide the least."""
        self.axes.axhline(y, color=LIMIT_COLOUR, linestyle=(0, (6, 4)), linewidth=1.0, zorder=2,
                          gid=f"{self.name}/{words}")
        best = None
        for place, alignment, shift in ((1, "right", -6), (0, "left", 6), (0.5, "center", 0)):
            text = self.axes.annotate(words, (place, y), (shift, 4), xycoords=("axes fraction", "data"),
                                      textcoords="offset points", ha=alignment, color=LIMIT_COLOUR, fontsize=11)
            hidden = text.get_window_extent(self.renderer).count_overlaps(self.taken)
            if best is None or hidden < best[0]:
                if best:
                    best[1].remove()
                best = hidden, text
            else:
                text.remove()
        self.taken.append(best[1].get_window_extent(self.renderer))
        ends = self.axes.transAxes.transform([(0, 0), (1, 1)])
        height = self.axes.transData.transform((1, y))[1]
        self.keep_line_clear((ends[0][0], height), (ends[1][0], height))

    def draw_labels(self, series):
        points = shown(series, self.panel)
        for (x, y, words), place in zip(points, self.pixels(points)):
            if words:
                self.draw_label((x, y), place, words, COLOURS[series.colour])

    def draw_label(self, at, place, words, colour):
        text = self.axes.annotate(words, at, (0, 0), textcoords="offset points", color=colour, fontsize=11, zorder=9)
        box = text.get_window_extent(self.renderer)
        inside = self.axes.get_window_extent(self.renderer)
        for away in range(8, 218, 7):
            for x, y in ((8, away - box.height / 2), (8, -away - box.height / 2), (-box.width / 2, away),
                         (-box.width / 2, -away - box.height), (-box.width - 8, away - box.height / 2),
                         (-box.width - 8, -away - box.height / 2)):
                left, low = place[0] + x, place[1] + y
                here = Bbox.from_bounds(left - 3, low, box.width + 6, box.height)  # labels do not touch
                if (here.x0 < inside.x0 or here.x1 > inside.x1 or here.y0 < inside.y0 or here.y1 > inside.y1
                        or here.count_overlaps(self.taken)):
                    continue
                self.taken.append(here)
                text.set_position((x, y))
                nearest = (min(max(place[0], here.x0), here.x1), min(max(place[1], here.y0), here.y1))
                if math.dist(nearest, place) > 18:
                    self.axes.annotate("", at, (nearest[0] - place[0], nearest[1] - place[1]),
                                       textcoords="offset points",
                                       arrowprops={"arrowstyle": "-", "color": colour, "linewidth": 0.6,
                                                   "shrinkA": 0, "shrinkB": 0})
                return
        text.remove()

    def legend(self):
        self.axes.legend(handles=legend_lines([self.panel]), loc="upper left", borderaxespad=0,
                         bbox_to_anchor=(1 + LEGEND_GAP / self.axes.bbox.width, 1.0))


def line_of(series, **more):
    """The look of a series, without its points."""
    colour = COLOURS[series.colour]
    face = "white" if series.mark == "ring" else matplotlib.colors.to_rgba(colour, series.opacity)
    edge = matplotlib.colors.to_rgba(colour, series.opacity if series.mark != "ring" else 1)
    return Line2D([], [], color=colour, linewidth=series.width, marker="o" if series.mark == "ring" else series.mark,
                  markersize=8 if series.mark == "ring" else 7, markerfacecolor=face, markeredgecolor=edge,
                  markeredgewidth={"x": 2.5, "ring": 1.5}.get(series.mark, 0),
                  linestyle="none" if not series.joined else (0, (4, 3)) if series.dashed else "solid",
                  drawstyle="steps-post" if series.stepped else "default", **more)


def legend_lines(panels):
    """One entry for each name that stands in any of the panels."""
    found = {}
    for series in (series for panel in panels for series in panel.series if series.in_legend):
        found.setdefault(series.name, line_of(series, label=series.name))
    return list(found.values())


def width_of(panels, columns=1):
    """The room that their legend takes, whatever the font."""
    figure = new_figure(1000, 1000)
    handles = legend_lines(panels)
    legend = figure.legend(handles=handles, ncol=max(columns, 1), columnspacing=1.6)
    return WIDER_FONT * legend.get_window_extent(figure.canvas.get_renderer()).width if handles else 0


def new_figure(width, height):
    figure = Figure(figsize=(width / DOT, height / DOT), facecolor="white")
    FigureCanvasAgg(figure)  # measures the words
    return figure


def save(path, figure):
    """Writes the file by rename, so that it is whole or absent."""
    part = path.with_name(path.name + ".part")
    try:
        figure.savefig(part, format="svg", metadata={"Date": None, "Creator": None})
        os.replace(part, path)
    except OSError as error:
        raise Failure(f"{path}: {error.strerror}") from error


def save_column(path, panels):
    """The panels one below the other, each with its legend."""
    beside = max((width_of([panel]) for panel in panels), default=0)
    frame = replace(ALONE, width=ALONE.width + LEGEND_GAP + math.ceil(beside), right=LEGEND_GAP + math.ceil(beside))
    figure = new_figure(frame.width, frame.height * len(panels))
    for k, panel in enumerate(panels):
        Drawing(figure, panel, frame, 0, k * frame.height, f"panel{k}").legend()
    save(path, figure)


def save_sheet(path, heading, panels, columns, notes):
    """The panels in rows under one heading, with one legend and notes below: the format of a slide."""
    rows = -(-len(panels) // columns)
    width, top = ON_SHEET.width * columns, 50
    bottom = top + rows * ON_SHEET.height
    handles = legend_lines(panels)
    room = width - 2 * ON_SHEET.left
    legend_columns = next((count for count in range(len(handles), 1, -1) if width_of(panels, count) <= room), 1)
    below = bottom + 22 * -(-len(handles) // legend_columns) + 22
    notes = [line for note in notes for line in textwrap.wrap(note, int(room / NOTE_LETTER))]
    height = below + 22 * len(notes)
    figure = new_figure(width, height)
    figure.text(ON_SHEET.left / width, 1 - 36 / height, heading, fontsize=21, fontweight="bold")
    for k, panel in enumerate(panels):
        Drawing(figure, panel, ON_SHEET, k % columns * ON_SHEET.width, top + k // columns * ON_SHEET.height, f"panel{k}")
    figure.legend(handles=handles, ncol=legend_columns, loc="upper left", borderaxespad=0, columnspacing=1.6,
                  bbox_to_anchor=(ON_SHEET.left / width, 1 - bottom / height))
    for k, note in enumerate(notes):
        figure.text(ON_SHEET.left / width, 1 - (below + 4 + 22 * k) / height, note, color="#505050", fontsize=11.5)
    save(path, figure)
