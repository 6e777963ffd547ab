#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""gallery_test.py SEAGLINT SOURCE: the commands of the gallery print what it says and make its pictures."""
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True


def main(seaglint, source):
    source = pathlib.Path(source).resolve()
    sys.path.insert(0, str(source / "tools/python"))
    import gallery
    check_difference(gallery)
    differing = gallery.compare(source / "tools/tutorials/gallery.md", source, pathlib.Path(seaglint).resolve())
    if differing:
        sys.exit("\n".join(differing))


def check_difference(gallery):
    """What the test relies on: a line that moves by its width and another size are found, fewer colours are not."""
    from PIL import Image, ImageDraw
    with tempfile.TemporaryDirectory() as folder:
        files = [pathlib.Path(folder, f"{i}.png") for i in range(4)]
        for file, shift, size in ((files[0], 0, 300), (files[1], 4, 300), (files[2], 0, 310)):
            image = Image.new("RGB", (size, 200), "white")
            ImageDraw.Draw(image).line([(0, 100 + shift), (150, 50 + shift), (300, 150 + shift)], fill="#0072b2", width=3)
            image.save(file)
        with Image.open(files[0]) as image:
            image.quantize(gallery.COLOURS).save(files[3])
        assert gallery.difference(files[0], files[3]) < gallery.TOLERANCE < gallery.difference(files[0], files[1])
        assert gallery.difference(files[0], files[2]) == float("inf")


main(*sys.argv[1:])
