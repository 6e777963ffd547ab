#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Scattering of an infinitely long perfectly conducting strip, 0.2667 m wide at 10.24 GHz, by integral equations: strip.py > strip.csv

Without thickness: both integral equations in Chebyshev functions of the strip's coordinate, which contain the currents' edge singularities, with Kress'
quadrature for the logarithm (R. Kress, J. Comput. Appl. Math. 61, 1995, 345-360): relative error of the echo 1e-9. With thickness: a rectangle by
sections.py.

Needs numpy and scipy. Columns: thickness; angles of transmitter and receiver from the normal, about the strip's axis; P soft (vv of an upright
strip) and hard (hh), the amplitude of the field's component along the edges as P sqrt(2 / pi k r) e^{-jkr + j pi/4}, e^{+jwt}, phase from the middle of the cross-section.
"""
import numpy as np
from scipy.special import j0, y0

from sections import directions, echoes, graded

WIDTH, FREQUENCY = 0.2667, 10.24e9
K = 2 * np.pi * FREQUENCY / 299792458
GAMMA = np.euler_gamma
LARGEST = 0.15e-3  # element, m


def thin(angles):  # soft and hard P for every pair of angles
    ka = K * WIDTH / 2
    n = int(2 * ka + 60)  # Chebyshev functions
    P = 2 * n
    t = np.pi * np.arange(2 * P) / P
    m = np.arange(1, P)[:, None]
    R = -2 * np.pi / P * np.sum(np.cos(m * t[None, :]) / m, 0) - np.pi * np.cos(P * t) / P**2  # weights of ln 4 sin^2
    i = np.arange(2 * P)
    d = np.abs(np.cos(t)[:, None] - np.cos(t)[None, :])
    J = j0(ka * d)
    with np.errstate(all="ignore"):
        smooth = y0(ka * d) - 2 / np.pi * np.log(d) * J
    smooth[d < 1e-12] = 2 / np.pi * (np.log(ka / 2) + GAMMA)
    log = 0.5 * (R[np.abs(i[:, None] - i)] + R[(i[:, None] + i) % (2 * P)])
    H = 0.5 * (np.pi / P * (J - 1j * (smooth - 2 / np.pi * np.log(2) * J)) - 2j / np.pi * J * log)
    cosines = np.cos(np.arange(P)[:, None] * t[None, :])
    A = cosines * (0.5 * np.pi / P) @ H @ cosines.T  # double integrals of H0 cos p theta cos q theta'
    order = np.arange(1, n)
    B, D = np.zeros((n - 1, P)), np.zeros((n - 1, P))  # sin m theta sin theta in cosines, and the derivative of sin m theta
    B[order - 1, order - 1], B[order - 1, order + 1], D[order - 1, order] = 0.5, -0.5, order
    N = ka**2 * (B @ A @ B.T) - D @ A @ D.T
    theta = np.pi * (np.arange(4000) + 0.5) / 4000
    basis = np.cos(np.arange(P)[:, None] * theta) * np.pi / 4000
    waves = basis @ np.exp(1j * ka * np.sin(np.radians(angles)) * np.cos(theta)[:, None])
    slopes = B @ waves * ka * np.cos(np.radians(angles))
    return -waves[:n].T @ np.linalg.solve(A[:n, :n], waves[:n]), slopes.T @ np.linalg.solve(N, slopes)


def thick(t, angles):
    along, across = graded(WIDTH, t / 40, LARGEST)[:-1], graded(t, t / 40, t / 8)[:-1]
    outline = np.array([(t / 2, -WIDTH / 2 + s) for s in along] + [(t / 2 - s, WIDTH / 2) for s in across]
                       + [(-t / 2, WIDTH / 2 - s) for s in along] + [(-t / 2 + s, -WIDTH / 2) for s in across])
    return echoes(outline, K, directions(angles), directions(angles))


angles = np.arange(-90, 90.5, 1.5)
print("thickness_mm,transmit_deg,receive_deg,soft_re,soft_im,hard_re,hard_im")
for t_mm in (0, 0.5, 1.6256, 3):
    soft, hard = thick(1e-3 * t_mm, angles) if t_mm > 0 else thin(angles)
    pairs = [(i, i) for i in range(len(angles)) if angles[i] >= 0]
    if t_mm in (0, 1.6256):
        pairs += [(i, o) for i in range(len(angles)) if angles[i] in (21, 51) for o in range(len(angles)) if abs(angles[o]) <= 75]
    for i, o in pairs:
        print(f"{t_mm:g},{angles[i]:g},{angles[o]:g},{soft[o, i].real:.6g},{soft[o, i].imag:.6g},{hard[o, i].real:.6g},{hard[o, i].imag:.6g}")
