# SPDX-License-Identifier: Apache-2.0
"""Model files that scenes share."""

from __future__ import annotations

import os
from typing import List, Optional, Union

import numpy as np

from . import _check, _core
from ._check import fail
from ._immutable import Immutable
from .material import Material
from .mesh import Mesh, new_file


class Model(Immutable):
    """The contents of a model file, which is read once and can be added to any number of scenes: scene.add(model) draws all of its meshes
    with their materials, in the pose of the file. Keys of the object select another pose, for example
    scene[name + ".model_animation"] = "walk" and scene[name + ".model_time"] = 0.5.

    A model can be pickled; the other process reads its file again.

    path: the file.   bounds: the lowest and highest coordinates, y up, float64 of shape (2, 3); None without meshes.
    animations, variants, scenes: names in the file, which may be empty.
    """

    __slots__ = ("path", "bounds", "animations", "variants", "scenes", "_model", "_file", "_meshes", "_options")
    path: str
    bounds: Optional[np.ndarray]
    animations: List[str]
    variants: List[str]
    scenes: List[str]

    def __init__(self) -> None:
        raise TypeError("Model: cannot be created from nothing; expected Model.load(path)")

    @classmethod
    def load(cls, path: Union[str, "os.PathLike[str]"], *, allow_outside: bool = False, up_axis: Optional[str] = None) -> "Model":
        """Reads a model file (.obj, .gltf, .glb, .ply, .stl).

        allow_outside: whether the file may refer to files outside its folder.
        up_axis: "y" or "z". The default is that of the format: z for STL, otherwise y.

        Raises InputError if the file cannot be read. Problems that do not prevent that are warnings when it is drawn.
        """
        file = _check.path("path", path)
        axis = "" if up_axis is None else _check.choice("up_axis", up_axis, ("y", "z"))
        model = _core.load_model(file, _check.flag("allow_outside", allow_outside), axis)
        out = cls.__new__(cls)
        out._set(_options={"allow_outside": bool(allow_outside), "up_axis": up_axis}, path=file, bounds=_core.model_bounds(model), **_core.model_names(model), _model=model, _meshes=None,
                 _file=new_file(os.path.basename(file)))
        return out

    def __reduce__(self) -> Any:
        return _load, (self.path, self._options)

    def __repr__(self) -> str:
        return f"Model({self.path!r})"

    @property
    def meshes(self) -> List[Mesh]:
        """The meshes that are drawn, each with one material, in the pose of the file, y up. Reads the textures when it is first used."""
        if self._meshes is None:
            materials = [Material._of_file(properties) for properties in _core.model_materials(self._model, self.path)]
            name = os.path.basename(self.path)
            self._set(_meshes=[Mesh._of_file(asset, name, arrays, materials[number], (_mesh_of, (self.path, self._options, i), {}))
                               for i, (asset, arrays, number) in enumerate(_core.model_parts(self._model))])
        return list(self._meshes)

    def _single_mesh(self, material: Optional[Material]) -> Mesh:
        """Returns all meshes as one. material: replaces those of the meshes."""
        meshes = self.meshes
        if not meshes:
            raise fail(self.path, "has no meshes", "at least one")
        if len(meshes) == 1 and material is None:
            return meshes[0]
        kinds = {mesh.topology for mesh in meshes}
        if len(kinds) > 1:
            raise fail(self.path, f"has {' and '.join(sorted(kinds))}", "one of them; Model.load() keeps all meshes")
        materials = {id(mesh.material) for mesh in meshes}
        if material is None and len(materials) > 1:
            raise fail(self.path, f"has {len(materials)} materials", "one; Model.load() keeps all of them, and material= replaces them")
        starts = np.cumsum([0] + [len(mesh.vertices) for mesh in meshes[:-1]])
        return Mesh(np.concatenate([mesh.vertices for mesh in meshes]),
                    np.concatenate([mesh.faces + np.uint32(start) for mesh, start in zip(meshes, starts)]),
                    normals=_joined(meshes, "normals"), uvs=_joined(meshes, "uvs", 0.0), uv_origin="upper_left",
                    colors=_joined(meshes, "colors", 1.0), material=meshes[0].material if material is None else material,
                    topology=meshes[0].topology)


def _load(path: str, options: Any) -> Model:
    return Model.load(path, **options)


def _mesh_of(path: str, options: Any, number: int) -> Mesh:
    return _load(path, options).meshes[number]


def _joined(meshes: List[Mesh], name: str, missing: Optional[float] = None) -> Optional[np.ndarray]:
    """Returns an array of all meshes. missing: the value for meshes that lack it; None: if one lacks it, none has it."""
    arrays = [getattr(mesh, name) for mesh in meshes]
    known = [array for array in arrays if array is not None]
    if not known or (missing is None and len(known) < len(arrays)):
        return None
    width = known[0].shape[1]
    return np.concatenate([np.full((len(mesh.vertices), width), missing, np.float32) if array is None else array
                           for mesh, array in zip(meshes, arrays)])
