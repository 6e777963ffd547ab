# SPDX-License-Identifier: BSD-3-Clause
"""Meshes (Wavefront OBJ, metres) and reference tables that tools/validation makes from formulas and reference data."""
import csv
import math

C = 299792458.0


def obj(vertices, faces):
    """Faces count their vertices from 0."""
    lines = ["v {:.9f} {:.9f} {:.9f}".format(*v) for v in vertices]
    return "\n".join(lines + ["f " + " ".join(str(i + 1) for i in face) for face in faces]) + "\n"


def almond(around=96, along=40):
    """The almond of 9.936 inch, tip ahead (Woo, Wang, Schuh and Sanders, IEEE Antennas Propag. Mag. 35(1), 1993, 84-89)."""
    d = 9.936 * 0.0254

    def ring(t):
        if t < 0:
            r = math.sqrt(1 - (t / 0.416667) ** 2)
            y, z = 0.193333 * d * r, 0.064444 * d * r
        else:
            r = math.sqrt(1 - (t / 2.08335) ** 2) - 0.96
            y, z = 4.83345 * d * r, 1.61115 * d * r
        angles = [2 * math.pi * j / around for j in range(around)]
        return [(d * t, y * math.cos(a), z * math.sin(a)) for a in angles]

    stations = [-0.416667 * math.cos(math.pi / 2 * i / along) for i in range(1, along)] + [0.58333 * i / along for i in range(along)]
    vertices = [(-0.416667 * d, 0, 0)] + [v for t in stations for v in ring(t)] + [(0.58333 * d, 0, 0)]
    tip, last = len(vertices) - 1, 1 + (len(stations) - 1) * around
    faces = []
    for j in range(around):
        k = (j + 1) % around
        faces += [(0, 1 + k, 1 + j), (tip, last + j, last + k)]
        for i in range(len(stations) - 1):
            a, b = 1 + i * around + j, 1 + i * around + k
            faces += [(a, b, b + around), (a, b + around, a + around)]
    return obj(vertices, faces)


def top_hat(radius, height=0.4, reach=2, strips=48):
    """A closed cylinder on a plate."""
    angles = [2 * math.pi * i / strips for i in range(strips)]
    vertices = [(radius * math.cos(a), radius * math.sin(a), height * j) for j in range(2) for a in angles]
    vertices += [(0, 0, height)] + [(x * reach, y * reach, 0) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    faces = []
    for i in range(strips):
        j = (i + 1) % strips
        faces += [(i, j, j + strips), (i, j + strips, i + strips), (i + strips, j + strips, 2 * strips)]
    p = 2 * strips + 1
    return obj(vertices, faces + [(p, p + 1, p + 2), (p, p + 2, p + 3)])


def top_hat_table(radius, height=0.4, elevation_deg=40, frequency_hz=8e9):
    """sigma = 4 pi (2 h sqrt(k R cos(el) / 4 pi))^2, as curved_surface_test.cpp derives it."""
    amplitude2 = 4 * height**2 * (2 * math.pi * frequency_hz / C) * radius * math.cos(math.radians(elevation_deg)) / (4 * math.pi)
    level = 10 * math.log10(4 * math.pi * amplitude2)
    rows = [f"{frequency_hz:.9g},{azimuth},{elevation_deg},{level:.9g},{level:.9g}" for azimuth in range(0, 91, 3)]
    return "\n".join(["frequency_hz,azimuth_deg,elevation_deg,hh_dbsm,vv_dbsm", *rows]) + "\n"


def rough_trihedral(leg, noise=0.0001, facet=0.02):
    """Three squares of small facets, each coordinate off its place by a normal number of this standard deviation
    (sum of 12 numbers of the generator of Park and Miller, Comm. ACM 31, 1988, 1192)."""
    state = 1

    def normal():
        nonlocal state
        total = -6.0
        for _ in range(12):
            state = state * 16807 % 2147483647
            total += state / 2147483647
        return total

    n = round(leg / facet)
    vertices, faces = [], []
    for face in range(3):
        for j in range(n + 1):
            for i in range(n + 1):
                u, v = leg * i / n, leg * j / n
                place = ((u, v, 0), (0, u, v), (v, 0, u))[face]
                vertices.append(tuple(x + noise * normal() for x in place))
    for face in range(3):
        for j in range(n):
            for i in range(n):
                a = face * (n + 1) ** 2 + j * (n + 1) + i
                c = a + n + 1
                faces += [(a, a + 1, c + 1), (a, c + 1, c)]
    return obj(vertices, faces)


def block_ship():
    """Hull and house of block_ship.py, a wavelength of 1 m."""
    def rectangle(half_length, half_width, z):
        return [(x * half_length, y * half_width, z) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]

    vertices = rectangle(3, 0.8, 0) + rectangle(3, 0.8, 1.2) + rectangle(0.9, 0.5, 1.2) + rectangle(0.9, 0.5, 2.4)
    faces = [(0, 3, 2, 1), (12, 13, 14, 15)]
    for first in (0, 4, 8):
        faces += [(first + i, first + (i + 1) % 4, first + 4 + (i + 1) % 4, first + 4 + i) for i in range(4)]
    return obj(vertices, faces)


def groove(angle_deg, arm=3, thick=0.4, height=3):
    """The upright groove of grooves.py, a wavelength of 1 m."""
    half = math.radians(angle_deg / 2)
    end = (arm * math.cos(half), arm * math.sin(half))
    back = (end[0] - thick * math.sin(half), end[1] + thick * math.cos(half))
    corners = [(0, 0), end, back, (-thick / math.sin(half), 0), (back[0], -back[1]), (end[0], -end[1])]
    n = len(corners)
    vertices = [(x, y, z) for z in (-height / 2, height / 2) for x, y in corners]
    faces = [(i, (i + 1) % n, n + (i + 1) % n, n + i) for i in range(n)]
    for i in range(1, n - 1):
        faces += [(0, i + 1, i), (n, n + i, n + i + 1)]
    return obj(vertices, faces)


def table(rows, columns, frequency_hz):
    """Rows of a reference (dictionaries) as a table of `seaglint rcs`."""
    head = ["frequency_hz", "azimuth_deg", "elevation_deg"] + columns
    lines = [",".join([f"{frequency_hz:.9g}"] + [row[c] for c in head[1:]]) for row in rows]
    return "\n".join([",".join(head), *lines]) + "\n"


def rows_of(file, **equal):
    """Rows whose columns have these numbers."""
    with open(file, encoding="utf-8") as stream:
        return [row for row in csv.DictReader(stream) if all(float(row[k]) == v for k, v in equal.items())]


def trihedral_table(file, azimuth_deg):
    """The full-wave results, in wavelengths at leg 4 f_rel, for legs of 4 m."""
    with open(file, encoding="utf-8") as stream:
        rows = [row for row in csv.reader(stream) if row[0] == str(azimuth_deg)]
    v, h = ({row[2]: row[9:11] for row in rows if row[1] == which} for which in "VH")
    lines = [f"{float(f) * C:.9g},{45 + azimuth_deg},35.264389682754654," + ",".join(h[f] + v[f]) for f in h]
    return "\n".join(["frequency_hz,azimuth_deg,elevation_deg,hh_re,hh_im,vv_re,vv_im", *lines]) + "\n"


def mie_table(file, radius):
    """S / a over ka as S over frequency, for a sphere whose ka is the frequency in GHz."""
    with open(file, encoding="utf-8") as stream:
        rows = list(csv.reader(stream))[1:]
    lines = ["{:.9g},23,11,{:.9g},{:.9g},{:.9g},{:.9g}".format(float(ka) * 1e9, *(radius * float(x) for x in (re, im, re, im))) for ka, re, im in rows]
    return "\n".join(["frequency_hz,azimuth_deg,elevation_deg,hh_re,hh_im,vv_re,vv_im", *lines]) + "\n"


def square_trihedral_dbsm(leg, frequency_hz):
    """sigma = 12 pi a^4 / lambda^2 on axis: 4 pi A^2 / lambda^2 of the aperture A = sqrt(3) a^2."""
    return 10 * math.log10(12 * math.pi * leg**4 / (C / frequency_hz) ** 2)
