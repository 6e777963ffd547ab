// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Shape of the JONSWAP spectrum (gamma = 1: Pierson-Moskowitz in Bretschneider's form) over u = w / wp and the mean
// periods that follow from it.

namespace seaglint {

// Peak enhancement gamma^r - 1, r = exp(-(u-1)^2 / (2 s^2)), s = 0.07 below the peak and 0.09 above (Hasselmann et al.
// 1973, "Measurements of wind-wave growth and swell decay during JONSWAP", Deutsche Hydrogr. Z. A8(12), eq. 2.4.1).
double jonswap_enhancement(double u, double gamma);

// Beyond these u the enhancement is below double precision: ten standard deviations from the peak.
inline constexpr double kEnhancementBegin = 0.3, kEnhancementEnd = 1.9;

// Energy period Te = 2 pi m_-1 / m_0 and mean zero-crossing period Tz = 2 pi sqrt(m_0 / m_2) over the peak period, of
// the whole spectrum without a cut-off; gamma >= 1. Relative error 1e-10. At gamma 1: 0.8572 and 0.7104.
double energy_period_ratio(double gamma);
double zero_crossing_period_ratio(double gamma);

}  // namespace seaglint
