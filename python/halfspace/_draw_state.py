# SPDX-License-Identifier: Apache-2.0
"""The state of draws: halfspace.draw.State and its parts."""

from __future__ import annotations

from typing import Any, Optional, Sequence, Tuple

from . import _check, _core
from ._check import fail

_MAX_QUERIES = 1024


def word(enum: str, name: str, value: Any) -> Any:
    members = getattr(_core, enum).__members__
    return members[_check.choice(name, value, tuple(members))]


class Blend:
    """result = source factor x source + destination factor x destination, for color and alpha. Names follow OpenGL.

    Factors: zero, one, src_color, dst_color, src_alpha, dst_alpha, constant_color, constant_alpha, one_minus_... of these, and
    src_alpha_saturate. Equations: add, subtract, reverse_subtract, min, max. The default is straight-alpha blending.
    """

    __slots__ = ("_core",)

    def __init__(self, source: str = "src_alpha", destination: str = "one_minus_src_alpha", equation: str = "add", *,
                 source_alpha: str = "one", destination_alpha: str = "one_minus_src_alpha", equation_alpha: str = "add",
                 constant: Sequence[float] = (0.0, 0.0, 0.0, 0.0)) -> None:
        b = _core.BlendState()
        b.source_color, b.destination_color = word("BlendFactor", "source", source), word("BlendFactor", "destination", destination)
        b.source_alpha = word("BlendFactor", "source_alpha", source_alpha)
        b.destination_alpha = word("BlendFactor", "destination_alpha", destination_alpha)
        b.color_equation = word("BlendEquation", "equation", equation)
        b.alpha_equation = word("BlendEquation", "equation_alpha", equation_alpha)
        b.set_constant(*_check.vector("constant", constant, 4))
        self._core = b


class Stencil:
    """The stencil test of one face. Operations: keep, zero, replace, increment_clamp, decrement_clamp, invert, increment_wrap,
    decrement_wrap; `fail` if the stencil test fails, `depth_fail` if only the depth test fails, `passed` if both pass."""

    __slots__ = ("_core",)

    def __init__(self, compare: str = "always", *, reference: int = 0, fail: str = "keep", depth_fail: str = "keep", passed: str = "keep",
                 read_mask: int = 255, write_mask: int = 255) -> None:
        s = _core.StencilFace()
        s.compare = word("CompareOp", "compare", compare)
        s.fail, s.depth_fail = word("StencilOp", "fail", fail), word("StencilOp", "depth_fail", depth_fail)
        s.pass_ = word("StencilOp", "passed", passed)
        for name, value in (("reference", reference), ("read_mask", read_mask), ("write_mask", write_mask)):
            setattr(s, name, _check.integer(name, value, 0, 255))
        self._core = s


class State:
    """The state of a draw. The defaults are OpenGL's initial values, but with the depth test enabled.

    topology: triangles, triangle_strip, triangle_fan, points, lines, line_strip, line_loop.   polygon_mode: fill, line, point.
    cull: none, front, back, front_and_back.   front: counter_clockwise, clockwise.   provoking: last, first.
    depth_compare: never, less, equal, less_equal, greater, not_equal, greater_equal, always.   depth_range: window depths of the clip planes.
    depth_clip: negative_one_to_one (OpenGL) or zero_to_one (reversed Z: with depth_compare="greater" and depth cleared to 0).
    offset: (slope factor, constant units, clamp) of glPolygonOffset.   offset_modes: the polygon modes in which triangles have it.
    viewport, scissor: (x, y, width, height) in pixels, from the lower left corner. The default is the whole image. The viewport may
        have fractions of a pixel, and a negative height turns the picture upside down.
    clip_origin: lower_left, or upper_left for clip spaces in which y points down.
    blend: a Blend, "alpha", "additive" or None.   color_mask: which of r, g, b and a are written.
    stencil: a Stencil for both faces, or a pair for front and back faces.
    query: number of an occlusion query, 0 to 1023, that counts the samples that pass all tests of the draw (Pass.samples_passed).
    order_independent: blend fragments from far to near, regardless of the order of the draws; needs depth_write=False
        and a color attachment, and allows neither blend nor color_mask.
    point_size, line_width: in pixels.   sample_mask, alpha_to_coverage, sample_shading: for passes with several samples per pixel.
    """

    __slots__ = ("_core", "_base_vertex", "_order_independent", "_topology")

    def __init__(self, *, topology: str = "triangles", polygon_mode: str = "fill", cull: str = "none", front: str = "counter_clockwise",
                 provoking: str = "last", depth_test: bool = True, depth_write: bool = True, depth_compare: str = "less",
                 depth_clip: str = "negative_one_to_one", depth_clamp: bool = False, depth_range: Tuple[float, float] = (0.0, 1.0),
                 offset: Tuple[float, float, float] = (0.0, 0.0, 0.0), offset_modes: Sequence[str] = ("fill",), viewport: Optional[Sequence[float]] = None,
                 scissor: Optional[Sequence[int]] = None, blend: Any = None, color_mask: Sequence[bool] = (True, True, True, True),
                 stencil: Any = None, order_independent: bool = False, point_size: float = 1.0, point_origin: str = "upper_left",
                 line_width: float = 1.0, sample_mask: int = 0xFFFFFFFF, alpha_to_coverage: bool = False, sample_shading: bool = False,
                 base_vertex: int = 0, query: Optional[int] = None, clip_origin: str = "lower_left") -> None:
        s = _core.DrawState()
        self._topology, self._order_independent = topology, bool(order_independent)
        s.topology, s.polygon_mode = word("DrawTopology", "topology", topology), word("PolygonMode", "polygon_mode", polygon_mode)
        s.cull, s.front = word("CullMode", "cull", cull), word("Winding", "front", front)
        s.provoking, s.point_origin = word("ProvokingVertex", "provoking", provoking), word("PointOrigin", "point_origin", point_origin)
        near, far = (_check.number("depth_range", d, 0.0, 1.0) for d in _check.pair("depth_range", depth_range, "a pair of depths"))
        s.set_depth(bool(depth_test), bool(depth_write), word("CompareOp", "depth_compare", depth_compare),
                    word("ClipDepth", "depth_clip", depth_clip), bool(depth_clamp), near, far)
        modes = [_check.choice("offset_modes", mode, ("fill", "line", "point")) for mode in offset_modes]
        s.set_offset(*_check.vector("offset", offset), *(mode in modes for mode in ("fill", "line", "point")))
        s.viewport, s.scissor = _viewport(viewport), _rect("scissor", scissor, 0, 2**31 - 1)
        s.clip_origin = word("ClipOrigin", "clip_origin", clip_origin)
        if isinstance(blend, str):
            blend = {"alpha": Blend(), "additive": Blend(destination="one", destination_alpha="one")}[
                _check.choice("blend", blend, ("alpha", "additive"))]
        if blend is not None:
            if not isinstance(blend, Blend):
                raise fail("blend", f"is of type {type(blend).__name__}", "a Blend, alpha, additive or None")
            s.blend = blend._core
        s.set_color_mask(*(bool(c) for c in _check.pair("color_mask", color_mask, "4 booleans", 4)))
        if stencil is not None:
            faces = (stencil, stencil) if isinstance(stencil, Stencil) else _check.pair("stencil", stencil, "a Stencil or a pair of them")
            for face in faces:
                if not isinstance(face, Stencil):
                    raise fail("stencil", f"is of type {type(face).__name__}", "a Stencil or a pair of them")
            s.set_stencil(faces[0]._core, faces[1]._core)
        if order_independent:
            if depth_write:
                raise fail("depth_write", "is True with order_independent=True", "False")
            if blend is not None:
                raise fail("blend", "is set with order_independent=True", "None")
            if not all(color_mask):
                raise fail("color_mask", "disables channels with order_independent=True", "4 times True")
            if depth_compare not in ("less", "less_equal", "greater", "greater_equal"):
                raise fail("depth_compare", f"is {depth_compare!r} with order_independent=True",
                           "less, less_equal, greater or greater_equal")
        s.order_independent, s.alpha_to_coverage, s.sample_shading = bool(order_independent), bool(alpha_to_coverage), bool(sample_shading)
        s.point_size = _check.number("point_size", point_size, 0.0, 4096.0)
        s.line_width = _check.number("line_width", line_width, 0.0, 4096.0)
        s.sample_mask = _check.integer("sample_mask", sample_mask, 0, 0xFFFFFFFF)
        s.base_vertex = self._base_vertex = _check.integer("base_vertex", base_vertex, -2**31, 2**31 - 1)
        if query is not None:
            s.query = _check.integer("query", query, 0, _MAX_QUERIES - 1)
        self._core = s


def _viewport(value: Any) -> Any:
    if value is None:
        return None
    largest = float(_check.MAX_SIDE)
    sides = _check.pair("viewport", value, "(x, y, width, height)", 4)
    x, y, width, height = (_check.number("viewport", n) for n in sides)
    if not (1 / 256 <= width <= largest and 1 / 256 <= abs(height) <= largest and abs(x) <= largest and abs(y) <= largest):
        raise fail("viewport", f"is {tuple(value)}", f"a width and a height from 1/256 to {_check.MAX_SIDE}, where the height may be negative, within {_check.MAX_SIDE} of (0, 0)")
    return _core.ViewportRect(x, y, width, height)


def _rect(name: str, value: Any, smallest: int, largest: int) -> Any:
    if value is None:
        return None
    x, y, width, height = _check.pair(name, value, "(x, y, width, height)", 4)
    x, y = (_check.integer(name, n, -largest, largest) for n in (x, y))
    width, height = (_check.integer(name, n, -2**31, 2**31 - 1) for n in (width, height))
    if not (smallest <= width <= largest and smallest <= height <= largest):
        raise fail(name, f"is {tuple(value)}", f"a width and a height from {smallest} to {largest}")
    return _core.Rect(x, y, width, height)
