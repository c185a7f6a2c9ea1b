#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Builds a wheel of the source tree with pip, installs it into a temporary folder and renders with it, also on emulated processors.

Uses the packages of the system (`--no-build-isolation`), so it needs no network. Skipped if one of them is missing.
"""
import json
import os
import re
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
QEMU = shutil.which("qemu-x86_64")
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
        extensions = sorted(name.split(".")[0] for name in others if name.endswith(".so"))
        self.assertEqual(extensions, ["halfspace/_core", "halfspace/_library"])
        programs = {name for name in others if not name.endswith(".so")}
        expected = {"_halfspace_command.py", "halfspace/halfspace", "halfspace/halfspace-jpeg-tool"}
        self.assertLessEqual(expected, programs)
        self.assertLessEqual(programs, expected | {f"halfspace/halfspace-{kind}-tool" for kind in ("image", "draco")})

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

    def test_its_command_renders_and_decodes(self):
        self.assertEqual(json.loads(command("info", "--json").stdout)["arch"], "x86-64-v3")
        for arguments in (("render", "earth", "--size", "64x36", "-o", "picture.jpg"), ("compare", "picture.jpg", "picture.jpg")):
            result = command(*arguments)
            self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_its_code_uses_neither_lzcnt_nor_movbe(self):
        for file in ("halfspace", "halfspace-jpeg-tool", "_library*.so"):
            (file,) = (FOLDER / "site" / "halfspace").glob(file)
            code = run("objdump", "-d", "--no-show-raw-insn", file)
            self.assertIn("vfmadd", code + "vfmadd" * file.name.endswith("tool"))
            self.assertIsNone(re.search(r"\t(lzcnt|movbe)\b", code), file.name)

    @unittest.skipUnless(QEMU, "qemu-user is not installed")
    def test_it_runs_on_processors_with_its_features(self):
        (FOLDER / "triangle.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        for processor in ("Haswell", "Haswell,-abm", "Haswell,-movbe", "EPYC", "Skylake-Server", "max"):
            picture = FOLDER / f"{processor}.png"
            result = emulated(processor, FOLDER / "site" / "halfspace" / "halfspace", "render", "triangle.obj", "--size", "16x16", "-o", picture)
            self.assertEqual((result.returncode, result.stderr, picture.exists()), (0, "", True), processor)
            result = emulated(processor, PYTHON, "-c", "import halfspace; print(halfspace._core.lanes)")
            self.assertEqual((result.returncode, result.stdout), (0, "8\n"), processor + result.stderr)

    @unittest.skipUnless(QEMU, "qemu-user is not installed")
    def test_other_processors_are_rejected_in_one_line(self):
        line = "halfspace: this build needs .*AVX2.*, which this processor does not support; rebuild with -DHALFSPACE_ARCH=x86-64-v2"
        for processor in ("Nehalem", "SandyBridge", "Haswell,-avx2"):
            result = emulated(processor, FOLDER / "site" / "halfspace" / "halfspace", "render", "moon")
            self.assertEqual(result.returncode, 1, processor)
            self.assertRegex(result.stderr, f"^{line}\n$")
            result = emulated(processor, PYTHON, "-c", "import halfspace")
            self.assertEqual(result.returncode, 1, processor)
            self.assertRegex(result.stderr.splitlines()[-1], f"^ImportError: {line}$")

    def python(self, code):
        return run(PYTHON, "-c", code, PYTHONPATH=str(FOLDER / "site")).strip()


def command(*arguments):
    """Runs the command that pip installed."""
    return subprocess.run([FOLDER / "site" / "bin" / "halfspace", *arguments], capture_output=True, text=True, cwd=FOLDER,
                          env={**os.environ, "PYTHONPATH": str(FOLDER / "site")})


def emulated(processor, *command):
    """Runs a command on an emulated processor. Its /proc/cpuinfo is that of this machine."""
    result = subprocess.run([QEMU, "-cpu", processor, *command], capture_output=True, text=True, cwd=FOLDER,
                            env={**os.environ, "PYTHONPATH": str(FOLDER / "site")})
    result.stderr = "".join(line + "\n" for line in result.stderr.splitlines() if "TCG doesn't support" not in line)
    return result


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
