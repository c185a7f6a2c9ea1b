#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the tests of the Python module. Exits with 77, which CTest reports as skipped, if a required package is missing.

  PYTHONPATH=BUILD/python HALFSPACE_PROGRAM=BUILD/bin/halfspace run.py [arguments of pytest]
"""

import importlib.util
import sys
from pathlib import Path


def main():
    for package in ("pytest", "numpy"):
        if importlib.util.find_spec(package) is None:
            print(f"skipped: {package} is not installed (Debian and Ubuntu: python3-{package})")
            return 77
    import pytest

    return pytest.main(["-q", "-p", "no:cacheprovider", "-W", "error", str(Path(__file__).parent), *sys.argv[1:]])


if __name__ == "__main__":  # processes that the tests start also import this file
    sys.exit(main())
