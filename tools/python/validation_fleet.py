# SPDX-License-Identifier: BSD-3-Clause
"""The fleet, a section of the page of tools/validation: the reference ship of every kind with its echo over azimuth, range-velocity map and ISAR image; levels beside Skolnik's formula and the table of
Williams, Cramp and Curtis; what makes them; the decoys of validation_decoys."""
import csv
import html
import math
import re
import resource
import statistics

import validation_decoys
import validation_page
import validation_plot
from validation_run import Failure, seaglint

STEP_DEG = 5
# The band stands for small changes of aspect: lobes of a target of length D are c / 2D wide, 18 MHz for 8.5 m.
VIEWS = ["--frequency-ghz", "9.2:9.6:0.02", "--elevation-deg", "1"]
SEA = ["--sea-reflection", "--significant-wave-height-m", "0.5"]
PARTS_AZIMUTHS, SEA_AZIMUTHS = (15, 345, 30), (30, 345, 45)
ELEMENTS = ("hh", "vv")
QUADRANTS_DEG = {"port bow": 45, "port quarter": 135, "starboard quarter": 225, "starboard bow": 315}
HALF_QUADRANT_DEG = 30   # 15 to 75 deg from the bow or the stern
EXPLAINED_DB = 6.0       # a larger difference from the literature is looked into

# Skolnik, Introduction to Radar Systems, 2nd ed. 1980, p. 45, eq. (2.38): f in MHz, D in kilotons; from ships of 2 to 17 kt.
VALID_KT = (2.0, 17.0)
SEA_WATER_KT_PER_M3 = 1.025e-3
MIDDLE_MHZ = 9400

# Williams, Cramp and Curtis, Electronic Circuits and Systems 2(4), 1978, X band: lowest and highest median over the aspects, m^2, of ships of similar length.
WILLIAMS = {
    "small coasters of 40 to 46 m": (20, 800), "coaster of 67 m": (1000, 5000), "collier of 73 m": (300, 2000), "frigate of 103 m": (5000, 100000), "cargo ships of 153 and 166 m": (400, 16000),
    "bulk carrier of 198 m": (1000, 32000), "ore carrier of 206 m": (2000, 25000), "container carrier of 212 m": (10000, 80000), "tankers of 213 to 229 m": (5000, 80000), "inshore fishing vessel of 9 m": (3, 10)}

# Kind: rows of the table with which it is compared, design value in X band of IALA (Guideline 1111), m^2.
KINDS = {
    "frigate": (["frigate of 103 m"], None), "corvette": (["coaster of 67 m", "collier of 73 m"], None), "patrol_boat": (["small coasters of 40 to 46 m"], 100),
    "container_ship": (["container carrier of 212 m"], 100000), "tanker": (["tankers of 213 to 229 m"], 100000), "bulk_carrier": (["bulk carrier of 198 m", "ore carrier of 206 m"], 10000),
    "fishing_vessel": (["small coasters of 40 to 46 m"], 100), "ferry": (["cargo ships of 153 and 166 m"], 10000), "tug": (["small coasters of 40 to 46 m"], 100), "inflatable_boat": (["inshore fishing vessel of 9 m"], 3)}


def dbsm(area_m2):
    return 10 * math.log10(max(area_m2, 1e-30))


def skolnik_m2(frequency_mhz, displacement_kt):
    return 52 * math.sqrt(frequency_mhz) * displacement_kt**1.5


def off(azimuth_deg, centre_deg):
    """Angle between two azimuths."""
    return abs((azimuth_deg - centre_deg + 180) % 360 - 180)


def quadrant_medians(areas):
    """Median of the bow and quarter aspects of either side, m^2. areas: azimuth in deg -> cross-sections in m^2."""
    return {name: statistics.median(area for azimuth, values in areas.items() if off(azimuth, centre) <= HALF_QUADRANT_DEG for area in values) for name, centre in QUADRANTS_DEG.items()}


def skolnik_statistic(areas):
    """Mean of the medians of port and starboard bow and quarter aspects, m^2."""
    return statistics.mean(quadrant_medians(areas).values())


def sector_medians(areas, width_deg=30):
    """Median by sector, m^2; the first has the bow in its middle."""
    sectors = {}
    for azimuth, values in areas.items():
        sectors.setdefault(width_deg * (int((azimuth + width_deg / 2) // width_deg) % (360 // width_deg)), []).extend(values)
    return {centre: statistics.median(values) for centre, values in sorted(sectors.items())}


def place(low, high, range_m2):
    """Where lowest and highest median lie against a range, in words."""
    def side(value):
        return "below" if value < range_m2[0] else "above" if value > range_m2[1] else "within"
    return side(low) if side(low) == side(high) else f"{side(low)} to {side(high)}"


def outside_db(value, range_m2):
    """Distance of a value from a range, dB; zero within."""
    return dbsm(value) - min(max(dbsm(value), dbsm(range_m2[0])), dbsm(range_m2[1]))


def rcs(mesh, azimuths, out, *options):
    """Cross-sections in m^2 of a sweep: element -> azimuth -> values over the band."""
    file = out / "fleet_sweep.csv"
    seaglint("rcs", "--target", mesh, *VIEWS, "--azimuth-deg", azimuths, "--figure", "off", *options, "-o", file)
    areas = {element: {} for element in ELEMENTS}
    with open(file, encoding="utf-8") as stream:
        for row in csv.DictReader(line for line in stream if not line.startswith("#")):
            for element in ELEMENTS:
                areas[element].setdefault(float(row["azimuth_deg"]), []).append(10 ** (float(row[f"{element}_dbsm"]) / 10))
    file.unlink()
    return areas


def sweep(azimuths_deg):
    """First, last azimuth and step as an option."""
    return ":".join(map(str, azimuths_deg))


def thinned(areas, azimuths_deg):
    """The values at the azimuths of a coarser sweep."""
    first, last, step = azimuths_deg
    return {element: {azimuth: values for azimuth, values in by_azimuth.items() if azimuth in range(first, last + 1, step)} for element, by_azimuth in areas.items()}


def shares(file):
    """Parts by their share of the sum of all parts' mean cross-sections over the bow and quarter aspects, both elements; largest first."""
    means = {}
    with open(file, encoding="utf-8") as stream:
        for row in csv.DictReader(line for line in stream if not line.startswith("#")):
            sector = row["sector_centre_deg"]
            if row["part"] != "whole" and row["polarisation"] in ELEMENTS and sector != "all" and any(off(float(sector), centre) <= 15 for centre in QUADRANTS_DEG.values()):
                means[row["part"]] = means.get(row["part"], 0) + 10 ** (float(row["mean_dbsm"]) / 10)
    total = sum(means.values())
    return sorted(((part, mean / total) for part, mean in means.items()), key=lambda one: -one[1])


def hydrostatics(text):
    """The lines on the ship afloat, and its displacement in kilotons."""
    volume = re.search(r"([0-9.e+]+) m\^3 below", text)
    if not volume:
        raise Failure(f"mesh make ship printed no volume:\n{text}")
    lines = text[text.index("afloat"):text.index("scenario")].splitlines()
    return "\n".join(line.removeprefix("afloat").strip() for line in lines), float(volume[1]) * SEA_WATER_KT_PER_M3


def scenario(kind, out):
    """The ship alone in the view and the sea of all."""
    file = out / f"{kind}.yaml"
    file.write_text(f"seaglint: 1\nname: fleet\nview: {{azimuth_deg: 40, elevation_deg: 2}}\nsea: {{significant_wave_height_m: 1.5, peak_period_s: 7, propagation_deg: 60}}\n"
                    f"targets:\n  {kind}: {{label: 1, ship: {{kind: {kind}, seed: 0}}, motion: {{model: ship, translations: true}}}}\n", encoding="utf-8")
    return file


def draw_levels(areas, file):
    """Level at 9.4 GHz, and its median over the band, against azimuth."""
    script = [f'set terminal pngcairo size 900,640 font "sans,15"; set output "{file}"', "set multiplot layout 2,1", "set grid; set xrange [0:360]; set xtics 45; set key bottom left horizontal"]
    for element in ELEMENTS:
        rows = sorted(areas[element].items())
        medians = [dbsm(statistics.median(values)) for _, values in rows]
        middle = [dbsm(values[len(values) // 2]) for _, values in rows]
        script += [f"set title '{element}'; set ylabel 'dBsm'; set xlabel 'azimuth (deg)'; set yrange [{min(middle) - 5}:{max(middle) + 5}]", "plot '-' with points pt 7 ps 0.6 lc rgb '#999999' title '9.4 GHz', '-' with lines lw 2 lc rgb '#0b5c8a' title 'median, 9.2 to 9.6 GHz'"]
        for levels in (middle, medians):
            script += [f"{azimuth} {level}" for (azimuth, _), level in zip(rows, levels)] + ["e"]
    validation_plot.gnuplot(script, file)
    return file


def solve(kind, out):
    """Everything of one ship."""
    print(f"    {kind} ...", flush=True)
    mesh, parts = out / f"{kind}.glb", out / f"{kind}_parts.csv"
    text, displacement_kt = hydrostatics(seaglint("mesh", "make", "ship", "--kind", kind, "--above-water", "-o", mesh)[0])
    areas = rcs(mesh, sweep((0, 360 - STEP_DEG, STEP_DEG)), out, "--statistics", parts)
    files = [(f"{kind}: {about}", out / f"{kind}_{name}.png") for about, name in (("the mesh above water", "mesh"), ("RCS over azimuth, elevation 1 deg", "levels"), ("range-velocity map", "map"), ("ISAR image", "isar"))]
    seaglint("mesh", "info", mesh, "--picture", files[0][1], "--width", 900, "--azimuth-deg", 50, "--elevation-deg", 12)
    draw_levels(areas, files[1][1])
    scene = scenario(kind, out)
    for product, (_, file) in zip(("rv", "isar"), files[2:]):
        seaglint("map", scene, "--product", product, "-o", file)
    ship = {"kind": kind, "mesh": mesh, "afloat": text, "displacement_kt": displacement_kt, "files": files, "areas": areas, "shares": shares(parts)}
    ship["sea"], ship["free"] = rcs(mesh, sweep(SEA_AZIMUTHS), out, *SEA), thinned(areas, SEA_AZIMUTHS)
    ship["statistic"] = {element: skolnik_statistic(areas[element]) for element in ELEMENTS}
    ship["sectors"] = {element: sector_medians(areas[element]) for element in ELEMENTS}
    ship["skolnik"] = skolnik_m2(MIDDLE_MHZ, displacement_kt)
    ship["williams"] = tuple(end(WILLIAMS[row][i] for row in KINDS[kind][0]) for i, end in enumerate((min, max)))
    return ship


def step_change_db(areas):
    """Change of the statistic where every other azimuth is left out, dB; the smaller of halves weighs as the larger."""
    azimuths = sorted(areas)
    halves = [dbsm(skolnik_statistic({azimuth: areas[azimuth] for azimuth in azimuths[first::2]})) for first in (0, 1)]
    return max(abs(half - dbsm(skolnik_statistic(areas))) for half in halves)


def difference_db(ship, element):
    return dbsm(ship["statistic"][element]) - dbsm(ship["skolnik"])


def valid(ship):
    return VALID_KT[0] <= ship["displacement_kt"] <= VALID_KT[1]


def sea_gain_db(ship, element):
    """Gain of the statistic, and of the mean over all views, by the sea's reflection."""
    sea, free = ship["sea"][element], ship["free"][element]
    mean = [statistics.mean(area for values in areas.values() for area in values) for areas in (sea, free)]
    return dbsm(skolnik_statistic(sea)) - dbsm(skolnik_statistic(free)), dbsm(mean[0]) - dbsm(mean[1])


def distance_db(ship, element):
    """Distance from the literature: from Skolnik's formula where it is valid, else the larger of those of lowest and highest sector median from the range of Williams, Cramp and Curtis."""
    if valid(ship):
        return difference_db(ship, element)
    medians = ship["sectors"][element].values()
    return max((outside_db(end, ship["williams"]) for end in (min(medians), max(medians))), key=abs)


def change_db(changed, base, element):
    return dbsm(skolnik_statistic(changed[element])) - dbsm(skolnik_statistic(base[element]))


def solve_removals(ship, out):
    """Changes of the statistic without the part with the largest share, and without three."""
    base, parts = thinned(ship["areas"], PARTS_AZIMUTHS), [part for part, _ in ship["shares"][:3]]
    ship["removals"] = []
    for removed in (parts[:1], parts):
        areas = rcs(ship["mesh"], sweep(PARTS_AZIMUTHS), out, *(word for part in removed for word in ("--without", f"part={part}")))
        ship["removals"].append((removed, {element: change_db(areas, base, element) for element in ELEMENTS}))


def pair(values, form="{:+.1f}"):
    return " / ".join(form.format(value) for value in values)


def area(value):
    """m^2 to two digits."""
    return f"{float(f'{value:.2g}'):,.0f}" if value >= 10 else f"{value:.2g}"


LEVELS_HEAD = ["ship", "kilotons", "Skolnik, dBsm", "hh / vv, dBsm", "hh / vv - Skolnik, dB", "medians of the sectors, m^2: hh; vv", "Williams et al., m^2", "IALA, m^2", "hh; vv against Williams"]


def levels_row(ship):
    ends = {element: (min(medians.values()), max(medians.values())) for element, medians in ship["sectors"].items()}
    differences = pair(difference_db(ship, element) for element in ELEMENTS)
    design = KINDS[ship["kind"]][1]
    return [ship["kind"].replace("_", " "), f"{ship['displacement_kt']:.3g}", f"{dbsm(ship['skolnik']):.1f}", pair((dbsm(ship["statistic"][element]) for element in ELEMENTS), "{:.1f}"), differences if valid(ship) else f"({differences})",
            "; ".join(f"{area(low)} to {area(high)}" for low, high in ends.values()), f"{ship['williams'][0]:,} to {ship['williams'][1]:,}", f"{design:,}" if design else "", "; ".join(place(*ends[element], ship["williams"]) for element in ELEMENTS)]


PARTS_HEAD = ["ship", "parts with the largest share of the mean", "without the first, hh / vv, dB", "without the first three", "sea reflection, Hs 0.5 m: statistic, hh / vv, dB", "mean"]


def parts_row(ship):
    removals = [pair(change.values()) for _, change in ship.get("removals", [])] or ["", ""]
    gains = list(zip(*(sea_gain_db(ship, element) for element in ELEMENTS)))
    return [ship["kind"].replace("_", " "), ", ".join(f"{part} {share:.0%}" for part, share in ship["shares"][:3]), *removals, *(pair(gain) for gain in gains)]


ABOUT = f"""The reference ship of every kind (seed 0, laden), as <code>seaglint mesh make ship</code> makes it, of metal but for windows and, of the inflatable boat, tubes, console, seats and crew. RCS: 9.4 GHz, elevation 1 deg, every {STEP_DEG} deg, free space; the medians are over 21 frequencies from 9.2 to 9.6 GHz. Maps and images: Ku band by the defaults, seen from 40 deg off the bow, Hs 1.5 m. A click enlarges a picture."""
FORMULA = f"""<b>Skolnik's formula</b>: 52 f<sup>1/2</sup> D<sup>3/2</sup> m<sup>2</sup>, f in MHz, D in kilotons, from measurements of naval ships of 2 to 17 kt at grazing incidence (Skolnik, Introduction to Radar Systems, 1980, eq. 2.38); outside of these sizes differences are in brackets. Its statistic is the mean of the medians of port and starboard bow and quarter aspects, here 15 to 75 deg
from the bow and the stern, over all views and frequencies; the limits of these aspects are not published with it. Leaving out every other azimuth changes it by {{change}}. <b>Williams, Cramp and Curtis</b> (Electronic Circuits and Systems 2(4), 1978): lowest and highest median over the aspects of ships of similar length, here of sectors of 30 deg, as later authors repeat the table. <b>IALA</b> (Guideline 1111): values for design, no statistics.
Of these numbers only those of the fishing vessel of 9 m have been compared with a print."""
MECHANISMS = """Ships that are more than 6 dB away from Skolnik's formula, or outside of its sizes from the range of Williams et al., are computed without the parts with the largest share of the mean cross-section over bow and quarter. A part has the paths that end on it. Open cabinets and hoods are square trihedra, 12&pi;a<sup>4</sup>/&lambda;<sup>2</sup>, 32 to 39 dBsm each for
edges of 0.45 to 0.69 m, over some 25 deg; on ships most of them have doors. Upright walls and decks at right angles are dihedrals, and trihedra where walls meet. The levels above are those of free space, measured ones contain the sea's reflection: the last columns show what the four paths over a sea of Hs 0.5 m add to the statistic and to the mean at elevation 1 deg:
at most 12 dB for a point; more where two upright faces at right angles, which send little back at 1 deg, form a trihedron with the sea."""
LIMITS = """One ship of each kind and one elevation; displacement, not tonnage, is known of ours, and tonnage, not displacement, of the merchant ships. Measured medians contain ships of the years around 1970, their cranes, deck cargo, rigging and rust."""


def curve(ships):
    """Level against displacement."""
    sizes = [10 ** (0.1 * i) for i in range(-26, 19)]
    inside = [size for size in sizes if VALID_KT[0] * 0.95 <= size <= VALID_KT[1] * 1.05]
    data = [validation_plot.series("Skolnik", "lines", "#999999", [(size, dbsm(skolnik_m2(MIDDLE_MHZ, size))) for size in sizes]), validation_plot.series("Skolnik, 2 to 17 kt", "lines", "#000000", [(size, dbsm(skolnik_m2(MIDDLE_MHZ, size))) for size in inside])]
    data += [validation_plot.series(element, "points", colour, [(ship["displacement_kt"], dbsm(ship["statistic"][element])) for ship in ships]) for element, colour in zip(ELEMENTS, ("#0072b2", "#d55e00"))]
    williams = [(ship["displacement_kt"], [dbsm(end) for end in ship["williams"]]) for ship in ships]
    data.append(validation_plot.series("Williams et al., similar length", "points", "#009e73", [(size, sum(ends) / 2) for size, ends in williams], [ends[0] for _, ends in williams], [ends[1] for _, ends in williams]))
    panel = validation_plot.panel("median level against displacement", "displacement (kt)", "level (dBsm)", (-20, 75), data)
    panel["x"]["log"] = True
    return panel


def compare(out):
    """The section of the page, and its figures for validation.json; the tables as Markdown in fleet_tables.md."""
    start_s = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    ships = [solve(kind, out) for kind in KINDS]
    for ship in ships:
        if max(abs(distance_db(ship, element)) for element in ELEMENTS) > EXPLAINED_DB:
            print(f"    {ship['kind']} without parts ...", flush=True)
            solve_removals(ship, out)
    decoys, decoys_table, decoy_figures = validation_decoys.part(out)
    levels, parts = [levels_row(ship) for ship in ships], [parts_row(ship) for ship in ships]
    tables = "\n\n".join([validation_decoys.markdown(LEVELS_HEAD, levels), validation_decoys.markdown(PARTS_HEAD, parts), decoys_table])
    (out / "fleet_tables.md").write_text(tables + "\n", encoding="utf-8")
    minutes = (resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - start_s) / 60
    print(f"{tables}\n{minutes:.0f} minutes of processor time", flush=True)
    return section(ships, levels, parts, decoys, out), [ship_figures(ship) for ship in ships] + decoy_figures


def section(ships, levels, parts, decoys, out):
    changes = [step_change_db(areas) for ship in ships for areas in ship["areas"].values()]
    about = FORMULA.format(change=f"{statistics.median(changes):.1f} dB (median of ships and polarisations; largest {max(changes):.1f} dB)")
    sheet = "\n".join(f"<h3>{ship['kind'].replace('_', ' ')}</h3>\n<pre>{html.escape(ship['afloat'])}</pre>\n<div class=\"row\">{''.join(validation_page.enlarged(*file) for file in ship['files'])}</div>" for ship in ships)
    return f"""<section id="fleet"><h2>The fleet</h2>
<p>{ABOUT}</p>
{sheet}
<h3>Levels beside the literature</h3>
<p>{about}</p>
{validation_page.table(LEVELS_HEAD, levels)}
{validation_plot.figure([curve(ships)], out / "fleet.png", "median levels of the ships over displacement, with Skolnik's formula", (900, 640))}
<p>{MECHANISMS}</p>
{validation_page.table(PARTS_HEAD, parts)}
<p><b>Limits.</b> {LIMITS}</p>
{decoys}</section>"""


def ship_figures(ship):
    figures = {"ship": ship["kind"], "displacement_kt": ship["displacement_kt"], "skolnik_dbsm": dbsm(ship["skolnik"]), "shares": dict(ship["shares"][:5]), "without": [{"parts": parts, **{f"{element}_db": change for element, change in changes.items()}} for parts, changes in ship.get("removals", [])]}
    for element in ELEMENTS:
        gain, mean_gain = sea_gain_db(ship, element)
        figures.update({f"{element}_dbsm": dbsm(ship["statistic"][element]), f"{element}_sector_medians_dbsm": {f"{centre:g}": dbsm(median) for centre, median in ship["sectors"][element].items()}, f"{element}_sea_db": gain, f"{element}_sea_mean_db": mean_gain})
    return figures
