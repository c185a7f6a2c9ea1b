# SPDX-License-Identifier: Apache-2.0
"""halfspace.export, halfspace.info and halfspace.compare."""

from __future__ import annotations

import json
import os
from typing import Any, Dict, Mapping, Optional, Union

import numpy as np

from . import _check, _core
from ._check import fail
from ._options import is_model_file, warn
from .scene import Scene

Path = Union[str, "os.PathLike[str]"]


class DifferenceError(AssertionError):
    """Two images differ by more than the tolerance. The message is one line."""


DifferenceError.__module__ = "halfspace"


def export(scene: Path, out: Path, *, set: Optional[Mapping[str, Any]] = None, allow_outside: bool = False,
           threads: Optional[int] = None) -> None:
    """Writes a scene or a model file in another format, as `halfspace export SCENE -o OUT` does. Scene.export() writes a scene in memory.

    scene: a shipped scene ("moon"), a scene file, or a model file (.obj, .gltf, .glb, .ply, .stl).
    out: a file ending in .glb, .gltf, .obj, .ply or .stl.   set: keys of the scene; not for model files.
    allow_outside: whether models may refer to files outside their folders.

    Raises InputError and OutputError with the messages of the command line. What the format cannot store is a RenderWarning.
    """
    file, target = _check.path("scene", scene), _check.model_output("out", out)
    keys = _check.mapping("set", {} if set is None else set, "a dictionary of keys and values")
    count = _check.threads(threads, _core.cores())
    if not is_model_file(file):
        opened = Scene.load(file, allow_outside=_check.flag("allow_outside", allow_outside), threads=count)
        if keys:
            opened.set(keys)
        return opened.export(target)
    if keys:
        raise fail("set", "applies only to scenes", "a model without it")
    warn(_core.export_model(file, target, _check.flag("allow_outside", allow_outside)))


def info(model: Optional[Path] = None, *, up_axis: Optional[str] = None, allow_outside: bool = False) -> Dict[str, Any]:
    """Describes a model file or, without one, this build, with the keys and values of `halfspace info MODEL --json`, except for the commit
    of the program.

    model: a file ending in .obj, .gltf, .glb, .ply or .stl.   up_axis: "y" or "z". The default is that of the file.
    allow_outside: whether the model may refer to files outside its folder.
    """
    if model is None:
        return json.loads(_core.program_info())
    axis = "" if up_axis is None else _check.choice("up_axis", up_axis, ("y", "z"))
    return json.loads(_core.model_info(_check.path("model", model), _check.flag("allow_outside", allow_outside), axis))


def compare(a: Any, b: Any, *, difference: Optional[Path] = None, tolerance: Optional[float] = None) -> Dict[str, Any]:
    """Measures the difference between two images, with the keys and values of `halfspace compare A B --json`.

    a, b: image files, or pictures: uint8 of shape (H, W, 3) or (H, W, 4), or linear float32 of shape (H, W, 4).
    difference: a PNG file that receives the difference as a picture.
    tolerance: raises DifferenceError if the largest difference exceeds this number. 8-bit values count as 0 to 1.
    """
    limit = None if tolerance is None else _check.number("tolerance", tolerance, 0.0, 1e9)
    picture = "" if difference is None else _check.path("difference", difference)
    results, problem = _core.compare(_compared("a", a), _compared("b", b), picture, limit, f"{tolerance}")
    if problem:
        raise DifferenceError(problem)
    return json.loads(results)


def _compared(name: str, image: Any) -> Any:
    if not isinstance(image, np.ndarray):
        return _core.ComparedImage.read(_check.path(name, image))
    expected = "uint8 of shape (H, W, 3) or (H, W, 4), or float32 of shape (H, W, 4)"
    if image.ndim != 3 or 0 in image.shape or image.shape[2] not in ((3, 4) if image.dtype == np.uint8 else (4,)):
        raise fail(name, f"has the shape {image.shape}", expected)
    if image.dtype == np.uint8:
        return _core.ComparedImage.codes(name, np.ascontiguousarray(image))
    if image.dtype != np.float32:
        raise fail(name, f"has the dtype {image.dtype}", expected)
    return _core.ComparedImage.light(name, np.ascontiguousarray(_check.numbers(name, image, (None, None, 4), np.float32)))
