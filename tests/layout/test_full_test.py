#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that scripts/test_full.sh reports a step whose build fails, even if programs from an earlier build exist."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "test_full.sh"


def write_program(path, code):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"#!/bin/sh\nexit {code}\n")
    path.chmod(0o755)


class FailedBuilds(unittest.TestCase):
    def test_every_step_with_a_failed_build_fails(self):
        with tempfile.TemporaryDirectory(prefix="halfspace-test-full-") as folder:
            tree = Path(folder)
            write_program(tree / "programs" / "cmake", 1)
            for name in ("clang++", "ctest", "python3"):
                write_program(tree / "programs" / name, 0)
            for name in ("shader_compile_time.sh", "off_costs.sh", "mutate.py", "try_packages.sh", "try_install.sh"):  # they build on their own
                write_program(tree / "scripts" / name, 1)
            for name in ("install_deps.sh", "lesson_pictures.py"):
                write_program(tree / "scripts" / name, 0)
            for name in ("test-conformance", "test-reference"):
                write_program(tree / "build" / "full-gcc" / "bin" / name, 0)
            (tree / "scripts" / "test_full.sh").write_text(SCRIPT.read_text())
            environment = {**os.environ, "PATH": f"{tree / 'programs'}:{os.environ['PATH']}"}
            subprocess.run(["git", "init", "-q", folder], check=True)
            subprocess.run(["git", "add", "scripts"], check=True, cwd=folder)

            def run(*arguments):
                return subprocess.run(["bash", "scripts/test_full.sh", *arguments], cwd=folder, env=environment, capture_output=True, text=True)

            names = run("list").stdout.split()
            self.assertIn("lessons", names)
            names.remove("pip")  # runs pip_test.py, which the python3 stand-in replaces
            result = run()
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertEqual(result.stdout.splitlines()[-1], "failed: " + " ".join(names))


if __name__ == "__main__":
    unittest.main()
