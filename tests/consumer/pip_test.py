#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Builds a wheel of the source tree with pip, installs it into a temporary folder and renders with it.

Uses the packages of the system (`--no-build-isolation`), so it needs no network. Skipped if one of them is missing.
"""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import no_skips  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
PYTHON = "/usr/bin/python3"
NEEDED = {"pip": "python3-pip", "setuptools": "python3-setuptools", "wheel": "python3-wheel", "numpy": "python3-numpy"}


def missing_packages():
    """Returns the Debian packages that are missing."""
    return [package for module, package in NEEDED.items() if subprocess.run([PYTHON, "-c", f"import {module}"], capture_output=True).returncode != 0]


def run(*command, **environment):
    result = subprocess.run([str(c) for c in command], capture_output=True, text=True, env={**os.environ, **environment}, cwd=FOLDER)
    assert result.returncode == 0, result.stdout[-3000:] + result.stderr[-3000:]
    return result.stdout


class Wheel(unittest.TestCase):
    def test_it_contains_the_package_the_extension_and_the_decoders(self):
        self.assertRegex(WHEEL.name, r"^halfspace-[0-9.]+-cp3\d+-cp3\d+-linux_x86_64\.whl$")
        names = zipfile.ZipFile(WHEEL).namelist()
        sources = {f"halfspace/{path.name}" for path in (ROOT / "python" / "halfspace").iterdir() if path.suffix in (".py", ".typed")}
        others = {name for name in names if ".dist-info/" not in name} - sources
        self.assertLessEqual(sources, set(names))
        extensions = {name for name in others if name.startswith("halfspace/_core") and name.endswith(".so")}
        self.assertEqual(len(extensions), 1, names)
        tools = others - extensions
        self.assertIn("halfspace/halfspace-jpeg-tool", tools)
        self.assertLessEqual(tools, {f"halfspace/halfspace-{kind}-tool" for kind in ("jpeg", "image", "draco")})

    def test_it_is_built_for_the_instruction_set_of_the_arguments(self):
        self.assertEqual(self.python("import halfspace; print(halfspace._core.arch)"), "x86-64-v3")

    def test_its_version_matches_the_library(self):
        code = "import halfspace, importlib.metadata as m; print(m.version('halfspace') == halfspace.__version__)"
        self.assertEqual(self.python(code), "True")

    def test_it_renders_and_decodes(self):
        code = """if True:
            import halfspace
            halfspace.render("earth", size=(64, 36)).save("map.jpg")
            print(halfspace.render("earth", size=(8, 8), set={"earth.color": "map.jpg"}).shape)"""
        self.assertEqual(self.python(code), "(8, 8, 3)")

    def python(self, code):
        return run(PYTHON, "-c", code, PYTHONPATH=str(FOLDER / "site")).strip()


def main():
    global FOLDER, WHEEL
    missing = missing_packages()
    if missing:
        print(f"skipped: {', '.join(missing)} not installed")
        return int(no_skips.skipped_tests_fail())
    with tempfile.TemporaryDirectory(prefix="halfspace-pip-") as folder:
        FOLDER = Path(folder)
        shutil.copytree(ROOT, FOLDER / "tree", ignore=shutil.ignore_patterns(".git", "build", "out", "__pycache__"))
        run(PYTHON, "-m", "pip", "wheel", "--no-build-isolation", "--no-deps", "--no-index", "-w", FOLDER, FOLDER / "tree",
            CMAKE_ARGS="-DHALFSPACE_ARCH=x86-64-v3")
        WHEEL = next(FOLDER.glob("*.whl"))
        run(PYTHON, "-m", "pip", "install", "--no-deps", "--no-index", "--target", FOLDER / "site", WHEEL)
        return no_skips.main()


if __name__ == "__main__":
    sys.exit(main())
