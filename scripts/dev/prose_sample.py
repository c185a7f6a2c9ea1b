#!/usr/bin/env python3
"""Draws a blind sample of this project's text for a reader, and evaluates the reader's marks.

    prose_sample.py draw SEED SAMPLE.txt KEY.json   items in random order, and where each comes from
    prose_sample.py score KEY.json MARKED.txt       marked items per kind; MARKED.txt holds the item numbers

The control items are the comments of meshoptimizer.h (Debian package libmeshoptimizer-dev).
"""
import argparse
import json
import pathlib
import random
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
CONTROL = pathlib.Path("/usr/include/meshoptimizer.h")
LINES_AFTER = 5
COUNTS = {"comment": 100, "document": 100, "message": 50, "control": 50}


def tracked(*patterns):
    names = subprocess.run(["git", "ls-files", *patterns], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    return [ROOT / name for name in names.splitlines()]


def line_comments(path, marker):
    """Blocks of consecutive comment lines, and comments at the end of a line of code, each with the lines after it."""
    lines = path.read_text().splitlines()
    trailing = re.compile(r"\S.*\s" + marker + r"[/<]*\s+\S")
    i = 0
    while i < len(lines):
        begin = i
        while i < len(lines) and lines[i].lstrip().startswith(marker):
            i += 1
        if i > begin:
            block = [line for line in lines[begin:i] if "SPDX" not in line and not line.startswith("#!")]
            if re.search("[a-z]{3}", "".join(block)) and "----" not in "".join(block):
                yield begin + 1, "\n".join(block + lines[i : i + LINES_AFTER])
        elif marker == "//" and trailing.match(lines[i]) and '"' not in lines[i] and "// namespace" not in lines[i]:
            yield i + 1, "\n".join(lines[i : i + 1 + LINES_AFTER])
            i += 1
        else:
            i += 1


def block_comments(path):
    text = path.read_text()
    lines = text.splitlines()
    for match in re.finditer(r"/\*.*?\*/", text, re.S):
        begin = text.count("\n", 0, match.start())
        end = text.count("\n", 0, match.end()) + 1
        if begin > 0:  # the first is the licence
            yield begin + 1, "\n".join(lines[begin : end + LINES_AFTER])


def docstrings(path):
    text = path.read_text()
    lines = text.splitlines()
    for match in re.finditer(r'"""(?!\\).*?"""', text, re.S):
        begin = text.count("\n", 0, match.start())
        end = text.count("\n", 0, match.end()) + 1
        if re.search("[a-z]{3}", match[0]):
            yield begin + 1, "\n".join(lines[begin : end + LINES_AFTER])


def page_texts(path):
    """Sentences of the page of `halfspace explain`."""
    text = path.read_text()
    for match in re.finditer(r'"((?:\\.|[^"\\\n])*)"|`((?:\\.|[^`\\])*)`', text):
        literal = re.sub(r"\$\{[^{}]*\}", "N", match[1] or match[2] or "")
        if len(re.findall(r"\b[a-z]{2,}\b", literal)) >= 6 and re.search(r"[.?]", literal):
            yield text.count("\n", 0, match.start()) + 1, f"page: {literal}"


def sentences(path):
    text = path.read_text()
    text = re.sub(r"```.*?```", "", text, flags=re.S)
    text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    for block in re.split(r"\n\s*\n", text):
        if block.startswith("    ") or "|---" in block or block.lstrip().startswith(("<", "![")):
            continue
        for paragraph in re.split(r"(?m)^\s*(?:#+|[-*]|\d+\.)\s+", block):
            for sentence in re.split(r"(?<=[.!?])\s+(?=[A-Z`\[])", " ".join(paragraph.split())):
                if len(sentence.split()) >= 4:
                    yield 0, sentence


def messages(path):
    """Test names, and string literals with at least four words: help, errors, progress."""
    text = path.read_text()
    for match in re.finditer(r"\bTEST(?:_F|_P)?\((\w+),\s*(\w+)\)", text):
        yield text.count("\n", 0, match.start()) + 1, f"test name: {match[1]}.{match[2]}"
    if "tests" in path.parts:
        return
    for match in re.finditer(r'(?:"(?:\\.|[^"\\\n])*"\s*)+', text):
        literal = "".join(re.findall(r'"((?:\\.|[^"\\\n])*)"', match[0]))
        if len(re.findall(r"[a-z]{2,}", literal)) >= 4 and " " in literal and '{"' not in literal and ".h" not in literal:
            yield text.count("\n", 0, match.start()) + 1, f"message: {literal}"


def candidates():
    found = {kind: [] for kind in COUNTS}
    def add(kind, path, items):
        found[kind] += [(f"{path.relative_to(ROOT) if path.is_relative_to(ROOT) else path}:{line}", text) for line, text in items]
    for path in tracked("*.h", "*.cpp"):
        add("comment", path, line_comments(path, "//"))
        add("message", path, messages(path))
    for path in tracked("*.py", "*.sh", "*.cmake", "*CMakeLists.txt"):
        add("comment", path, line_comments(path, "#"))
    for path in tracked("*.py"):
        add("comment", path, docstrings(path))
    for path in tracked("apps/explain/page/*.js"):
        add("comment", path, line_comments(path, "//"))
        add("message", path, page_texts(path))
    for path in tracked("*.md"):
        add("document", path, sentences(path))
    add("control", CONTROL, block_comments(CONTROL))
    return found


def without_names(text):
    """Hides which project an item is from."""
    return re.sub(r"(?i)meshopt(imizer)?|halfspace", "lib", text).replace("HS_", "LIB_")


def draw(seed, sample_path, key_path):
    generator = random.Random(seed)
    found = candidates()
    items = [(kind, *item) for kind, count in COUNTS.items() for item in generator.sample(found[kind], min(count, len(found[kind])))]
    generator.shuffle(items)
    sample_path.write_text("".join(f"===== {i}\n{without_names(text)}\n\n" for i, (_, _, text) in enumerate(items, 1)))
    key_path.write_text(json.dumps([{"item": i, "kind": kind, "place": place} for i, (kind, place, _) in enumerate(items, 1)], indent=1))


def score(key_path, marked_path):
    key = json.loads(key_path.read_text())
    marked = {int(n) for n in re.findall(r"\d+", marked_path.read_text())}
    unknown = marked - {entry["item"] for entry in key}
    if unknown:
        sys.exit(f"{marked_path}: no such items: {sorted(unknown)}; expected numbers from 1 to {len(key)}")
    def share(entries):
        hits = sum(entry["item"] in marked for entry in entries)
        return f"{hits} of {len(entries)} marked ({100 * hits / max(1, len(entries)):.1f} %)"
    for kind in COUNTS:
        print(f"{kind}: {share([entry for entry in key if entry['kind'] == kind])}")
    print(f"ours: {share([entry for entry in key if entry['kind'] != 'control'])}")
    for entry in key:
        if entry["item"] in marked:
            print(f"  {entry['item']} {entry['kind']} {entry['place']}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    command = commands.add_parser("draw")
    command.add_argument("seed", type=int)
    command.add_argument("sample", type=pathlib.Path)
    command.add_argument("key", type=pathlib.Path)
    command = commands.add_parser("score")
    command.add_argument("key", type=pathlib.Path)
    command.add_argument("marked", type=pathlib.Path)
    arguments = parser.parse_args()
    if arguments.command == "score":
        return score(arguments.key, arguments.marked)
    if not CONTROL.exists():
        sys.exit(f"{CONTROL}: not found; expected the package libmeshoptimizer-dev to be installed")
    draw(arguments.seed, arguments.sample, arguments.key)


if __name__ == "__main__":
    main()
