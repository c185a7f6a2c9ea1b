#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests the programs of portable builds (HALFSPACE_PORTABLE), which select a library that matches the processor's instruction set.

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
CPU_FLAGS = set(re.search(r"^flags\s*:(.*)$", Path("/proc/cpuinfo").read_text(), re.M)[1].split())
HAS_V4 = {"avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl"} <= CPU_FLAGS
QEMU = shutil.which("qemu-x86_64")
# Python code that hides a feature of x86-64-v4 from the module when it reads /proc/cpuinfo.
WITHOUT_AVX512BW = """
import builtins, io
open_file = builtins.open
def open_without_avx512bw(path, *arguments, **named):
    file = open_file(path, *arguments, **named)
    return io.StringIO(file.read().replace(" avx512bw", "")) if path == "/proc/cpuinfo" else file
builtins.open = open_without_avx512bw
"""


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

    def test_a_mask_without_any_library_gives_a_one_line_error(self):
        result = run(LOADER, "--glibc-hwcaps-mask", "x86-64-v2", self.program, "info")
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

    def python(self, code, folder=""):
        result = subprocess.run(["/usr/bin/python3", "-c", code], capture_output=True, text=True, cwd=PREFIX,
                                env={**os.environ, "PYTHONPATH": str(self.packages / folder)})
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout.strip()

    def test_the_best_extension_for_the_processor_is_selected(self):
        self.assertEqual(self.python("import halfspace; print(halfspace._core.arch)"), "x86-64-v4" if HAS_V4 else "x86-64-v3")

    def test_v3_is_selected_without_avx512bw(self):
        self.assertEqual(self.python(WITHOUT_AVX512BW + "import halfspace; print(halfspace._core.arch)"), "x86-64-v3")

    @unittest.skipUnless(HAS_V4, "the processor has no AVX-512")
    def test_both_extensions_render_the_same_picture(self):
        code = "import halfspace, hashlib; print(hashlib.sha256(halfspace.render('moon', size=(160, 90)).tobytes()).hexdigest())"
        self.assertEqual(self.python(WITHOUT_AVX512BW + code), self.python(code))

    def test_each_folder_has_the_extension_of_its_name(self):
        for level in ("x86-64-v3", "x86-64-v4"):
            folder = f"halfspace/{level}"
            self.assertEqual(len(list((self.packages / folder).glob("_core*.so"))), 1, level)
            if level == "x86-64-v3" or HAS_V4:
                self.assertEqual(self.python("import _core; print(_core.arch)", folder), level)

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
            for cpu in ("qemu64", "Nehalem", "SandyBridge"):
                result = run(QEMU, "-cpu", cpu, PREFIX / "bin" / program, "--help")
                self.assertEqual((result.returncode, result.stdout), (1, ""), cpu)
                lines = [line for line in result.stderr.splitlines() if "TCG doesn't support" not in line]
                self.assertEqual(len(lines), 1, result.stderr)
                self.assertRegex(lines[0], "^halfspace: this build needs .*AVX2.*processor does not support; packages .*need .*x86-64-v3$")

    def test_a_v3_processor_runs_the_v3_library(self):
        self.assertEqual(arch_of(QEMU, "-cpu", "Haswell", PREFIX / "bin" / "halfspace"), "x86-64-v3")

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
