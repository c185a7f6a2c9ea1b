# SPDX-License-Identifier: Apache-2.0
"""Rendered images."""

from __future__ import annotations

import io
import os
from typing import Any, BinaryIO, Optional, Tuple, Union

import numpy as np

from . import _check, _core
from ._check import fail


def _without_alpha(place: str, name: str, expected: str) -> Exception:
    return fail(place, f"is {name!r}, a format without alpha, but the picture has alpha", expected)


class Picture(np.ndarray):
    """A rendered image: an array that displays itself in a notebook and can be saved.

    8-bit pictures are uint8 of shape (height, width, 3), or (height, width, 4) with straight alpha, and contain sRGB-encoded values. Linear
    pictures are float32 of shape (height, width, 4) and contain linear values before exposure and tone mapping. Row 0 is the top row.
    Slices and results of calculations are also Pictures, but only those that still have the shape of an image can be saved.
    """

    def __array_wrap__(self, array: np.ndarray, context: Any = None, return_scalar: bool = False) -> Any:
        # A mean or maximum is a number, not a picture.
        return array[()] if array.ndim == 0 else super().__array_wrap__(array, context)

    def _is_codes(self) -> bool:
        return self.dtype == np.uint8 and self.ndim == 3 and self.shape[2] in (3, 4) and self.size > 0

    def _repr_png_(self) -> Optional[bytes]:
        """Returns the picture as a PNG file, or None if it does not have 8-bit values."""
        return _core.png(np.ascontiguousarray(self)) if self._is_codes() else None

    def save(self, path: Union[str, "os.PathLike[str]", BinaryIO], *, format: Optional[str] = None) -> None:
        """Writes the picture to a file or a stream.

        path: a file name, whose extension selects the format, or a binary stream such as io.BytesIO().
        format: of a stream: "png", "jpg", "tif", "exr" or "hdr". The default is the extension of the stream's `name`, if it has one.

        8-bit pictures: png or tif, or jpg without alpha. Linear pictures: exr, or hdr if alpha is 1 everywhere. Raises InputError for other
        formats, and OutputError if the file cannot be written. Exceptions of the stream's write() are passed on.
        """
        if hasattr(path, "write"):
            place, name, extension = _stream_format(path, format)
            encode = _core.encode_codes if self._checked(place, name, extension) else _core.encode_light
            _write_all(path, encode(np.ascontiguousarray(self), extension, place))
            return
        name = _check.path("path", path)
        if format is not None:
            raise fail("format", f"is {format!r}, but path is a file name", "None, because the extension selects the format")
        save = _core.save_codes if self._checked("path", name, os.path.splitext(name)[1].lower()) else _core.save_light
        save(name, np.ascontiguousarray(self))

    def _checked(self, place: str, name: str, extension: str) -> bool:
        """Returns whether the picture has 8-bit values. Raises InputError if the format cannot store it."""
        names = "a file name ending in " if place == "path" else "the format "
        if self._is_codes():
            if extension not in (".png", ".jpg", ".jpeg", ".tif", ".tiff"):
                raise fail(place, f"is {name!r}", f"{names}.png, .jpg or .tif for 8-bit pictures")
            if self.shape[2] == 4 and extension in (".jpg", ".jpeg"):
                raise _without_alpha(place, name, f"{names}.png or .tif")
            return True
        if self.dtype != np.float32 or self.ndim != 3 or self.shape[2] != 4 or self.size == 0:
            raise fail("picture", f"is {self.dtype} of shape {self.shape}", "uint8 (H, W, 3 or 4) or float32 (H, W, 4)")
        if extension not in (".exr", ".hdr"):
            raise fail(place, f"is {name!r}", f"{names}.exr or .hdr for linear pictures")
        if extension == ".hdr" and (self[..., 3] != 1.0).any():
            raise _without_alpha(place, name, f"{names}.exr")
        return False


def _stream_format(stream: Any, format: Optional[str]) -> Tuple[str, str, str]:
    """Returns the place for error messages, the name of the format or the stream, and the format as an extension like ".png"."""
    if isinstance(stream, io.TextIOBase):
        raise fail("path", "is a stream of text", "a binary stream, for example io.BytesIO() or open(name, 'wb')")
    if format is not None:
        return "format", format, "." + _check.string("format", format).lower().lstrip(".")
    name = getattr(stream, "name", None)  # an integer if the stream was opened with a file descriptor
    if not isinstance(name, str) or not os.path.splitext(name)[1]:
        raise fail("format", "is missing", "the format of the stream, for example format='png'")
    return "path", name, os.path.splitext(name)[1].lower()


def _write_all(stream: Any, data: bytes) -> None:
    """Writes all bytes. An unbuffered stream may write only a part at a time."""
    rest = data
    while rest:
        written = stream.write(rest)
        rest = rest[len(rest) if written is None else written:]
