#!/usr/bin/env python3
"""Runs all studies and updates the generated parts of docs/results/accuracy.md (the run and the tables) and docs/results/charts.

    scripts/accuracy_run.py build/release/bin/halfspace [FOLDER]      run from the root of the tree; takes several minutes

With FOLDER, uses the files that an earlier `halfspace chart all -o FOLDER` has written there.
"""
import json
import os
import re
import shutil
import subprocess
import sys

DOC = "docs/results/accuracy.md"


def number(x):
    return f"{x:.3g}"


def table(study):
    first = study["variants"][0]
    measures = list(first["measures"]) if len(first["measures"]) <= 3 else []
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


def replaced(text, name, content):
    pattern = re.compile(rf"(<!-- {name} -->\n).*?(<!-- end -->)", re.S)
    if not pattern.search(text):
        sys.exit(f"{DOC}: the marker <!-- {name} --> is missing")
    return pattern.sub(lambda m: m.group(1) + content + m.group(2), text)


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit("usage: scripts/accuracy_run.py PROGRAM [FOLDER], for example build/release/bin/halfspace")
    folder = sys.argv[2] if len(sys.argv) == 3 else "build/charts"
    if len(sys.argv) == 2:
        subprocess.run([sys.argv[1], "chart", "all", "-o", folder], check=True)
    os.makedirs("docs/results/charts", exist_ok=True)
    with open(DOC, encoding="utf-8") as file:
        text = file.read()
    for name in re.findall(r"<!-- study (\w+) -->", text):
        with open(os.path.join(folder, name + ".json"), encoding="utf-8") as file:
            study = json.load(file)
        text = replaced(text, f"study {name}", table(study))
        for suffix in (".svg", "-dark.svg"):
            shutil.copy(os.path.join(folder, name + suffix), "docs/results/charts")
        run = study["run"]
    text = replaced(text, "run", f"`{run['command']}`, {run['date']}, {run['processor']}, {run['cores']} cores, {run['threads']} threads, "
                    f"{run['version']}.\n")
    with open(DOC, "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    main()
