# SPDX-License-Identifier: BSD-3-Clause
"""Checks of arguments and warnings that all parts of the package share."""
from __future__ import annotations

import json
import math
import warnings
from collections.abc import Iterable, Mapping

import numpy as np

from ._core import InputError


class SeaglintWarning(UserWarning):
    """What the program prints as a warning: a defect of a mesh, an echo that depends on its triangles."""


def warn(texts: Iterable[str]) -> None:
    """Each text as a warning at the line that called the function of the package."""
    for text in texts:
        warnings.warn(text, SeaglintWarning, stacklevel=3)


def axis(name: str, values) -> list[float]:
    """A number or a sequence of numbers as a list of float."""
    array = np.atleast_1d(np.asarray(values))
    if array.ndim != 1 or array.size == 0 or array.dtype.kind not in "iuf":
        raise InputError(f"{name}: must be a number or a sequence of numbers, not {array.dtype} of shape {array.shape}")
    if not np.all(np.isfinite(array)):
        raise InputError(f"{name}: value {array[~np.isfinite(array)][0]}: must be finite")
    return array.astype(float).tolist()


def number(name: str, value, lower: float = -math.inf, upper: float = math.inf) -> float:
    """One number within bounds."""
    values = axis(name, value)
    if np.ndim(value) != 0:
        raise InputError(f"{name}: must be one number, not {len(values)}")
    if not lower <= values[0] <= upper:
        raise InputError(f"{name}: value {value}: must be within {lower:g} and {upper:g}")
    return values[0]


def count(name: str, value) -> int:
    """A whole number of at least 0, below 2^63."""
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)):
        raise InputError(f"{name}: must be a whole number, not {value!r}")
    if not 0 <= value < 2**63:
        raise InputError(f"{name}: value {value}: must be at least 0")
    return int(value)


def threads_of(value) -> int:
    """A number of threads as the program takes it."""
    if count("threads", value) > 1024:
        raise InputError(f"threads: value {value}: must be within 0 (all processors) and 1024")
    return int(value)


def overrides(values: Mapping[str, object], prefix: str = "") -> list[tuple[str, str]]:
    """Values by their key paths as the program takes them from --set."""
    return [(prefix + str(key), value if isinstance(value, str) else json.dumps(value)) for key, value in values.items()]
