# SPDX-License-Identifier: BSD-3-Clause
"""Corner-reflector decoys beside geometrical optics, a part of the fleet on the page of tools/validation."""
import csv
import html
import math
import statistics

import validation_page
import validation_plot
from validation_run import seaglint

LEG_M = 0.4
WAVELENGTH_M = 299792458.0 / 9.4e9
CUT = ["--frequency-ghz", "9.4", "--azimuth-deg", "0:359.75:0.25", "--elevation-deg", "0"]
SPHERE = ["--frequency-ghz", "9.2:9.6:0.1", "--azimuth-deg", "0:354:6", "--elevation-deg", "-88:88:4"]
LIMIT_DB = 6.0  # of the minima below the lobes, IMO A.384(X)
CELL_ELEVATION_DEG = math.degrees(math.asin(1 / 3))  # of the lower and upper cells of an octahedral reflector as rain catcher

# Largest cross-section of one reflector over a^4 / lambda^2 by geometrical optics. Triangular trihedral and dihedral: Knott, Shaeffer and Tuley, Radar Cross Section, table 6.1, as sim/canonical. Square and circular (quadrant) trihedral: 4 pi A^2 with the
# aperture A on the axis, sqrt(3) a^2 and 1.114 a^2.
TRIANGULAR, SQUARE, CIRCULAR, DIHEDRAL = 4 * math.pi / 3, 12 * math.pi, 15.6, 8 * math.pi

# Name: options of `mesh make decoy`, factor of geometrical optics, elevation of the axis at azimuth 0, deg.
DECOYS = {
    "octahedral, triangular": (["--kind", "octahedral"], TRIANGULAR, CELL_ELEVATION_DEG),
    "octahedral, square": (["--kind", "octahedral", "--panel", "square"], SQUARE, CELL_ELEVATION_DEG),
    "octahedral, circular": (["--kind", "octahedral", "--panel", "circular"], CIRCULAR, CELL_ELEVATION_DEG),
    "icosahedral": (["--kind", "icosahedral"], TRIANGULAR, 0.0),
    "cluster of six": (["--kind", "trihedral_cluster", "--cells", "6"], TRIANGULAR, 0.0),
    "trihedral": (["--kind", "trihedral"], TRIANGULAR, 0.0),
    "dihedral": (["--kind", "dihedral"], DIHEDRAL, 0.0)}

ABOUT = f"""Perfect reflectors with legs of {LEG_M:g} m (12.5 wavelengths at 9.4 GHz), octahedral ones as rain catchers, one cell upwards. <b>Peak</b>: on the axis of a cell, by geometrical optics 4&pi;a<sup>4</sup>/3&lambda;<sup>2</sup> for triangular panels, 12&pi;a<sup>4</sup>/&lambda;<sup>2</sup> for square and 15.6a<sup>4</sup>/&lambda;<sup>2</sup>
for circular ones, 8&pi;a<sup>4</sup>/&lambda;<sup>2</sup> for the dihedral. <b>Horizon</b>: elevation 0, every 0.25 deg of azimuth. <b>Sphere</b>: 9.2 to 9.6 GHz, all directions. Levels are relative to the peak by geometrical optics, and of hh unless stated."""
LIMITS = """No measured curve of an octahedral reflector with stated dimensions was found that could be shown beside these. Geometrical optics counts three reflections alone (two of the dihedral), which the solver has exactly without edges. With edges the boundary of the reflected wave, which meets the rim of the next panel on the axis of square trihedra and dihedrals, takes a decibel off,
waves between the rims of adjacent cells of the icosahedral reflector likewise, with a ripple over frequency; plates and dihedrals fill the minima between the lobes."""


def peak_dbsm(factor):
    return 10 * math.log10(factor * LEG_M**4 / WAVELENGTH_M**2)


def triangular_aperture(cosines):
    """Aperture over a^2 of a triangular trihedral for three reflections; cosines: of the direction with its legs; that of sim/canonical."""
    c = sorted(abs(x) for x in cosines)
    p = sum(c)
    return p - 2 / p if c[0] + c[1] >= c[2] else 4 * c[0] * c[1] / p


def octahedral_db(azimuth_deg, elevation_deg):
    """Level of the triangular rain catcher by geometrical optics, relative to one trihedral on its axis."""
    azimuth, elevation = math.radians(azimuth_deg), math.radians(elevation_deg)
    cosines = [math.cos(elevation) * math.cos(azimuth - math.radians(leg)) * math.sqrt(2 / 3) + math.sin(elevation) / math.sqrt(3) for leg in (60, 180, 300)]
    return 20 * math.log10(max(math.sqrt(3) * triangular_aperture(cosines), 1e-6))


def levels(mesh, options, out):
    """(azimuth, elevation, hh, vv), dBsm, of every row of a sweep."""
    file = out / "decoy_sweep.csv"
    seaglint("rcs", "--target", mesh, *options, "--figure", "off", "-o", file)
    with open(file, encoding="utf-8") as stream:
        rows = [tuple(float(row[name]) for name in ("azimuth_deg", "elevation_deg", "hh_dbsm", "vv_dbsm")) for row in csv.DictReader(line for line in stream if not line.startswith("#"))]
    file.unlink()
    return rows


def weighted_median(values, weights):
    half, total = sum(weights) / 2, 0.0
    for value, weight in sorted(zip(values, weights)):
        total += weight
        if total >= half:
            return value


def mean_db(values_db, weights):
    return 10 * math.log10(sum(weight * 10 ** (value / 10) for value, weight in zip(values_db, weights)) / sum(weights))


def coverage(cut, limit):
    """Degrees of azimuth at or above a limit, and the widest gap below it; cut: levels evenly spread over a turn."""
    step, above = 360 / len(cut), [value >= limit for value in cut]
    if not any(above):
        return 0.0, 360.0
    first = above.index(True)
    widest = run = 0
    for value in above[first:] + above[:first]:
        run = 0 if value else run + 1
        widest = max(widest, run)
    return step * sum(above), step * widest


def solve(name, options, factor, elevation, out):
    mesh, picture, pattern = (out / f"decoy_{name.replace(', ', '_').replace(' ', '_')}{end}" for end in (".glb", ".png", "_pattern.png"))
    seaglint("mesh", "make", "decoy", *options, "--leg-m", LEG_M, "-o", mesh)
    seaglint("mesh", "info", mesh, "--picture", picture, "--width", 640, "--azimuth-deg", 25, "--elevation-deg", 20)
    axis = ["--frequency-ghz", "9.4", "--azimuth-deg", "0", "--elevation-deg", f"{elevation:.10g}"]
    (optics,), (edges,) = levels(mesh, [*axis, "--edges", "off"], out), levels(mesh, axis, out)
    cut, sphere, peak = levels(mesh, CUT, out), levels(mesh, SPHERE, out), peak_dbsm(factor)
    weights = [math.cos(math.radians(row[1])) for row in sphere]
    draw_pattern(name, cut, pattern)
    horizon, around = [row[2] - peak for row in cut], [row[2] - peak for row in sphere]
    return {"name": name, "peak": peak, "optics_db": optics[2] - peak, "hh_db": edges[2] - peak, "vv_db": edges[3] - peak, "cut": cut, "horizon_median_db": statistics.median(horizon), "horizon_mean_db": mean_db(horizon, [1] * len(horizon)),
            "sphere_median_db": weighted_median(around, weights), "sphere_mean_db": mean_db(around, weights), "files": [(f"{name}: the mesh", picture), (f"{name}: level over azimuth, elevation 0", pattern)]}


def draw_pattern(name, cut, file):
    """Polar diagram of 45 dB."""
    top = 5 * math.ceil(max(max(row[2:]) for row in cut) / 5)
    script = [f'set terminal pngcairo size 640,640 font "sans,15"; set output "{file}"', f"set title '{name}, dBsm'; set polar; set angles degrees; set border polar lc rgb '#999999'; unset xtics; unset ytics; set grid polar 30; set size square; set theta top ccw; set ttics 0,30",
              f"set rrange [{top - 45}:{top}]; set rtics 15; set key bottom right", "plot '-' with lines lw 1.5 lc rgb '#0b5c8a' title 'hh', '-' with lines lw 1 lc rgb '#d55e00' title 'vv'"]
    for column in (2, 3):
        script += [f"{row[0]} {max(row[column], top - 45)}" for row in cut] + [f"360 {max(cut[0][column], top - 45)}", "e"]
    validation_plot.gnuplot(script, file)


def optics_rows():
    """What geometrical optics says of the triangular octahedral reflector: medians and means over the horizon and the sphere."""
    horizon = [octahedral_db(i / 4, 0) for i in range(1440)]
    places = [(azimuth, elevation) for elevation in range(-88, 89, 4) for azimuth in range(0, 360, 2)]
    sphere, weights = [octahedral_db(*place) for place in places], [math.cos(math.radians(elevation)) for _, elevation in places]
    return statistics.median(horizon), mean_db(horizon, [1] * len(horizon)), weighted_median(sphere, weights), mean_db(sphere, weights)


def rows(decoys):
    made = [[one["name"], f"{one['peak']:.1f}", *(f"{one[key]:+.1f}" for key in ("optics_db", "hh_db", "vv_db", "horizon_median_db", "horizon_mean_db", "sphere_median_db", "sphere_mean_db"))] for one in decoys]
    made.insert(1, ["the same by geometrical optics", made[0][1], "0.0", "", "", *(f"{value:+.1f}" for value in optics_rows())])
    return made


HEAD = ["decoy", "peak by geometrical optics, dBsm", "solver without edges, dB", "hh, dB", "vv, dB", "horizon: median, dB", "mean", "sphere: median, dB", "mean"]


def lobes(octahedral):
    """A sentence on the lobes of the triangular rain catcher over the horizon."""
    cut = [row[2] - octahedral["peak"] for row in octahedral["cut"]]
    lobe = statistics.median(cut[at % len(cut)] for centre in range(0, 360, 60) for at in range(4 * (centre - 5), 4 * (centre + 5) + 1))
    degrees, gap = coverage(cut, lobe - LIMIT_DB)
    return f"""The triangular rain catcher has six lobes on the horizon, every 60 deg, whose cells lie 19.5 deg above and below it: their middle is at {lobe:+.1f} dB (geometrical optics {octahedral_db(0, 0):+.1f} dB), and {degrees:.0f} deg of azimuth are within {LIMIT_DB:g} dB of it, with gaps of up to {gap:.1f} deg
(IMO A.384(X) asks for 240 deg and gaps of at most 10 deg). The narrow flashes between the lobes are dihedrals."""


def part(out):
    """The part of the section in HTML, its table in Markdown, and figures for validation.json."""
    print("    decoys ...", flush=True)
    decoys = [solve(name, *decoy, out) for name, decoy in DECOYS.items()]
    octahedral = decoys[0]
    curves = [validation_plot.series(label, "lines", colour, [(row[0], max(row[column] - octahedral["peak"], -40)) for row in octahedral["cut"]]) for label, colour, column in (("hh", "#0072b2", 2), ("vv", "#d55e00", 3))]
    curves.append(validation_plot.series("geometrical optics", "lines", "#000000", [(i / 2, max(octahedral_db(i / 2, 0), -40)) for i in range(720)]))
    fold = [validation_plot.panel("octahedral rain catcher on the horizon", "azimuth (deg)", "level relative to one trihedral (dB)", (-40, 10), curves),
            validation_plot.panel("the same, one lobe", "azimuth (deg)", "level relative to one trihedral (dB)", (-25, 10), [{**one, "x": [x for x in one["x"] if x <= 90], "y": [max(y, -25) for x, y in zip(one["x"], one["y"]) if x <= 90]} for one in curves])]
    figure = validation_plot.figure(fold, out / "decoys.png", "level of the octahedral reflector over azimuth, solver and geometrical optics", (1400, 520))
    table = rows(decoys)
    tiles = "\n".join(f"<div>{''.join(validation_page.enlarged(*file) for file in one['files'])}</div>" for one in decoys)
    section = f"""<h3>Decoys beside geometrical optics</h3>
<p>{ABOUT}</p>
{validation_page.table(HEAD, table)}
<p>{lobes(octahedral)}</p>
{figure}
<div class="row">{tiles}</div>
<p><b>Limits.</b> {LIMITS}</p>"""
    figures = [{"decoy": one["name"], "peak_by_optics_dbsm": one["peak"], **{key: one[key] for key in one if key.endswith("_db")}} for one in decoys]
    return section, markdown(HEAD, table), figures


def markdown(head, table):
    return "\n".join("| " + " | ".join(cells) + " |" for cells in [head, ["---"] * len(head), *table])
