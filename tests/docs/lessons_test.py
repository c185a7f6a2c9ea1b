#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that the changes shown in the lessons apply to the programs."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts" / "docs"))
import lesson_figures  # noqa: E402
import lesson_pictures  # noqa: E402


class Lessons(unittest.TestCase):
    def test_changes_apply(self):
        for name in lesson_pictures.names():
            source = (lesson_pictures.PROGRAMS / f"{name}.cpp").read_text(encoding="utf-8")
            self.assertNotEqual(lesson_pictures.source_of(name, "solution"), source, f"{name}: no solution in solutions.md")
            self.assertNotEqual(lesson_pictures.source_of(name, "wrong"), source, f"{name}: its page shows no wrong variant")

    def test_pictures_are_small(self):
        names = lesson_pictures.names()
        images = [path for folder in (lesson_pictures.PAGES, lesson_pictures.TEACHERS) for path in (folder / "images").glob("*.png")]
        expected = [lesson_pictures.picture_path(name, variant) for name in names for variant in ("", *lesson_pictures.VARIANTS)]
        self.assertEqual(sorted(images), sorted([*expected, lesson_pictures.LINEAR]))
        self.assertLessEqual(sum(path.stat().st_size for path in images), 2_000_000)

    def test_figures_are_those_of_the_script(self):
        kept = {path.stem: path.read_text(encoding="utf-8") for path in lesson_figures.IMAGES.glob("*.svg")}
        self.assertEqual(kept, {name: draw().svg() for name, draw in lesson_figures.FIGURES.items()})
        pages = "".join(path.read_text(encoding="utf-8") for path in lesson_pictures.PAGES.glob("*.md"))
        self.assertEqual([name for name in kept if f"images/{name}.svg" not in pages], [], "no page shows these figures")

    def test_the_divided_square_of_lesson_16_is_covered_once(self):
        """The triangles have a positive area, their areas add up to 1, and each edge has as many segments as its level."""
        for outer, inner in (((4, 6, 4, 7), (7, 4)), ((1, 1, 1, 1), (2, 2)), ((3, 1, 5, 2), (2, 5))):
            triangles = lesson_figures.divided_square(outer, inner)
            areas = [(b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) for a, b, c in triangles]
            self.assertGreater(min(areas), 0)
            self.assertEqual(sum(areas), 2)  # twice the area
            points = {point for corners in triangles for point in corners}
            edges = [sum(u == 0 for u, _ in points), sum(v == 0 for _, v in points), sum(u == 1 for u, _ in points), sum(v == 1 for _, v in points)]
            self.assertEqual(tuple(count - 1 for count in edges), outer)
        # The lesson states the level and the segments of the widest circle.
        level = lesson_figures.patch_levels(lesson_figures.teapot_patch(), (0, 4, 9))[3]
        self.assertIn(f"= {level:.2f}, so it has 7 segments", (lesson_pictures.PAGES / "16.md").read_text(encoding="utf-8"))

    def test_each_page_states_what_a_student_needs(self):
        for name in lesson_pictures.names():
            page = (lesson_pictures.PAGES / f"{name[:2]}.md").read_text(encoding="utf-8")
            number = int(name[:2])
            self.assertTrue(page.startswith(f"# Lesson {number}: "), name)
            for text in ("- **Before this lesson**: ", "- **Goal**: ", "- **Time**: ", "## Break the program", "## Exercise", "Next: ["):
                self.assertIn(text, page, name)
            self.assertIn(f"halfspace check-lesson {number} lesson{name[:2]}.", page, name)

    def test_pictures_do_not_depend_on_compiler_options(self):
        """With -march=native, compilers contract a*b + c, which rounds differently. No pixel may depend on that. Lesson 3, which once did, is
        always tested; all programs without the library, also with clang++, are tested if HALFSPACE_LONG_TESTS is set."""
        every = "HALFSPACE_LONG_TESTS" in os.environ
        compilers = [name for name in (["g++", "clang++"] if every else ["c++"]) if shutil.which(name)]
        if not compilers:
            self.skipTest("no compiler was found")
        names = [name for name in lesson_pictures.names() if name[:2] in lesson_pictures.PLAIN] if every else ["03_perspective"]
        with tempfile.TemporaryDirectory() as folder:
            source, program, picture = (Path(folder) / name for name in ("lesson.cpp", "lesson", "lesson.ppm"))
            for name in names:
                for variant in ("", "solution"):
                    shutil.copyfile(lesson_pictures.PROGRAMS / f"{name}.cpp", source)
                    if variant:
                        source.write_text(lesson_pictures.source_of(name, variant), encoding="utf-8")
                    pictures = set()
                    for compiler in compilers:
                        for options in (["-O1", "-ffp-contract=off"], ["-O2", "-march=native"]):
                            subprocess.run([compiler, "-std=c++20", *options, str(source), "-o", str(program)], check=True)
                            subprocess.run([str(program), str(picture)], check=True)
                            pictures.add(picture.read_bytes())
                    self.assertEqual(len(pictures), 1, f"{name} {variant}")

    def test_the_container_has_what_the_build_needs(self):
        script = (ROOT / "scripts" / "install_deps.sh").read_text(encoding="utf-8")
        needed = re.search(r"^packages=\((.*?)\)", script, re.MULTILINE | re.DOTALL)[1].split()
        installed = (ROOT / "scripts" / "learn" / "Dockerfile").read_text(encoding="utf-8").split()
        self.assertGreater(len(needed), 10)
        self.assertEqual([package for package in needed if package not in installed], [])

    def test_solutions_are_not_in_the_folder_of_the_students(self):
        for page in lesson_pictures.PAGES.glob("*.md"):
            self.assertNotIn("teachers/images", page.read_text(encoding="utf-8"), page.name)

    def test_a_change_of_absent_or_repeated_lines_is_rejected(self):
        self.assertEqual(lesson_pictures.changed("a\n  b\nc", [(["b"], ["x", "y"])], ""), "a\nx\ny\nc")
        for text in ("a\nc", "b\nb"):
            with self.assertRaises(lesson_pictures.LessonError):
                lesson_pictures.changed(text, [(["b"], ["x"])], "")


if __name__ == "__main__":
    unittest.main()
