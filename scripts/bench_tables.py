# SPDX-License-Identifier: Apache-2.0
"""Markdown tables of what bench_measure.py wrote. Standard library alone."""
import math

# The workloads that peers are compared by; the others are ours alone, and no part of the mean.
COMPARED = ["clear", "fill", "layers_b2f", "layers_f2b", *(f"sphere_{k}_{n}" for k in ("phong", "gouraud", "flat") for n in ("20k", "200k", "2m")),
            "tiny_1m", "shadow_200k", "points_100k", "hdr_200k", "tonemap"]
TRIANGLES = {"200k": 200_000, "2m": 2_000_000, "1m": 1_000_000}

# Floating-point operations of one shaded pixel, counted by hand in the shader's source (a fused multiply-add is two, a division or a root
# one): 50 for the weights of a pixel, 4 a varying, 50 for derivatives of a texture coordinate, 120 for a trilinear look-up, 105 for
# Blinn's light, 95 for Phong's, 10 a texel of the shadow map, 160 for the tone curve.
FLOPS = {"layers": 50 + 36 + 95, "sphere_phong": 50 + 32 + 50 + 120 + 105, "sphere_gouraud": 50 + 16 + 50 + 120 + 6,
         "sphere_flat": 50 + 8 + 50 + 120 + 6, "shadow": 50 + 24 + 105 + 28 + 90, "hdr": 357 + 3 + 160, "tonemap": 160, "points": 20 + 95}
# Bytes of one pixel that must leave the tile.
BYTES = {"clear": 8, "fill": 4}


class Results:
    """The numbers of one run, by what they belong to."""

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
        """Is the picture within 1/255 of double precision on 99.9% of what it covers, and no further from it than llvmpipe's?"""
        ours = self.pictures.get((contender, workload, size))
        theirs = self.pictures.get(("llvmpipe 1", workload, size))
        if not ours or ours["colors_off"] > ours["covered"] / 1000:
            return False
        # 0.002/255 is what equal pictures differ by where one rounds half a code up and the other down.
        return not theirs or (ours["colors_off"] <= theirs["colors_off"] + ours["covered"] / 1e5 and ours["rms_color"] <= theirs["rms_color"] + 0.002)

    def ratio(self, ours, theirs, workload, size):
        """How many times as long the peer takes; None where either was not measured or our picture does not count."""
        a, b = self.ms(ours, workload, size), self.ms(theirs, workload, size)
        return b / a if a and b and self.picture_counts(ours, workload, size) else None

    def mean_ratio(self, ours, theirs, size):
        found = [self.ratio(ours, theirs, w, size) for w in COMPARED]
        found = [r for r in found if r]
        return math.exp(sum(map(math.log, found)) / len(found)) if found else None


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
    rounds = f"{raw['rounds']} interleaved rounds of {raw['seconds']} s; the median of the rounds' medians" if raw["rounds"] > 1 else f"one round of {raw['seconds']} s"
    others = max(m["busy_before"], m["busy_after"])
    busy = f" **Other work ran beside it (it kept {others:.1f} cores busy): the figures are no measure of the programs.**" if others > 0.2 else ""
    return f"From the run of {m['date']}: {m['cpu']}, {m['cores']} cores, {m['system']}, {m['compiler']}, commit {m['commit']}; {rounds}.{busy}"


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
    return table([f"{size}, ms", *columns, f"rounds of native {n} over their median"], rows)


def ratio_table(results, size):
    n = results.threads
    pairs = [("native 1 : llvmpipe 1", "halfspace native 1", "llvmpipe 1"), (f"native {n} : llvmpipe {n}", f"halfspace native {n}", f"llvmpipe {n}"),
             ("v3 1 : llvmpipe 1", "halfspace v3 1", "llvmpipe 1"), (f"v3 {n} : llvmpipe {n}", f"halfspace v3 {n}", f"llvmpipe {n}"),
             (f"native {n} : SwiftShader {n}", f"halfspace native {n}", f"SwiftShader {n}"),
             (f"native {n} : Embree {n}", f"halfspace native {n}", f"Embree {n}")]
    pairs = list(dict((p[0], p) for p in pairs).values())

    def scaling(workload):
        one, all_threads = results.ms("halfspace native 1", workload, size), results.ms(f"halfspace native {n}", workload, size)
        return times(one / all_threads if one and all_threads else None)

    rows = [[w, *(times(results.ratio(a, b, w, size)) for _, a, b in pairs), scaling(w), picture(results, w, size)] for w in results.names]
    rows.append(["**geometric mean of the first 18**", *(times(results.mean_ratio(a, b, size)) for _, a, b in pairs[:5]), *([""] * (len(pairs) - 5)), "", ""])
    return table([size, *(p[0] for p in pairs), f"{n} threads : 1", "pixels off, ours / llvmpipe's"], rows)


def picture(results, workload, size):
    def off(contender):
        p = results.pictures.get((contender, workload, size))
        return f"{100 * p['colors_off'] / max(p['covered'], 1):.3f}%" if p else "–"

    return f"{off('halfspace native 1')} / {off('llvmpipe 1')}"


def covered_pixels(results, workload, size):
    return results.pictures.get(("halfspace native 1", workload, size), {}).get("covered")


def flops(workload):
    """Of a shaded pixel; None where triangles are most of the work, or the workload is not counted."""
    return None if workload.endswith("_2m") else next((count for key, count in FLOPS.items() if workload.startswith(key)), None)


def resource(results, workload, size, threads):
    """(what binds by this model, the rate reached, the limit, its unit); None where there is no model."""
    ms, covered = results.ms(f"halfspace native {threads}", workload, size), covered_pixels(results, workload, size)
    width, height = map(int, size.split("x"))
    if not ms or not covered:
        return None
    if workload in BYTES:
        return (f"{BYTES[workload]} bytes a pixel leave the tile; memset", 1e-6 * BYTES[workload] * width * height / ms,
                results.limits.get((f"memset {size}", threads)), "GB/s")
    count = flops(workload)
    return (f"{count} operations a shaded pixel; multiply-adds", 1e-6 * count * covered / ms, results.limits.get(("fma", threads)), "GFLOP/s") if count else None


def intensity(results, workload, size, threads):
    """(operations a byte that leaves the tile, GFLOP/s reached); None where operations are not counted."""
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
    return table([f"{size}, {n} threads, native", "resource", "reached", "limit", "share", "core cycles a triangle of the mesh"], rows)


def limit_table(results):
    names = list(dict.fromkeys((r["limit"], r["unit"]) for r in results.raw["limits"]))
    counts = list(dict.fromkeys((1, results.threads)))
    rows = [[name, *(number(results.limits.get((name, n))) for n in counts), unit] for name, unit in names]
    return table(["limit", *(f"{n} thread{'s' if n > 1 else ''}" for n in counts), "unit"], rows)


def slope(points):
    """Of the least-squares line through the logarithms: 1 where cost grows as the number does."""
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
    """What a triangle and a pixel cost as there are more of them. The exponent is that of the fit of cost to number: 1 where each costs the same."""
    rows = []
    for (who, _), points in sweep_series(results, "triangle_count").items():
        decades = [p for p in points if p[0] in (1e4, 1e5, 1e6, 1e7)]
        mean = ", ".join(f"{1e6 * ms / x:.1f}" for x, ms in decades)
        further = ", ".join(f"{1e6 * (b[1] - a[1]) / (b[0] - a[0]):.1f}" for a, b in zip(decades, decades[1:]))
        rows.append([who, "ns a triangle at 10^4, 10^5, 10^6, 10^7", mean, number(slope([p for p in points if p[0] >= 1e5]))])
        rows.append([who, "ns a further triangle between them", further, ""])
    for (who, workload), points in sweep_series(results, "picture_size").items():
        large = [(x, ms) for x, ms in points if x >= 512]
        costs = ", ".join(f"{1e6 * ms / x**2:.2f}" for x, ms in large)
        rows.append([f"{who}, {workload}", f"ns a pixel at {', '.join(str(int(x)) + '²' for x, _ in large)}", costs, number(slope([(x * x, ms) for x, ms in large]))])
    return table(["one thread", "cost", "values", "exponent"], rows)


def sections(results):
    """What documents show, by the name of its place."""
    by_size = lambda make: "\n\n".join(make(results, size) for size in results.sizes)
    n = results.threads
    means = " ".join(
        f"At {size} Halfspace is, in the geometric mean of the first 18 workloads, {times(results.mean_ratio(f'halfspace native {n}', f'llvmpipe {n}', size))} as fast as "
        f"llvmpipe on {n} threads (x86-64-v3 build: {times(results.mean_ratio(f'halfspace v3 {n}', f'llvmpipe {n}', size))}) and "
        f"{times(results.mean_ratio(f'halfspace native {n}', f'SwiftShader {n}', size))} as fast as SwiftShader." for size in results.sizes)
    return {
        "source": source_line(results),
        "means": means,
        "times": by_size(time_table),
        "ratios": by_size(ratio_table),
        "resources": by_size(resource_table),
        "limits": limit_table(results),
        "growth": growth_table(results),
        "readme": source_line(results) + " " + means + "\n\n" + ratio_table(results, results.sizes[0]),
    }
