# SPDX-License-Identifier: Apache-2.0
"""Materials and textures of meshes."""

from __future__ import annotations

from typing import Any, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np

from . import _check, _core
from ._check import fail
from ._immutable import Immutable

_FILTERS = ("nearest", "bilinear", "trilinear", "nearest_mipmap_nearest", "bilinear_mipmap_nearest", "nearest_mipmap_linear")
_WRAPS = ("repeat", "mirrored", "clamp", "mirrored_clamp")
_ALPHA_MODES = ("opaque", "mask", "blend")
_NUMBERS = ("metallic", "roughness", "specular", "ior", "clearcoat", "clearcoat_roughness", "sheen", "sheen_roughness", "alpha_cutoff",
            "normal_scale", "occlusion_strength", "unlit", "double_sided")  # properties of _core.Material with the same name
# The textures, and the properties and channels of _core.Material that they supply.
_TEXTURES = {"base_color_texture": (("base_color", "red"),), "metallic_roughness_texture": (("roughness", "green"), ("metallic", "blue")),
             "normal_texture": (("normal", "red"),), "occlusion_texture": (("occlusion", "red"),), "emissive_texture": (("emissive", "red"),)}


class Texture(Immutable):
    """An image that covers a surface. The texels are copied. All arguments can be read as members of the same name.

    texels: an array of shape (H, W), (H, W, 3) or (H, W, 4), top row first, with straight alpha. The dtype is uint8 (0 to 255), uint16 (0
        to 65535), float16 or float32. Integers in base color and emissive textures are sRGB values; all other texels are linear. Floats of
        colors can exceed 1. Floats of a normal texture can be the normals themselves, of length 1, instead of normals mapped to 0 to 1.
        Other floats are limited to 0 to 1 when they are drawn. No texel is rounded. The member has the shape (H, W, 4), float32 instead of
        float16, and is read-only.
    filter: "nearest", "bilinear", or one with mip levels: "trilinear", "nearest_mipmap_nearest", "bilinear_mipmap_nearest" or
        "nearest_mipmap_linear" (OpenGL's minification filters).
    mag: "nearest" or "bilinear", for texels that are larger than a pixel. The default is "nearest" if the name of `filter` begins with
        "nearest", and otherwise "bilinear".
    wrap: "repeat", "mirrored", "clamp" or "mirrored_clamp", or a pair of them for u and v. The member is a pair.
    anisotropy: maximum number of probes along an elongated footprint, 1 to 16.
    """

    __slots__ = ("texels", "filter", "mag", "wrap", "anisotropy", "_sampler")
    texels: np.ndarray
    filter: str
    mag: str
    wrap: Tuple[str, str]
    anisotropy: int

    def __init__(self, texels: Any, *, filter: str = "trilinear", mag: Optional[str] = None,
                 wrap: Union[str, Tuple[str, str]] = "repeat", anisotropy: int = 8) -> None:
        checked = _check.texels("texels", texels)
        pair = tuple(wrap) if isinstance(wrap, (tuple, list)) else (wrap, wrap)
        if len(pair) != 2:
            raise fail("wrap", f"is {wrap!r}", "a word or a pair of words")
        wraps = [getattr(_core.Wrap, _check.choice("wrap", w, _WRAPS)) for w in pair]
        chosen = getattr(_core.Filter, _check.choice("filter", filter, _FILTERS))
        magnification = ("nearest" if filter.startswith("nearest") else "bilinear") if mag is None else _check.choice("mag", mag, _FILTERS[:2])
        probes = _check.integer("anisotropy", anisotropy, 1, 16)
        self._set(texels=_check.read_only(checked, texels), filter=filter, mag=magnification, wrap=pair, anisotropy=probes,
                  _sampler=_core.Sampler(chosen, getattr(_core.Filter, magnification), wraps[0], wraps[1], probes))

    def _restore(self, members: Any) -> None:
        self.__init__(**members)  # type: ignore[misc]

    @classmethod
    def _of_file(cls, texels: np.ndarray, filter: Any, mag: Any, wrap_u: Any, wrap_v: Any, anisotropy: int) -> "Texture":
        return cls(texels, filter=filter.name, mag=mag.name, wrap=(wrap_u.name, wrap_v.name), anisotropy=anisotropy)


def _texture(name: str, value: Any) -> Texture:
    if isinstance(value, Texture):
        return value
    try:
        return Texture(value)
    except _core.InputError as e:
        raise _core.InputError(f"{name}: {e}") from None


def _linear(name: str, value: Any, alpha: bool) -> Tuple[float, ...]:
    """Returns a linear color of 3 or 4 numbers from "#rrggbb", "#rrggbbaa" or numbers. alpha: whether 4 numbers are allowed."""
    digits = value[1:] if isinstance(value, str) and value.startswith("#") else ""
    if len(digits) in (6, 8)[: 1 + alpha] and all(c in "0123456789abcdefABCDEF" for c in digits):
        return tuple(srgb(np.frombuffer(bytes.fromhex(digits), np.uint8)).tolist())
    expected = "3 or 4 numbers from 0 to 1, \"#rrggbb\" or \"#rrggbbaa\"" if alpha else "3 numbers from 0, or \"#rrggbb\""
    if isinstance(value, str):
        raise fail(name, f"is {value!r}", expected)
    color = _check.numbers(name, value, (None,))
    high = 1.0 if alpha else 1e9
    if color.size not in (3, 4)[: 1 + alpha] or color.min() < 0.0 or color.max() > high:
        raise fail(name, f"is {color.tolist()}", expected)
    return tuple(color.tolist())


class Material(Immutable):
    """The appearance of a surface: the metallic-roughness material of glTF 2.0. Each property is a number multiplied by a texture.

    All arguments can be read as members of the same name. A material cannot be changed; create another one.

    base_color: linear (r, g, b) or (r, g, b, a), in [0, 1], or sRGB as "#rrggbb" or "#rrggbbaa". Convert sRGB values with srgb(). The
        member has 4 linear numbers.
    metallic, roughness: 0 to 1.   specular: scales the reflectance of non-metals.   ior: index of refraction, at least 1.
    emissive: linear (r, g, b); may exceed 1. Also "#rrggbb".   clearcoat, clearcoat_roughness: 0 to 1.
    sheen, sheen_roughness: white reflection by the fibers of cloth, 0 to 1.
    alpha_mode: "opaque", "mask" (the surface exists where alpha >= alpha_cutoff) or "blend". The default is "blend" if the alpha of
        base_color is less than 1, otherwise "opaque".
    unlit: draw the base color without lighting, exposure and tone curve.   double_sided: draw both sides.
    *_texture: a Texture, or an array that Texture accepts. metallic_roughness_texture has roughness in the green and metallic in the blue
        channel, as in glTF. normal_texture is in tangent space with green up. Textures need a mesh with `uvs`.
    """

    __slots__ = ("base_color", "metallic", "roughness", "specular", "ior", "emissive", "clearcoat", "clearcoat_roughness", "sheen",
                 "sheen_roughness", "alpha_mode", "alpha_cutoff", "unlit", "double_sided", "normal_scale", "occlusion_strength", *_TEXTURES)
    base_color: Tuple[float, float, float, float]
    metallic: float
    roughness: float
    specular: float
    ior: float
    emissive: Tuple[float, float, float]
    clearcoat: float
    clearcoat_roughness: float
    sheen: float
    sheen_roughness: float
    alpha_mode: str
    alpha_cutoff: float
    unlit: bool
    double_sided: bool
    normal_scale: float
    occlusion_strength: float
    base_color_texture: Optional[Texture]
    metallic_roughness_texture: Optional[Texture]
    normal_texture: Optional[Texture]
    occlusion_texture: Optional[Texture]
    emissive_texture: Optional[Texture]

    def __init__(self, base_color: Union[str, Sequence[float]] = (0.8, 0.8, 0.8), *, metallic: float = 0.0, roughness: float = 0.6,
                 specular: float = 1.0, ior: float = 1.5, emissive: Union[str, Sequence[float]] = (0.0, 0.0, 0.0), clearcoat: float = 0.0,
                 clearcoat_roughness: float = 0.0, sheen: float = 0.0, sheen_roughness: float = 0.5,
                 alpha_mode: Optional[str] = None, alpha_cutoff: float = 0.5, unlit: bool = False, double_sided: bool = True,
                 normal_scale: float = 1.0, occlusion_strength: float = 1.0, base_color_texture: Any = None,
                 metallic_roughness_texture: Any = None, normal_texture: Any = None, occlusion_texture: Any = None,
                 emissive_texture: Any = None) -> None:
        color = _linear("base_color", base_color, True)
        rgba = (*color[:3], color[3] if len(color) == 4 else 1.0)
        limits = {"metallic": (metallic, 1.0), "roughness": (roughness, 1.0), "specular": (specular, 1.0), "clearcoat": (clearcoat, 1.0),
                  "clearcoat_roughness": (clearcoat_roughness, 1.0), "sheen": (sheen, 1.0),
                  "sheen_roughness": (sheen_roughness, 1.0), "alpha_cutoff": (alpha_cutoff, 1.0),
                  "normal_scale": (normal_scale, 1e3), "occlusion_strength": (occlusion_strength, 1.0)}
        mode = ("blend" if rgba[3] < 1.0 else "opaque") if alpha_mode is None else _check.choice("alpha_mode", alpha_mode, _ALPHA_MODES)
        textures = {"base_color_texture": base_color_texture, "metallic_roughness_texture": metallic_roughness_texture,
                    "normal_texture": normal_texture, "occlusion_texture": occlusion_texture, "emissive_texture": emissive_texture}
        self._set(base_color=rgba, emissive=_linear("emissive", emissive, False), ior=_check.number("ior", ior, 1.0, 100.0), alpha_mode=mode,
                  unlit=bool(unlit), double_sided=bool(double_sided),
                  **{name: _check.number(name, value, 0.0, high) for name, (value, high) in limits.items()},
                  **{name: None if value is None else _texture(name, value) for name, value in textures.items()})

    @classmethod
    def _of_file(cls, properties: Dict[str, Any]) -> "Material":
        """Returns a material with the properties of a model file, which can be outside of the ranges that the constructor accepts."""
        out = cls.__new__(cls)
        textures = {name: None if properties[name] is None else Texture._of_file(*properties[name]) for name in _TEXTURES}
        out._set(**{**properties, "alpha_mode": properties["alpha_mode"].name, **textures})
        return out

    def __repr__(self) -> str:
        shown = ", ".join(f"{x:g}" for x in self.base_color)
        return f"Material(({shown}), metallic={self.metallic:g}, roughness={self.roughness:g}, alpha_mode={self.alpha_mode!r})"

    def _texture_names(self) -> List[str]:
        """Returns the names of the textures that the material has."""
        return [name for name in _TEXTURES if getattr(self, name) is not None]

    def _materials(self) -> Any:
        """Returns the material with its textures for _core."""
        m = _core.Material()
        m.set_base_color(list(self.base_color))
        m.set_emissive(list(self.emissive))
        for name in _NUMBERS:
            setattr(m, name, getattr(self, name))
        m.alpha_mode = getattr(_core.AlphaMode, self.alpha_mode)
        out = _core.Materials()
        for name in self._texture_names():
            texture = getattr(self, name)
            number = out.add_texture(texture.texels, texture._sampler)
            for property, channel in _TEXTURES[name]:
                m.set_texture(property, number, getattr(_core.Channel, channel))
        out.set_material(m)
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
