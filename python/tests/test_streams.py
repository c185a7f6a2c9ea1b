# SPDX-License-Identifier: Apache-2.0
"""Pictures saved to streams."""

import io
import os
import tempfile

import numpy as np
import pytest

import halfspace


@pytest.fixture(scope="module")
def pictures():
    scene = halfspace.Scene.load("moon")
    return {"codes": scene.render((40, 30)), "alpha": scene.render((40, 30), alpha=True), "light": scene.render((40, 30), linear=True)}


@pytest.mark.parametrize("kind, format", [("codes", "png"), ("codes", "jpg"), ("codes", "jpeg"), ("codes", "tif"), ("alpha", "png"),
                                          ("alpha", "TIFF"), ("light", "exr"), ("light", "hdr")])
def test_a_stream_receives_the_bytes_of_the_file(pictures, tmp_path, kind, format):
    picture, path = pictures[kind], tmp_path / f"picture.{format.lower()}"
    picture.save(path)
    stream = io.BytesIO()
    picture.save(stream, format=format)
    assert stream.getvalue() == path.read_bytes()


def test_the_name_of_a_stream_selects_the_format(pictures, tmp_path):
    pictures["codes"].save(tmp_path / "a.png")
    with open(tmp_path / "b.png", "wb") as file:
        pictures["codes"].save(file)
    with open(tmp_path / "c.png", "wb", buffering=0) as file:
        pictures["codes"].save(file, format=".png")
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes() == (tmp_path / "c.png").read_bytes()


class Slow:
    """Accepts at most 100 bytes at a time, as a pipe may do."""

    def __init__(self):
        self.data = b""

    def write(self, data):
        self.data += data[:100]
        return len(data[:100])


def test_a_stream_can_accept_a_part_of_the_bytes(pictures):
    slow, whole = Slow(), io.BytesIO()
    pictures["codes"].save(slow, format="png")
    pictures["codes"].save(whole, format="png")
    assert slow.data == whole.getvalue()


@pytest.mark.parametrize("kind, stream, format, message", [
    ("codes", io.BytesIO, None, "format: is missing; expected"),
    ("codes", io.BytesIO, "bmp", "format: is 'bmp'; expected the format .png, .jpg or .tif"),
    ("codes", io.BytesIO, "exr", "format: is 'exr'; expected"),
    ("codes", io.BytesIO, 7, "format: is 7; expected a string"),
    ("light", io.BytesIO, "png", "format: is 'png'; expected the format .exr or .hdr"),
    ("alpha", io.BytesIO, "jpg", "format: is 'jpg', a format without alpha"),
    ("codes", io.StringIO, "png", "path: is a stream of text; expected a binary stream"),
    ("codes", tempfile.TemporaryFile, None, "format: is missing"),
])
def test_wrong_formats_of_streams_are_errors(pictures, kind, stream, format, message):
    with stream() as file, pytest.raises(halfspace.InputError, match=f"^{message}"):
        pictures[kind].save(file, format=format)


def test_a_file_name_needs_no_format(pictures, tmp_path):
    with pytest.raises(halfspace.InputError, match="^format: is 'png', but path is a file name; expected None"):
        pictures["codes"].save(tmp_path / "a.bin", format="png")
    assert os.listdir(tmp_path) == []


def test_exceptions_of_a_stream_are_passed_on(pictures):
    stream = io.BytesIO()
    stream.close()
    with pytest.raises(ValueError, match="closed"):
        pictures["codes"].save(stream, format="png")


def test_slices_are_saved(pictures):
    stream = io.BytesIO()
    part = pictures["codes"][::2, 5:]
    part.save(stream, format="png")
    assert stream.getvalue() == part._repr_png_() and np.array_equal(part, pictures["codes"][::2, 5:])
