# SPDX-License-Identifier: Apache-2.0
"""halfspace.render."""

from __future__ import annotations

import os
from typing import Any, Mapping, Optional, Union

from . import _check
from ._options import check_names, is_model_file
from .camera import Camera
from .picture import Picture
from .scene import Scene, Size


def render(scene: Union[str, "os.PathLike[str]"], *, size: Size = (1920, 1080), set: Optional[Mapping[str, Any]] = None,
           camera: Union[str, Camera, None] = None, time: Optional[float] = None, linear: bool = False, alpha: bool = False,
           threads: Optional[int] = None, **view: Any) -> Picture:
    """Renders a scene or a model file. The pixels are bit-identical to those that `halfspace render` writes.

    scene: a shipped scene ("moon"), a scene file, or a model file (.obj, .gltf, .glb, .ply, .stl).
    size: (width, height) in pixels.
    set: keys of the scene and their values, for example {"time.hours": 18}.
    camera: the name of a camera of the scene or the model, or a Camera.
    time: time in the scene's animations, in seconds. The default is 0. The camera of a model file is fitted to the pose at this time. If a
        time is given and no animation is named, the first animation of the file plays; there is a warning if it has several.
    threads: number of threads. The default is one per core.
    alpha: omit the background. Alpha is straight, and 0 where nothing is drawn. background="transparent" has the same effect.
    view: arguments of Scene.load for model files, such as yaw, background and animation.
    Returns 8-bit sRGB values: uint8 of shape (height, width, 3), or (height, width, 4) with alpha=True. With linear=True, returns linear
    values before exposure and tone mapping: float32 of shape (height, width, 4).

    Raises InputError with the message that the command line prints, in terms of Python's arguments, and TypeError for an unknown argument.
    Warnings have the category RenderWarning.
    """
    check_names(view, ("size", "set", "camera", "time", "linear", "alpha", "threads"))
    width, height = _check.size(size)
    path = _check.path("scene", scene)
    alpha = alpha or (isinstance(view.get("background"), str) and view["background"] == "transparent")
    view.setdefault("aspect", width / height)
    if time is not None:
        time = _check.number("time", time, -1e9, 1e9)
        if is_model_file(path):
            view.setdefault("times", [time])
    opened = Scene.load(path, threads=threads, **view)
    keys = dict(_check.mapping("set", {} if set is None else set, "a dictionary of keys and values"))
    if isinstance(camera, str):
        keys["camera"] = camera
        camera = None
    if keys:
        opened.set(keys)
    return opened.render((width, height), camera=camera, time=0.0 if time is None else time, linear=linear, alpha=alpha)
