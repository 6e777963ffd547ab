// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Edge diffraction where a face is no perfect conductor: coefficients of the impedance wedge, and equivalent currents
// of edges of materials.

#include <array>

#include "sim/core/numbers/linear.h"
#include "sim/scattering/coefficients/material.h"
#include "sim/scattering/coefficients/wedge_diffraction.h"

namespace seaglint {

// Exact diffraction of a plane wave by an infinite wedge whose faces have constant surface impedances, in the plane
// normal to its edge.
//
// u is the field along the edge, E (soft) or H (hard); phi and phi0 are the angles of receiver and transmitter from
// face 0, 0..N pi. On each face (1/r) du/dphi = +-jk sin(theta) u, with theta the Brewster angle, so that the face
// reflects u with (sin phi0 - sin theta) / (sin phi0 + sin theta): sin(theta) is the impedance relative to free space
// (hard) or its inverse (soft), 0 for the hard and infinite for the soft perfect conductor. The diffracted field is P
// sqrt(2 / pi k r) e^{-jkr + j pi/4}.
//
// G. D. Maliuzhinets, Sov. Phys. Dokl. 3 (1958) 752-755; T. B. A. Senior and J. L. Volakis, Approximate Boundary
// Conditions in Electromagnetics (1995), ch. 4. Each face enters by g(x) = psi(x + pi/2 - theta) psi(x - pi/2 + theta),
// psi Maliuzhinets' function, x the angle from the other face. By Parseval's theorem its Fourier integral becomes
//
//     ln g(x) / g(0) = (1/pi) integral A(s) ln [(cos(x/N) + cosh(s/N)) / (1 + cosh(s/N))] ds,  s = 0..infinity,
//     A(s) = sin(theta) cosh s / (sinh^2 s + sin^2(theta)),
//
// which holds for every sin(theta) including 0 and infinity; sinh s = |sin(theta)| tan v leaves a smooth integrand on
// 0..pi/2 (for a reactive face on a path of s rotated off the real axis). With g(x +- pi) g(x) elementary, P is 1 /
// [Psi(phi) Psi(phi0)] times a symmetric trigonometric form: reciprocal by construction.

// sin(theta) from here on counts as infinite (soft perfect conductor); relative error of the field below 1e-9.
inline constexpr double kSoftConductor = 1e12;

// sin(theta) of the face that reflects u with `reflection` at an angle of incidence of sine `sin_phi` from the face, 0
// < sin_phi <= 1. At most kSoftConductor; passive: real part >= 0.
Complex brewster_sine(const Complex& reflection, double sin_phi);

// P for sin(theta) of both faces, 0 <= phi, phi0 <= N pi, 1 <= N <= 2; N = 1 is a plane with a junction of two
// impedances. Infinite on the incident and the reflection shadow boundaries. Relative error of g by
// quadrature, up to 0.98 N pi from the other face: below 2e-6 for |sin(theta)| <= 10, up to 1.3e-4 for 10 to 100.
Complex impedance_wedge(double phi, double phi0, const std::array<Complex, 2>& brewster_sines, double N);

// P of the physical-optics currents on a half-plane illuminated from phi0 in (0, pi), of the total field with the
// coefficients of reflection and, through a sheet, of transmission of u: (j/4) [(1 + R - T) sin phi - (1 - R - T) sin
// phi0] / (cos phi + cos phi0), any phi.
Complex half_plane_optics(double phi, double phi0, const Complex& reflection, const Complex& transmission = 0);

// Edge diffraction where a face is no perfect conductor: Keller's field of the impedance wedge, or of a thin sheet's
// edge, less the physical optics of the same surfaces, as equivalent edge currents.
//
// In the plane normal to the edge the soft and the hard wave (E and H along the edge) are separate. A face enters with
// the impedance that has its reflection coefficient at the angle of the wave, the mean of the values of incident and
// exit direction: exact for the pole of the reflection boundary, and reciprocal. At oblique incidence, where no closed
// solution exists for two impedances, the coefficient is the one from E_t to E_t (H_t to H_t) of the face; conversion
// between the two enters only through physical optics.
//
// Thin sheets, with air behind. R and T of the sheet referred to its middle split the field into an even and an odd
// part that reflect with R + T and R - T: each is a half-plane problem in one half-space, a junction (N = 1) of the
// sheet's impedance with a hard (even) or soft (odd) plane (resistive and conductive sheet conditions, Senior and
// Volakis 1995, ch. 2 and 3). The normal polarisation of a dielectric makes sin(theta) of the even part vanish at
// normal incidence, as B (a^2 - c^2) with c = cos phi: these factors are split by Wiener and Hopf, sqrt((a - c) / (a +
// c)) for each direction, where |a| is below about 1 (kNormalPolarisationWindow); otherwise the impedance is that of
// the angle. The even sine is the geometric mean of both directions, with which the edge of a weak sheet radiates the
// field of its polarisation.

// Materials of the faces of a wedge at one wavenumber. Both are the same surface for a sheet with air behind (N = 2).
struct MaterialFaces {
  std::array<const MaterialSurface*, 2> face;
  double k = 0;  // rad/m
  bool is_sheet = false;
};

// As equivalent_edge_currents() (wedge_diffraction.h): p . current is S per metre of edge for received polarisation p
// (unit) in direction s (unit), for waves along k_hat with electric fields `fields`; physical optics is subtracted on
// faces that are illuminated and visible from s, or within `shadow` (rad) of a shadow boundary. N > 1. Off Keller's
// cone the amplitude is divided by the sines of both directions with the edge and multiplied by sqrt(1 - ((k^ - s) . t
// / 2)^2), which is reciprocal and follows Michaeli's current of the conducting half-plane seen broadside to 10 %. Zero
// for a wave from inside the body. Of two perfect conductors on the cone: equal to equivalent_edge_currents() to
// rounding.
std::array<CVec3, 2> material_edge_currents(const WedgeFrame& wedge, const MaterialFaces& faces, const Vec3& k_hat,
                                            const std::array<Vec3, 2>& fields, const Vec3& s, double shadow);

}  // namespace seaglint
