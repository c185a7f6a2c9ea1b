# SPDX-License-Identifier: Apache-2.0
"""Charts of what bench_measure.py wrote, as PNG and SVG. Needs matplotlib."""
import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams["svg.hashsalt"] = "halfspace"  # the same picture, the same bytes
import matplotlib.pyplot as plt

from bench_tables import COMPARED, sweep_series

COLORS = {"halfspace native": "#1f6fb4", "halfspace v3": "#7fb3dc", "llvmpipe": "#d9722b", "SwiftShader": "#8a8a8a", "Embree": "#4a9a4a"}
STYLES = ["-", "--", "-.", ":", (0, (1, 2))]


def save(figure, folder, name):
    figure.tight_layout()
    figure.savefig(folder / f"{name}.png", dpi=110)
    figure.savefig(folder / f"{name}.svg", metadata={"Date": None})
    plt.close(figure)


def bars(results, folder):
    """Frames a second of each program over llvmpipe's, by workload."""
    n = results.threads
    for size in results.sizes:
        names = [w for w in COMPARED if (f"llvmpipe {n}", w, size) in results.rows]
        who = [f"halfspace native {n}", f"halfspace v3 {n}", f"SwiftShader {n}", f"Embree {n}"]
        figure, axes = plt.subplots(figsize=(12, 5))
        width = 0.8 / len(who)
        for k, contender in enumerate(who):
            at = [(i, results.ms(f"llvmpipe {n}", w, size) / results.ms(contender, w, size)) for i, w in enumerate(names) if results.ms(contender, w, size)]
            if at:
                axes.bar([i + (k - 1.5) * width for i, _ in at], [r for _, r in at], width, label=contender, color=COLORS[contender.rsplit(" ", 1)[0]])
        axes.axhline(1, color=COLORS["llvmpipe"], label=f"llvmpipe {n}")
        axes.set_yscale("log")
        axes.set_xticks(range(len(names)), names, rotation=45, ha="right")
        axes.set_ylabel("frames a second over llvmpipe's")
        axes.set_title(f"{size}, {n} threads (more is faster)")
        axes.legend(fontsize=8)
        save(figure, folder, f"workloads_{size}")


def lines(results, folder, name, sweep, panels, x_label, log_x=True):
    """One panel for each (label of y, function of x and ms, logarithmic)."""
    series = sweep_series(results, sweep)
    if not series:
        return
    workloads = list(dict.fromkeys(workload for _, workload in series))
    figure, all_axes = plt.subplots(1, len(panels), figsize=(6.5 * len(panels), 4.6), squeeze=False)
    for axes, (label, value, log_y) in zip(all_axes[0], panels):
        for (who, workload), points in series.items():
            axes.plot([x for x, _ in points], [value(x, ms, points) for x, ms in points], marker="o", markersize=3, color=COLORS[who],
                      linestyle=STYLES[workloads.index(workload) % len(STYLES)], label=f"{who} {workload}".strip())
        if log_x:
            axes.set_xscale("log")
        if log_y:
            axes.set_yscale("log")
        axes.set_xlabel(x_label)
        axes.set_ylabel(label)
        axes.grid(alpha=0.3)
        axes.legend(fontsize=7)
    save(figure, folder, name)


def triangles_of_size(area):
    return max(16, min(1_000_000, int(4e6 / area)))  # as benchmarks/sweeps.cpp has it


def draw_all(results, folder):
    folder.mkdir(parents=True, exist_ok=True)
    bars(results, folder)
    pixels = 1920 * 1080
    lines(results, folder, "triangle_size", "triangle_size",
          [("million triangles a second, 1 thread", lambda x, ms, _: 1e-3 * triangles_of_size(x) / ms, True),
           ("million pixels of triangles a second, 1 thread", lambda x, ms, _: 1e-3 * x * triangles_of_size(x) / ms, True)], "area of a triangle, px²")
    lines(results, folder, "triangle_count", "triangle_count", [("ms a frame at 1920x1080, 1 thread", lambda x, ms, _: ms, True),
          ("ns a triangle", lambda x, ms, _: 1e6 * ms / x, True)], "triangles of the sphere")
    lines(results, folder, "overdraw", "overdraw", [("million pixels of quads a second, 1 thread", lambda x, ms, _: 1e-3 * pixels * x / ms, True)],
          "quads over the whole picture, back to front")
    lines(results, folder, "varyings", "varyings", [("ms a frame at 1920x1080, 1 thread", lambda x, ms, _: ms, False)], "floats from vertex to fragment", False)
    lines(results, folder, "threads", "threads", [("times as fast as one thread", lambda x, ms, points: points[0][1] / ms, False)], "threads", False)
    lines(results, folder, "picture_size", "picture_size", [("ns a pixel, 1 thread", lambda x, ms, _: 1e6 * ms / x**2, True)], "side of the picture, px")
