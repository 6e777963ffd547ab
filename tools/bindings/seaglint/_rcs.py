# SPDX-License-Identifier: BSD-3-Clause
"""Sweeps of a mesh, and comparisons of exports with it or with each other."""
from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._common import InputError, axis, count, number, threads_of, warn
from ._mesh import Mesh, place


def _word(name, value):
    if not isinstance(value, str):
        raise InputError(f"{name}: must be a text, not {value!r}")
    return value


def _request(placement, waterline_m, materials, crease_deg, edges, max_bounces, min_patch_m, sheet_thickness_mm, method, ray_spacing_m, like):
    """What the mesh is made of and how it is solved; None: the default, or what `like` has."""
    request = place(_core.RcsRequest(), *placement)
    request.waterline_m = None if waterline_m is None else number("waterline_m", waterline_m, -1e4, 1e4)
    request.edges = True if edges is None else bool(edges)
    request.crease_deg = None if crease_deg is None else number("crease_deg", crease_deg, 0, 60)
    request.max_bounces = _core.default_bounces if max_bounces is None else count("max_bounces", max_bounces)
    if not 1 <= request.max_bounces <= _core.max_bounces:
        raise InputError(f"max_bounces: value {max_bounces}: must be within 1 and {_core.max_bounces}")
    request.min_patch_m, request.sheet_thickness_mm = number("min_patch_m", min_patch_m, 0, 1e6), number("sheet_thickness_mm", sheet_thickness_mm, 0, 1000)
    request.method, request.ray_spacing_m = _word("method", method), number("ray_spacing_m", ray_spacing_m, 0, 1e6)
    if method == "beams" and request.ray_spacing_m != 0:
        raise InputError(f"ray_spacing_m: value {ray_spacing_m}: valid only with method 'rays'; beams have min_patch_m")
    chosen = {"": materials} if isinstance(materials, str) else dict(materials or {})
    request.set_materials(sorted((str(part), str(material)) for part, material in chosen.items()))
    if like is not None:
        request = _core.solved_like(request, _word("like", like), crease_deg is not None, edges is not None, max_bounces is not None)
    return request


def _target(target):
    return target._core if isinstance(target, Mesh) else os.fspath(target)


def rcs(target: Mesh | str | os.PathLike, frequencies_hz: ArrayLike, azimuth_deg: ArrayLike = 0.0, elevation_deg: ArrayLike = 0.0, *, unit: str = "m",
        forward: str = "+x", up: str = "+z", scale: float = 1.0, offset_m: ArrayLike = (0.0, 0.0, 0.0), waterline_m: float | None = None,
        materials: str | Mapping[str, str] | None = None, crease_deg: float | None = None, edges: bool | None = None, max_bounces: int | None = None, min_patch_m: float = 0.0,
        sheet_thickness_mm: float = 0.0, range_m: float = 0.0, transmitter_deg: tuple[float, float] | None = None, cavities: Sequence[str] = (), only: Sequence[str] = (),
        without: Sequence[str] = (), method: str = "beams", ray_spacing_m: float = 0.0, like: str | None = None, threads: int = 0) -> NDArray[np.complex128]:
    """Scattering matrices of a mesh at rest, complex [frequency, elevation, azimuth, received, transmitted], in metres.

    Polarisations in the order h, v; sigma = 4 pi |S|^2. e^{+jwt}, phase origin at the mesh's origin, basis of
    CONVENTIONS.md.

    target: Mesh or file (then `unit` is that of the file), turned, enlarged and moved as by Mesh(); what is then below
    z = waterline_m is removed. frequencies_hz, azimuth_deg, elevation_deg: numbers or
    sequences; azimuth 0 = radar ahead of the bow, counter-clockwise from above.
    materials: "aluminium", a file, or {part: material}, "" for all other parts. crease_deg: None as the mesh says,
    0 = all facets flat. edges: edge diffraction; None: on. max_bounces: None: 40. like: "hfss", "feko" or "cst": crease_deg,
    edges and max_bounces that are None are those of that program. transmitter_deg: (azimuth, elevation) of a fixed
    transmitter; the angles are then those of the receiver. only, without: contributions, "part=hull", "bounces=2", "mechanism=edge". method: how paths are found,
    "beams", or "rays" (ray_spacing_m apart; 0: from the size of the target).
    The other settings are the options of `seaglint rcs`.
    """
    request = _request((unit, forward, up, scale, offset_m), waterline_m, materials, crease_deg, edges, max_bounces, min_patch_m, sheet_thickness_mm, method, ray_spacing_m, like)
    request.frequency_hz, request.azimuth_deg, request.elevation_deg = axis("frequencies_hz", frequencies_hz), axis("azimuth_deg", azimuth_deg), axis("elevation_deg", elevation_deg)
    request.range_m = number("range_m", range_m, 0, 1e9)
    if transmitter_deg is not None:
        azimuth, elevation = transmitter_deg
        request.set_transmitter(azimuth, elevation)
    request.set_cavities(list(cavities))
    request.select(list(only), list(without))
    values, texts = _core.rcs(request, _target(target), threads_of(threads))
    warn(texts)
    return values


def _per_export(name, value, text):
    """None, one value for all exports, or a list of one for each, as texts."""
    if value is None:
        return []
    return [text(name, one) for one in value] if isinstance(value, list) else [text(name, value)]


def _numbers(name, value):
    return ",".join(repr(x) for x in axis(name, value))


def compare(export: str | os.PathLike | Sequence[str | os.PathLike], against: str | os.PathLike | None = None, *, target: Mesh | str | os.PathLike | None = None, unit: str = "m",
            forward: str = "+x", up: str = "+z", scale: float = 1.0, offset_m: ArrayLike = (0.0, 0.0, 0.0), waterline_m: float | None = None,
            materials: str | Mapping[str, str] | None = None, crease_deg: float | None = None, edges: bool | None = None, max_bounces: int | None = None, min_patch_m: float = 0.0,
            sheet_thickness_mm: float = 0.0, polarisation: str | list[str] | None = None, incidence: str | tuple[float, float] | list | None = None,
            frequency_hz: float | list[float] | None = None, elevation_deg: float | list[float] | None = None, phi: tuple[float, float] | list | None = None, origin_m: tuple[float, float, float] | list | None = None,
            floor_db: float = 80.0, as_is: bool = False, interpolate_m: float | None = None, method: str = "beams", ray_spacing_m: float = 0.0, like: str | None = None, threads: int = 0) -> dict:
    """Differences of exports (CST, FEKO, HFSS, PyAEDT, a chamber, a table of `seaglint rcs`) or folders of them from a
    mesh or a file.

    target: a Mesh or a file in `unit`, solved at the exports' own angles and frequencies, with the settings of rcs();
    or against: another file. Returns the dictionary of compare.json (tools/compare): for each export and polarisation
    summary (the verdict in two sentences), bias_db, mean_abs_db, rms_db, p90_db, p95_db (compared - export), correlation
    of the complex values, what was fitted
    (phase, origin, conjugation, sign), lobes, nulls, solver settings, warnings; "known", the differences of both from
    the exact or closed-form values of a mesh that is a sphere, a plate, a dihedral or a trihedral; "trials", what a few
    views give with another unit of the mesh or with the settings of another program, where the agreement is poor.

    What an export does not say, one value for all or a list of one for each: polarisation "vv" (received,
    transmitted) or "v" (transmitted); incidence "monostatic" or (theta, phi) in degrees; frequency_hz; elevation_deg
    of a table by azimuth; phi (a, b): the
    file's phi is a * azimuth + b degrees; origin_m of its phase, body frame. floor_db: levels further below the
    export's maximum are clipped. as_is: no fit before the correlation. interpolate_m: extent of the target, if
    `against` has other angles.
    """
    exports = _core.Exports()
    exports.files = [os.fspath(file) for file in ([export] if isinstance(export, (str, os.PathLike)) else export)]
    if not exports.files:
        raise InputError("export: must be a file or several")
    exports.polarisation = _per_export("polarisation", polarisation, _word)
    exports.incidence = _per_export("incidence", incidence, lambda name, value: value if isinstance(value, str) else _numbers(name, value))
    exports.frequency_ghz = _per_export("frequency_hz", frequency_hz, lambda name, value: repr(number(name, value) / 1e9))
    exports.elevation_deg = _per_export("elevation_deg", elevation_deg, lambda name, value: repr(number(name, value, -90, 90)))
    exports.phi, exports.origin_m = _per_export("phi", phi, _numbers), _per_export("origin_m", origin_m, _numbers)
    exports.floor_db = number("floor_db", floor_db, 1, 300)
    if (target is None) == (against is None):
        raise InputError("compare: give either target, a mesh, or against, a file")
    if interpolate_m is not None and against is None:
        raise InputError("interpolate_m is for against: a mesh is solved at the angles of the export")
    if target is None:
        extent = None if interpolate_m is None else number("interpolate_m", interpolate_m, 1e-3, 1e4)
        return json.loads(_core.compare_tables(exports, os.fspath(against), bool(as_is), extent, threads_of(threads)))
    request = _request((unit, forward, up, scale, offset_m), waterline_m, materials, crease_deg, edges, max_bounces, min_patch_m, sheet_thickness_mm, method, ray_spacing_m, like)
    figures, texts = _core.compare_target(exports, request, _target(target), bool(as_is), threads_of(threads))
    warn(texts)
    return json.loads(figures)
