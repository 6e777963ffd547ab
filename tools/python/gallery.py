# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of the tutorials and of the gallery: their commands are run, the pictures stored or compared, the seconds written."""
import pathlib
import re
import tempfile

import numpy
from PIL import Image

import tutorial

COLOURS = 256  # of a stored picture
# Mean difference of a picture from the stored one, of 255: up to 1.3 by COLOURS; the rest, with which last digits of
# another processor change single pixels, is far less than a curve that moves or a map that changes.
TOLERANCE = 2.0
TAKES = re.compile(r"^Takes \d+ s\.$", re.MULTILINE)


def difference(stored, made):
    """Mean difference of two pictures, of 255; infinite for different sizes."""
    with Image.open(stored) as first, Image.open(made) as second:
        if first.size != second.size:
            return float("inf")
        return float(numpy.abs(numpy.asarray(first.convert("RGB"), float) - numpy.asarray(second.convert("RGB"), float)).mean())


def made_by(page, source, program, use, seconds=None):
    """Runs the commands of a page in an empty folder and calls use(stored, made) for each of its pictures."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        tutorial.run(page, source, folder, tutorial.environment_with(program), seconds)
        for stored, picture in tutorial.pictures(page, folder):
            use(stored, picture)


def compare(page, source, program):
    """A line for each picture of a page whose command makes another one than the stored picture."""
    found = []

    def look(stored, made):
        change = difference(stored, made) if stored.exists() else float("inf")
        if change > TOLERANCE:
            found.append(f"{made.name}: differs from the stored picture by {change:.2f} of 255 in the mean; tools/measure gallery stores it")

    made_by(page, source, program, look)
    return found


def store(page, source, program):
    """Stores the pictures of a page and writes the seconds of its commands; returns the number of pictures."""
    stored, seconds, before = [], {}, 0

    def keep(file, made):
        stored.append(file)
        with Image.open(made) as image:
            image.convert("RGB").quantize(COLOURS, dither=Image.Dither.NONE).save(file, optimize=True)

    made_by(page, source, program, keep, seconds)
    text = page.read_text(encoding="utf-8")

    def takes(match):  # the commands between this line and the one before
        nonlocal before
        line = text.count("\n", 0, match.start())
        taken = sum(of for at, of in seconds.items() if before < at <= line)
        before = line
        return f"Takes {max(1, round(taken))} s."

    page.write_text(TAKES.sub(takes, text), encoding="utf-8")
    return len(stored)
