// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Tapers between two asymptotic forms about the forward direction of an incident wave, the incident shadow boundary of
// an edge. k_hat: direction of the wave, s: direction of the diffracted ray, both unit; 1 where the term counts fully,
// 0 where it is left out.

#include "sim/core/numbers/linear.h"

namespace seaglint {

// Taper of fringe contributions on paths via reflectors, with s the direction before the first of them: 1 from 90 deg
// off the forward direction on, 0 within 30 deg of it. Near the shadow boundary the field towards a reflector at finite
// distance is no separate ray; the end-point contribution of the beam on that reflector contains it.
double fringe_forward_taper(const Vec3& k_hat, const Vec3& s);

// Taper of the edge's diffracted field, which is separable from the beam: 1 from 18 deg off the forward direction on, 0
// within 2.6 deg of it. cosine: k_hat . s.
double diffraction_forward_taper(const Vec3& k_hat, const Vec3& s);
double diffraction_forward_taper(double cosine);

}  // namespace seaglint
