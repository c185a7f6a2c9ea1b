#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that ctags, and with it editors and code search, finds the functions of source files. It found none when every file opened its
namespace with "namespace a::inline MACRO"."""

import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FILES = ("src/core/text.cpp", "src/raster/visibility/visibility.cpp", "src/model/obj/read_obj.cpp", "src/scene/scene_file.cpp",
         "src/render/scene_assets.cpp")


def defined_functions(text):
    """Returns the names of the functions whose definition begins at the start of a line and whose signature fits on it."""
    return set(re.findall(r"^[A-Za-z][^;=]*?(\w+)\([^;]*\) *(?:const )?(?:noexcept )?\{$", text, re.M))


def tagged_functions(path):
    tags = subprocess.run(["ctags", "-x", "--c++-kinds=f", path], check=True, capture_output=True, text=True).stdout
    return [line.split()[0] for line in tags.splitlines()]


class Tags(unittest.TestCase):
    def test_ctags_finds_the_functions_of_a_file(self):
        for name in FILES:
            defined, tagged = defined_functions((ROOT / name).read_text(encoding="utf-8")), tagged_functions(ROOT / name)
            self.assertGreaterEqual(len(defined), 3, name)
            self.assertEqual(defined - set(tagged), set(), name)
            self.assertGreaterEqual(len(tagged), len(defined), name)


if __name__ == "__main__":
    version = subprocess.run(["ctags", "--version"], capture_output=True, text=True).stdout if shutil.which("ctags") else ""
    if "Universal Ctags" not in version:
        print("skipped: universal-ctags is not installed")
        sys.exit(77)
    unittest.main()
