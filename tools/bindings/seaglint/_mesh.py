# SPDX-License-Identifier: BSD-3-Clause
"""Meshes."""
from __future__ import annotations

import os

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._common import axis, number
from ._core import InputError


class Mesh:
    """A triangle mesh in metres, body frame: x forward, y to port, z up.

    Mesh(file, unit="m") reads .glb .gltf .obj .stl .ply .nas .unv .msh; Mesh.from_arrays(vertices, triangles) takes
    arrays [vertex][3] and [triangle][3], counter-clockwise seen from outside. forward and up: axes of the file that
    point ahead and upwards, "+x" to "-z"; scale: factor about its origin; then the mesh is moved by offset_m.
    """

    def __init__(self, file: str | os.PathLike, unit: str = "m", *, forward: str = "+x", up: str = "+z", scale: float = 1.0, offset_m: ArrayLike = (0.0, 0.0, 0.0)):
        if isinstance(file, _core.Mesh):
            self._core = file
        else:
            self._core = _core.Mesh.read(os.fspath(file), place(_core.RcsRequest(), unit, forward, up, scale, offset_m))

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


def place(request, unit, forward, up, scale, offset_m):
    """The request with a mesh file's unit and axes, its factor and its translation."""
    request.unit, request.forward, request.up = unit, forward, up
    request.scale, offset = number("scale", scale, 1e-3, 1e3), axis("offset_m", offset_m)
    if len(offset) != 3:
        raise InputError(f"offset_m: must be three numbers, not {len(offset)}")
    request.offset_m = offset
    return request


def _readonly(array):
    array.flags.writeable = False
    return array
