# SPDX-License-Identifier: Apache-2.0
"""Objects whose members can be read but not changed."""

from __future__ import annotations

from typing import Any


class Immutable:
    """The base of materials, textures and meshes. A derived class lists its members in __slots__."""

    __slots__ = ()

    def _set(self, **members: Any) -> None:
        for name, value in members.items():
            object.__setattr__(self, name, value)

    def __setattr__(self, name: str, value: Any) -> None:
        kind = type(self).__name__
        raise AttributeError(f"{kind}.{name}: cannot be changed; expected a new {kind}")

    def __delattr__(self, name: str) -> None:
        setattr(self, name, None)

    def __copy__(self) -> Any:
        return self

    def __deepcopy__(self, memo: Any) -> Any:
        return self

    def __reduce__(self) -> Any:
        """For pickling: all members except the private ones, which _restore() creates again."""
        members = [name for name in self.__slots__ if not name.startswith("_")]
        return _restored, (type(self), {name: getattr(self, name) for name in members})

    def _restore(self, members: Any) -> None:
        self._set(**members)


def _restored(kind: Any, members: Any) -> Any:
    out = kind.__new__(kind)
    out._restore(members)
    return out
