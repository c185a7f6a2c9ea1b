# SPDX-License-Identifier: Apache-2.0
"""The shaders of halfspace.draw."""

from __future__ import annotations

from typing import Any, Iterable, List, Optional, Sequence, Tuple

import numpy as np

from . import _check, _core
from ._check import fail
from ._draw_state import word
from .camera import _check_planes, _rigid
from .material import Texture


def light(type: str = "directional", *, place: Sequence[float] = (0.0, 0.0, 1.0), diffuse: Sequence[float] = (1.0, 1.0, 1.0),
          specular: Sequence[float] = (1.0, 1.0, 1.0), attenuation: Sequence[float] = (1.0, 0.0, 0.0), axis: Sequence[float] = (0.0, 0.0, 1.0),
          inner: float = 20.0, outer: float = 30.0, range: Optional[float] = None) -> Any:
    """Returns a light for phong() and metallic().

    type: "directional" (place: direction towards the light), or "point" or "spot" (place: position in world space).
    attenuation: (a, b, c) of 1 / (a + b d + c d^2).   spot: axis, towards the light; inner, outer: degrees from the axis.
    range: distance at which a point or spot light has faded to zero, as in KHR_lights_punctual; None: unlimited.
    """
    kind = word("LightType", "type", type)
    where = np.array(_check.vector("place", place))
    if type == "directional":
        where = where / (np.linalg.norm(where) or 1.0)
    towards = np.array(_check.vector("axis", axis))
    cosines = np.cos(np.radians([_check.number("inner", inner, 0.0, 90.0), _check.number("outer", outer, inner, 90.0)]))
    return _core.Light(kind, where.tolist(), _check.vector("diffuse", diffuse), _check.vector("specular", specular),
                       _check.vector("attenuation", attenuation), (towards / (np.linalg.norm(towards) or 1.0)).tolist(), *cosines.tolist(),
                       0.0 if range is None else 1.0 / _check.number("range", range, 1e-30, 1e30))


def colored(clip_from_object: Any, color: Sequence[float] = (1.0, 1.0, 1.0, 1.0)) -> Any:
    """Returns a shader without lighting: `color` times the vertex color, both linear. Arrays: positions (N, 3), colors (N, 4).

    clip_from_object: (4, 4).
    """
    return _core.colored(_check.numbers("clip_from_object", clip_from_object, (4, 4)), _check.vector("color", color, 4))


def _lights(lights: Iterable[Any]) -> List[Any]:
    lights = _check.items("lights", lights, "a list of lights")
    for i, one in enumerate(lights):
        if not isinstance(one, _core.Light):
            raise fail(f"lights[{i}]", f"is of type {type(one).__name__}", "a light of draw.light()")
    return lights


def _placing(clip_from_world: Any, world_from_object: Any, eye: Any, lights: Iterable[Any], two_sided: bool) -> Any:
    world = np.eye(4) if world_from_object is None else world_from_object
    world = _check.transforms("world_from_object", _check.numbers("world_from_object", world, (4, 4)))[0]
    return _core.Placing(_check.numbers("clip_from_world", clip_from_world, (4, 4)), world,
                         _check.vector("eye", eye), _lights(lights), bool(two_sided))


def _map(texture: Any) -> Any:
    if texture is None:
        return _core.Map(None, Texture(np.zeros((1, 1), np.uint8))._sampler)
    texture = texture if isinstance(texture, Texture) else Texture(texture)
    return _core.Map(texture.texels, texture._sampler)


def phong(clip_from_world: Any, world_from_object: Any = None, *, eye: Any, lights: Iterable[Any] = (), color: Any = (1.0, 1.0, 1.0),
          ambient: Any = (0.0, 0.0, 0.0), diffuse: Any = (1.0, 1.0, 1.0), specular: Any = (0.0, 0.0, 0.0), emissive: Any = (0.0, 0.0, 0.0),
          shininess: float = 32.0, model: str = "blinn_phong", per_vertex: bool = False, two_sided: bool = False, texture: Any = None,
          normal_texture: Any = None, normal_scale: float = 1.0) -> Any:
    """Returns a shader for surfaces. It computes color * (ambient + diffuse * D) + specular * S + emissive, where D and S are the sums
    of the diffuse and specular terms of the lights. Arrays: positions, normals (N, 3), and uvs (N, 2)
    if there is a texture, which multiplies the color.

    eye: position of the camera in world space.   model: lambert, phong, blinn_phong.   per_vertex: Gouraud shading.
    normal_texture: a normal map in tangent space with green up. It needs uvs and tangents (N, 4): a unit vector along u in object space,
        and the sign of the bitangent, cross(normal, tangent) w.   normal_scale: multiplies the x and y components of the map.
    """
    if per_vertex and normal_texture is not None:
        raise fail("normal_texture", "is given with per_vertex=True", "None")
    factors = [_check.vector(n, v) for n, v in (("color", color), ("ambient", ambient), ("diffuse", diffuse), ("specular", specular),
                                                ("emissive", emissive))]
    return _core.phong(_placing(clip_from_world, world_from_object, eye, lights, two_sided), factors,
                       _check.number("shininess", shininess, 0.0, 1e5), word("LightModel", "model", model), bool(per_vertex),
                       _map(texture), _map(normal_texture), _check.number("normal_scale", normal_scale, 0.0, 1e3))


def metallic(clip_from_world: Any, world_from_object: Any = None, *, eye: Any, lights: Iterable[Any] = (),
             base_color: Any = (0.8, 0.8, 0.8, 1.0), metallic: float = 0.0, roughness: float = 0.6, emissive: Any = (0.0, 0.0, 0.0),
             ambient: Any = (0.0, 0.0, 0.0), vertex_colors: bool = False, two_sided: bool = False, texture: Any = None) -> Any:
    """Returns the metallic-roughness shader of glTF 2.0. Arrays: positions, normals (N, 3); colors (N, 4) with vertex_colors; uvs (N, 2)
    with a texture, which multiplies the base color. An alpha below 1 is written to the image; `State(blend="alpha")` blends with it."""
    if vertex_colors and texture is not None:
        raise fail("vertex_colors", "are given with a texture", "one of them")
    return _core.metallic(_placing(clip_from_world, world_from_object, eye, lights, two_sided), _check.vector("base_color", base_color, 4),
                          _check.number("metallic", metallic, 0.0, 1.0), _check.number("roughness", roughness, 0.0, 1.0),
                          _check.vector("emissive", emissive), _check.vector("ambient", ambient), bool(vertex_colors), _map(texture))


def depth_only(clip_from_object: Any, *, texture: Any = None, opacity: float = 1.0, cutoff: float = 0.5) -> Any:
    """Returns a shader that writes only depth and stencil, for example for a depth prepass or a shadow map. Arrays: positions (N, 3), and
    uvs (N, 2) with a texture: pixels where opacity times the alpha of the texture is less than `cutoff` are not covered."""
    return _core.depth_only(_check.numbers("clip_from_object", clip_from_object, (4, 4)), _map(texture),
                            _check.number("opacity", opacity, 0.0, 1.0), _check.number("cutoff", cutoff, 0.0, 1.0))


def _lens(size: Any, pose: Any, fov: float, height: Optional[float], near: float, far: float) -> Tuple[Any, int, int]:
    width_px, height_px = _check.size(size)
    world = np.eye(4) if pose is None else _rigid("pose", pose)
    half = np.tan(np.radians(_check.number("fov", fov, 0.01, 179.0)) / 2.0) if height is None else _check.number("height", height, 1e-9, 1e9) / 2.0
    _check_planes(near, far)
    return _core.Lens(np.ascontiguousarray(world), [float(half * width_px / height_px), float(half)], float(near), float(far),
                      height is None), width_px, height_px


def spheres(size: Any, *, pose: Any = None, fov: float = 45.0, height: Optional[float] = None, near: float = 0.1, far: float = 1000.0,
            lights: Iterable[Any] = (), ambient: Any = (0.0, 0.0, 0.0), diffuse: Any = (1.0, 1.0, 1.0), specular: Any = (0.0, 0.0, 0.0),
            emissive: Any = (0.0, 0.0, 0.0), shininess: float = 32.0, model: str = "blinn_phong") -> Any:
    """Returns a shader for spheres. Each is a point whose pixels are the exact intersections of their rays with the sphere. Arrays: centers
    (N, 3) in camera space (x right, y up, z forward), radii (N,) and colors (N, 3), linear.

    size: (width, height) of the image.   pose: camera to world, OpenGL axes, (4, 4).   fov: vertical, in degrees.   height: if given, the
        view is orthographic, and this is its height.   The other arguments are those of phong().
    Depth is reversed: clear it to 0 and draw with State(topology="points", depth_clip="zero_to_one", depth_compare="greater").
    """
    factors = [_check.vector(n, v) for n, v in (("ambient", ambient), ("diffuse", diffuse), ("specular", specular), ("emissive", emissive))]
    return _core.spheres(*_lens(size, pose, fov, height, near, far), _lights(lights), factors, _check.number("shininess", shininess, 0.0, 1e5),
                         word("LightModel", "model", model))


def sky(size: Any, panorama: Any, *, pose: Any = None, fov: float = 45.0, brightness: float = 1.0) -> Any:
    """Returns a shader for a distant background. It covers the whole image and needs no arrays.

    size: (width, height) of the image.   pose: camera to world, OpenGL axes, (4, 4).   fov: vertical, in degrees.
    panorama: equirectangular, (H, W, 3) or (H, W, 4): uint8 sRGB values or linear float32. The center of the image is seen along -z.
    The depth is 0, the far plane of reversed depth. Draw it with State(depth_clip="zero_to_one", depth_compare="greater_equal",
    depth_write=False), or first with depth_test=False.
    """
    if isinstance(panorama, np.ndarray) and panorama.dtype == np.float32:
        if panorama.ndim != 3 or panorama.shape[2] not in (3, 4) or 0 in panorama.shape or max(panorama.shape) > _check.MAX_SIDE:
            raise fail("panorama", f"has the shape {panorama.shape}", f"(H, W, 3) or (H, W, 4) with sides from 1 to {_check.MAX_SIDE}")
        image = np.ones((*panorama.shape[:2], 4), np.float32)
        image[..., :3] = _check.numbers("panorama", panorama, (None, None, panorama.shape[2]), np.float32)[..., :3]
    else:
        image = _check.texels("panorama", panorama)
    return _core.sky(_lens(size, pose, fov, None, 0.1, 1000.0)[0], image, _check.number("brightness", brightness, 0.0, 1e9))
