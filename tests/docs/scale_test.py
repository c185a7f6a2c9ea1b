#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the scripts of docs/howto/scale.md, with fewer frames and other folders.

  scale_test.py BUILD
"""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "support"))
from dask_python import python_with_dask  # noqa: E402

PAGE = (ROOT / "docs" / "howto" / "scale.md").read_text(encoding="utf-8")
BUILD = Path(sys.argv.pop(1)).resolve()


def block(language):
    """The only block of the page in a language."""
    blocks = re.findall(rf"^```{language}\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)
    assert len(blocks) == 1, f"{len(blocks)} blocks of {language}"
    return blocks[0]


def replaced(text, changes):
    for old, new in changes.items():
        assert text.count(old) == 1, f"'{old}' occurs {text.count(old)} times"
        text = text.replace(old, new)
    return text


class Scripts(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="halfspace-test-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())

    def test_a_task_of_a_slurm_array_renders_its_shard(self):
        script = replaced(block("bash"), {"0..19999": "0..4 --size 64x36", "/shared/out": str(self.folder)})
        environment = {**os.environ, "PATH": f"{BUILD / 'bin'}:{os.environ['PATH']}", "SLURM_ARRAY_TASK_ID": "1", "SLURM_ARRAY_TASK_COUNT": "2"}
        subprocess.run(["sh", "-e"], input=script, text=True, env=environment, check=True, stderr=subprocess.DEVNULL)
        self.assertEqual(self.files(), ["0001.png", "0003.png"])

    def test_the_python_script_renders_with_dask(self):
        dask = python_with_dask(BUILD)
        if dask is None:
            self.skipTest("Dask is not installed (scripts/install_deps.sh --dask)")
        script = replaced(block("python"), {"range(20000)": "range(3), size=(64, 36)", "/shared/out": str(self.folder),
                                            'Client("tcp://scheduler:8786")': "Client(processes=False, dashboard_address=None)"})
        subprocess.run([dask[0], "-c", script], env=dask[1], check=True, stderr=subprocess.DEVNULL)
        self.assertEqual(self.files(), ["0000.png", "0001.png", "0002.png"])

    def test_the_kubernetes_job_has_a_shard_for_each_index(self):
        """Reads the few lines that matter; there is no cluster here."""
        job = block("yaml")
        completions = re.search(r"^  completions: (\d+)$", job, re.MULTILINE)[1]
        self.assertIn("completionMode: Indexed", job)
        command = re.search(r"^ +command: \[(.*)\]$", job, re.MULTILINE)[1].replace('"', "").split(", ")
        self.assertEqual(command[-2:], ["--shard", f"$(JOB_COMPLETION_INDEX)/{completions}"])
        command[0] = str(BUILD / "bin" / "halfspace")
        changes = {"0..239": "0..8", "/out/{frame}.png": f"{self.folder}/{{frame}}.png", command[-1]: f"0/{completions}"}
        subprocess.run([changes.get(word, word) for word in command] + ["--size", "64x36"], check=True, stderr=subprocess.DEVNULL)
        self.assertEqual(self.files(), ["0000.png", "0008.png"])


if __name__ == "__main__":
    unittest.main()
