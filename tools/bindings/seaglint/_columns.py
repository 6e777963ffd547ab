# SPDX-License-Identifier: BSD-3-Clause
"""Columns of all shards of a data set.

HDF5 needs some 0.1 ms to open and read an array, 2 s for the 34 columns of 500 shards. The program writes shards of the
same size with the same structure: a shard whose bytes outside of the arrays' values equal those of another has its
values at the same places, and they are taken from there with their checksums. Any other shard is read by HDF5.
"""
from __future__ import annotations

import os
import pathlib
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ._core import InputError


def _chunks(dataset):
    """(begin, end) of the bytes of every chunk of an array, with their checksums."""
    for i in range(dataset.id.get_num_chunks()):
        chunk = dataset.id.get_chunk_info(i)
        yield chunk.byte_offset, chunk.byte_offset + chunk.size


def _complement(ranges, size):
    """The ranges of [0, size) that are not in `ranges`."""
    left, at = [], 0
    for begin, end in sorted(ranges):
        if begin > at:
            left.append((at, begin))
        at = max(at, end)
    if at < size:
        left.append((at, size))
    return left


def fletcher32(blocks: NDArray[np.uint8]) -> NDArray[np.uint64]:
    """HDF5's checksum of each block [block, byte] of an even number of bytes: the sum of its 16-bit words and that of
    these sums, both modulo 65535."""
    words = np.ascontiguousarray(blocks).view(">u2").astype(np.uint64)
    first, second = words.sum(axis=1), words @ np.arange(words.shape[1], 0, -1, dtype=np.uint64)
    first, second = ((total - (total > 0)) % 65535 + (total > 0) for total in (first, second))  # 0 of zeros alone
    return second << 16 | first


def _arrays(data):
    """For the columns and for the drawn keys, which lie apart in a shard: [(name, array)]."""
    return [list(group.items()) for group in (data["samples"], data.get("drawn", {})) if len(group) > 0]


class _Content:
    """The bytes of a file; a slice of them is read when it is asked for."""

    def __init__(self, stream):
        self._number = stream.fileno()
        self.size = os.fstat(self._number).st_size

    def __getitem__(self, part):
        return os.pread(self._number, part.stop - part.start, part.start)


class _Structure:
    """The places of the columns in a shard, and all bytes that decide on them."""

    def __init__(self, data, content):
        import h5py

        arrays = []
        data.visititems(lambda _, item: arrays.append(item) if isinstance(item, h5py.Dataset) else None)
        self._columns = {}  # name: (begin, end without the checksum, type), in the bytes of the ranges one after another
        self._ranges = []
        self._known = all(array.chunks for array in arrays)  # whether all is stored as the program does
        if not self._known:
            return
        self._size = content.size
        self._parts = [(begin, end, content[begin:end]) for begin, end in _complement([chunk for array in arrays for chunk in _chunks(array)], self._size)]
        for group in _arrays(data):
            places = {}
            for name, array in group:
                chunks = list(_chunks(array))
                checked = array.fletcher32 and array.id.get_create_plist().get_nfilters() == 1 and array.nbytes % 2 == 0
                if not checked or len(chunks) != 1 or array.chunks != array.shape or chunks[0][1] - chunks[0][0] != array.nbytes + 4:
                    self._known = False
                    return
                places[name] = (*chunks[0], array.dtype)
            first = min(begin for begin, _, _ in places.values())
            before = sum(end - begin for begin, end in self._ranges)
            self._columns |= {name: (before + begin - first, before + end - 4 - first, dtype) for name, (begin, end, dtype) in places.items()}
            self._ranges.append((first, max(end for _, end, _ in places.values())))

    def is_of(self, content):
        return self._known and content.size == self._size and all(content[begin:end] == part for begin, end, part in self._parts)

    def bytes_of_columns(self, content):
        return b"".join(content[begin:end] for begin, end in self._ranges)

    def values(self, files, bytes_of_columns):
        """The columns of some files of this structure."""
        rows = np.frombuffer(b"".join(bytes_of_columns), np.uint8).reshape(len(files), -1)
        columns = {}
        for name, (begin, end, dtype) in self._columns.items():
            values = np.ascontiguousarray(rows[:, begin:end])
            stored = np.ascontiguousarray(rows[:, end:end + 4]).view("<u4")[:, 0]
            for k in np.flatnonzero(fletcher32(values) != stored):
                raise InputError(f"{files[k]}: {name}: the values do not have their checksum")
            columns[name] = values.view(dtype).reshape(-1)
        return columns


def _read_by_hdf5(file, content):
    import h5py

    try:
        with h5py.File(file) as data:
            return {name: array[...] for group in _arrays(data) for name, array in group}, _Structure(data, content)
    except (OSError, KeyError, RuntimeError) as error:
        raise InputError(f"{file}: not a shard: {error}") from None


def read_columns(files: Sequence[pathlib.Path]) -> dict[str, NDArray]:
    """{name: array over the samples of all files}; text as str. Throws InputError naming a damaged file."""
    parts, structure, alike = [], None, []  # alike: (file, bytes of its columns) of the structure, not yet in parts

    def finish():
        if alike:
            parts.append(structure.values(*zip(*alike)))
            alike.clear()

    for file in files:
        with open(file, "rb") as stream:
            content = _Content(stream)
            if structure is not None and structure.is_of(content):
                alike.append((file, structure.bytes_of_columns(content)))
                continue
            finish()
            columns, structure = _read_by_hdf5(file, content)
        parts.append(columns)
        if columns.keys() != parts[0].keys():
            raise InputError(f"{file}: its columns are not those of {files[0].name}")
    finish()
    columns = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]} if parts else {}
    return {name: np.char.decode(values, "utf-8") if values.dtype.kind == "S" else values for name, values in columns.items()}
