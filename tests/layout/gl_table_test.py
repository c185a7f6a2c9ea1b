#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks docs/reference/gl.md: every row has a state, and the names of the library and of tests in it exist.

  gl_table_test.py            runs the checks and the tests of the checks
  gl_table_test.py --counts   prints the table of counts that belongs at the end of the document
"""

import re
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DOCUMENT = ROOT / "docs" / "reference" / "gl.md"
COLUMNS = ["OpenGL", "since", "Halfspace", "test"]
COUNT_COLUMNS = ["state", "3.3 core", "later"]
STATES = ["present", "partly", "absent", "does not apply"]
GROUP_PREFIX = "Conformance/"
COMPILE_PREFIX = "Compile."


# ---- the document

def table_rows(text, columns):
    """Yields the cells of every row of the tables with the given columns."""
    inside = False
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")] if line.startswith("|") else None
        if cells is None:
            inside = False
        elif cells == columns:
            inside = True
        elif inside and not re.fullmatch(r"[-: ]+", "".join(cells)):
            yield cells


def state_of(cell):
    """Returns the state that a cell of the column Halfspace begins with, or None."""
    if cell.startswith("`"):
        return "present"
    if cell.startswith("partly: "):
        return "partly"
    if re.match(r"no($|; )", cell):
        return "absent"
    if cell.startswith("not applicable: "):
        return "does not apply"
    return None


def quoted(cell):
    return re.findall(r"`([^`]+)`", cell)


def count_rows(rows):
    """Returns the rows of the table of counts."""
    counts = {state: [0, 0] for state in STATES}
    for row in rows:
        counts[state_of(row[2])][row[1] != "3.3"] += 1
    totals = [sum(column) for column in zip(*counts.values())]
    return [[state, *map(str, counts[state])] for state in STATES] + [["all", *map(str, totals)]]


# ---- names of the library

def without_comments(text):
    return re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.S)


def installed_headers():
    """Returns the texts of the public headers and of the headers that they include, except those in the private folders of raster."""
    listed = re.search(r"set\(halfspace_public_headers(.*?)\)", (ROOT / "cmake" / "install.cmake").read_text(), re.S)[1].split()
    texts, waiting = {}, listed
    while waiting:
        name = waiting.pop()
        path = ROOT / "src" / name
        if name in texts or re.match(r"raster/\w+/", name) or not path.is_file():
            continue
        texts[name] = without_comments(path.read_text(encoding="utf-8"))
        waiting += re.findall(r'#include "halfspace/([^"]+)"', texts[name])
    return texts.values()


def body_from(text, brace):
    """Returns the text from an opening brace to its closing one."""
    depth = 0
    for match in re.finditer(r"[{}]", text[brace:]):
        depth += 1 if match[0] == "{" else -1
        if depth == 0:
            return text[brace : brace + match.end()]
    return text[brace:]


class Library:
    """What the headers declare."""

    def __init__(self, headers):
        self.text = "\n".join(headers)
        self.bodies = {}
        for match in re.finditer(r"(?<![<,] )(?<!<)\b(?:struct|class|enum(?: class)?) (\w+)\b[^;{}()]*\{", self.text):
            self.bodies[match[1]] = self.bodies.get(match[1], "") + body_from(self.text, match.end() - 1)

    def declares(self, name):
        """name: a type, function, constant or concept, or a member of a type as Type::member."""
        first, _, member = name.partition("::")
        if member:
            return re.search(rf"\b{member}\b", self.bodies.get(first, "")) is not None
        declarations = (rf"\b(?:struct|class|enum(?: class)?|using|concept) {name}\b", rf"\bconstexpr [\w:<> ]+ {name}\b",
                        rf"^(?:(?!\breturn\b)[\w:<>,&* ])*[\w>&*] [&*]?{name}\(")
        return any(re.search(d, self.text, re.M) for d in declarations)

    def missing_names(self, code):
        """Returns the names in a piece of code that are not declared. Parameters such as R and names of std and glm are not checked."""
        names = re.findall(r"[A-Za-z_]\w*(?:::\w+)*", re.sub(r'"[^"]*"', "", code))
        checked = [n for n in names if len(n) > 1 and not n.startswith(("std::", "glm::"))]
        return [n for n in checked if not self.declares(n)] if names else [code]


# ---- names of tests

class Tests:
    """The tests of the folder tests."""

    def __init__(self, texts, compile_tests):
        self.names, self.groups, self.compile_tests = set(), set(), set(compile_tests)
        for text in texts:
            self.names |= {f"{suite}.{name}" for suite, name in re.findall(r"^(?:TYPED_)?TEST(?:_F|_P)?\((\w+), (\w+)\)", text, re.M)}
            self.groups |= set(re.findall(r"^INSTANTIATE_TEST_SUITE_P\(Conformance, (\w+),", text, re.M))

    def exists(self, name):
        if name.startswith(GROUP_PREFIX):
            return name.removeprefix(GROUP_PREFIX) in self.groups
        if name.startswith(COMPILE_PREFIX):
            return name.removeprefix(COMPILE_PREFIX) in self.compile_tests
        return name in self.names


def tests_of_tree():
    texts = [path.read_text(encoding="utf-8") for path in sorted((ROOT / "tests").rglob("*.cpp"))]
    return Tests(texts, [path.stem for path in (ROOT / "tests" / "compile").glob("*.cpp")])


# ---- the check

def problems_of_row(row, library, tests):
    if len(row) != len(COLUMNS):
        return [f"{row[0]}: {len(row)} cells; expected {len(COLUMNS)}"]
    feature, since, here, test = row
    state, found = state_of(here), []
    if not re.fullmatch(r"3\.3|4\.[0-6]|[A-Z]+_\w+", since):
        found.append(f"since {since}; expected 3.3, 4.0 to 4.6 or an extension")
    if state is None:
        found.append("no state; expected an API name, 'partly: …', 'no' or 'not applicable: …'")
    if state == "present" and not quoted(test):
        found.append("present without a test")
    if state == "partly" and not quoted(here):
        found.append("partly present without an API name")
    if state in ("absent", "does not apply") and test != "":
        found.append("a test of something that is absent")
    found += [f"the headers do not declare {name}" for code in quoted(here) for name in library.missing_names(code)]
    found += [f"there is no test {name}" for name in quoted(test) if not tests.exists(name)]
    return [f"{feature}: {problem}" for problem in found]


def problems(text, library, tests):
    rows = list(table_rows(text, COLUMNS))
    found = [problem for row in rows for problem in problems_of_row(row, library, tests)]
    if not found and list(table_rows(text, COUNT_COLUMNS)) != count_rows(rows):
        found.append(f"the table of counts is wrong; expected {count_rows(rows)}")
    return found


class Document(unittest.TestCase):
    def test_names_and_counts_are_correct(self):
        text = DOCUMENT.read_text(encoding="utf-8")
        self.assertGreater(len(list(table_rows(text, COLUMNS))), 150)  # the tables were found
        self.assertEqual(problems(text, Library(installed_headers()), tests_of_tree()), [])

    def test_features_are_listed_once(self):
        features = [row[0] for row in table_rows(DOCUMENT.read_text(encoding="utf-8"), COLUMNS)]
        self.assertEqual(sorted({f for f in features if features.count(f) > 1}), [])


class Checks(unittest.TestCase):
    """Tests that the checks detect wrong rows."""

    LIBRARY = Library(["struct Box : Shape {\n  int width = 0;\n};\nenum class Op : int { add, take };\ntemplate <class T>\n"
                       "Box make_box(T x) { return box_of(x); }\ninline constexpr int kBoxes = 3;\ntemplate <int n, class T>\n"
                       "struct Lid {\n  T handle;\n};\n"])
    TESTS = Tests(["TEST(Boxes, AreWide) {\nTYPED_TEST(Types, Fit) {\nINSTANTIATE_TEST_SUITE_P(Conformance, Blend, x);\n"], ["wrong_box"])

    def check(self, here, test="", since="3.3"):
        return problems_of_row(["glBox", since, here, test], self.LIBRARY, self.TESTS)

    def test_correct_rows(self):
        for here, test in (("`Box::width`", "`Boxes.AreWide`"), ("`Lid::handle`", "`Types.Fit`"),
                           ("`make_box`, `Op::take`; the rest", "`Conformance/Blend`, `Types.Fit`"),
                           ('`make_box<Op::add>` of a `std::array`', "`Compile.wrong_box`"), ("partly: `kBoxes`; others are missing", ""),
                           ("no", ""), ("no; use a larger one", ""), ("not applicable: everything is a box", "")):
            self.assertEqual(self.check(here, test), [], here)

    def test_names_that_do_not_exist(self):
        for here in ("`Box::height`", "`Shape::width`", "`make_boxes`", "`box_of`", "`Op::width`", "`take`", "`make_box<Op::put>`",
                     "partly: `kBox`"):
            self.assertIn("do not declare", " ".join(self.check(here, "`Boxes.AreWide`")), here)
        for test in ("`Boxes.AreHigh`", "`Boxes`", "`Blend`", "`Conformance/Boxes`", "`Compile.box`", "`Boxes.AreWide`, `Types.Fits`"):
            self.assertIn("there is no test", " ".join(self.check("`Box`", test)), test)

    def test_rows_without_state_name_or_test(self):
        for here, test in (("", ""), ("yes", ""), ("`Box`", ""), ("partly: some", ""), ("no", "`Boxes.AreWide`"), ("nothing", "")):
            self.assertEqual(len(self.check(here, test)), 1, here)
        self.assertEqual(len(self.check("no", since="3.4")), 1)
        self.assertEqual(len(problems_of_row(["glBox", "3.3", "no"], self.LIBRARY, self.TESTS)), 1)

    def test_counts(self):
        text = ("| OpenGL | since | Halfspace | test |\n|---|---|---|---|\n| a | 3.3 | `Box` | `Boxes.AreWide` |\n| b | 4.2 | no | |\n"
                "\n| state | 3.3 core | later |\n|---|---|---|\n| present | 1 | 0 |\n| partly | 0 | 0 |\n| absent | 0 | 1 |\n"
                "| does not apply | 0 | 0 |\n| all | 1 | 1 |\n")
        self.assertEqual(problems(text, self.LIBRARY, self.TESTS), [])
        self.assertIn("counts", problems(text.replace("| absent | 0 | 1 |", "| absent | 1 | 1 |"), self.LIBRARY, self.TESTS)[0])
        self.assertIn("no test", problems(text.replace("AreWide", "AreMadeUp"), self.LIBRARY, self.TESTS)[0])


if __name__ == "__main__":
    if sys.argv[1:] == ["--counts"]:
        for cells in [COUNT_COLUMNS, ["---"] * 3, *count_rows(list(table_rows(DOCUMENT.read_text(encoding="utf-8"), COLUMNS)))]:
            print("| " + " | ".join(cells) + " |" if cells[0] != "---" else "|---|---|---|")
    else:
        unittest.main()
