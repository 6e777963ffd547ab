// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Transition function of the uniform theory of diffraction, and its divided differences for two and three boundaries.

#include "sim/core/numbers/linear.h"

namespace seaglint {

// F(x) = 2j sqrt(x) e^{jx} integral from sqrt(x) to infinity of e^{-j t^2} dt (R. G. Kouyoumjian and P. H. Pathak,
// Proc. IEEE 62 (1974) 1448-1461, eq. 26): 0 on a shadow boundary, 1 far from it; F(-x) is its conjugate. x real; error
// below 1e-7.
Complex transition_function(double x);

// Transition function of a wave diffracted from one edge to another along a face, x and y > 0 the arguments of the two
// edges: (y F(x) - x F(y)) / (y - x). Tends to F(x) for large y and differs from F(x) F(y) where both are small: it is
// the value of the integral over both apertures on a hard plane (far-field limit of the generalised Fresnel integrals
// of F. Capolino, M. Albani, S. Maci and R. Tiberio, IEEE Trans. AP-45 (1997) 1240-1248).
Complex double_transition_function(double x, double y);

// The same with the end point of the second edge as third boundary, x, y > 0, z of either sign. All three are divided
// differences of F(x) / x. By parts, the integral of F(al) e^{jpl} / sqrt(l) over a length l is the difference of T(al,
// -pl) e^{jpl} / (jp sqrt(l)) at its ends, T the double transition function; that of T(al, bl) e^{jpl} / sqrt(l) is
// likewise that of the triple one of (al, bl, -pl).
Complex triple_transition_function(double x, double y, double z);

}  // namespace seaglint
