# SPDX-License-Identifier: Apache-2.0
"""Shared by all tests: the command-line program, shared data, and small meshes."""

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

import halfspace

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def command_line(tmp_path):
    """Renders with the command-line program and returns the path of the PNG file."""
    program = os.environ.get("HALFSPACE_PROGRAM", "")
    if not os.path.exists(program):
        pytest.skip("the program was not built (HALFSPACE_PROGRAM)")

    def run(*arguments, out="picture.png"):
        path = tmp_path / out
        subprocess.run([program, "render", *map(str, arguments), "-o", str(path)], check=True, capture_output=True, text=True)
        return path

    return run


@pytest.fixture
def program():
    """The path of the command-line program."""
    path = os.environ.get("HALFSPACE_PROGRAM", "")
    if not os.path.exists(path):
        pytest.skip("the program was not built (HALFSPACE_PROGRAM)")
    return path


@pytest.fixture
def horse():
    """A mesh of 96,966 triangles from the shared data."""
    path = ROOT.parent / "shared" / "data" / "meshes" / "horse.ply"
    if path.exists():
        return path
    pytest.skip(f"{path} is missing")


def without_text(path):
    """Returns the chunks of a PNG file, except for text chunks, which contain the command line."""
    data, chunks, at = Path(path).read_bytes(), [], 8
    while at < len(data):
        length = int.from_bytes(data[at : at + 4], "big")
        chunk = data[at : at + length + 12]
        if chunk[4:8] not in (b"tEXt", b"iTXt", b"zTXt"):
            chunks.append(chunk)
        at += length + 12
    return chunks


def same_bytes(picture, path):
    """Returns whether the picture would be saved as this file, apart from text chunks."""
    saved = Path(str(path) + ".own.png")
    picture.save(saved)
    return without_text(saved) == without_text(path)


def sphere(rows=24, columns=48, radius=1.0):
    """Returns vertices, faces, normals and uvs of a sphere with a seam."""
    v, u = np.meshgrid(np.linspace(0, 1, rows + 1), np.linspace(0, 1, columns + 1), indexing="ij")
    polar, around = np.pi * v, 2 * np.pi * u
    normals = np.stack([np.sin(polar) * np.sin(around), np.cos(polar), np.sin(polar) * np.cos(around)], axis=-1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    a = (i * (columns + 1) + j).ravel()
    b, c, d = a + columns + 1, a + columns + 2, a + 1
    faces = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    return radius * normals, faces, normals, np.stack([u.ravel(), 1 - v.ravel()], axis=1)


QUAD = (np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]), np.array([[0, 1, 2], [0, 2, 3]]))


@pytest.fixture
def quad():
    return halfspace.Mesh(*QUAD)
