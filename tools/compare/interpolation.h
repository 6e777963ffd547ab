// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Values of a cut at directions between its own, for a target of known extent.

#include <span>
#include <string>

#include "sim/core/process/parallel.h"
#include "sim/field_tables/field_table.h"
#include "tools/compare/paired_cut.h"

namespace seaglint {

// Which places were interpolated and how well. Errors are relative to a scattering centre's own amplitude, or of levels
// alone to its power.
struct InterpolationQuality {
  double radius_m = 0;
  std::size_t interpolated = 0, omitted = 0;  // omitted: standard error above kLargestInterpolationError
  double standard_error = 0;                  // rms over all places, for centres anywhere within the radius
  double largest_error = 0;                   // of any centre within the radius, at any place
};

// Of both sets of places together.
InterpolationQuality combined(const InterpolationQuality& a, const InterpolationQuality& b);

// "interpolated at 40 directions, 2 omitted, for a target within 1.5 m of its phase origin: standard error -60 dB, at
// most -41 dB of a scattering centre".
std::string text_of(const InterpolationQuality& quality);

// -26 dB: at the mean level of a pattern 0.4 dB.
inline constexpr double kLargestInterpolationError = 0.05;

struct InterpolatedCut {
  RcsCut cut;  // in the angles and about the origin of the interpolated one; omitted places are absent
  InterpolationQuality quality;
};

// The cut at these places, each at the equal frequency of its own (1e-6), elsewhere omitted. The target is taken as
// scattering centres x with |x| <= radius_m about the cut's phase origin and constant amplitudes, S(q) = sum_n a_n
// e^{j q.x_n}, q = k (r^_t + r^_s). With centres equally dense in that sphere, values at q and q' are correlated by
// K(u) = 3 (sin u - u cos u) / u^3, u = radius |q - q'|, and the estimate of least mean-square error is w = K^-1 k
// (Wiener interpolation; Rasmussen & Williams 2006, (2.25)), of the nearest 48 values within 8 half-waves pi / radius,
// which are taken to have independent errors of 1e-4 of the mean level. Its standard error is sqrt(1 - k.w) relative to
// the mean level. Levels without phases are interpolated as powers, which hold the differences of two centres:
// twice the radius; powers below 0 become kMinLevel_dbsm. radius_m > 0, finite.
// Throws InputError with the step of angle that is needed if every place is omitted.
InterpolatedCut interpolated_cut(const RcsCut& cut, std::span<const ViewPoint> places, double radius_m, int threads);

}  // namespace seaglint
