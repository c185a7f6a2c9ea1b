# SPDX-License-Identifier: Apache-2.0
"""The name of the wheel and its command. tests/consumer/pip_test.py builds a whole wheel."""

import os
import shutil
import subprocess
import sys

import pytest

import halfspace
from conftest import ROOT


def wheel_name(folder, arguments):
    """Returns the name of the wheel for these arguments of CMake. Nothing is built."""
    for name in ("setup.py", "pyproject.toml", "CMakeLists.txt"):
        shutil.copy(ROOT / name, folder)
    (folder / "python" / "halfspace").mkdir(parents=True)
    for name in ("_halfspace_command.py", "halfspace/__init__.py"):
        shutil.copy(ROOT / "python" / name, folder / "python" / name)
    subprocess.run([sys.executable, "setup.py", "-q", "bdist_wheel", "--skip-build"], cwd=folder, check=True, capture_output=True,
                   env={**os.environ, "CMAKE_ARGS": arguments})
    (wheel,) = (folder / "dist").iterdir()
    return wheel.name


@pytest.mark.parametrize("arguments, tag", [("", "-0native"), ("-DHALFSPACE_ARCH=native", "-0native"), ("-DHALFSPACE_ARCH=x86-64-v3", ""),
                                            ("-G Ninja -D HALFSPACE_ARCH:STRING=x86-64-v4", "")])
def test_the_name_of_a_native_wheel_says_so(tmp_path, arguments, tag):
    pytest.importorskip("wheel")
    assert wheel_name(tmp_path, arguments).startswith(f"halfspace-{halfspace.__version__}{tag}-cp3")


def command(*arguments, **environment):
    code = "import _halfspace_command as c; c.main()"
    return subprocess.run([sys.executable, "-c", code, *arguments], capture_output=True, text=True, env={**os.environ, **environment})


def test_the_command_runs_the_program(program, tmp_path):
    assert command("list").stdout == subprocess.run([program, "list"], capture_output=True, text=True, check=True).stdout
    failed = command("render", str(tmp_path / "none.obj"))
    assert failed.returncode == 3 and failed.stderr.startswith("halfspace: ") and failed.stderr.count("\n") == 1


def test_a_missing_program_is_reported_in_one_line(tmp_path):
    shutil.copy(ROOT / "python" / "_halfspace_command.py", tmp_path)
    failed = command("list", PYTHONPATH=str(tmp_path))
    assert failed.returncode == 1
    assert failed.stderr == f"halfspace: {tmp_path}/halfspace/halfspace: No such file or directory; expected the program of the wheel\n"
