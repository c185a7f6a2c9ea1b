#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws charts from data files with matplotlib.

    draw_charts.py studies FOLDER [NAME...]    draws NAME.svg and NAME-dark.svg from NAME.json; default: every study in the folder
    draw_charts.py curves FILE.csv OPTIONS     draws FILE.svg: columns of the file against its first column

`halfspace chart` runs the first command. bench_charts.py uses the functions of this file to draw the benchmark charts.
Exit codes: 0 success, 1 invalid data or a file that cannot be written, 2 invalid command line, 69 matplotlib is missing.
"""
import argparse
import csv
import json
import math
import os
import sys
from pathlib import Path

NO_MATPLOTLIB = 69  # EX_UNAVAILABLE; must match apps/study/draw_charts.cpp
SYSTEM_PYTHON = "/usr/bin/python3"

try:
    import matplotlib
except ImportError:
    if __name__ != "__main__":
        raise
    # System packages are visible only to the system's interpreter, which may not be the first in PATH.
    if sys.executable != SYSTEM_PYTHON and os.access(SYSTEM_PYTHON, os.X_OK):
        os.execv(SYSTEM_PYTHON, [SYSTEM_PYTHON, *sys.argv])
    print("draw_charts.py: matplotlib is missing (Debian and Ubuntu: python3-matplotlib)", file=sys.stderr)
    sys.exit(NO_MATPLOTLIB)
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.ticker import FixedFormatter, FixedLocator, NullFormatter

# From Okabe and Ito, "Color universal design", 2008: distinguishable with all types of color vision, on white and on black.
COLORS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c6bb1", "#7f7f7f"]
LIGHT = {"ink": "#222222", "faint": "#c8c8c8", "ground": "#ffffff"}
DARK = {"ink": "#e6e6e6", "faint": "#4a4a4a", "ground": "#16181c"}

DPI = 96  # Figures are laid out in CSS pixels.
POINT = 72 / DPI  # Length of a pixel in points.
SMALL = 11 * POINT  # Font size of labels.


def use_theme(ink, faint, ground):
    """Sets the style of all figures created after this call."""
    matplotlib.rcParams.update({
        "figure.dpi": DPI, "figure.facecolor": ground, "axes.facecolor": ground, "savefig.facecolor": ground,
        "text.color": ink, "axes.labelcolor": ink, "axes.edgecolor": ink, "xtick.color": ink, "ytick.color": ink, "grid.color": faint,
        "font.family": "sans-serif", "font.sans-serif": ["DejaVu Sans"], "font.size": 12 * POINT, "axes.titlesize": 14 * POINT, "legend.frameon": False,
        "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.linewidth": 0.4, "axes.axisbelow": True,
        "axes.prop_cycle": matplotlib.cycler(color=COLORS), "lines.linewidth": 1.2, "lines.markersize": 4,
        "text.parse_math": False,  # Do not parse names as formulas.
        "svg.fonttype": "none",  # Keep text as text, which keeps files small.
        "svg.hashsalt": "halfspace",  # The same data must produce the same file.
    })


def new_figure(width, height):
    """Creates an empty figure. width and height: size in pixels."""
    figure = Figure(figsize=(width / DPI, height / DPI))
    FigureCanvasAgg(figure)
    return figure


def save(figure, path, **options):
    metadata = {"Date": None, "Creator": None} if path.suffix == ".svg" else {}
    figure.savefig(path, metadata=metadata, **options)


def new_panels(count, width, height, **options):
    """Creates a figure with plots next to each other, each width x height pixels. Returns the figure and a list of its axes."""
    figure = new_figure(count * width, height)
    return figure, list(figure.subplots(1, count, squeeze=False, **options)[0])


def legend_beside(axes):
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1), borderaxespad=0)


def power_of_ten(exponent):
    return "10" + str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def log_ticks(axis, low, high):
    """Sets the bounds of a logarithmic axis and its ticks. An axis that spans less than 2.5 decades is labeled at 1, 2 and 5 times each
    power of ten, a longer one at the powers of ten, or at every n-th of them."""
    axis.axes.set(**{f"{axis.axis_name}scale": "log", f"{axis.axis_name}lim": (low, high)})
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    if high / low < 10**2.5:
        major = [float(f"{factor}e{power}") for power in powers for factor in (1, 2, 5)]
        labels = [f"{value:g}" for value in major]
    else:
        shown = [power for power in powers if power % math.ceil(len(powers) / 10) == 0]
        major, labels = [float(f"1e{power}") for power in shown], [power_of_ten(power) for power in shown]
    factors = range(1, 10) if len(powers) <= 8 else (1,)
    minor = {float(f"{factor}e{power}") for power in powers for factor in factors} - set(major)
    axis.set_major_locator(FixedLocator([value for value in major if low <= value <= high]))
    axis.set_major_formatter(FixedFormatter([label for label, value in zip(labels, major) if low <= value <= high]))
    axis.set_minor_locator(FixedLocator(sorted(value for value in minor if low <= value <= high)))
    axis.set_minor_formatter(NullFormatter())


def finish_axes(axes, x_label, y_label, log_x, log_y):
    """Sets the titles and scales of axes whose data are complete, and adds a legend."""
    axes.set(xlabel=x_label, ylabel=y_label, xscale="log" if log_x else "linear", yscale="log" if log_y else "linear")
    for axis, is_log in ((axes.xaxis, log_x), (axes.yaxis, log_y)):
        if is_log:
            log_ticks(axis, *axis.get_view_interval())
    axes.legend()


# ---- charts of studies ----

WIDTH, HEIGHT = 1000, 660
ROOM = (90, 130, 970, 580)  # Bounds of the plot area: left, bottom, right, top, in pixels with y up.
LINE_HEIGHT, POINT_RADIUS = 15, 5  # Of labels and points, in pixels.


def overlap(a, b):
    """Area that two rectangles (left, bottom, right, top) have in common."""
    return max(0, min(a[2], b[2]) - max(a[0], b[0])) * max(0, min(a[3], b[3]) - max(a[1], b[1]))


def label_box(x, y, anchor, width):
    left = x - {"left": 0, "center": 0.5, "right": 1}[anchor] * width
    return left, y - LINE_HEIGHT / 2, left + width, y + LINE_HEIGHT / 2


def label_candidates(x, y):
    """Positions to try for a label: right, left, above, below and the four corners, then the same at larger distances."""
    for r in (9, 20, 34, 50, 70, 95):
        far = r > 9
        up, aside = (r, 0.7 * r) if far else (r + 3, r - 3)
        yield from ((x + r, y, "left", far), (x - r, y, "right", far), (x, y + up, "center", far), (x, y - up, "center", far))
        for dy in (0.8 * up, -0.8 * up):
            yield from ((x + aside, y + dy, "left", far), (x - aside, y + dy, "right", far))


def place_labels(points, widths, room, obstacles=()):
    """Places a label next to each point. Returns (x, y, anchor, far) for each: anchor is the part of the text at x, y is at half its
    height, and a far label needs a leader line. The algorithm is greedy: each label in turn is placed where it overlaps the points, the
    obstacles and the labels already placed the least. Any part of a label outside `room` counts three times."""
    places, taken = [], [(x - POINT_RADIUS, y - POINT_RADIUS, x + POINT_RADIUS, y + POINT_RADIUS) for x, y in points] + list(obstacles)
    for (x, y), width in zip(points, widths):
        area = width * LINE_HEIGHT

        def cost(place):
            box = label_box(*place[:3], width)
            outside = area - overlap(box, room)
            distance = abs(place[0] - x) + abs(place[1] - y)
            return 3 * outside + sum(overlap(box, other) for other in taken) + (0.01 * area if place[3] else 0) + 1e-3 * distance

        places.append(min(label_candidates(x, y), key=cost))
        taken.append(label_box(*places[-1][:3], width))
    return places


def boxes_along(line):
    """Covers a polyline (points in pixels) with small boxes, so that labels avoid it."""
    for (x0, y0), (x1, y1) in zip(line, line[1:]):
        steps = math.ceil(math.hypot(x1 - x0, y1 - y0) / 4)
        for x, y in ((x0 + (x1 - x0) * k / steps, y0 + (y1 - y0) * k / steps) for k in range(steps)):
            yield x - 2, y - 2, x + 2, y + 2


def draw_labels(axes, names, xs, ys, lows, highs, front):
    """Draws the name of each point next to it, clear of the points, the error bars from lows to highs and the line through `front`."""
    renderer = axes.figure.canvas.get_renderer()
    font = FontProperties(size=SMALL)
    widths = [renderer.get_text_width_height_descent(name, font, False)[0] for name in names]
    points, bottoms, tops, line = (axes.transData.transform(list(at)) for at in (zip(xs, ys), zip(xs, lows), zip(xs, highs), front))
    obstacles = [(x - 3, low, x + 3, high) for (x, low), (_, high) in zip(bottoms, tops)] + list(boxes_along(line))
    leader = {"arrowstyle": "-", "color": matplotlib.rcParams["text.color"], "alpha": 0.4, "linewidth": 0.6, "shrinkA": 0, "shrinkB": 0}
    for name, at, (x, y), (label_x, label_y, anchor, far) in zip(names, zip(xs, ys), points, place_labels(points, widths, ROOM, obstacles)):
        axes.annotate(name, at, ((label_x - x) * POINT, (label_y - y) * POINT), textcoords="offset points", ha=anchor, va="center",
                      fontsize=SMALL, arrowprops=leader if far else None, zorder=4)


def draw_legend(figure):
    """Draws the legend below the plot, in as few rows as fit."""
    handles, labels = figure.axes[0].get_legend_handles_labels()
    for columns in range(len(labels), 0, -1):
        legend = figure.legend(handles, labels, loc="center", bbox_to_anchor=(0.5, 40 / HEIGHT), ncol=columns, labelspacing=0.3)
        if legend.get_window_extent(figure.canvas.get_renderer()).width <= WIDTH - 20:
            return
        legend.remove()


def log_bounds(values):
    low, high = math.log10(min(values)), math.log10(max(values))
    margin = max(0.08 * (high - low), 0.15)
    return 10 ** (low - margin), 10 ** (high + margin)


def study_figure(study):
    """Draws error and time of the variants of a study. study: the content of its JSON file, which write_study() writes."""
    variants, truth = study["variants"], study["truth"]
    errors = [max(v["error"], truth["error"], 1e-30) for v in variants]  # Differences below the error of the reference are meaningless.
    median, low, high = ([max(v["ms"][key], 1e-6) for v in variants] for key in ("median", "low", "high"))
    figure = new_figure(WIDTH, HEIGHT)
    left, bottom, right, top = ROOM
    axes = figure.add_axes((left / WIDTH, bottom / HEIGHT, (right - left) / WIDTH, (top - bottom) / HEIGHT))
    log_ticks(axes.xaxis, *log_bounds(errors))
    log_ticks(axes.yaxis, *log_bounds(low + high))
    axes.set(xlabel=study["error_name"], ylabel=f"ms, {study['time_name']}")
    front = sorted((x, y) for x, y, v in zip(errors, median, variants) if v["pareto"])
    axes.plot(*zip(*front), linestyle="--", color=matplotlib.rcParams["text.color"], label="Pareto front", zorder=2)
    for k, group in enumerate(dict.fromkeys(v["group"] for v in variants)):
        rows = [i for i, v in enumerate(variants) if v["group"] == group]
        bars = [[median[i] - low[i] for i in rows], [high[i] - median[i] for i in rows]]
        axes.errorbar([errors[i] for i in rows], [median[i] for i in rows], bars, linestyle="", marker="o", markersize=6, capsize=3,
                      color=COLORS[k % len(COLORS)], label=group, zorder=3)
    draw_labels(axes, [v["name"] for v in variants], errors, median, low, high, front)
    reference = f"reference: {truth['method']}; error {truth['error']:.1e} ({truth['error_method']})"
    for line, y, size in ((study["title"], 0.963, 16), (study["setting"], 0.927, 11), (reference, 0.900, 11)):
        figure.text(left / WIDTH, y, line, fontsize=size * POINT, va="center")
    draw_legend(figure)
    return figure


def draw_study(path):
    study = json.loads(path.read_text(encoding="utf-8"))
    for theme, suffix in ((LIGHT, ".svg"), (DARK, "-dark.svg")):
        use_theme(**theme)
        save(study_figure(study), path.with_name(path.stem + suffix))


def draw_studies(args):
    for path in [args.folder / f"{name}.json" for name in args.names] or sorted(args.folder.glob("*.json")):
        try:
            draw_study(path)
        except (LookupError, TypeError, ValueError) as error:
            sys.exit(f"draw_charts.py: {path}: not the data of a study ({error!r}); expected a file written by halfspace chart")


# ---- charts of curves ----


def curve_figure(args):
    with open(args.file, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    column = lambda name: [float(row[name]) for row in rows]
    figure = new_figure(640, 400)
    axes = figure.add_subplot()
    xs = column(next(iter(rows[0])))  # the first column
    for k, (name, title) in enumerate(args.line):
        axes.plot(xs, column(name), marker="o", markerfacecolor=COLORS[k] if k == 0 else matplotlib.rcParams["axes.facecolor"], label=title)
    for name, title in args.dashed:
        axes.plot(xs, column(name), linestyle="--", label=title)
    for value, title in args.bound:
        axes.plot([xs[0], xs[-1]], [float(value)] * 2, linestyle="--", label=title)
    axes.set_ylim(bottom=0)
    finish_axes(axes, args.x_label, args.y_label, args.log_x, False)
    figure.tight_layout()
    return figure


def draw_curves(args):
    use_theme(**LIGHT)
    try:
        figure = curve_figure(args)
    except (LookupError, TypeError, ValueError) as error:
        sys.exit(f"draw_charts.py: {args.file}: cannot draw its columns ({error!r}); expected a header and rows of numbers")
    save(figure, args.file.with_suffix(".svg"))


def pair(text):
    name, sign, title = text.partition("=")
    if not sign:
        raise argparse.ArgumentTypeError(f"invalid value '{text}'; expected NAME=TITLE")
    return name, title


def main():
    parser = argparse.ArgumentParser(description="Draws charts from data files with matplotlib.")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    studies = commands.add_parser("studies", help="draw NAME.svg and NAME-dark.svg from NAME.json")
    studies.add_argument("folder", type=Path)
    studies.add_argument("names", nargs="*", metavar="NAME", help="names of studies (default: all in the folder)")
    studies.set_defaults(run=draw_studies)
    curves = commands.add_parser("curves", help="draw columns of FILE.csv against its first column, as FILE.svg")
    curves.add_argument("file", type=Path, metavar="FILE.csv")
    curves.add_argument("--x-label", required=True)
    curves.add_argument("--y-label", required=True)
    curves.add_argument("--log-x", action="store_true", help="logarithmic x axis")
    for option, text in (("--line", "COLUMN=TITLE"), ("--dashed", "COLUMN=TITLE"), ("--bound", "VALUE=TITLE")):
        curves.add_argument(option, type=pair, action="append", default=[], metavar=text)
    curves.set_defaults(run=draw_curves)
    args = parser.parse_args()
    try:
        args.run(args)
    except OSError as error:
        sys.exit(f"draw_charts.py: {error}")


if __name__ == "__main__":
    main()
