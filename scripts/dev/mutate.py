#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Applies the faults of tests/faults to a copy of the source tree, one at a time, and checks that the tests detect each.

  scripts/dev/mutate.py [OPTION...]           all faults
  scripts/dev/mutate.py [OPTION...] N         fault N of the list
  scripts/dev/mutate.py [OPTION...] N M       faults N to M
  scripts/dev/mutate.py [OPTION...] NAME...   faults by file name, without .fault
  scripts/dev/mutate.py list                  numbers, file names and descriptions of the faults
    --resume      skips the faults that were caught before with the same sources
    --record      writes the name of the test that caught the fault into each fault file
    --copies N    number of faults tried at the same time, each in its own copy of the tree; default: the number of cores

The last line is "N caught, M missed"; the exit code is 1 if any fault was missed. A fault is caught if a test fails that passes without the
fault. A fault that does not compile proves nothing and counts as missed (warnings are not errors here).

A fault file has a name, a source file, a test that catches the fault (optional), the old text (lines that begin with "- ") and the new text
(lines that begin with "+ "; if there are none, the old text is deleted):

  name: Clipping skips the near plane
  file: src/raster/primitives/clip.cpp
  test: raster Clip.NearPlane
  - case 1: return p.z + p.w;
  + case 1: return 1.0;

The old text must occur exactly once in the file. It can be part of a line. tests/faults/apply_test.py checks all fault files.

The test is given by the name of its program and a GoogleTest filter. Only this test is built and run. If it passes, or if none is given,
all programs that can detect a fault in the file are built and run. The copies and the results are kept in build/mutate. Everything is
compiled at -O1, with clang++ if it is installed, because it compiles faster than g++.
"""

import argparse
import hashlib
import os
import queue
import re
import shutil
import subprocess
import sys
import threading
import time
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FAULTS = ROOT / "tests" / "faults"
WORK = ROOT / "build" / "mutate"
RESULTS = WORK / "caught.txt"  # lines "KEY STEM"

# Test programs that can detect a fault in a folder, in the order in which they run. Most faults are detected by the first one.
TESTS = {
    "src/core/": ["core", "raster", "property", "conformance", "shading"],
    "apps/cli/": ["cli"],
    "apps/command_line/": ["cli"],
    "apps/explain/": ["explain"],
    "src/geometry/": ["geometry", "render"],
    "src/image/": ["image", "cli"],
    "src/model/": ["model", "render"],
    "src/procedural/": ["procedural", "render"],
    "src/raster/trace/": ["explain"],
    "src/raster/": ["raster", "property", "conformance", "shading"],
    "src/reference/": ["reference"],
    "src/render/": ["render", "reference"],
    "src/scene/": ["scene", "render", "cli"],
    "src/shading/": ["shading", "raster", "property", "conformance"],
    "apps/study/": ["study"],
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
    test: str | None = None  # "PROGRAM FILTER"

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
    match = re.fullmatch(r"name: (.+)\nfile: (.+)\n(?:test: (\w+ \S+)\n)?((?:-.*\n)+)((?:\+.*\n)*)", content)
    if not match:
        raise FaultError(f"{stem}: expected a line 'name: ...', a line 'file: ...', lines '- ...' and lines '+ ...', "
                         "with at most a line 'test: PROGRAM FILTER' before the lines")
    name, file, test, old, new = match.groups()
    text = lambda lines: "\n".join(line[2:] for line in lines.splitlines())
    fault = Fault(stem, name, file, text(old), text(new), test)
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


def listed_names():
    """Returns the paths of the files and links of the tree, relative to its root."""
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT, check=True, text=True,
                            stdout=subprocess.PIPE).stdout
    return sorted(filter(None, listed.split("\0")))


def listed_files():
    return [name for name in listed_names() if (ROOT / name).is_file()]  # a deleted file is still listed


def listed_folder_links():
    """Returns the links to folders, such as include/halfspace."""
    return [name for name in listed_names() if (ROOT / name).is_symlink() and (ROOT / name).is_dir()]


def source_key(names):
    """Returns a hash of everything that affects whether the tests detect a fault, except the faults themselves."""
    key = hashlib.sha256()
    for name in names:
        if not name.startswith(("docs/", "tests/faults/")):
            key.update(name.encode() + b"\0" + (ROOT / name).read_bytes() + b"\0")
    return key.hexdigest()


def fault_key(sources, fault):
    return hashlib.sha256("\0".join([sources, fault.file, fault.old, fault.new]).encode()).hexdigest()[:16]


class Copy:
    """A copy of the source tree with a build folder."""

    def __init__(self, root, names, jobs):
        self.root, self.build, self.jobs, self.log = root / "tree", root / "build", jobs, ""
        # Lets ccache share objects between copies with different paths.
        self.environment = dict(os.environ, CCACHE_BASEDIR=str(root), HALFSPACE_LONG_TESTS="1")
        self.update(names)

    def update(self, names):
        """Copies the files that differ and preserves the times of all others, so that little is rebuilt."""
        for old in [path for path in self.root.rglob("*") if path.is_file()] if self.root.exists() else []:
            if str(old.relative_to(self.root)) not in set(names):
                old.unlink()
        for name in names:
            target, content = self.root / name, (ROOT / name).read_bytes()
            if not target.is_file() or target.read_bytes() != content:
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_bytes(content)
                shutil.copymode(ROOT / name, target)
        for name in listed_folder_links():
            link = self.root / name
            if not link.is_symlink():
                link.parent.mkdir(parents=True, exist_ok=True)
                link.symlink_to(os.readlink(ROOT / name))

    def run(self, command, timeout=None):
        """Runs a command. Returns its exit code, or None if it did not finish in time."""
        try:
            result = subprocess.run(command, cwd=self.root, env=self.environment, timeout=timeout, text=True, errors="replace",
                                    stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        except subprocess.TimeoutExpired:
            self.log = f"{Path(command[0]).name} did not finish within {timeout} s"
            return None
        self.log = result.stdout
        return result.returncode

    def configure(self):
        compiler = ["-DCMAKE_CXX_COMPILER=clang++"] if shutil.which("clang++") else []
        return self.run(["cmake", "-S", str(self.root), "-B", str(self.build), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=None",
                         "-DCMAKE_CXX_FLAGS=-O1 -DNDEBUG", "-DHALFSPACE_BUILD_BENCHMARKS=OFF", "-DHALFSPACE_BUILD_EXAMPLES=OFF",
                         "-DHALFSPACE_WERROR=OFF", *compiler]) == 0

    def make(self, program, jobs=None):
        return self.run(["cmake", "--build", str(self.build), "--target", f"test-{program}", "--", "-j", str(jobs or self.jobs)]) == 0

    def passes(self, program, test="*"):
        """Builds and runs a test program. The exit code 1 of GoogleTest, a crash and a timeout are failures."""
        command = [str(self.build / "bin" / f"test-{program}"), f"--gtest_filter={test}", "--gtest_fail_fast", "--gtest_brief=1"]
        return self.run(command, 600) == 0

    def failed_test(self):
        """Returns the name of the failed test, or None if the program did not finish."""
        match = re.search(r"\[  FAILED  \] ([A-Za-z0-9_/.]+)", self.log)
        return match.group(1) if match else None

    def tests_run(self):
        match = re.search(r"\[==========\] (\d+) tests? .* ran", self.log)
        return int(match.group(1)) if match else 0

    def catch(self, fault):
        """Plants a fault. Returns whether a test catches it, and either "PROGRAM TEST" or the reason why none does."""
        file = self.root / fault.file
        text = file.read_text(encoding="utf-8")
        file.write_text(fault.planted(text), encoding="utf-8")
        try:
            if fault.test:
                program, test = fault.test.split()
                if not self.make(program):
                    return False, "does not build"
                if not self.passes(program, test):  # the test passes without the fault
                    return True, fault.test
            for program in fault.tests():
                if not self.make(program):
                    return False, "does not build"
                if self.passes(program):
                    continue
                test = self.failed_test() or "*"
                file.write_text(text, encoding="utf-8")
                if not self.make(program) or not self.passes(program, test):
                    return False, f"test-{program} {test} fails without the fault too"
                return True, f"{program} {test}"
            return False, "passed"
        finally:
            file.write_text(text, encoding="utf-8")


def check_without_faults(copy, faults, jobs):
    """Checks that the recorded tests of all faults run and pass. Builds them with that many jobs."""
    tests = {}
    for fault in faults:
        if fault.test:
            program, test = fault.test.split()
            tests.setdefault(program, set()).add(test)
    if not copy.configure():
        raise FaultError("the copy cannot be configured:\n" + copy.log)
    for program, names in sorted(tests.items()):
        if not copy.make(program, jobs) or not copy.passes(program, ":".join(sorted(names))):
            raise FaultError(f"the tests of test-{program} fail without any fault:\n" + "\n".join(copy.log.splitlines()[-30:]))
        if copy.tests_run() < len(names):
            raise FaultError(f"fault files name tests that test-{program} does not have; expected {', '.join(sorted(names))}")


def record(fault, test):
    """Writes the test that catches a fault into the fault file."""
    path = FAULTS / f"{fault.stem}.fault"
    content = re.sub(r"^test: .*\n", "", path.read_text(encoding="utf-8"), flags=re.MULTILINE)
    path.write_text(re.sub(r"^(file: .*\n)", rf"\g<1>test: {test}\n", content, count=1, flags=re.MULTILINE), encoding="utf-8")


def run_faults(selected, options):
    """Applies each fault. Returns the numbers of caught and missed faults."""
    names = listed_files()
    sources = source_key(names)
    WORK.mkdir(parents=True, exist_ok=True)
    known = set(RESULTS.read_text().split()[::2]) if options.resume and RESULTS.exists() else set()
    unknown = [(number, fault) for number, fault in selected if fault_key(sources, fault) not in known]
    counts = {True: len(selected) - len(unknown), False: 0}
    if counts[True]:
        print(f"{counts[True]} faults are skipped: they were caught before with the same sources", flush=True)
    groups = queue.Queue()  # one copy tries all faults of a file, because what depends on the file is compiled only there
    for file in sorted({fault.file for _, fault in unknown}):
        groups.put([(number, fault) for number, fault in unknown if fault.file == file])
    jobs = max(1, (os.cpu_count() or 1) // options.copies)
    copies = [Copy(WORK / str(i), names, jobs) for i in range(min(options.copies, groups.qsize()))]
    lock = threading.Lock()

    def try_fault(copy, number, fault):
        begin = time.monotonic()
        caught, detail = copy.catch(fault)
        with lock:
            counts[caught] += 1
            print(f"{'caught' if caught else 'MISSED'} {number} {fault.stem} ({detail}; {time.monotonic() - begin:.0f} s)", flush=True)
            if caught:
                with RESULTS.open("a", encoding="utf-8") as file:
                    file.write(f"{fault_key(sources, fault)} {fault.stem}\n")
                if options.record:
                    record(fault, detail)

    def work(copy):
        while True:
            try:
                group = groups.get_nowait()
            except queue.Empty:
                return
            for number, fault in group:
                try_fault(copy, number, fault)

    if copies:
        print("building the tree without faults", flush=True)
        check_without_faults(copies[0], [fault for _, fault in unknown], os.cpu_count() or 1)
    for copy in copies[1:]:
        if not copy.configure():
            raise FaultError("a copy cannot be configured:\n" + copy.log)
    threads = [threading.Thread(target=work, args=(copy,)) for copy in copies]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return counts[True], counts[False]


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("faults", nargs="*")
    parser.add_argument("--resume", action="store_true")
    parser.add_argument("--record", action="store_true")
    parser.add_argument("--copies", type=int, default=os.cpu_count() or 1)
    options = parser.parse_args(arguments)
    try:
        faults = load_all()
        if options.faults == ["list"]:
            for number, fault in enumerate(faults, 1):
                print(f"{number} {fault.stem}: {fault.name}")
            return 0
        selected = select(faults, options.faults)
    except FaultError as error:
        print(f"mutate.py: {error}", file=sys.stderr)
        return 2
    try:
        caught, missed = run_faults(selected, options)
    except FaultError as error:
        print(f"mutate.py: {error}", file=sys.stderr)
        return 1
    print(f"{caught} caught, {missed} missed")
    return 0 if missed == 0 else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
