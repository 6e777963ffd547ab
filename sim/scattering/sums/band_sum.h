// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Sum of many points over a band: their phases are collected in cells of path length, in which the sum varies so slowly
// with k that its values at the nodes of the band determine it. The cost per point does not depend on the number of
// frequencies, which need not be equidistant.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/scattering/observation/frequency_band.h"
#include "sim/scattering/points/point.h"

namespace seaglint {

// Largest phase over half of the band between a point and the centre of its cell, rad. Together with that of a point's
// own amplitude, at most a tenth, the interpolation error of a point is below 9e-5 (FrequencyBand::weights).
inline constexpr double kCellHalfPhase = 0.25;

class BandSum {
 public:
  explicit BandSum(const FrequencyBand& band);

  // A point at the nodes of the band.
  void add(const Point& point);
  // Adds a sum over the same band, cell by cell.
  void add(const BandSum& other);

  // hh, hv, vh, vv at a wavenumber of the band, m.
  ScatteringMatrix at(double k) const;

 private:
  // Values at the nodes of the points in one cell, relative to the phase of its centre: real and imaginary parts.
  struct Cell {
    std::int64_t place = 0;  // its centre is at place * cell_m_
    std::array<std::array<double, 8>, kBandNodes> values{};
  };
  Cell& cell(std::int64_t place);

  FrequencyBand band_;
  double cell_m_;                     // 0 for a single wavenumber: one cell
  std::vector<Cell> cells_;           // in the order of their first points
  std::vector<std::int32_t> number_;  // of the cell at a place, from first_ on; -1: none yet
  std::int64_t first_ = 0;
};

}  // namespace seaglint
