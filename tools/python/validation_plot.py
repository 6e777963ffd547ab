# SPDX-License-Identifier: BSD-3-Clause
"""Panels of curves on the page of tools/validation: for the script of the page, and as a picture by gnuplot where no script runs."""
import html
import json
import subprocess

import validation_page
from validation_run import Failure


def gnuplot(script, file):
    """Draws a list of lines of gnuplot, which set the output to the file."""
    result = subprocess.run(["gnuplot"], input="\n".join(script), capture_output=True, text=True)
    if result.returncode != 0 or not file.exists():
        raise Failure(f"gnuplot: {result.stderr}")


def series(name, style, colour, points, low=None, high=None):
    """points: (x, y). style: points, lines, linespoints or band; low and high: ends of error bars or of the band."""
    made = {"name": name, "style": style, "colour": colour, "x": [float(x) for x, _ in points], "y": [float(y) for _, y in points]}
    if low is not None:
        made.update(low=[float(y) for y in low], high=[float(y) for y in high])
    return made


def panel(title, x, y, span, data):
    """x, y: labels; span: lowest and highest y."""
    return {"title": title, "x": {"label": x, "log": False}, "y": {"label": y, "log": False, "range": list(span)}, "equal": False, "series": data}


def draw(panels, file, size=(1400, 1000)):
    """The panels, two beside each other, as a picture."""
    styles = {"points": "points pt 7 ps 1.3", "lines": "lines lw 2", "linespoints": "linespoints pt 6 lw 2"}
    script = [f'set terminal pngcairo size {size[0]},{size[1]} font "sans,13"; set output "{file}"', f"set multiplot layout {(len(panels) + 1) // 2},{min(len(panels), 2)}", "set grid; set key top left; set autoscale xfix; set offsets graph 0.02, graph 0.02, 0, 0"]
    for plot in panels:
        low, high = plot["y"]["range"]
        above = 0.35 if any(one["name"] for one in plot["series"]) else 0.05  # room for the names
        scale = "set" if plot["x"]["log"] else "unset"
        script += [f'set title "{plot["title"]}"; set xlabel "{plot["x"]["label"]}"; set ylabel "{plot["y"]["label"]}"; {scale} logscale x; set yrange [{low}:{high + above * (high - low)}]']
        drawn = []
        for one in plot["series"]:
            style = f"filledcurves fs transparent solid 0.3 noborder lc rgb '{one['colour']}'" if one["style"] == "band" else f"{'yerrorbars pt 7 ps 1.3' if 'low' in one else styles[one['style']]} lc rgb '{one['colour']}'"
            drawn.append(f"'-' title \"{one['name']}\" with {style}")
        script.append("plot " + ", ".join(drawn))
        for one in plot["series"]:
            columns = [one["x"], *([] if one["style"] == "band" else [one["y"]]), *([one["low"], one["high"]] if "low" in one else [])]
            script += [" ".join(map(str, values)) for values in zip(*columns)] + ["e"]
    gnuplot(script, file)


def figure(panels, file, about, size=(1400, 1000)):
    """The panels as a figure of the page, with the picture in the file."""
    draw(panels, file, size)
    plot = json.dumps({"columns": min(len(panels), 2), "panels": panels}).replace("<", "\\u003c")
    return f'<figure class="plot"><img alt="{html.escape(about)}" src="{validation_page.picture(file)}"><script type="application/json">{plot}</script></figure>'
