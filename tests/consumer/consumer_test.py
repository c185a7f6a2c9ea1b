#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Installs a build into temporary folders and uses it from projects outside the tree.

    consumer_test.py BUILD_FOLDER COMPILER

The source tree is also added to a host project with add_subdirectory and with FetchContent. HALFSPACE_LONG_TESTS additionally builds that
project, compiles every public header on its own, compiles with pkg-config and clang, and compiles the other project at -O3 instead of -O1.
"""
import gzip
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import no_skips  # noqa: E402

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
LONG_TESTS = "HALFSPACE_LONG_TESTS" in os.environ
CLANG = shutil.which("clang++")
BUILD = COMPILER = TEMPORARY = PREFIX = None


def run(*command, **options):
    return subprocess.run([str(c) for c in command], capture_output=True, text=True, **options)


def expect(*command, **options):
    result = run(*command, **options)
    if result.returncode != 0:
        raise AssertionError(f"{shlex.join(map(str, command))}\n{result.stdout[-4000:]}{result.stderr[-4000:]}")
    return result.stdout


def cached(name):
    """Returns a variable of the build's CMake cache."""
    match = re.search(rf"^{name}:\w+=(.*)$", (BUILD / "CMakeCache.txt").read_text(), re.M)
    return match[1] if match else ""


def other_width(lanes):
    return 4 if lanes != 4 else 1


def files(folder):
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if not path.is_dir())


def configure(source, name, *arguments):
    folder = TEMPORARY / name
    options = ["-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_CXX_COMPILER={COMPILER}", f"-DCMAKE_CXX_FLAGS={cached('CMAKE_CXX_FLAGS')}"]
    if not LONG_TESTS:
        options.append("-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG")  # compiles faster
    result = run("cmake", "-S", source, "-B", folder, "-G", "Ninja", *options, *arguments)
    return folder, result


def package_flags():
    """Returns the compile flags of halfspace-core.pc without those of other packages."""
    text = (LIBRARIES / "pkgconfig" / "halfspace-core.pc").read_text()
    flags = re.search(r"^Cflags: (.*)$", text, re.M)[1]
    return shlex.split(flags.replace("${includedir}", str(PREFIX / "include")))


def module_headers():
    """Yields the public headers, for example halfspace/core/check.h."""
    text = (ROOT / "cmake" / "install.cmake").read_text()
    names = re.search(r"set\(halfspace_public_headers(.*?)\)", text, re.S)[1].split()
    for name in names:
        if name.split("/")[0] in MODULES:
            yield "halfspace/" + name


class Installation(unittest.TestCase):
    def test_destdir_contains_the_same_files(self):
        root = TEMPORARY / "root"
        expect("cmake", "--install", BUILD, "--prefix", "/opt/halfspace", env={**os.environ, "DESTDIR": str(root)})
        self.assertEqual(files(root / "opt" / "halfspace"), files(PREFIX))
        self.assertEqual([p.name for p in root.iterdir()], ["opt"])
        shutil.rmtree(root)

    def test_no_file_names_an_absolute_path(self):
        for name in files(PREFIX):
            path = PREFIX / name
            if path.suffix in (".cmake", ".pc", ".h"):
                text = path.read_text()
                for folder in (str(BUILD), str(ROOT), str(PREFIX)):
                    self.assertNotIn(folder, text, name)
                if path.suffix != ".h":
                    # For a prefix below /usr, CMake writes code that compares the folder of the file with the original prefix. In a moved
                    # prefix it has no effect.
                    text = re.sub(r"^# Use original install prefix.*?^unset\(_realCurr\)$", "", text, flags=re.M | re.S)
                    self.assertIsNone(re.search(r'["; =](/usr|/opt|/home)/', text), name)

    def test_programs_find_their_libraries(self):
        programs = [name for name, option in (("halfspace", "HALFSPACE_BUILD_APPS"), ("halfspace-bench", "HALFSPACE_BUILD_BENCHMARKS"))
                    if cached(option) == "ON"]
        installed = [path.name for path in (PREFIX / "bin").glob("halfspace*")]
        self.assertLessEqual(set(programs), set(installed))
        for program in installed:
            self.assertIn("Usage", expect(PREFIX / "bin" / program, "--help"))

    def test_macros_begin_with_the_prefixes_of_the_project(self):
        for name in files(PREFIX / "include"):
            for macro in re.findall(r"^\s*#\s*define\s+(\w+)", (PREFIX / "include" / name).read_text(), re.M):
                self.assertRegex(macro, "^(HS|HALFSPACE)_", name)

    @unittest.skipUnless(shutil.which("man"), "man is not installed")
    def test_manual_pages_are_valid(self):
        if not (PREFIX / "bin" / "halfspace").exists():
            self.skipTest("the build has no programs")
        pages = {path.name.removesuffix(".gz"): path for path in (PREFIX / "share" / "man" / "man1").iterdir()}  # compressed in packages
        def text(path):
            with gzip.open(path, "rt") if path.suffix == ".gz" else open(path) as page:
                return page.read()

        texts = {name: text(path) for name, path in pages.items()}
        self.assertIn(r"\-\-aov", texts["halfspace-render.1"])
        for name, path in pages.items():
            result = run("man", "--warnings", "-E", "UTF-8", "-Tutf8", "-l", path, env={**os.environ, "LC_ALL": "C.UTF-8", "MANWIDTH": "80"})
            self.assertEqual((result.returncode, result.stderr), (0, ""), name)
            self.assertLessEqual(texts[name].count(".SH OPTIONS\n"), 1, name)


class Package(unittest.TestCase):
    def test_programs_of_another_project_draw_the_expected_pixels(self):
        components = "raster;render" if "render" in MODULES else "raster"
        folder, result = configure(HERE, "consumer", f"-DCMAKE_PREFIX_PATH={PREFIX}", f"-DCOMPONENTS={components}")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        expect("cmake", "--build", folder, "-j", "2")
        self.assertIn("all pixels are as expected", expect(folder / "own_shader"))
        for name in ("picture.png", "picture.jpg"):
            expect(folder / "scene", LIBRARIES / "halfspace", folder / name)
            self.assertGreater((folder / name).stat().st_size, 1000)
        if cached("BUILD_SHARED_LIBS") == "ON":  # the decoders are found relative to the library
            expect(folder / "scene", "", folder / "picture.jpg")
        if LONG_TESTS:
            self.compare_pictures(folder)

    def compare_pictures(self, folder):
        program = PREFIX / "bin" / "halfspace"
        if program.exists():
            expect(program, "render", "earth", "--size", "96x54", "-o", folder / "expected.png")
            expect(program, "compare", folder / "picture.png", folder / "expected.png", "--tolerance", "0")

    def test_a_component_needs_only_its_own_packages(self):
        others = ("fmt", "JPEG", "OpenEXR", "nlohmann_json")
        _, result = configure(HERE, "raster-only", f"-DCMAKE_PREFIX_PATH={PREFIX}", *(f"-DCMAKE_DISABLE_FIND_PACKAGE_{o}=ON" for o in others))
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_a_missing_package_is_reported(self):
        _, result = configure(HERE, "no-json", f"-DCMAKE_PREFIX_PATH={PREFIX}", "-DCOMPONENTS=raster;scene",
                              "-DCMAKE_DISABLE_FIND_PACKAGE_nlohmann_json=ON")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("Halfspace::scene needs the package nlohmann_json", " ".join(result.stderr.split()))

    def test_an_unknown_component_is_reported(self):
        _, result = configure(HERE, "unknown", f"-DCMAKE_PREFIX_PATH={PREFIX}", "-DCOMPONENTS=raster;rays")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("There is no module rays", " ".join(result.stderr.split()))

    def test_another_width_does_not_link(self):
        lanes = int(re.search(r"-DHALFSPACE_LANES=(\d+)", " ".join(package_flags()))[1])
        other = other_width(lanes)
        library = next(LIBRARIES.glob("libhalfspace-raster*[0-9ra]")).name
        modules = [m for m in ("render", "raster", "image", "procedural", "geometry", "scene", "model", "shading", "core") if m in MODULES]
        libraries = [LIBRARIES / library.replace("-raster", f"-{m}") for m in modules]
        for source, missing in (("other_width", ("Pass::run",)), ("scene", ("SceneAssets::prepare", "SceneFile::open", "write_image"))):
            if source == "scene" and "render" not in MODULES:
                continue
            flags = [f for f in package_flags() if not f.startswith("-DHALFSPACE_LANES")]
            for width in (lanes, other) if source == "other_width" else (other,):
                result = run(COMPILER, "-std=c++20", *shlex.split(cached("CMAKE_CXX_FLAGS")), *flags, f"-DHALFSPACE_LANES={width}",
                             HERE / f"{source}.cpp", "-o", TEMPORARY / source, *libraries, *TBB)
                self.assertEqual(result.returncode == 0, width == lanes, result.stderr[-2000:])
            for name in missing:
                self.assertRegex(result.stderr, rf"undefined reference to .*halfspace::lanes{other}::{name}\b")

    def test_functions_of_two_widths_in_one_process(self):
        lanes = int(re.search(r"-DHALFSPACE_LANES=(\d+)", " ".join(package_flags()))[1])
        objects = []
        for width in (lanes, other_width(lanes)):
            objects.append(str(TEMPORARY / f"packets{width}.so"))
            flags = [f for f in package_flags() if not f.startswith(("-I", "-DHALFSPACE_LANES"))]
            expect(COMPILER, "-std=c++20", "-shared", "-fPIC", *flags, f"-DHALFSPACE_LANES={width}", f"-I{ROOT / 'include'}",
                   HERE / "packet_positions.cpp", "-o", objects[-1])
        # RTLD_GLOBAL lets the second object use the symbols of the first.
        code = """import ctypes, sys
for functions in [ctypes.CDLL(f, ctypes.RTLD_GLOBAL) for f in sys.argv[1:]]:
    print([functions.packet_and_position(x, y) for x in range(4) for y in range(4)])"""
        alone = [expect(sys.executable, "-c", code, name) for name in objects]
        self.assertNotEqual(*alone)
        self.assertEqual(expect(sys.executable, "-c", code, *objects), alone[0] + alone[1])
        self.assertEqual(expect(sys.executable, "-c", code, *objects[::-1]), alone[1] + alone[0])

    @unittest.skipUnless(LONG_TESTS, "needs HALFSPACE_LONG_TESTS")
    def test_two_widths_in_one_process(self):
        lanes = int(re.search(r"-DHALFSPACE_LANES=(\d+)", " ".join(package_flags()))[1])
        installed, result = configure(HERE, "installed-width", f"-DCMAKE_PREFIX_PATH={PREFIX}")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        other, result = configure(HERE / "host", "other-width", f"-DHALFSPACE_SOURCE={ROOT}", f"-DHALFSPACE_LANES={other_width(lanes)}",
                                  "-DCMAKE_CXX_COMPILER_LAUNCHER=" + cached("CMAKE_CXX_COMPILER_LAUNCHER"))
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        modules = []
        for folder in (installed, other):
            expect("cmake", "--build", folder, "--target", "own_shader_module", "-j", "2")
            modules.append(str(folder / "libown_shader_module.so"))
        code = "import ctypes, sys; sys.exit(sum(m.main() for m in [ctypes.CDLL(f, ctypes.RTLD_GLOBAL) for f in sys.argv[1:]]))"
        for order in (modules, modules[::-1]):
            output = expect(sys.executable, "-c", code, *order)
            self.assertEqual(output.count("all pixels are as expected"), 2, output)
            for width in (lanes, other_width(lanes)):
                self.assertIn(f"{width} lanes:", output)

    def test_only_flags_that_all_compilers_know_are_passed_on(self):
        """A project may use another compiler than the installation. Options that only some compilers know depend on the compiler's name."""
        common = {"-ffp-contract=off", "-falign-functions=32", "-pthread"}
        unknown = [flag for flag in package_flags() if flag not in common and not flag.startswith(("-march=", "-mtune=", "-mno-", "-D", "-I"))]
        self.assertEqual(unknown, [])
        text = (LIBRARIES / "cmake" / "Halfspace" / "Halfspace-core.cmake").read_text()
        options = re.search(r'INTERFACE_COMPILE_OPTIONS "(.*?)"', text)[1].replace("\\$", "$").split(";")
        unknown = [o for o in options if o not in common and not o.startswith(("-march=", "-mtune=", "-mno-", "$<$<AND:$<CXX_COMPILER_ID:GNU>,"))]
        self.assertEqual(unknown, [])

    @unittest.skipUnless(LONG_TESTS and CLANG, "needs HALFSPACE_LONG_TESTS and clang")
    def test_clang_can_use_the_installation(self):
        folder, result = configure(HERE, "clang", f"-DCMAKE_PREFIX_PATH={PREFIX}", f"-DCMAKE_CXX_COMPILER={CLANG}", "-DCOMPONENTS=raster")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        expect("cmake", "--build", folder)
        self.assertIn("all pixels are as expected", expect(folder / "own_shader"))

    @unittest.skipUnless(LONG_TESTS and shutil.which("pkg-config"), "needs HALFSPACE_LONG_TESTS and pkg-config")
    def test_pkg_config(self):
        environment = {**os.environ, "PKG_CONFIG_PATH": str(LIBRARIES / "pkgconfig"), "LD_LIBRARY_PATH": str(LIBRARIES)}
        for source, module in (("own_shader", "raster"), ("scene", "render")):
            flags = shlex.split(expect("pkg-config", "--cflags", "--libs", f"halfspace-{module}", env=environment))
            expect(COMPILER, "-std=c++20", HERE / f"{source}.cpp", "-o", TEMPORARY / source, *flags)
        self.assertIn("all pixels are as expected", expect(TEMPORARY / "own_shader", env=environment))
        expect(TEMPORARY / "scene", LIBRARIES / "halfspace", TEMPORARY / "picture.png", env=environment)


class Headers(unittest.TestCase):
    @unittest.skipUnless(LONG_TESTS, "needs HALFSPACE_LONG_TESTS")
    def test_every_public_header_compiles_on_its_own(self):
        for header in module_headers():
            expect(COMPILER, "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", *package_flags(), "-x", "c++", "-", input=f"#include <{header}>\n")

    def test_all_public_headers_compile_together(self):
        text = "".join(f"#include <{header}>\n" for header in module_headers())
        expect(COMPILER, "-std=c++20", "-fsyntax-only", *package_flags(), "-x", "c++", "-", input=text)


class Host(unittest.TestCase):
    """The source tree inside another project."""

    def configure(self, name, *arguments):
        folder, result = configure(HERE / "host", name, f"-DHALFSPACE_SOURCE={ROOT}", *arguments)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return folder

    def test_add_subdirectory(self):
        folder = self.configure("host", "-DCMAKE_CXX_COMPILER_LAUNCHER=" + cached("CMAKE_CXX_COMPILER_LAUNCHER"))
        scripts = list((folder / "halfspace").rglob("cmake_install.cmake"))
        self.assertGreaterEqual(len(scripts), 2)
        for script in scripts:
            self.assertNotIn("file(INSTALL", script.read_text(), script)
        if LONG_TESTS:
            expect("cmake", "--build", folder, "--target", "own_shader", "-j", "2")
            self.assertIn("all pixels are as expected", expect(folder / "own_shader"))

    def test_a_python_module_without_pybind11_is_rejected(self):
        _, result = configure(HERE / "host", "no-pybind11", f"-DHALFSPACE_SOURCE={ROOT}", "-DHALFSPACE_PYTHON=ON",
                              "-DCMAKE_DISABLE_FIND_PACKAGE_pybind11=ON")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("HALFSPACE_PYTHON=ON needs pybind11", " ".join(result.stderr.split()))

    def test_fetch_content(self):
        self.configure("fetch", "-DFETCH=ON")

    def test_modules_without_their_packages_are_left_out(self):
        missing = [f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in ("fmt", "nlohmann_json", "JPEG", "OpenEXR")]
        missing += [f"-D{name}=OFF" for name in ("SPNG_LIBRARY", "MESHOPTIMIZER_LIBRARY")]
        self.configure("only-raster", "-DFETCH=ON", "-DONLY_RASTER=ON", *missing)

    def test_nothing_is_installed_unless_asked(self):
        folder = self.configure("python", "-DHALFSPACE_PYTHON=ON")
        for script in (folder / "halfspace").rglob("cmake_install.cmake"):
            self.assertNotIn("file(INSTALL", script.read_text(), script)


def main():
    global BUILD, COMPILER, TEMPORARY, PREFIX, LIBRARIES, MODULES, TBB
    BUILD, COMPILER = Path(sys.argv[1]).resolve(), sys.argv[2]
    with tempfile.TemporaryDirectory(prefix="halfspace-consumer-") as folder:
        TEMPORARY = Path(folder)
        PREFIX = TEMPORARY / "prefix"
        expect("cmake", "--install", BUILD, "--prefix", PREFIX)
        LIBRARIES = next(PREFIX.glob("lib*/**/pkgconfig")).parent
        MODULES = [p.stem.removeprefix("halfspace-") for p in (LIBRARIES / "pkgconfig").glob("*.pc")]
        TBB = ["-ltbb"] if "tbb" in (LIBRARIES / "pkgconfig" / "halfspace-core.pc").read_text() else []
        return no_skips.main()


if __name__ == "__main__":
    sys.exit(main())
