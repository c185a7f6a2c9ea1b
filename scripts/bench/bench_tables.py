# SPDX-License-Identifier: Apache-2.0
"""Makes Markdown tables from the results of bench_measure.py. Needs only the standard library."""
import math

# The workloads in the geometric mean. The others are listed in the tables but are not part of the mean.
COMPARED = ["clear", "fill", "layers_b2f", "layers_f2b", *(f"sphere_{k}_{n}" for k in ("phong", "gouraud", "flat") for n in ("20k", "200k", "2m")),
            "tiny_1m", "shadow_200k", "points_100k", "hdr_200k", "tonemap"]
TRIANGLES = {"200k": 200_000, "2m": 2_000_000, "1m": 1_000_000}

# Floating-point operations per shaded pixel, counted by hand in the shader source. A fused multiply-add counts as two operations, a
# division or square root as one. The counts are 50 for the barycentric weights, 4 per varying, 50 for the derivatives of a texture
# coordinate, 120 for a trilinear lookup, 105 for Blinn-Phong lighting, 95 for Phong lighting, 10 per shadow-map texel and 160 for the tone
# curve.
FLOPS = {"layers": 50 + 36 + 95, "sphere_phong": 50 + 32 + 50 + 120 + 105, "sphere_gouraud": 50 + 16 + 50 + 120 + 6,
         "sphere_flat": 50 + 8 + 50 + 120 + 6, "shadow": 50 + 24 + 105 + 28 + 90, "hdr": 357 + 3 + 160, "tonemap": 160, "points": 20 + 95}
# Bytes per pixel that must be written from the tile to memory.
BYTES = {"clear": 8, "fill": 4}


class Results:
    """The results of one run, indexed by contender, workload and size."""

    def __init__(self, results):
        self.raw = results
        self.threads = results["threads"]
        self.rows = {(r["contender"], r["workload"], r["size"]): r for r in results["workloads"]}
        self.pictures = {(r["contender"], r["workload"], r["size"]): r for r in results["pictures"]}
        self.limits = {(r["limit"], r["threads"]): r["value"] for r in results["limits"]}
        self.sizes = list(dict.fromkeys(r["size"] for r in results["workloads"]))
        self.names = list(dict.fromkeys(r["workload"] for r in results["workloads"]))
        self.sweeps = results["sweeps"]

    def ms(self, contender, workload, size):
        row = self.rows.get((contender, workload, size))
        return row["ms"] if row else None

    def picture_counts(self, contender, workload, size):
        """Whether 99.9% of the covered pixels are within 1/255 of the reference, and the picture is as accurate as llvmpipe's."""
        ours = self.pictures.get((contender, workload, size))
        theirs = self.pictures.get(("llvmpipe 1", workload, size))
        if not ours or ours["colors_off"] > ours["covered"] / 1000:
            return False
        # Pictures that differ only in how they round values halfway between two 8-bit values differ by 0.002/255 RMS.
        return not theirs or (ours["colors_off"] <= theirs["colors_off"] + ours["covered"] / 1e5 and ours["rms_color"] <= theirs["rms_color"] + 0.002)

    def ratio(self, ours, theirs, workload, size):
        """The peer's time divided by ours; None if either was not measured or our picture is not accurate enough."""
        a, b = self.ms(ours, workload, size), self.ms(theirs, workload, size)
        return b / a if a and b and self.picture_counts(ours, workload, size) else None

    def names_without_ratio(self):
        """The workloads that we and llvmpipe drew, but not accurately enough for a ratio at any size."""
        def has_ratio(name):
            return any(self.ratio(f"halfspace native {n}", f"llvmpipe {n}", name, size) for n in (1, self.threads) for size in self.sizes)

        drawn = {w for (who, w, _) in self.rows if who.startswith("llvmpipe")}
        return [name for name in self.names if name in drawn and not has_ratio(name)]

    def mean_ratio(self, ours, theirs, size):
        found = [self.ratio(ours, theirs, w, size) for w in COMPARED]
        found = [r for r in found if r]
        return math.exp(sum(map(math.log, found)) / len(found)) if found else None


def mean_of_rows(ratios, cap):
    """The geometric mean of the rows of a table. Each row is limited to cap, so that a few easy rows do not outweigh the others."""
    return math.exp(sum(math.log(min(r, cap)) for r in ratios) / len(ratios)) if ratios else None


def number(value):
    if value is None:
        return "–"
    return f"{value:.0f}" if value >= 100 else f"{value:.1f}" if value >= 10 else f"{value:.2f}"


def times(value):
    return "–" if value is None else f"{value:.2f}x"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def source_line(results):
    m, raw = results.raw["machine"], results.raw
    rounds = (f"Times are medians over {raw['rounds']} interleaved rounds of {raw['seconds']} s; each round contributes its median frame time."
              if raw["rounds"] > 1 else f"Times are median frame times of one round of {raw['seconds']} s.")
    others = max(m["busy_before"], m["busy_after"])
    busy = f" **Other processes kept {others:.1f} cores busy during the run, so the times are not reliable.**" if others > 0.2 else ""
    return (f"Measured on {m['date']} at commit {m['commit']} on {m['cpu']}, {m['cores']} cores, {m['system']}, compiled with {m['compiler']}. "
            f"{rounds}{busy}")


def gaps_line(results, later_commits):
    """What the figures do not cover: later changes of the renderer, counted in whole hundreds of commits, and workloads without a speedup.
    Empty if they cover everything."""
    without = results.names_without_ratio()
    parts = []
    if later_commits >= 100:
        parts.append(f"The renderer has changed in more than {later_commits // 100 * 100} commits since then, which are not measured yet.")
    if without:
        parts.append(f"This run has no speedup of {', '.join(without)}.")
    return " ".join(parts)


def stamp(results):
    """The machine, date and commit of a table, as a line below it."""
    m = results.raw["machine"]
    return f"Measured on {m['cpu']}, {m['date']}, commit {m['commit']}."


def time_table(results, size):
    n = results.threads
    columns = [f"halfspace v3 1", f"halfspace v3 {n}", "halfspace native 1", f"halfspace native {n}", "llvmpipe 1", f"llvmpipe {n}",
               f"SwiftShader {n}", "Embree 1", f"Embree {n}"]
    columns = [c for c in dict.fromkeys(columns) if any((c, w, size) in results.rows for w in results.names)]
    spread_of = f"halfspace native {n}"

    def spread(workload):
        row = results.rows.get((spread_of, workload, size))
        return f"{min(row['ms_rounds']) / row['ms']:.2f} … {max(row['ms_rounds']) / row['ms']:.2f}" if row else "–"

    rows = [[w, *(number(results.ms(c, w, size)) for c in columns), spread(w)] for w in results.names]
    return table([f"{size}, ms", *columns, f"rounds of native {n} / median"], rows)


def state_table(results, key, first_column, plain=None):
    """Times of the rows of results.raw[key], and llvmpipe's times divided by ours. plain: the name of a row; if given, the table also lists
    all times relative to that row."""
    n = results.threads
    rows = {(r["workload"], r["contender"]): r["ms"] for r in results.raw.get(key, [])}
    names = list(dict.fromkeys(workload for workload, _ in rows))
    peer = f"llvmpipe {n}"
    ours = {b: f"halfspace {b} {n}" for b in ("v3", "native") if any(contender == f"halfspace {b} {n}" for _, contender in rows)}

    def ratio(a, b):
        return a / b if a and b else None

    def relative(name):
        return [times(ratio(rows.get((name, c)), rows.get((plain, c)))) for c in (*ours.values(), peer)] if plain else []

    head = [first_column, *(f"halfspace {b}, ms" for b in ours), "llvmpipe, ms", *(f"{b} vs llvmpipe" for b in ours)]
    if plain:
        head += [*(f"{b} / {plain}" for b in ours), f"llvmpipe / {plain}"]
    ratios = {name: {b: ratio(rows.get((name, peer)), rows.get((name, c))) for b, c in ours.items()} for name in names}
    lines = [[name, *(number(rows.get((name, c))) for c in (*ours.values(), peer)), *(times(r) for r in ratios[name].values()), *relative(name)]
             for name in names]
    caps = {"v3": 6, "native": 9}
    means = [times(mean_of_rows([r[b] for r in ratios.values() if r[b]], caps[b])) for b in ours]
    lines.append(["**geometric mean**", *("" for _ in ours), "", *means, *("" for _ in relative(plain))])
    return table(head, lines)


def ratio_table(results, size):
    n = results.threads
    threads = f"{n} thread{'s' if n > 1 else ''}"
    pairs = [("native vs llvmpipe, 1 thread", "halfspace native 1", "llvmpipe 1"), (f"native vs llvmpipe, {threads}", f"halfspace native {n}", f"llvmpipe {n}"),
             ("v3 vs llvmpipe, 1 thread", "halfspace v3 1", "llvmpipe 1"), (f"v3 vs llvmpipe, {threads}", f"halfspace v3 {n}", f"llvmpipe {n}"),
             (f"native vs SwiftShader, {threads}", f"halfspace native {n}", f"SwiftShader {n}"),
             (f"native vs Embree, {threads}", f"halfspace native {n}", f"Embree {n}")]
    pairs = list(dict((p[0], p) for p in pairs).values())

    def scaling(workload):
        one, all_threads = results.ms("halfspace native 1", workload, size), results.ms(f"halfspace native {n}", workload, size)
        return times(one / all_threads if one and all_threads else None)

    rows = [[w, *(times(results.ratio(a, b, w, size)) for _, a, b in pairs), scaling(w), picture(results, w, size)] for w in results.names]
    rows.append(["**geometric mean of the first 18**", *(times(results.mean_ratio(a, b, size)) for _, a, b in pairs[:5]), *([""] * (len(pairs) - 5)), "", ""])
    return table([size, *(p[0] for p in pairs), f"native, {threads} vs 1", "pixels beyond 1/255, Halfspace / llvmpipe"], rows)


def picture(results, workload, size):
    def off(contender):
        p = results.pictures.get((contender, workload, size))
        return f"{100 * p['colors_off'] / max(p['covered'], 1):.3f}%" if p else "–"

    return f"{off('halfspace native 1')} / {off('llvmpipe 1')}"


def covered_pixels(results, workload, size):
    return results.pictures.get(("halfspace native 1", workload, size), {}).get("covered")


def flops(workload):
    """Operations per shaded pixel; None if triangles are most of the work or the workload has no count."""
    return None if workload.endswith("_2m") else next((count for key, count in FLOPS.items() if workload.startswith(key)), None)


def resource(results, workload, size, threads):
    """(limiting resource in this model, rate reached, limit, unit); None if the workload has no model."""
    ms, covered = results.ms(f"halfspace native {threads}", workload, size), covered_pixels(results, workload, size)
    width, height = map(int, size.split("x"))
    if not ms or not covered:
        return None
    if workload in BYTES:
        return (f"memory: {BYTES[workload]} bytes written per pixel", 1e-6 * BYTES[workload] * width * height / ms,
                results.limits.get((f"memset {size}", threads)), "GB/s")
    count = flops(workload)
    return (f"arithmetic: {count} operations per shaded pixel", 1e-6 * count * covered / ms, results.limits.get(("fma", threads)), "GFLOP/s") if count else None


def intensity(results, workload, size, threads):
    """(operations per byte written from the tile, GFLOP/s reached); None if the workload has no operation count."""
    ms, covered, count = results.ms(f"halfspace native {threads}", workload, size), covered_pixels(results, workload, size), flops(workload)
    width, height = map(int, size.split("x"))
    written = {"tonemap": 4, "hdr_200k": 16}.get(workload, 8) * width * height
    return (count * covered / written, 1e-6 * count * covered / ms) if ms and covered and count else None


def resource_table(results, size):
    rows = []
    n = results.threads
    clock = results.limits.get(("clock", 1), 0)
    for w in results.names:
        ms = results.ms(f"halfspace native {n}", w, size)
        triangles = next((count for key, count in TRIANGLES.items() if w.endswith("_" + key) and w.startswith(("sphere", "tiny"))), None)
        cycles = f"{ms * 1e6 * clock * n / triangles:.0f}" if ms and triangles else "–"
        found = resource(results, w, size, n)
        if found and found[2]:
            what, reached, limit, unit = found
            rows.append([w, what, f"{reached:.1f} {unit}", f"{limit:.1f} {unit}", f"{100 * reached / limit:.0f}%", cycles])
        elif triangles:
            rows.append([w, "triangles", "–", "–", "–", cycles])
    return table([f"{size}, {n} threads, native", "resource", "reached", "limit", "share", "core cycles per triangle"], rows)


def limit_table(results):
    names = list(dict.fromkeys((r["limit"], r["unit"]) for r in results.raw["limits"]))
    counts = list(dict.fromkeys((1, results.threads)))
    rows = [[name, *(number(results.limits.get((name, n))) for n in counts), unit] for name, unit in names]
    return table(["limit", *(f"{n} thread{'s' if n > 1 else ''}" for n in counts), "unit"], rows)


def slope(points):
    """Slope of the least-squares line through the logarithms: 1 if the cost is proportional to the count."""
    if len(points) < 2:
        return None
    x, y = [math.log(p[0]) for p in points], [math.log(p[1]) for p in points]
    mx, my = sum(x) / len(x), sum(y) / len(y)
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)


def sweep_series(results, sweep):
    """{contender or (contender, workload): [(x, ms)]} of one sweep."""
    series = {}
    for row in results.sweeps:
        if row["sweep"] == sweep:
            named = sweep in ("threads", "picture_size")
            kind = row["contender"].rsplit(" ", 1)[0]
            series.setdefault((kind, row["workload"] if named else ""), []).append((row["x"], row["ms"]))
    return {key: sorted(points) for key, points in series.items()}


def growth_table(results):
    """The cost per triangle and per pixel as their number grows. The exponent is slope(): 1 if the total cost is proportional to the
    count."""
    rows = []
    for (who, _), points in sweep_series(results, "triangle_count").items():
        decades = [p for p in points if p[0] in (1e4, 1e5, 1e6, 1e7)]
        mean = ", ".join(f"{1e6 * ms / x:.1f}" for x, ms in decades)
        further = ", ".join(f"{1e6 * (b[1] - a[1]) / (b[0] - a[0]):.1f}" for a, b in zip(decades, decades[1:]))
        rows.append([who, "ns per triangle at 10^4, 10^5, 10^6, 10^7", mean, number(slope([p for p in points if p[0] >= 1e5]))])
        rows.append([who, "ns per additional triangle between these counts", further, ""])
    for (who, workload), points in sweep_series(results, "picture_size").items():
        large = [(x, ms) for x, ms in points if x >= 512]
        costs = ", ".join(f"{1e6 * ms / x**2:.2f}" for x, ms in large)
        rows.append([f"{who}, {workload}", f"ns per pixel at {', '.join(str(int(x)) + '²' for x, _ in large)}", costs, number(slope([(x * x, ms) for x, ms in large]))])
    return table(["one thread", "cost", "values", "exponent"], rows)


def sections(results, later_commits=0):
    """The generated sections of the documents, by the name in their markers. later_commits: number of commits after the measured one that
    changed the renderer."""
    gaps = gaps_line(results, later_commits)
    source = source_line(results) + (f" **{gaps}**" if gaps else "")
    stamped = lambda text: f"{text}\n\n{stamp(results)}"
    by_size = lambda make: stamped("\n\n".join(make(results, size) for size in results.sizes))

    def states(key, *columns):
        if not results.raw.get(key):
            return ""
        return stamped(state_table(results, key, *columns))

    n = results.threads
    means = "Speedup on {} thread{}, geometric mean of 18 workloads: {}.".format(n, "s" if n > 1 else "", "; ".join(
        f"at {size}, {times(results.mean_ratio(f'halfspace native {n}', f'llvmpipe {n}', size))} over llvmpipe "
        f"({times(results.mean_ratio(f'halfspace v3 {n}', f'llvmpipe {n}', size))} with the x86-64-v3 build) and "
        f"{times(results.mean_ratio(f'halfspace native {n}', f'SwiftShader {n}', size))} over SwiftShader" for size in results.sizes))
    return {
        "source": source,
        "means": means,
        "times": by_size(time_table),
        "ratios": by_size(ratio_table),
        "resources": by_size(resource_table),
        "limits": stamped(limit_table(results)),
        "growth": stamped(growth_table(results)),
        "matrix": states("matrix", "state", "plain"),
        "scenes": states("scenes", "scene and camera"),
        "readme": means + "\n\n" + source,
    }
