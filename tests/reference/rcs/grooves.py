#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Scattering of upright grooves, perfectly conducting, by the integral equations of block_ship.py: grooves.py > grooves.csv

A groove is a closed prism with a section of two arms of 3 wavelengths, 0.4 thick, at an angle of 25 or 80 deg, open towards azimuth 0, and a height of 3 wavelengths. Seen from above its echo is cross-polarised.
Columns: angle of the groove, azimuth and elevation, deg; S in wavelengths, hh, hv, vv, as in block_ship.csv.
"""
import numpy as np

from block_ship import Mesh, scattering_matrices

ARM, THICK, HEIGHT = 3, 0.4, 3
LONGEST_SIDE = 0.16  # of the rectangles that two triangles form, wavelengths


def groove(angle_deg):
    half = np.radians(angle_deg / 2)
    end = ARM * np.array([np.cos(half), np.sin(half)])
    back, apex = end + THICK * np.array([-np.sin(half), np.cos(half)]), np.array([-THICK / np.sin(half), 0])
    count = lambda length: int(np.ceil(length / LONGEST_SIDE))
    along, across, up = count(np.linalg.norm(back - apex)), count(THICK), count(HEIGHT)
    numbers, places, triangles = {}, [], []

    def node(place):
        key = tuple(np.round(place, 9) + 0.0)
        if key not in numbers:
            numbers[key] = len(places)
            places.append(place)
        return numbers[key]

    def patch(at, columns, rows, outwards):
        for i in range(columns):
            for j in range(rows):
                p, q, r, s = (node(at(u / columns, v / rows)) for u, v in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)))
                pair = [(p, q, r), (p, r, s)] if (i + j) % 2 else [(p, q, s), (q, r, s)]
                triangles.extend(pair if outwards else [t[::-1] for t in pair])

    for side in (1, -1):
        mirror = np.array([1, side])
        wall = lambda a, b: lambda u, v: np.array([*(mirror * (a + u * (b - a))), (v - 0.5) * HEIGHT])
        patch(wall(np.zeros(2), end), along, up, side > 0)
        patch(wall(end, back), across, up, side > 0)
        patch(wall(back, apex), along, up, side > 0)
        for z in (0.5, -0.5):
            cap = lambda u, v, z=z: np.array([*(mirror * ((1 - v) * u * end + v * (apex + u * (back - apex)))), z * HEIGHT])
            patch(cap, along, across, (side > 0) == (z > 0))
    return Mesh(places, triangles)


if __name__ == "__main__":
    print("angle_deg,azimuth_deg,elevation_deg,hh_re,hh_im,hv_re,hv_im,vv_re,vv_im")
    for angle, azimuths in ((25, np.arange(0, 33, 1.0)), (80, np.arange(0, 61, 2.0))):
        directions = np.array([(azimuth, elevation) for elevation in (5.0, 15.0, 30.0) for azimuth in azimuths])
        for (azimuth, elevation), S in zip(directions, scattering_matrices(groove(angle), 2 * np.pi, *directions.T)):
            echoes = [S[0, 0], 0.5 * (S[0, 1] + S[1, 0]), S[1, 1]]
            print(f"{angle},{azimuth:g},{elevation:g}," + ",".join(f"{x.real:.5f},{x.imag:.5f}" for x in echoes))
