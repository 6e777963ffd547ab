// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Variation of training maps by changes that leave the class: each epoch trains on other versions of them.

#include <span>

#include "classify/cnn/network_input.h"
#include "sim/core/numbers/random.h"

namespace seaglint {

// The centres of another observation of the same kind of target, in the same order. The ranges change sign in half of
// the cases, as seen from the other end, and so do the velocities, as for the same motion run backwards. The ranges are
// multiplied by a factor uniform in 0.8..1.25, another aspect or spacing. v += w (r - mean r) with w normal of 0.00125
// rad/s adds a constant rotation of the whole, or the radar's own motion. Residuals from the line of velocity over
// range keep their magnitude.
CentreList observed_otherwise(std::span<const ScatteringCentre> centres, Random& random);

// Adds errors of estimation, normal: 0.001 m/s in velocity, that of a centre 32 dB above clutter and noise in its cell
// (Cramer-Rao bound, sqrt(3)/(2 pi) cells / sqrt(SNR)); 0.02 m in range and 1 dB in amplitude, above that bound, as
// scatterers in one cell interfere.
CentreList with_errors(CentreList centres, Random& random);

// Range and velocity shift of the images, uniform within +-2 columns and +-0.5 rows.
ImageOffset random_offset(Random& random);

}  // namespace seaglint
