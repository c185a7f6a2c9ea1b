# SPDX-License-Identifier: Apache-2.0
"""The low-level interface: passes that draw arrays with the library's shaders and OpenGL's draw state.

    from halfspace import draw
    image = np.zeros((480, 640, 4), np.uint8)
    p = draw.Pass(color=image)
    p.draw(draw.colored(np.eye(4)), positions=triangle, colors=colors)
    p.run()

Conventions are OpenGL's: clip = P V M p, window depth in [0, 1], winding counter-clockwise. Row 0 of an image is its top row.

Shaders: colored(), phong(), metallic(), depth_only(), spheres() and sky(). Available only in C++, or in an extension module of one's own
(python/examples/custom_shader): other shaders, several color targets, integer targets, blend factors that refer to a second color, and
shaders that read the index of an instance. All shaders of this module write one color.
"""

from __future__ import annotations

from typing import Any, List, Optional, Sequence, Tuple

import numpy as np

from . import _check, _core
from ._check import fail
from ._draw_state import Blend, State, Stencil
from ._shaders import colored, depth_only, light, metallic, phong, sky, spheres

__all__ = ["Blend", "Pass", "State", "Stencil", "colored", "depth_only", "light", "metallic", "phong", "sky", "spheres"]

_COLOR_TYPES = {"rgba8": np.uint8, "srgb8a8": np.uint8, "rgba16f": np.float16, "rgba32f": np.float32, "r32f": np.float32, "rg32f": np.float32,
                "rgb32f": np.float32}
_CHANNELS = {"r32f": (), "rg32f": (2,), "rgb32f": (3,)}
_WIDTHS = {"positions": 3, "normals": 3, "tangents": 4, "colors": 4, "uvs": 2, "centers": 3, "radii": 1, "corners": 2}
_WHOLE_VIEW = np.array([[-1, -1], [3, -1], [-1, 3]], np.float32)  # one triangle that covers the image
_DEPTH_TYPES = {"d16": np.dtype(np.uint16), "d24": np.dtype(np.uint32), "d32f": np.dtype(np.float32), "d24s8": np.dtype(np.uint32),
                "d32fs8": np.dtype([("depth", np.float32), ("stencil", np.uint32)])}
_DEFAULT_FORMATS = {np.dtype(np.uint8): "srgb8a8", np.dtype(np.float16): "rgba16f", np.dtype(np.float32): "rgba32f"}


class Pass:
    """A list of draws into images. run() executes them in order.

    color: a C-contiguous array of shape (H, W, 4) that receives the colors: uint8 (format "srgb8a8" or "rgba8"), float16 ("rgba16f") or
        float32 ("rgba32f"). Float32 arrays of shape (H, W), (H, W, 2) and (H, W, 3) receive the first channels ("r32f", "rg32f",
        "rgb32f"). None for a pass that only writes depth.
    color_format: chosen by the dtype and the shape if None, where uint8 means "srgb8a8". Colors are linear in shaders.
    depth: an array of shape (H, W) that receives the depth, or None for a depth buffer that only the pass uses. Types: uint16 for "d16",
        uint32 for "d24" and "d24s8", float32 for "d32f", and [("depth", float32), ("stencil", uint32)] for "d32fs8".
    depth_format: one of these formats, or "none" for no depth buffer.
    samples: samples per pixel: 1, 2, 4 or 8.
    load: start with the contents of the arrays. Otherwise, the pass starts with clear_color (linear), clear_depth and clear_stencil. A
        depth buffer without an array always starts with clear_depth and clear_stencil.

    The arrays of draws, except for indices, are not copied if they are C-contiguous and have the types that draw() specifies. Do not change
    them before run().
    """

    def __init__(self, color: Optional[np.ndarray], depth: Optional[np.ndarray] = None, *, color_format: Optional[str] = None,
                 depth_format: str = "d32f", samples: int = 1, load: bool = False, clear_color: Sequence[float] = (0.0, 0.0, 0.0, 0.0),
                 clear_depth: float = 1.0, clear_stencil: int = 0) -> None:
        if color is None:
            name = "none"
            if color_format is not None:
                raise fail("color_format", f"is {color_format!r} without a color array", "None")
            if not isinstance(depth, np.ndarray) or depth.ndim != 2:
                raise fail("depth", f"is {_described(depth)}", "an array of shape (H, W) if there is no color array")
            height, width = depth.shape
        else:
            name = _color_format(color, color_format)
            height, width = color.shape[:2]
        _check.size((width, height))
        _check.choice("depth_format", depth_format, ("none", *_DEPTH_TYPES))
        if depth is not None and depth_format == "none":
            raise fail("depth", "is given with the format none", "None")
        if depth is not None:
            kind = _DEPTH_TYPES.get(depth_format)
            if not isinstance(depth, np.ndarray) or depth.shape != (height, width) or depth.dtype != kind:
                raise fail("depth", f"is {_described(depth)}", f"{kind} of shape {(height, width)}")
        self.samples_passed: List[int] = []
        self._targets = [(label, array, _place(array)) for label, array in (("color", color), ("depth", depth)) if array is not None]
        for label, array, _ in self._targets:
            if not (array.flags.c_contiguous and array.flags.writeable):
                raise fail(label, "is not C-contiguous and writeable", "an array that is")
        if not isinstance(samples, (int, np.integer)) or samples not in (1, 2, 4, 8):
            raise fail("samples", f"is {samples!r}", "1, 2, 4 or 8")
        self._core = _core.Pass(width, height, getattr(_core.TexelFormat, name), color, getattr(_core.TexelFormat, depth_format), depth,
                                samples)
        self._core.set_load(bool(load), _check.vector("clear_color", clear_color, 4), _check.number("clear_depth", clear_depth, 0.0, 1.0),
                            _check.integer("clear_stencil", clear_stencil, 0, 255))

    def draw(self, shader: Any, *, indices: Any = None, state: Optional[State] = None, instances: int = 1, per_instance: Sequence[str] = (),
             **arrays: Any) -> None:
        """Adds a draw.

        shader: the result of colored(), phong() or another function of this module.
        indices: uint32 of shape (M,) or (M, 3). The default is 0, 1, 2, ...
        arrays: the arrays that the shader needs, for example positions, normals, colors or uvs: float32 with one row per vertex.
        instances: how many times the vertices are drawn.   per_instance: the names of arrays with one row per instance, for example
            ["colors"]. Copies with transforms of their own are separate draws.
        """
        if not isinstance(shader, _core.Shader):
            raise fail("shader", f"is of type {type(shader).__name__}", "the result of colored() or another shader of halfspace.draw")
        if state is not None and not isinstance(state, State):
            raise fail("state", f"is of type {type(state).__name__}", "a State or None")
        needed = shader.attributes
        if needed == ["corners"]:
            arrays.setdefault("corners", _WHOLE_VIEW)
        if "centers" in needed and (state is None or state._topology != "points"):
            raise fail("topology", f"is {'triangles' if state is None else state._topology}", "points for spheres()")
        if sorted(arrays) != sorted(needed):
            raise fail("arrays", f"are {', '.join(sorted(arrays)) or 'missing'}", ", ".join(needed))
        streams = [_stream(name, arrays[name], "centers" in needed) for name in needed]
        copies = _check.integer("instances", instances, 1, 2**31 - 1)
        own = {_check.choice("per_instance", name, needed) for name in _check.items("per_instance", per_instance, "a list of names")}
        counts = [len(rows) for name, rows in zip(needed, streams) if name not in own]
        if not counts:
            raise fail("per_instance", "names all arrays", "at least one array with one row per vertex")
        if len(set(counts)) != 1 or 0 in counts:
            raise fail("arrays", f"have {', '.join(map(str, counts))} rows", "the same number, at least 1")
        for name, rows in zip(needed, streams):
            if name in own and len(rows) < copies:
                raise fail(name, f"has {len(rows)} rows", f"one per instance, {copies}")
        vertices = counts[0]
        index = None
        if indices is not None:
            # A copy, because an index that is changed after the check could read outside the arrays.
            try:
                index = np.array(indices).reshape(-1)
            except ValueError:  # rows of different lengths
                raise fail("indices", "is not an array", "integers of shape (M,) or (M, 3)") from None
            index = _check.indices("indices", index, None, vertices)
        base = 0 if state is None else state._base_vertex
        if base != 0:
            low, high = (0, vertices - 1) if index is None else (int(index.min(initial=0)), int(index.max(initial=0)))
            if low + base < 0 or high + base >= vertices:
                raise fail("base_vertex", f"is {base}, so that vertices {low + base} to {high + base} are drawn",
                           f"vertices from 0 to {vertices - 1}")
        if copies * (vertices if index is None else len(index)) >= 2**32:
            raise fail("instances", f"is {copies} with {vertices if index is None else len(index)} vertices each", "less than 2^32 vertices in all")
        if state is not None and state._order_independent and not any(label == "color" for label, _, _ in self._targets):
            raise fail("state", "has order_independent=True, but the pass has no color array", "a pass with one")
        chosen = state._core if state is not None else _core.DrawState()
        self._core.draw(shader, streams, [int(name in own) for name in needed], index, chosen, copies)

    def run(self, *, threads: Optional[int] = None) -> int:
        """Executes and removes all draws. Returns the number of draws. The pixels do not depend on the number of threads.

        Sets the member samples_passed: a list whose element i is the number of samples that passed all tests in draws with State(query=i).
        """
        for label, array, place in self._targets:
            if _place(array) != place:
                raise fail(label, "was resized", "an array that keeps its memory until run()")
        count, passed = self._core.run(_check.threads(threads, _core.cores()))
        self.samples_passed = passed
        return count


def _color_format(color: Any, wanted: Optional[str]) -> str:
    """Returns the format of a color array, which can only have one format unless it is uint8."""
    if not isinstance(color, np.ndarray) or color.ndim not in (2, 3) or color.dtype not in _DEFAULT_FORMATS:
        raise fail("color", f"is {_described(color)}", "uint8, float16 or float32 of shape (H, W, 4)")
    channels = {(): "r32f", (2,): "rg32f", (3,): "rgb32f"}.get(color.shape[2:]) if color.dtype == np.float32 else None
    if channels is None and color.shape[2:] != (4,):
        raise fail("color", f"is {_described(color)}", "uint8, float16 or float32 of shape (H, W, 4)")
    name = wanted if wanted is not None else channels or _DEFAULT_FORMATS[color.dtype]
    if _COLOR_TYPES[_check.choice("color_format", name, tuple(_COLOR_TYPES))] != color.dtype:
        raise fail("color", f"has the dtype {color.dtype}", f"{np.dtype(_COLOR_TYPES[name])} for the format {name}")
    if _CHANNELS.get(name, (4,)) != color.shape[2:]:
        raise fail("color", f"has the shape {color.shape}", f"(H, W{''.join(f', {n}' for n in _CHANNELS.get(name, (4,)))}) for the format {name}")
    return name


def _stream(name: str, value: Any, spheres: bool) -> np.ndarray:
    """Returns an array of a draw. The colors of spheres have no alpha."""
    if name == "radii":
        return _check.numbers(name, value, (None,), np.float32)[:, np.newaxis]
    return _check.numbers(name, value, (None, 3 if spheres and name == "colors" else _WIDTHS[name]), np.float32)


def _place(array: np.ndarray) -> Tuple[Any, ...]:
    """Returns the address and the shape of an array."""
    return (array.__array_interface__["data"][0], array.shape)


def _described(value: Any) -> str:
    return f"{value.dtype} of shape {value.shape}" if isinstance(value, np.ndarray) else repr(value)
