#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the stability tests and writes their results to docs/explanation/stability.md.

    scripts/docs/stability_table.py build/release/bin/test-stability      from the root of the source tree
"""
import os
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

import generated_sections

HEAD = """# Stability where methods fail

Each row is a known failure mode of renderers. The test runs the common method under conditions in which it should fail, and checks that it
does fail. It then runs our method under the same conditions and compares its error with a bound. The sources in `tests/stability` give the
reason for each bound. The columns "common" and "ours" contain the measured errors; 0 is correct.
`scripts/docs/stability_table.py build/release/bin/test-stability` generates the table.

{origin}.

| row | failure | conditions; common method vs. ours | error | common | ours | bound | test |
|---|---|---|---|---|---|---|---|
"""


def properties_of(case):
    return {p.get("name"): p.get("value") for p in case.iter("property")}


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: scripts/docs/stability_table.py PROGRAM, for example build/release/bin/test-stability")
    with tempfile.TemporaryDirectory() as folder:
        report = os.path.join(folder, "report.xml")
        run = subprocess.run([sys.argv[1], "--gtest_filter=Stability.*", "--gtest_output=xml:" + report], stdout=subprocess.PIPE, text=True)
        if run.returncode != 0:
            sys.exit(run.stdout + "stability_table.py: tests failed; the table is unchanged")
        cases = xml.etree.ElementTree.parse(report).getroot().iter("testcase")
        rows = [(int(p["row"]), case.get("name"), p) for case in cases for p in [properties_of(case)]]
    text = HEAD.format(origin=generated_sections.origin())
    for row, name, p in sorted(rows, key=lambda r: r[0]):
        text += f"| {row} | {p['failure']} | {p['regime']} | {p['number']} | {p['common']} | {p['ours']} | {p['bound']} | `Stability.{name}` |\n"
    with open("docs/explanation/stability.md", "w", encoding="utf-8") as file:
        file.write(text)
    print(f"docs/explanation/stability.md: {len(rows)} tests, rows {sorted({r[0] for r in rows})}")


if __name__ == "__main__":
    main()
