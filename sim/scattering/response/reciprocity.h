// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Reciprocity: S(a, b) = S(b, a)^T, received along a and transmitted along b; for one antenna hv = vh.
//
// Geometrical optics carries a wave from panel to panel and physical optics radiates it, so that the sum of the beams
// is reciprocal to their accuracy only (README.md, "Reciprocity"). The mean of a matrix and of the transposed one with
// the antennas exchanged is the orthogonal projection on reciprocal matrices: its mean squared error over the elements
// of both is that of the two, less the square of half of their difference.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "sim/scattering/beams/bistatic_geometry.h"
#include "sim/scattering/surfaces/point_contributions.h"

namespace seaglint {

// Pairs of antennas, and behind them those with exchanged antennas that are not among them.
class ReciprocalPairs {
 public:
  explicit ReciprocalPairs(std::span<const BistaticGeometry> pairs);

  std::span<const BistaticGeometry> all() const { return all_; }
  // Index of the pair with the antennas of this one exchanged; itself for one antenna.
  std::size_t exchanged(std::size_t pair) const { return exchanged_[pair]; }

 private:
  std::vector<BistaticGeometry> all_;
  std::vector<std::size_t> exchanged_;
};

// Mean of a matrix hh, hv, vh, vv and the transposed one of exchanged antennas.
template <typename Element>
std::array<Element, 4> reciprocal_mean(const std::array<Element, 4>& matrix, const std::array<Element, 4>& exchanged) {
  const auto mean = [&](int i, int j) { return (matrix[i] + exchanged[j]) * typename Element::value_type(0.5); };
  return {mean(0, 0), mean(1, 2), mean(2, 1), mean(3, 3)};
}

// The point of a path becomes that of its reciprocal.
void exchange_antennas(PointContribution& point);

}  // namespace seaglint
