# SPDX-License-Identifier: Apache-2.0
"""Memory: what errors say, and what many scenes need."""

import gc
import os
import subprocess
import sys

import numpy as np
import pytest

import halfspace
from conftest import sphere

SHORTAGE = r"size (\d+x\d+): needs (\d+) MiB of memory in addition to \d+ MiB in use; expected at most \d+ MiB$"


def test_a_picture_that_does_not_fit_into_the_process_names_the_sizes():
    code = """
import resource, numpy as np, halfspace
scene = halfspace.Scene(threads=1)
scene.render((8, 8))
pages = int(open("/proc/self/statm").read().split()[0])
resource.setrlimit(resource.RLIMIT_AS, (pages * resource.getpagesize() + (200 << 20),) * 2)
for function in (lambda: scene.render((8000, 8000)), lambda: scene.render((8000, 8000), linear=True),
                 lambda: scene.labels(["depth", "normal"], size=(8000, 8000)), lambda: scene.render_batch([None] * 40, size=(1600, 1600)),
                 lambda: scene.label_batch([None] * 40, ["depth"], size=(1600, 1600))):
    try:
        function()
    except MemoryError as e:
        print(e)
print(scene.render((8, 8)).shape)
"""
    lines = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout.splitlines()
    mebi = 1 << 20
    expected = [8000 * 8000 * 7, 8000 * 8000 * 16, 8000 * 8000 * 16, 1600 * 1600 * (40 * 3 + 4), 1600 * 1600 * 41 * 4]
    assert len(lines) == 6 and lines[5] == "(8, 8, 3)"
    for line, needed in zip(lines, expected):
        with pytest.raises(MemoryError, match=SHORTAGE):
            raise MemoryError(line)
        assert f"needs {-(-needed // mebi)} MiB" in line


def test_a_batch_larger_than_the_memory_of_the_machine_is_refused():
    scene = halfspace.Scene()
    with pytest.raises(MemoryError, match=SHORTAGE):
        scene.render_batch([halfspace.Camera.look_at((0, 0, 5))] * 20000, size=(16384, 16384))


def resident_bytes():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def test_new_scenes_leak_nothing():
    vertices, faces, normals, _ = sphere(8, 16)

    def render(count):
        for i in range(count):
            scene = halfspace.Scene(threads=1)
            mesh = halfspace.Mesh(vertices, faces, normals=normals)
            scene.add(mesh, np.eye(4))
            scene.labels(["color", "depth", "object"], size=(32, 32))

    render(20)
    gc.collect()
    before = resident_bytes()
    render(60)
    gc.collect()
    assert resident_bytes() - before < 8 << 20  # 60 filtered environments would need 120 MB


def test_the_environment_is_prepared_by_the_first_scene_only():
    """Compares processor times of one process. The first scene also loads what all scenes share."""
    code = """
import time, halfspace
mesh = halfspace.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
def render(lighting):
    start = time.process_time()
    scene = halfspace.Scene(lighting=lighting, threads=1)
    scene.add(mesh)
    scene["shadow.method"] = "none"
    scene.render((8, 8))
    return time.process_time() - start
render("none")
first = render("studio")
print(first, min(render("studio") for _ in range(5)), min(render("none") for _ in range(5)))
"""
    first, studio, none = map(float, subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout.split())
    assert studio < 0.3 * first  # 40 to 70 ms for the filter, a few ms for the rest
    assert none < 0.3 * first
