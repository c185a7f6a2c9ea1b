# SPDX-License-Identifier: Apache-2.0
"""The shapes of scene files as meshes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional, Tuple, Union

import numpy as np

from . import _check, _core
from ._check import fail
from ._immutable import Immutable
from .material import Material

if TYPE_CHECKING:
    from .mesh import Mesh

_MAX_VERTICES = 2**23


class Shapes(Immutable):
    """Constructors of Mesh for shapes around the origin, y up, with normals and texture coordinates. They have the names, formulas and
    defaults of the shapes in scene files, except that `box` is called `cube` there.

    radius, size, length, tube: in scene units, at most 1e6.
    material: the default is gray.
    """

    __slots__ = ()

    @classmethod
    def sphere(cls, radius: float = 1.0, *, latitudes: int = 64, longitudes: int = 128, material: Optional[Material] = None) -> "Mesh":
        """Returns a sphere of `latitudes` bands from pole to pole (2 to 8192) and `longitudes` sectors (3 to 16384). A map with its left
        edge at 180 degrees West is not mirrored."""
        return _mesh(cls, _core.uv_sphere(_length("radius", radius), *_grid(latitudes, longitudes, 2)), material)

    @classmethod
    def icosphere(cls, radius: float = 1.0, *, level: int = 5, material: Optional[Material] = None) -> "Mesh":
        """Returns a sphere of 20 * 4**level triangles of nearly equal size. level: 0 to 8."""
        return _mesh(cls, _core.icosphere(_length("radius", radius), _check.integer("level", level, 0, 8)), material)

    @classmethod
    def box(cls, size: Union[float, Tuple[float, float, float]] = 2.0, *, segments: int = 1, material: Optional[Material] = None) -> "Mesh":
        """Returns a box. size: length of the edges along x, y and z, or one number for a cube. Each face is divided into segments squared
        rectangles, 1 to 1024 per edge, and shows a whole map."""
        single = isinstance(size, (int, float, np.number))
        sizes = [_length("size", s) for s in ([size] * 3 if single else _check.vector("size", size))]
        positions, *others = _core.cube(1.0, _segments(segments))
        return _mesh(cls, (positions * np.array(sizes), *others), material)

    @classmethod
    def plane(cls, size: float = 2.0, *, segments: int = 1, material: Optional[Material] = None) -> "Mesh":
        """Returns a square in the plane y = 0 that faces up, divided into segments squared squares, 1 to 1024 per edge."""
        return _mesh(cls, _core.plane(_length("size", size), _segments(segments)), material)

    @classmethod
    def cylinder(cls, radius: float = 1.0, length: float = 2.0, *, latitudes: int = 64, longitudes: int = 128,
                 material: Optional[Material] = None) -> "Mesh":
        """Returns a closed cylinder along the y axis. latitudes: rows of the side, and rings of the caps. longitudes: sectors."""
        return _mesh(cls, _core.cylinder(_length("radius", radius), _length("length", length), *_grid(latitudes, longitudes, 2)), material)

    @classmethod
    def cone(cls, radius: float = 1.0, length: float = 2.0, *, latitudes: int = 64, longitudes: int = 128,
             material: Optional[Material] = None) -> "Mesh":
        """Returns a closed cone along the y axis with its apex up. latitudes: rows of the side, and rings of the base."""
        return _mesh(cls, _core.cone(_length("radius", radius), _length("length", length), *_grid(latitudes, longitudes, 2)), material)

    @classmethod
    def torus(cls, radius: float = 1.0, tube: float = 0.25, *, latitudes: int = 64, longitudes: int = 128,
              material: Optional[Material] = None) -> "Mesh":
        """Returns a torus around the y axis. radius: from the axis to the middle of the tube. tube: radius of the tube, less than `radius`.
        latitudes: columns around the tube, at least 3."""
        return _mesh(cls, _core.torus(*_ring(radius, tube), *_grid(latitudes, longitudes, 3)), material)

    @classmethod
    def torus_knot(cls, radius: float = 1.0, tube: float = 0.25, *, latitudes: int = 64, longitudes: int = 128,
                   material: Optional[Material] = None) -> "Mesh":
        """Returns a tube along a trefoil knot around the y axis. The arguments are those of torus(). It does not intersect itself if `tube`
        is less than radius / 4."""
        return _mesh(cls, _core.torus_knot(*_ring(radius, tube), *_grid(latitudes, longitudes, 3)), material)


def _mesh(cls: Any, arrays: Tuple[Any, ...], material: Optional[Material]) -> "Mesh":
    positions, normals, uvs, faces = arrays
    return cls(positions, faces, normals=normals, uvs=uvs, uv_origin="upper_left", material=material)


def _length(name: str, value: Any) -> float:
    return _check.number(name, value, 1e-6, 1e6)


def _ring(radius: Any, tube: Any) -> Tuple[float, float]:
    whole, thin = _length("radius", radius), _length("tube", tube)
    if np.float32(thin) >= np.float32(whole):
        raise fail("tube", f"is {tube}", f"less than the radius, {radius}")
    return whole, thin


def _grid(latitudes: Any, longitudes: Any, fewest: int) -> Tuple[int, int]:
    bands, sectors = _check.integer("latitudes", latitudes, fewest, 8192), _check.integer("longitudes", longitudes, 3, 16384)
    if bands * sectors > _MAX_VERTICES:
        raise fail("latitudes, longitudes", f"are {bands} and {sectors}", f"a product of at most {_MAX_VERTICES}")
    return bands, sectors


def _segments(segments: Any) -> int:
    return _check.integer("segments", segments, 1, 1024)
