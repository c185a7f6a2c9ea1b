#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints the errors of one of several sources that were compiled together.

  errors_of.py MESSAGES SOURCE.cpp

MESSAGES is a file with the output of GCC or Clang for a source that includes SOURCE.cpp and others of its folder. Like a compiler, exits with
1 if SOURCE.cpp has an error. Exits with 2 if it is not clear which source an error belongs to.
"""

import re
import sys
from pathlib import Path

# What GCC and Clang print before an error: where its file was included, and what GCC was compiling.
CONTEXT = re.compile(r"In file included from |\s+from |.*: (In .*|At global scope):$|.*:\s+(recursively )?required (from|by|for) |"
                     r".*:\s+in .constexpr. expansion of |.*:\s+\[ skipping ")
ERROR = re.compile(r".*: (fatal )?error: ")
# GCC does not repeat the lines of code of the previous error.
OMITTED_CODE = ["(the line of the previous error)", "(its mark)"]


def errors(lines):
    """Yields the lines of each error and its notes."""
    starts = []
    for number, line in enumerate(lines):
        if ERROR.match(line):
            while number > 0 and CONTEXT.match(lines[number - 1]):
                number -= 1
            starts.append(number)
    for start, end in zip(starts, [*starts[1:], len(lines)]):
        error = lines[start:end]
        at = next(n for n, line in enumerate(error, 1) if ERROR.match(line))
        yield error if at < len(error) and ": note: " not in error[at] else error[:at] + OMITTED_CODE + error[at:]


def errors_of(lines, source):
    """Returns the lines of the errors of a source. An error that names no source is one of the same source as the error before it."""
    found, owners = [], set()
    for error in errors(lines):
        owners = set(re.findall(rf"{re.escape(str(source.parent))}/\w+\.cpp(?=:\d)", "\n".join(error))) or owners
        if len(owners) != 1:
            print(f"an error belongs to {len(owners)} sources; expected one:", *error, sep="\n")
            sys.exit(2)
        found += error if owners == {str(source)} else []
    return found


if __name__ == "__main__":
    messages, source = map(Path, sys.argv[1:])
    lines = messages.read_text(encoding="utf-8").splitlines()
    summary = [lines.pop()] if lines and lines[-1].endswith(" generated.") else []  # Clang's last line
    found = errors_of(lines, source)
    print(*found, *summary, sep="\n")
    sys.exit(1 if found else 0)
