# SPDX-License-Identifier: Apache-2.0
"""Runs the tests of a Python file. With the environment variable HALFSPACE_NO_SKIPS, which scripts/test_full.sh sets, a skipped test fails,
so that a missing program cannot hide a test."""

import os
import re
import sys
import unittest

# Reasons that no package can remedy.
ALLOWED = r"the processor has no |needs HALFSPACE_LONG_TESTS$|the build has no programs$|this version of qemu-user executes "


def skipped_tests_fail():
    return "HALFSPACE_NO_SKIPS" in os.environ


def main(arguments=()):
    """Returns the exit code of the program. arguments: passed on to unittest, for example the names of tests."""
    result = unittest.main(module="__main__", argv=[sys.argv[0], *arguments], exit=False).result
    failed = not result.wasSuccessful()
    for test, reason in result.skipped:
        if skipped_tests_fail() and not re.search(ALLOWED, reason):
            print(f"{os.path.basename(sys.argv[0])}: {test.id()} was skipped: {reason}", file=sys.stderr)
            failed = True
    return int(failed)
