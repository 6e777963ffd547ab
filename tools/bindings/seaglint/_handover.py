# SPDX-License-Identifier: BSD-3-Clause
"""Forms in which results are handed to others: the cards of a data set (README.md with metadata of the Hugging Face Hub,
croissant.json, columns.csv), tar archives in the WebDataset layout, and PyAEDT's pairs of files.

Every file appears whole or not at all. The bytes of cards and archives depend only on the data set and the arguments.
"""
from __future__ import annotations

import contextlib
import csv
import datetime
import fcntl
import hashlib
import io
import json
import math
import os
import pathlib
import re
import secrets
import tarfile
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from ._common import axis, number
from ._core import InputError, WorkError

_REMEDY = "make it again by `seaglint generate SCENARIO -o DIR --resume`"


@contextlib.contextmanager
def _whole(file):
    """A binary stream to a file that gets its name when all is written. Other processes see the lock of its temporary
    name and leave it alone."""
    temporary = file.with_name(f"{file.name}.{secrets.token_hex(8)}.tmp")
    try:
        with open(temporary, "xb") as stream:
            with contextlib.suppress(OSError):  # a file system without locks
                fcntl.lockf(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
            yield stream
            stream.flush()
            os.fsync(stream.fileno())
            os.replace(temporary, file)
    except OSError as error:
        raise WorkError(f"{file}: cannot write: {error.strerror or error}") from None
    finally:
        with contextlib.suppress(OSError):
            temporary.unlink()


def _write(file, text):
    with _whole(file) as stream:
        stream.write(text.encode())


def _json_text(value):
    return json.dumps(value, indent=2, ensure_ascii=False) + "\n"


def _sha256(file):
    try:
        return hashlib.sha256(file.read_bytes()).hexdigest()
    except OSError as error:
        raise InputError(f"{file}: {error.strerror}") from None


def _text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


class _Stored:
    """The arrays and columns of one shard, whose SHA-256 is that of the manifest."""

    def __init__(self, data, index):
        import h5py

        entry = data.manifest["shards"][index]
        self.file = data.folder / entry["file"]
        try:
            content = self.file.read_bytes()
        except OSError as error:
            raise InputError(f"{self.file}: {error.strerror}") from None
        if hashlib.sha256(content).hexdigest() != entry["sha256"]:
            raise InputError(f"{self.file}: truncated or changed: its checksum is not the manifest's; {_REMEDY}")
        self._bytes, self.count = len(content), int(entry["samples"])
        try:
            with h5py.File(io.BytesIO(content), "r") as file:
                self._read(file, [column["name"] for column in data.manifest["columns"]])
        except (OSError, KeyError, RuntimeError, TypeError, ValueError) as error:
            if isinstance(error, InputError):
                raise
            raise InputError(f"{self.file}: not a shard: {error}") from None
        if self.arrays["maps"].shape != (self.count, *([data.looks] if data.looks > 1 else []), *data.map_shape):
            raise InputError(f"{self.file}: does not contain what the manifest lists")

    def _array(self, file, path, rows=True):
        """Values of an array in chunks of this file, reached by hard links: no other file is read."""
        import h5py

        links = [file.get(path[:end], getlink=True) for end in [*(at.start() for at in re.finditer("/", path)), len(path)]]
        array = file[path]
        filters = array.id.get_create_plist().get_nfilters()
        if not all(isinstance(link, h5py.HardLink) for link in links) or not array.chunks or array.is_virtual or filters != 1 or not array.fletcher32 or array.nbytes > self._bytes:
            raise InputError(f"{self.file}: {path} is not stored as this program does")
        if rows and array.shape[0] != self.count:
            raise InputError(f"{self.file}: {path} has {array.shape[0]} rows, not {self.count}")
        self.text[path] = tuple(_text(array.attrs[name]) for name in ("units", "description"))
        values = array[...]
        return np.char.decode(values, "utf-8") if values.dtype.kind == "S" else values

    def _read(self, file, columns):
        self.text = {}  # (unit, description) of every array
        self.arrays = {name: self._array(file, name) for name in ("maps", "hop_code", "centres")}
        if "maps_complex" in file:
            self.arrays["maps_complex"] = self._array(file, "maps_complex").view(np.complex64)[..., 0]
        self.axes = {name: self._array(file, f"axes/{name}", rows=False) for name in ("velocity_mps", "range_m")}
        paths = {name: f"samples/{name}" for name in columns}
        self.drawn = [key for name in ("drawn_numbers", "drawn_words") for key in _text(file.attrs.get(name, "")).split()]
        paths.update((key, f"drawn/{key}") for key in self.drawn)
        self.columns = {name: self._array(file, path) for name, path in paths.items()}
        self.column_text = {name: self.text[path] for name, path in paths.items()}

    def rows(self):
        """The values of the columns, one tuple for each sample; a number that is none is None."""
        rows = zip(*(values.tolist() for values in self.columns.values()))
        return [tuple(None if isinstance(value, float) and math.isnan(value) else value for value in row) for row in rows]


def _stored_shards(data):
    return (_Stored(data, index) for index in range(len(data.manifest["shards"])))


# Cards.

_SIGNATURE = "<!-- data card of seaglint, SHA-256 of the text above: "
_ADDED = "\n## Files beside the shards\n\n"

# Identifiers of the Hub that are SPDX's in lower case (Hub documentation, "Licenses"), and those that differ.
_HUB_LICENCES = set("""afl-3.0 apache-2.0 artistic-2.0 bsd-2-clause bsd-3-clause bsd-3-clause-clear bsl-1.0 cc-by-2.0 cc-by-2.5 cc-by-3.0
cc-by-4.0 cc-by-nc-2.0 cc-by-nc-3.0 cc-by-nc-4.0 cc-by-nc-nd-3.0 cc-by-nc-nd-4.0 cc-by-nc-sa-2.0 cc-by-nc-sa-3.0 cc-by-nc-sa-4.0
cc-by-nd-4.0 cc-by-sa-3.0 cc-by-sa-4.0 cc0-1.0 cdla-permissive-1.0 cdla-permissive-2.0 cdla-sharing-1.0 ecl-2.0 epl-1.0 epl-2.0
etalab-2.0 eupl-1.1 isc lppl-1.3c mit mpl-2.0 ms-pl ncsa ofl-1.1 osl-3.0 postgresql unlicense wtfpl zlib""".split())
_RENAMED_LICENCES = {"c-uda-1.0": "c-uda", "odbl-1.0": "odbl", "odc-by-1.0": "odc-by", "pddl-1.0": "pddl"}


def _is_url(text):
    return text.startswith(("https://", "http://"))


def _require(argument, value, is_good, bound):
    if value is not None and not (isinstance(value, str) and is_good(value)):
        raise InputError(f"{argument}: value {value!r}: {bound}")


def _is_date(text):
    try:
        return re.fullmatch(r"\d{4}-\d\d-\d\d", text, re.ASCII) is not None and bool(datetime.date.fromisoformat(text))
    except ValueError:
        return False


def _is_line(text):
    return bool(text) and not re.search(r"[\x00-\x1f\x7f\ud800-\udfff]", text)


def _is_good_url(text):
    return re.fullmatch(r"""https?://[^\s\x00-\x20\x7f-\U0010ffff<>"{}|\\^`]+""", text) is not None


def check_publication(name, licence, creators, organisations, url, date, version):
    """Raises InputError unless each has its form; None: not given."""
    _require("name", name, _is_line, "must be one line without control characters")
    _require("licence", licence, lambda text: _is_good_url(text) or re.fullmatch("[A-Za-z0-9][A-Za-z0-9.+-]*", text), "must be an identifier of the SPDX list such as CC-BY-4.0, LicenseRef-NAME, or a URL")
    for argument, names in (("creators", creators), ("organisations", organisations)):
        if isinstance(names, str):
            raise InputError(f"{argument}: must be a list of names, not {names!r}")
        for one in names:
            _require(argument, one, _is_line, "must be one line without control characters")
    _require("url", url, _is_good_url, "must begin with https:// or http://")
    _require("date", date, _is_date, "must be a date YYYY-MM-DD")
    _require("version", version, lambda text: re.fullmatch(r"(0|[1-9]\d*)(\.(0|[1-9]\d*)){2}", text, re.ASCII), "must be MAJOR.MINOR.PATCH, such as 1.0.0")
    return {"name": name, "licence": licence, "creators": list(creators), "organisations": list(organisations), "url": url, "date": date, "version": version}


def hub_licence(spdx: str) -> str | None:
    """The Hub's identifier of a licence of the SPDX list; None if it has none."""
    lower = spdx.lower()
    return _RENAMED_LICENCES.get(lower, lower if lower in _HUB_LICENCES else None)


def hub_size_category(samples: int) -> str:
    """"n<1K", "1K<n<10K", ... with the lower bound included."""
    bounds = ["1K", "10K", "100K", "1M", "10M", "100M", "1B", "10B"]
    above = sum(samples >= 1000 * 10**k for k in range(len(bounds) - 1))
    return f"n<{bounds[0]}" if above == 0 else f"{bounds[above - 1]}<n<{bounds[above]}"


def _is_unchanged(text):
    above = text[:max(text.rfind(_SIGNATURE), 0)]
    return bool(above) and text == _signed(above)


def _signed(text):
    return f"{text}{_SIGNATURE}{hashlib.sha256(text.encode()).hexdigest()} -->\n"


def _is_own_croissant(text):
    try:
        return json.loads(text)["isBasedOn"]["name"] == "seaglint"
    except (ValueError, KeyError, TypeError):
        return False


def _require_own(file, is_own):
    """A file of the user is not replaced; returns the text of one that `seaglint` wrote."""
    if not file.is_symlink() and not file.exists():
        return None
    text = file.read_text(encoding="utf-8", errors="replace") if file.is_file() else ""
    if not is_own(text):
        raise InputError(f"{file}: was not written by seaglint, or was changed since; move it away or remove it")
    return text


def _data_card(file):
    """The text of README.md as `generate` writes it, without what the cards add."""
    text = _require_own(file, _is_unchanged)
    if text is None:
        raise InputError(f"{file}: no such file; {_REMEDY}")
    text = text[:text.rfind(_SIGNATURE)]
    if text.startswith("---\n"):
        text = text.split("---\n", 2)[2]
    return text.partition(_ADDED)[0]


def _cell(value):
    if value is None:
        return ""
    if not isinstance(value, str):
        return repr(value)
    line = "".join(c if c.isprintable() else " " for c in value)
    return "'" + line if line.lstrip(" ").startswith(("=", "+", "-", "@")) else line  # a spreadsheet would run it


def _write_columns(data, file):
    """columns.csv; returns the first shard without its maps, and the samples and targets of each label."""
    first, labels = None, {}
    with _whole(file) as stream:
        text = io.TextIOWrapper(stream, encoding="utf-8", newline="", write_through=True)
        table = csv.writer(text, lineterminator="\n")
        for stored in _stored_shards(data):
            fixed = len(stored.columns) - len(stored.drawn)  # shard and row stand before the drawn columns
            if first is None:
                first = stored
                first.arrays = {name: values[:0] for name, values in stored.arrays.items()}
                names = [*stored.columns]
                table.writerow([*names[:fixed], "shard", "row", *names[fixed:]])
            elif list(stored.columns) != list(first.columns):
                raise InputError(f"{stored.file}: its columns are not those of {first.file.name}")
            for row, values in enumerate(stored.rows()):
                cells = [_cell(value) for value in values]
                table.writerow([*cells[:fixed], _cell(stored.file.name), row, *cells[fixed:]])
            for label, target, name in zip(*(stored.columns[column].tolist() for column in ("label", "target", "target_name"))):
                of_label = labels.setdefault(label, [0, {}])
                of_label[0] += 1
                of_label[1][target] = name
        text.detach()
    return first, labels


def _context():
    """The context of the specification's appendix 1, with the prefixes of its section "Namespaces" and the terms of its
    text that the appendix leaves out."""
    terms = {"@language": "en", "@vocab": "https://schema.org/", "cr": "http://mlcommons.org/croissant/", "dct": "http://purl.org/dc/terms/", "sc": "https://schema.org/", "conformsTo": "dct:conformsTo"}
    terms.update((term, f"cr:{term}") for term in """citeAs column extract field fileObject fileProperty fileSet format includes isLiveDataset jsonPath key md5 parentField path
        recordSet references regex repeated replace separator source subField transform""".split())
    terms.update((term, {"@id": f"cr:{term}", "@type": "@json"}) for term in ("data", "examples"))
    return {**terms, "dataType": {"@id": "cr:dataType", "@type": "@vocab"}}


def merged_file(folder: pathlib.Path) -> tuple[pathlib.Path | None, list[str]]:
    """dataset.h5 if it is merged from these shards; a warning if it is merged from others."""
    import h5py

    file = folder / "dataset.h5"
    try:
        with h5py.File(file, "r") as merged:
            if not _text(merged.attrs.get("format", "")).startswith("seaglint merged "):
                return None, []
            if _text(merged.attrs.get("manifest_sha256", "")) == _sha256(folder / "manifest.json"):
                return file, []
    except OSError:
        return None, []
    return None, [f"{file}: is of another manifest than the shards beside it; merge again or remove it"]


def _distribution(data):
    def entry(file, form, description, sha256):
        return {"@type": "cr:FileObject", "@id": file.name, "name": file.name, "description": description, "contentUrl": file.name,
                "contentSize": f"{file.stat().st_size} B", "encodingFormat": form, "sha256": sha256}

    files = [("columns.csv", "text/csv", "columns of all samples, with shard and row of each map"), ("scenario.yaml", "application/yaml", "scenario: every key with its value"),
             ("inputs.sha256", "text/plain", "SHA-256 of the files that the scenario names"), ("manifest.json", "application/json", "shards in order, version, seed")]
    if merged_file(data.folder)[0]:
        files.append(("dataset.h5", "application/x-hdf5", "all shards as one file, whose maps are read from the shards"))
    listed = [entry(data.folder / name, form, text, _sha256(data.folder / name)) for name, form, text in files if (data.folder / name).is_file()]
    for shard in data.manifest["shards"]:
        first = shard["first_sample"]
        listed.append(entry(data.folder / shard["file"], "application/x-hdf5", f"samples {first} to {first + shard['samples'] - 1}", shard["sha256"]))
    return listed


def _class_records(data, labels):
    """Labels with the names of the classes or, where the scenario gives none, of the targets."""
    def field(name, kind, description):
        return {"@type": "cr:Field", "@id": f"classes/{name}", "name": name, "description": description, "dataType": kind}

    named = "classes" in data.manifest
    records = []
    for label, (count, targets) in sorted(labels.items()):
        name = data.classes[label] if named else ", ".join(targets[target] for target in sorted(targets))
        records.append({"classes/label": label, "classes/name": name, "classes/samples": count})
    return {"@type": "cr:RecordSet", "@id": "classes", "name": "classes", "description": "classes of the targets", "dataType": "sc:Enumeration", "key": {"@id": "classes/label"},
            "field": [field("label", "sc:Integer", "value of the column label"), field("name", "sc:Text", "name of the class" if named else "targets of the scenario that are of this class"),
                      field("samples", "sc:Integer", "samples of this class")], "data": records}


def _sample_records(first):
    kinds = {"i": "sc:Integer", "f": "sc:Float", "U": "sc:Text"}
    entries = [(name, kinds[values.dtype.kind], *first.column_text[name]) for name, values in first.columns.items()]
    place = [("shard", "sc:Text", "", "HDF5 file that has the sample's map"), ("row", "sc:Integer", "1", "row of the sample in the arrays of that file, from 0")]
    at = len(entries) - len(first.drawn)
    fields = []
    for name, kind, unit, description in entries[:at] + place + entries[at:]:
        meaning = description if kind == "sc:Text" else f"{description}; dimensionless" if unit == "1" else f"{description}; unit {unit}"
        field = {"@type": "cr:Field", "@id": f"samples/{name}", "name": name, "description": meaning, "dataType": [kind, "cr:Label"] if name == "label" else kind,
                 "source": {"fileObject": {"@id": "columns.csv"}, "extract": {"column": name}}}
        if name == "label":
            field["references"] = {"field": {"@id": "classes/label"}}
        fields.append(field)
    return {"@type": "cr:RecordSet", "@id": "samples", "name": "samples", "description": "one record for each map: its class, sea, view, keys, signal-to-clutter ratios and features",
            "key": {"@id": "samples/sample"}, "field": fields}


def _description(data, first, targets):
    manifest, columns = data.manifest, data.columns
    views = "a view drawn for each observation" if any(key.startswith("view.") for key in first.drawn) else f"{len(np.unique(columns['view']))} views"
    arrays = ", ".join(f"/{path} ({description}; {unit})" for path, (unit, description) in first.text.items() if not path.startswith(("samples/", "drawn/")))
    has_targets = columns["bodies"].any()
    what = f"{targets} radar targets at sea" if has_targets else "the sea without a target"
    use = ", for the classification of targets by their label" if has_targets else ""
    return (f"{manifest['samples']} range-velocity maps of {what} ({len(np.unique(columns['sea_key']))} independent sea realisations, {views}){use}. "
            f"Synthetic: simulated by seaglint {manifest['program_version']} with seed {manifest['seed']}; nothing was measured. "
            f"A map has {data.map_shape[0]} velocity cells and {data.map_shape[1]} range cells. Arrays of the HDF5 shards: {arrays}, and the columns of the record set samples in "
            "/samples. All samples of one group (one sea realisation) belong on one side of a split.")


def _croissant(data, first, labels, publication, citation):
    """The content of croissant.json (Croissant 1.0, http://mlcommons.org/croissant/1.0)."""
    licence = publication["licence"]
    card = {"@context": _context(), "@type": "sc:Dataset", "conformsTo": "http://mlcommons.org/croissant/1.0", "name": publication["name"] or data.manifest["scenario"],
            "description": _description(data, first, sum(len(targets) for _, targets in labels.values()))}
    if licence:
        card["license"] = licence if _is_url(licence) else {"@type": "sc:CreativeWork", "name": licence} if licence.startswith("LicenseRef-") else f"https://spdx.org/licenses/{licence}"
    creators = [{"@type": f"sc:{kind}", "name": name} for kind, names in (("Person", publication["creators"]), ("Organization", publication["organisations"])) for name in names]
    given = {"url": publication["url"], "creator": creators, "datePublished": publication["date"], "version": publication["version"]}
    card.update((key, value) for key, value in given.items() if value)
    return {**card, "keywords": ["radar", "range-velocity map", "frequency agility", "sea clutter", "synthetic"], "citeAs": citation, "isLiveDataset": False,
            "isBasedOn": {"@type": "sc:SoftwareApplication", "name": "seaglint", "softwareVersion": data.manifest["program_version"]},
            "distribution": _distribution(data), "recordSet": [_class_records(data, labels), _sample_records(first)]}


def _front_matter(title, licence, samples):
    """Metadata of the Hub. The one split has a name of its own: `train` would suggest that others exist."""
    lines = [f"pretty_name: {json.dumps(title, ensure_ascii=False)}"]  # a double-quoted string of JSON is one of YAML
    if licence:
        known = hub_licence(licence)
        lines.append(f"license: {known or 'other'}")
        if not known:
            lines.append(f"license_{'link' if _is_url(licence) else 'name'}: {json.dumps(licence, ensure_ascii=False)}")
    lines += ["task_categories:", "- image-classification", "- tabular-classification", "size_categories:", f"- {hub_size_category(samples)}", "source_datasets:", "- original",
              "annotations_creators:", "- machine-generated", "tags:", "- radar", "- range-velocity map", "- frequency agility", "- sea clutter", "- synthetic",
              "configs:", "- config_name: columns", "  data_files:", "  - split: samples", "    path: columns.csv"]
    return "\n".join(["---", *lines, "---", ""])


def _markdown(text):
    return re.sub(r"([\\`*\[\]<>|&~#])", r"\\\1", text)


def _sections(publication, citation):
    licence, makers = publication["licence"], "; ".join(_markdown(name) for name in publication["creators"] + publication["organisations"])
    text = (f"{_ADDED}`columns.csv` has the columns of all samples in one table, with file (`shard`) and row (`row`) of every map; `croissant.json` describes the data set\n"
            "in the Croissant format, with the SHA-256 of every file.\n\n## Licence\n\n")
    text += "Not given by those who made this data set.\n" if not licence else f"<{licence}>\n" if _is_url(licence) else f"{_markdown(licence)}\n"
    text += f"\nMade by {makers}.\n" if makers else ""
    text += f"\n<{publication['url']}>\n" if publication["url"] else ""
    return f"{text}\n## Citation of the simulator\n\n```bibtex\n{citation}\n```\n"


def write_cards(data, publication: dict) -> tuple[dict, list[str]]:
    """Dataset.card(): the dictionary of croissant.json, and warnings."""
    folder, version = data.folder, data.manifest["program_version"]
    names = [column["name"] for column in data.manifest["columns"]]
    body = _data_card(folder / "README.md")
    _require_own(folder / "croissant.json", _is_own_croissant)
    _require_own(folder / "columns.csv", lambda text: text.startswith(",".join([*names, "shard", "row"])))
    if _sha256(folder / "scenario.yaml") != data.manifest["scenario_sha256"]:
        raise InputError(f"{folder / 'scenario.yaml'}: is not the one that the manifest was written for; bring that one back, or go on with another `learning` by `seaglint generate SCENARIO -o DIR --resume`")
    if not re.fullmatch("[A-Za-z0-9][A-Za-z0-9.+-]*", version):
        raise InputError(f"{folder / 'manifest.json'}: program_version: {version!r}: must be letters, digits, -, . and +")
    citation = f"@software{{seaglint,\n  title = {{seaglint}},\n  author = {{{{The seaglint authors}}}},\n  version = {{{version}}}\n}}"
    first, labels = _write_columns(data, folder / "columns.csv")
    title = publication["name"] or data.manifest["scenario"]
    _write(folder / "README.md", _signed(_front_matter(title, publication["licence"], len(data)) + body + _sections(publication, citation)))
    card = _croissant(data, first, labels, publication, citation)
    _write(folder / "croissant.json", _json_text(card))
    warnings = merged_file(folder)[1]
    missing = [name for name in ("license", "url", "creator", "datePublished") if name not in card]
    if missing:
        warnings.append(f"croissant.json: Croissant requires {', '.join(missing)} too; licence, url, creators or organisations, date give them")
    return card, warnings


def check_croissant(data) -> None:
    """Raises InputError unless croissant.json, if there is one, lists the shards and every file that it lists is there
    with its SHA-256. Files elsewhere (URLs, other folders) are left out; shards are compared with the manifest."""
    file = data.folder / "croissant.json"
    if not file.exists():
        return

    def fault(what):
        raise InputError(f"{file}: {what}; make the cards again by Dataset.card()")

    try:
        resources = [entry for entry in json.loads(file.read_text(encoding="utf-8"))["distribution"] if {"contentUrl", "sha256"} <= entry.keys()]
        listed = {entry["contentUrl"]: entry["sha256"] for entry in resources if pathlib.PurePath(entry["contentUrl"]).name == entry["contentUrl"]}
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        fault(f"not a description of a data set: {error}")
    for shard in data.manifest["shards"]:
        if shard["file"] not in listed:
            fault(f"does not list {shard['file']}")
        if listed.pop(shard["file"]) != shard["sha256"]:
            fault(f"the SHA-256 of {shard['file']} is not the manifest's")
    for name, sha256 in listed.items():
        if not (data.folder / name).is_file():
            fault(f"lists {name!r}, which is missing")
        if _sha256(data.folder / name) != sha256:
            fault(f"the SHA-256 of {name!r} is another one")


# WebDataset: the files of one sample are adjacent and have its number, nine digits, before the first dot.

_WEBDATASET = "seaglint webdataset 1"
_ARCHIVE_NAME = re.compile(r"samples-\d{6,}\.tar")
_TEMPORARY_NAME = re.compile(r"(.+)\.[0-9a-f]{16}\.tmp")


def _npy(values):
    stream = io.BytesIO()
    np.lib.format.write_array(stream, np.ascontiguousarray(values), version=(1, 0), allow_pickle=False)
    return stream.getvalue()


def _members(stored):
    """(key, {name: bytes}) of every sample of a shard."""
    names = [*stored.columns]
    for row, values in enumerate(stored.rows()):
        record = dict(zip(names, values))
        files = {"map.npy": _npy(stored.arrays["maps"][row])}
        if "maps_complex" in stored.arrays:
            files["complex.npy"] = _npy(stored.arrays["maps_complex"][row])
        files.update({"hop_code.npy": _npy(stored.arrays["hop_code"][row]), "centres.npy": _npy(stored.arrays["centres"][row, :record["centres"]]),
                      "cls": str(record["label"]).encode(), "json": (json.dumps(record, ensure_ascii=False) + "\n").encode()})
        yield f"{record['sample']:09d}", files


def _rounded_up(size, unit):
    return -(-size // unit) * unit


def _archive_bytes(size):
    """Of an archive with `size` bytes of files: two blocks at its end, padded to a record as tar(1) does."""
    return _rounded_up(size + 2 * tarfile.BLOCKSIZE, tarfile.RECORDSIZE)


def _webdataset_description(data, first, manifest_sha256):
    files = {"map.npy": ("maps", "float32", "velocity, range", "|RV|"), "complex.npy": ("maps_complex", "complex64", "velocity, range", "RV"),
             "hop_code.npy": ("hop_code", "uint16", "pulse", None), "centres.npy": ("centres", "float32", "centre, value; strongest first", None)}
    manifest = data.manifest
    return {"format": _WEBDATASET, "program_version": manifest["program_version"], "processors": manifest["processors"], "manifest_sha256": manifest_sha256,
            **({"classes": manifest["classes"]} if "classes" in manifest else {}), "samples": len(data), "axes": {name: values.tolist() for name, values in first.axes.items()},
            "files": {name: {"type": kind, "order": order, "units": first.text[array][0], "description": text or first.text[array][1]}
                      for name, (array, kind, order, text) in files.items() if array in first.arrays},
            "columns": {name: {"units": unit, "description": text} for name, (unit, text) in first.column_text.items()}}


def _require_place(data, folder, manifest_sha256):
    """A new or empty folder, or one with an export of the same data set, complete or not."""
    if not folder.exists():
        return
    if not folder.is_dir():
        raise InputError(f"{folder}: is a file, not a directory")
    if folder.samefile(data.folder):
        raise InputError(f"{folder}: is the data set itself; export it into another directory")
    try:
        description = json.loads((folder / "description.json").read_text(encoding="utf-8"))
        same_set = description["format"] == _WEBDATASET and description["manifest_sha256"] == manifest_sha256
    except (OSError, ValueError, KeyError, TypeError):
        same_set = False
    for name in sorted(file.name for file in folder.iterdir()):
        temporary = _TEMPORARY_NAME.fullmatch(name)
        final = temporary[1] if temporary else name
        exported = final in ("description.json", "index.json") or _ARCHIVE_NAME.fullmatch(final)
        # Network file systems keep a removed file that is open elsewhere under a hidden name.
        if not name.startswith(".") and not (exported and (temporary or same_set)):
            raise InputError(f"{folder}: the directory contains {name}, which is not of this data set's export; choose a new directory")


def write_webdataset(data, directory: str | os.PathLike, max_tar_mb: float) -> int:
    """Dataset.to_webdataset(): the number of archives."""
    folder, limit = pathlib.Path(directory), int(number("max_tar_mb", max_tar_mb, 0.01, 1e6) * 1e6)
    if folder.suffix.lower() in (".tar", ".npz", ".h5", ".zip", ".gz"):
        raise InputError(f"{folder}: must be a directory, in which the archives are written")
    manifest_sha256 = _sha256(data.folder / "manifest.json")
    _require_place(data, folder, manifest_sha256)
    samples = ((key, files, sum(tarfile.BLOCKSIZE + _rounded_up(len(content), tarfile.BLOCKSIZE) for content in files.values())) for stored in _stored_shards(data) for key, files in _members(stored))

    def following():
        sample = next(samples, None)
        if sample and _archive_bytes(sample[2]) > limit:
            raise InputError(f"max_tar_mb: value {max_tar_mb}: an archive of sample {sample[0]} alone has {_archive_bytes(sample[2])} bytes, more than the limit of {limit}")
        return sample

    sample, shards = following(), []
    try:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "index.json").unlink(missing_ok=True)
    except OSError as error:
        raise WorkError(f"{error.filename}: {error.strerror}") from None
    _write(folder / "description.json", _json_text(_webdataset_description(data, _Stored(data, 0), manifest_sha256)))
    while sample:
        file, size, count = folder / f"samples-{len(shards):06d}.tar", 0, 0
        with _whole(file) as stream:
            with tarfile.open(fileobj=stream, mode="w", format=tarfile.USTAR_FORMAT) as tar:
                while sample and _archive_bytes(size + sample[2]) <= limit:
                    key, files, taken = sample
                    for name, content in files.items():
                        member = tarfile.TarInfo(f"{key}.{name}")  # of mode 0644; no owner, no time
                        member.size = len(content)
                        tar.addfile(member, io.BytesIO(content))
                    size, count, sample = size + taken, count + 1, following()
        shards.append({"url": file.name, "nsamples": count, "filesize": file.stat().st_size, "sha256": _sha256(file)})
    kept = {shard["url"] for shard in shards} | {"description.json"}
    for left in folder.iterdir():  # of an earlier export with smaller archives, or of one that was killed
        if left.name not in kept and not left.name.startswith("."):
            left.unlink()
    _write(folder / "index.json", _json_text({"__kind__": "wids-shard-index-v1", "wids_version": 1, "name": data.manifest["scenario"], "shardlist": shards}))
    return len(shards)


# PyAEDT.


def write_pyaedt(stem: str | os.PathLike, values: ArrayLike, frequencies_hz: ArrayLike, azimuth_deg: ArrayLike = 0.0, elevation_deg: ArrayLike = 0.0,
                 *, model_info: dict[str, Sequence] | None = None) -> list[pathlib.Path]:
    """Writes scattering matrices as PyAEDT's monostatic exports: `STEM VV.json` with the table `STEM VV.h5`, which
    pandas.read_hdf() opens, and HV, VH, HH (received, transmitted).

    values: complex [frequency, elevation, azimuth, received, transmitted] in metres, h before v, as rcs() returns them.
    The table has sqrt(4 pi) S in metres along theta^ = -v and phi^ = h over Freq in GHz, IWavePhi = azimuth and IWaveTheta =
    90 deg - elevation in degrees. model_info: PyAEDT's entry of that name, {part: [file in the folder geometry, ...]}.
    Returns the JSON files. Needs the packages python3-pandas and python3-tables.
    """
    try:
        import pandas
        import tables  # noqa: F401, by which pandas writes
    except ImportError as error:
        raise ImportError(f"write_pyaedt needs the packages python3-pandas and python3-tables: {error}") from None
    stem = pathlib.Path(stem)
    axes = [axis("frequencies_hz", frequencies_hz), axis("azimuth_deg", azimuth_deg), axis("elevation_deg", elevation_deg)]
    for name, bounds, points in zip(("frequencies_hz", "azimuth_deg", "elevation_deg"), ((1e6, 1e12), (-1e6, 1e6), (-90, 90)), axes):
        for point in points:
            number(name, point, *bounds)
    frequencies, azimuths, elevations = axes
    matrices = np.asarray(values, complex)
    expected = (len(frequencies), len(elevations), len(azimuths), 2, 2)
    if matrices.shape != expected:
        raise InputError(f"values: shape {matrices.shape}: must be {expected}, [frequency, elevation, azimuth, received h v, transmitted h v]; bistatic values have no place in these files")
    if not np.all(np.isfinite(matrices)):
        raise InputError("values: must be finite")
    places = [(f / 1e9, phi, 90 - elevation) for f in frequencies for elevation in elevations for phi in azimuths]
    index = pandas.MultiIndex.from_tuples(places, names=["Freq", "IWavePhi", "IWaveTheta"])
    files = []
    for received, transmitted in ("vv", "hv", "vh", "hh"):
        sign = 1 if received == transmitted else -1
        column = sign * math.sqrt(4 * math.pi) * matrices[..., "hv".index(received), "hv".index(transmitted)].reshape(-1)
        file = stem.with_name(f"{stem.name} {(received + transmitted).upper()}.json")
        table = file.with_suffix(".h5")
        temporary = table.with_name(f"{table.name}.{secrets.token_hex(8)}.tmp")
        try:
            pandas.DataFrame({"data": column}, index=index).to_hdf(temporary, key="df", mode="w", format="table")
            os.replace(temporary, table)
        except OSError as error:
            raise WorkError(f"{table}: cannot write: {error.strerror or error}") from None
        finally:
            temporary.unlink(missing_ok=True)
        _write(file, _json_text({"solution": file.stem, "monostatic_file": table.name, "model_units": "meter", "frequency_units": "GHz", "model_info": dict(model_info or {})}))
        files.append(file)
    return files
