# SPDX-License-Identifier: Apache-2.0
"""Meshes from arrays."""

from __future__ import annotations

import itertools
import os
from typing import Any, Dict, Optional, Tuple, Union

import numpy as np

from . import _check, _core
from ._check import fail
from ._options import warn
from ._shapes import Shapes
from .material import Material, Texture, srgb

_numbers = itertools.count(1)
_WIDTHS = {"triangles": 3, "lines": 2, "points": None}
_MAX_VERTICES = 2**31
_MIN_COORDINATE, _MAX_COORDINATE = 1e-20, 1e18  # outside this range, float32 overflows, or normals become inexact
_UNSET_DIFFUSE = (102, 102, 102, 255)  # of a trimesh.visual.material.SimpleMaterial that was made without one


def new_file(name: str) -> str:
    """Returns a file name for a model in memory, which no other model has. Warnings about the model begin with it."""
    return f"/memory/{next(_numbers)}/{name}"


class _UnitNormals(np.ndarray):
    """Normals of a mesh that was pickled: they are used as they are, because another division by their length would change some bits."""


class Mesh(Shapes):
    """Vertices of one material. All arrays are copied; a Mesh is immutable and can be added to any number of scenes.

    Mesh.load() reads a file, and sphere(), box(), plane(), cylinder(), cone(), torus() and others create shapes. All arguments except
    `crease` can be read as members of the same name: read-only arrays, or None for those that were not given.

    vertices: (N, 3), in object space. The largest magnitude of a coordinate is 1e-20 to 1e18, unless all are 0.
    faces: (M, 3) indices of triangles, counter-clockwise seen from the front; (M, 2) for lines, (M,) for points. The default is
        0, 1, 2, ...
    normals: (N, 3), any length except 0. By default, normals are computed, and vertices are split at edges sharper than `crease`.
    crease: angle in degrees. 0 gives flat shading, 180 smooth shading.
    uvs: (N, 2). Without them, textures of the material have no effect, and there is a RenderWarning.
    uv_origin: "lower_left" (v increases upwards, as in OpenGL, OBJ and trimesh) or "upper_left" (as in glTF).
    colors: (N, 3) or (N, 4); uint8 sRGB values, or linear floats in [0, 1]. They multiply the base color.
    material: the default is gray, or white if there are colors.
    topology: "triangles", "lines" or "points". Lines and points are not lit.
    """

    __slots__ = ("vertices", "faces", "normals", "uvs", "uv_origin", "colors", "material", "topology", "bounds", "_model", "_file", "_made_by")
    vertices: np.ndarray  #: float64 (N, 3)
    faces: np.ndarray  #: uint32 (M, 3), (M, 2) for lines, (M,) for points
    normals: Optional[np.ndarray]  #: float32 (N, 3), unit length; None if they are computed
    uvs: Optional[np.ndarray]  #: float32 (N, 2)
    uv_origin: str
    colors: Optional[np.ndarray]  #: float32 (N, 4), linear
    material: Material
    topology: str
    bounds: np.ndarray  #: float64 (2, 3): the lowest and highest coordinates of the vertices that faces use, in object space

    def __init__(self, vertices: Any, faces: Any = None, *, normals: Any = None, uvs: Any = None, colors: Any = None,
                 material: Optional[Material] = None, topology: str = "triangles", crease: float = 30.0,
                 uv_origin: str = "lower_left") -> None:
        positions = _check.numbers("vertices", vertices, (None, 3))
        count = len(positions)
        _check.choice("topology", topology, tuple(_WIDTHS))
        if not 1 <= count < _MAX_VERTICES:
            raise fail("vertices", f"has {count} rows", f"1 to {_MAX_VERTICES - 1}")
        if faces is None and topology != "points" and count % _WIDTHS[topology] != 0:
            raise fail("vertices", f"has {count} rows", f"a multiple of {_WIDTHS[topology]} if there are no faces")
        largest = float(np.abs(positions).max())
        if largest > _MAX_COORDINATE or 0.0 < largest < _MIN_COORDINATE:
            raise fail("vertices", f"has coordinates of at most {largest:g} in magnitude",
                       f"all 0, or a largest magnitude from {_MIN_COORDINATE:g} to {_MAX_COORDINATE:g}")
        index = None if faces is None else _check.indices("faces", faces, _WIDTHS[topology], count)
        if index is not None and index.size == 0:
            raise fail("faces", "is empty", "at least one row")
        unit = normals if isinstance(normals, _UnitNormals) else None
        if normals is not None and unit is None:
            unit = _unit("normals", _rows("normals", normals, count, 3))
        uv = None if uvs is None else _rows("uvs", uvs, count, 2)
        _check.choice("uv_origin", uv_origin, ("lower_left", "upper_left"))
        rgba = None if colors is None else _colors("colors", colors, count)
        if material is None:
            material = Material((0.8, 0.8, 0.8) if rgba is None else (1.0, 1.0, 1.0),
                                alpha_mode="blend" if rgba is not None and rgba[:, 3].min() < 1.0 else "opaque")
        if not isinstance(material, Material):
            raise fail("material", f"is of type {type(material).__name__}", "a halfspace.Material")
        names = material._texture_names()
        if uvs is None and names:  # not an error, because meshes with and without uvs can share a material
            warn([f"uvs: are missing, but the material has {', '.join(names)}; expected uvs, without which textures have no effect"])
        model = _core.Model(*_used(positions, unit, uv, rgba, None if index is None else index.ravel()), getattr(_core.Topology, topology),
                            uv_origin == "lower_left", material._materials(), _check.number("crease", crease, 0.0, 180.0) or -1.0)
        if index is None:
            index = np.arange(count, dtype=np.uint32)
            index = index if topology == "points" else index.reshape(-1, _WIDTHS[topology])
        self._set_arrays(vertices=_check.read_only(positions, vertices), faces=_check.read_only(index, faces),
                         normals=None if unit is None else _check.read_only(unit.view(np.ndarray), normals),
                         uvs=None if uv is None else _check.read_only(uv, uvs), uv_origin=uv_origin,
                         colors=None if rgba is None else _check.read_only(rgba, colors), material=material, topology=topology)
        given = {"normals": None if self.normals is None else self.normals.view(_UnitNormals), "uvs": self.uvs, "colors": self.colors, "material": material, "topology": topology,
                 "crease": crease, "uv_origin": uv_origin}
        self._set(_model=model, _file=new_file("mesh"), _made_by=(Mesh, (self.vertices, self.faces), given))

    def _set_arrays(self, **members: Any) -> None:
        self._set(**members)
        seen = self.vertices[_mask(self.faces, len(self.vertices))]
        self._set(bounds=_check.read_only(np.array([seen.min(axis=0), seen.max(axis=0)]), None))

    def __reduce__(self) -> Any:
        return _make, self._made_by

    def __repr__(self) -> str:
        low, high = self.bounds.tolist()
        return f"Mesh({len(self.faces)} faces, from {low} to {high})"

    @classmethod
    def load(cls, path: Union[str, "os.PathLike[str]"], *, material: Optional[Material] = None, allow_outside: bool = False,
             up_axis: Optional[str] = None) -> "Mesh":
        """Reads a model file (.obj, .gltf, .glb, .ply, .stl) as one mesh, in the pose of the file, y up. The arguments are those of
        Model.load().

        material: replaces the materials of the file. Without it, a file whose meshes differ in their materials raises InputError;
            Model.load() keeps all of them.
        """
        from .model import Model  # which creates meshes

        return Model.load(path, allow_outside=allow_outside, up_axis=up_axis)._single_mesh(material)

    @classmethod
    def _of_file(cls, asset: Any, name: str, arrays: Dict[str, Any], material: Material, made_by: Any) -> "Mesh":
        """Returns a mesh that is drawn as its file is drawn, also with properties of materials that Material lacks. made_by: a function and
        its arguments that return an equal mesh."""
        topology = arrays["topology"].name
        width = _WIDTHS[topology]
        mesh = cls.__new__(cls)
        faces = arrays["faces"] if width is None else arrays["faces"].reshape(-1, width)
        known = {key: arrays[key] for key in ("vertices", "normals", "uvs", "colors")}
        for array in (faces, *known.values()):
            if array is not None:
                array.flags.writeable = False
        mesh._set_arrays(**known, faces=faces, uv_origin="upper_left", material=material, topology=topology)
        mesh._set(_model=asset, _file=new_file(name), _made_by=made_by)
        return mesh

    @classmethod
    def from_trimesh(cls, mesh: Any, *, crease: float = 30.0, material: Optional[Material] = None) -> "Mesh":
        """Converts an object with the attributes of trimesh.Trimesh: vertices, faces and, optionally, visual.

        Used from `visual`: vertex_colors or face_colors (depending on its `kind`), or uv with material. Of a PBRMaterial, these attributes
        are used: baseColorFactor, baseColorTexture, metallicFactor, roughnessFactor, metallicRoughnessTexture, normalTexture,
        occlusionTexture, emissiveFactor, emissiveTexture, alphaMode, alphaCutoff and doubleSided. None means the default of glTF, except
        that surfaces without metallicFactor, roughnessFactor and metallicRoughnessTexture are not metallic, and that surfaces are
        double-sided unless doubleSided is False. Of simple materials, image and diffuse are used. trimesh itself is not needed.
        """
        for name in ("vertices", "faces"):
            if not hasattr(mesh, name):
                raise fail("mesh", f"an object of type {type(mesh).__name__} has no {name}", "a halfspace.Mesh or an object like trimesh.Trimesh")
        vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces)
        visual = getattr(mesh, "visual", None)
        kind = getattr(visual, "kind", None)
        colors, uvs = None, None
        if kind == "vertex":
            colors = np.asarray(visual.vertex_colors)
        elif kind == "face":
            index = _check.indices("faces", faces, 3, len(vertices))
            vertices, faces = vertices[index].reshape(-1, 3), np.arange(3 * len(index)).reshape(-1, 3)
            colors = np.repeat(np.asarray(visual.face_colors), 3, axis=0)
        elif kind == "texture":
            uvs = None if getattr(visual, "uv", None) is None else np.asarray(visual.uv)
            material = material if material is not None else _material_of(getattr(visual, "material", None), uvs is not None)
        return cls(vertices, faces, uvs=uvs, colors=colors, material=material, crease=crease)


def _make(function: Any, arguments: Tuple[Any, ...], keywords: Dict[str, Any]) -> Any:
    return function(*arguments, **keywords)


def _mask(index: np.ndarray, count: int) -> Any:
    """Returns a mask of the vertices that the index uses, or a slice if it uses all."""
    used = np.zeros(count, bool)
    used[index.ravel()] = True
    return slice(None) if used.all() else used


def _used(positions: np.ndarray, normals: Any, uvs: Any, colors: Any, index: Optional[np.ndarray]) -> Tuple[Any, ...]:
    """Returns the arguments of _core.Model without the vertices that no face uses, so that they do not affect bounds and precision."""
    used = slice(None) if index is None else _mask(index, len(positions))
    if isinstance(used, np.ndarray):
        index = (np.cumsum(used) - 1)[index].astype(np.uint32)
    arrays = (None if array is None else array[used] for array in (positions, normals, uvs, colors))
    return (*arrays, None, index)


def _rows(name: str, value: Any, count: int, width: int) -> np.ndarray:
    rows = _check.numbers(name, value, (None, width), np.float32)
    if len(rows) != count:
        raise fail(name, f"has {len(rows)} rows", f"one per vertex, {count}")
    return rows


def _unit(name: str, vectors: np.ndarray) -> np.ndarray:
    length = np.sqrt((vectors.astype(np.float64) ** 2).sum(axis=1, keepdims=True))
    zero = np.nonzero(length[:, 0] == 0.0)[0]
    if zero.size:
        raise fail(f"{name}[{zero[0]}]", "is zero", "a direction")
    return np.ascontiguousarray(vectors / length, dtype=np.float32)


def _colors(name: str, value: Any, count: int) -> np.ndarray:
    array = np.asarray(value)
    if array.ndim != 2 or array.shape[1] not in (3, 4):
        raise fail(name, f"has the shape {array.shape}", "(N, 3) or (N, 4)")
    linear = srgb(array) if array.dtype == np.uint8 else array
    rows = _rows(name, linear, count, array.shape[1])
    if rows.min() < 0.0 or rows.max() > 1.0:
        raise fail(name, f"has values from {rows.min():g} to {rows.max():g}", "uint8, or numbers from 0 to 1")
    return np.ascontiguousarray(np.column_stack([rows, np.ones(count, np.float32)]) if rows.shape[1] == 3 else rows)


def _picture_of(image: Any) -> Optional[Texture]:
    """Converts a PIL image or an array."""
    if image is None:
        return None
    if hasattr(image, "convert"):
        image = image.convert("RGBA")
    return Texture(np.asarray(image))


def _base_color_of(m: Any) -> Tuple[Any, Any]:
    """Returns the texture and the linear factor of a trimesh material. Either is None if the material lacks it."""
    if hasattr(m, "baseColorFactor"):
        factor = None if m.baseColorFactor is None else np.asarray(m.baseColorFactor).ravel()
        # trimesh stores glTF's base color factor, which is linear, as uint8.
        return m.baseColorTexture, factor / 255.0 if factor is not None and factor.dtype == np.uint8 else factor
    image, diffuse = getattr(m, "image", None), getattr(m, "diffuse", None)
    if diffuse is None or (image is not None and np.array_equal(diffuse, _UNSET_DIFFUSE)):
        return image, None
    color = np.asarray(diffuse).ravel()
    return image, srgb(color) if color.dtype == np.uint8 else color


def _material_of(m: Any, mapped: bool) -> Optional[Material]:
    """Returns the material that corresponds to a trimesh material. mapped: the mesh has texture coordinates."""
    if m is None:
        return None

    def given(name: str, default: Any) -> Any:
        value = getattr(m, name, None)
        return default if value is None else value

    def texture(image: Any) -> Optional[Texture]:
        return _picture_of(image) if mapped else None

    image, factor = _base_color_of(m)
    white = (1.0, 1.0, 1.0) if image is not None else (0.8, 0.8, 0.8)
    shine = texture(given("metallicRoughnessTexture", None))
    mode = given("alphaMode", None)
    return Material(white if factor is None else factor, metallic=given("metallicFactor", 0.0 if shine is None else 1.0),
                    roughness=given("roughnessFactor", 0.6 if shine is None else 1.0), emissive=given("emissiveFactor", (0.0, 0.0, 0.0)),
                    alpha_mode=mode.lower() if isinstance(mode, str) else mode, alpha_cutoff=given("alphaCutoff", 0.5),
                    double_sided=given("doubleSided", True), base_color_texture=texture(image), metallic_roughness_texture=shine,
                    normal_texture=texture(given("normalTexture", None)), occlusion_texture=texture(given("occlusionTexture", None)),
                    emissive_texture=texture(given("emissiveTexture", None)))
