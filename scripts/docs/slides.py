#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a deck of slides for each lesson, in the Markdown format of Marp.

  scripts/docs/slides.py [FOLDER]           writes FOLDER/01.md to 24.md and FOLDER/images (default: build/slides)
  scripts/docs/slides.py [FOLDER] --html    also converts the decks to HTML with Marp

All text is that of docs/tutorial/lessons. A deck has the head of the page, then the key sentences of each paragraph with all formulas, tables,
code and pictures, and the whole exercise. The solutions are in docs/teachers, which this script does not read.
"""

import json
import math
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGES = ROOT / "docs" / "tutorial" / "lessons"

# A slide of Marp has 1280x720 pixels. STYLE leaves 1152x624 between the margins. The heading is 64 high, and the rest has room for 15 lines of
# 36 pixels. After the indentation of a list, a line has room for 72 characters of a wide font, such as DejaVu Sans: 15 pixels each. Marp makes
# code smaller that is too wide.
LINES, CHARACTERS, TABLE_CHARACTERS = 15, 72, 95
TITLE_CHARACTERS = 38  # the picture takes 40 % of the title slide
ITEM, CODE_LINE, CODE_FRAME, TABLE_ROW, PICTURE, FIGURE = 0.2, 0.8, 1.1, 1.2, 7, 11.5  # in lines; the words of a figure need more room
STYLE = """\
  section { display: block; align-content: start; font-size: 26px; line-height: 36px; padding: 48px 64px; }
  h1 { font-size: 44px; line-height: 54px; margin: 0 0 20px; }
  h2 { font-size: 36px; line-height: 44px; margin: 0 0 20px; }
  p, ul, ol { margin: 0 0 8px; }
  li + li { margin: 6px 0 0; }
  li ol { list-style: decimal; }
  pre { font-size: 20px; line-height: 28px; margin: 8px 0; padding: 10px 16px; }
  table { font-size: 19px; line-height: 26px; margin: 0 0 8px; }
  p img { display: block; height: 240px; margin: 0 auto; }
  p img[src$=".svg"] { height: 400px; max-width: 100%; object-fit: contain; }
"""


class SlideError(Exception):
    """A page that gives no deck, or a folder that cannot be written."""


@dataclass
class Block:
    """A part of a page: its kind, its lines without markup of the block, and for code its language."""

    kind: str  # heading, paragraph, list, code, table or image
    lines: list
    language: str = ""

    @property
    def text(self):
        return " ".join(line.strip() for line in self.lines)


def plain(text):
    """Removes the links to other documents, which are not beside the slides, but keeps their text."""
    return re.sub(r"(?<!!)\[([^]]*)\]\((?![a-z]+://)[^)\s]*\)", r"\1", text)


def kind_of(line):
    """Returns the kind of block that begins with this line."""
    starts = {"heading": "#", "table": "|", "image": "![", "comment": "<!--", "code": ("```", "    ")}
    for kind, start in starts.items():
        if line.startswith(start):
            return kind
    return "list" if re.match(r"- |\d+\. ", line) else "paragraph"


def parsed(text, page):
    """Returns the blocks of a page."""
    blocks, lines = [], text.split("\n")
    while lines:
        line = lines.pop(0)
        if not line.strip():
            continue
        kind, taken = kind_of(line), [line]
        if line.startswith("```"):
            if "```" not in lines:
                raise SlideError(f"{page}: a block of code begins with '{line}' but has no end; expected a line with ```")
            end = lines.index("```")
            taken, lines = lines[:end], lines[end + 1 :]
        elif kind != "comment":
            while lines and lines[0].strip():
                taken.append(lines.pop(0))
        if kind == "code":
            indented = not line.startswith("```")
            blocks.append(Block(kind, [row[4:] for row in taken] if indented else taken, "text" if indented else line[3:] or "text"))
        elif kind != "comment":
            blocks.append(Block(kind, plain("\n".join(taken)).split("\n")))
    return blocks


def sentences(text):
    return re.split(r'(?<=[.?!])\s+|(?<=[.?!][)"])\s+', text)


def numbers_in(sentence):
    """Returns how many numbers a sentence has. Those of lessons do not count."""
    return len(re.findall(r"\d+(?:[.,]\d+)*", re.sub(r"[Ll]essons? \d+((, | to | and )\d+)*", "", sentence)))


def worked_numbers(every):
    """Returns the indices of the sentences with worked numbers: those with three numbers, or with two and an equals sign, and those that follow,
    as long as they have numbers."""
    kept = set()
    for i, sentence in enumerate(every):
        if numbers_in(sentence) >= (1 if i - 1 in kept else 2 if " = " in sentence else 3):
            kept.add(i)
    return kept


def key_sentences(text, introduces):
    """Returns the first sentence of a paragraph, the worked numbers, and the last sentence if it introduces what follows. A sentence that refers to
    the one before it comes with that one."""
    every = sentences(text)
    kept = {0} | worked_numbers(every)
    if introduces or text.endswith((":", "?")):
        kept.add(len(every) - 1)
    for i in range(len(every) - 1, 0, -1):
        if i in kept and re.match(r".{0,30}\b(it|its|they|them|their|this|these|there|then|both)\b", every[i], re.IGNORECASE):
            kept.add(i - 1)
    return [every[i] for i in sorted(kept)]


def items(block):
    """Returns the items of a list, with their mark."""
    rows = re.split(r"\n(?=- |\d+\. )", "\n".join(block.lines))
    return [" ".join(line.strip() for line in row.split("\n")) for row in rows]


def rows_of(text, characters):
    return math.ceil(len(text) / characters)


def height(block, characters=CHARACTERS):
    """Returns the number of lines that a block takes on a slide."""
    if block.kind == "code":
        return CODE_FRAME + CODE_LINE * len(block.lines)
    if block.kind == "table":
        return TABLE_ROW * sum(rows_of(line, TABLE_CHARACTERS) for line in block.lines if not re.fullmatch(r"[|\-: ]+", line))
    if block.kind == "image":
        return FIGURE if ".svg)" in block.text else PICTURE
    return sum(rows_of(line, characters) + (ITEM if block.kind == "list" else 0) for line in block.lines)


def markdown(block):
    if block.kind == "code":
        return "\n".join([f"```{block.language}", *block.lines, "```"])
    return "\n".join(block.lines)


def sections(blocks, title):
    """Returns the sections of a page as pairs of a heading and blocks. A paragraph that begins with a bold sentence begins a section, too."""
    found = [(title, [])]
    for block in blocks:
        bold = re.match(r"\*\*(.+?)[.]?\*\* ", block.text) if block.kind == "paragraph" else None
        if block.kind == "heading":
            found.append((block.text.lstrip("# "), []))
            continue
        if bold:
            found.append((bold[1], []))
            block = Block("paragraph", [block.text[bold.end() :]])
        found[-1][1].append(block)
    return [(heading, kept) for heading, kept in found if kept]


def shown(block, heading, introduces):
    """Returns what a slide shows of a block: key sentences, and the first sentence of items without a number. An exercise is shown as it is."""
    if block.kind == "paragraph":
        return Block("paragraph", [block.text]) if heading == "Exercise" else Block("list", ["- " + s for s in key_sentences(block.text, introduces)])
    if block.kind == "list":
        whole = heading == "Exercise"
        return Block("list", [item if whole or not item.startswith("- ") else sentences(item)[0] for item in items(block)])
    return block


def units(heading, blocks):
    """Returns the parts of a section that stay together on a slide, as lists of blocks: a paragraph with the list, table or code after it."""
    found, joins = [], False
    for block, following in zip(blocks, [*blocks[1:], Block("end", [])]):
        stays = block.kind == "paragraph" and following.kind in ("list", "code", "table")
        part = shown(block, heading, stays and following.kind != "list")
        if joins and part.kind == "list" and found[-1][-1].kind == "list":
            part.lines = ["  " + line for line in part.lines]  # a list in the last item of the list before
        if joins:
            found[-1].append(part)
        else:
            found.append([part])
        joins = stays
    return found


def filled(parts, limit):
    """Distributes parts over slides, in order: each slide has as many as fit into `limit` lines, but at least one."""
    slides = []
    for part in parts:
        if slides and sum(map(height, [*slides[-1], *part])) <= limit:
            slides[-1] += part
        else:
            slides.append([*part])
    return slides


def paginated(page, heading, blocks):
    """Distributes a section over as few slides as it needs, and these as evenly as possible. Returns the slides as lists of blocks."""
    parts = []
    for unit in units(heading, blocks):
        parts += [unit] if sum(map(height, unit)) <= LINES else [[block] for block in unit]
    for part in parts:
        if sum(map(height, part)) > LINES:
            needed = sum(map(height, part))
            raise SlideError(f"{page}, section '{heading}': '{part[0].lines[0][:40]}' needs {needed:.1f} lines; a slide has {LINES}")
    fewest = len(filled(parts, LINES))
    return next(slides for slides in (filled(parts, limit) for limit in range(1, LINES + 1)) if len(slides) == fewest)


def joined(blocks):
    """Returns the text of a slide. Lists that follow each other become one."""
    text = ""
    for before, block in zip([None, *blocks], blocks):
        text += ("" if before is None else "\n" if before.kind == block.kind == "list" else "\n\n") + markdown(block)
    return text


def deck(text, page):
    """Returns the slides of a lesson, and the paths of its pictures."""
    blocks = [block for block in parsed(text, page) if not block.text.startswith("Next: ")]
    if [block.kind for block in blocks[:3]] != ["heading", "image", "list"]:
        raise SlideError(f"{page}: expected a heading, a picture, and a list with 'Before this lesson', 'Goal' and 'Time'")
    heading, picture, head = blocks[0].text.lstrip("# "), blocks[1].text, Block("list", items(blocks[2]))
    image = re.search(r"\(([^)]+)\)", picture)[1]
    needed = height(head, TITLE_CHARACTERS) + 1.5 * rows_of(heading, TITLE_CHARACTERS / 2)
    if needed > LINES + 1:  # the title is counted, too
        raise SlideError(f"{page}: the list at the top needs {needed:.0f} lines; the title slide has {LINES + 1}")
    slides = [f"![bg right:40% contain]({image})\n\n# {heading}\n\n{markdown(head)}"]
    for name, parts in sections(blocks[3:], heading.partition(": ")[2]):
        slides += [f"## {name}\n\n{joined(parts_of_slide)}" for parts_of_slide in paginated(page, name, parts)]
    front = f'---\nmarp: true\npaginate: true\ntitle: {json.dumps(heading)}\nstyle: |\n{STYLE}---\n\n'
    images = re.findall(r"!\[[^]]*\]\(([^)]+)\)", "\n".join(slides))
    return front + "\n\n---\n\n".join(slides) + "\n", images


def write_decks(folder):
    """Writes all decks and copies their pictures. Returns the paths of the decks."""
    pages = sorted(PAGES.glob("[0-9][0-9].md"))
    decks = {page.name: deck(page.read_text(encoding="utf-8"), page.relative_to(ROOT)) for page in pages}
    for name, (_, images) in decks.items():
        for image in images:
            if not (PAGES / image).is_file():
                raise SlideError(f"{PAGES.relative_to(ROOT) / name}: the picture {image} does not exist")
    if folder.resolve() == PAGES:
        raise SlideError(f"{folder}: expected another folder than that of the lessons, whose pages have the same names")
    try:
        for name, (text, images) in decks.items():
            for image in images:
                (folder / image).parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(PAGES / image, folder / image)
            (folder / name).write_text(text, encoding="utf-8")
    except OSError as error:
        raise SlideError(f"{folder}: {error.strerror}; expected a folder that can be written") from error
    return [folder / name for name in decks]


def marp():
    """Returns the command that runs Marp, installed for all or in node_modules of the working directory."""
    for command in (["marp"], ["npx", "--no-install", "marp"]):
        if shutil.which(command[0]) and subprocess.run([*command, "--version"], capture_output=True, check=False).returncode == 0:
            return command
    raise SlideError("--html needs Marp, which was not found; install it with: npm install -g @marp-team/marp-cli")


def main(arguments):
    if arguments == ["--help"]:
        print(__doc__.strip())
        return 0
    folders = [argument for argument in arguments if not argument.startswith("-")]
    unknown = [argument for argument in arguments if argument.startswith("-") and argument != "--html"]
    if unknown or len(folders) > 1:
        wrong = f"unknown option '{unknown[0]}'" if unknown else f"{len(folders)} folders"
        print(f"slides.py: {wrong}; expected [FOLDER] [--html], or --help", file=sys.stderr)
        return 2
    try:
        command = marp() if "--html" in arguments else None
        decks = write_decks(Path(folders[0] if folders else "build/slides"))
        if command:
            run = subprocess.run([*command, "--no-stdin", *map(str, decks)], capture_output=True, text=True, check=False)
            if run.returncode != 0:
                reason = run.stderr.strip().rpartition("\n")[2]
                raise SlideError(f"Marp failed: {reason}")
    except SlideError as error:
        print(f"slides.py: {error}", file=sys.stderr)
        return 1
    print(f"{len(decks)} decks in {decks[0].parent}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
