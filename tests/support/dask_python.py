# SPDX-License-Identifier: Apache-2.0
"""Finds a Python with Dask for tests that run another program."""

import os
import subprocess
import sys


def python_with_dask(build):
    """Returns the path and the environment of a Python that imports Dask and the module of a build folder. None if there is none, which is an
    error with HALFSPACE_NO_SKIPS."""
    environment = {**os.environ, "PYTHONPATH": str(build / "python"), "HALFSPACE_PROGRAM": str(build / "bin" / "halfspace")}
    for python in (sys.executable, "/usr/bin/python3"):
        if subprocess.run([python, "-c", "import distributed, halfspace"], env=environment, stderr=subprocess.DEVNULL).returncode == 0:
            return python, environment
    assert "HALFSPACE_NO_SKIPS" not in os.environ, "Dask or the Python module is missing (scripts/install_deps.sh --dask)"
    return None
