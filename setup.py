# SPDX-License-Identifier: Apache-2.0
"""Builds the extension and the command `halfspace` with CMake, for `pip install .`.

The environment variable CMAKE_ARGS has further arguments of CMake, for example -DHALFSPACE_ARCH=x86-64-v3. The default instruction set is
that of this machine; the name of the wheel then has the build tag `0native`. The build needs a C++ compiler, CMake and the libraries that
scripts/install_deps.sh installs.
"""

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent
ARGUMENTS = shlex.split(os.environ.get("CMAKE_ARGS", ""))


def pybind11_options():
    """Returns where CMake finds the pybind11 of the build environment. Without one, CMake searches the system."""
    try:
        import pybind11
    except ImportError:
        return {}
    return {"pybind11_DIR": pybind11.get_cmake_dir()}


def instruction_set(arguments):
    """Returns the value of HALFSPACE_ARCH in arguments of CMake."""
    values = re.findall(r"(?:^|\s)-D\s*HALFSPACE_ARCH(?::\w+)?=(\S+)", " ".join(arguments))
    return values[-1] if values else "native"


class CMakeBuild(build_ext):
    """Builds only what the wheel contains and installs it into the folder of the wheel. Ray tracing, for `halfspace validate`, is built only
    if CMAKE_ARGS has -DHALFSPACE_WITH_EMBREE=ON."""

    def run(self):
        package = Path(self.get_ext_fullpath("halfspace._core")).resolve().parent
        build = Path(self.build_temp).resolve()
        options = {"HALFSPACE_PYTHON": "ON", "HALFSPACE_PYTHON_DIR": ".", "Python_EXECUTABLE": sys.executable, "CMAKE_BUILD_TYPE": "Release",
                   "HALFSPACE_WERROR": "OFF", "HALFSPACE_WITH_EMBREE": "OFF", **pybind11_options()}
        options.update({f"HALFSPACE_BUILD_{part}": "OFF" for part in ("TESTS", "BENCHMARKS", "EXAMPLES")})
        defines = [f"-D{name}={value}" for name, value in options.items()]
        subprocess.run(["cmake", "-S", ROOT, "-B", build, *defines, *ARGUMENTS, f"-DHALFSPACE_ARCH={ARCH}"], check=True)
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))
        subprocess.run(["cmake", "--build", build, "--target", "halfspace_python", "halfspace", "-j", jobs], check=True)
        for component in ("python", "wheel"):
            subprocess.run(["cmake", "--install", build, "--component", component, "--prefix", package.parent, "--strip"], check=True)


ARCH = instruction_set(ARGUMENTS)
version = re.search(r"project\(halfspace VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
# A build tag starts with a digit.
options = {"bdist_wheel": {"build_number": "0native"}} if ARCH == "native" else {}
setup(version=version, ext_modules=[Extension("halfspace._core", [])], cmdclass={"build_ext": CMakeBuild}, options=options)
