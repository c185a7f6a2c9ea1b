#!/usr/bin/env python3
"""Runs the stability tests and writes docs/stability.md from what they found.

    scripts/stability_table.py build/release/bin/test-stability      from the root of the tree
"""
import os
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

HEAD = """# Stability where methods fail

Every row is a known failure of renderers. A test draws it in the regime where the plain method fails, asserts that the plain method is
wrong there (so the test looks in the right place), and holds ours to a bound whose reason stands beside it in `tests/stability`. 0 is
right in every column of numbers. This table is made by the run: `scripts/stability_table.py build/release/bin/test-stability`.

| row | failure | regime; plain method against ours | number | plain | ours | bound | test |
|---|---|---|---|---|---|---|---|
"""


def properties_of(case):
    return {p.get("name"): p.get("value") for p in case.iter("property")}


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: scripts/stability_table.py PROGRAM, for example build/release/bin/test-stability")
    with tempfile.TemporaryDirectory() as folder:
        report = os.path.join(folder, "report.xml")
        run = subprocess.run([sys.argv[1], "--gtest_filter=Stability.*", "--gtest_output=xml:" + report], stdout=subprocess.PIPE, text=True)
        if run.returncode != 0:
            sys.exit(run.stdout + "stability_table.py: tests failed; the table is left as it is")
        cases = xml.etree.ElementTree.parse(report).getroot().iter("testcase")
        rows = [(int(p["row"]), case.get("name"), p) for case in cases for p in [properties_of(case)]]
    text = HEAD
    for row, name, p in sorted(rows, key=lambda r: r[0]):
        text += f"| {row} | {p['failure']} | {p['regime']} | {p['number']} | {p['plain']} | {p['ours']} | {p['bound']} | `Stability.{name}` |\n"
    with open("docs/stability.md", "w", encoding="utf-8") as file:
        file.write(text)
    print(f"docs/stability.md: {len(rows)} tests, rows {sorted({r[0] for r in rows})}")


if __name__ == "__main__":
    main()
