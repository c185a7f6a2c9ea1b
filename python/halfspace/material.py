# SPDX-License-Identifier: Apache-2.0
"""Materials and textures of meshes."""

from __future__ import annotations

from typing import Any, Optional, Sequence, Tuple, Union

import numpy as np

from . import _check, _core
from ._check import fail

_FILTERS = ("nearest", "bilinear", "trilinear")
_WRAPS = ("repeat", "mirrored", "clamp")
_ALPHA_MODES = ("opaque", "mask", "blend")


class Texture:
    """An image that covers a surface. The texels are copied.

    texels: uint8 of shape (H, W), (H, W, 3) or (H, W, 4), top row first. Base color and emissive textures contain sRGB values with
        straight alpha; all others contain linear values.
    filter: "nearest", "bilinear" or "trilinear" (with mip levels).
    wrap: "repeat", "mirrored" or "clamp", or a pair of them for u and v.
    anisotropy: maximum number of probes along an elongated footprint, 1 to 16.
    """

    __slots__ = ("_texels", "_sampler")

    def __init__(self, texels: Any, *, filter: str = "trilinear", wrap: Union[str, Tuple[str, str]] = "repeat", anisotropy: int = 8) -> None:
        checked = _check.texels("texels", texels)
        self._texels = checked.copy() if np.shares_memory(checked, texels) else checked
        pair = tuple(wrap) if isinstance(wrap, (tuple, list)) else (wrap, wrap)
        if len(pair) != 2:
            raise fail("wrap", f"is {wrap!r}", "a word or a pair of words")
        wraps = [getattr(_core.Wrap, _check.choice("wrap", w, _WRAPS)) for w in pair]
        chosen = getattr(_core.Filter, _check.choice("filter", filter, _FILTERS))
        self._sampler = _core.Sampler(chosen, wraps[0], wraps[1], _check.integer("anisotropy", anisotropy, 1, 16))


def _texture(name: str, value: Any) -> Texture:
    if isinstance(value, Texture):
        return value
    try:
        return Texture(value)
    except _core.InputError as e:
        raise _core.InputError(f"{name}: {e}") from None


class Material:
    """The appearance of a surface: the metallic-roughness material of glTF 2.0. Each property is a number multiplied by a texture.

    base_color: linear (r, g, b) or (r, g, b, a), in [0, 1]. Convert sRGB values with srgb().
    metallic, roughness: 0 to 1.   specular: scales the reflectance of non-metals.   ior: index of refraction, at least 1.
    emissive: linear (r, g, b); may exceed 1.   clearcoat, clearcoat_roughness: 0 to 1.
    sheen, sheen_roughness: white reflection by the fibers of cloth, 0 to 1.
    alpha_mode: "opaque", "mask" (the surface exists where alpha >= alpha_cutoff) or "blend". The default is "blend" if the alpha of
        base_color is less than 1, otherwise "opaque".
    unlit: draw the base color without lighting.   double_sided: draw both sides.
    *_texture: a Texture, or an array that Texture accepts. metallic_roughness_texture has roughness in the green and metallic in the blue
        channel, as in glTF. normal_texture is in tangent space with green up. Textures need a mesh with `uvs`.
    """

    __slots__ = ("_core", "_textures", "_text")

    def __init__(self, base_color: Sequence[float] = (0.8, 0.8, 0.8), *, metallic: float = 0.0, roughness: float = 0.6, specular: float = 1.0,
                 ior: float = 1.5, emissive: Sequence[float] = (0.0, 0.0, 0.0), clearcoat: float = 0.0, clearcoat_roughness: float = 0.0,
                 sheen: float = 0.0, sheen_roughness: float = 0.5,
                 alpha_mode: Optional[str] = None, alpha_cutoff: float = 0.5, unlit: bool = False, double_sided: bool = True,
                 normal_scale: float = 1.0, occlusion_strength: float = 1.0, base_color_texture: Any = None,
                 metallic_roughness_texture: Any = None, normal_texture: Any = None, occlusion_texture: Any = None,
                 emissive_texture: Any = None) -> None:
        if isinstance(base_color, str):
            raise fail("base_color", f"is {base_color!r}", "3 or 4 numbers from 0 to 1")
        color = _check.numbers("base_color", base_color, (None,))
        if color.size not in (3, 4) or color.min() < 0.0 or color.max() > 1.0:
            raise fail("base_color", f"is {np.asarray(base_color).tolist()}", "3 or 4 numbers from 0 to 1")
        rgba = (*color[:3], color[3] if color.size == 4 else 1.0)
        m = _core.Material()
        m.set_base_color(list(rgba))
        m.set_emissive([_check.number("emissive", x, 0.0, 1e9) for x in _check.vector("emissive", emissive)])
        limits = {"metallic": (metallic, 1.0), "roughness": (roughness, 1.0), "specular": (specular, 1.0), "clearcoat": (clearcoat, 1.0),
                  "clearcoat_roughness": (clearcoat_roughness, 1.0), "sheen": (sheen, 1.0),
                  "sheen_roughness": (sheen_roughness, 1.0), "alpha_cutoff": (alpha_cutoff, 1.0),
                  "normal_scale": (normal_scale, 1e3), "occlusion_strength": (occlusion_strength, 1.0)}
        for name, (value, high) in limits.items():
            setattr(m, name, _check.number(name, value, 0.0, high))
        m.ior = _check.number("ior", ior, 1.0, 100.0)
        mode = ("blend" if rgba[3] < 1.0 else "opaque") if alpha_mode is None else _check.choice("alpha_mode", alpha_mode, _ALPHA_MODES)
        m.alpha_mode = getattr(_core.AlphaMode, mode)
        m.unlit, m.double_sided = bool(unlit), bool(double_sided)
        self._core = m
        shown = ", ".join(f"{x:g}" for x in rgba)
        self._text = f"Material(({shown}), metallic={metallic:g}, roughness={roughness:g}, alpha_mode={mode!r})"
        textures = {"base_color_texture": (base_color_texture, (("base_color", "red"),)),
                    "metallic_roughness_texture": (metallic_roughness_texture, (("roughness", "green"), ("metallic", "blue"))),
                    "normal_texture": (normal_texture, (("normal", "red"),)),
                    "occlusion_texture": (occlusion_texture, (("occlusion", "red"),)),
                    "emissive_texture": (emissive_texture, (("emissive", "red"),))}
        self._textures = {name: (_texture(name, value), uses) for name, (value, uses) in textures.items() if value is not None}

    def __repr__(self) -> str:
        return self._text

    def _materials(self) -> Any:
        """Returns the material with its textures for _core."""
        out = _core.Materials()
        for texture, uses in self._textures.values():
            number = out.add_texture(texture._texels, texture._sampler)
            for name, channel in uses:
                self._core.set_texture(name, number, getattr(_core.Channel, channel))
        out.set_material(self._core)
        return out


def srgb(codes: Any) -> np.ndarray:
    """Converts 8-bit sRGB values (uint8 of any shape, with 3 or 4 channels in the last axis) to linear float32 in [0, 1]. Alpha is divided
    by 255."""
    array = np.asarray(codes)
    if array.dtype != np.uint8 or array.ndim == 0 or array.shape[-1] not in (3, 4):
        raise fail("codes", f"are {array.dtype} of shape {array.shape}", "uint8 with 3 or 4 channels in the last axis")
    x = array.astype(np.float64) / 255.0
    out = np.where(x <= 0.04045, x / 12.92, ((x + 0.055) / 1.055) ** 2.4)
    if array.shape[-1] == 4:
        out[..., 3] = x[..., 3]
    return out.astype(np.float32)
