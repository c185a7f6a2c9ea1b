#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that the changes shown in the lessons apply to the programs."""

import sys
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

    def test_each_page_states_what_a_student_needs(self):
        for name in lesson_pictures.names():
            page = (lesson_pictures.PAGES / f"{name[:2]}.md").read_text(encoding="utf-8")
            for text in (f"# Lesson {int(name[:2])}: ", "- **Before this lesson**: ", "- **Goal**: ", "- **Time**: ", "## Break the program", "## Exercise", "Next: [", f"check-lesson {int(name[:2])} lesson{name[:2]}."):
                self.assertIn(text, page, name)

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
