# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of the tutorials and of the gallery: their commands are run, the pictures stored or compared, the seconds written."""
import pathlib
import re
import tempfile

import numpy
from PIL import Image

import tutorial

COLOURS = 256  # of a stored picture
# Pixels that differ visibly from the stored picture's, by LEAST of 255 in one colour, over those that are drawn at all: up
# to 0.15 % by COLOURS; 2.6 % where the numbers of one axis move and two curves change in a few places.
LEAST, TOLERANCE = 64, 0.005
TAKES = re.compile(r"^Takes \d+ s\.$", re.MULTILINE)


def difference(stored, made):
    """Share of the drawn pixels of a stored picture that another one has differently; infinite for different sizes."""
    with Image.open(stored) as first, Image.open(made) as second:
        if first.size != second.size:
            return float("inf")
        old, new = (numpy.asarray(image.convert("RGB"), int) for image in (first, second))
    colours, counts = numpy.unique(old.reshape(-1, 3), axis=0, return_counts=True)
    drawn = abs(old - colours[counts.argmax()]).max(axis=2) > LEAST / 4
    return (abs(old - new).max(axis=2) > LEAST).sum() / max(1, drawn.sum())


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
            found.append(f"{made.name}: {100 * change:.1f} % of what is drawn differs from the stored picture; tools/measure gallery stores it")

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
