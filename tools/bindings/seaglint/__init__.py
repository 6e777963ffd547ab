# SPDX-License-Identifier: BSD-3-Clause
"""Ships and corner-reflector decoys at sea as a frequency-agile radar sees them.

Angles in degrees, everything else in SI units; frames, signs and e^{+jwt} as in CONVENTIONS.md. Wrong input raises
InputError (a ValueError) with the place of the fault, failed work WorkError; what the program would warn about is a
SeaglintWarning. Long work releases Python's lock and ends at Ctrl-C.
"""
from __future__ import annotations

import importlib.machinery
import os
import pathlib
import sys


def _no_core():
    """Why the compiled module is not there, and what builds it; nothing where it is there and fails."""
    here = pathlib.Path(__file__).resolve().parent
    if any((here / ("_core" + suffix)).is_file() for suffix in importlib.machinery.EXTENSION_SUFFIXES):
        return None
    build = next((folder for folder in here.parents if (folder / "CMakeCache.txt").is_file()), None)
    command = f"cmake --build {build} --target seaglint_python" if build else "cmake --preset release && cmake --build --preset release --target seaglint_python"
    others = ", ".join(sorted(file.name for file in here.glob("_core.*.so")))
    what = f"is not built for Python {sys.version_info.major}.{sys.version_info.minor} ({sys.executable}), but as {others}: run the Python that it is for, /usr/bin/python3" if others else f"is not built: run `{command}`"
    return f"the compiled module of seaglint {what}"


try:
    from . import _core
except ImportError:
    _why = _no_core()
    if _why is None:
        raise
    raise ImportError(_why, name="seaglint._core") from None
from ._common import SeaglintWarning
from ._core import InputError, WorkError
from ._dataset import Dataset
from ._handover import write_pyaedt
from ._mesh import Mesh
from ._rcs import compare, rcs
from ._sample import Sample, Simulator, sample
from ._scenario import Scenario
from ._series import MotionSeries, SeaSeries, motion, sea
from ._train import evaluate, train

__all__ = ["Dataset", "InputError", "Mesh", "MotionSeries", "Sample", "Scenario", "SeaSeries", "SeaglintWarning", "Simulator", "WorkError", "compare", "data_folder", "evaluate", "motion", "rcs", "sample", "sea",
           "train", "write_pyaedt"]
__version__ = _core.__version__
InputError.__doc__ = "Wrong input: file:line:col, key, value and bound, where they exist."
WorkError.__doc__ = "The work failed on valid input: a full disk, no permission, no convergence."


def _find_data():
    """Assets, materials and scenarios: $SEAGLINT_DATA, PREFIX/share/seaglint, or the source tree of a build."""
    if os.environ.get("SEAGLINT_DATA"):
        return
    for folder in pathlib.Path(__file__).resolve().parents:
        for candidate in (folder / "share/seaglint", folder):
            if (candidate / "assets/materials").is_dir():
                _core.set_data_folder(str(candidate))
                return


_find_data()


def data_folder() -> str:
    """Folder of the assets, materials and scenarios of the program."""
    return _core.data_folder()
