// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// How the energy of a sea is spread over frequency.

#include "sim/scenario/sea_spec.h"

namespace seaglint {

// kExact: the density integrates to Hs^2/16. kDnv: the factor 1 - 0.287 ln gamma of DNV-RP-C205, which is +0.24 % off
// at gamma 3.3 and -1.8 % at 7.
enum class SpectrumNormalisation { kExact, kDnv };

// JONSWAP (gamma = 1: Pierson-Moskowitz), all values in SI: Hs and Tp > 0, gamma >= 1.
class JonswapSpectrum {
 public:
  JonswapSpectrum(double significant_wave_height_m, double peak_period_s, double gamma,
                  SpectrumNormalisation normalisation = SpectrumNormalisation::kExact);

  double density(double omega) const;  // one-sided, m^2 s/rad; 0 for omega <= 0
  double energy(double lower,
                double upper) const;        // integral of the density over [lower, upper], m^2; relative error 1e-10
  double energy_above(double omega) const;  // m^2
  double peak_omega() const { return peak_omega_; }

 private:
  double shape(double u) const;  // density times peak_omega_ over scale_, u = omega / peak_omega_
  double enhancement_integral(double lower, double upper) const;

  double peak_omega_;
  double gamma_;
  double scale_;  // m^2
};

// Below this multiple of the peak frequency a JONSWAP sea holds less than 1e-20 of its energy: realisations start here.
inline constexpr double kLowestPeakMultiple = 0.4;

// The cut-offs of a state in rad/s; a zero field stands for max(8, 4 wp) and for sqrt(2 g / Hs) (no limit for Hs = 0).
double linear_cutoff(const SeaState& state);
double second_order_cutoff(const SeaState& state);

}  // namespace seaglint
