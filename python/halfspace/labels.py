# SPDX-License-Identifier: Apache-2.0
"""The names of labels, and the id of pixels without a surface."""

from __future__ import annotations

from typing import Dict, Iterable, Set, Tuple

import numpy as np

from . import _check, _core
from ._check import fail
from .picture import Picture

LABELS = ("color", "depth", "distance", "normal", "camera_normal", "albedo", "position", "uv", "object", "instance", "triangle",
          "barycentrics", "mask")
NO_ID: int = _core.no_id  #: id where there is no surface


def checked_outputs(outputs: Iterable[str]) -> Tuple[str, ...]:
    if isinstance(outputs, str):
        raise fail("outputs", f"is {outputs!r}", "a list of names, for example ['depth', 'object']")
    return tuple(_check.choice("outputs", name, LABELS) for name in _check.items("outputs", outputs, "a list of names"))


def images_of(outputs: Tuple[str, ...]) -> Set[str]:
    """Returns the names of the images that _core renders."""
    wanted = set(outputs)
    return wanted - {"mask"} | ({"object"} if "mask" in wanted else set())


def checked_background(depth: float) -> float:
    if not isinstance(depth, (int, float, np.integer, np.floating)) or np.isnan(depth):
        raise fail("background_depth", f"is {depth!r}", "a number or infinity")
    return float(depth)


def finished(arrays: Dict[str, np.ndarray], outputs: Tuple[str, ...]) -> Dict[str, np.ndarray]:
    """Adds the mask, and removes arrays that were needed only for the mask."""
    arrays["mask"] = arrays["object"] != NO_ID if "object" in arrays else None
    if "color" in arrays:
        arrays["color"] = arrays["color"].view(Picture)
    return {name: arrays[name] for name in outputs}
