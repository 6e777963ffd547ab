// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Frequency spectra of the sea surface elevation.

#include <memory>

#include "sim/scenario/sea_spec.h"

namespace seaglint {

// One-sided density of the elevation over angular frequency.
class Spectrum {
 public:
  virtual ~Spectrum() = default;

  virtual double density(double omega) const = 0;               // m^2 s/rad; 0 for omega <= 0
  virtual double energy(double lower, double upper) const = 0;  // integral of the density over [lower, upper], m^2
  virtual double energy_above(double omega) const = 0;          // m^2
  virtual double total_energy() const = 0;                      // m^2
  virtual double peak_omega() const = 0;                        // rad/s
  virtual double lowest_omega() const = 0;                      // rad/s; the energy below is negligible
};

// Lower end of realisations, relative to the peak frequency: a JONSWAP sea has less than 1e-20 of its energy below it.
inline constexpr double kLowestPeakMultiple = 0.4;

// JONSWAP (gamma = 1: Pierson-Moskowitz in Bretschneider's form), all values in SI: Hs and Tp > 0, gamma >= 1. Error of
// energies: the larger of 1e-10 relative and 5e-17 (5/16) Hs^2, the rounding of the difference of two cumulatives near
// 0.2 far above the peak. Relative error of the last of 512 strata up to 8 rad/s: 1e-10 at Tp 8 s, 8e-8 at 40 s; up to
// 100 rad/s at 40 s: 0.3 %.
class JonswapSpectrum : public Spectrum {
 public:
  JonswapSpectrum(double significant_wave_height_m, double peak_period_s, double gamma,
                  SpectrumNormalisation normalisation = SpectrumNormalisation::kExact);

  double density(double omega) const override;
  double energy(double lower, double upper) const override;
  double energy_above(double omega) const override;
  double total_energy() const override { return total_; }
  double peak_omega() const override { return peak_omega_; }
  double lowest_omega() const override { return kLowestPeakMultiple * peak_omega_; }

 private:
  double shape(double u) const;  // density times peak_omega_ over scale_, u = omega / peak_omega_
  double enhancement_integral(double lower, double upper) const;

  double peak_omega_;
  double gamma_;
  double scale_;  // m^2
  double total_;  // m^2
};

// Piecewise linear spectrum of a table, scaled to a significant wave height.
class TableSpectrum : public Spectrum {
 public:
  TableSpectrum(std::shared_ptr<const SpectrumTable> table, double significant_wave_height_m);

  double density(double omega) const override;
  double energy(double lower, double upper) const override;
  double energy_above(double omega) const override;
  double total_energy() const override { return total_; }
  double peak_omega() const override { return table_->peak_omega(); }
  double lowest_omega() const override;

 private:
  double cumulative(double omega) const;  // integral up to omega before scaling

  std::shared_ptr<const SpectrumTable> table_;
  double total_;  // m^2
  double scale_;
};

// Spectrum of the wind sea (or table) and of the swell of a state; null for a height of 0.
std::unique_ptr<Spectrum> wind_sea_spectrum(const SeaState& state);
std::unique_ptr<Spectrum> swell_spectrum(const SeaState& state);

// The cut-offs of a state in rad/s; a zero field means max(8, 4 wp) (or the end of a table), and the frequency where k
// Hs = 2 (no limit for Hs = 0). Swell ends at the lower of four times its peak frequency and the cut-off of the sea.
double linear_cutoff(const SeaState& state);
double swell_cutoff(const SeaState& state);
double second_order_cutoff(const SeaState& state);

}  // namespace seaglint
