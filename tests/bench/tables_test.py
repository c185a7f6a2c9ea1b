#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests the table values that scripts/bench/bench_tables.py produces, the rule for when it shows a ratio, and the processor names from
scripts/bench/bench_measure.py."""
import re
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts" / "bench"))
sys.dont_write_bytecode = True
import bench_measure  # noqa: E402
import bench_report  # noqa: E402
import bench_tables  # noqa: E402
import generated_sections  # noqa: E402

SIZE = "512x512"


def results(**changes):
    """Two workloads, drawn by three programs; ours takes 2 ms, and llvmpipe 8 or 18 ms."""

    def row(contender, workload, ms, threads):
        return {"contender": contender, "workload": workload, "size": SIZE, "threads": threads, "ms": ms, "ms_rounds": [ms, 2 * ms]}

    def picture(contender, workload, off, rms):
        return {"contender": contender, "workload": workload, "size": SIZE, "covered": 10000, "colors_off": off, "rms_color": rms}

    raw = {
        "machine": {"cpu": "C", "cores": 2, "system": "S", "compiler": "G", "commit": "abc", "date": "2026-01-01", "busy_before": 0.0, "busy_after": 0.1},
        "threads": 2, "rounds": 5, "seconds": 0.5, "quick": False,
        "workloads": [row(f"{who} {n}", w, ms / n, n) for who, w, ms in (
            ("halfspace native", "fill", 2.0), ("llvmpipe", "fill", 8.0), ("halfspace native", "tiny_1m", 2.0), ("llvmpipe", "tiny_1m", 18.0)) for n in (1, 2)],
        "pictures": [picture("halfspace native 1", "fill", 0, 0.25), picture("llvmpipe 1", "fill", 0, 0.25),
                     picture("halfspace native 1", "tiny_1m", 10, 0.25), picture("llvmpipe 1", "tiny_1m", 20, 0.30)],
        "limits": [{"limit": "memset 512x512", "unit": "GB/s", "value": 4.0, "threads": n} for n in (1, 2)] + [{"limit": "clock", "unit": "GHz", "value": 3.0, "threads": 1}],
        "matrix": [row(who, w, ms, 2) for who, w, ms in (("halfspace v3 2", "plain", 2.0), ("llvmpipe 2", "plain", 6.0),
                                                         ("halfspace v3 2", "srgb", 1.0), ("llvmpipe 2", "srgb", 12.0))],
        "scenes": [row(who, w, ms, 2) for who, w, ms in (("halfspace native 2", "hall", 2.0), ("llvmpipe 2", "hall", 8.0),
                                                         ("halfspace native 2", "garden", 5.0), ("llvmpipe 2", "garden", 10.0))],
        "sweeps": [{"sweep": "triangle_count", "x": x, "ms": x * 1e-5, "contender": "halfspace native 1", "workload": f"triangle_count={x}"} for x in (1e4, 1e5, 1e6)],
    }
    raw.update(changes)
    return bench_tables.Results(raw)


class Tables(unittest.TestCase):
    def test_ratio_is_the_peers_time_over_ours(self):
        self.assertAlmostEqual(results().ratio("halfspace native 1", "llvmpipe 1", "fill", SIZE), 4.0)

    def test_mean_is_geometric(self):
        r = results()
        for n in (1, 2):
            r.pictures[(f"halfspace native {n}", "fill", SIZE)] = r.pictures[("halfspace native 1", "fill", SIZE)]
            r.pictures[(f"halfspace native {n}", "tiny_1m", SIZE)] = r.pictures[("halfspace native 1", "tiny_1m", SIZE)]
        self.assertAlmostEqual(r.mean_ratio("halfspace native 1", "llvmpipe 1", SIZE), 6.0)

    def test_gaps_are_stated_beside_the_figures(self):
        r = results()
        self.assertEqual(bench_tables.gaps_line(r, 99), "")
        self.assertNotIn("**", bench_tables.sections(r)["readme"])
        r.pictures[("halfspace native 1", "tiny_1m", SIZE)]["colors_off"] = 11  # the picture no longer counts
        gaps = bench_tables.gaps_line(r, 249)
        self.assertIn("more than 200 commits", gaps)
        self.assertIn("no speedup of tiny_1m.", gaps)
        for name in ("readme", "source"):
            self.assertTrue(bench_tables.sections(r, 249)[name].endswith(f"**{gaps}**"))

    def test_documents_state_the_gaps_of_their_run(self):
        root = Path(__file__).resolve().parents[2]
        readme, page = ((root / name).read_text(encoding="utf-8") for name in bench_report.DOCUMENTS)
        commit = re.search(r"at commit (\w+)", readme)[1]
        self.assertIn(f"at commit {commit}", page)
        without = {name for name in re.findall(r"^\| (\w+) \| – ", page, re.MULTILINE)}
        for text in (readme, " ".join(page.split())):
            if bench_report.later_commits(commit) >= 100:  # 0 without a history
                self.assertIn("commits since then", text)
            for name in without:
                self.assertRegex(text, rf"no speedup of [^.]*\b{name}\b")

    def test_a_wrong_picture_has_no_ratio(self):
        r = results()
        r.pictures[("halfspace native 1", "tiny_1m", SIZE)]["colors_off"] = 11  # at most 10 of the 10,000 covered pixels may be wrong
        self.assertIsNone(r.ratio("halfspace native 1", "llvmpipe 1", "tiny_1m", SIZE))

    def test_a_picture_further_off_than_llvmpipes_has_no_ratio(self):
        r = results()
        r.pictures[("halfspace native 1", "fill", SIZE)]["rms_color"] = 0.26
        self.assertIsNone(r.ratio("halfspace native 1", "llvmpipe 1", "fill", SIZE))

    def test_share_of_the_memset(self):
        # 4 bytes for each of 262,144 pixels in 1 ms on two threads: 1.05 of 4 GB/s.
        what, reached, limit, unit = bench_tables.resource(results(), "fill", SIZE, 2)
        self.assertAlmostEqual(reached, 1.048576)
        self.assertEqual((limit, unit), (4.0, "GB/s"))

    def test_slope_of_linear_growth_is_one(self):
        self.assertAlmostEqual(bench_tables.slope([(10, 3), (100, 30), (1000, 300)]), 1.0)

    def test_other_processes_are_reported(self):
        quiet = results()
        self.assertNotIn("Other processes", bench_tables.source_line(quiet))
        quiet.raw["machine"]["busy_after"] = 0.5
        self.assertIn("Other processes kept 0.5 cores busy", bench_tables.source_line(quiet))

    def test_processors_with_the_same_name_are_distinguished(self):
        of_cores = "processor\t: 0\ncpu family\t: {}\nmodel\t\t: 17\nmodel name\t: AMD EPYC\n\nprocessor\t: 1\ncpu family\t: 9\nmodel name\t: other\n"
        self.assertEqual("AMD EPYC (family 25, model 17)", generated_sections.cpu_name(of_cores.format(25)))
        self.assertEqual("AMD EPYC (family 26, model 17)", generated_sections.cpu_name(of_cores.format(26)))
        self.assertEqual("Some core", generated_sections.cpu_name("model name : Some core\n"))

    def test_matrix_caps_ratios_in_the_mean(self):
        lines = bench_tables.state_table(results(), "matrix", "state", "plain").splitlines()
        self.assertIn("| srgb | 1.00 | 12.0 | 12.00x | 0.50x | 2.00x |", lines)
        self.assertIn("4.24x", lines[-1])  # the square root of 3 · 6, not of 3 · 12

    def test_scenes_have_no_plain_row(self):
        lines = bench_tables.state_table(results(), "scenes", "scene").splitlines()
        self.assertEqual("| scene | halfspace native, ms | llvmpipe, ms | native vs llvmpipe |", lines[0])
        self.assertIn("| garden | 5.00 | 10.0 | 2.00x |", lines)
        self.assertEqual("| **geometric mean** |  |  | 2.83x |", lines[-1])  # the square root of 4 · 2

    def test_every_section_is_generated(self):
        for name, text in bench_tables.sections(results()).items():
            self.assertTrue(text, name)
            for line in text.splitlines():
                if line.startswith("| "):
                    self.assertTrue(line.endswith(" |"), line)

    def test_documents_contain_only_known_sections(self):
        sections = {name: "new" for name in bench_tables.sections(results())}
        root = Path(__file__).resolve().parents[2]
        for name in bench_report.DOCUMENTS:
            text = (root / name).read_text()
            found = generated_sections.names(text)
            self.assertTrue(found, name)
            self.assertLessEqual(set(found), set(sections), name)
            updated = generated_sections.replaced(text, sections)
            self.assertEqual(generated_sections.names(updated), found)
            self.assertEqual(updated.count("\nnew\n"), len(found))


if __name__ == "__main__":
    unittest.main()
