# SPDX-License-Identifier: Apache-2.0
"""The low-level interface: passes that draw arrays with the library's shaders and OpenGL's draw state.

    from halfspace import draw
    image = np.zeros((480, 640, 4), np.uint8)
    p = draw.Pass(color=image)
    p.draw(draw.colored(np.eye(4)), positions=triangle, colors=colors)
    p.run()

Conventions are OpenGL's: clip = P V M p, window depth in [0, 1], winding counter-clockwise. Row 0 of an image is its top row.
"""

from __future__ import annotations

from typing import Any, Iterable, Optional, Sequence, Tuple

import numpy as np

from . import _check, _core
from ._check import fail
from .material import Texture

_COLOR_TYPES = {"rgba8": np.uint8, "srgb8a8": np.uint8, "rgba16f": np.float16, "rgba32f": np.float32}
_DEPTH_TYPES = {"d16": np.dtype(np.uint16), "d24": np.dtype(np.uint32), "d32f": np.dtype(np.float32), "d24s8": np.dtype(np.uint32),
                "d32fs8": np.dtype([("depth", np.float32), ("stencil", np.uint32)])}
_DEFAULT_FORMATS = {np.dtype(np.uint8): "srgb8a8", np.dtype(np.float16): "rgba16f", np.dtype(np.float32): "rgba32f"}


def _word(enum: str, name: str, value: Any) -> Any:
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
        b.source_color, b.destination_color = _word("BlendFactor", "source", source), _word("BlendFactor", "destination", destination)
        b.source_alpha = _word("BlendFactor", "source_alpha", source_alpha)
        b.destination_alpha = _word("BlendFactor", "destination_alpha", destination_alpha)
        b.color_equation = _word("BlendEquation", "equation", equation)
        b.alpha_equation = _word("BlendEquation", "equation_alpha", equation_alpha)
        b.set_constant(*_check.vector("constant", constant, 4))
        self._core = b


class Stencil:
    """The stencil test of one face. Operations: keep, zero, replace, increment_clamp, decrement_clamp, invert, increment_wrap,
    decrement_wrap; `fail` if the stencil test fails, `depth_fail` if only the depth test fails, `passed` if both pass."""

    __slots__ = ("_core",)

    def __init__(self, compare: str = "always", *, reference: int = 0, fail: str = "keep", depth_fail: str = "keep", passed: str = "keep",
                 read_mask: int = 255, write_mask: int = 255) -> None:
        s = _core.StencilFace()
        s.compare = _word("CompareOp", "compare", compare)
        s.fail, s.depth_fail = _word("StencilOp", "fail", fail), _word("StencilOp", "depth_fail", depth_fail)
        s.pass_ = _word("StencilOp", "passed", passed)
        for name, value in (("reference", reference), ("read_mask", read_mask), ("write_mask", write_mask)):
            setattr(s, name, _check.integer(name, value, 0, 255))
        self._core = s


class State:
    """The state of a draw. The defaults are OpenGL's initial values, but with the depth test enabled.

    topology: triangles, triangle_strip, triangle_fan, points, lines, line_strip, line_loop.   polygon_mode: fill, line, point.
    cull: none, front, back, front_and_back.   front: counter_clockwise, clockwise.   provoking: last, first.
    depth_compare: never, less, equal, less_equal, greater, not_equal, greater_equal, always.   depth_range: window depths of the clip planes.
    depth_clip: negative_one_to_one (OpenGL) or zero_to_one (reversed Z: with depth_compare="greater" and depth cleared to 0).
    offset: (slope factor, constant units, clamp) of glPolygonOffset.
    viewport, scissor: (x, y, width, height) in pixels, from the lower left corner. The default is the whole image.
    blend: a Blend, "alpha", "additive" or None.   color_mask: which of r, g, b and a are written.
    stencil: a Stencil for both faces, or a pair for front and back faces.
    order_independent: blend fragments from far to near, regardless of the order of the draws; needs depth_write=False.
    point_size, line_width: in pixels.   sample_mask, alpha_to_coverage, sample_shading: for passes with several samples per pixel.
    """

    __slots__ = ("_core", "_base_vertex")

    def __init__(self, *, topology: str = "triangles", polygon_mode: str = "fill", cull: str = "none", front: str = "counter_clockwise",
                 provoking: str = "last", depth_test: bool = True, depth_write: bool = True, depth_compare: str = "less",
                 depth_clip: str = "negative_one_to_one", depth_clamp: bool = False, depth_range: Tuple[float, float] = (0.0, 1.0),
                 offset: Tuple[float, float, float] = (0.0, 0.0, 0.0), viewport: Optional[Sequence[int]] = None,
                 scissor: Optional[Sequence[int]] = None, blend: Any = None, color_mask: Sequence[bool] = (True, True, True, True),
                 stencil: Any = None, order_independent: bool = False, point_size: float = 1.0, point_origin: str = "upper_left",
                 line_width: float = 1.0, sample_mask: int = 0xFFFFFFFF, alpha_to_coverage: bool = False, sample_shading: bool = False,
                 base_vertex: int = 0) -> None:
        s = _core.DrawState()
        s.topology, s.polygon_mode = _word("DrawTopology", "topology", topology), _word("PolygonMode", "polygon_mode", polygon_mode)
        s.cull, s.front = _word("CullMode", "cull", cull), _word("Winding", "front", front)
        s.provoking, s.point_origin = _word("ProvokingVertex", "provoking", provoking), _word("PointOrigin", "point_origin", point_origin)
        near, far = (_check.number("depth_range", d, 0.0, 1.0) for d in _check.pair("depth_range", depth_range, "a pair of depths"))
        s.set_depth(bool(depth_test), bool(depth_write), _word("CompareOp", "depth_compare", depth_compare),
                    _word("ClipDepth", "depth_clip", depth_clip), bool(depth_clamp), near, far)
        s.set_offset(*_check.vector("offset", offset))
        s.viewport, s.scissor = _rect("viewport", viewport, 1), _rect("scissor", scissor, 0)
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
            if depth_compare not in ("less", "less_equal", "greater", "greater_equal"):
                raise fail("depth_compare", f"is {depth_compare!r} with order_independent=True",
                           "less, less_equal, greater or greater_equal")
        s.order_independent, s.alpha_to_coverage, s.sample_shading = bool(order_independent), bool(alpha_to_coverage), bool(sample_shading)
        s.point_size = _check.number("point_size", point_size, 0.0, 4096.0)
        s.line_width = _check.number("line_width", line_width, 0.0, 4096.0)
        s.sample_mask = _check.integer("sample_mask", sample_mask, 0, 0xFFFFFFFF)
        s.base_vertex = self._base_vertex = _check.integer("base_vertex", base_vertex, -2**31, 2**31 - 1)
        self._core = s


def _rect(name: str, value: Any, smallest: int) -> Any:
    if value is None:
        return None
    x, y, width, height = _check.pair(name, value, "(x, y, width, height)", 4)
    x, y = (_check.integer(name, n, -_check.MAX_SIDE, _check.MAX_SIDE) for n in (x, y))
    width, height = (_check.integer(name, n, -2**31, 2**31 - 1) for n in (width, height))
    if not (smallest <= width <= _check.MAX_SIDE and smallest <= height <= _check.MAX_SIDE):
        raise fail(name, f"is {tuple(value)}", f"a width and a height from {smallest} to {_check.MAX_SIDE}")
    return _core.Rect(x, y, width, height)


def light(type: str = "directional", *, place: Sequence[float] = (0.0, 0.0, 1.0), diffuse: Sequence[float] = (1.0, 1.0, 1.0),
          specular: Sequence[float] = (1.0, 1.0, 1.0), attenuation: Sequence[float] = (1.0, 0.0, 0.0), axis: Sequence[float] = (0.0, 0.0, 1.0),
          inner: float = 20.0, outer: float = 30.0) -> Any:
    """Returns a light for phong() and metallic().

    type: "directional" (place: direction towards the light), or "point" or "spot" (place: position in world space).
    attenuation: (a, b, c) of 1 / (a + b d + c d^2).   spot: axis, towards the light; inner, outer: degrees from the axis.
    """
    kind = _word("LightType", "type", type)
    where = np.array(_check.vector("place", place))
    if type == "directional":
        where = where / (np.linalg.norm(where) or 1.0)
    towards = np.array(_check.vector("axis", axis))
    cosines = np.cos(np.radians([_check.number("inner", inner, 0.0, 90.0), _check.number("outer", outer, inner, 90.0)]))
    return _core.Light(kind, where.tolist(), _check.vector("diffuse", diffuse), _check.vector("specular", specular),
                       _check.vector("attenuation", attenuation), (towards / (np.linalg.norm(towards) or 1.0)).tolist(), *cosines.tolist())


def colored(clip_from_object: Any, color: Sequence[float] = (1.0, 1.0, 1.0, 1.0)) -> Any:
    """Returns a shader without lighting: `color` times the vertex color, both linear. Arrays: positions (N, 3), colors (N, 4).

    clip_from_object: (4, 4).
    """
    return _core.colored(_check.numbers("clip_from_object", clip_from_object, (4, 4)), _check.vector("color", color, 4))


def _placing(clip_from_world: Any, world_from_object: Any, eye: Any, lights: Iterable[Any], two_sided: bool) -> Any:
    world = np.eye(4) if world_from_object is None else world_from_object
    if not isinstance(lights, Iterable):
        raise fail("lights", f"is of type {type(lights).__name__}", "a list of lights")
    lights = list(lights)
    for i, one in enumerate(lights):
        if not isinstance(one, _core.Light):
            raise fail(f"lights[{i}]", f"is of type {type(one).__name__}", "a light of draw.light()")
    world = _check.transforms("world_from_object", _check.numbers("world_from_object", world, (4, 4)))[0]
    return _core.Placing(_check.numbers("clip_from_world", clip_from_world, (4, 4)), world,
                         _check.vector("eye", eye), lights, bool(two_sided))


def _texels(texture: Any) -> Tuple[Any, Any]:
    if texture is None:
        texture, texels = Texture(np.zeros((1, 1), np.uint8)), None
    else:
        texture = texture if isinstance(texture, Texture) else Texture(texture)
        texels = texture._texels
    return texels, texture._sampler


def phong(clip_from_world: Any, world_from_object: Any = None, *, eye: Any, lights: Iterable[Any] = (), color: Any = (1.0, 1.0, 1.0),
          ambient: Any = (0.0, 0.0, 0.0), diffuse: Any = (1.0, 1.0, 1.0), specular: Any = (0.0, 0.0, 0.0), emissive: Any = (0.0, 0.0, 0.0),
          shininess: float = 32.0, model: str = "blinn_phong", per_vertex: bool = False, two_sided: bool = False, texture: Any = None) -> Any:
    """Returns a shader for surfaces: color (ambient + diffuse D) + specular S + emissive. Arrays: positions, normals (N, 3), and uvs (N, 2)
    if there is a texture, which multiplies the color.

    eye: position of the camera in world space.   model: lambert, phong, blinn_phong.   per_vertex: Gouraud shading.
    """
    factors = [_check.vector(n, v) for n, v in (("color", color), ("ambient", ambient), ("diffuse", diffuse), ("specular", specular),
                                                ("emissive", emissive))]
    return _core.phong(_placing(clip_from_world, world_from_object, eye, lights, two_sided), factors,
                       _check.number("shininess", shininess, 0.0, 1e5), _word("LightModel", "model", model), bool(per_vertex),
                       *_texels(texture))


def metallic(clip_from_world: Any, world_from_object: Any = None, *, eye: Any, lights: Iterable[Any] = (),
             base_color: Any = (0.8, 0.8, 0.8, 1.0), metallic: float = 0.0, roughness: float = 0.6, emissive: Any = (0.0, 0.0, 0.0),
             ambient: Any = (0.0, 0.0, 0.0), vertex_colors: bool = False, two_sided: bool = False, texture: Any = None) -> Any:
    """Returns the metallic-roughness shader of glTF 2.0. Arrays: positions, normals (N, 3); colors (N, 4) with vertex_colors; uvs (N, 2)
    with a texture, which multiplies the base color. An alpha below 1 is written to the image; `State(blend="alpha")` blends with it."""
    if vertex_colors and texture is not None:
        raise fail("vertex_colors", "are given with a texture", "one of them")
    return _core.metallic(_placing(clip_from_world, world_from_object, eye, lights, two_sided), _check.vector("base_color", base_color, 4),
                          _check.number("metallic", metallic, 0.0, 1.0), _check.number("roughness", roughness, 0.0, 1.0),
                          _check.vector("emissive", emissive), _check.vector("ambient", ambient), bool(vertex_colors), *_texels(texture))


class Pass:
    """A list of draws into images. run() executes them in order.

    color: a C-contiguous array of shape (H, W, 4) that receives the colors: uint8 (format "srgb8a8" or "rgba8"), float16 ("rgba16f") or
        float32 ("rgba32f").   color_format: chosen by the dtype if None, where uint8 means "srgb8a8". Colors are linear in shaders.
    depth: an array of shape (H, W) that receives the depth, or None for a depth buffer that only the pass uses. Types: uint16 for "d16",
        uint32 for "d24" and "d24s8", float32 for "d32f", and [("depth", float32), ("stencil", uint32)] for "d32fs8".
    depth_format: one of these formats, or "none" for no depth buffer.
    samples: samples per pixel: 1, 2, 4 or 8.
    load: start with the contents of the arrays. Otherwise, the pass starts with clear_color (linear), clear_depth and clear_stencil. A
        depth buffer without an array always starts with clear_depth and clear_stencil.

    The arrays of draws, except for indices, are not copied if they are C-contiguous and have the types that draw() specifies. Do not change
    them before run().
    """

    def __init__(self, color: np.ndarray, depth: Optional[np.ndarray] = None, *, color_format: Optional[str] = None,
                 depth_format: str = "d32f", samples: int = 1, load: bool = False, clear_color: Sequence[float] = (0.0, 0.0, 0.0, 0.0),
                 clear_depth: float = 1.0, clear_stencil: int = 0) -> None:
        if not isinstance(color, np.ndarray) or color.ndim != 3 or color.shape[2] != 4 or color.dtype not in _DEFAULT_FORMATS:
            raise fail("color", f"is {_described(color)}", "uint8, float16 or float32 of shape (H, W, 4)")
        name = color_format if color_format is not None else _DEFAULT_FORMATS[color.dtype]
        if _COLOR_TYPES[_check.choice("color_format", name, tuple(_COLOR_TYPES))] != color.dtype:
            raise fail("color", f"has the dtype {color.dtype}", f"{np.dtype(_COLOR_TYPES[name])} for the format {name}")
        height, width = color.shape[:2]
        _check.size((width, height))
        _check.choice("depth_format", depth_format, ("none", *_DEPTH_TYPES))
        if depth is not None and depth_format == "none":
            raise fail("depth", "is given with the format none", "None")
        if depth is not None:
            kind = _DEPTH_TYPES.get(depth_format)
            if not isinstance(depth, np.ndarray) or depth.shape != (height, width) or depth.dtype != kind:
                raise fail("depth", f"is {_described(depth)}", f"{kind} of shape {(height, width)}")
        self._targets = [(label, array, _place(array)) for label, array in (("color", color), ("depth", depth)) if array is not None]
        for label, array, _ in self._targets:
            if not (array.flags.c_contiguous and array.flags.writeable):
                raise fail(label, "is not C-contiguous and writeable", "an array that is")
        if not isinstance(samples, (int, np.integer)) or samples not in (1, 2, 4, 8):
            raise fail("samples", f"is {samples!r}", "1, 2, 4 or 8")
        self._core = _core.Pass(width, height, getattr(_core.ColorFormat, name), color, getattr(_core.DepthFormat, depth_format), depth,
                                samples)
        self._core.set_load(bool(load), _check.vector("clear_color", clear_color, 4), _check.number("clear_depth", clear_depth, 0.0, 1.0),
                            _check.integer("clear_stencil", clear_stencil, 0, 255))

    def draw(self, shader: Any, *, indices: Any = None, state: Optional[State] = None, **arrays: Any) -> None:
        """Adds a draw.

        shader: the result of colored(), phong() or metallic().
        indices: uint32 of shape (M,) or (M, 3). The default is 0, 1, 2, ...
        arrays: the arrays that the shader needs, named positions, normals, colors or uvs: float32 of shape (N, 2), (N, 3) or (N, 4).
        """
        if not isinstance(shader, _core.Shader):
            raise fail("shader", f"is of type {type(shader).__name__}", "the result of colored(), phong() or metallic()")
        if state is not None and not isinstance(state, State):
            raise fail("state", f"is of type {type(state).__name__}", "a State or None")
        needed = shader.attributes
        if sorted(arrays) != sorted(needed):
            raise fail("arrays", f"are {', '.join(sorted(arrays)) or 'missing'}", ", ".join(needed))
        widths = {"positions": 3, "normals": 3, "colors": 4, "uvs": 2}
        streams = [_check.numbers(name, arrays[name], (None, widths[name]), np.float32) for name in needed]
        counts = {name: len(rows) for name, rows in zip(needed, streams)}
        if len(set(counts.values())) != 1 or 0 in counts.values():
            raise fail("arrays", f"have {', '.join(map(str, counts.values()))} rows", "the same number, at least 1")
        index = None
        if indices is not None:
            # A copy, because an index that is changed after the check could read outside the arrays.
            try:
                index = np.array(indices).reshape(-1)
            except ValueError:  # rows of different lengths
                raise fail("indices", "is not an array", "integers of shape (M,) or (M, 3)") from None
            index = _check.indices("indices", index, None, len(streams[0]))
        base = 0 if state is None else state._base_vertex
        if base != 0:
            low, high = (0, len(streams[0]) - 1) if index is None else (int(index.min(initial=0)), int(index.max(initial=0)))
            if low + base < 0 or high + base >= len(streams[0]):
                raise fail("base_vertex", f"is {base}, so that vertices {low + base} to {high + base} are drawn",
                           f"vertices from 0 to {len(streams[0]) - 1}")
        chosen = state._core if state is not None else _core.DrawState()
        self._core.draw(shader, streams, index, chosen)

    def run(self, *, threads: Optional[int] = None) -> int:
        """Executes and removes all draws. Returns the number of draws. The pixels do not depend on the number of threads."""
        for label, array, place in self._targets:
            if _place(array) != place:
                raise fail(label, "was resized", "an array that keeps its memory until run()")
        return self._core.run(_check.threads(threads, _core.cores()))


def _place(array: np.ndarray) -> Tuple[Any, ...]:
    """Returns the address and the shape of an array."""
    return (array.__array_interface__["data"][0], array.shape)


def _described(value: Any) -> str:
    return f"{value.dtype} of shape {value.shape}" if isinstance(value, np.ndarray) else repr(value)
