#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the commands of the documents and checks their links.

    documents_test.py PROGRAM_DIR

Every command in an indented or "sh" block is run, at a reduced size, in one temporary folder per document. A block after the line
`<!-- not run: REASON -->` is not run; its paths, presets, targets and options must exist. A block after `<!-- slow: REASON -->` runs only
if HALFSPACE_LONG_TESTS is set, as scripts/test_full.sh does; otherwise it is checked in the same way.
"""
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAMS = Path()
MARK = re.compile(r"<!-- (not run|slow): (.+) -->")
LONG_TESTS = "HALFSPACE_LONG_TESTS" in os.environ
PROGRAM_NAMES = ("halfspace", "halfspace-bench", "halfspace-bench-gl", "halfspace-limits", "halfspace-stages", "halfspace-view")
# The commands and options of these programs are tested only if they are built.
OPTIONAL_PROGRAMS = ("halfspace-bench", "halfspace-bench-gl", "halfspace-limits", "halfspace-stages", "halfspace-view")


class Block:
    def __init__(self, document, line, reason, lines):
        self.place, self.reason, self.commands = f"{document}:{line}", reason, []
        pending = ""
        for text in lines:
            pending += text.strip()
            if pending.endswith("\\"):
                pending = pending[:-1]
                continue
            if pending and not pending.startswith("#"):
                self.commands.append(pending)
            pending = ""


def documents():
    return ["README.md", "CONTRIBUTING.md", *sorted(str(path.relative_to(ROOT)) for path in (ROOT / "docs").rglob("*.md"))]


def blocks(document, text=None):
    lines = (text if text is not None else (ROOT / document).read_text()).splitlines()
    found, reason, i = [], None, 0
    while i < len(lines):
        begin = i
        if match := MARK.fullmatch(lines[i].strip()):
            reason = None if match[1] == "slow" and LONG_TESTS else match[2]
            i += 1
            continue
        if lines[i].startswith("```"):
            language = lines[i][3:].strip()
            i += 1
            while i < len(lines) and not lines[i].startswith("```"):
                i += 1
            if language == "sh":
                found.append(Block(document, begin + 1, reason, lines[begin + 1 : i]))
            i += 1
        elif lines[i].startswith("    ") and (i == 0 or not lines[i - 1].strip() or MARK.fullmatch(lines[i - 1].strip())):
            while i < len(lines) and (lines[i].startswith("    ") or not lines[i].strip()):
                i += 1
            found.append(Block(document, begin + 1, reason, lines[begin:i]))
        else:
            i += 1
            if not lines[begin].strip():
                continue  # a blank line may separate a mark from its block
        reason = None
    return found


def words_of(command):
    return shlex.split(command, comments=True)


def program_name(word):
    """Returns the program's name if the word is one of this project's programs, with or without a path."""
    name = word.rsplit("/", 1)[-1]
    return name if name in PROGRAM_NAMES and (word == name or word.startswith("./") or "/bin/" in word) else None


def reduced(command):
    """Returns the command with options that make it run in about a second."""
    words = words_of(command)
    name, text = program_name(words[0]), command
    text = re.sub(r"^\S+", name, text)
    text = re.sub(r"--frames (\d+)\.\.\d+", lambda m: f"--frames {m[1]}..{int(m[1]) + 1}", text)
    text, count = re.subn(r"--size \S+", "--size 64x36", text)
    extra = []
    if name == "halfspace-bench" and "--list" not in words:
        text = re.sub(r"--seconds \S+", "", text)
        extra = ["--seconds 0"] + ([] if count else ["--size 64x36"])
    elif len(words) > 1 and words[1] in ("render", "validate") and "--print" not in words and "--table" not in words and not count:
        extra = ["--size 64x36"]
    if len(words) > 1 and words[1] == "validate" and "--rays" not in words:
        extra.append("--rays 16")
    if len(words) > 1 and words[1] == "chart" and "--quick" not in words:
        extra.append("--quick")
    if not extra:
        return text
    # Insert the options before a comment or a redirection.
    match = re.search(r"\s(#|>|\|)", text)
    end = match.start() if match else len(text)
    return f"{text[:end].rstrip()} {' '.join(extra)} {text[end:].lstrip()}".rstrip()


def help_of(words):
    name = program_name(words[0])
    command = [str(PROGRAMS / name)]
    if name == "halfspace" and len(words) > 1 and not words[1].startswith("-"):
        command.append(words[1])
    text = subprocess.run([*command, "--help"], capture_output=True, text=True, check=True).stdout
    more = re.findall(r"--help-\w+", text)  # other parts of the help
    return text + "".join(subprocess.run([*command, option], capture_output=True, text=True, check=True).stdout for option in more)


def is_absent(name):
    return name in OPTIONAL_PROGRAMS and not (PROGRAMS / name).exists()


def missing_parts(command):
    """Returns the files, presets, targets and options that a command names but that do not exist."""
    words, missing = words_of(command), []
    options = [word.split("=")[0] for word in words[1:] if word.startswith("--")]
    first = words[0]
    name = program_name(first)
    if is_absent(name):
        return []
    if name:
        text = help_of(words)
        missing += [option for option in options if not re.search(re.escape(option) + r"\b", text)]
    elif is_script(first):
        path = ROOT / first
        if not os.access(path, os.X_OK):
            return [first]
        text = path.read_text()
        missing += [option for option in options if option not in text]
    elif first in ("cmake", "ctest"):
        presets = (ROOT / "CMakePresets.json").read_text()
        listings = "".join(p.read_text() for p in [ROOT / "CMakeLists.txt", *(ROOT / "cmake").glob("*.cmake")])
        names = {preset["name"] for kind in ("configurePresets", "buildPresets", "testPresets") for preset in json.loads(presets).get(kind, [])}
        for option, value in zip(words, words[1:]):
            if option == "--preset" and value not in names:
                missing.append(f"preset {value}")
            if option == "--target" and not is_absent(value) and not (PROGRAMS / value).exists():
                missing.append(f"target {value}")
        for word in words:
            if match := re.match(r"-D(HALFSPACE_\w+)", word):
                if match[1] not in listings:
                    missing.append(match[1])
    return missing


def is_script(word):
    return re.fullmatch(r"(scripts|tests|benchmarks|\.ci)/\S*[^/]", word) is not None


def is_shell(block):
    known = ("cmake", "ctest", "cd", "export", "git", "python3", "pip", "apt-get", "sudo", "ffmpeg")
    first = [command.split()[0] for command in block.commands]
    return any(program_name(word) or word in known or is_script(word) for word in first)


class Commands(unittest.TestCase):
    def test_commands_run(self):
        environment = dict(os.environ, PATH=f"{PROGRAMS}:{os.environ['PATH']}")
        count = 0
        for document in documents():
            with tempfile.TemporaryDirectory() as folder:
                environment["HOME"] = folder
                for block in blocks(document):
                    if block.reason is not None or not is_shell(block):
                        continue
                    for command in block.commands:
                        word = command.split()[0]
                        if word == "cd" or is_absent(program_name(word)):
                            continue
                        with self.subTest(place=block.place, command=command):
                            self.assertTrue(program_name(word), "neither run nor marked; expected '<!-- not run: REASON -->' before the block")
                            result = subprocess.run(["bash", "-c", reduced(command)], cwd=folder, env=environment, capture_output=True, text=True, timeout=300)
                            self.assertEqual(result.returncode, 0, f"{reduced(command)}: {result.stderr.strip()}")
                            count += 1
        self.assertGreater(count, 20, "found too few commands: the parser must be wrong")

    def test_marked_commands_refer_to_existing_files(self):
        for document in documents():
            for block in blocks(document):
                if block.reason is None:
                    continue
                for command in block.commands:
                    with self.subTest(place=block.place, command=command):
                        self.assertEqual(missing_parts(command) if is_shell(block) else [], [])


class Links(unittest.TestCase):
    def test_relative_links_exist(self):
        for document in documents():
            text = re.sub(r"```.*?```", "", (ROOT / document).read_text(), flags=re.S)
            targets = re.findall(r"\]\(([^)\s]+)\)", text) + re.findall(r'(?:src|srcset|href)="([^"\s]+)"', text)
            for target in targets:
                if "://" in target:
                    continue
                name, _, anchor = target.partition("#")
                path = (ROOT / document).parent / name if name else ROOT / document
                with self.subTest(document=document, link=target):
                    self.assertTrue(path.exists())
                    if anchor:
                        self.assertIn(anchor, anchors(path.read_text()))


def anchors(text):
    headings = re.findall(r"^#+ (.+)$", text, re.M)
    return [re.sub(r"[^\w\- ]", "", heading.replace("`", "").lower()).replace(" ", "-") for heading in headings]


class Parser(unittest.TestCase):
    TEXT = "Text\n\n    halfspace list\n\n<!-- not run: it builds -->\n    cmake --preset nothing\n\n```sh\nhalfspace info \\\n  --json\n```\n"

    def test_blocks_and_marks(self):
        found = blocks("x.md", self.TEXT)
        self.assertEqual([(b.reason, b.commands) for b in found],
                         [(None, ["halfspace list"]), ("it builds", ["cmake --preset nothing"]), (None, ["halfspace info --json"])])

    def test_missing_parts_are_found(self):
        for command in ("cmake --preset nothing", "scripts/none.sh", "scripts/bench/bench.sh --none", "halfspace render --none", "cmake -DHALFSPACE_NONE=1"):
            with self.subTest(command=command):
                self.assertEqual(len(missing_parts(command)), 1)

    def test_commands_are_reduced(self):
        self.assertEqual(reduced("./halfspace render moon --frames 0..47 -o m.png  # note"),
                         "halfspace render moon --frames 0..1 -o m.png --size 64x36 # note")
        self.assertEqual(reduced("halfspace render moon --print > m.json"), "halfspace render moon --print > m.json")


if __name__ == "__main__":
    if len(sys.argv) < 2 or not (Path(sys.argv[1]) / "halfspace").exists():
        sys.exit("documents_test.py: expected the folder of the built programs as the first argument")
    PROGRAMS = Path(sys.argv.pop(1)).resolve()
    unittest.main()
