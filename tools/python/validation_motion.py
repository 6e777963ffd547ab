# SPDX-License-Identifier: BSD-3-Clause
"""Motion beside measurements, a section of the page of tools/validation: KCS models in a tank, buoys in the ocean, from the output of test_motion; S175 against VERES."""
import html
import subprocess

import validation_page
import validation_plot
from validation_run import Failure, seaglint

TESTS = ["build/release/test_motion", "--gtest_filter=KcsModelTests.*:OceanBuoys.*"]

# The command of sim/motion/ship/README.md.
S175 = {"sections": "tests/reference/ship_motion/s175_sections.csv", "metacentric_height_m": 0.996, "roll_gyradius_m": 8.331, "pitch_gyradius_m": 42, "yaw_gyradius_m": 42, "roll_damping": 0.05, "speed_mps": 10.29}

KCS_ABOUT = """The container ship KCS from its published coefficients against two models of the Tokyo 2015 workshop at Fr 0.26 (<code>tests/reference/ship_motion/kcs</code>), measured to about 5 %: heave over wave amplitude, pitch over wave slope, roll. Heading 0 is a head sea."""
KCS_LIMITS = """Strip theory has no flow along the hull: in head and bow seas waves no longer than the ship pitch it too much. Roll of less than a degree depends on how the model is held in sway and yaw."""
BUOY_ABOUT = """Tilt over wave slope of two moored buoys of 6 m in the ocean (<code>tests/reference/ship_motion/doe_buoy</code>), by band. Natural period of roll, damping and effective slope coefficient of the float are fitted to the first half of a record of 30 minutes ({fits}); pitch has three quarters of the period of roll; the second half and the whole of z06 are computed with them. Error bars: standard error of the record."""
BUOY_LIMITS = """In swell (below 0.13 Hz) z05 tilts by 0.8 of the slope, as its accelerometers confirm, presumably by its mooring, and its roll lags by 20 to 30 deg: the coefficient has the ratio, not the lag. In the low swell of z06 (0.10 to 0.13 Hz, 0.3 deg) the halves of the record differ by a quarter."""


def printed_rows():
    """What the tests print, by the first word of the lines: the cells of each line."""
    result = subprocess.run(TESTS, capture_output=True, text=True)
    if result.returncode != 0:
        raise Failure(f"{' '.join(TESTS)}\n{result.stdout}{result.stderr}")
    rows = {"kcs": [], "kcs_curve": [], "buoy": [], "fit": []}
    for line in result.stdout.splitlines():
        word, *cells = line.split(",")
        if word in rows and cells[0] not in ("case", "wave_length_per_lpp", "buoy"):
            rows[word].append(cells)
    if not all(rows.values()):
        raise Failure(f"{' '.join(TESTS)} printed no {', '.join(word for word, found in rows.items() if not found)}")
    return rows


COLOURS = {"heave": "#0072b2", "pitch": "#d55e00", "tilt": "#0072b2"}


def series(quantity, kind, style, points, errors=None):
    ends = {} if errors is None else {name: [float(y) + sign * error for (_, y), error in zip(points, errors)] for name, sign in (("low", -1), ("high", 1))}
    return validation_plot.series(f"{quantity}, {kind}", style, COLOURS[quantity], points, **ends)


def panel(title, x, y, data):
    return validation_plot.panel(title, x, y, (0, 1.1 * max(max(s.get("high", s["y"])) for s in data)), data)


def panels(rows):
    def kcs(case, quantity, x, y):
        return [(row[x], row[y]) for row in rows["kcs"] if row[0] == case and row[3] == quantity]

    head = []
    for i, quantity in enumerate(("heave", "pitch"), 1):
        head += [series(quantity, "measured", "points", kcs("2.10", quantity, 1, 4)), series(quantity, "computed", "lines", [(row[0], row[i]) for row in rows["kcs_curve"]])]
    around = []
    for quantity in ("heave", "pitch"):
        around += [series(quantity, "measured", "points", kcs("2.11", quantity, 2, 4)), series(quantity, "computed", "linespoints", kcs("2.11", quantity, 2, 5))]
    made = [panel("KCS, head sea", "wave length over ship's length", "heave per amplitude, pitch per slope", head),
            panel("KCS, waves of its length", "heading (deg)", "heave per amplitude, pitch per slope", around)]
    for buoy in ("z05", "z06"):
        bands = [row for row in rows["buoy"] if row[:2] == [buoy, "second"]]
        middle = [(float(row[2]) + float(row[3])) / 2 for row in bands]
        made.append(panel(f"buoy {buoy}, second half", "frequency (Hz)", "tilt per slope",
                          [series("tilt", "measured", "points", list(zip(middle, (row[4] for row in bands))), [float(row[5]) for row in bands]), series("tilt", "computed", "linespoints", list(zip(middle, (row[6] for row in bands))))]))
    return made


def cells(row, case):
    return [case, row[1], row[2], row[3], row[4], f"{float(row[5]):.3g}", f"{float(row[5]) / float(row[4]) - 1:+.0%}" if row[3] != "roll" else f"{float(row[5]) - float(row[4]):+.1f}"]


def compare(out):
    """The section of the page, and its figures for validation.json."""
    rows = printed_rows()
    figure = validation_plot.figure(panels(rows), out / "motion.png", "heave and pitch of KCS, tilt of two buoys: measured and computed")
    s175 = out / "s175.png"
    settings = [word for key, value in S175.items() for word in ("--set", f"targets.ship.motion.{key}={value}")]
    seaglint("motion", "scenarios/quick.yaml", *settings, "--set", "sea.propagation_deg=120", "--duration-s", 10, "--rao", s175, "--rao-reference", "tests/reference/ship_motion/s175_veres.re1", "-o", out / "s175.csv")
    fits = "; ".join(f"{name}: {float(period):g} s, {float(damping):g}, {float(slope):g}" for name, period, damping, slope in rows["fit"])
    kcs = [cells(row, row[0]) for row in rows["kcs"]]
    buoys = [[row[0], row[1], f"{row[2]}-{row[3]}", row[4], row[5], row[6], f"{float(row[6]) / float(row[4]) - 1:+.0%}"] for row in rows["buoy"] if row[1] != "first"]
    section = f"""<section id="motion"><h2>Motion beside measurements</h2>
<p>{KCS_ABOUT}</p>
<p>{BUOY_ABOUT.format(fits=html.escape(fits))}</p>
<p><b>Limits.</b> {KCS_LIMITS} {BUOY_LIMITS}</p>
{figure}
{validation_page.table(["KCS, case", "wave length over ship's length", "heading (deg)", "quantity", "measured", "computed", "difference (roll: deg)"], kcs)}
{validation_page.table(["buoy", "part of the record", "band (Hz)", "tilt per slope, measured", "standard error", "computed", "difference"], buoys)}
<p>The same strip theory against another one, VERES, which has the true lines of the hull: S175 towards 120 deg at 20 knots.</p>
<figure><img alt="responses of S175, computed and by VERES" src="{validation_page.picture(s175)}"></figure></section>"""
    figures = [{"body": "KCS", "case": row[0], "wave_length_per_lpp": float(row[1]), "heading_deg": float(row[2]), "quantity": row[3], "measured": float(row[4]), "computed": float(row[5])} for row in rows["kcs"]]
    figures += [{"body": row[0], "part": row[1], "low_hz": float(row[2]), "high_hz": float(row[3]), "quantity": "tilt per slope", "measured": float(row[4]), "computed": float(row[6])} for row in rows["buoy"]]
    return section, figures
