# SPDX-License-Identifier: Apache-2.0
"""Halfspace: a CPU renderer. Renders scenes, model files and meshes (given as arrays) to NumPy arrays, without a GPU or a display.

    import halfspace
    picture = halfspace.render("moon", size=(1280, 720), set={"time.hours": 18})    # uint8, (720, 1280, 3)
    picture.save("moon.png")

    scene = halfspace.Scene()
    scene.add(halfspace.Mesh(vertices, faces))
    picture = scene.render((640, 480))

Invalid values and files raise InputError, a ValueError with a one-line message. Files that cannot be written raise OutputError, an OSError.
Results are bit-identical for any number of threads.
"""

import os as _os

from . import _core  # first: raises ImportError if the processor lacks instructions that this build uses
from . import _check, draw
from ._core import InputError, OutputError
from ._files import DifferenceError, compare, export, info
from ._one_call import render
from ._options import RenderWarning
from .camera import Camera
from .frames import render_frames, render_models, submit_frames, submit_models
from .labels import LABELS, NO_ID
from .material import Material, Texture, srgb
from .mesh import Mesh
from .model import Model
from .picture import Picture
from .scene import Scene

InputError.__doc__ = "An argument or a file cannot be used. The message is one line: where, the problem, and what was expected."
OutputError.__doc__ = "A result cannot be written. The message is one line: the file, the problem, and what was expected."
RenderWarning.__module__ = InputError.__module__ = OutputError.__module__ = __name__
__version__: str = _core.version


def scenes() -> "list[str]":
    """Returns the names of the shipped scenes."""
    return _core.scene_names()


def set_tool_folder(folder: "str | _os.PathLike[str]") -> None:
    """Sets the folder of the programs that decode images and compressed meshes, such as halfspace-image-tool, for the whole process. By
    default, they are found relative to this package."""
    _core.set_tool_folder(_check.path("folder", folder))


__all__ = ["LABELS", "NO_ID", "Camera", "DifferenceError", "InputError", "Material", "Mesh", "Model", "OutputError", "Picture", "RenderWarning",
           "Scene", "Texture", "compare", "draw", "export", "info", "render", "render_frames", "render_models", "scenes", "set_tool_folder",
           "srgb", "submit_frames", "submit_models"]
