// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Division of a frequency sweep into bands whose nodes stand for their frequencies.

#include <cstddef>
#include <span>
#include <vector>

#include "sim/scattering/observation/frequency_band.h"
#include "sim/scattering/scatterer/scatterer.h"

namespace seaglint {

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
