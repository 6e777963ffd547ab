#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Scattering of infinitely long perfectly conducting prisms at 10.24 GHz, by integral equations: sections.py > sections.csv

The currents on the outline of the cross-section, on elements graded towards its vertices; pulses and point matching for the soft field (along the edges), triangles
and the weak form of the hypersingular equation (A. W. Maue, Z. Phys. 126, 1949, 601-618) for the hard one; for large sections combined with the double-layer
equation (A. J. Burton and G. F. Miller, Proc. R. Soc. A 323, 1971, 201-210), since alone it has the interior resonances of the outline as solutions, which no practicable element
size removes.

Needs numpy and scipy. Columns: azimuths of transmitter and receiver, deg; P soft (vv of an upright prism) and hard (hh), the amplitude of the
field's component along the edges as P sqrt(2 / pi k r) e^{-jkr + j pi/4}, e^{+jwt}, phase from the origin of the cross-section; its name.
"""
import numpy as np
from scipy.special import j0, j1, y0, y1

WAVELENGTH = 299792458 / 10.24e9


def graded(length, smallest, largest, growth=1.2):  # positions from 0 to length, dense at both ends
    s, h = [0.0], smallest
    while s[-1] < length / 2:
        s.append(s[-1] + h)
        h = min(growth * h, largest)
    s = np.array(s) * (length / 2 / s[-1])
    return np.r_[s, (length - s[::-1])[1:]]


def directions(azimuths_deg):
    return np.c_[np.cos(np.radians(azimuths_deg)), np.sin(np.radians(azimuths_deg))]


def closed(corners, smallest, largest):  # the nodes along a polygon
    corners = np.array(corners)
    sides = [(a, b - a, np.linalg.norm(b - a)) for a, b in zip(corners, np.roll(corners, -1, 0))]
    return np.array([a + along * s / length for a, along, length in sides for s in graded(length, smallest, largest)[:-1]])


def echoes(p, k, incident, scattered, combined=False):  # P soft and hard [receiver, transmitter] of the outline through the nodes p; unit vectors towards receiver and transmitter
    q = np.roll(p, -1, 0)
    middle, length = (p + q) / 2, np.linalg.norm(q - p, axis=1)
    tangent = (q - p) / length[:, None]
    normal = np.c_[tangent[:, 1], -tangent[:, 0]]
    points, weights = np.polynomial.legendre.leggauss(4)

    def integral_of_ln(x):  # over each element, for the observer x
        d = x[:, None, :] - p[None, :, :]
        a, b = np.einsum("ijk,jk->ij", d, tangent), np.einsum("ijk,jk->ij", d, normal)

        def primitive(u):
            with np.errstate(all="ignore"):
                value = 0.5 * u * np.log(u * u + b * b) - u + np.abs(b) * np.arctan2(u, np.abs(b))
            return np.where(u * u + b * b < 1e-300, 0, value)

        return primitive(a) - primitive(a - length[None, :])

    smooth = np.zeros((len(p), len(p)), complex)  # integral of H0 less its logarithmic part
    for x, w in zip(points, weights):
        r = np.maximum(np.linalg.norm(middle[:, None, :] - (p + 0.5 * (1 + x) * length[:, None] * tangent)[None], axis=2), 1e-12)
        smooth += (j0(k * r) - 1j * (y0(k * r) - 2 / np.pi * np.log(r))) * (0.5 * w * length)[None, :]
    G = smooth - 2j / np.pi * integral_of_ln(middle)
    twice = sum(0.5 * w * integral_of_ln(p + 0.5 * (1 + x) * length[:, None] * tangent) for x, w in zip(points, weights))
    np.fill_diagonal(twice, length * (np.log(length) - 1.5))
    double = length[:, None] * (smooth - 2j / np.pi * twice)
    double = 0.5 * (double + double.T)
    before = np.roll(np.arange(len(p)), 1)
    equal, mixed = lambda M: M + M[np.ix_(before, before)], lambda M: M[before] + M[:, before]  # of triangle functions on two elements
    currents, charges = k**2 * (normal @ normal.T) * double, double / (length[:, None] * length[None, :])
    Z = 0.25 * (equal(currents) + mixed(currents)) - (equal(charges) - mixed(charges))

    def double_layer():  # (-2j + D) u = incident field, tested like Z u = its normal derivative; D the integral of dH0/dn', u the field on the outline over -4j
        D = np.zeros((len(p), len(p)), complex)
        for x, w in zip(points, weights):
            d = p[None, :, :] - (p + 0.5 * (1 + x) * length[:, None] * tangent)[:, None, :]
            a, b = -np.einsum("ijk,jk->ij", d, tangent), -np.einsum("ijk,jk->ij", d, normal)
            angle = -np.sign(b) * (np.arctan2(a, np.abs(b)) - np.arctan2(a - length[None, :], np.abs(b)))
            part = -2j / np.pi * np.where(np.abs(b) < 1e-13, 0, angle)
            for x2, w2 in zip(points, weights):
                r = np.maximum(np.hypot(0.5 * (1 + x2) * length[None, :] - a, b), 1e-12)
                part += k * (j1(k * r) - 1j * (y1(k * r) + 2 / (np.pi * k * r))) * (b / r) * (0.5 * w2 * length)[None, :]
            D += 0.5 * w * length[:, None] * part
        np.fill_diagonal(D, -2j * length)
        return 0.25 * (equal(D) + mixed(D))

    def waves(towards):
        soft, hard, field = [], [], []
        for r_hat in towards:
            wave = sum(0.5 * w * np.exp(1j * k * ((p + 0.5 * (1 + x) * length[:, None] * tangent) @ r_hat)) for x, w in zip(points, weights))
            slope = 1j * k * (normal @ r_hat) * wave * length
            soft.append(wave)
            hard.append(0.5 * (slope + slope[before]))
            field.append(0.5 * (wave * length + (wave * length)[before]))
        return np.array(soft).T, np.array(hard).T, np.array(field).T

    (soft_in, hard_in, field_in), (soft_out, hard_out, _) = waves(incident), waves(scattered)
    if combined:
        Z = Z - 1j * k * double_layer()
        hard_in = hard_in - 1j * k * field_in
    return -(soft_out * length[:, None]).T @ np.linalg.solve(G, soft_in), -hard_out.T @ np.linalg.solve(Z, hard_in)


def chevron(opening_deg, arm, thickness):  # its concave vertex in the origin, open towards azimuth 0
    half = np.radians(opening_deg / 2)
    end = arm * np.array([np.cos(half), np.sin(half)])
    back = end + thickness * np.array([-np.sin(half), np.cos(half)])
    return [(0, 0), tuple(end), tuple(back), (-thickness / np.sin(half), 0), (back[0], -back[1]), (end[0], -end[1])]


SECTIONS = {
    "box": [(-0.05, -0.075), (0.05, -0.075), (0.05, 0.075), (-0.05, 0.075)],
    "triangle": [(0.1 * np.cos(t), 0.1 * np.sin(t)) for t in np.radians([10, 130, 250])],
    "knife": [(-0.1, 0), (0.1, -0.02), (0.1, 0.02)],
    "chevron": chevron(150, 0.1, 0.04),
    "dihedral": chevron(90, 0.15, 0.04),
    "dihedral85": chevron(85, 0.15, 0.04),
    "dihedral95": chevron(95, 0.15, 0.04),
}

LONG = {"dihedral90long": chevron(90, 0.6, 0.04), "dihedral95long": chevron(95, 0.6, 0.04)}

if __name__ == "__main__":
    print("transmit_deg,receive_deg,soft_re,soft_im,hard_re,hard_im,section")
    azimuths = np.arange(1, 361, 4)
    for name, corners in SECTIONS.items():
        nodes = closed(corners, WAVELENGTH / 7200, WAVELENGTH / 240)
        soft, hard = echoes(nodes, 2 * np.pi / WAVELENGTH, directions(azimuths), directions(azimuths))
        pairs = [(i, i) for i in range(len(azimuths))]
        pairs += [(i, o) for i in range(len(azimuths)) if azimuths[i] in (33, 77) for o in range(len(azimuths)) if o != i]
        for i, o in pairs:
            print(f"{azimuths[i]},{azimuths[o]},{soft[o, i].real:.5g},{soft[o, i].imag:.5g},{hard[o, i].real:.5g},{hard[o, i].imag:.5g},{name}")
    azimuths = np.arange(1, 71)
    for name, corners in LONG.items():
        towards = directions(azimuths)
        soft, hard = echoes(closed(corners, WAVELENGTH / 400, WAVELENGTH / 60), 2 * np.pi / WAVELENGTH, towards, towards, combined=True)
        for i, azimuth in enumerate(azimuths):
            print(f"{azimuth},{azimuth},{soft[i, i].real:.5g},{soft[i, i].imag:.5g},{hard[i, i].real:.5g},{hard[i, i].imag:.5g},{name}")
