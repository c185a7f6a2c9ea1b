#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the tables and charts of a benchmark run (the JSON file of bench_measure.py) to a folder, and with --docs also to the
documents."""
import argparse
import json
import shutil
import subprocess
import sys
from pathlib import Path

import bench_tables

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "docs"))
import generated_sections  # noqa: E402

DOCUMENTS = ["README.md", "docs/results/performance.md"]
CHARTS = Path("docs/results/benchmark")


def later_commits(commit):
    """The number of commits after the measured one that changed the renderer. 0 if the commit is unknown."""
    count = subprocess.run(["git", "rev-list", "--count", f"{commit.removesuffix('-dirty')}..HEAD", "--", ":/src"], capture_output=True, text=True)
    return int(count.stdout) if count.returncode == 0 else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", type=Path)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--docs", action="store_true", help="update README.md, docs/results/performance.md and docs/results/benchmark in the current folder")
    args = parser.parse_args()

    results = bench_tables.Results(json.loads(args.results.read_text()))
    sections = bench_tables.sections(results, later_commits(results.raw["machine"]["commit"]))
    args.out.mkdir(parents=True, exist_ok=True)
    shown = ("source", "means", "times", "ratios", "resources", "limits", "growth", "matrix", "scenes")
    (args.out / "tables.md").write_text("\n\n".join(sections[name] for name in shown) + "\n")
    if args.docs:
        for name in DOCUMENTS:
            text = Path(name).read_text(encoding="utf-8")
            generated_sections.update(name, {key: sections[key] for key in generated_sections.names(text)})
    try:
        import bench_charts
    except ImportError:
        print("bench_report.py: no charts, matplotlib is missing (Debian: python3-matplotlib)", file=sys.stderr)
    else:
        bench_charts.draw_all(results, args.out)
        if args.docs:  # The documents use only the PNG files.
            CHARTS.mkdir(parents=True, exist_ok=True)
            for chart in args.out.glob("*.png"):
                shutil.copy(chart, CHARTS)
    print(f"{args.out}/tables.md")


if __name__ == "__main__":
    main()
