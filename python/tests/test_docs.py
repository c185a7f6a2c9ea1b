# SPDX-License-Identifier: Apache-2.0
"""Runs the code blocks of docs/howto/python.md and the example programs."""

import re
import subprocess
import sys

import pytest

from conftest import ROOT

EXAMPLES = ROOT / "python" / "examples"


def test_the_code_in_the_document_runs(tmp_path, monkeypatch):
    blocks = re.findall(r"^```python\n(.*?)^```", (ROOT / "docs" / "howto" / "python.md").read_text(), flags=re.S | re.M)
    assert len(blocks) >= 8
    monkeypatch.chdir(tmp_path)
    names = {}
    for block in blocks:
        exec(compile(block, "python.md", "exec"), names)
    assert names["image"].any()
    assert (tmp_path / "moon_0002.png").exists()


def run(*arguments):
    return subprocess.run([sys.executable, *map(str, arguments)], check=True, capture_output=True, text=True).stdout


def test_the_dataset_example_writes_views_with_labels(tmp_path):
    np = pytest.importorskip("numpy")
    text = run(EXAMPLES / "dataset.py", "--views", "3", "--size", "64x48", "--out", tmp_path)
    assert re.search(r"3 views of 64x48 with color, depth, camera_normal, object: \d+ frames/s", text)
    views = np.load(tmp_path / "views_00000.npz")
    assert views["color"].shape == (3, 48, 64, 3) and views["depth"].dtype == np.float32 and views["box_counts"].sum() == len(views["boxes"])
    number, left, top, right, bottom = views["boxes"][0]
    assert (views["object"][0, top:bottom, left:right] == number).any() and (tmp_path / "labels.png").exists()


def test_the_turntable_example_writes_frames(tmp_path):
    (tmp_path / "triangle.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    run(EXAMPLES / "turntable.py", tmp_path / "triangle.obj", tmp_path / "out")
    assert len(list((tmp_path / "out").glob("*.png"))) == 48
