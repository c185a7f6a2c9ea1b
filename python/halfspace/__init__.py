# SPDX-License-Identifier: Apache-2.0
"""Halfspace: a CPU renderer. Renders scenes, model files and meshes of arrays to NumPy arrays, without a GPU or a display.

    import halfspace
    picture = halfspace.render("moon", size=(1280, 720), set={"time.hours": 18})    # uint8, (720, 1280, 3)
    picture.save("moon.png")

    scene = halfspace.Scene()
    scene.add(halfspace.Mesh(vertices, faces))
    picture = scene.render((640, 480))

All problems with arguments and files are InputError, a ValueError of one line. Results have the same bits for any number of threads.
"""

from . import _core
from ._core import InputError, OutputError
from .camera import Camera
from .material import Material, Texture, srgb
from .mesh import Mesh
from .picture import Picture
from .scene import RenderWarning, Scene, render

InputError.__module__ = OutputError.__module__ = __name__
__version__: str = _core.version


def scenes() -> "list[str]":
    """Returns the names of the shipped scenes."""
    return _core.scene_names()


__all__ = ["Camera", "InputError", "Material", "Mesh", "OutputError", "Picture", "RenderWarning", "Scene", "Texture", "render", "scenes",
           "srgb"]
