#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests which files and folders scripts/install.sh adds and removes, and which packages scripts/install_deps.sh installs. Stand-ins replace
CMake, which installs a list of empty files instead of a real build, and apt."""
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CMAKE = """#!/bin/sh
case "$1" in
  -S) for argument; do case "$argument" in -DCMAKE_INSTALL_PREFIX=*) printf %s "${argument#*=}" > prefix ;; esac; done ;;
  --build) echo built >> built ;;
  --install) for file in $FILES; do mkdir -p "$DESTDIR$(cat prefix)/$(dirname "$file")"; : > "$DESTDIR$(cat prefix)/$file"; done ;;
esac
"""
MANIFEST = "share/halfspace/installed_files.txt"


def entries(folder):
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*"))


class InstallScript(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="halfspace install "))
        self.addCleanup(shutil.rmtree, self.folder)
        self.prefix = self.folder / "a prefix [1]"
        for name, text in (("tree/scripts/install.sh", (ROOT / "scripts" / "install.sh").read_text()),
                           ("tree/scripts/install_deps.sh", "#!/bin/sh\n"), ("bin/cmake", CMAKE)):
            path = self.folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
            path.chmod(0o755)

    def run_script(self, *arguments, files="", code=0):
        environment = {**os.environ, "PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}", "FILES": files}
        result = subprocess.run([self.folder / "tree/scripts/install.sh", *arguments], env=environment, capture_output=True, text=True, cwd=self.folder)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        return result.stdout + result.stderr

    def test_uninstalling_leaves_nothing(self):
        self.run_script(self.prefix, files="bin/halfspace share/man/man1/halfspace.1")
        self.assertTrue((self.prefix / "share/man/man1/halfspace.1").exists())
        self.assertEqual(self.run_script("--uninstall", self.prefix), f"removed 3 files from {self.prefix}\n")
        self.assertFalse(self.prefix.exists())

    def test_folders_and_files_of_others_are_kept(self):
        (self.prefix / "share/man/man1").mkdir(parents=True)
        before = entries(self.prefix)
        self.run_script(self.prefix, files="bin/halfspace share/man/man1/halfspace.1")
        (self.prefix / "bin/other").touch()
        self.run_script("--uninstall", self.prefix)
        self.assertEqual(entries(self.prefix), sorted([*before, "bin", "bin/other"]))

    def test_a_second_installation_replaces_the_first(self):
        (self.prefix / "share").mkdir(parents=True)
        self.run_script(self.prefix, files="bin/halfspace lib/old/gone.so lib/stays.a")
        self.run_script(self.prefix, files="bin/halfspace lib/stays.a")
        self.assertEqual(entries(self.prefix), ["bin", "bin/halfspace", "lib", "lib/stays.a", "share", "share/halfspace", MANIFEST])
        self.run_script("--uninstall", self.prefix)
        self.assertEqual(entries(self.prefix), ["share"])

    def test_compiled_python_files_are_removed(self):
        self.run_script(self.prefix, files="lib/python3/site-packages/halfspace/__init__.py")
        (self.prefix / "lib/python3/site-packages/halfspace/__pycache__").mkdir()
        (self.prefix / "lib/python3/site-packages/halfspace/__pycache__/mesh.cpython.pyc").touch()
        self.run_script("--uninstall", self.prefix)
        self.assertFalse(self.prefix.exists())

    def test_a_relative_prefix_starts_at_the_working_directory(self):
        self.run_script("own", files="bin/halfspace")
        self.assertTrue((self.folder / "own/bin/halfspace").exists())

    def test_a_prefix_that_cannot_be_written_is_rejected_before_the_build(self):
        self.prefix.write_text("a file")
        out = self.run_script(self.prefix / "below", files="bin/halfspace", code=1)
        self.assertRegex(out, r"^install\.sh: cannot write to .*; expected a different prefix.*\n$")
        self.assertFalse((self.folder / "tree/built").exists())

    def test_a_prefix_without_an_installation_is_reported(self):
        out = self.run_script("--uninstall", self.prefix, code=1)
        self.assertRegex(out, r"^install\.sh: .* does not exist; expected a prefix that .*\n$")


class InstallDependencies(unittest.TestCase):
    """Runs scripts/install_deps.sh on a system without packages."""

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="halfspace packages "))
        self.addCleanup(shutil.rmtree, self.folder)
        log = self.folder / "log"
        for name, text in (("dpkg-query", "exit 1"), ("apt-get", f"echo \"$@\" > '{log}'"), ("id", "echo 0")):
            path = self.folder / name
            path.write_text(f"#!/bin/sh\n{text}\n")
            path.chmod(0o755)

    def packages(self, *arguments):
        environment = {**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}"}
        done = subprocess.run([ROOT / "scripts/install_deps.sh", *arguments], env=environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return set((self.folder / "log").read_text().split())

    def test_the_window_needs_no_browser(self):
        added = self.packages("--view") - self.packages()
        self.assertEqual(added, {"libsdl2-dev", "libimgui-dev", "libx11-dev", "fonts-dejavu-core"})

    def test_the_browser_and_the_x_server_are_for_tests(self):
        added = self.packages("--gui-tests") - self.packages()
        self.assertLessEqual({"chromium", "chromium-driver", "python3-selenium", "xvfb"}, added)
        self.assertNotIn("libimgui-dev", added)

    def test_the_options_that_scripts_and_documents_use_exist(self):
        files = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *ROOT.glob("docs/**/*.md"), *ROOT.glob("scripts/**/*.sh")]
        used = {option for file in files for line in re.findall(r"install_deps\.sh((?: --[a-z-]+)+)", file.read_text()) for option in line.split()}
        self.assertLessEqual({"--tests", "--view", "--gui-tests"}, used)
        self.packages(*sorted(used - {"--package"}))


if __name__ == "__main__":
    unittest.main()
