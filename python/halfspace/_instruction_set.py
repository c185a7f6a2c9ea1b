# SPDX-License-Identifier: Apache-2.0
"""Chooses the extension for this processor. Packages have one extension per instruction set, in the folders x86-64-v3 and x86-64-v4. A
build for one machine has only one extension, in the folder of the package."""

import os
import warnings

_V3 = {"avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "abm", "movbe"}
_V4 = _V3 | {"avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl"}
_SETS = (("x86-64-v4", _V4), ("x86-64-v3", _V3))


def processor_flags(path="/proc/cpuinfo"):
    """Returns the names that Linux uses for the features of the processor, or None if the features are unknown."""
    try:
        with open(path) as file:
            for line in file:
                if line.startswith("flags"):
                    return set(line.split(":", 1)[1].split())
    except OSError:
        pass
    return None


def extension_folder(package, flags):
    """Returns the folder of the extension, or None if the package has only one extension. Raises ImportError if the processor can run none
    of them. If the features are unknown, warns and returns the extension with the smallest instruction set.

    flags: the result of processor_flags().
    """
    present = [(name, needed) for name, needed in _SETS if os.path.isdir(os.path.join(package, name))]
    if present and flags is None:
        name, flags = present[-1]
        warnings.warn(f"halfspace: the features of this processor are unknown, because /proc/cpuinfo cannot be read; the extension for {name} "
                      "is used, which ends with an illegal instruction on older processors", RuntimeWarning, stacklevel=2)
    for name, needed in present:
        if needed <= flags:
            return os.path.join(package, name)
    if present:
        name, needed = present[-1]
        raise ImportError(f"halfspace: this processor lacks {', '.join(sorted(needed - flags))}; expected a processor with {name}")
    return None
