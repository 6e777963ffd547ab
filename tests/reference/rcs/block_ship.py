#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Scattering of a small, perfectly conducting model of a ship, by integral equations: block_ship.py > block_ship.csv; block_ship.py sphere: the same code against Mie's series

A hull of 6 x 1.6 x 1.2 wavelengths, from z = 0 up, with a house of 1.8 x 1 x 1.2 on the middle of its deck: decks, walls on them, right-angled concave edges and free edges. Basis functions of S. M. Rao, D. R. Wilton
and A. W. Glisson (IEEE Trans. AP-30, 1982, 409-418) on triangles; the combined-field integral equation (J. R. Mautz and R. F. Harrington, AEU 32, 1978, 157-164), since the electric-field and the magnetic-field
equation each have interior resonances; Galerkin testing. Pairs of triangles near each other by the exact potentials of 1/R and its gradient (D. R. Wilton et al., IEEE Trans. AP-32, 1984, 276-281; R. D. Graglia, AP-41,
1993, 1448-1455) and quadrature of the remainder, others by quadrature (D. A. Dunavant, Int. J. Num. Meth. Eng. 21, 1985, 1129-1148).

Needs numpy and scipy. Columns: azimuth and elevation, deg; S in wavelengths, hh, hv, vv; |S|^2 4 pi is the cross-section, phase from the origin, e^{+jwt}, h and v the azimuth's and elevation's unit vectors
(CONVENTIONS.md).
"""
import sys

import numpy as np
import scipy.sparse
from scipy.linalg import lu_factor, lu_solve
from scipy.spatial import cKDTree
from scipy.special import spherical_jn, spherical_yn

HULL, HOUSE = (-3, 3, -0.8, 0.8, 0, 1.2), (-0.9, 0.9, -0.5, 0.5, 1.2, 2.4)
LONGEST_SIDE = 0.1  # of the rectangles that two triangles form, wavelengths
ELECTRIC = 0.7  # weight of the electric-field equation
NEAR = 3.5  # maximum distance of near pairs, sides


def dunavant(count):  # barycentric coordinates and weights
    if count == 3:
        return np.array([[4, 1, 1], [1, 4, 1], [1, 1, 4]]) / 6, np.full(3, 1 / 3)
    a, b = (6 + np.sqrt(15)) / 21, (6 - np.sqrt(15)) / 21
    places = [[1 / 3] * 3] + [[1 - 2 * x if i == j else x for j in range(3)] for x in (a, b) for i in range(3)]
    return np.array(places), np.array([0.225] + 3 * [(155 + np.sqrt(15)) / 1200] + 3 * [(155 - np.sqrt(15)) / 1200])


class Mesh:  # closed, normals outwards
    def __init__(self, vertices, triangles):
        self.triangles = np.asarray(triangles)
        self.corners = np.asarray(vertices, float)[self.triangles]
        normal = np.cross(self.corners[:, 1] - self.corners[:, 0], self.corners[:, 2] - self.corners[:, 0])
        self.area = np.linalg.norm(normal, axis=1) / 2
        self.normal = normal / (2 * self.area)[:, None]
        self.centre = self.corners.mean(1)
        # The unknown of the side opposite each vertex is the current across it, from one of its triangles into the other.
        self.unknown, self.sign, sides = np.zeros((len(self.triangles), 3), int), np.ones((len(self.triangles), 3)), {}
        for t, corners in enumerate(self.triangles):
            for i in range(3):
                side = frozenset((corners[(i + 1) % 3], corners[(i + 2) % 3]))
                if side in sides:
                    self.sign[t, i] = -1
                self.unknown[t, i] = sides.setdefault(side, len(sides))
        self.unknowns = len(sides)
        length = np.stack([np.linalg.norm(self.corners[:, (i + 2) % 3] - self.corners[:, (i + 1) % 3], axis=1) for i in range(3)], 1)
        self.scale = self.sign * length / (2 * self.area)[:, None]  # f = scale (r - corner), div f = 2 scale

    def points(self, count):
        places, weights = dunavant(count)
        return np.einsum("qi,tic->tqc", places, self.corners), self.area[:, None] * weights

    def functions(self, count):  # points; f, div f, f x n, (f x n) x r, r x f with the weights, as matrices from unknowns to points, one per component
        points, weights = self.points(count)
        f = self.scale[:, None, :, None] * (points[:, :, None, :] - self.corners[:, None, :, :])
        row = np.broadcast_to(np.arange(weights.size).reshape(*weights.shape, 1), f.shape[:3])
        column = np.broadcast_to(self.unknown[:, None, :], f.shape[:3])

        def matrix(values):
            return scipy.sparse.csr_matrix(((values * weights[:, :, None]).ravel(), (row.ravel(), column.ravel())), shape=(weights.size, self.unknowns))

        def matrices(vectors):
            return [matrix(vectors[..., c]) for c in range(3)]

        turned, r = np.cross(f, self.normal[:, None, None, :]), points[:, :, None, :]
        divergence = np.broadcast_to(2 * self.scale[:, None, :], f.shape[:3])
        return points.reshape(-1, 3), matrices(f), matrix(divergence), matrices(turned), matrices(np.cross(turned, r)), matrices(np.cross(r, f))


def static_potentials(r, corners, normal):  # integrals over a triangle, for the observer r, of 1/R, of (r' - foot of r)/R and of the gradient with respect to r of -1/R; the foot
    height = np.einsum("...c,...c->...", r - corners[..., 0, :], normal)
    foot, above = r - height[..., None] * normal, np.abs(height)
    potential, moment, gradient, angle = 0, 0, 0, 0
    for i in range(3):
        a, b = corners[..., i, :], corners[..., (i + 1) % 3, :]
        along = (b - a) / np.linalg.norm(b - a, axis=-1, keepdims=True)
        out = np.cross(along, normal)
        across = np.einsum("...c,...c->...", a - foot, out)
        first = np.einsum("...c,...c->...", a - foot, along)
        last = first + np.linalg.norm(b - a, axis=-1)
        least = across**2 + height**2
        near, far = np.sqrt(least + first**2), np.sqrt(least + last**2)
        with np.errstate(all="ignore"):
            log = np.where(first + last > 0, np.log((far + last) / (near + first)), np.log((near - first) / (far - last)))
        log = np.where((least < 1e-24) & ~np.isfinite(log), 0, log)
        seen = np.arctan2(across * last, least + above * far) - np.arctan2(across * first, least + above * near)
        potential = potential + across * log - above * seen
        moment = moment + 0.5 * out * (least * log + last * far - first * near)[..., None]
        gradient = gradient + out * log[..., None]
        angle = angle + seen
    return potential, moment, gradient + normal * (np.where(above < 1e-9, 0, np.sign(height)) * angle)[..., None], foot


def near_pairs(mesh, k, test, source):  # [pair, test function, source function]
    outer, outer_weight = dunavant(7)
    r = np.einsum("qi,tic->tqc", outer, mesh.corners[test])
    points = np.einsum("qi,tic->tqc", outer, mesh.corners[source])
    weight = outer_weight * mesh.area[source][:, None]
    shape = (len(test), len(outer))
    potential, moment, gradient, foot = static_potentials(
        r, np.broadcast_to(mesh.corners[source][:, None], (*shape, 3, 3)), np.broadcast_to(mesh.normal[source][:, None], (*shape, 3))
    )
    away = r[:, :, None, :] - points[:, None, :, :]
    R = np.maximum(np.linalg.norm(away, axis=-1), 1e-12)
    kR = k * R
    rest = np.where(kR < 1e-3, -1j * k - k * k * R / 2, (np.exp(-1j * kR) - 1) / R) / (4 * np.pi)  # G - 1 / (4 pi R)
    rest_of_gradient = np.where(kR < 1e-2, -0.5 * k * k / R + 1j * k**3 / 3, (1 - (1 + 1j * kR) * np.exp(-1j * kR)) / R**3) / (4 * np.pi)  # times r - r'
    G = np.einsum("pqi,pi->pq", rest, weight) + potential / (4 * np.pi)
    Gr = np.einsum("pqi,pi,pic->pqc", rest, weight, points) + (moment + foot * potential[..., None]) / (4 * np.pi)
    grad_G = np.einsum("pqi,pi,pqic->pqc", rest_of_gradient, weight, away) - gradient / (4 * np.pi)
    test_weight = outer_weight * mesh.area[test][:, None]
    f = mesh.scale[test][:, None, :, None] * (r[:, :, None, :] - mesh.corners[test][:, None])
    A = mesh.scale[source][:, None, :, None] * (Gr[:, :, None, :] - G[:, :, None, None] * mesh.corners[source][:, None])
    charges = 4 / k**2 * mesh.scale[test][:, :, None] * mesh.scale[source][:, None, :] * (test_weight * G).sum(1)[:, None, None]
    electric = 1j * k * (np.einsum("pq,pqac,pqbc->pab", test_weight, f, A) - charges)
    curl_A = mesh.scale[source][:, None, :, None] * np.cross(grad_G[:, :, None, :], r[:, :, None, :] - mesh.corners[source][:, None])
    magnetic = -np.einsum("pq,pqac,pqbc->pab", test_weight, np.cross(f, mesh.normal[test][:, None, None, :]), curl_A)
    itself = test == source
    magnetic[itself] = 0.5 * np.einsum("pq,pqac,pqbc->pab", test_weight[itself], f[itself], f[itself])
    return ELECTRIC * electric + (1 - ELECTRIC) * magnetic


def impedances(mesh, k):
    points, f, divergence, turned, turned_r, r_f = mesh.functions(3)
    count = len(points) // len(mesh.triangles)
    reach = NEAR * np.max(np.linalg.norm(mesh.corners - mesh.centre[:, None], axis=2))
    neighbours = cKDTree(mesh.centre).query_ball_point(mesh.centre, reach)
    Z = np.zeros((mesh.unknowns, mesh.unknowns), complex)
    together = max(1, int(6e7 / len(points)) // count) * count
    for start in range(0, len(points), together):
        rows = slice(start, min(len(points), start + together))
        R = np.sqrt(sum((points[rows, None, c] - points[None, :, c]) ** 2 for c in range(3)))
        near_row = np.concatenate([np.full(count * len(neighbours[p // count]), p - start) for p in range(rows.start, rows.stop)])
        near_column = np.concatenate([(np.asarray(neighbours[p // count])[:, None] * count + np.arange(count)).ravel() for p in range(rows.start, rows.stop)])
        R[near_row, near_column] = 1
        G = np.exp(-1j * k * R) / (4 * np.pi * R)
        G[near_row, near_column] = 0
        gradient = -(1 + 1j * k * R) / R**2 * G  # times r - r'
        over = lambda test, source, kernel: test[rows].T @ (source.T @ kernel.T).T
        Z += ELECTRIC * 1j * k * (sum(over(f[c], f[c], G) for c in range(3)) - over(divergence, divergence, G) / k**2)
        Z += (1 - ELECTRIC) * sum(over(turned[c], r_f[c], gradient) - over(turned_r[c], f[c], gradient) for c in range(3))
    test = np.concatenate([np.full(len(near), t) for t, near in enumerate(neighbours)])
    source = np.concatenate([np.asarray(near) for near in neighbours])
    for start in range(0, len(test), 4000):
        t, s = test[start : start + 4000], source[start : start + 4000]
        pairs = near_pairs(mesh, k, t, s)
        np.add.at(Z, (np.broadcast_to(mesh.unknown[t][:, :, None], pairs.shape), np.broadcast_to(mesh.unknown[s][:, None, :], pairs.shape)), pairs)
    return Z


def scattering_matrices(mesh, k, azimuths_deg, elevations_deg):  # S [direction, received h v, transmitted h v]
    az, el = np.radians(azimuths_deg), np.radians(elevations_deg)
    towards = np.stack([np.cos(el) * np.cos(az), np.cos(el) * np.sin(az), np.sin(el)], -1)
    h = np.stack([-np.sin(az), np.cos(az), 0 * az], -1)
    fields = np.stack([h, np.cross(towards, h)], 1)
    points, f, _, turned, _, _ = mesh.functions(7)
    wave = np.exp(1j * k * points @ towards.T)
    on = lambda functions, vectors: sum((functions[c].T @ wave)[:, :, None] * vectors[:, :, c] for c in range(3))
    electric = on(f, fields)
    incident = ELECTRIC * electric + (1 - ELECTRIC) * on(turned, np.cross(-towards[:, None, :], fields))
    currents = lu_solve(lu_factor(impedances(mesh, k), overwrite_a=True), incident.reshape(mesh.unknowns, -1)).reshape(incident.shape)
    return -1j * k / (4 * np.pi) * np.einsum("uap,uaq->apq", electric, currents)


def surface_of_boxes(boxes, longest):  # of the union of the boxes, on grids along all sides of all boxes
    grids = []
    for axis in range(3):
        cuts = sorted({box[2 * axis + i] for box in boxes for i in (0, 1)})
        grids.append(np.concatenate([np.linspace(a, b, int(np.ceil((b - a) / longest - 1e-9)) + 1)[1 if i else 0 :] for i, (a, b) in enumerate(zip(cuts, cuts[1:]))]))
    middle = np.meshgrid(*[(g[1:] + g[:-1]) / 2 for g in grids], indexing="ij")
    inside = np.pad(np.any([np.all([(m > box[2 * a]) & (m < box[2 * a + 1]) for a, m in enumerate(middle)], axis=0) for box in boxes], axis=0), 1)
    numbers, triangles = {}, []
    for axis in range(3):
        step = np.diff(inside.astype(int), axis=axis)
        b, c = (axis + 1) % 3, (axis + 2) % 3
        for place in zip(*np.nonzero(step)):
            corner = np.array(place) - 1
            corner[axis] += 1
            quad = []
            for along in ((0, 0), (1, 0), (1, 1), (0, 1)):
                node = corner.copy()
                node[[b, c]] += along
                quad.append(numbers.setdefault(tuple(node), len(numbers)))
            if step[place] > 0:  # into the body
                quad.reverse()
            turned = (corner[b] + corner[c]) % 2  # diagonals of adjacent rectangles meet
            p, q, r, s = quad
            triangles += [(p, q, r), (p, r, s)] if turned else [(p, q, s), (q, r, s)]
    return Mesh([[grids[a][node[a]] for a in range(3)] for node in numbers], triangles)


def sphere(halvings):  # its area is that of unit radius
    from scipy.spatial import ConvexHull

    t = (1 + 5**0.5) / 2
    points = np.array([(0, s, c * t)[i:] + (0, s, c * t)[:i] for i in range(3) for s in (-1, 1) for c in (-1, 1)]) / np.hypot(1, t)
    for _ in range(halvings):
        halves = [(points[a] + points[b]) / np.linalg.norm(points[a] + points[b]) for hull in [ConvexHull(points).simplices] for a, b in {tuple(sorted((s[i], s[i - 1]))) for s in hull for i in range(3)}]
        points = np.concatenate([points, halves])
    triangles = np.array([s if np.dot(np.cross(points[s[1]] - points[s[0]], points[s[2]] - points[s[0]]), points[s].sum(0)) > 0 else s[::-1] for s in ConvexHull(points).simplices])
    return Mesh(points * np.sqrt(4 * np.pi / Mesh(points, triangles).area.sum()), triangles)


def mie(ka):  # monostatic S / a of a sphere: Bohren and Huffman, Absorption and Scattering of Light by Small Particles (1983), 4.61, of an infinite index
    n = np.arange(1, int(ka + 4 * ka ** (1 / 3) + 10))
    j, y, dj, dy = spherical_jn(n, ka), spherical_yn(n, ka), spherical_jn(n, ka, True), spherical_yn(n, ka, True)
    electric, magnetic = (j + ka * dj) / (j - 1j * y + ka * (dj - 1j * dy)), j / (j - 1j * y)
    return 1j / ka * np.sum((-1.0) ** n * (n + 0.5) * (electric - magnetic))


if __name__ == "__main__":
    if sys.argv[1:] == ["sphere"]:
        mesh = sphere(3)
        for ka in (2.0, 4.0, 4.4934, 5.0):  # 4.4934: an interior resonance
            S, exact = scattering_matrices(mesh, ka, np.array([30.0]), np.array([20.0]))[0], mie(ka)
            print(f"ka {ka}: hh, vv over Mie's {S[0, 0] / exact:.4f} {S[1, 1] / exact:.4f}, hv {abs(S[0, 1]):.1e}")
        sys.exit()
    directions = np.array([(azimuth, elevation) for elevation in (2.0, 10.0, 25.0, 50.0) for azimuth in np.arange(0, 91, 2.0)])
    print("azimuth_deg,elevation_deg,hh_re,hh_im,hv_re,hv_im,vv_re,vv_im")
    for (azimuth, elevation), S in zip(directions, scattering_matrices(surface_of_boxes([HULL, HOUSE], LONGEST_SIDE), 2 * np.pi, *directions.T)):
        echoes = [S[0, 0], 0.5 * (S[0, 1] + S[1, 0]), S[1, 1]]
        print(f"{azimuth:g},{elevation:g}," + ",".join(f"{x.real:.5f},{x.imag:.5f}" for x in echoes))
