#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs all studies and shadow comparisons, and updates the generated parts of docs/results/accuracy.md and docs/results/charts.

    scripts/docs/accuracy_run.py build/release/bin/halfspace [FOLDER]      run from the root of the tree; takes several minutes

With FOLDER, uses the files that an earlier run has written to that folder. The default folder is build/charts.
"""
import csv
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import generated_sections
import shadow_tables

DOC = "docs/results/accuracy.md"
# Studies that compare whole pictures have all of these (apps/study/pictures.h). They are in the data, but not in the tables.
PICTURE_MEASURES = {"rms", "mean", "p999", "max", "ssim"}


def number(x):
    return f"{x:.3g}"


def table(study):
    first = study["variants"][0]
    measures = [] if PICTURE_MEASURES <= set(first["measures"]) else list(first["measures"])
    head = ["variant", "error"] + [m.replace("_", " ") for m in measures] + ["ms", "quartiles", "front"]
    rows = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    for v in study["variants"]:
        ms = v["ms"]
        cells = [v["name"], number(v["error"])] + [number(v["measures"][m]) for m in measures]
        cells += [number(ms["median"]), number(ms["low"]) + " to " + number(ms["high"]), "yes" if v["pareto"] else ""]
        rows.append("| " + " | ".join(cells) + " |")
    truth = study["truth"]
    text = f"{study['setting']}. Error: {study['error_name']}. Time: {study['time_name']}.\n"
    text += f"Reference: {truth['method']}. Its error is {truth['error']:.1e} ({truth['error_method']}).\n\n"
    return text + "<details><summary>Table</summary>\n\n" + "\n".join(rows) + "\n\n</details>\n"


def measure(program, folder):
    subprocess.run([program, "chart", "all", "-o", folder], check=True)
    with open(os.path.join(folder, "shadows_table.csv"), "w", encoding="utf-8") as file:
        subprocess.run([program, "validate", "--table", "--size", "480x270"], check=True, stdout=file)
    Path(folder, "origin.txt").write_text(generated_sections.origin(), encoding="utf-8")


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit("usage: scripts/docs/accuracy_run.py PROGRAM [FOLDER], for example build/release/bin/halfspace")
    folder = sys.argv[2] if len(sys.argv) == 3 else "build/charts"
    if len(sys.argv) == 2:
        measure(sys.argv[1], folder)
    os.makedirs("docs/results/charts", exist_ok=True)
    sections = {}
    for section in generated_sections.names(Path(DOC).read_text(encoding="utf-8")):
        if not section.startswith("study-"):
            continue
        name = section.removeprefix("study-")
        study = json.loads(Path(folder, name + ".json").read_text(encoding="utf-8"))
        sections[section] = table(study)
        for suffix in (".svg", "-dark.svg"):
            shutil.copy(os.path.join(folder, name + suffix), "docs/results/charts")
        run = study["run"]
    with open(os.path.join(folder, "shadows_table.csv"), newline="", encoding="utf-8") as file:
        sections["shadow-tables"] = shadow_tables.markdown(csv.DictReader(file))
    sections["run"] = (f"{Path(folder, 'origin.txt').read_text(encoding='utf-8')}, with {run['threads']} threads: `{run['command']}` and "
                       f"`halfspace validate --table --size 480x270`, {run['version']}.")
    generated_sections.update(DOC, sections)


if __name__ == "__main__":
    main()
