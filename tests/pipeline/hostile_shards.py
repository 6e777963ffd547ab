# SPDX-License-Identifier: BSD-3-Clause
"""Data sets whose first shard was made to deceive its reader, with a manifest that agrees.

    hostile_shards.py BASE OUTPUT SECRET    copies the data set BASE to OUTPUT/KIND for every kind; prints the kinds

SECRET is a file that one of them names as the storage of its maps.
"""
import hashlib
import json
import pathlib
import shutil
import sys

import h5py
import numpy as np

base, output, secret = (pathlib.Path(word).resolve() for word in sys.argv[1:])


def plain(file, array, values):
    del file[array]
    file.create_dataset(array, data=values, chunks=(1,) + values.shape[1:], fletcher32=True)


def low_level(file, array, shape, change, layout=None):
    """An array made by the C interface; change(property list, space) sets its storage."""
    del file[array]
    properties = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    if layout is not None:
        properties.set_layout(layout)
    space = h5py.h5s.create_simple(shape)
    change(properties, space)
    h5py.h5d.create(file.id, array.encode(), h5py.h5t.IEEE_F32LE, space, properties)


def virtual(shape, array="maps"):
    def change(properties, space):
        ones = (1,) * len(shape)
        space.select_hyperslab((0,) * len(shape), ones)
        properties.set_virtual(space, b"/nonexistent.h5", b"/x", h5py.h5s.create_simple(ones))

    return lambda file: low_level(file, array, shape, change, h5py.h5d.VIRTUAL)


def external(file):
    shape = file["maps"].shape
    low_level(file, "maps", shape,
              lambda properties, space: properties.set_external(str(secret).encode(), 0, h5py.h5f.UNLIMITED))


def link(target):
    def change(file):
        del file["maps"]
        file["maps"] = target

    return change


def deflated(file):
    del file["maps"]
    file.create_dataset("maps", shape=(4, 100000, 100000), dtype="<f4", chunks=(1, 1000, 100000), compression="gzip")


def claimed(file):
    """An index that claims a chunk of the length of the file."""
    values, at = file["maps"][:], file["maps"].id.get_chunk_info(0)
    size = np.array(at.size, "<u4").tobytes()
    # The key of a chunk in a version 1 B-tree: its size, its filter mask, its offset in every dimension and the element.
    key = size + np.zeros(1, "<u4").tobytes() + np.zeros(values.ndim + 1, "<u8").tobytes()
    name = file.filename
    file.close()
    content = pathlib.Path(name).read_bytes()
    assert content.count(key + np.array(at.byte_offset, "<u8").tobytes()) == 1
    pathlib.Path(name).write_bytes(content.replace(key, np.array(4000000000, "<u4").tobytes() + key[4:], 1))


def samples_elsewhere(file):
    del file["samples"]
    file["samples"] = h5py.ExternalLink(str(base / "shard_00000.h5"), "/samples")


KINDS = {
    "external_storage": external,
    "external_link": link(h5py.ExternalLink(str(base / "shard_00000.h5"), "/maps")),
    "external_group": samples_elsewhere,
    "soft_link": link(h5py.SoftLink("/maps")),
    "virtual_small": virtual((4, 64, 256)),
    "virtual_huge": virtual((4, 100000, 10000000)),
    "extent_overflow": virtual((4, 2**62, 1)),
    "extent_overflow_centres": virtual((4, 2**62, 3), "centres"),
    "compressed": deflated,
    "claimed_chunk": claimed,
    "other_type": lambda file: plain(file, "maps", file["maps"][:].astype("f8")),
    "whole_numbers": lambda file: plain(file, "maps", np.full(file["maps"].shape, -5, "i1")),
    "centres_beyond": lambda file: plain(file, "samples/centres", np.full(file["samples/centres"].shape, 2**62)),
}

for kind, change in KINDS.items():
    folder = output / kind
    shutil.copytree(base, folder)
    shard = folder / "shard_00000.h5"
    with h5py.File(shard, "r+") as opened:
        change(opened)
    manifest = json.loads((folder / "manifest.json").read_text())
    manifest["shards"][0]["sha256"] = hashlib.sha256(shard.read_bytes()).hexdigest()
    (folder / "manifest.json").write_text(json.dumps(manifest))
    print(kind)
