#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests scripts/docs/draw_charts.py: what a chart shows, whether its labels are readable, and its exit codes. Needs matplotlib."""
import copy
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest
import xml.dom.minidom
from itertools import combinations
from pathlib import Path
from unittest import mock

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts" / "docs"
SKIPPED = 77  # ctest shows the test as skipped
sys.path.insert(0, str(SCRIPTS))
sys.dont_write_bytecode = True
try:
    import draw_charts
except ImportError:
    if sys.executable != "/usr/bin/python3" and os.path.exists("/usr/bin/python3"):
        os.execv("/usr/bin/python3", ["/usr/bin/python3", *sys.argv])
    print("draw_charts_test.py: skipped: matplotlib is absent (Debian and Ubuntu: python3-matplotlib)")
    sys.exit(SKIPPED)


def variant(name, group, error, ms, pareto=False):
    return {"name": name, "group": group, "error": error, "ms": {"low": 0.9 * ms, "median": ms, "high": 1.2 * ms, "runs": 9}, "pareto": pareto}


def wave_study():
    """Points on a wave, some of them close together. Texts have the maximum length allowed for studies (see study_test.cpp)."""
    variants = [variant(f"variant {i}, 16x14", f"group {i % 3}", 10 ** (-6 + 0.4 * i), 3 + 2 * math.sin(0.9 * i)) for i in range(12)]
    variants += [variant("above $x^2$", "group 1", 1.05e-6, 5.2, True), variant("low & fast", "group 2", 2e-4, 0.6, True),
                 variant("no error", "group 0", 0.0, 60, True), variant("twin", "group 0", 1e-2, 3), variant("other twin", "group 1", 1e-2, 3)]
    line = ("Averages over shadow-plane, moon (terminator), shadow-contact and shadow-knot, 480x270; " * 2)[:118]
    return {"study": "wave", "title": "A wave", "setting": line, "error_name": "RMS error", "time_name": "frame",
            "truth": {"method": line[:50], "error": 2.5e-7, "error_method": line[:39]}, "variants": variants}


def boxes_of(texts, figure):
    figure.canvas.draw()  # places the texts
    renderer = figure.canvas.get_renderer()
    return {text.get_text(): text.get_window_extent(renderer) for text in texts if text.get_text()}


class StudyChart(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        draw_charts.use_theme(**draw_charts.LIGHT)
        cls.study = wave_study()
        cls.figure = draw_charts.study_figure(cls.study)
        cls.axes = cls.figure.axes[0]

    def test_points_are_inside_the_plot_at_their_error_and_time(self):
        bounds = self.axes.get_window_extent()
        shown = [point for bar in self.axes.containers for point in zip(*bar.lines[0].get_data())]
        expected = [(max(v["error"], 2.5e-7), v["ms"]["median"]) for v in self.study["variants"]]
        self.assertEqual(sorted(shown), sorted(expected))
        for point in shown:
            self.assertTrue(bounds.contains(*self.axes.transData.transform(point)), point)

    def test_error_bars_span_the_quartiles(self):
        spans = sorted(tuple(segment[:, 1]) for bar in self.axes.containers for segment in bar.lines[2][0].get_segments())
        for (low, high), v in zip(spans, sorted(self.study["variants"], key=lambda v: v["ms"]["low"])):
            self.assertAlmostEqual(low, v["ms"]["low"])
            self.assertAlmostEqual(high, v["ms"]["high"])

    def test_front_connects_the_variants_on_it(self):
        front = next(line for line in self.axes.lines if line.get_label() == "Pareto front")
        self.assertEqual(list(zip(*front.get_data())), [(2.5e-7, 60), (1.05e-6, 5.2), (2e-4, 0.6)])
        self.assertEqual(front.get_linestyle(), "--")

    def test_labels_are_inside_the_plot_and_do_not_overlap(self):
        labels = boxes_of(self.axes.texts, self.figure)
        self.assertEqual(set(labels), {v["name"] for v in self.study["variants"]})
        bounds = self.axes.get_window_extent()
        for name, box in labels.items():
            self.assertTrue(bounds.x0 <= box.x0 and box.x1 <= bounds.x1 and bounds.y0 <= box.y0 and box.y1 <= bounds.y1, name)
        for (a, box_a), (b, box_b) in combinations(labels.items(), 2):
            self.assertFalse(box_a.overlaps(box_b), f"'{a}' covers '{b}'")

    def test_labels_do_not_cover_points_or_the_front(self):
        front = self.axes.transData.transform([(2.5e-7, 60), (1.05e-6, 5.2), (2e-4, 0.6)])
        on_front = [a + t / 200 * (b - a) for a, b in zip(front, front[1:]) for t in range(201)]
        for name, box in boxes_of(self.axes.texts, self.figure).items():
            self.assertFalse(any(box.contains(x, y) for x, y in on_front), f"'{name}' covers the front")
            for v in self.study["variants"]:
                x, y = self.axes.transData.transform((max(v["error"], 2.5e-7), v["ms"]["median"]))
                self.assertFalse(box.contains(x, y), f"'{name}' covers the point of '{v['name']}'")

    def test_titles_and_legend_are_inside_the_picture_and_do_not_overlap(self):
        texts = [*self.figure.texts, self.axes.xaxis.label, self.axes.yaxis.label, *self.figure.legends[0].get_texts()]
        boxes = boxes_of(texts, self.figure)
        self.assertLessEqual({"A wave", self.study["setting"], "RMS error", "ms, frame", "Pareto front", "group 0", "group 1", "group 2"}, set(boxes))
        for text, box in boxes.items():
            self.assertTrue(0 <= box.x0 and box.x1 <= draw_charts.WIDTH and 0 <= box.y0 and box.y1 <= draw_charts.HEIGHT, text)
        for (a, box_a), (b, box_b) in combinations(boxes.items(), 2):
            self.assertFalse(box_a.overlaps(box_b), f"'{a}' covers '{b}'")

    def test_a_long_legend_has_several_rows(self):
        study = copy.deepcopy(self.study)
        for i, v in enumerate(study["variants"]):
            v["group"] = f"group with a very long name {i % 7}"
        figure = draw_charts.study_figure(study)
        boxes = boxes_of(figure.legends[0].get_texts(), figure)
        self.assertEqual(len(boxes), 8)
        self.assertGreater(len({round(box.y0) for box in boxes.values()}), 1)
        lowest_title = boxes_of([figure.axes[0].xaxis.label], figure)["RMS error"].y0
        for text, box in boxes.items():
            self.assertTrue(0 <= box.x0 and box.x1 <= draw_charts.WIDTH and 0 <= box.y0 and box.y1 <= lowest_title, text)

    def test_ticks_name_their_values(self):
        axis = draw_charts.new_figure(300, 200).add_subplot().xaxis
        for low, high, values, labels in (
                (0.03, 3, [0.05, 0.1, 0.2, 0.5, 1, 2], ["0.05", "0.1", "0.2", "0.5", "1", "2"]),
                (2e-12, 50, [1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1], ["10⁻¹⁰", "10⁻⁸", "10⁻⁶", "10⁻⁴", "10⁻²", "10⁰"])):
            draw_charts.log_ticks(axis, low, high)
            self.assertEqual(list(axis.get_majorticklocs()), values)
            self.assertEqual([label.get_text() for label in axis.get_majorticklabels()], labels)


class Labels(unittest.TestCase):
    def test_the_least_overlap_is_chosen(self):
        room = (0, 0, 400, 300)
        self.assertEqual(draw_charts.place_labels([(200, 150)], [80], room), [(209, 150, "left", False)])
        self.assertEqual(draw_charts.place_labels([(395, 150)], [80], room), [(386, 150, "right", False)], "at the right edge")
        obstacles = [(205, 0, 400, 300), (0, 155, 400, 300), (0, 0, 195, 300)]
        (_, y, _, _), = draw_charts.place_labels([(200, 150)], [80], room, obstacles)
        self.assertLess(y, 150, "only the place below is partly free")


class Program(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        (self.folder / "wave.json").write_text(json.dumps(wave_study()))

    def run_script(self, *arguments, **environment):
        return subprocess.run([sys.executable, SCRIPTS / "draw_charts.py", *map(str, arguments)], capture_output=True, text=True,
                              env={**os.environ, **environment})

    def error_of(self, *arguments):
        """Runs the script in this process, which saves the time of starting it, and returns the message with which it exits."""
        with mock.patch.object(sys, "argv", ["draw_charts.py", *map(str, arguments)]), self.assertRaises(SystemExit) as raised:
            draw_charts.main()
        return raised.exception.code

    def test_files_hold_text_and_are_reproducible(self):
        files = [self.folder / name for name in ("wave.svg", "wave-dark.svg")]
        contents = []
        for _ in range(2):
            result = self.run_script("studies", self.folder, "wave")
            self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))
            contents.append([file.read_text() for file in files])
        self.assertEqual(contents[0], contents[1])
        for content, theme in zip(contents[0], (draw_charts.LIGHT, draw_charts.DARK)):
            document = xml.dom.minidom.parseString(content)
            texts = {node.firstChild.data for node in document.getElementsByTagName("text")}
            self.assertLessEqual({v["name"] for v in wave_study()["variants"]} | {"A wave", "Pareto front"}, texts)
            for color in theme.values():
                self.assertIn(color, content)
            self.assertLess(len(content), 60_000)

    def test_all_studies_are_drawn_by_default(self):
        (self.folder / "second.json").write_text(json.dumps(wave_study()))
        self.assertEqual(self.run_script("studies", self.folder).returncode, 0)
        self.assertEqual(len(list(self.folder.glob("*.svg"))), 4)

    def test_invalid_data_gives_a_one_line_error(self):
        incomplete = wave_study()
        del incomplete["truth"]
        for content in ("{", "[]", json.dumps(incomplete), json.dumps({**wave_study(), "variants": []})):
            with self.subTest(content=content[:20]):
                (self.folder / "wave.json").write_text(content)
                self.assertRegex(self.error_of("studies", self.folder, "wave"), r"\Adraw_charts.py: .*wave.json: not the data of a study .*\Z")
        result = self.run_script("studies", self.folder, "none")
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"^draw_charts.py: .*none.json.*\n$")

    def test_missing_matplotlib_has_its_own_exit_code(self):
        (self.folder / "matplotlib.py").write_text("raise ImportError('hidden')\n")
        result = self.run_script("studies", self.folder, PYTHONPATH=str(self.folder))
        self.assertEqual(result.returncode, 69)
        self.assertEqual(result.stderr, "draw_charts.py: matplotlib is missing (Debian and Ubuntu: python3-matplotlib)\n")

    def test_curves_show_the_columns_of_a_file(self):
        (self.folder / "data.csv").write_text("x,a,b\n1,10,5\n100,20,6\n10000,15,7\n")
        arguments = ("curves", self.folder / "data.csv", "--log-x", "--x-label", "the x", "--y-label", "the y", "--dashed", "b=second", "--bound", "18=bound")
        result = self.run_script(*arguments, "--line", "a=first=1")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        document = xml.dom.minidom.parse(str(self.folder / "data.svg"))
        texts = {node.firstChild.data for node in document.getElementsByTagName("text")}
        self.assertLessEqual({"the x", "the y", "first=1", "second", "bound", "10²"}, texts)
        result = self.run_script(*arguments, "--line", "c=third")
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"^draw_charts.py: .*data.csv: .*'c'.*\n$")


if __name__ == "__main__":
    unittest.main()
