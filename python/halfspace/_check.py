# SPDX-License-Identifier: Apache-2.0
"""Checks arguments. Every problem raises an InputError with a one-line message: "NAME: problem; expected what would be valid"."""

from __future__ import annotations

import math
import os
from typing import Any, Iterable, List, Mapping, Optional, Sequence, Tuple

import numpy as np

from ._core import InputError, is_model_format

MAX_SIDE = 16384


def fail(name: str, problem: str, expected: str) -> "InputError":
    """Returns the exception to raise. Its message is one line, even if the problem contains an array."""
    return InputError(" ".join(f"{name}: {problem}; expected {expected}".split("\n")))


def _shape_text(shape: Sequence[Optional[int]]) -> str:
    names = iter(("N", "M"))
    words = [next(names) if n is None else str(n) for n in shape]
    return "(" + ", ".join(words) + ("," if len(words) == 1 else "") + ")"


def _array(name: str, value: Any, shape: Sequence[Optional[int]], what: str) -> np.ndarray:
    try:
        array = np.asarray(value)
    except ValueError:
        raise fail(name, "is not an array", f"{what} of shape {_shape_text(shape)}") from None
    if array.ndim != len(shape) or any(n is not None and n != m for n, m in zip(shape, array.shape)):
        raise fail(name, f"has the shape {array.shape}", _shape_text(shape))
    return array


def numbers(name: str, value: Any, shape: Sequence[Optional[int]], dtype: Any = np.float64) -> np.ndarray:
    """Returns finite numbers as a C-contiguous array of the given dtype. Does not copy the value if it already is one. None in the shape
    allows any length."""
    array = _array(name, value, shape, "numbers")
    if array.dtype.kind not in "fiu":
        raise fail(name, f"has the dtype {array.dtype}", "a floating-point or integer dtype")
    with np.errstate(over="ignore"):
        out = np.ascontiguousarray(array, dtype=dtype)
    if not np.isfinite(out).all():
        where = tuple(int(i) for i in np.argwhere(~np.isfinite(out))[0])
        raise fail(f"{name}[{', '.join(map(str, where))}]", f"is {out[where]}", "a finite number")
    return out


def indices(name: str, value: Any, width: Optional[int], vertices: int) -> np.ndarray:
    """Returns indices of vertices as uint32, of shape (N, width), or (N,) if width is None."""
    array = _array(name, value, (None,) if width is None else (None, width), "integers")
    if array.dtype.kind not in "iu":
        raise fail(name, f"has the dtype {array.dtype}", "an integer dtype")
    if array.size:
        low, high = int(array.min()), int(array.max())
        if low < 0 or high >= vertices:
            raise fail(name, f"has the index {low if low < 0 else high}", f"indices from 0 to {vertices - 1}")
    return np.ascontiguousarray(array, dtype=np.uint32)


def texels(name: str, value: Any) -> np.ndarray:
    """Returns an image as uint8, uint16 or float32 of shape (H, W, 4). Gray is replicated. If there is no alpha channel, alpha is opaque."""
    try:
        array = np.asarray(value)
    except ValueError:  # rows of different lengths
        raise fail(name, "is not an array", "numbers of shape (H, W), (H, W, 3) or (H, W, 4)") from None
    if array.dtype not in (np.uint8, np.uint16, np.float16, np.float32):
        raise fail(name, f"has the dtype {array.dtype}", "uint8, uint16, float16 or float32")
    if array.ndim == 2:
        array = array[:, :, np.newaxis]
    if array.ndim != 3 or array.shape[2] not in (1, 3, 4) or 0 in array.shape or max(array.shape) > MAX_SIDE:
        raise fail(name, f"has the shape {np.shape(value)}", f"(H, W), (H, W, 3) or (H, W, 4) with sides from 1 to {MAX_SIDE}")
    if array.shape[2] == 1:
        array = np.repeat(array, 3, axis=2)
    if array.shape[2] == 3:
        opaque = 1 if array.dtype.kind == "f" else np.iinfo(array.dtype).max
        array = np.dstack([array, np.full(array.shape[:2], opaque, array.dtype)])
    if array.dtype.kind == "f":
        return numbers(name, array, (None, None, 4), np.float32)
    return np.ascontiguousarray(array)


def read_only(array: np.ndarray, given: Any) -> np.ndarray:
    """Returns an array that cannot be written, as a copy if it shares memory with the value that the caller passed."""
    foreign = given is not None and not isinstance(given, (list, tuple)) and np.shares_memory(array, given)
    own = array.copy() if foreign else array
    own.flags.writeable = False
    return own


def plain(name: str, value: Any) -> Any:
    """Returns a value that JSON can represent. Converts NumPy numbers, arrays and paths, also inside of lists and dictionaries."""
    if isinstance(value, (np.ndarray, np.generic)):
        value = value.tolist()
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if isinstance(value, Mapping):
        return {string(f"{name}: a key" if name else "a key", key): plain(f"{name}.{key}" if name else key, item)
                for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(f"{name}[{i}]", item) for i, item in enumerate(value)]
    if isinstance(value, float) and not math.isfinite(value):
        raise fail(name, f"is {value}", "a finite number")
    if value is not None and not isinstance(value, (bool, int, float, str)):
        raise fail(name, f"is of type {type(value).__name__}", "a bool, a number, a string, a list or a dictionary")
    return value


def string(name: str, value: Any) -> str:
    """Returns a string."""
    if not isinstance(value, str):
        raise fail(name, f"is {value!r}", "a string")
    return value


def name_or_index(name: str, value: Any) -> str:
    """Returns the name of a part of a model file, or its index as a string."""
    if isinstance(value, str):
        return value
    if isinstance(value, (bool, np.bool_)) or not hasattr(value, "__index__"):
        raise fail(name, f"is {value!r}", "a name or an index")
    return str(integer(name, value, 0, 2**31 - 1))


def flag(name: str, value: Any) -> bool:
    """Returns a bool."""
    if not isinstance(value, (bool, np.bool_)):
        raise fail(name, f"is {value!r}", "True or False")
    return bool(value)


def mapping(name: str, value: Any, expected: str) -> Mapping[Any, Any]:
    """Returns a dictionary. expected: what it should contain, for example "a dictionary of keys and values"."""
    if not isinstance(value, Mapping):
        raise fail(name, f"is of type {type(value).__name__}", expected)
    return value


def path(name: str, value: Any) -> str:
    """Returns the name of a file."""
    try:
        return os.fsdecode(value)
    except TypeError:
        raise fail(name, f"is {value!r}", "a file name") from None


def model_output(name: str, value: Any) -> str:
    """Returns the name of a model file to write."""
    file = path(name, value)
    if not is_model_format(file):
        raise fail(name, f"is {file!r}", "a file name ending in .glb, .gltf, .obj, .ply or .stl")
    return file


def items(name: str, value: Any, expected: str) -> List[Any]:
    """Returns the elements of a sequence or an iterator as a list."""
    if isinstance(value, (str, bytes)) or not isinstance(value, Iterable):
        raise fail(name, f"is of type {type(value).__name__}", expected)
    return list(value)


def callback(name: str, value: Any) -> Any:
    """Returns a function or None."""
    if value is not None and not callable(value):
        raise fail(name, f"is of type {type(value).__name__}", "a function or None")
    return value


def integer(name: str, value: Any, low: int, high: int) -> int:
    """Returns an integer in [low, high]."""
    try:
        x = value.__index__()
    except (TypeError, AttributeError):
        raise fail(name, f"is {value!r}", f"an integer from {low} to {high}") from None
    if not low <= x <= high:
        raise fail(name, f"is {x}", f"an integer from {low} to {high}")
    return x


def number(name: str, value: Any, low: float = -math.inf, high: float = math.inf) -> float:
    """Returns a finite number in [low, high]."""
    try:
        if isinstance(value, (str, bytes)):
            raise TypeError
        x = float(value)
    except (TypeError, ValueError, OverflowError):
        raise fail(name, f"is {value!r}", "a number") from None
    if not math.isfinite(x) or not low <= x <= high:
        raise fail(name, f"is {value}", "a finite number" if math.isinf(high) and math.isinf(low) else f"a number from {low:g} to {high:g}")
    return x


def pair(name: str, value: Any, expected: str, length: int = 2) -> Tuple[Any, ...]:
    """Returns a sequence of 2 (or another number of) elements as a tuple."""
    if not isinstance(value, (tuple, list, np.ndarray)) or len(value) != length:
        raise fail(name, f"is {value!r}", expected)
    return tuple(value)


def vector(name: str, value: Any, length: int = 3) -> Tuple[float, ...]:
    """Returns a tuple of finite numbers."""
    return tuple(float(x) for x in numbers(name, value, (length,)))


def size(value: Any) -> Tuple[int, int]:
    """Returns (width, height)."""
    try:
        if isinstance(value, Mapping):
            raise TypeError
        width, height = value
        width, height = width.__index__(), height.__index__()
    except (TypeError, ValueError, AttributeError):
        raise fail("size", f"is {value!r}", "(width, height) in pixels, for example (1280, 720)") from None
    if not (1 <= width <= MAX_SIDE and 1 <= height <= MAX_SIDE):
        raise fail("size", f"is {(width, height)}", f"a width and a height from 1 to {MAX_SIDE}")
    return width, height


def choice(name: str, value: Any, choices: Sequence[str]) -> str:
    """Returns one of the words."""
    if not isinstance(value, str) or value not in choices:
        raise fail(name, f"is {value!r}", "one of " + ", ".join(choices))
    return value


def threads(value: Optional[int], cores: int) -> int:
    """Returns a number of threads; None means one per core."""
    if value is None:
        return cores
    try:
        count = value.__index__()
    except (TypeError, AttributeError):
        raise fail("threads", f"is {value!r}", "None or a number from 1 to 1024") from None
    if not 1 <= count <= 1024:
        raise fail("threads", f"is {count}", "None or a number from 1 to 1024")
    return count


def transforms(name: str, value: Any) -> np.ndarray:
    """Returns affine transforms of shape (4, 4) or (N, 4, 4) as an array of shape (N, 4, 4)."""
    try:
        array = np.asarray(value)
    except ValueError:  # rows of different lengths
        raise fail(name, "is not an array", "numbers of shape (4, 4) or (N, 4, 4)") from None
    if array.ndim == 2:
        array = array[np.newaxis]
    out = numbers(name, array, (None, 4, 4))
    wrong = np.nonzero((out[:, 3] != (0.0, 0.0, 0.0, 1.0)).any(axis=1))[0]
    if wrong.size:
        raise fail(f"{name}[{wrong[0]}]", f"has the last row {out[wrong[0], 3].tolist()}", "[0, 0, 0, 1]")
    return out
