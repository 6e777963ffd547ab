// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Reciprocity: S(a, b) = S(b, a)^T, received along a and transmitted along b; for one antenna hv = vh.
//
// Geometrical optics carries a wave from panel to panel and physical optics radiates it, so that the sum of the beams
// is reciprocal to their accuracy only (README.md, "Reciprocity"). For one antenna the mean of the matrix and of the
// transposed one is the orthogonal projection on reciprocal matrices: its squared error over the elements is that of
// the matrix less |hv - vh|^2 / 2.

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "sim/scattering/observation/bistatic_geometry.h"
#include "sim/scattering/points/point_contributions.h"

namespace seaglint {

// Index of the pair with the antennas of the pair i exchanged, itself for one antenna; none where it is not among them.
inline std::optional<std::size_t> exchanged_pair(std::span<const BistaticGeometry> pairs, std::size_t i) {
  const auto exchanged = std::ranges::find_if(pairs, [&](const BistaticGeometry& other) {
    return other.transmit == pairs[i].receive && other.receive == pairs[i].transmit;
  });
  if (exchanged == pairs.end()) return std::nullopt;
  return static_cast<std::size_t>(exchanged - pairs.begin());
}

// Mean of a matrix hh, hv, vh, vv and the transposed one of exchanged antennas.
template <typename Element>
std::array<Element, 4> reciprocal_mean(const std::array<Element, 4>& matrix, const std::array<Element, 4>& exchanged) {
  const auto mean = [&](int i, int j) { return (matrix[i] + exchanged[j]) * typename Element::value_type(0.5); };
  return {mean(0, 0), mean(1, 2), mean(2, 1), mean(3, 3)};
}

// The point of a path becomes that of its reciprocal.
inline void exchange_antennas(PointContribution& point) {
  std::swap(point.pattern[1], point.pattern[2]);
  std::swap(point.gradient.transmit, point.gradient.receive);
  std::swap(point.gradient.transmit_slide, point.gradient.receive_slide);
}

}  // namespace seaglint
