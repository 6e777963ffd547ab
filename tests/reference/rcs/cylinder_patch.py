#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Echo of an upright cylinder before a level rectangle by geometrical and physical optics: cylinder_patch.py > cylinder_patch.csv

The cylinder, perfectly conducting, has its axis on z, a radius of 0.5 m and stands from z = 0 to 1 m. The rectangle lies in z = 0; its border cuts the rays that the cylinder spreads. The field on each body is that of geometrical optics: of the incident wave, and of the one reflected by the other body, on the rectangle with the ray's exact spreading. Physical-optics currents are integrated by Gauss-Legendre quadrature, along z in closed form. At the cylinder's shadow boundary the current fades out over (k R)^(-1/3) rad, as in sim/scattering/radiation.
Columns: number of the rectangle, azimuth and elevation, deg, frequency, GHz; S in m, hh, vv: power 4 pi |S|^2, e^{+jwt}, phase origin at z = 0 on the axis.
"""
import numpy as np

RADIUS, HEIGHT = 0.5, 1.0
RECTANGLES = {1: (0.8, 1.15, -0.3, 0.25), 2: (0.8, 1.15, -0.05, 0.05)}  # x, y from and to, m
UP = np.array([0, 0, 1.0])


def quadrature(low, high, intervals):
    """Points and weights of Gauss-Legendre quadrature, 20 points in each interval."""
    x, weight = np.polynomial.legendre.leggauss(20)
    width = (high - low) / intervals
    return (low + width * (np.arange(intervals)[:, None] + (x + 1) / 2)).ravel(), np.tile(weight * width / 2, intervals)


def reflected(vector, normal):
    return vector - 2 * np.asarray(normal @ vector)[..., None] * normal


def echoes(k, azimuth, elevation, rectangle):
    """S of hh and vv."""
    ce, se, heading = np.cos(elevation), np.sin(elevation), np.array([np.cos(azimuth), np.sin(azimuth)])
    r = np.array([*(ce * heading), se])
    h = np.cross(UP, r) / ce
    x0, x1, y0, y1 = rectangle

    def scattered(polarisation, normal, direction, field, phases):
        """-(jk / 2 pi) of p . [n x (k^ x E)], weighted by `phases`, which hold the quadrature's weights."""
        current = np.cross(normal, np.cross(direction, field))
        return -1j * k / (2 * np.pi) * np.sum(current @ polarisation * phases)

    # Points around the cylinder, and on the rectangle.
    around, of_angle = quadrature(azimuth - np.pi / 2, azimuth + np.pi / 2, 200)
    normal = np.stack([np.cos(around), np.sin(around), 0 * around], -1)
    facing = np.arcsin(np.clip(np.cos(around - azimuth) * ce, 0, 1)) * (k * RADIUS) ** (1 / 3)
    fade = np.clip(facing, 0, 1) ** 3 * (10 - 15 * np.clip(facing, 0, 1) + 6 * np.clip(facing, 0, 1) ** 2)
    of_cylinder = of_angle * RADIUS * fade
    x, of_x = quadrature(x0, x1, 6)
    y, of_y = quadrature(y0, y1, 7)
    Q = np.stack([*np.meshgrid(x, y, indexing="ij"), np.zeros((len(x), len(y)))], -1)
    of_rectangle = np.outer(of_x, of_y)

    # Cylinder to rectangle: the angle at which the ray to each point leaves the cylinder, by Newton's method.
    angle = 0.5 * (np.arctan2(Q[..., 1], Q[..., 0]) + azimuth)

    def leaving(angle):
        n = np.stack([np.cos(angle), np.sin(angle)], -1)
        return n, reflected(-heading, n), Q[..., :2] - RADIUS * n

    def miss(angle):
        _, away, way = leaving(angle)
        return away[..., 0] * way[..., 1] - away[..., 1] * way[..., 0]

    for _ in range(10):
        angle -= miss(angle) / ((miss(angle + 1e-6) - miss(angle - 1e-6)) / 2e-6)
    n, away, way = leaving(angle)
    distance, cosine = np.sum(away * way, -1), n @ heading  # in the plane
    height = distance * se / ce
    assert np.all(np.abs(miss(angle)) < 1e-9) and np.all(distance > 0)
    caustic = RADIUS * cosine / 2
    n3 = np.concatenate([n, 0 * n[..., :1]], -1)
    point = np.concatenate([RADIUS * n, height[..., None]], -1)
    onto = np.concatenate([ce * away, np.full_like(height, -se)[..., None]], -1)
    to_rectangle = (of_rectangle * np.sqrt(caustic / (caustic + distance)) * ((cosine > 0) & (height < HEIGHT))
                    * np.exp(1j * k * (point @ r - distance / ce + Q @ r)))

    # Rectangle to cylinder: heights of the points of the cylinder whose ray back meets the rectangle.
    def range_along(start, slope, low, high):
        if abs(slope) < 1e-12:
            inside = (start > low) & (start < high)
            return np.where(inside, -1e9, 1e9), np.where(inside, 1e9, -1e9)
        a, b = (low - start) / slope, (high - start) / slope
        return np.minimum(a, b), np.maximum(a, b)

    place = RADIUS * normal
    in_x, in_y = range_along(place[:, 0], heading[0], x0, x1), range_along(place[:, 1], heading[1], y0, y1)
    z0 = np.maximum(np.maximum(in_x[0], in_y[0]) * se / ce, 0)
    z1 = np.maximum(np.minimum(np.minimum(in_x[1], in_y[1]) * se / ce, HEIGHT), z0)
    from_below = reflected(-r, UP)
    to_cylinder = of_cylinder * (z1 - z0) * np.exp(1j * k * (place @ (r - from_below)))  # no phase along z

    S = []
    for E in (h, np.cross(r, h)):
        along_z = (np.exp(2j * k * se * HEIGHT) - 1) / (2j * k * se)
        S.append(scattered(E, normal, -r, E, of_cylinder * np.exp(2j * k * place @ r) * along_z)
                 + scattered(E, UP, -r, E, of_rectangle * np.exp(2j * k * Q @ r))
                 + scattered(E, UP, onto, 2 * (n3 @ E)[..., None] * n3 - E, to_rectangle)
                 + scattered(E, normal, from_below, 2 * E[2] * UP - E, to_cylinder))
    return S


def main():
    print("rectangle,azimuth_deg,elevation_deg,frequency_ghz,hh_re,hh_im,vv_re,vv_im")
    for number, rectangle in RECTANGLES.items():
        for elevation in (25, 40):
            for azimuth in range(0, 13, 3):
                for frequency in (8, 8.2, 8.4):
                    k = 2 * np.pi * frequency * 1e9 / 299792458.0
                    hh, vv = echoes(k, np.radians(azimuth), np.radians(elevation), rectangle)
                    print(f"{number},{azimuth},{elevation},{frequency},{hh.real:.6f},{hh.imag:.6f},{vv.real:.6f},{vv.imag:.6f}")


if __name__ == "__main__":
    main()
