# SPDX-License-Identifier: Apache-2.0
"""Selects the data for the benchmark charts from the results of bench_measure.py. draw_charts.py draws them as PNG and SVG, which needs
matplotlib."""
import sys
from pathlib import Path

from bench_tables import COMPARED, intensity, sweep_series

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "docs"))
from draw_charts import COLORS, LIGHT, finish_axes, legend_beside, new_panels, save, use_theme  # noqa: E402

PROGRAM_COLORS = dict(zip(("halfspace native", "llvmpipe", "Embree", "halfspace v3", "SwiftShader"), (COLORS[k] for k in (0, 1, 2, 5, 7))))
RATIOS = (0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50)
PANEL = (624, 442)  # size in pixels


def save_both(figure, folder, name):
    figure.tight_layout()
    save(figure, folder / f"{name}.png", dpi=110)
    save(figure, folder / f"{name}.svg")


def bars(results, folder):
    """Draws the frame rate of each program relative to llvmpipe, by workload: bars above 1 are faster than llvmpipe."""
    n = results.threads
    for size in results.sizes:
        names = [w for w in COMPARED if (f"llvmpipe {n}", w, size) in results.rows]
        who = [f"halfspace native {n}", f"halfspace v3 {n}", f"SwiftShader {n}", f"Embree {n}"]
        figure, (axes,) = new_panels(1, 1248, 480)
        width = 0.8 / len(who)
        for k, contender in enumerate(who):
            found = [(i, results.ms(f"llvmpipe {n}", w, size) / results.ms(contender, w, size)) for i, w in enumerate(names) if results.ms(contender, w, size)]
            if found:
                places, ratios = [i + (k - 1.5) * width for i, _ in found], [r - 1 for _, r in found]
                axes.bar(places, ratios, width, bottom=1, label=contender, color=PROGRAM_COLORS[contender.rsplit(" ", 1)[0]])
        axes.axhline(1, color=PROGRAM_COLORS["llvmpipe"], label=f"llvmpipe {n}")
        axes.set_yscale("log")
        low, high = axes.get_ylim()
        ticks = [r for r in RATIOS if low <= r <= high]
        axes.set_yticks(ticks, [f"{r:g}" for r in ticks])
        axes.minorticks_off()
        axes.set_xticks(range(len(names)), names, rotation=45, ha="right")
        axes.set_ylabel("frame rate relative to llvmpipe")
        axes.set_title(f"{size}, {n} threads")
        legend_beside(axes)
        save_both(figure, folder, f"workloads_{size}")


def by_program(results, folder, sweep, panels, x_label, log_x=True):
    """Draws one line per program. Each panel is a tuple: (y label, function of x and ms, whether y is logarithmic)."""
    series = sweep_series(results, sweep)
    if not series:
        return
    figure, all_axes = new_panels(len(panels), *PANEL)
    for axes, (label, value, log_y) in zip(all_axes, panels):
        for (who, _), points in series.items():
            axes.plot([x for x, _ in points], [value(x, ms) for x, ms in points], marker="o", color=PROGRAM_COLORS[who], label=who)
        finish_axes(axes, x_label, label, log_x, log_y)
    save_both(figure, folder, sweep)


def by_workload(results, folder, sweep, label, value, x_label, log_x, log_y):
    """Draws one line per workload and one panel per program, with a common y axis. value: function of x, ms and the ms of the first point."""
    series = sweep_series(results, sweep)
    if not series:
        return
    programs = list(dict.fromkeys(who for who, _ in series))
    workloads = list(dict.fromkeys(workload for _, workload in series))
    figure, all_axes = new_panels(len(programs), *PANEL, sharey=True)
    for axes, program in zip(all_axes, programs):
        for (who, workload), points in series.items():
            if who == program:
                axes.plot([x for x, _ in points], [value(x, ms, points[0][1]) for x, ms in points], marker="o",
                          color=COLORS[workloads.index(workload) % len(COLORS)], label=workload)
        axes.set_title(program)
    for axes in all_axes:  # They share the y axis, whose range is known only now.
        finish_axes(axes, x_label, label, log_x, log_y)
        places = sorted({x for points in series.values() for x, _ in points})
        axes.set_xticks(places, [f"{x:g}" for x in places])
        axes.minorticks_off()
    save_both(figure, folder, sweep)


def roofline(results, folder):
    """Draws a roofline: operations per second against operations per byte written from the tile, below the FMA and memset limits."""
    n = results.threads
    for size in results.sizes:
        peak, bandwidth = results.limits.get(("fma", n)), results.limits.get((f"memset {size}", n))
        points = [(w, *found) for w in COMPARED if (found := intensity(results, w, size, n))]
        if not peak or not bandwidth or not points:
            continue
        figure, (axes,) = new_panels(1, 864, 480)
        low, high = 0.5 * min(p[1] for p in points), 4 * max(max(p[1] for p in points), peak / bandwidth)
        axes.plot([low, peak / bandwidth, high], [low * bandwidth, peak, peak], color="black", label=f"memset {bandwidth:.0f} GB/s, FMA {peak:.0f} GFLOP/s")
        for k, (workload, x, y) in enumerate(points):
            axes.plot(x, y, marker="os^Dv*P"[k % 7], linestyle="", color=COLORS[k % len(COLORS)], label=workload)
        finish_axes(axes, "operations per byte written from the tile", "GFLOP/s", True, True)
        axes.set_title(f"{size}, {n} threads, native build")
        legend_beside(axes)
        save_both(figure, folder, f"roofline_{size}")


def triangles_of_size(area):
    return max(16, min(1_000_000, int(4e6 / area)))  # must match benchmarks/workloads/sweeps.cpp


def draw_all(results, folder):
    folder.mkdir(parents=True, exist_ok=True)
    use_theme(**LIGHT)
    bars(results, folder)
    roofline(results, folder)
    pixels = 1920 * 1080
    by_program(results, folder, "triangle_size",
               [("million triangles per second, 1 thread", lambda x, ms: 1e-3 * triangles_of_size(x) / ms, True),
                ("million triangle pixels per second, 1 thread", lambda x, ms: 1e-3 * x * triangles_of_size(x) / ms, True)], "triangle area, px²")
    by_program(results, folder, "triangle_count",
               [("ms per frame at 1920x1080, 1 thread", lambda x, ms: ms, True), ("ns per triangle", lambda x, ms: 1e6 * ms / x, True)], "triangles of the sphere")
    by_program(results, folder, "overdraw", [("million quad pixels per second, 1 thread", lambda x, ms: 1e-3 * pixels * x / ms, True)],
               "full-screen quads, back to front")
    by_program(results, folder, "varyings", [("ms per frame at 1920x1080, 1 thread", lambda x, ms: ms, False)], "floats passed from vertex to fragment shader", False)
    by_workload(results, folder, "threads", "speedup over one thread", lambda x, ms, first: first / ms, "threads", False, False)
    by_workload(results, folder, "picture_size", "ns per pixel, 1 thread", lambda x, ms, first: 1e6 * ms / x**2, "picture size, px per side", True, True)
