# SPDX-License-Identifier: Apache-2.0
"""Creates the shadow tables of docs/results/accuracy.md from the CSV output of `halfspace validate --table`. See accuracy_run.py."""

TITLES = {
    "bias": ("bias (pcf3, 2048)", "bias"),
    "filter": ("filter (auto, 2048)", "method"),
    "resolution": ("resolution (pcf3, auto)", "resolution"),
    "angle": ("angle of the light from the vertical, degrees", "angle"),
}


def beyond_one_texel(row, kind):
    return 100 * (float(row[kind + "_1_to_3"]) + float(row[kind + "_beyond_3"]))


def tables(rows):
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    for factor, (title, column) in TITLES.items():
        of_factor = [row for row in rows if row["factor"] == factor]
        timed = factor != "angle"
        head = [title, *scenes, "mean error"] + (["map, ms", "lookup, ms"] if timed else [])
        yield "| " + " | ".join(head) + " |\n" + "|---" * len(head) + "|\n"
        for value in dict.fromkeys(row[column] for row in of_factor):
            group = [row for row in of_factor if row[column] == value]
            cells = [f"{beyond_one_texel(r, 'false_shadow'):.3f} / {beyond_one_texel(r, 'false_light'):.3f}" for r in group]
            mean = lambda key: sum(float(r[key]) for r in group) / len(group)
            cells.append(f"{mean('error'):.4f}")
            if timed:
                cells += [f"{mean('map_ms'):.1f}", f"{mean('lookup_ms'):.1f}"]
            yield "| " + " | ".join([value, *cells]) + " |\n"
        yield "\n"


def markdown(rows):
    return "".join(tables(list(rows)))
