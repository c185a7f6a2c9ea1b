#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the pictures of the lessons, and applies the changes that the lessons show to their programs.

  scripts/docs/lesson_pictures.py draw BUILD            builds and runs all programs and variants, and writes their pictures with `convert` of
                                                   ImageMagick: those of solutions to docs/teachers/images, and
                                                   all others to docs/tutorial/lessons/images
  scripts/docs/lesson_pictures.py check BUILD           the same, but compares with the existing pictures, with `halfspace compare`
  scripts/docs/lesson_pictures.py write NAME VARIANT OUT  writes the source of one variant; CMake calls this

A lesson shows changes to its program as diff blocks: "wrong" is the block in the section "Break the program" of the lesson, and
"solution" is the block of the lesson in docs/teachers/solutions.md. The old lines of a change must occur exactly once in the program, apart from their
indentation. linear.png is the picture of lesson 12 with rgba8_target instead of srgb8a8_target, made by hand.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAMS = ROOT / "apps" / "lessons"
PAGES = ROOT / "docs" / "tutorial" / "lessons"
TEACHERS = ROOT / "docs" / "teachers"
VARIANTS = ("wrong", "solution")
LINEAR = PAGES / "images" / "linear.png"  # lesson 12 with a target that does not encode
PLAIN = ("01", "02", "03", "04", "05", "24")  # these lessons do not use the library, and write PPM


class LessonError(Exception):
    """A change that cannot be applied."""


def names():
    return [path.stem for path in sorted(PROGRAMS.glob("*.cpp"))]


def section(text, title):
    """Returns the text from a heading of level 2 to the next one."""
    match = re.search(rf"^## {re.escape(title)}\n(.*?)(?=^## |\Z)", text, re.MULTILINE | re.DOTALL)
    return match.group(1) if match else ""


def change_of(name, variant):
    """Returns the hunks of a variant as pairs (old lines, new lines), or an empty list if the lesson has no such variant."""
    number = name[:2]
    if variant == "wrong":
        text = section((PAGES / f"{number}.md").read_text(encoding="utf-8"), "Break the program")
    else:
        text = section((TEACHERS / "solutions.md").read_text(encoding="utf-8"), f"Lesson {int(number)}")
    block = re.search(r"^```diff\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    hunks, old, new = [], [], []
    for line in block.group(1).splitlines() if block else []:
        if line.startswith("-") and new:
            hunks.append((old, new))
            old, new = [], []
        (old if line.startswith("-") else new).append(line[1:])
    return hunks + ([(old, new)] if old else [])


def changed(source, hunks, name):
    """Returns the source with the hunks applied."""
    lines = source.split("\n")
    for old, new in hunks:
        wanted = [line.strip() for line in old]
        places = [i for i in range(len(lines)) if [line.strip() for line in lines[i : i + len(old)]] == wanted]
        if len(places) != 1:
            raise LessonError(f"{name}: '{wanted[0]}' occurs {len(places)} times, expected once")
        lines[places[0] : places[0] + len(old)] = new
    return "\n".join(lines)


def source_of(name, variant):
    source = (PROGRAMS / f"{name}.cpp").read_text(encoding="utf-8")
    return changed(source, change_of(name, variant), f"{name}, {variant}")


def write_png(picture, out):
    """Converts a picture of a program to PNG without changing its pixels."""
    subprocess.run(["convert", str(picture), "-strip", "-define", "png:compression-level=9", f"png:{out}"], check=True)


def picture_path(name, variant):
    """Returns the file of the picture of a program ("") or of one of its variants."""
    if variant == "solution":
        return TEACHERS / "images" / f"{name[:2]}.png"
    return PAGES / "images" / (f"{name[:2]}-{variant}.png" if variant else f"{name[:2]}.png")


def pictures(build):
    """Builds and runs all programs and variants. Yields the path of each picture in the documents and the file that the program wrote."""
    subprocess.run(["cmake", "--build", str(build), "--target", "lessons", "lesson-variants", "halfspace"], check=True, stdout=subprocess.DEVNULL)
    with tempfile.TemporaryDirectory() as temporary:
        for name in names():
            for variant in ("", *VARIANTS):
                if variant and not change_of(name, variant):
                    continue
                program = build / "bin" / (f"lesson-{name}-{variant}" if variant else f"lesson-{name}")
                picture = Path(temporary) / ("picture.ppm" if name[:2] in PLAIN else "picture.png")
                # The lessons that measure times fail if their images differ, which is expected of wrong variants.
                run = subprocess.run([str(program), str(picture)], stdout=subprocess.DEVNULL, check=False)
                if run.returncode != 0 and variant != "wrong":
                    raise LessonError(f"{program.name} failed")
                yield picture_path(name, variant), picture


def draw(build):
    for kept, picture in pictures(build):
        write_png(picture, kept)


def check(build):
    for kept, picture in pictures(build):
        if kept.name == "13-wrong.png":  # its blocks are as wide as a register
            continue
        compare = [str(build / "bin" / "halfspace"), "compare", str(picture), str(kept), "--tolerance", "0"]
        result = subprocess.run(compare, capture_output=True, text=True, check=False)
        if result.returncode != 0:
            raise LessonError(f"{kept.relative_to(ROOT)} is not what the program draws. {result.stderr.strip()}")


def main(arguments):
    try:
        if len(arguments) == 4 and arguments[0] == "write" and arguments[2] in VARIANTS:
            Path(arguments[3]).write_text(source_of(arguments[1], arguments[2]), encoding="utf-8")
        elif len(arguments) == 2 and arguments[0] == "draw":
            draw(Path(arguments[1]))
        elif len(arguments) == 2 and arguments[0] == "check":
            check(Path(arguments[1]))
        else:
            print(__doc__, file=sys.stderr)
            return 2
    except LessonError as error:
        print(f"lesson_pictures.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
