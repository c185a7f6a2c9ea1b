#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Copies the shaders of tests/mesa/ported into docs/howto/port_glsl.md. The section NAME of the document has the code of NAME.cpp or NAME.h.

    scripts/docs/ported_shaders.py            updates the document
    scripts/docs/ported_shaders.py --check    exits with 1 if the document is not current

Copied are the text of raw strings R"glsl(...)glsl" and of regions of C++ between the lines `// [name]` and `// [end]`. GLSL comes before the
regions that precede it in the source.
"""
import re
import sys
import textwrap
from pathlib import Path

from generated_sections import names, replaced

ROOT = Path(__file__).resolve().parents[2]
DOCUMENT = ROOT / "docs" / "howto" / "port_glsl.md"
SOURCES = ROOT / "tests" / "mesa" / "ported"
PART = re.compile(r"^[ ]*// \[\w+\]\n(?P<cpp>.*?)^[ ]*// \[end\]\n|R\"glsl\((?P<glsl>.*?)\)glsl\"", re.DOTALL | re.MULTILINE)


def section(source):
    """Returns the code blocks of a source."""
    groups = []  # of regions and the GLSL that follows them
    for match in PART.finditer(source):
        kind = match.lastgroup
        if not groups or (kind == "cpp" and groups[-1]["glsl"]):
            groups.append({"glsl": [], "cpp": []})
        groups[-1][kind].append(f"```{kind}\n{textwrap.dedent(match[kind]).strip()}\n```\n")
    return "\n" + "\n".join(block for group in groups for block in group["glsl"] + group["cpp"]) + "\n"


def source_of(name):
    paths = [SOURCES / f"{name}.{end}" for end in ("cpp", "h")]
    path = next((p for p in paths if p.exists()), None)
    return path or sys.exit(f"{DOCUMENT.name}: the section {name} has no source; expected {paths[0].relative_to(ROOT)}")


def main():
    text = DOCUMENT.read_text(encoding="utf-8")
    missing = sorted({path.stem for path in SOURCES.glob("*.cpp")} - set(names(text)))
    if missing:
        sys.exit(f"{DOCUMENT.name}: no section for {', '.join(missing)}; expected <!-- generated: {missing[0]} -->")
    current = replaced(text, {name: section(source_of(name).read_text(encoding="utf-8")) for name in names(text)})
    if "--check" in sys.argv[1:]:
        return "" if current == text else f"{DOCUMENT.name} differs from {SOURCES.relative_to(ROOT)}; run scripts/docs/ported_shaders.py"
    DOCUMENT.write_text(current, encoding="utf-8")
    return ""


if __name__ == "__main__":
    sys.exit(main() or 0)
