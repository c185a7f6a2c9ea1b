#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests the programs and the Python module of portable builds (HALFSPACE_PORTABLE), which select a library that matches the processor.

    portable_test.py BUILD_V3 BUILD_V4     two portable builds, for x86-64-v3 and x86-64-v4

The Python module is tested if both builds have it. Both are installed into one prefix, as scripts/package.sh packages them.
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import no_skips  # noqa: E402

LOADER = "/lib64/ld-linux-x86-64.so.2"
PREFIX = None
PYTHON = "/usr/bin/python3"
HAS_V4 = "x86-64-v4 (supported" in subprocess.run([LOADER, "--help"], capture_output=True, text=True).stdout
QEMU = shutil.which("qemu-x86_64")
# Processors and virtual machines that can run our code for x86-64-v3. glibc does not assign x86-64-v3 to the second and the third. The last
# one has AVX-512, which qemu-user does not emulate (up to version 9).
V3_PROCESSORS = ("Haswell", "Haswell,-abm", "Haswell,-movbe", "EPYC", "Skylake-Server")
OLD_PROCESSORS = ("qemu64", "Nehalem", "SandyBridge", "Haswell,-avx2")
REJECTED = r"halfspace: this build needs .*AVX2.*processor does not support; packages .*need .*x86-64-v3"


# Reads a table with gathers that use different registers, and prints how many of them return wrong values.
GATHERS = """
#include <cstdio>
alignas(32) static const int table[8] = {1, 2, 3, 4, 5, 6, 7, 8}, index[8] = {7, 6, 5, 4, 3, 2, 1, 0};
int main() {
  int wrong = 0;
  alignas(32) int out[8];
  %s
  std::printf("%%d\\n", wrong);
}
"""
GATHER = """
  asm volatile("vmovdqa (%%1), %%%%ymm{x}\\n vpcmpeqd %%%%ymm{m}, %%%%ymm{m}, %%%%ymm{m}\\n vpxor %%%%ymm{d}, %%%%ymm{d}, %%%%ymm{d}\\n"
               "vgatherdps %%%%ymm{m}, (%%2, %%%%ymm{x}, 4), %%%%ymm{d}\\n vmovdqa %%%%ymm{d}, (%%0)"
               :: "r"(out), "r"(index), "r"(table) : "memory", "xmm{x}", "xmm{m}", "xmm{d}");
  wrong += out[0] != 8 || out[7] != 1;
""".replace("%%", "%")


def run(*command):
    return subprocess.run([str(c) for c in command], capture_output=True, text=True, timeout=600)


def arch_of(*command):
    result = run(*command, "info", "--json")
    assert result.returncode == 0, result.stderr
    return json.loads(result.stdout)["arch"]


class Selection(unittest.TestCase):
    def setUp(self):
        self.program = PREFIX / "bin" / "halfspace"

    def test_the_best_library_for_the_processor_is_selected(self):
        self.assertEqual(arch_of(self.program), "x86-64-v4" if HAS_V4 else "x86-64-v3")

    def test_a_mask_selects_v3(self):
        self.assertEqual(arch_of(LOADER, "--glibc-hwcaps-mask", "x86-64-v3", self.program), "x86-64-v3")

    def test_prepending_prefers_v3(self):
        self.assertEqual(arch_of(LOADER, "--glibc-hwcaps-prepend", "x86-64-v3", self.program), "x86-64-v3")

    @unittest.skipUnless(HAS_V4, "the processor has no AVX-512")
    def test_prepending_prefers_v4_to_what_the_mask_selects(self):
        options = ("--glibc-hwcaps-mask", "x86-64-v3", "--glibc-hwcaps-prepend", "x86-64-v4")
        self.assertEqual(arch_of(LOADER, *options, self.program), "x86-64-v4")

    def test_v3_is_used_if_the_loader_assigns_a_lower_level(self):
        self.assertEqual(arch_of(LOADER, "--glibc-hwcaps-mask", "x86-64-v2", self.program), "x86-64-v3")

    def test_a_missing_library_gives_a_one_line_error(self):
        with tempfile.TemporaryDirectory() as folder:
            shutil.copy(self.program, folder)
            result = run(Path(folder) / "halfspace", "info")
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"^halfspace: libhalfspace-cli\.so\.\S+: cannot open.*\n$")

    @unittest.skipUnless(HAS_V4, "the processor has no AVX-512")
    def test_both_libraries_render_the_same_picture(self):
        pictures = []
        for mask in ("x86-64-v3", "x86-64-v4"):
            picture = PREFIX / f"{mask}.png"
            result = run(LOADER, "--glibc-hwcaps-mask", mask, self.program, "render", "moon", "--size", "160x90", "-o", picture)
            self.assertEqual(result.returncode, 0, result.stderr)
            pictures.append(picture.read_bytes())
        self.assertEqual(*pictures)

    def test_decoders_are_found(self):
        picture = PREFIX / "picture.jpg"
        for command in (("render", "earth", "--size", "64x36", "-o", picture), ("compare", picture, picture)):
            result = run(self.program, *command)
            self.assertEqual(result.returncode, 0, result.stderr)

    def test_the_benchmark_starts(self):
        self.assertIn("Usage", run(PREFIX / "bin" / "halfspace-bench", "--help").stdout)


class PythonModule(unittest.TestCase):
    def setUp(self):
        self.packages = PREFIX / "lib" / "python3" / "dist-packages"
        if not (self.packages / "halfspace").exists():
            self.skipTest("the builds have no Python module")

    def start(self, code, *before):
        return subprocess.run([*before, PYTHON, "-c", code], capture_output=True, text=True, cwd=PREFIX,
                              env={**os.environ, "PYTHONPATH": str(self.packages)})

    def python(self, code, *before):
        result = self.start(code, *before)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout.strip()

    def arch(self, *before):
        return self.python("import halfspace; print(halfspace._core.arch)", *before)

    def test_the_best_library_for_the_processor_is_selected(self):
        self.assertEqual(self.arch(), "x86-64-v4" if HAS_V4 else "x86-64-v3")

    def test_the_same_library_as_of_the_programs_is_selected(self):
        for mask in ("x86-64-v2", "x86-64-v3", "x86-64-v4"):
            before = (LOADER, "--glibc-hwcaps-mask", mask)
            self.assertEqual(self.arch(*before), arch_of(*before, PREFIX / "bin" / "halfspace"), mask)

    @unittest.skipUnless(HAS_V4, "the processor has no AVX-512")
    def test_both_libraries_render_the_same_picture(self):
        code = "import halfspace, hashlib; print(hashlib.sha256(halfspace.render('moon', size=(160, 90)).tobytes()).hexdigest())"
        self.assertEqual(self.python(code, LOADER, "--glibc-hwcaps-mask", "x86-64-v3"), self.python(code))

    def test_there_is_one_extension_and_one_library_for_each_instruction_set(self):
        package = self.packages / "halfspace"
        found = sorted(str(path.relative_to(package)).split(".")[0] for path in package.rglob("*.so"))
        self.assertEqual(found, ["_core", "glibc-hwcaps/x86-64-v3/_library", "glibc-hwcaps/x86-64-v4/_library"])

    @unittest.skipUnless(QEMU, "qemu-user is not installed")
    def test_it_is_imported_on_every_processor_that_can_run_it(self):
        for cpu in V3_PROCESSORS:
            self.assertEqual(self.arch(QEMU, "-cpu", cpu), "x86-64-v3", cpu)

    @unittest.skipUnless(QEMU, "qemu-user is not installed")
    def test_a_processor_below_v3_is_rejected_in_one_line(self):
        for cpu in OLD_PROCESSORS:
            result = self.start("import halfspace", QEMU, "-cpu", cpu)
            self.assertEqual((result.returncode, result.stdout), (1, ""), cpu)
            self.assertRegex(result.stderr.splitlines()[-1], f"^ImportError: {REJECTED}$")

    def test_decoders_are_found(self):
        picture = PREFIX / "map.jpg"
        self.assertEqual(run(PREFIX / "bin" / "halfspace", "render", "earth", "--size", "64x36", "-o", picture).returncode, 0)
        code = f"import halfspace; print(halfspace.render('earth', size=(8, 8), set={{'earth.color': {str(picture)!r}}}).shape)"
        self.assertEqual(self.python(code), "(8, 8, 3)")


def emulates_gathers():
    """Returns False for qemu-user 7.2.22 (Debian 12), in which some gathers return zeros, depending on their registers."""
    registers = [(m, x, (m + 3 * x + 1) % 16) for m in range(16) for x in range(16)]
    gathers = [GATHER.format(m=m, x=x, d=d) for m, x, d in registers if len({m, x, d}) == 3]
    source, program = PREFIX / "gathers.cpp", PREFIX / "gathers"
    source.write_text(GATHERS % "".join(gathers))
    subprocess.run(["c++", source, "-o", program], check=True)
    assert run(program).stdout == "0\n"
    return run(QEMU, "-cpu", "Haswell", program).stdout == "0\n"


@unittest.skipUnless(QEMU, "qemu-user is not installed")
class Emulation(unittest.TestCase):
    def test_a_processor_below_v3_is_rejected_in_one_line(self):
        for program in ("halfspace", "halfspace-bench"):
            for cpu in OLD_PROCESSORS:
                result = run(QEMU, "-cpu", cpu, PREFIX / "bin" / program, "--help")
                self.assertEqual((result.returncode, result.stdout), (1, ""), cpu)
                lines = [line for line in result.stderr.splitlines() if "TCG doesn't support" not in line]
                self.assertEqual(len(lines), 1, result.stderr)
                self.assertRegex(lines[0], f"^{REJECTED}$")

    def test_every_processor_that_can_run_the_v3_library_does(self):
        (PREFIX / "triangle.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        for cpu in V3_PROCESSORS:
            emulator = (QEMU, "-cpu", cpu)
            self.assertEqual(arch_of(*emulator, PREFIX / "bin" / "halfspace"), "x86-64-v3")
            picture = PREFIX / f"{cpu}.png"
            result = run(*emulator, PREFIX / "bin" / "halfspace", "render", PREFIX / "triangle.obj", "--size", "16x16", "-o", picture)
            self.assertEqual((result.returncode, picture.exists()), (0, True), result.stderr)

    def test_a_v3_processor_renders_the_same_picture(self):
        if not emulates_gathers():
            self.skipTest("this version of qemu-user executes some gathers incorrectly")
        pictures = []
        for emulator in ((), (QEMU, "-cpu", "Haswell")):
            picture = PREFIX / "emulated.png"
            result = run(*emulator, PREFIX / "bin" / "halfspace", "render", "moon", "--size", "64x36", "-o", picture)
            self.assertEqual(result.returncode, 0, result.stderr)
            pictures.append(picture.read_bytes())
        self.assertEqual(*pictures)


class Libraries(unittest.TestCase):
    def test_a_program_library_exports_one_function(self):
        for level in ("v3", "v4"):
            for name in ("cli", "bench"):
                library = next(PREFIX.glob(f"lib/**/glibc-hwcaps/x86-64-{level}/libhalfspace-{name}.so.*"))
                symbols = run("nm", "-D", "--defined-only", library).stdout.split("\n")
                self.assertEqual([line.split()[-1] for line in symbols if line], [f"halfspace_{name}_main"])
                # An empty entry would mean the working directory.
                runpath = re.search(r"R(?:UN)?PATH.*\[(.*)\]", run("readelf", "-d", library).stdout)
                self.assertEqual(runpath[1], "$ORIGIN/../..")


def main():
    global PREFIX
    with tempfile.TemporaryDirectory(prefix="halfspace-portable-") as folder:
        PREFIX = Path(folder)
        for build, component in ((sys.argv[1], []), (sys.argv[2], ["--component", "isa"]), (sys.argv[2], ["--component", "python"])):
            subprocess.run(["cmake", "--install", build, "--prefix", folder, *component], check=True, capture_output=True)
        print(f"the processor has {'AVX-512' if HAS_V4 else 'no AVX-512'}; qemu-user is {'' if QEMU else 'not '}installed")
        return no_skips.main()


if __name__ == "__main__":
    sys.exit(main())
