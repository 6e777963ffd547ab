// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

#include <array>

#include "sim/core/numbers/linear.h"

namespace seaglint {

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

}  // namespace seaglint
