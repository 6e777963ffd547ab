// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Frequencies of an observation: bands over which amplitudes vary slowly, and the division of a sweep into them.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/scattering/scatterer/scatterer.h"

namespace seaglint {

inline constexpr std::size_t kBandNodes = 4;
using BandValues = std::array<Complex, kBandNodes>;  // of an amplitude, at the nodes

// Range of wavenumbers over which the form of a decomposition is the same. The ranges have fixed limits, so that a
// frequency has the same terms alone and within any sweep.
struct FormRange {
  double lowest = 0, highest = 0;  // rad/m
  double centre() const { return 0.5 * (lowest + highest); }
};
inline constexpr double kFormRatio = 1.189207115002721;  // 2^(1/4), highest over lowest
FormRange form_range(double k);                          // that contains k > 0

// Part of a frequency sweep over which amplitudes vary slowly: they are evaluated at a few wavenumbers, the nodes of
// the band, and interpolated by the polynomial through them.
class FrequencyBand {
 public:
  // One wavenumber, which is the only node; rad/m, > 0.
  explicit FrequencyBand(double k);
  // From lowest to highest > lowest, rad/m, within one FormRange: kBandNodes equidistant nodes.
  FrequencyBand(double lowest, double highest);

  const FormRange& form() const { return form_; }
  double centre() const { return centre_; }
  double half_width() const { return half_width_; }
  std::span<const double> nodes() const { return {nodes_.data(), count_}; }
  double node_step() const { return count_ > 1 ? nodes_[1] - nodes_[0] : 0; }  // rad/m

  // Weights of the values at the nodes in the interpolated value at k in the band. The error is at most
  // 0.0058 h^4 times the fourth derivative, h the half-width: 0.0058 x^4 of e^{jk d} with |h d| <= x.
  std::array<double, kBandNodes> weights(double k) const;

 private:
  double centre_, half_width_;
  FormRange form_;
  std::array<double, kBandNodes> nodes_{};
  std::size_t count_ = 1;
};

// Division of a frequency sweep into bands whose nodes stand for their frequencies.
class SweepPlan {
 public:
  // `wavenumbers`: of the sweep, in any order, at least one. Bands are at most kMaxBandRatio wide (highest over
  // lowest), narrower where layers of the target's materials delay the wave. Where a band holds no more frequencies
  // than nodes they are their own nodes.
  SweepPlan(const Scatterer& scatterer, std::span<const double> wavenumbers);

  struct Band {
    FrequencyBand band;
    std::size_t first_node;           // of nodes()
    std::vector<std::size_t> points;  // the frequencies, as indices of the sweep
  };
  std::span<const Band> bands() const { return bands_; }
  std::size_t size() const { return wavenumbers_.size(); }  // frequencies
  double wavenumber(std::size_t frequency) const { return wavenumbers_[frequency]; }
  // Frequency nearest to the middle of the sweep, the lower of two.
  std::size_t middle() const;
  // Wavenumbers at which contributions are evaluated, those of all bands.
  std::span<const double> nodes() const { return nodes_; }

 private:
  void add(const FrequencyBand& band, std::vector<std::size_t> points);

  std::vector<double> wavenumbers_;
  std::vector<Band> bands_;
  std::vector<double> nodes_;
};

}  // namespace seaglint
