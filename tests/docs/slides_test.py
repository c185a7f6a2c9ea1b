#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests scripts/docs/slides.py: what the decks of the lessons contain, whether it fits on the slides, and the messages of the script."""

import math
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "scripts" / "docs" / "slides.py"
sys.path.insert(0, str(SCRIPT.parent))
sys.dont_write_bytecode = True
import slides  # noqa: E402

PAGES = {path.name: path.read_text(encoding="utf-8") for path in sorted(slides.PAGES.glob("[0-9][0-9].md"))}
# Words in the alternative text of a picture that Marp takes as filters.
FILTERS = {"blur", "brightness", "contrast", "drop-shadow", "grayscale", "hue-rotate", "invert", "opacity", "saturate", "sepia"}
# Pixels of a slide between its upper and lower margin: 720 - 2 * 48.
HEIGHT = 624


def run(*arguments, **options):
    return subprocess.run([sys.executable, str(SCRIPT), *arguments], capture_output=True, text=True, check=False, **options)


def without_links(text):
    return " ".join(re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", text).split())


def pixels(slide):
    """Returns the height of a slide's text with the sizes in the deck's style. A line is 1112 pixels wide, and 600 on the title slide, where the
    picture is beside it. A character takes 15 pixels, as in a wide font. Code does not wrap."""
    width, total, in_code = (600 if slide.startswith("![bg") else 1112), 0, False
    for line in slide.splitlines():
        if line.startswith("```"):
            in_code = not in_code
            total += 19  # half of margin, padding and border
        elif in_code:
            total += 28
        elif line.startswith("# "):
            total += 54 * math.ceil(len(line) * 26 / width) + 20
        elif line.startswith("## "):
            total += 44 + 20
        elif line.startswith("!["):
            total += 0 if "![bg" in line else 8 + (400 if ".svg)" in line else 240)
        elif line.startswith("|"):
            total += 0 if set(line) <= set("|-:") else 26 * math.ceil(len(line) * 11 / 1152) + 13
        elif line:
            total += 36 * math.ceil(len(line) * 15 / width) + 6
    return total


class Decks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.out = Path(cls.folder.name) / "new" / "slides"
        cls.result = run(str(cls.out))
        cls.decks = {path.name: path.read_text(encoding="utf-8") for path in sorted(cls.out.glob("*.md"))}

    def slides_of(self, name):
        front, text = re.fullmatch(r"---\n(.*?)\n---\n\n(.*)", self.decks[name], re.DOTALL).groups()
        self.assertIn("marp: true", front)
        return text.split("\n---\n\n")

    def test_every_lesson_gives_a_deck(self):
        self.assertEqual((self.result.returncode, self.result.stderr), (0, ""))
        self.assertEqual(len(PAGES), 24)
        self.assertEqual(list(self.decks), list(PAGES))

    def test_the_title_slide_has_goal_prerequisites_and_time(self):
        for name, page in PAGES.items():
            title = self.slides_of(name)[0]
            self.assertIn(page.splitlines()[0] + "\n", title)
            for text in ("**Before this lesson**: ", "**Goal**: ", "**Time**: "):
                self.assertIn(text, title, name)

    def test_pictures_of_the_page_are_shown_and_exist(self):
        for name, page in PAGES.items():
            shown = re.findall(r"!\[([^]]*)\]\(([^)]+)\)", self.decks[name])
            self.assertEqual([image for _, image in shown], re.findall(r"!\[[^]]*\]\(([^)]+)\)", page), name)
            for words, image in shown:
                self.assertTrue((self.out / image).is_file(), f"{name}: {image}")
                self.assertEqual(FILTERS & set(words.split()), set(), f"{name}: {image}: Marp would change the picture")

    def test_formulas_code_and_tables_are_shown(self):
        for name, page in PAGES.items():
            code = "\n".join(re.findall(r"^```\w*\n(.*?)\n```$", page, re.MULTILINE | re.DOTALL))
            lines = code.splitlines() + re.findall(r"^(?:    )?(\S.*)$", "\n".join(re.findall(r"^(?:    |\|).*$", page, re.MULTILINE)), re.MULTILINE)
            self.assertGreater(len(lines), 0, name)
            for line in lines:
                self.assertIn(line, self.decks[name], name)

    def test_the_exercise_is_shown_as_a_whole(self):
        for name, page in PAGES.items():
            exercise = re.search(r"^## Exercise\n(.*?)(?=^## |^Next: )", page, re.MULTILINE | re.DOTALL)[1]
            text = without_links(re.sub(r"<!--.*?-->|^```$", "", exercise, flags=re.MULTILINE)).replace("```", "")
            shown = [slide.partition("\n")[2] for slide in self.slides_of(name) if slide.startswith("## Exercise\n")]
            self.assertEqual(" ".join(re.sub(r"```(text)?", "", " ".join(shown)).split()), " ".join(text.split()), name)

    def test_all_text_is_that_of_the_page(self):
        for name, page in PAGES.items():
            self.assertNotRegex(self.decks[name], r"\]\([^)\s]*\.md", f"{name}: a link to a document that is not beside the deck")
            text = without_links(re.sub(r"\*\*(.+?)[.]?\*\* ", r"\1 ", page))
            for line in "\n".join(self.slides_of(name)).splitlines():
                if line.startswith("![bg"):
                    continue
                words = without_links(re.sub(r"^\s*(- |\d+\. |#+ )|^```\w*$", "", re.sub(r"\*\*(.+?)\*\*( |$)", r"\1\2", line)))
                self.assertIn(words, text, f"{name}: {line}")

    def test_every_slide_fits(self):
        for name in PAGES:
            for slide in self.slides_of(name):
                self.assertLessEqual(pixels(slide), HEIGHT, f"{name}: {slide}")
                self.assertGreater(len(slide.strip().splitlines()), 1, f"{name}: only a heading")

    def test_solutions_are_not_shown(self):
        solutions = (ROOT / "docs" / "teachers" / "solutions.md").read_text(encoding="utf-8")
        count = 0
        for part in re.split(r"^## Lesson ", solutions, flags=re.MULTILINE)[1:]:
            name, pieces = f"{int(part.split()[0]):02}.md", re.split(r"^```\w*$", part.partition("\n")[2], flags=re.MULTILINE)
            code = [line[1:].strip() for piece in pieces[1::2] for line in piece.splitlines() if line.startswith("+")]
            removed = {line[1:].strip() for piece in pieces[1::2] for line in piece.splitlines() if line.startswith("-")}
            answers = [sentence for piece in pieces[0::2] for sentence in slides.sentences(" ".join(piece.split()))]
            for text in [line for line in code if line not in removed] + answers:
                if len(text) > 20:  # shorter lines, such as a brace, say nothing
                    self.assertNotIn(text, self.decks[name], name)
                    count += 1
        self.assertGreater(count, 100, "found too few lines: the parser must be wrong")


class Text(unittest.TestCase):
    def test_key_sentences(self):
        text = "The first is kept. It is dropped. Consider 1, 2 and 3. The sum is 6. Nothing follows. The formula is"
        self.assertEqual(slides.key_sentences(text, True), ["The first is kept.", "Consider 1, 2 and 3.", "The sum is 6.", "The formula is"])
        self.assertEqual(slides.key_sentences("A is first. B is second. (They meet at a = 2.5 and b = 3.)", False),
                         ["A is first.", "B is second.", "(They meet at a = 2.5 and b = 3.)"])

    def test_numbers_of_lessons_are_no_worked_numbers(self):
        self.assertEqual(slides.numbers_in("As in lessons 1, 2 and 3, and in lesson 4."), 0)
        self.assertEqual(slides.numbers_in("1,776 vertices of 2.5"), 2)

    def test_links_to_documents_become_text(self):
        self.assertEqual(slides.plain("[a\n  b](../c.md) [d](https://e.f) ![g](h.png)"), "a\n  b [d](https://e.f) ![g](h.png)")


class Messages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def check(self, result, code, words):
        self.assertEqual(result.returncode, code)
        self.assertEqual(result.stdout, "")
        self.assertRegex(result.stderr, rf"\Aslides\.py: .*{words}.*\n\Z")

    def test_wrong_arguments(self):
        self.check(run("--pdf"), 2, r"unknown option '--pdf'; expected \[FOLDER\] \[--html\]")
        self.check(run("a", "b"), 2, "2 folders; expected")

    def test_a_file_in_place_of_the_folder(self):
        (self.folder / "file").write_text("kept")
        self.check(run(str(self.folder / "file")), 1, "file: .*; expected a folder that can be written")
        self.assertEqual((self.folder / "file").read_text(), "kept")

    def test_the_lessons_are_not_overwritten(self):
        self.check(run(str(slides.PAGES)), 1, "expected another folder")
        self.assertEqual({name: (slides.PAGES / name).read_text(encoding="utf-8") for name in PAGES}, PAGES)

    def test_marp_converts_all_decks(self):
        program = self.folder / "marp"
        program.write_text('#!/bin/sh\n[ "$1" = --version ] || echo "$@" > "$0.log"\n')
        program.chmod(0o755)
        environment = {**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}"}
        self.assertEqual(run(str(self.folder / "out"), "--html", env=environment).returncode, 0)
        self.assertEqual((self.folder / "marp.log").read_text().split(), ["--no-stdin", *[str(self.folder / "out" / name) for name in PAGES]])
        program.write_text('#!/bin/sh\n[ "$1" = --version ] || { echo "no browser" >&2; exit 1; }\n')
        self.check(run(str(self.folder / "out"), "--html", env=environment), 1, "Marp failed: no browser")

    def test_without_marp_the_message_says_what_to_install(self):
        self.check(run(str(self.folder / "out"), "--html", env={"PATH": str(self.folder)}), 1, "npm install -g @marp-team/marp-cli")
        self.assertFalse((self.folder / "out").exists())

    def test_a_page_that_does_not_fit_is_named_and_nothing_is_written(self):
        head = "# Lesson 1: A\n\n![A](a.png)\n\n- **Goal**: b\n\n"
        for text, message in (("No heading.\n", "expected a heading, a picture, and a list"),
                              (head + "```cpp\nline\n", "begins with '```cpp' but has no end"),
                              (head + "## Code\n\n```\n" + "line\n" * 40 + "```\n", "section 'Code': 'line' needs 33.1 lines; a slide has 15"),
                              (head.replace("b", "word " * 200) + "Text.\n", "the list at the top needs"),
                              (head + "Text.\n", "the picture a.png does not exist")):
            (self.folder / "01.md").write_text(text)
            with mock.patch.multiple(slides, PAGES=self.folder, ROOT=self.folder), self.assertRaisesRegex(slides.SlideError, f"01.md.*{message}"):
                slides.write_decks(self.folder / "out")
            self.assertFalse((self.folder / "out").exists())


if __name__ == "__main__":
    unittest.main()
