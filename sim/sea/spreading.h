// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Directional spreading of the energy of one frequency.

#include "sim/scenario/sea_spec.h"

namespace seaglint {

// Exponent s of cos^2s, by omega over the peak frequency: that of the spec, or Mitsuyasu's s (f/fp)^5 below the peak
// and s (f/fp)^-2.5 above (Mitsuyasu et al. 1975, in Goda's form).
double spreading_exponent(const SpreadingSpec& spec, double omega_over_peak);

// Quantile of the directional distribution: the angle from the mean direction below which, from -pi on, the fraction
// `probability` in (0, 1) of the energy lies; error 1e-10 rad, bit-identical on all machines. For the wrapped normal,
// the quantile of the normal distribution before wrapping.
double spreading_quantile(const SpreadingSpec& spec, double probability, double omega_over_peak);

}  // namespace seaglint
