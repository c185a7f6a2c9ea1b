#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that the changes shown in the lessons apply to the programs."""

import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts" / "docs"))
import lesson_pictures  # noqa: E402


class Lessons(unittest.TestCase):
    def test_changes_apply(self):
        for name in lesson_pictures.names():
            source = (lesson_pictures.PROGRAMS / f"{name}.cpp").read_text(encoding="utf-8")
            self.assertNotEqual(lesson_pictures.source_of(name, "solution"), source, f"{name}: no solution in teachers.md")
            self.assertNotEqual(lesson_pictures.source_of(name, "wrong"), source, f"{name}: its page shows no wrong variant")

    def test_pictures_are_small(self):
        images = list((lesson_pictures.PAGES / "images").glob("*.png"))
        self.assertEqual(len(images), 42)
        self.assertLessEqual(sum(path.stat().st_size for path in images), 1_000_000)

    def test_a_change_of_absent_or_repeated_lines_is_rejected(self):
        self.assertEqual(lesson_pictures.changed("a\n  b\nc", [(["b"], ["x", "y"])], ""), "a\nx\ny\nc")
        for text in ("a\nc", "b\nb"):
            with self.assertRaises(lesson_pictures.LessonError):
                lesson_pictures.changed(text, [(["b"], ["x"])], "")


if __name__ == "__main__":
    unittest.main()
