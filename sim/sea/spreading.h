// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// How the energy of one frequency is spread over directions.

#include "sim/scenario/sea_spec.h"

namespace seaglint {

// The exponent s of cos^2s at a frequency, omega over the peak's: the spec's, or Mitsuyasu's s (f/fp)^5 below the peak
// and s (f/fp)^-2.5 above (Mitsuyasu et al. 1975, in Goda's form).
double spreading_exponent(const SpreadingSpec& spec, double omega_over_peak);

// First moment of the density D of energy over the angle from the mean direction, the mean of the angle's cosine: 1 for
// kNone, s/(s+1) for cos^2s, exp(-width^2/2) for the wrapped normal.
double spreading_r1(const SpreadingSpec& spec, double omega_over_peak);

// The angle from the mean direction below which the share `probability`, in (0, 1), of the energy travels, counted from
// -pi; to 1e-10 rad, the same bits on every machine. The wrapped normal's is that of the normal before wrapping.
double spreading_quantile(const SpreadingSpec& spec, double probability, double omega_over_peak);

}  // namespace seaglint
