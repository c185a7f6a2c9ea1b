#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Applies the faults of tests/faults to a copy of the source tree, one at a time, and checks that the tests detect each.

  scripts/mutate.py           all faults
  scripts/mutate.py N         fault N of the list
  scripts/mutate.py N M       faults N to M
  scripts/mutate.py NAME...   faults by file name, without .fault
  scripts/mutate.py list      numbers, file names and what each fault does

The last line is "N caught, M missed"; the exit code is 1 if any fault was missed. A fault is caught if a test fails. A fault
that does not compile proves nothing and counts as missed (warnings are not errors here).

A fault file has a name, a source file, the old text (lines that begin with "- ") and the new text (lines that begin with "+ "; without
any, the old text is deleted):

  name: Clipping skips the near plane
  file: src/raster/primitives/clip.cpp
  - case 1: return p.z + p.w;
  + case 1: return 1.0;

The old text must occur exactly once in the file. It can be part of a line. tests/faults/apply_test.py checks all fault files.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FAULTS = ROOT / "tests" / "faults"

# Test programs that can detect a fault in a folder, in the order in which they run. Most faults are detected by the first one.
TESTS = {
    "src/core/": ["core", "raster", "property", "conformance", "shading"],
    "src/explain/": ["explain"],
    "src/geometry/": ["geometry", "render"],
    "src/image/": ["image", "cli"],
    "src/model/": ["model"],
    "src/procedural/": ["procedural", "render"],
    "src/raster/trace/": ["explain"],
    "src/raster/": ["raster", "property", "conformance", "shading"],
    "src/reference/": ["reference"],
    "src/render/": ["render", "reference"],
    "src/scene/": ["scene", "render", "cli"],
    "src/shading/": ["shading", "raster", "property", "conformance"],
    "src/study/": ["study"],
}


class FaultError(Exception):
    """A fault file that cannot be read or does not apply."""


@dataclass
class Fault:
    stem: str
    name: str
    file: str
    old: str
    new: str

    def planted(self, text):
        """Returns the text with the fault applied."""
        count = text.count(self.old)
        if count != 1:
            raise FaultError(f"{self.stem}: the old text occurs {count} times in {self.file}, expected once")
        return text.replace(self.old, self.new)

    def tests(self):
        for folder, tests in TESTS.items():
            if self.file.startswith(folder):
                return tests
        raise FaultError(f"{self.stem}: no test programs are listed for {self.file}; expected a file in one of {', '.join(TESTS)}")


def parse(stem, content):
    """Parses a fault file."""
    match = re.fullmatch(r"name: (.+)\nfile: (.+)\n((?:-.*\n)+)((?:\+.*\n)*)", content)
    if not match:
        raise FaultError(f"{stem}: expected a line 'name: ...', a line 'file: ...', lines '- ...' and lines '+ ...'")
    name, file, old, new = match.groups()
    text = lambda lines: "\n".join(line[2:] for line in lines.splitlines())
    fault = Fault(stem, name, file, text(old), text(new))
    if fault.old.strip() == "":
        raise FaultError(f"{stem}: the old text is empty")
    if fault.old == fault.new:
        raise FaultError(f"{stem}: the new text is the old text")
    return fault


def fault_files():
    return sorted(FAULTS.glob("*.fault"))


def load_all():
    return [parse(path.stem, path.read_text(encoding="utf-8")) for path in fault_files()]


def select(faults, arguments):
    """Returns the faults selected on the command line, with their numbers."""
    numbered = list(enumerate(faults, 1))
    if not arguments:
        return numbered
    if len(arguments) <= 2 and all(re.fullmatch(r"[0-9]+", a) for a in arguments):
        first, last = int(arguments[0]), int(arguments[-1])
        for number in first, last:
            if not 1 <= number <= len(faults):
                raise FaultError(f"{number} is not a fault; expected 1 to {len(faults)}, a name or list")
        return numbered[first - 1 : last]
    stems = {fault.stem: (number, fault) for number, fault in numbered}
    for argument in arguments:
        if argument not in stems:
            raise FaultError(f"'{argument}' is not a fault; expected 1 to {len(faults)}, a name or list")
    return [stems[argument] for argument in arguments]


class Copy:
    """A copy of the source tree with a build folder."""

    def __init__(self, root):
        self.root, self.build, self.log = root, root / "build", ""
        # Lets ccache share objects between copies with different paths.
        self.environment = dict(os.environ, CCACHE_BASEDIR=str(root), HALFSPACE_LONG_TESTS="1")
        listed = self.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], ROOT).stdout
        for name in filter(None, listed.split("\0")):
            if (ROOT / name).is_file():  # a deleted file is still listed
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(ROOT / name, root / name)

    def run(self, command, folder, timeout=None):
        return subprocess.run(command, cwd=folder, env=self.environment, timeout=timeout, text=True, errors="replace",
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def configure(self):
        result = self.run(["cmake", "-S", str(self.root), "-B", str(self.build), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                           "-DHALFSPACE_BUILD_BENCHMARKS=OFF", "-DHALFSPACE_WERROR=OFF"], self.root)
        self.log = result.stdout
        return result.returncode == 0

    def check(self, tests):
        """Builds and runs test programs until one fails. Returns "passed", "failed" or "does not build"."""
        for test in tests:
            result = self.run(["cmake", "--build", str(self.build), "--target", f"test-{test}"], self.root)
            self.log = result.stdout
            if result.returncode != 0:
                return "does not build"
            try:
                result = self.run([str(self.build / "bin" / f"test-{test}"), "--gtest_fail_fast", "--gtest_brief=1"], self.root, 600)
                self.log = result.stdout
            except subprocess.TimeoutExpired:
                self.log = f"test-{test} did not finish within 600 s"
                return "failed"
            if result.returncode != 0:
                return "failed"
        return "passed"

    def failure(self):
        """Returns the name of the failed test, or the last line of the output."""
        match = re.search(r"\[  FAILED  \] ([A-Za-z0-9_/.]+)", self.log)
        return match.group(1) if match else self.log.strip().rpartition("\n")[2]


def run_faults(selected):
    """Applies each fault. Returns the numbers of caught and missed faults."""
    with tempfile.TemporaryDirectory() as folder:
        copy = Copy(Path(folder))
        print("building the tree without faults", flush=True)
        tests = list(dict.fromkeys(test for _, fault in selected for test in fault.tests()))
        if not copy.configure() or copy.check(tests) != "passed":
            raise FaultError("the tests fail without any fault:\n" + "\n".join(copy.log.splitlines()[-30:]))
        caught = missed = 0
        for number, fault in selected:
            file = copy.root / fault.file
            text = file.read_text(encoding="utf-8")
            file.write_text(fault.planted(text), encoding="utf-8")
            verdict = copy.check(fault.tests())
            if verdict == "failed":
                caught += 1
                print(f"caught {number} {fault.stem} ({copy.failure()})", flush=True)
            else:
                missed += 1
                print(f"MISSED {number} {fault.stem} ({verdict})", flush=True)
            file.write_text(text, encoding="utf-8")
        return caught, missed


def main(arguments):
    try:
        faults = load_all()
        if arguments == ["list"]:
            for number, fault in enumerate(faults, 1):
                print(f"{number} {fault.stem}: {fault.name}")
            return 0
        selected = select(faults, arguments)
    except FaultError as error:
        print(f"mutate.py: {error}", file=sys.stderr)
        return 2
    try:
        caught, missed = run_faults(selected)
    except FaultError as error:
        print(f"mutate.py: {error}", file=sys.stderr)
        return 1
    print(f"{caught} caught, {missed} missed")
    return 0 if missed == 0 else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
