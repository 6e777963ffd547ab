# SPDX-License-Identifier: BSD-3-Clause
"""Cards and tar archives of data sets by the rules of their specifications and against the shards by h5py; PyAEDT's files.
Nothing is invented, no file of the user is replaced, a data set stays sound."""
import csv
import errno
import hashlib
import io
import itertools
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import tarfile
import warnings

import h5py
import numpy as np
import pytest

import seaglint
from program import REFLECTOR, program
from seaglint._handover import hub_licence, hub_size_category

PUBLICATION = {"licence": "CC-BY-4.0", "name": 'Points: "a" set # 1', "creators": ["A. Person", "B. Person"], "url": "https://example.org/d", "organisations": ["Laboratory"],
               "date": "2026-02-28", "version": "1.0.0"}
OWN = "was not written by seaglint, or was changed since; move it away or remove it"


def generated(folder, *settings, more=()):
    words = [word for setting in settings for word in ("--set", setting)]
    made = program("generate", "points.yaml", "-o", folder, *words, *more)
    assert made.returncode == 0, made.stderr
    return made


@pytest.fixture(scope="module")
def without_clutter(tmp_path_factory):
    """A data set whose rows have values that are no numbers, with a drawn key."""
    folder = tmp_path_factory.mktemp("card") / "set"
    generated(folder, "dataset.maps_per_shard=15", "clutter.enabled=false", "sea.peak_period_s=uniform(7 9)")
    return folder


@pytest.fixture
def folder(without_clutter, tmp_path):
    return pathlib.Path(shutil.copytree(without_clutter, tmp_path / "set"))


def card(folder, **publication):
    """The cards, without the warning of what Croissant requires."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", seaglint.SeaglintWarning)
        return seaglint.Dataset(folder).card(**publication)


def bytes_of(folder):
    return {file.name: file.read_bytes() for file in folder.iterdir()}


def sha256(file):
    return subprocess.run(["sha256sum", file], check=True, capture_output=True, text=True).stdout.split()[0]


def assert_refused(folder, sentence, call):
    """With this sentence, and nothing changed."""
    before = bytes_of(folder)
    with pytest.raises(seaglint.InputError, match=re.escape(sentence)):
        call()
    assert bytes_of(folder) == before


# Properties of schema.org (the vocabulary of names without prefix) that the specification names.
SCHEMA_ORG = {"name", "description", "license", "url", "creator", "datePublished", "keywords", "publisher", "version", "distribution", "contentUrl", "contentSize", "encodingFormat",
              "sha256", "isBasedOn", "softwareVersion"}


def expanded(context, term):
    """The IRI of a property or type by the context: a term, a prefix, or the vocabulary."""
    meaning = context.get(term, term)
    meaning = meaning["@id"] if isinstance(meaning, dict) else meaning
    prefix, colon, rest = meaning.partition(":")
    if colon and not rest.startswith("//"):
        return context[prefix] + rest
    assert meaning in SCHEMA_ORG, f"{term}: neither in the context nor a property of schema.org"
    return context["@vocab"] + meaning


def nodes(context, value):
    """Every object but those that are plain JSON by the context."""
    if isinstance(value, list):
        for entry in value:
            yield from nodes(context, entry)
    elif isinstance(value, dict):
        yield value
        for name, entry in value.items():
            if name != "@context" and not (isinstance(context.get(name), dict) and context[name].get("@type") == "@json"):
                yield from nodes(context, entry)


def assert_dataset_level(card, complete):
    """Croissant 1.0, "Dataset-level Information"; complete: also the properties that only a user knows."""
    context = card["@context"]
    for prefix, iri in {"cr": "http://mlcommons.org/croissant/", "sc": "https://schema.org/", "dct": "http://purl.org/dc/terms/"}.items():
        assert context[prefix] == iri
    assert context["@vocab"] == "https://schema.org/" and context["data"] == {"@id": "cr:data", "@type": "@json"} and context["dataType"] == {"@id": "cr:dataType", "@type": "@vocab"}
    assert expanded(context, card["@type"]) == "https://schema.org/Dataset" and expanded(context, "conformsTo") == "http://purl.org/dc/terms/conformsTo"
    assert card["conformsTo"] == "http://mlcommons.org/croissant/1.0"
    of_user = {"license", "url", "creator", "datePublished", "version"}
    assert {"@context", "@type", "conformsTo", "name", "description", "distribution"} <= set(card)
    assert of_user & set(card) == (of_user if complete else set())
    if complete:
        assert re.fullmatch(r"\d{4}-\d\d-\d\d", card["datePublished"]) and re.fullmatch(r"\d+\.\d+\.\d+", card["version"]) and card["license"].startswith("https://spdx.org/licenses/")
        assert {expanded(context, creator["@type"]) for creator in card["creator"]} == {"https://schema.org/Person", "https://schema.org/Organization"}
    identified = {}
    for node in nodes(context, card):
        for name in node:
            assert name.startswith("@") or expanded(context, name)
        if "@id" in node and len(node) > 1:
            assert node["@id"] not in identified
            identified[node["@id"]] = node
    assert all(node["@id"] in identified for node in nodes(context, card) if set(node) == {"@id"})


def assert_resources(card, folder):
    """All files of the folder but the two cards themselves, with the checksums of sha256sum."""
    files = {}
    for resource in card["distribution"]:
        file = files[resource["@id"]] = folder / resource["contentUrl"]
        assert resource["@type"] == "cr:FileObject" and resource["sha256"] == sha256(file) and resource["contentSize"] == f"{file.stat().st_size} B"
        assert re.fullmatch(r"[a-z]+/[a-z0-9.+-]+", resource["encodingFormat"])
        assert file.suffix != ".h5" or (resource["encodingFormat"] == "application/x-hdf5" and h5py.is_hdf5(file))
    assert {file.name for file in folder.iterdir()} == {file.name for file in files.values()} | {"README.md", "croissant.json"}
    return len(files)


def record_sets_of(card):
    sets = {entry["@id"]: entry for entry in card["recordSet"]}
    assert set(sets) == {"classes", "samples"}
    for name, record_set in sets.items():
        assert record_set["@type"] == "cr:RecordSet" and record_set["key"]["@id"] in [field["@id"] for field in record_set["field"]]
        for field in record_set["field"]:
            assert field["@type"] == "cr:Field" and field["@id"] == f"{name}/{field['name']}" and ("data" in record_set or "source" in field)
            assert np.atleast_1d(field["dataType"])[0] in ("sc:Integer", "sc:Float", "sc:Text")
    classes = sets["classes"]
    assert classes["dataType"] == "sc:Enumeration" and "classes/name" in [field["@id"] for field in classes["field"]]
    assert all(set(record) == {field["@id"] for field in classes["field"]} for record in classes["data"])
    return classes, {field["source"]["extract"]["column"]: field for field in sets["samples"]["field"]}


def assert_columns(folder, fields):
    """columns.csv: every column of the shards with its unit, and every value. Returns the rows."""
    assert {field["source"]["fileObject"]["@id"] for field in fields.values()} == {"columns.csv"}
    with open(folder / "columns.csv", newline="") as table:
        rows = list(csv.DictReader(table))
    assert list(rows[0]) == list(fields)
    position = 0
    for shard in json.loads((folder / "manifest.json").read_text())["shards"]:
        with h5py.File(folder / shard["file"]) as stored:
            columns = {**stored["samples"], **stored.get("drawn", {})}
            assert set(columns) == set(fields) - {"shard", "row"}
            for name, column in columns.items():
                kind, unit = {"i": "sc:Integer", "f": "sc:Float", "S": "sc:Text"}[column.dtype.kind], column.attrs["units"].decode()
                assert fields[name]["dataType"] == ([kind, "cr:Label"] if name == "label" else kind)
                assert column.attrs["description"].decode() in fields[name]["description"]
                assert kind == "sc:Text" or fields[name]["description"].endswith("dimensionless" if unit == "1" else f"unit {unit}")
                for row, value in zip(rows[position:], column[:]):
                    text = row[name]
                    same = text == value.decode() if kind == "sc:Text" else int(text) == value if kind == "sc:Integer" else (text == "" and math.isnan(value)) or float(text) == value
                    assert same, f"{name}: {text}"
        for row in range(shard["samples"]):
            assert (rows[position + row]["shard"], rows[position + row]["row"]) == (shard["file"], str(row))
        position += shard["samples"]
    assert position == len(rows)
    return rows


def assert_hub_card(folder, card, fields, samples):
    yaml = pytest.importorskip("yaml", reason="needs the package python3-yaml")
    _, front, body = (folder / "README.md").read_text().split("---\n", 2)
    metadata = yaml.safe_load(front)
    assert metadata["pretty_name"] == card["name"] and ("license" in metadata) == ("license" in card)
    assert metadata["size_categories"] == [hub_size_category(samples)] and metadata["configs"][0]["data_files"][0]["path"] == "columns.csv"
    assert set(metadata["task_categories"]) == {"image-classification", "tabular-classification"}
    assert all(f"| `{name}` |" in body for name in fields.keys() - {"shard", "row"})
    for table in re.findall(r"(?:^\|.*\n)+", body, flags=re.M):  # a cell has no bar of its own
        assert len({len(re.findall(r"(?<!\\)\|", line)) for line in table.splitlines()}) == 1, table


@pytest.mark.parametrize("publication, files", [(PUBLICATION, 6), ({}, 6), ({}, 7)], ids=["complete", "nothing given", "merged"])
def test_cards_follow_the_specifications(folder, publication, files):
    if files == 7:
        assert program("merge", folder).returncode == 0
    made = card(folder, **publication)
    assert made == json.loads((folder / "croissant.json").read_text())
    assert_dataset_level(made, complete=bool(publication))
    assert assert_resources(made, folder) == files
    classes, fields = record_sets_of(made)
    rows = assert_columns(folder, fields)
    labels = [int(row["label"]) for row in rows]
    assert {record["classes/label"]: record["classes/samples"] for record in classes["data"]} == {label: labels.count(label) for label in labels}
    assert len(rows) == 40 and "sea.peak_period_s" in fields
    assert_hub_card(folder, made, fields, len(rows))


def test_a_card_invents_neither_licence_nor_person_nor_date(folder):
    with pytest.warns(seaglint.SeaglintWarning, match="Croissant requires license, url, creator, datePublished too") as warned:
        seaglint.Dataset(folder).card()
    assert warned[0].filename == __file__
    assert "## Licence\n\nNot given by those who made this data set.\n" in (folder / "README.md").read_text()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        seaglint.Dataset(folder).card(**PUBLICATION)
    assert "license: cc-by-4.0\n" in (folder / "README.md").read_text()


def test_cards_have_the_same_bytes_in_every_run_and_leave_the_data_set_sound(folder):
    card(folder, **PUBLICATION)
    first = bytes_of(folder)
    card(folder)
    assert bytes_of(folder) != first
    card(folder, **PUBLICATION)
    assert bytes_of(folder) == first
    assert program("verify", folder, "--regenerate", 0).returncode == 0
    resumed = generated(folder, "dataset.maps_per_shard=15", "clutter.enabled=false", "sea.peak_period_s=uniform(7 9)", more=["--resume"])
    assert "0 maps made" in resumed.stdout
    assert bytes_of(folder) == first
    seaglint.Dataset(folder, check=True)


def test_changed_files_of_cards_are_found(folder):
    card(folder)
    columns = folder / "columns.csv"
    columns.write_text(columns.read_text() + "\n")
    with pytest.raises(seaglint.InputError, match=r"croissant\.json: the SHA-256 of 'columns.csv' is another one; make the cards again by Dataset\.card\(\)"):
        seaglint.Dataset(folder, check=True)
    columns.unlink()
    with pytest.raises(seaglint.InputError, match="lists 'columns.csv', which is missing"):
        seaglint.Dataset(folder, check=True)
    card(folder)
    assert len(seaglint.Dataset(folder, check=True)) == 40
    (folder / "croissant.json").write_text('{"distribution": [')
    with pytest.raises(seaglint.InputError, match="croissant.json: not a description of a data set: "):
        seaglint.Dataset(folder, check=True)


def test_cards_replace_no_file_of_the_user(folder):
    for name in ("README.md", "croissant.json", "columns.csv"):
        file, before = folder / name, (folder / name).read_text() if (folder / name).exists() else None
        file.write_text((before or "") + "mine\n")
        assert_refused(folder, f"{file}: {OWN}", lambda: card(folder))
        file.unlink() if before is None else file.write_text(before)
    settings = ("dataset.maps_per_shard=15", "clutter.enabled=false", "sea.peak_period_s=uniform(7 9)")
    (folder / "README.md").write_text("mine\n")
    generated(folder, *settings, more=["--resume"])
    assert (folder / "README.md").read_text() == "mine\n"
    (folder / "README.md").unlink()
    assert_refused(folder, "README.md: no such file; make it again by `seaglint generate", lambda: card(folder))
    generated(folder, *settings, more=["--resume"])
    card(folder)


def test_values_of_another_form_are_refused(folder):
    data = seaglint.Dataset(folder)
    wrong = {"licence": (["CC BY 4.0", "", "-MIT", "free!", 4], "must be an identifier of the SPDX list"),
             "date": (["2026-02-29", "28.2.2026", "2026-2-28", "2026-13-01", "tomorrow"], "must be a date YYYY-MM-DD"),
             "version": (["1.0", "1.0.0.0", "01.0.0", "v1.0.0", "1..0"], "must be MAJOR.MINOR.PATCH"),
             "url": (["example.org", "ftp://example.org", "https://", "https://a b", "https://a>b"], "must begin with https:// or http://"),
             "name": (["two\nlines", "", "\ud800"], "must be one line"), "creators": ([["two\nlines"]], "must be one line"), "organisations": (["A"], "must be a list of names")}
    for argument, (values, bound) in wrong.items():
        for value in values:
            with pytest.raises(seaglint.InputError, match=f"^{argument}: .*{re.escape(bound)}"):
                data.card(**{argument: value})
    assert not (folder / "columns.csv").exists()


def test_licences_have_the_form_of_the_hub(folder):
    def front_of(licence):
        card(folder, licence=licence)
        return (folder / "README.md").read_text(), (folder / "croissant.json").read_text()

    assert "\nlicense: odbl\n" in front_of("ODbL-1.0")[0]
    assert '\nlicense: other\nlicense_name: "GPL-3.0-only"\n' in front_of("GPL-3.0-only")[0]
    front, croissant = front_of("https://example.org/l")
    assert '\nlicense: other\nlicense_link: "https://example.org/l"\n' in front and '"license": "https://example.org/l"' in croissant
    front, croissant = front_of("LicenseRef-mine")
    assert '\nlicense_name: "LicenseRef-mine"\n' in front and "spdx.org" not in croissant
    assert [hub_licence(name) for name in ("CC-BY-SA-4.0", "MIT", "ODC-By-1.0", "GPL-3.0-only")] == ["cc-by-sa-4.0", "mit", "odc-by", None]
    sizes = {1: "n<1K", 999: "n<1K", 1000: "1K<n<10K", 10200: "10K<n<100K", 999999999: "100M<n<1B", 10**9: "1B<n<10B"}
    assert {samples: hub_size_category(samples) for samples in sizes} == sizes


def test_cards_of_a_damaged_data_set_are_not_made(folder):
    os.truncate(folder / "shard_00001.h5", (folder / "shard_00001.h5").stat().st_size - 10)
    assert_refused(folder, "shard_00001.h5: truncated or changed", lambda: card(folder))


def test_a_merged_file_of_another_set_is_named_and_left_out(folder, data_set):
    assert program("merge", data_set, "-o", folder / "dataset.h5").returncode == 0
    with pytest.warns(seaglint.SeaglintWarning, match="dataset.h5: is of another manifest"):
        made = seaglint.Dataset(folder).card(**PUBLICATION)
    assert "dataset.h5" not in [resource["name"] for resource in made["distribution"]]


def test_cards_cite_the_program_as_citation_cff_does(folder):
    yaml = pytest.importorskip("yaml", reason="needs the package python3-yaml")
    cff = yaml.safe_load(pathlib.Path(seaglint.data_folder(), "CITATION.cff").read_text())
    cited = card(folder)["citeAs"]
    assert all("= {" + value + "}" in cited for value in (cff["title"], cff["version"], "{" + cff["authors"][0]["name"] + "}"))


def test_cards_name_the_classes_of_a_scenario(tmp_path):
    generated(tmp_path / "set", "dataset.classes=[decoys, guarded ship]", "dataset.maps_per_case=2", "dataset.realisations_per_case=1")
    made = card(tmp_path / "set")
    assert [record["classes/name"] for record in record_sets_of(made)[0]["data"]] == ["decoys", "guarded ship"]


def test_what_a_spreadsheet_would_run_has_an_apostrophe():
    from seaglint._handover import _cell

    assert [_cell(value) for value in ("=1+1", " @a", "plain", "a\nb", 0.1, None)] == ["'=1+1", "' @a", "plain", "a b", "0.1", ""]


@pytest.mark.parametrize("call", ["replace", "fsync"])
def test_a_write_that_fails_leaves_the_earlier_files(folder, monkeypatch, call):
    card(folder, **PUBLICATION)
    before = bytes_of(folder)

    def full(*_):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, call, full)
    with pytest.raises(seaglint.WorkError, match="columns.csv: cannot write: No space left on device"):
        card(folder)
    with pytest.raises(seaglint.WorkError, match="description.json: cannot write: No space left on device"):
        seaglint.Dataset(folder).to_webdataset(folder.parent / "tar")
    assert bytes_of(folder) == before and list((folder.parent / "tar").iterdir()) == []


# WebDataset.


def samples_of(archive):
    """Grouped as the WebDataset library does: adjacent files whose names agree up to the first dot."""
    with tarfile.open(archive, "r:") as tar:
        members = tar.getmembers()
        for member in members:
            assert member.isreg() and member.mode == 0o644 and (member.uid, member.gid, member.mtime, member.uname, member.gname) == (0, 0, 0, "", "")
        for key, group in itertools.groupby([member.name for member in members], key=lambda name: name.split(".", 1)[0]):
            yield key, {name.split(".", 1)[1]: tar.extractfile(name).read() for name in group}


def array(content):
    return np.load(io.BytesIO(content), allow_pickle=False)


def assert_sample(key, files, stored, columns, row, description):
    """The files of a sample against a row of its shard."""
    assert set(files) == set(description["files"]) | {"cls", "json"}
    assert array(files["map.npy"]).dtype == np.float32
    np.testing.assert_array_equal(array(files["map.npy"]), stored["maps"][row])
    np.testing.assert_array_equal(array(files["hop_code.npy"]), stored["hop_code"][row])
    np.testing.assert_array_equal(array(files["centres.npy"]), stored["centres"][row, :columns["centres"][row]])
    assert ("complex.npy" in files) == ("maps_complex" in stored)
    if "complex.npy" in files:
        assert array(files["complex.npy"]).dtype == np.complex64
        np.testing.assert_array_equal(array(files["complex.npy"]), stored["maps_complex"][row].view(np.complex64)[..., 0])
    record = json.loads(files["json"])
    assert list(record) == list(description["columns"]) and set(record) == set(columns)
    assert int(key) == record["sample"] and int(files["cls"]) == record["label"]
    for name, value in record.items():
        there = columns[name][row]
        assert value == (there.decode() if there.dtype.kind == "S" else there) or (value is None and math.isnan(there)), name


def read_archives(folder, export):
    """Compares an export with the shards; returns the numbers of archives and samples."""
    index, description = json.loads((export / "index.json").read_text()), json.loads((export / "description.json").read_text())
    assert description["manifest_sha256"] == sha256(folder / "manifest.json")
    exported = []
    for shard in index["shardlist"]:
        samples = list(samples_of(export / shard["url"]))
        assert (shard["sha256"], shard["filesize"], shard["nsamples"]) == (sha256(export / shard["url"]), (export / shard["url"]).stat().st_size, len(samples))
        exported += samples
    keys = [key for key, _ in exported]
    assert keys == sorted(set(keys)) and sorted(file.name for file in export.glob("*.tar")) == [shard["url"] for shard in index["shardlist"]]
    following = iter(exported)
    for shard in json.loads((folder / "manifest.json").read_text())["shards"]:
        with h5py.File(folder / shard["file"]) as stored:
            arrays = {**stored["samples"], **stored.get("drawn", {})}
            for name in ("range_m", "velocity_mps"):
                np.testing.assert_array_equal(description["axes"][name], stored[f"axes/{name}"][:])
            assert all(description["columns"][name]["units"] == column.attrs["units"].decode() for name, column in arrays.items())
            columns = {name: column[:] for name, column in arrays.items()}
            for row in range(shard["samples"]):
                assert_sample(*next(following), stored, columns, row, description)
    assert next(following, None) is None
    return len(index["shardlist"]), len(exported)


def test_archives_have_the_arrays_and_rows_of_the_shards(data_set, tmp_path):
    assert seaglint.Dataset(data_set).to_webdataset(tmp_path / "tar", max_tar_mb=1) == 4
    archives = list((tmp_path / "tar").glob("*.tar"))
    assert all(file.stat().st_size <= 1000000 and file.stat().st_size % 10240 == 0 for file in archives)
    assert read_archives(data_set, tmp_path / "tar") == (4, 40)


def test_archives_have_complex_maps_drawn_keys_and_null_where_there_is_no_number(tmp_path):
    generated(tmp_path / "set", "dataset.complex_maps=true", "clutter.enabled=false", "dataset.maps_per_case=5", "sea.peak_period_s=uniform(7 9)")
    assert seaglint.Dataset(tmp_path / "set").to_webdataset(tmp_path / "tar") == 1
    assert read_archives(tmp_path / "set", tmp_path / "tar") == (1, 20)


def test_archives_have_the_same_bytes_in_every_run_and_replace_those_of_their_data_set_alone(data_set, folder, tmp_path):
    data, out = seaglint.Dataset(data_set), tmp_path / "tar"
    assert data.to_webdataset(out, 0.2) > data.to_webdataset(out, 1)
    assert data.to_webdataset(tmp_path / "again", 1) == 4
    before = bytes_of(out)
    assert bytes_of(tmp_path / "again") == before and read_archives(data_set, out) == (4, 40)
    assert_refused(out, "which is not of this data set's export; choose a new directory", lambda: seaglint.Dataset(folder).to_webdataset(out))
    (out / "notes.txt").write_text("mine")
    assert_refused(out, "the directory contains notes.txt", lambda: data.to_webdataset(out))


def test_bounds_and_places_that_cannot_be_are_refused(data_set, tmp_path):
    data, out = seaglint.Dataset(data_set), tmp_path / "tar"
    data.to_webdataset(out, 1)
    assert_refused(out, "max_tar_mb: value 0.05: an archive of sample 000000000 alone has 81920 bytes, more than the limit of 50000", lambda: data.to_webdataset(out, 0.05))
    for limit in (0, math.nan, 2e6):
        assert_refused(out, "max_tar_mb: value", lambda: data.to_webdataset(out, limit))
    assert_refused(out, "must be a directory", lambda: data.to_webdataset(out / "new.tar"))
    assert_refused(data_set, "is the data set itself", lambda: data.to_webdataset(data_set))
    (tmp_path / "file").write_text("")
    assert_refused(out, "is a file, not a directory", lambda: data.to_webdataset(tmp_path / "file"))


def test_archives_of_a_damaged_data_set_have_no_index(data_set, tmp_path):
    """What has its final name is whole, and no index says that the export is complete."""
    copy, out = pathlib.Path(shutil.copytree(data_set, tmp_path / "set")), tmp_path / "tar"
    os.truncate(copy / "shard_00003.h5", (copy / "shard_00003.h5").stat().st_size - 10)
    with pytest.raises(seaglint.InputError, match="shard_00003.h5: truncated or changed"):
        seaglint.Dataset(copy).to_webdataset(out, 1)
    seaglint.Dataset(data_set).to_webdataset(tmp_path / "whole", 1)
    whole = bytes_of(tmp_path / "whole")
    assert "index.json" not in bytes_of(out) and all(whole[name] == content for name, content in bytes_of(out).items())


@pytest.mark.parametrize("trick", ["external storage", "external link", "soft link", "other filter"])
def test_no_other_file_is_read_by_a_shard_made_to_deceive(folder, tmp_path, trick):
    secret, shard = tmp_path / "secret", folder / "shard_00000.h5"
    secret.write_bytes(b"\x01" * 200)
    with h5py.File(tmp_path / "other.h5", "w") as other:
        other["label"] = np.zeros(15, np.int64)
    with h5py.File(shard, "a") as file:
        units = dict(file["samples/label"].attrs)
        del file["samples/label"]
        if trick == "external storage":
            file.create_dataset("samples/label", (15,), "<i8", external=[(str(secret), 0, 120)])
        elif trick == "other filter":
            file.create_dataset("samples/label", (15,), "<i8", chunks=(15,), compression="gzip")
        else:
            file["samples/label"] = h5py.ExternalLink(tmp_path / "other.h5", "label") if trick == "external link" else h5py.SoftLink("/samples/target")
        if trick in ("external storage", "other filter"):
            file["samples/label"].attrs.update(units)
    manifest = json.loads((folder / "manifest.json").read_text())
    manifest["shards"][0]["sha256"] = hashlib.sha256(shard.read_bytes()).hexdigest()
    (folder / "manifest.json").write_text(json.dumps(manifest))
    for call in (lambda: card(folder), lambda: seaglint.Dataset(folder).to_webdataset(tmp_path / "tar")):
        assert_refused(folder, "shard_00000.h5: samples/label is not stored as this program does", call)


# PyAEDT.


@pytest.fixture(scope="module")
def sweep():
    frequencies, azimuth, elevation = [9.5e9, 10e9, 10.5e9], [0, 10, 20, 30], [2, 5]
    return seaglint.rcs(REFLECTOR, frequencies, azimuth, elevation), frequencies, azimuth, elevation


def test_pyaedt_files_are_opened_by_pandas(sweep, tmp_path):
    pandas = pytest.importorskip("pandas", reason="needs the package python3-pandas")
    pytest.importorskip("tables", reason="needs the package python3-tables")
    assert [file.name for file in seaglint.write_pyaedt(tmp_path / "own", *sweep)] == ["own VV.json", "own HV.json", "own VH.json", "own HH.json"]
    description = json.loads((tmp_path / "own HV.json").read_text())
    assert (description["monostatic_file"], description["frequency_units"]) == ("own HV.h5", "GHz")
    frame = pandas.read_hdf(tmp_path / description["monostatic_file"])
    assert list(frame.index.names) == ["Freq", "IWavePhi", "IWaveTheta"] and list(frame.columns) == ["data"] and frame["data"].dtype == complex
    assert len(frame) == 24 and len(pandas.read_hdf(tmp_path / "own HV.h5", "df", where="IWaveTheta > 86")) == 12
    values, frequencies, azimuth, elevation = sweep
    for (q, f), (e, up), (a, turn) in itertools.product(enumerate(frequencies), enumerate(elevation), enumerate(azimuth)):
        assert frame.loc[(f / 1e9, turn, 90 - up), "data"] == -math.sqrt(4 * math.pi) * values[q, e, a, 0, 1]  # hv along -phi^ = -h


def test_pyaedt_files_are_read_back_as_the_same_sweep(sweep, tmp_path):
    pytest.importorskip("tables", reason="needs the package python3-tables")
    files = seaglint.write_pyaedt(tmp_path / "own", *sweep)
    for file, element in zip(files, ("vv", "hv", "vh", "hh")):
        entry, = seaglint.compare(file, target=REFLECTOR, as_is=True)["exports"]
        assert entry["polarisation"] == element and entry["pairs"] == 24
        assert entry["rms_db"] < 1e-6 and entry["correlation"] > 1 - 1e-12


def test_a_folder_of_pyaedt_files_names_its_geometry(tmp_path):
    """Neither a target nor a list of files is needed; the folder's own results are no exports."""
    pytest.importorskip("tables", reason="needs the package python3-tables")
    exports, dihedral = tmp_path / "exports", pathlib.Path(__file__).resolve().parents[1] / "cases/exports/dihedral.obj"
    (exports / "geometry").mkdir(parents=True)
    text = dihedral.read_text()
    vertices = text[:text.index("f 1")]
    (exports / "geometry/left.obj").write_text(vertices + "f 1 2 3 4\n")
    (exports / "geometry/right.obj").write_text(vertices + "f 5 1 4 6\n")
    azimuth = np.arange(-20, 21, 4)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", seaglint.SeaglintWarning)  # an open sheet
        values = seaglint.rcs(dihedral, 6e9, azimuth, 8)
    info = {"left": ["left.obj", [143, 175, 143], 1.0, "meter"], "right": ["right.obj", [143, 0, 0], 1.0, "meter"]}
    seaglint.write_pyaedt(exports / "own", values, 6e9, azimuth, 8, model_info=info)
    (exports / "notes.txt").write_text("measured on a Monday\n")
    one = program("compare", exports / "own VV.json", "--tolerance-db", "0.001", "-o", tmp_path / "compared")
    assert one.returncode == 0 and "target as the export names it: " in one.stderr, one.stderr + one.stdout
    whole = program("compare", exports, "--tolerance-db", "0.001", "-o", exports)
    assert whole.returncode == 0 and "exports: 4 tables; not read as tables: notes.txt, own HH.h5" in whole.stderr, whole.stderr + whole.stdout
    assert len(json.loads((exports / "compare.json").read_text())["exports"]) == 4
    assert program("compare", exports, "-o", exports).returncode == 0
    parts = program("compare", exports, "--target", exports / "geometry/left.obj", "--target", exports / "geometry/right.obj", "--tolerance-db", "0.001", "-o", tmp_path / "compared")
    assert parts.returncode == 0, parts.stderr + parts.stdout
    (exports / "geometry/left.obj").unlink()
    missing = program("compare", exports / "own VV.json", "-o", tmp_path / "compared")
    assert missing.returncode == 2 and "own VV.json names no geometry that is beside it" in missing.stderr
    none = program("compare", exports / "geometry", "--target", REFLECTOR, "-o", tmp_path / "compared")
    assert none.returncode == 2 and "no file in this folder is a table" in none.stderr


def test_what_pyaedt_files_cannot_hold_is_refused(sweep, tmp_path):
    pytest.importorskip("tables", reason="needs the package python3-tables")
    values, frequencies, azimuth, elevation = sweep
    with pytest.raises(seaglint.InputError, match=r"values: shape \(3, 2, 4, 2, 2\): must be \(3, 2, 3, 2, 2\)"):
        seaglint.write_pyaedt(tmp_path / "own", values, frequencies, azimuth[:3], elevation)
    with pytest.raises(seaglint.InputError, match="values: must be finite"):
        seaglint.write_pyaedt(tmp_path / "own", values * math.nan, frequencies, azimuth, elevation)
    with pytest.raises(seaglint.InputError, match="elevation_deg: value 91.0: must be within -90 and 90"):
        seaglint.write_pyaedt(tmp_path / "own", values, frequencies, azimuth, [2, 91])
    with pytest.raises(seaglint.WorkError, match="cannot write"):
        seaglint.write_pyaedt(tmp_path / "no folder/own", *sweep)
    assert list(tmp_path.iterdir()) == []
