#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that every fault (tests/faults) and every patch in tests/off applies to the current tree."""

import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts" / "dev"))
sys.dont_write_bytecode = True
import mutate  # noqa: E402


def fault_problem(stem, content, root):
    """Returns the reason why a fault does not apply to the tree at root, or None."""
    try:
        fault = mutate.parse(stem, content)
        if not (root / fault.file).is_file():
            return f"{stem}: {fault.file} does not exist"
        fault.planted((root / fault.file).read_text(encoding="utf-8"))
        fault.tests()
    except mutate.FaultError as error:
        return str(error)
    return None


def patch_problem(patch, root):
    """Returns the reason why a patch does not apply without fuzz to the tree at root, or None."""
    command = ["patch", "--dry-run", "--force", "--silent", "--fuzz=0", "-p1", "-d", str(root), "-i", str(patch)]
    result = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return None if result.returncode == 0 else f"{patch.name}: {result.stdout.strip()}"


needs_patch = unittest.skipUnless(shutil.which("patch"), "the program patch is not installed (package patch on Debian and Ubuntu)")


class Tree(unittest.TestCase):
    def test_every_fault_applies(self):
        files = mutate.fault_files()
        self.assertTrue(files)
        problems = [fault_problem(path.stem, path.read_text(encoding="utf-8"), ROOT) for path in files]
        self.assertEqual([p for p in problems if p], [])

    def test_faults_are_unique(self):
        faults = mutate.load_all()
        self.assertEqual(len({fault.name for fault in faults}), len(faults))
        self.assertEqual(len({(fault.file, fault.old, fault.new) for fault in faults}), len(faults))

    @needs_patch
    def test_every_off_patch_applies(self):
        patches = sorted((ROOT / "tests" / "off").glob("*.patch"))
        self.assertTrue(patches)
        self.assertEqual([p for p in (patch_problem(patch, ROOT) for patch in patches) if p], [])


class Checks(unittest.TestCase):
    """Tests that the checks report faults and patches that do not apply."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        (self.root / "src" / "core").mkdir(parents=True)
        (self.root / "src" / "core" / "a.h").write_text("int one = 1;\nint two = 2;\nint three = 3;\n")
        (self.root / "a.h").write_text("int one = 1;\n")

    def problem(self, edits, file="src/core/a.h", name="A fault"):
        return fault_problem("stem", f"name: {name}\nfile: {file}\n{edits}", self.root)

    def test_faults_that_apply(self):
        self.assertIsNone(self.problem("- int one = 1;\n+ int one = 2;\n"))
        self.assertIsNone(self.problem("- one = 1;\n- int two\n+ one = 1;\n+ int deux\n"))
        self.assertIsNone(self.problem("- int two = 2;\n"))

    def test_faults_that_do_not_apply(self):
        self.assertIn("occurs 0 times", self.problem("- int four = 4;\n+ int four = 5;\n"))
        self.assertIn("occurs 3 times", self.problem("- int\n+ long\n"))
        self.assertIn("does not exist", self.problem("- int one\n+ long one\n", file="src/core/b.h"))
        self.assertIn("no test programs", self.problem("- int one\n+ long one\n", file="a.h"))

    def test_malformed_faults(self):
        self.assertIn("new text is the old text", self.problem("- int one\n+ int one\n"))
        self.assertIn("old text is empty", self.problem("- \n+ int one\n"))
        self.assertIn("expected a line", self.problem("+ int one\n"))
        self.assertIn("expected a line", self.problem("- int one\n+ long one\nsomething else\n"))
        self.assertIn("expected a line", self.problem("- int one\n+ long one\n", name=""))

    def test_planted_text(self):
        fault = mutate.parse("stem", "name: A fault\nfile: src/core/a.h\n- one = 1;\n- int two\n+ one = 1;\n+ int deux\n")
        self.assertEqual("int one = 1;\nint deux = 2;\n", fault.planted("int one = 1;\nint two = 2;\n"))
        self.assertEqual((fault.stem, fault.name, fault.file), ("stem", "A fault", "src/core/a.h"))

    def test_test_that_catches_a_fault(self):
        fault = mutate.parse("stem", "name: A fault\nfile: src/core/a.h\ntest: raster Clip.NearPlane/2\n- one\n+ two\n")
        self.assertEqual("raster Clip.NearPlane/2", fault.test)
        self.assertIsNone(mutate.parse("stem", "name: A fault\nfile: src/core/a.h\n- one\n+ two\n").test)
        self.assertIn("expected a line", self.problem("test: raster\n- one\n+ two\n"))
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "stem.fault"
            path.write_text("name: A fault\nfile: src/core/a.h\ntest: core Old.Test\n- test: one\n+ two\n")
            with unittest.mock.patch.object(mutate, "FAULTS", Path(folder)):
                mutate.record(mutate.parse("stem", path.read_text()), "raster New.Test")
            self.assertEqual("name: A fault\nfile: src/core/a.h\ntest: raster New.Test\n- test: one\n+ two\n", path.read_text())

    def test_copies_have_the_links_of_the_tree(self):
        self.assertIn("include/halfspace", mutate.listed_folder_links())
        with tempfile.TemporaryDirectory() as folder:
            copy = mutate.Copy(Path(folder), ["src/core/check.h"], 1)
            self.assertTrue((copy.root / "include" / "halfspace" / "core" / "check.h").is_file())

    def test_results_depend_on_the_fault_and_the_sources(self):
        first, second = (mutate.Fault("stem", "A fault", "src/core/a.h", "one", new) for new in ("two", "three"))
        self.assertEqual(mutate.fault_key("sources", first), mutate.fault_key("sources", first))
        self.assertNotEqual(mutate.fault_key("sources", first), mutate.fault_key("sources", second))
        self.assertNotEqual(mutate.fault_key("sources", first), mutate.fault_key("other", first))

    def test_selection(self):
        faults = [mutate.Fault(stem, stem, "src/core/a.h", "a", "b") for stem in ("first", "second", "third")]
        stems = lambda *arguments: [(number, fault.stem) for number, fault in mutate.select(faults, list(arguments))]
        self.assertEqual([(1, "first"), (2, "second"), (3, "third")], stems())
        self.assertEqual([(2, "second")], stems("2"))
        self.assertEqual([(2, "second"), (3, "third")], stems("2", "3"))
        self.assertEqual([(3, "third"), (1, "first")], stems("third", "first"))
        for wrong in "0", "4", "fourth":
            self.assertRaises(mutate.FaultError, stems, wrong)

    @needs_patch
    def test_patches(self):
        hunk = "--- a/a.h\n+++ b/a.h\n@@ -1 +1 @@\n-int {} = 1;\n+int {} = 2;\n"
        patch = self.root / "a.patch"
        patch.write_text(hunk.format("one", "one"))
        self.assertIsNone(patch_problem(patch, self.root))
        patch.write_text(hunk.format("four", "four"))
        self.assertIn("a.patch", patch_problem(patch, self.root))
        patch.write_text("--- a/b.h\n+++ b/b.h\n@@ -1 +1 @@\n-int one = 1;\n+int one = 2;\n")
        self.assertIn("a.patch", patch_problem(patch, self.root))


if __name__ == "__main__":
    unittest.main()
