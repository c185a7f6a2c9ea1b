# SPDX-License-Identifier: Apache-2.0
"""Rendered images."""

from __future__ import annotations

import os
from typing import Any, Optional, Union

import numpy as np

from . import _check, _core
from ._check import fail


def _without_alpha(name: str, expected: str) -> Exception:
    return fail("path", f"is {name!r}, a format without alpha, but the picture has alpha", expected)


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

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the picture to a file. The extension selects the format.

        8-bit pictures: .png or .tif, or .jpg without alpha. Linear pictures: .exr, or .hdr if alpha is 1 everywhere. Raises InputError for
        other extensions, and OutputError if the file cannot be written.
        """
        name = _check.path("path", path)
        extension = os.path.splitext(name)[1].lower()
        if self._is_codes():
            if extension not in (".png", ".jpg", ".jpeg", ".tif", ".tiff"):
                raise fail("path", f"is {name!r}", "a file name ending in .png, .jpg or .tif for 8-bit pictures")
            if self.shape[2] == 4 and extension in (".jpg", ".jpeg"):
                raise _without_alpha(name, "a file name ending in .png or .tif")
            _core.save_codes(name, np.ascontiguousarray(self))
        elif self.dtype == np.float32 and self.ndim == 3 and self.shape[2] == 4 and self.size > 0:
            if extension not in (".exr", ".hdr"):
                raise fail("path", f"is {name!r}", "a file name ending in .exr or .hdr for linear pictures")
            if extension == ".hdr" and (self[..., 3] != 1.0).any():
                raise _without_alpha(name, "a file name ending in .exr")
            _core.save_light(name, np.ascontiguousarray(self))
        else:
            raise fail("picture", f"is {self.dtype} of shape {self.shape}", "uint8 (H, W, 3 or 4) or float32 (H, W, 4)")
