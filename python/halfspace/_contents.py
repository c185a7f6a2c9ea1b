# SPDX-License-Identifier: Apache-2.0
"""The keys, lights and cameras of a scene."""

from __future__ import annotations

import json
from typing import Any, Iterator, List

from . import _check, _core
from ._check import fail


class Contents:
    """The part of Scene that reads and changes the description of the scene."""

    _core: Any

    def _flush(self) -> None:
        raise NotImplementedError

    def __getitem__(self, key: str) -> Any:
        """Returns the value of a key as it is represented in JSON: a bool, number, string or list. For a section, such as "ball" or "post",
        returns a dictionary of its keys."""
        self._flush()
        return json.loads(self._core.value(_check.string("key", key)))

    def __contains__(self, key: object) -> bool:
        """Returns whether scene[key] exists: a key, or a section, such as the name of an object or a light."""
        if not isinstance(key, str):
            return False
        try:
            self[key]
        except _core.InputError:
            return False
        return True

    def keys(self) -> List[str]:
        """Returns the full names of all keys, for example "objects.ball.radius", in the order of a scene file."""
        self._flush()
        return self._core.keys()

    def __iter__(self) -> Iterator[str]:
        """Iterates over keys()."""
        return iter(self.keys())

    def __len__(self) -> int:
        """The number of keys."""
        return len(self.keys())

    @property
    def objects(self) -> List[str]:
        """The names of all objects of the scene, in the order of their ids."""
        self._flush()
        return self._core.objects()

    @property
    def lights(self) -> List[str]:
        """The names of all lights of the scene. scene[name] is a dictionary of the keys of a light."""
        return self._core.lights()

    @property
    def cameras(self) -> List[str]:
        """The names of all cameras of the scene. Scene.view(name) returns a camera."""
        return self._core.cameras()

    def remove_light(self, name: str) -> None:
        """Removes a light: one that was added with add_light() or one of the scene file."""
        if _check.string("name", name) not in self.lights:
            raise fail("name", f"no light '{name}' in this scene", "one of " + ", ".join(self.lights) if self.lights else "add_light() first")
        self._flush()
        self._core.merge(json.dumps({"lights": {name: None}}))
