# SPDX-License-Identifier: BSD-3-Clause
"""Ships and corner-reflector decoys at sea as a frequency-agile radar sees them.

Angles in degrees, everything else in SI units; frames, signs and e^{+jwt} as in CONVENTIONS.md. Wrong input raises
InputError (a ValueError) with the place of the fault, failed work WorkError; what the program would warn about is a
SeaglintWarning. Long work releases Python's lock and ends at Ctrl-C.
"""
from __future__ import annotations

import json
import os
import pathlib
import warnings
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._core import InputError, WorkError
from ._dataset import Dataset

__all__ = ["Dataset", "InputError", "Mesh", "Sample", "Scenario", "SeaglintWarning", "Simulator", "WorkError", "compare", "data_folder", "rcs", "sample"]
__version__ = _core.__version__
InputError.__doc__ = "Wrong input: file:line:col, key, value and bound, where they exist."
WorkError.__doc__ = "The work failed on valid input: a full disk, no permission, no convergence."


class SeaglintWarning(UserWarning):
    """What the program prints as a warning: a defect of a mesh, an echo that depends on its triangles."""


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


def _axis(name, values):
    """A number or a sequence of numbers as a list of float."""
    array = np.atleast_1d(np.asarray(values))
    if array.ndim != 1 or array.size == 0 or array.dtype.kind not in "iuf":
        raise InputError(f"{name}: must be a number or a sequence of numbers, not {array.dtype} of shape {array.shape}")
    if not np.all(np.isfinite(array)):
        raise InputError(f"{name}: value {array[~np.isfinite(array)][0]}: must be finite")
    return array.astype(float).tolist()


class Scenario:
    """A scenario: a YAML file, one of the program by its name (`quick.yaml`), or a dictionary of its keys.

    set: values that replace those of the scenario, {"radar.pulses": 64}. len() is the number of its samples.
    """

    def __init__(self, source: str | os.PathLike | dict, set: Mapping[str, object] | None = None):
        pairs = [(str(key), value if isinstance(value, str) else json.dumps(value)) for key, value in (set or {}).items()]
        if isinstance(source, dict):
            self._core = _core.Scenario.parse(json.dumps(source), "scenario", pairs)
        else:
            self._core = _core.Scenario.read(os.fspath(source), pairs)
        self._pipeline = None

    name = property(lambda self: self._core.name, doc="Its name, by default that of the file.")
    seed = property(lambda self: self._core.seed)
    targets = property(lambda self: self._core.targets, doc="Names of the targets.")

    def yaml(self) -> str:
        """The scenario with all defaults, as YAML."""
        return self._core.yaml()

    def __len__(self):
        return len(self._core)

    def __repr__(self):
        return f"<seaglint.Scenario {self.name}: {len(self)} samples>"


class Mesh:
    """A triangle mesh in metres, body frame: x forward, y to port, z up.

    Mesh(file, unit="m") reads .glb .gltf .obj .stl .ply .nas .unv .msh; Mesh.from_arrays(vertices, triangles) takes
    arrays [vertex][3] and [triangle][3], counter-clockwise seen from outside.
    """

    def __init__(self, file: str | os.PathLike, unit: str = "m"):
        self._core = file if isinstance(file, _core.Mesh) else _core.Mesh.read(os.fspath(file), unit)

    @classmethod
    def from_arrays(cls, vertices: ArrayLike, triangles: ArrayLike) -> Mesh:
        vertices, triangles = np.asarray(vertices), np.asarray(triangles)
        for name, array, kinds in (("vertices", vertices, "iuf"), ("triangles", triangles, "iu")):
            if array.ndim != 2 or array.shape[1] != 3 or array.dtype.kind not in kinds:
                raise InputError(f"{name}: must be an array of shape (n, 3), not {array.dtype} of shape {array.shape}")
        if not np.all(np.isfinite(vertices)):
            raise InputError("vertices: must be finite")
        if triangles.size and (triangles.min() < 0 or triangles.max() >= len(vertices)):
            raise InputError(f"triangles: index {triangles.max()}: must be within 0 and {len(vertices) - 1}")
        return cls(_core.Mesh.of_arrays(vertices, triangles))

    vertices = property(lambda self: _readonly(self._core.vertices), doc="[vertex][3], m; a view.")
    triangles = property(lambda self: _readonly(self._core.triangles), doc="[triangle][3], indices of vertices; a view.")
    parts = property(lambda self: _readonly(self._core.parts), doc="[triangle], index into part_names; a view.")
    part_names = property(lambda self: self._core.part_names)

    def write(self, file: str | os.PathLike) -> None:
        """Writes .glb, .gltf, .obj, .stl or .ply."""
        self._core.write(os.fspath(file))

    def __repr__(self):
        return f"<seaglint.Mesh: {len(self.triangles)} triangles, {len(self.part_names)} parts>"


def _readonly(array):
    array.flags.writeable = False
    return array


def rcs(target: Mesh | str | os.PathLike, frequencies_hz: ArrayLike, azimuth_deg: ArrayLike = 0.0, elevation_deg: ArrayLike = 0.0, *, unit: str = "m",
        materials: str | Mapping[str, str] | None = None, crease_deg: float | None = None, edges: bool = True, max_bounces: int = 40, min_patch_m: float = 0.0,
        sheet_thickness_mm: float = 0.0, range_m: float = 0.0, transmitter_deg: tuple[float, float] | None = None, cavities: Sequence[str] = (), only: Sequence[str] = (),
        without: Sequence[str] = (), threads: int = 0) -> NDArray[np.complex128]:
    """Scattering matrices of a mesh at rest, complex [frequency, elevation, azimuth, received, transmitted], in metres.

    Polarisations in the order h, v; sigma = 4 pi |S|^2. e^{+jwt}, phase origin at the mesh's origin, basis of
    CONVENTIONS.md.

    target: Mesh or file (then `unit` is that of the file). frequencies_hz, azimuth_deg, elevation_deg: numbers or
    sequences; azimuth 0 = radar ahead of the bow, counter-clockwise from above.
    materials: "aluminium", a file, or {part: material}, "" for all other parts. crease_deg: None as the mesh says,
    0 = all facets flat. transmitter_deg: (azimuth, elevation) of a fixed transmitter; the angles are then those of the
    receiver. only, without: contributions, "part=hull", "bounces=2", "mechanism=edge". The other settings are the
    options of `seaglint rcs`.
    """
    request = _core.RcsRequest()
    request.frequency_hz, request.azimuth_deg, request.elevation_deg = _axis("frequencies_hz", frequencies_hz), _axis("azimuth_deg", azimuth_deg), _axis("elevation_deg", elevation_deg)
    request.unit, request.edges, request.crease_deg = unit, bool(edges), crease_deg
    request.max_bounces, request.min_patch_m, request.sheet_thickness_mm, request.range_m = max_bounces, min_patch_m, sheet_thickness_mm, range_m
    chosen = {"": materials} if isinstance(materials, str) else dict(materials or {})
    request.set_materials(sorted((str(part), str(material)) for part, material in chosen.items()))
    if transmitter_deg is not None:
        azimuth, elevation = transmitter_deg
        request.set_transmitter(azimuth, elevation)
    request.set_cavities(list(cavities))
    request.select(list(only), list(without))
    values, said = _core.rcs(request, target._core if isinstance(target, Mesh) else os.fspath(target), threads)
    for text in said:
        warnings.warn(text, SeaglintWarning, stacklevel=2)
    return values


class Sample:
    """One sample of a scenario.

    map: complex [velocity, range], m, of target, clutter and noise; range_m, velocity_mps: its axes (positive =
    farther, receding). echo: complex [pulse, frequency], carrier_hz, pulse_time_s, hop_code: [pulse]. centres:
    [centre, 3] range (m), velocity (m/s), amplitude (m), strongest first. columns: label, target, sea state, aspect,
    features, as the data set stores them.
    """

    map: NDArray[np.complex128]
    range_m: NDArray[np.float64]
    velocity_mps: NDArray[np.float64]
    echo: NDArray[np.complex128]
    carrier_hz: NDArray[np.float64]
    pulse_time_s: NDArray[np.float64]
    hop_code: NDArray[np.int32]
    centres: NDArray[np.float64]
    columns: dict

    def __init__(self, parts):
        self.__dict__.update(parts)

    def __repr__(self):
        return f"<seaglint.Sample {self.columns['sample']}: {self.columns['target_name']}, map {self.map.shape}>"


class Simulator:
    """Makes any sample of a scenario, in any order: simulator[k]. Meshes are loaded once, seas of the last samples kept."""

    def __init__(self, scenario: Scenario | str | os.PathLike | dict):
        self.scenario = scenario if isinstance(scenario, Scenario) else Scenario(scenario)
        self._core = _core.Pipeline(self.scenario._core)

    def __len__(self):
        return len(self._core)

    def __getitem__(self, k: int) -> Sample:
        k = int(k)
        if not -len(self) <= k < len(self):
            raise IndexError(f"sample {k}: the scenario has samples 0 to {len(self) - 1}")
        return Sample(self._core.sample(k % len(self)))


def sample(scenario: Scenario | str | os.PathLike | dict, k: int) -> Sample:
    """Sample k of a scenario (Sample). For several samples of one, Simulator(scenario)[k] or a Scenario object."""
    if not isinstance(scenario, Scenario):
        return Simulator(scenario)[k]
    if scenario._pipeline is None:
        scenario._pipeline = Simulator(scenario)
    return scenario._pipeline[k]


def compare(export: str | os.PathLike, against: str | os.PathLike, *, polarisation: str = "", incidence: str = "", floor_db: float = 80.0, as_is: bool = False, interpolate_m: float | None = None,
            threads: int = 0) -> dict:
    """Differences of an export (CST, FEKO, HFSS, PyAEDT, a chamber) from another one or a table of `seaglint rcs`.

    Returns the dictionary of compare.json (tools/compare). polarisation, incidence: what the files do not say, as
    --reference-polarisation and --incidence. interpolate_m: extent of the target if the angles differ.
    """
    figures = _core.compare_tables(os.fspath(export), os.fspath(against), polarisation, incidence, floor_db, as_is, interpolate_m, threads)
    return json.loads(figures)
