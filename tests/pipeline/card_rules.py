# SPDX-License-Identifier: BSD-3-Clause
"""Checks the cards of a data set by the rules of their specifications and against the files that they describe.

    card_rules.py DATA [complete]    prints the numbers of files, fields and samples

croissant.json by the Croissant specification 1.0 (sections Dataset-level Information, Resources, RecordSets, Categorical
Data; with `complete`, also the properties that only a user knows), README.md as YAML between two lines `---`, columns.csv
against the columns of the shards by h5py. Checksums are those of sha256sum.
"""
import csv
import json
import math
import pathlib
import re
import subprocess
import sys

import h5py
import yaml

data = pathlib.Path(sys.argv[1])
card = json.loads((data / "croissant.json").read_text())
context = card["@context"]

# Properties of schema.org (the vocabulary of names without prefix) that the specification names.
SCHEMA_ORG = {"name", "description", "license", "url", "creator", "datePublished", "keywords", "publisher", "version",
              "distribution", "contentUrl", "contentSize", "encodingFormat", "sha256", "isBasedOn", "softwareVersion"}


def require(condition, text):
    if not condition:
        sys.exit(text)


def expanded(term):
    """The IRI of a property or type by the context: a term, a prefix, or the vocabulary."""
    meaning = context.get(term, term)
    meaning = meaning["@id"] if isinstance(meaning, dict) else meaning
    prefix, colon, rest = meaning.partition(":")
    if colon and not rest.startswith("//"):
        require(prefix in context, f"{term}: prefix {prefix} is not in the context")
        return context[prefix] + rest
    require(meaning in SCHEMA_ORG, f"{term}: neither in the context nor a property of schema.org")
    return context["@vocab"] + meaning


def nodes(value, below=()):
    """Every object but those that are plain JSON by the context."""
    if isinstance(value, list):
        for entry in value:
            yield from nodes(entry, below)
    elif isinstance(value, dict):
        yield value
        for name, entry in value.items():
            if name != "@context" and not (isinstance(context.get(name), dict) and context[name].get("@type") == "@json"):
                yield from nodes(entry, below + (name,))


# The dataset.
for prefix, iri in {"cr": "http://mlcommons.org/croissant/", "sc": "https://schema.org/",
                    "dct": "http://purl.org/dc/terms/"}.items():
    require(context[prefix] == iri, f"prefix {prefix}")
require(context["@vocab"] == "https://schema.org/" and context["data"] == {"@id": "cr:data", "@type": "@json"}, "context")
require(context["dataType"] == {"@id": "cr:dataType", "@type": "@vocab"}, "context: dataType")
require(expanded(card["@type"]) == "https://schema.org/Dataset", "@type")
require(expanded("conformsTo") == "http://purl.org/dc/terms/conformsTo", "conformsTo")
require(card["conformsTo"] == "http://mlcommons.org/croissant/1.0", "version of Croissant")
required = {"@context", "@type", "conformsTo", "name", "description", "distribution"}
if "complete" in sys.argv[2:]:
    required |= {"license", "url", "creator", "datePublished", "version"}
    require(re.fullmatch(r"\d{4}-\d\d-\d\d", card["datePublished"]), "datePublished")
    require(re.fullmatch(r"\d+\.\d+\.\d+", card["version"]), "version")
    require(card["license"].startswith("https://spdx.org/licenses/"), "license")
    for creator in card["creator"]:
        require(expanded(creator["@type"]) in ("https://schema.org/Person", "https://schema.org/Organization"), "creator")
else:
    require(not {"license", "url", "creator", "datePublished", "version"} & set(card), "something is invented")
require(required <= set(card), f"missing: {required - set(card)}")

identified = {}
for node in nodes(card):
    for name in node:
        if not name.startswith("@"):
            expanded(name)
    if "@id" in node and len(node) > 1:
        require(node["@id"] not in identified, f"{node['@id']}: twice")
        identified[node["@id"]] = node
for node in nodes(card):
    if set(node) == {"@id"}:
        require(node["@id"] in identified, f"{node['@id']}: refers to nothing")

# The files: all of the directory but the two cards themselves.
files = {}
for resource in card["distribution"]:
    require(resource["@type"] == "cr:FileObject", resource)
    file = data / resource["contentUrl"]
    digest = subprocess.run(["sha256sum", file], check=True, capture_output=True, text=True).stdout.split()[0]
    require(resource["sha256"] == digest, f"{file}: sha256")
    require(resource["contentSize"] == f"{file.stat().st_size} B", f"{file}: contentSize")
    require(re.fullmatch(r"[a-z]+/[a-z0-9.+-]+", resource["encodingFormat"]), f"{file}: encodingFormat")
    if file.suffix == ".h5":
        require(resource["encodingFormat"] == "application/x-hdf5" and h5py.is_hdf5(file), file)
    files[resource["@id"]] = file
require({file.name for file in data.iterdir()} == {file.name for file in files.values()} | {"README.md", "croissant.json"},
        "not all files are listed")

# Record sets and fields.
record_sets = {entry["@id"]: entry for entry in card["recordSet"]}
require(set(record_sets) == {"classes", "samples"}, record_sets.keys())
for name, record_set in record_sets.items():
    require(record_set["@type"] == "cr:RecordSet", name)
    fields = [field["@id"] for field in record_set["field"]]
    require(record_set["key"]["@id"] in fields, f"{name}: key")
    for field in record_set["field"]:
        require(field["@type"] == "cr:Field" and field["@id"] == f"{name}/{field['name']}", field)
        types = field["dataType"] if isinstance(field["dataType"], list) else [field["dataType"]]
        require(types[0] in ("sc:Integer", "sc:Float", "sc:Text"), field)
        require("data" in record_set or "source" in field, f"{field['@id']}: no source")
classes = record_sets["classes"]
require(classes["dataType"] == "sc:Enumeration" and "classes/name" in [f["@id"] for f in classes["field"]], "enumeration")
for record in classes["data"]:
    require(set(record) == {field["@id"] for field in classes["field"]}, record)

# The table that the fields read: every column of the shards with its unit, and every value.
fields = {field["source"]["extract"]["column"]: field for field in record_sets["samples"]["field"]}
require({field["source"]["fileObject"]["@id"] for field in fields.values()} == {"columns.csv"}, "sources")
with open(files["columns.csv"], newline="") as table:
    rows = list(csv.DictReader(table))
require(list(rows[0]) == list(fields), "columns of columns.csv")
counts = {}
position = 0
for shard in json.loads((data / "manifest.json").read_text())["shards"]:
    with h5py.File(data / shard["file"]) as stored:
        require(set(stored["samples"]) == set(fields) - {"shard", "row"}, "columns of the shard")
        for column in stored["samples"].values():
            name, unit = column.name.rsplit("/", 1)[1], column.attrs["units"].decode()
            kind = {"i": "sc:Integer", "f": "sc:Float", "S": "sc:Text"}[column.dtype.kind]
            types = fields[name]["dataType"]
            require(types == ([kind, "cr:Label"] if name == "label" else kind), f"{name}: {types}")
            require(column.attrs["description"].decode() in fields[name]["description"], f"{name}: description")
            if kind != "sc:Text":
                require(fields[name]["description"].endswith("dimensionless" if unit == "1" else f"unit {unit}"), name)
            for row, value in enumerate(column[:]):
                text = rows[position + row][name]
                if kind == "sc:Text":
                    require(text == value.decode(), f"{name}: {text}")
                elif kind == "sc:Integer":
                    require(int(text) == value, f"{name}: {text}")
                else:
                    require((text == "" and math.isnan(value)) or float(text) == value, f"{name}: {text}")
        for row, label in enumerate(stored["samples/label"][:]):
            counts[int(label)] = counts.get(int(label), 0) + 1
            require((rows[position + row]["shard"], rows[position + row]["row"]) == (shard["file"], str(row)), "place")
        position += shard["samples"]
require(position == len(rows), "rows of columns.csv")
require({r["classes/label"]: r["classes/samples"] for r in classes["data"]} == counts, f"classes: {counts}")

# The metadata of README.md.
_, front, body = (data / "README.md").read_text().split("---\n", 2)
metadata = yaml.safe_load(front)
require(metadata["pretty_name"] == card["name"], metadata["pretty_name"])
require(("license" in metadata) == ("license" in card), "licence of README.md")
low, high = {"n<1K": (0, 1000), "1K<n<10K": (1000, 10000)}[metadata["size_categories"][0]]
require(low <= len(rows) < high, metadata["size_categories"])
require(metadata["configs"][0]["data_files"][0]["path"] == "columns.csv", "data_files")
require(set(metadata["task_categories"]) == {"image-classification", "tabular-classification"}, "tasks")
for name in fields.keys() - {"shard", "row"}:
    require(f"| `{name}` |" in body, f"README.md lacks {name}")
# Cells of a table have no bar of their own.
for table in re.findall(r"(?:^\|.*\n)+", body, flags=re.M):
    require(len({len(re.findall(r"(?<!\\)\|", line)) for line in table.splitlines()}) == 1, f"a ragged table:\n{table}")
print(len(files), len(fields), len(rows))
