# SPDX-License-Identifier: BSD-3-Clause
"""Data sets of `seaglint generate`, read map by map."""
from __future__ import annotations

import difflib
import hashlib
import json
import mmap
import os
import pathlib
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _handover
from ._columns import read_columns
from ._common import warn
from ._core import InputError


def folder_of(path: str | os.PathLike) -> pathlib.Path:
    """Folder of the data set: the given one, or its `data`, where `run` writes it."""
    folder = pathlib.Path(path)
    below = not (folder / "manifest.json").is_file() and (folder / "data/manifest.json").is_file()
    return folder / "data" if below else folder


class _Shard:
    """A file with some of the maps. Its maps are mapped into memory where they lie, one chunk each, with their checksum
    behind them."""

    def __init__(self, file, count, shape):
        import h5py

        try:
            with h5py.File(file) as data:
                maps = data["maps"]
                if maps.shape != (count, *shape) or maps.dtype != np.dtype("<f4") or maps.chunks != (*[1] * (len(shape) - 1), *shape[-2:]):
                    raise InputError(f"{file}: maps are {maps.dtype} of shape {maps.shape}: not a shard of this data set")
                chunks = [maps.id.get_chunk_info(i) for i in range(maps.id.get_num_chunks())]
        except (OSError, KeyError, RuntimeError) as error:
            raise InputError(f"{file}: not a shard: {error}") from None
        bytes_of_map = 4 * shape[-2] * shape[-1]
        size = os.path.getsize(file)
        self._looks = shape[0] if len(shape) == 3 else 1
        if len(chunks) != count * self._looks or any(c.size != bytes_of_map + 4 or c.byte_offset + c.size > size for c in chunks):
            raise InputError(f"{file}: its maps are not stored as this program does")
        self._shape = shape
        self._offsets = [0] * len(chunks)
        for chunk in chunks:
            self._offsets[chunk.chunk_offset[0] * self._looks + (chunk.chunk_offset[1] if len(shape) == 3 else 0)] = chunk.byte_offset
        with open(file, "rb") as stream:
            self._bytes = mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ)

    def map(self, row):
        velocities, ranges = self._shape[-2:]
        looks = [np.frombuffer(self._bytes, "<f4", velocities * ranges, offset).reshape(velocities, ranges) for offset in self._offsets[row * self._looks:(row + 1) * self._looks]]
        return looks[0] if len(self._shape) == 2 else np.stack(looks)


class Dataset:
    """A data set: len(), data[i] -> map [velocity, range] in metres, of several looks [look, velocity, range],
    data.columns["label"], data.where(label=1).

    path: the folder of `generate` or of `run`. Maps are read when they are used; each process has handles of its own,
    so that it can be shared with workers, forked or spawned. Maps are views of the file, not to be written to.
    check=True compares the SHA-256 of every shard with the manifest, and the files that croissant.json lists with it.
    """

    def __init__(self, path: str | os.PathLike, check: bool = False):
        folder = folder_of(path)
        try:
            manifest = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))
        except FileNotFoundError:
            raise InputError(f"{folder / 'manifest.json'}: no such file: not a data set, or not finished") from None
        except ValueError as error:
            raise InputError(f"{folder / 'manifest.json'}: {error}") from None
        self.folder, self.manifest = folder, manifest
        self._shape = (int(manifest["map"]["rows"]), int(manifest["map"]["columns"]))
        self._looks = int(manifest["map"].get("looks", 1))
        self._sample_shape = self._shape if self._looks == 1 else (self._looks, *self._shape)
        self._files, self._first = [], [0]
        for shard in manifest["shards"]:
            file = folder / shard["file"]
            if file.parent != folder or not file.is_file():
                raise InputError(f"{file}: no such file, but the manifest lists it")
            if check and hashlib.sha256(file.read_bytes()).hexdigest() != shard["sha256"]:
                raise InputError(f"{file}: its SHA-256 is not that of the manifest")
            if shard["first_sample"] != self._first[-1]:
                raise InputError(f"{folder / 'manifest.json'}: {shard['file']} begins at sample {shard['first_sample']}, not {self._first[-1]}")
            self._files.append(file)
            self._first.append(self._first[-1] + int(shard["samples"]))
        if self._first[-1] != manifest["samples"]:
            raise InputError(f"{folder / 'manifest.json'}: {manifest['samples']} samples, but {self._first[-1]} in its shards")
        self._first = np.array(self._first)
        if check:
            _handover.check_croissant(self)
        self._shards, self._owner, self._columns, self._look_columns, self._axes, self._closed = {}, os.getpid(), None, None, None, False

    def __len__(self):
        return int(self._first[-1])

    @property
    def map_shape(self) -> tuple[int, int]:
        """(velocity cells, range cells)."""
        return self._shape

    @property
    def looks(self) -> int:
        """Looks of a sample."""
        return self._looks

    @property
    def look_columns(self) -> dict[str, NDArray]:
        """{name: array [sample, look]} of what differs between looks: start_s, radar_key, everything measured and the
        motion; empty with one look."""
        if self._look_columns is None:
            import h5py

            self._require_open()
            parts = []
            for file in self._files if self._looks > 1 else []:
                with h5py.File(file) as data:
                    parts.append({name: array[...] for name, array in data["looks"].items()})
            self._look_columns = {name: np.concatenate([part[name] for part in parts]) for name in (parts[0] if parts else {})}
        return self._look_columns

    @property
    def classes(self) -> list[str]:
        """Names of the classes by label: columns["label"] counts them from 0."""
        return list(self.manifest.get("classes", ["array", "ship"]))

    def _require_open(self):
        if self._closed:
            raise InputError(f"{self.folder}: the data set is closed")

    @property
    def columns(self) -> dict[str, NDArray]:
        """{name: array over the samples}: label, target_name, azimuth_deg, features, ... (units in manifest["columns"]), and
        the drawn keys by their paths, "sea.peak_period_s"."""
        if self._columns is None:
            self._require_open()
            self._columns = read_columns(self._files)
        return self._columns

    def _axis(self, name):
        if self._axes is None:
            import h5py

            self._require_open()
            with h5py.File(self._files[0]) as data:
                self._axes = {axis: data[f"axes/{axis}"][...] for axis in ("range_m", "velocity_mps")}
        return self._axes[name]

    @property
    def range_m(self) -> NDArray[np.float64]:
        """Ranges of the map's columns relative to the reference point, positive = farther."""
        return self._axis("range_m")

    @property
    def velocity_mps(self) -> NDArray[np.float64]:
        """Velocities of the map's rows, positive = receding."""
        return self._axis("velocity_mps")

    def where(self, **equal) -> NDArray[np.int64]:
        """Numbers of the samples whose columns have these values: where(label=1, significant_wave_height_m=1.0)."""
        chosen = np.ones(len(self), bool)
        for name, value in equal.items():
            if name not in self.columns:
                raise InputError(f"no column {name}; the columns are {', '.join(self.columns)}")
            chosen &= self.columns[name] == value
        return np.flatnonzero(chosen)

    def __getitem__(self, index: int) -> NDArray[np.float32]:
        self._require_open()
        i = int(index)
        if not -len(self) <= i < len(self):
            raise IndexError(f"sample {i}: the data set has samples 0 to {len(self) - 1}")
        i %= len(self)
        if self._owner != os.getpid():  # a forked worker
            self._shards, self._owner = {}, os.getpid()
        number = int(np.searchsorted(self._first, i, side="right")) - 1
        shard = self._shards.get(number)
        if shard is None:
            shard = self._shards[number] = _Shard(self._files[number], int(self._first[number + 1] - self._first[number]), self._sample_shape)
        return shard.map(i - int(self._first[number]))

    def maps(self, indices: ArrayLike) -> NDArray[np.float32]:
        """The maps of some samples, [sample, velocity, range], of several looks [sample, look, velocity, range], copied."""
        indices = np.asarray(indices)
        result = np.empty((len(indices), *self._sample_shape), np.float32)
        for row, index in enumerate(indices):
            result[row] = self[index]
        return result

    def torch_dataset(self, column: str | Sequence[str] = "label", transform=None):
        """For torch.utils.data.DataLoader: items (map as a float32 tensor [look, velocity, range], value of the column), or with
        several columns (map, value, value, ...)."""
        columns = [column] if isinstance(column, str) else list(column)
        for name in columns:
            if name not in self.columns:
                near = difflib.get_close_matches(str(name), list(self.columns), 1)
                raise InputError(f"{self.folder}: no column {name!r}" + (f": did you mean {near[0]!r}?" if near else ""))
        return _TorchDataset(self, columns, transform)

    def card(self, *, name: str | None = None, licence: str | None = None, creators: Sequence[str] = (), organisations: Sequence[str] = (), url: str | None = None,
             date: str | None = None, version: str | None = None) -> dict:
        """Writes the files with which the data set is handed to others into its folder, and returns the dictionary of
        croissant.json.

        README.md: the data card with metadata of the Hugging Face Hub, licence and citation. columns.csv: one line for each
        sample, with `shard` and `row` of its map; an empty cell is no number. croissant.json, written last: the Croissant
        format 1.0, every file with its SHA-256 and a field for every column.

        name: the title; None: that of the scenario. licence: an identifier of the SPDX list, "CC-BY-4.0", LicenseRef-NAME, or
        a URL. creators, organisations: names. url: page of the data set. date: of publication, YYYY-MM-DD. version:
        MAJOR.MINOR.PATCH. Nothing is invented: what is not given is left out, and a SeaglintWarning names what Croissant
        requires. Every shard is read and compared with the manifest first. A file that this program did not write, or that
        was changed since, is an InputError and nothing is written.
        """
        self._require_open()
        card, warnings = _handover.write_cards(self, _handover.check_publication(name, licence, creators, organisations, url, date, version))
        warn(warnings)
        return card

    def to_webdataset(self, directory: str | os.PathLike, max_tar_mb: float = 500) -> int:
        """Writes tar archives samples-000000.tar, ... of at most max_tar_mb (10^6 bytes) in the WebDataset layout; returns
        their number.

        The files of a sample are adjacent, named by its number of nine digits: .map.npy (float32 [velocity, range], m),
        .complex.npy (complex64, of a data set with complex maps), .hop_code.npy (uint16 [pulse]), .centres.npy (float32
        [centre, (range_m, velocity_mps, amplitude_m)], strongest first), .cls (the label), .json (the row of the sample; null
        where a value is no number). description.json: axes, units, meaning. index.json, written last: the archives with samples,
        bytes and SHA-256, as the package `wids` reads them.

        directory: new, empty, or an export of this data set, which is replaced. Memory holds one shard. A training on the
        archives divides them by `group` of the samples' JSON.
        """
        self._require_open()
        archives = _handover.write_webdataset(self, directory, max_tar_mb)
        warn(_handover.merged_file(self.folder)[1])
        return archives

    def close(self):
        self._shards, self._closed = {}, True

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __getstate__(self):
        return {**self.__dict__, "_shards": {}}

    def __repr__(self):
        return f"<seaglint.Dataset {self.manifest.get('scenario')}: {len(self)} maps of {self._shape[0]} x {self._shape[1]} cells>"


class _TorchDataset:
    """Map-style: torch accepts anything with __len__ and __getitem__, and is imported where an item is made."""

    def __init__(self, data, columns, transform):
        self.data, self.values, self.transform = data, [data.columns[name] for name in columns], transform

    def __len__(self):
        return len(self.data)

    def __getitem__(self, index):
        import torch

        values = torch.from_numpy(self.data[index].reshape(-1, *self.data.map_shape).copy())
        return (values if self.transform is None else self.transform(values)), *(column[index].item() for column in self.values)
