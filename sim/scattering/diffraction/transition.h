// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The transition function of the uniform theory of diffraction, and its divided differences for two and three
// boundaries.

#include "sim/core/numbers/linear.h"

namespace seaglint {

// F(x) = 2j sqrt(x) e^{jx} integral from sqrt(x) to infinity of e^{-j t^2} dt: 0 on a shadow boundary, 1 far from it
// (R. G. Kouyoumjian and P. H. Pathak, Proc. IEEE 62 (1974) 1448-1461, eq. 26). F(-x) is its conjugate. Error below
// 1e-7.
Complex transition_function(double x);

// The same for a wave that runs along a face from one edge to another, where x and y belong to the two: F(x) when y is
// large. Not their product: with both boundaries near it is (y F(x) - x F(y)) / (y - x), what a plane wave past the
// first edge leaves at the second one of the integral over both apertures on a hard floor (the far-field limit of the
// generalised Fresnel integrals of F. Capolino, M. Albani, S. Maci and R. Tiberio, IEEE Trans. AP-45 (1997) 1240-1248).
Complex double_transition_function(double x, double y);

// The same with the end of the second edge for a third boundary. All are divided differences of F(x) / x, and the
// integral of F(al) e^{jpl} / sqrt(l) over the length l is the difference of transition(al, -pl) e^{jpl} / (jp sqrt(l))
// at its ends (by parts), that of transition(al, bl) likewise with transition(al, bl, -pl). x, y > 0, z of either sign.
Complex triple_transition_function(double x, double y, double z);

}  // namespace seaglint
