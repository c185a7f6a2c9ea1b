#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the symbols that the shared libraries export with tests/consumer/exports.txt.

    exports_test.py FOLDER
    exports_test.py --modules FILE...    extension modules of Python, which must not export functions of Halfspace

FOLDER contains the libraries of a build with BUILD_SHARED_LIBS. With HALFSPACE_RENEW_EXPORTS=1, the file is written instead. Each line is
the name of a function or variable, without parameters. The names of private functions must not appear in it.
"""
import os
import re
import subprocess
import sys
from pathlib import Path

# core/cpu.h, which is also compiled for the baseline instruction set.
WITHOUT_WIDTH = {"halfspace::build_arch", "halfspace::build_description", "halfspace::missing_cpu_features"}
LIST = Path(__file__).resolve().parent / "exports.txt"


def exported(library):
    """Returns the names that a library exports, without those that the compiler emits in every object that uses them."""
    lines = subprocess.run(["nm", "-D", "-C", "--defined-only", library], check=True, capture_output=True, text=True).stdout.splitlines()
    names = set()
    for line in lines:
        match = re.fullmatch(r"[0-9a-f]+ ([A-Za-z]) (.*?)(@@.*)?", line)
        if match[1] in "TDBR":
            names.add(re.sub(r"\(.*", "", match[2].replace("(anonymous namespace)", "ANONYMOUS")))
        elif not re.search(r"\bhalfspace::", match[2]):
            names.add(match[2])
    return names


def check_modules(files):
    """Other modules in the process may contain Halfspace as well, in another version or for another instruction set."""
    for file in map(Path, files):
        lines = subprocess.run(["nm", "-D", "-C", "--defined-only", file], check=True, capture_output=True, text=True).stdout.splitlines()
        names = {line.split(" ", 2)[2] for line in lines}
        ours = file.name.startswith(("_core", "_library"))
        initializer = "PyInit__core" if ours else f"PyInit_{file.name.split('.')[0]}"
        if initializer not in names:
            sys.exit(f"exports_test.py: {file.name} does not export {initializer}")
        # The other symbols of a module from outside the tree are up to its author.
        extra = sorted(name for name in names if "halfspace" in name or ours and name != initializer)
        if extra:
            sys.exit(f"{file.name} exports {len(extra)} names; expected only {initializer}:\n  " + "\n  ".join(extra[:20]))
    print(f"{len(files)} modules export no functions of Halfspace")


def main():
    if sys.argv[1] == "--modules":
        check_modules(sys.argv[2:])
        return
    libraries = sorted(Path(sys.argv[1]).glob("libhalfspace-*-lanes*.so"))
    if not libraries:
        sys.exit(f"exports_test.py: no shared libraries of Halfspace in {sys.argv[1]}")
    found = sorted({name for library in libraries for name in exported(library)})
    foreign = [name for name in found if not re.match(r"(non-virtual thunk to |vtable for |typeinfo (name )?for )?halfspace::", name)]
    if foreign:
        sys.exit("exported, but not in namespace halfspace:\n" + "\n".join(foreign))
    # Libraries for different widths can be loaded into one process, because their names differ.
    common = [name for name in found if not re.search(r"halfspace::lanes\d+::", name) and name not in WITHOUT_WIDTH]
    if common:
        sys.exit("exported, but not in the namespace of the SIMD width (core/namespace.h):\n" + "\n".join(common))
    found = sorted({re.sub(r"\blanes\d+::", "", name) for name in found})
    if os.environ.get("HALFSPACE_RENEW_EXPORTS"):
        LIST.write_text("\n".join(found) + "\n")
    listed = LIST.read_text().split("\n")[:-1]
    added, removed = sorted(set(found) - set(listed)), sorted(set(listed) - set(found))
    for title, names in (("exported, but not listed", added), ("listed, but not exported", removed)):
        if names:
            print(f"{title} in {LIST.name}:\n  " + "\n  ".join(names))
    if added or removed:
        sys.exit("exports_test.py: make private what users should not call, then run this test with HALFSPACE_RENEW_EXPORTS=1")
    print(f"{len(libraries)} libraries export the {len(listed)} listed names")


if __name__ == "__main__":
    main()
