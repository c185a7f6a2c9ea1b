#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks the sources of the library: no calls that a library must not make, the names of macros, and the list of public headers in the
documents."""

import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DECODERS = ("src/core/tool/", "src/image/tool/", "src/image/jpeg_tool/", "src/model/draco_tool/")  # separate programs

# Calls that change or use the state of the host program, and the only files that may contain them.
FORBIDDEN = {
    r"\b(printf|fprintf|puts|fputs|perror|vprintf)\s*\(": ["src/core/check_handler.cpp"],  # before abort()
    r"\bstd::(cout|cerr|clog)\b": [],
    r"\b(abort)\s*\(": ["src/core/check_handler.cpp"],
    r"(?<!->)(?<!\.)\b(exit|_exit|quick_exit|terminate)\s*\(": [],
    r"\b(getenv|secure_getenv|setenv|putenv)\s*\(": [],
    r"\b(signal|sigaction|sigprocmask|pthread_sigmask)\s*\(": [],
    r"\b(fesetround|fesetenv|feenableexcept|_MM_SET_\w+)\s*\(": [],
    r"\b_mm_setcsr\s*\(": ["src/core/float_mode.h"],  # restores the mode
    r"\b(setlocale|chdir|umask|srand)\s*\(": [],
}


def without_comments(text):
    return re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.S)


def without_strings(text):
    return re.sub(r'"(\\.|[^"\\\n])*"', '""', text)


def sources():
    for path in sorted((ROOT / "src").rglob("*")):
        name = path.relative_to(ROOT).as_posix()
        if path.suffix in (".h", ".cpp") and not name.startswith(DECODERS):
            yield name, without_comments(path.read_text(encoding="utf-8"))


def forbidden_calls(name, text):
    text = without_strings(text)
    return [match[0].strip() for pattern, allowed in FORBIDDEN.items() if name not in allowed for match in re.finditer(pattern, text)]


def public_headers():
    text = (ROOT / "cmake" / "install.cmake").read_text()
    return re.search(r"set\(halfspace_public_headers(.*?)\)", text, re.S)[1].split()


class Library(unittest.TestCase):
    def test_does_not_touch_the_state_of_the_host_program(self):
        for name, text in sources():
            self.assertEqual(forbidden_calls(name, text), [], name)

    def test_the_check_finds_forbidden_calls(self):
        for call in ("std::exit(1);", 'std::getenv("X")', "std::cerr << 1", "signal(SIGPIPE, SIG_IGN)", "_mm_setcsr(0)", "puts(text)"):
            self.assertNotEqual(forbidden_calls("src/core/a.cpp", call), [], call)
        for call in ("pool.exit(1)", '"exit("', "snprintf(a, 1)", "design(1)"):
            self.assertEqual(forbidden_calls("src/core/a.cpp", call), [], call)

    def test_macros_begin_with_the_prefixes_of_the_project(self):
        for name, text in sources():
            for macro in re.findall(r"^\s*#\s*define\s+(\w+)", text, re.M):
                self.assertRegex(macro, "^(HS|HALFSPACE)_", name)

    def test_names_are_in_the_namespace_of_the_simd_width(self):
        """Otherwise code that was compiled for different widths could link, or share functions in one process (core/namespace.h)."""
        for path in sorted((ROOT / "src").rglob("*")):
            name = path.relative_to(ROOT).as_posix()
            if name in ("src/core/cpu.h", "src/core/cpu.cpp", "src/core/namespace.h"):  # compiled for the launcher as well; opens it
                continue
            if path.suffix in (".h", ".cpp"):
                for line in re.findall(r"^namespace halfspace\b.*$", path.read_text(encoding="utf-8"), re.M):
                    self.assertTrue(line.startswith("namespace halfspace::HS_LANES"), f"{name}: {line}")

    def test_public_headers_exist(self):
        headers = public_headers()
        self.assertGreater(len(headers), 50)
        self.assertEqual([h for h in headers if not (ROOT / "src" / h).is_file()], [])

    def test_the_api_reference_lists_the_public_headers(self):
        text = (ROOT / "docs" / "reference" / "api.md").read_text()
        listed = re.findall(r"^\| `(\w+/[\w/]+\.h)`", text, re.M)
        self.assertEqual(sorted(listed), sorted(public_headers()))

    def test_the_api_reference_names_what_the_headers_declare(self):
        text = (ROOT / "docs" / "reference" / "api.md").read_text()
        for header, description in re.findall(r"^\| `(\w+/[\w/]+\.h)` \|(.*)$", text, re.M):
            declared = (ROOT / "src" / header).read_text()
            for name in re.findall(r"`(\w+)(?:\(\))?`", description):
                self.assertRegex(declared, rf"\b{name}\b", f"{header} does not declare {name}")


if __name__ == "__main__":
    unittest.main()
