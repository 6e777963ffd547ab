# SPDX-License-Identifier: BSD-3-Clause
"""The page and the JSON of tools/validation."""
import base64
import gzip
import html
import json

from figure_tables import ROOT

STYLE = """main > p, section > p { max-width: none; }
td:nth-child(n+2):not(:last-child) { white-space: nowrap; }
img.mesh { float: right; width: 300px; margin: 0 0 1em 1.5em; }
section, section pre { clear: both; }
.row { display: grid; grid-template-columns: repeat(4, 1fr); gap: 10px; align-items: center; }
.row img { width: 100%; height: auto; border: 1px solid var(--line); cursor: zoom-in; }
.row input { position: absolute; opacity: 0; }
.row input:checked + img { position: fixed; inset: 4vh 0 0; margin: auto; width: auto; max-width: 96vw; max-height: 92vh; background: #fff; cursor: zoom-out; z-index: 1; }
"""

LEAD = """<p>{version}, edge diffraction on unless stated. <b>Errors</b> are mean of the magnitude / rms in dB against the reference, both sides clipped at 80 dB (box, almond, ship and grooves: 40 dB) below the reference's maximum, over all directions or
frequencies of the cut; nothing is interpolated. <b>Measured</b> is the measurement against the same reference: the difference of two references. <b>Numerical</b>: mean change of our own levels in dB with patches of a quarter of the side (of a cavity: 8 in place of 6 per wavelength),
80 bounces in place of 40 (rays in the duct: 24 of 12), and flat in place of smooth facets, over some of the directions. <b>Rays</b>: the same by shooting and bouncing rays, with edge diffraction as the case; "rays - beams" is the mean change of the levels from beams to rays. Where these are far below the error, the error is that of the physics in the model; finer meshes and more rays will not mend it.</p>"""


def cell(pair):
    return " / ".join(pair) if pair else "-"


def change(value):
    return "-" if value is None else f"{value:.3f}"


def table(head, rows):
    lines = ['<div class="scroll"><table>', "<tr>" + "".join(f"<th>{c}</th>" for c in head) + "</tr>"]
    lines += ["<tr>" + "".join(f"<td>{c}</td>" for c in row) + "</tr>" for row in rows]
    return "\n".join(lines + ["</table></div>"])


def picture(file):
    return "data:image/png;base64," + base64.b64encode(file.read_bytes()).decode()


def enlarged(about, file):
    """A picture of a row that a click enlarges."""
    about = html.escape(about)
    return f'<label><input type="checkbox"><img alt="{about}" title="{about}" src="{picture(file)}"></label>'


def summary(results):
    rows = []
    for case, cuts in results:
        for i, cut in enumerate(cuts):
            title = f'<a href="#{case.name}">{html.escape(case.about)}</a>' if i == 0 else ""
            rows.append([title, cut.name, cell(cut.differences.get("po+diffraction")), cell(cut.differences.get("po")), cell(cut.differences.get("rays")), cell(cut.differences.get("measured")),
                         cut.solver(cut.correlation) or "-", *(change(cut.changes.get(kind)) for kind in ("patches", "bounces", "flat", "rays")), html.escape(case.goal) if i == 0 else ""])
    return table(["case", "cut", "with edge diffraction", "physical optics alone", "by rays", "measured", "complex correlation", "patches", "bounces", "flat facets", "rays - beams", "goal"], rows)


def printed_table(file):
    return "\n".join(line for line in file.read_text(encoding="utf-8").splitlines() if not line.startswith(("Figure", "Curves")))


def section(case, out):
    printed = printed_table(out / f"{case.name}.txt")
    if case.rays:
        printed += "\n\nBy rays. " + printed_table(out / f"{case.name}_rays.txt")
    note = f"<p><b>Limits.</b> {case.note}</p>" if case.note else ""
    return f"""<section id="{case.name}"><h2>{html.escape(case.title)}</h2>
<img class="mesh" alt="the mesh from azimuth {case.view[0]}, elevation {case.view[1]} deg" src="{picture(out / f'{case.name}_mesh.png')}">
<p><b>Geometry.</b> {html.escape(case.geometry)}</p>
<p><b>Reference.</b> {case.source}</p>
{note}
{curves(case, out)}
<pre>{html.escape(printed)}</pre></section>"""


def curves(case, out):
    """The levels and differences as a picture, and for the script of the page as curves in its place."""
    plot = (out / f"{case.name}_curves.json").read_text(encoding="utf-8").strip()
    return f"""<figure class="plot"><img alt="{html.escape(case.title)}: levels and differences" src="{picture(out / f'{case.name}.png')}"><script type="application/json">{plot}</script></figure>"""


def scripts():
    """plotly and the script of the program's own pages."""
    plotly = gzip.compress((ROOT / "build/release/generated/plotly.min.js").read_bytes(), 9, mtime=0)
    return f"""<script type="text/plain" id="plotly">{base64.b64encode(plotly).decode()}</script>
<script>
{(ROOT / "tools/page/page.js").read_text(encoding="utf-8")}</script>"""


def text_section(title, about, text):
    return f"<section><h2>{title}</h2>\n<p>{about}</p>\n<pre>{html.escape(text)}</pre></section>"


def page(version, results, flashes, others, sections, out):
    """others: (title, text in HTML, printed text); sections: finished ones."""
    parts = ["<header>\n<h1>The solver against references</h1>\n</header>"]
    if results:
        parts += [LEAD.format(version=html.escape(version)), summary(results)]
    if flashes:
        parts.append(table(["flash of the box, HH, 10.24 GHz: azimuth (deg)", "computed (dBsm)", "reference (dBsm)", "difference (dB)"], flashes))
    parts += [section(case, out) for case, _ in results] + [text_section(*other) for other in others] + sections
    return f"""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,">
<title>seaglint: the solver against references</title>
<style>
{(ROOT / "tools/page/style.css").read_text(encoding="utf-8")}{STYLE}</style>
</head>
<body>
<main>
{chr(10).join(parts)}
</main>
{scripts()}
</body></html>
"""


def cases_text(results):
    """One line per cut, which tools/measure reads: name|case|cut|with diffraction|physical optics|measured|correlation|goal."""
    lines = []
    for case, cuts in results:
        for cut in cuts:
            cells = [cell(cut.differences.get(kind)) for kind in ("po+diffraction", "po", "measured")]
            lines.append("|".join([case.name, case.about, cut.name, *cells, cut.solver(cut.correlation) or "-", case.goal]))
    return "\n".join(lines) + "\n"


def figures(results, others, commit, version):
    """All figures, for comparisons of versions; others: those of finished sections by name."""
    def difference(pair):
        return None if pair is None else {"mean_db": float(pair[0]), "rms_db": float(pair[1])}

    cases = []
    for case, cuts in results:
        for cut in cuts:
            correlation = cut.solver(cut.correlation)
            cases.append({"name": case.name, "case": case.about, "cut": cut.name, "reference": case.source,
                          "po_and_diffraction": difference(cut.differences.get("po+diffraction")), "physical_optics": difference(cut.differences.get("po")), "rays": difference(cut.differences.get("rays")), "measured": difference(cut.differences.get("measured")),
                          "correlation": None if correlation is None else float(correlation),
                          "change_db": {kind: None if kind not in cut.changes else round(cut.changes[kind], 4) for kind in ("patches", "bounces", "flat", "rays")}, "goal": case.goal})
    return json.dumps({"version": version, "commit": commit, "cases": cases, **others}, indent=2) + "\n"
