# SPDX-License-Identifier: Apache-2.0
"""Arguments of scenes: lighting, keys, views of model files and pixel formats. Also warnings."""

from __future__ import annotations

import contextlib
import json
import os
import re
import sys
import warnings
from typing import Any, Callable, Dict, Iterable, Iterator, List, Mapping, Sequence

import numpy as np

from . import _check, _core
from ._check import fail


class RenderWarning(UserWarning):
    """A problem that does not prevent rendering, such as a missing texture."""


# The scene in which `halfspace render MODEL` shows model files.
_STUDIO: Dict[str, Any] = {
    "version": 1, "samples": 4,
    "lights": {"key": {"type": "directional", "direction": [-0.16, 0.79, 0.59], "intensity": 1.2}},
    "environments": {"around": {"type": "studio", "size": 256, "brightness": 0.75}},
    "reflections": {"environment": "around"},
    "background": {"color": [0.62, 0.63, 0.65]},
    "post": {"hdr": True, "tone": "aces", "exposure": 0.62},
    "shadow": {"method": "pcf7", "resolution": 1024, "faces": "both"},
}
_DARK: Dict[str, Any] = {"version": 1, "samples": 4}
LIGHTING = {"studio": _STUDIO, "none": _DARK}

# Options of Scene.load for model files, in the order of ModelView.
_VIEW_OPTIONS = ("aspect", "yaw", "pitch", "zoom", "fov", "eye", "look_at", "up", "inside", "floor", "environment", "background",
                 "model_scene", "animation", "variant", "times", "up_axis", "turn_seconds", "allow_outside")
# Names that differ from those of _core, which are also accepted.
_LONG_NAMES = {"animation": "model_animation", "variant": "model_variant"}
_MODELS = (".obj", ".gltf", ".glb", ".ply", ".stl")


def _numbers(key: str, value: Any) -> np.ndarray:
    try:
        array = np.asarray(value)
    except ValueError:  # rows of different lengths
        array = np.empty(0, object)
    if array.dtype.kind not in "biuf":
        raise fail(key, "has elements that are not numbers", "a sequence of numbers")
    if not np.isfinite(array).all():
        raise fail(key, "has an element that is not finite", "finite numbers")
    return array


def setting_text(key: str, value: Any) -> str:
    """Returns "KEY=VALUE" for a Python or NumPy value."""
    _check.string("a key", key)
    if isinstance(value, (bool, np.bool_)):
        text = "true" if value else "false"
    elif isinstance(value, str):
        text = value
    elif isinstance(value, os.PathLike):
        text = os.fspath(value)
    elif isinstance(value, (int, np.integer)):
        text = str(int(value))
    elif isinstance(value, (float, np.floating)):
        text = repr(_check.number(key, value))
    elif isinstance(value, (list, tuple, np.ndarray)):
        array = _numbers(key, value)
        text = ",".join(repr(float(x)) for x in array) if array.ndim == 1 else json.dumps(array.tolist())
    else:
        raise fail(key, f"is of type {type(value).__name__}", "a bool, a number, a string or a sequence of numbers")
    return f"{key}={text}"


def is_model_file(path: str) -> bool:
    return path.lower().endswith(_MODELS)


_BACKGROUND = '"#rrggbb", "environment", "transparent" or three linear numbers from 0 to 1'


def _background(name: str, value: Any) -> Any:
    """Returns a string, or a linear color as a tuple."""
    if isinstance(value, str):
        if value in ("environment", "transparent") or re.fullmatch("#[0-9a-fA-F]{6}", value):
            return value
    else:
        with contextlib.suppress(_core.InputError):
            color = _check.vector(name, value)
            if min(color) >= 0.0 and max(color) <= 1.0:
                return color
    raise fail(name, f"is {value!r}", _BACKGROUND)


def check_names(options: Mapping[str, Any], others: Sequence[str] = ()) -> None:
    """Raises TypeError if an option of a view has an unknown name. others: other arguments of the function."""
    for name in options:
        if name not in _VIEW_OPTIONS and name not in _LONG_NAMES.values():
            raise TypeError(f"{name}: unknown argument; expected one of {', '.join((*others, *_VIEW_OPTIONS))}")


def view_options(path: str, options: Mapping[str, Any]) -> Dict[str, Any]:
    """Returns the checked options of a view with the names of _core. `background` can be a tuple, which _core does not accept."""
    given = {name: value for name, value in options.items() if value is not None}
    for name, long_name in _LONG_NAMES.items():
        if name in given and long_name in given:
            raise fail(long_name, f"is another name of {name}", "only one of them")
    for name in given:
        if not is_model_file(path) and name not in ("aspect", "allow_outside"):
            raise fail(name, "applies only to model files", "a file ending in .obj, .gltf, .glb, .ply or .stl")
    limits = {"aspect": (1.0 / _check.MAX_SIDE, _check.MAX_SIDE), "yaw": (-360.0, 360.0), "pitch": (-89.0, 89.0), "zoom": (1e-3, 1e3),
              "fov": (1.0, 170.0), "turn_seconds": (0.0, 1e9)}
    checks: Dict[str, Callable[[str, Any], Any]] = {
        **{name: lambda name, value: _check.number(name, value, *limits[name]) for name in limits},
        **dict.fromkeys(("eye", "look_at", "up"), _check.vector),
        **dict.fromkeys(("inside", "floor", "allow_outside"), _check.flag),
        **dict.fromkeys(("model_scene", *_LONG_NAMES, *_LONG_NAMES.values()), _check.name_or_index),
        "environment": _check.path,
        "background": _background,
        "times": lambda name, value: [_check.number(f"times[{i}]", t, -1e9, 1e9)
                                      for i, t in enumerate(_check.items("times", value, "a sequence of numbers"))],
        "up_axis": lambda name, value: _check.choice(name, value, ("y", "z")),
    }
    return {_LONG_NAMES.get(name, name): checks[name](name, value) for name, value in given.items()}


def times_of(time: Any, cameras: Sequence[Any]) -> List[float]:
    times = list(time) if isinstance(time, Iterable) and np.shape(time) != () or isinstance(time, Iterator) else [time] * len(cameras)
    if len(times) != len(cameras):
        raise fail("time", f"has {len(times)} values", f"one per camera, {len(cameras)}")
    return [_check.number("time", t) for t in times]


def pixel_kind(linear: bool, alpha: bool) -> Any:
    return _core.PixelKind.light if linear else _core.PixelKind.rgba if alpha else _core.PixelKind.rgb


def warn(lines: Sequence[str]) -> None:
    """Issues Python warnings, which refer to the line that called this package."""
    if not lines:
        return
    level, frame = 1, sys._getframe()
    while frame is not None and frame.f_globals.get("__package__") == __package__:
        level, frame = level + 1, frame.f_back  # type: ignore[assignment]
    for line in lines:
        warnings.warn(line, RenderWarning, stacklevel=level)


def emit(core: Any) -> None:
    """Issues the warnings of a scene as Python warnings."""
    warn(core.take_warnings())
