# SPDX-License-Identifier: BSD-3-Clause
"""Solves the cases of tools/validation and takes from the output how far they are from the references."""
import csv
import dataclasses
import json
import math
import pathlib
import re
import subprocess

SEAGLINT = "build/release/seaglint"

# Numerical parameters with which a case is solved again: each column tells what it changes.
CHANGES = {"patches": ["--min-patch-m", "{quarter_patch}"], "bounces": ["--max-bounces", "80"], "flat": ["--crease-deg", "0"]}


class Failure(Exception):
    """A command that failed, with what it printed."""


def seaglint(*arguments):
    result = subprocess.run([SEAGLINT, *map(str, arguments)], capture_output=True, text=True)
    if result.returncode != 0:
        raise Failure(f"seaglint {' '.join(map(str, arguments))}\n{result.stderr}")
    return result.stdout, result.stderr


@dataclasses.dataclass
class Cut:
    """One element at one frequency (or over frequency): mean and rms in dB of what is compared with the reference."""
    name: str  # "HH, 5.12 GHz"
    differences: dict = dataclasses.field(default_factory=dict)  # "po+diffraction", "po", "rays" (with diffraction as the case), "measured" -> (mean, rms)
    correlation: dict = dataclasses.field(default_factory=dict)  # "po+diffraction", "po" -> magnitude
    changes: dict = dataclasses.field(default_factory=dict)  # "patches", "bounces", "flat", "rays" -> mean change in dB

    def solver(self, of):
        """The value of the solver with edge diffraction, or without it where it is off."""
        return of.get("po+diffraction", of.get("po"))


ROW = re.compile(r"(?P<reference>\S+) +(?P<pol>[hv]{2}) +(?P<ghz>\S+) +(?P<compared>\S+) +\d+ +(?P<mean>\S+) +(?P<rms>\S+) +\S+ +\S+ +\S+(?: \S+)?"
                 r"(?: +(?:-|(?P<correlation>[0-9.]+) at \S+ deg))?\s*$")


def cuts_of(text, against):
    """The cuts in the table that `seaglint rcs --reference` prints, against references with these starts of names."""
    cuts = {}
    for line in text.splitlines():
        row = ROW.match(line)
        if not row or not row["reference"].startswith(tuple(against.split(","))):
            continue
        name = row["pol"].upper() + ("" if row["ghz"] == "sweep" else f", {row['ghz']} GHz")
        cut = cuts.setdefault(name, Cut(name))
        kind = "measured" if row["compared"].startswith("meas") else row["compared"]
        cut.differences[kind] = (f"{float(row['mean']):.2f}", f"{float(row['rms']):.2f}")
        if row["correlation"]:
            cut.correlation[kind] = row["correlation"]
    return list(cuts.values())


def solved(file):
    """(frequency, azimuth, elevation) -> (hh, hv, vh, vv) in dBsm, and min_patch_m of the head."""
    with open(file, encoding="utf-8") as stream:
        lines = stream.readlines()
    patch = next(float(m[1]) for line in lines if (m := re.search(r"min_patch_m ([0-9.e+-]+)", line)))
    levels = {}
    for row in csv.DictReader(line for line in lines if not line.startswith("#")):
        place = tuple(float(row[key]) for key in ("frequency_hz", "azimuth_deg", "elevation_deg"))
        areas = {pq: 4 * math.pi * (float(row[pq + "_re"]) ** 2 + float(row[pq + "_im"]) ** 2) for pq in ("hh", "hv", "vh", "vv")}
        levels[place] = {pq: 10 * math.log10(max(area, 1e-100)) for pq, area in areas.items()}
    return levels, patch


def thinned(sweep, every):
    """The sweep with `every` times the step of its angle, or without angles to sweep of its frequency."""
    words = list(sweep)
    for option in ("--azimuth-deg", "--frequency-ghz"):
        at = words.index(option) + 1
        if words[at].count(":") == 2:
            first, last, step = words[at].split(":")
            words[at] = f"{first}:{last}:{float(step) * every:.12g}"
            return words
    return words


def replaced(words, options):
    """The words with these options in place of their own."""
    words = list(words)
    for name, value in zip(options[::2], options[1::2]):
        if name in words:
            words[words.index(name) + 1] = value
        else:
            words += [name, value]
    return words


def without_references(words):
    return [word for word in words if not word.startswith("--reference")]


def set_change(case, cuts, kind, base, changed):
    """Mean change of the levels from `base` to `changed` in the elements and at the frequencies of the cuts."""
    for cut in cuts:
        element, _, ghz = cut.name.lower().partition(", ")
        frequency = float(ghz.split()[0]) * 1e9 if ghz else None  # as printed, six digits
        places = [p for p in changed if p in base and (frequency is None or abs(p[0] / frequency - 1) < 1e-5)]
        if not places:
            continue
        floor = max(base[p][element] for p in places) - case.floor_db
        cut.changes[kind] = sum(abs(max(changed[p][element], floor) - max(base[p][element], floor)) for p in places) / len(places)


def solve_changes(case, cuts, out):
    """Fills in by how much the levels change with other numerical parameters."""
    base, patch = solved(out / f"{case.name}.csv")
    for kind, options in {**CHANGES, **case.changes}.items():
        if options is None:
            continue
        words = [word.format(quarter_patch=f"{patch / 4:.6g}") for word in options]
        file = out / f"{case.name}_{kind}.csv"
        seaglint("rcs", "--target", mesh_of(case, out), *replaced(without_references(thinned(case.sweep, case.every)), words), "-o", file)
        set_change(case, cuts, kind, base, solved(file)[0])


def add_rays_curves(curves, rays):
    """Adds to the panels of the beams' curves those of the same model by rays."""
    for panel, other in zip(curves["panels"], rays["panels"]):
        names = [series["name"] for series in other["series"]]
        for model in ("po+diffraction", "po"):  # the model of the case is the last
            own = [series for series in other["series"] if series["name"].split(" - ")[0] == model]
            if own:
                panel["series"] += [{**series, "name": series["name"].replace(model, "rays", 1), "colour": "#cc79a7"} for series in own]
                break
        else:
            raise Failure(f"no curve of the solver among {', '.join(names)}")
    return curves


def solve_rays(case, cuts, arguments, out):
    """Solves the case by rays: their differences from the references, their change from beams, their curves."""
    stem = out / f"{case.name}_rays"
    printed, _ = seaglint(*arguments, "--method", "rays", "--curves", f"{stem}_curves.json", "-o", f"{stem}.csv")
    pathlib.Path(f"{stem}.txt").write_text(printed, encoding="utf-8")
    by_rays = {cut.name: cut for cut in cuts_of(printed, case.against)}
    for cut in cuts:
        cut.differences["rays"] = cut.solver(by_rays[cut.name].differences)
    set_change(case, cuts, "rays", solved(out / f"{case.name}.csv")[0], solved(f"{stem}.csv")[0])
    beams = out / f"{case.name}_curves.json"
    curves = add_rays_curves(json.loads(beams.read_text(encoding="utf-8")), json.loads(pathlib.Path(f"{stem}_curves.json").read_text(encoding="utf-8")))
    beams.write_text(json.dumps(curves).replace("<", "\\u003c") + "\n", encoding="utf-8")


def mesh_of(case, out):
    return case.mesh if "/" in case.mesh else str(out / case.mesh)


def solve(case, out):
    """Writes NAME.csv, NAME.png, NAME.txt (as printed), NAME_mesh.png, those of rays and the changed ones; returns the cuts."""
    for name, text in case.made.items():
        (out / name).write_text(text(), encoding="utf-8")
    if case.make:
        seaglint(*case.make, "-o", out / case.mesh)
    references = []
    for file, polarisation in case.references:
        references += ["--reference", file if "/" in file else out / file]
        references += ["--reference-polarisation", polarisation] if polarisation else []
    arguments = ["rcs", "--target", mesh_of(case, out), *case.sweep, "--floor-db", case.floor_db, *references]
    printed, _ = seaglint(*arguments, "--curves", out / f"{case.name}_curves.json", "-o", out / f"{case.name}.csv")
    (out / f"{case.name}.txt").write_text(printed, encoding="utf-8")
    seaglint("mesh", "info", mesh_of(case, out), "--picture", out / f"{case.name}_mesh.png", "--width", 480, "--azimuth-deg", case.view[0], "--elevation-deg", case.view[1])
    cuts = cuts_of(printed, case.against)
    if not cuts:
        raise Failure(f"{case.name}: no reference in\n{printed}")
    solve_changes(case, cuts, out)
    if case.rays:
        solve_rays(case, cuts, arguments, out)
    return cuts
