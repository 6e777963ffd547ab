#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reads a data set of seaglint: the maps of one class, divided into training and test by group.

    tools/python/read_dataset.py build/points/dataset.h5    after `seaglint merge build/points`
    tools/python/read_dataset.py build/points               shard by shard

Needs python3-h5py and python3-numpy. Copy what you need: this is an example, not a library.
"""
import argparse
import hashlib
import json
import pathlib
import sys

import h5py
import numpy as np


def require_shards(directory):
    """The shards that the manifest lists, in order. A virtual data set returns NaN for a missing shard, hence this check."""
    manifest = directory / "manifest.json"
    if not manifest.is_file():
        sys.exit(f"{manifest}: missing: the data set is not finished")
    shards = [directory / shard["file"] for shard in json.loads(manifest.read_text())["shards"]]
    missing = [str(shard) for shard in shards if not shard.is_file()]
    if missing:
        sys.exit(f"{missing[0]}: missing ({len(missing)} of {len(shards)} shards)")
    return shards


def require_own_manifest(merged, manifest):
    """Stops unless the merged file is of this manifest. HDF5 takes rows from any shards of the right names, beside the file or in
    the working directory: labels of one data set would be paired with maps of another."""
    with h5py.File(merged) as data:
        own = data.attrs.get("manifest_sha256", "")
    own = own.decode() if isinstance(own, bytes) else str(own)
    if own != hashlib.sha256(manifest.read_bytes()).hexdigest():
        sys.exit(f"{merged}: is of another manifest than {manifest}; merge again")


def class_names(directory):
    """The names of the classes by label."""
    return json.loads((directory / "manifest.json").read_text()).get("classes", ["array", "ship"])


def read_columns(files):
    """The rows of all samples: {column: values}, in the order of the files."""
    columns = {}
    for file in files:
        with h5py.File(file) as data:
            for name, column in data["samples"].items():
                columns.setdefault(name, []).append(column[:])
    return {name: np.concatenate(parts) for name, parts in columns.items()}


def read_maps(files, rows):
    """The maps of some rows (sorted), [row][velocity][range] in metres; only those are read."""
    maps, first = [], 0
    for file in files:
        with h5py.File(file) as data:
            count = data["maps"].shape[0]
            here = rows[(rows >= first) & (rows < first + count)] - first
            if here.size:
                maps.append(data["maps"][here])
            first += count
    return np.concatenate(maps)


def split_by_group(group, fraction, seed=0):
    """True for the training rows. All maps of one sea are in one part: a split within groups overestimates the accuracy."""
    seas = np.unique(group)
    order = np.random.default_rng(seed).permutation(seas)
    return np.isin(group, order[: max(1, round(fraction * seas.size))])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("data", type=pathlib.Path, help="directory of the data set, or the merged file in it")
    parser.add_argument("--label", type=int, default=1, help="by default 1 = ship, 0 = corner-reflector array; names in manifest.json")
    arguments = parser.parse_args()

    directory = arguments.data if arguments.data.is_dir() else arguments.data.parent
    shards = require_shards(directory)
    files = shards if arguments.data.is_dir() else [arguments.data]
    if not arguments.data.is_dir():
        require_own_manifest(arguments.data, directory / "manifest.json")

    columns = read_columns(files)
    rows = np.flatnonzero(columns["label"] == arguments.label)
    if rows.size == 0:
        sys.exit(f"{arguments.data}: no map has label {arguments.label}")
    maps = read_maps(files, rows)
    assert not np.isnan(maps).any(), "a shard is missing"
    train = split_by_group(columns["group"][rows], fraction=0.7)

    # Normalised to its energy, a map contains no absolute level, which would depend on the target's size.
    power = maps**2 / np.sum(maps**2, axis=(1, 2), keepdims=True)
    with h5py.File(files[0]) as data:
        velocity = data["axes/velocity_mps"][:]
    spread = np.sqrt(np.einsum("nvr,v->n", power, velocity**2))

    name = class_names(directory)[arguments.label]
    print(f"{rows.size} of {columns['label'].size} maps have label {arguments.label} ({name}); {maps.shape[1]} velocities, "
          f"{maps.shape[2]} ranges")
    print("part   maps  groups  peak_m (mean)  velocity spread (mean, m/s)")
    for name, part in (("train", train), ("test", ~train)):
        if part.any():
            groups = np.unique(columns["group"][rows][part]).size
            peak = columns["peak_m"][rows][part].mean()
            print(f"{name:5} {part.sum():5d} {groups:7d} {peak:14.3f} {spread[part].mean():28.4f}")


if __name__ == "__main__":
    main()
