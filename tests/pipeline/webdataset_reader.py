# SPDX-License-Identifier: BSD-3-Clause
"""Reads an export in the WebDataset layout with Python's tarfile and NumPy and compares it with the shards by h5py.

    webdataset_reader.py DATA EXPORT    prints the numbers of archives and samples

Samples are grouped as the WebDataset library does: adjacent files whose names agree up to the first dot.
"""
import hashlib
import io
import itertools
import json
import math
import pathlib
import sys
import tarfile

import h5py
import numpy as np

data, export = (pathlib.Path(word) for word in sys.argv[1:])


def samples_of(archive):
    with tarfile.open(archive, "r:") as tar:
        members = tar.getmembers()
        names = [member.name for member in members]
        for member in members:
            assert member.isreg() and member.mode == 0o644, member.name
            assert (member.uid, member.gid, member.mtime, member.uname, member.gname) == (0, 0, 0, "", ""), member.name
        for key, group in itertools.groupby(names, key=lambda name: name.split(".", 1)[0]):
            yield key, {name.split(".", 1)[1]: tar.extractfile(name).read() for name in group}


def array(content):
    return np.load(io.BytesIO(content), allow_pickle=False)


index = json.loads((export / "index.json").read_text())
description = json.loads((export / "description.json").read_text())
assert description["manifest_sha256"] == hashlib.sha256((data / "manifest.json").read_bytes()).hexdigest()
exported = []
for shard in index["shardlist"]:
    archive = export / shard["url"]
    assert shard["sha256"] == hashlib.sha256(archive.read_bytes()).hexdigest()
    assert shard["filesize"] == archive.stat().st_size
    samples = list(samples_of(archive))
    assert len(samples) == shard["nsamples"]
    exported += samples
keys = [key for key, _ in exported]
assert keys == sorted(set(keys)), "keys repeat or are out of order"
assert sorted(file.name for file in export.glob("*.tar")) == [shard["url"] for shard in index["shardlist"]]

position = 0
for shard in json.loads((data / "manifest.json").read_text())["shards"]:
    with h5py.File(data / shard["file"]) as stored:
        columns = {name: column[:] for name, column in stored["samples"].items()}
        np.testing.assert_array_equal(description["axes"]["range_m"], stored["axes/range_m"][:])
        np.testing.assert_array_equal(description["axes"]["velocity_mps"], stored["axes/velocity_mps"][:])
        for name, column in stored["samples"].items():
            assert description["columns"][name]["units"] == column.attrs["units"].decode()
        for row in range(shard["samples"]):
            key, files = exported[position]
            position += 1
            expected = {"map.npy", "hop_code.npy", "centres.npy", "cls", "json"}
            if "maps_complex" in stored:
                expected.add("complex.npy")
                values = array(files["complex.npy"])
                assert values.dtype == np.complex64
                np.testing.assert_array_equal(values, stored["maps_complex"][row].view(np.complex64)[..., 0])
            assert set(files) == expected == {name for name in description["files"]} | {"cls", "json"}, files.keys()
            assert array(files["map.npy"]).dtype == np.float32
            np.testing.assert_array_equal(array(files["map.npy"]), stored["maps"][row])
            np.testing.assert_array_equal(array(files["hop_code.npy"]), stored["hop_code"][row])
            np.testing.assert_array_equal(array(files["centres.npy"]), stored["centres"][row, :columns["centres"][row]])
            record = json.loads(files["json"])
            assert list(record) == list(description["columns"]) and set(record) == set(columns)
            assert int(key) == record["sample"] and int(files["cls"]) == record["label"]
            for name, value in record.items():
                there = columns[name][row]
                if there.dtype.kind == "S":
                    assert value == there.decode(), name
                else:
                    assert value == there or (value is None and math.isnan(there)), name
assert position == len(exported)
print(len(index["shardlist"]), position)
