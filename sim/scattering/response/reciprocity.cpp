// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/response/reciprocity.h"

#include <algorithm>
#include <utility>

namespace seaglint {

ReciprocalPairs::ReciprocalPairs(std::span<const BistaticGeometry> pairs)
    : all_(pairs.begin(), pairs.end()), exchanged_(pairs.size()) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto exchanged = std::ranges::find_if(all_, [&](const BistaticGeometry& other) {
      return other.transmit == pairs[i].receive && other.receive == pairs[i].transmit;
    });
    exchanged_[i] = static_cast<std::size_t>(exchanged - all_.begin());
    if (exchanged == all_.end()) all_.push_back(bistatic(pairs[i].receive, pairs[i].transmit));
  }
}

void exchange_antennas(PointContribution& point) {
  std::swap(point.pattern[1], point.pattern[2]);
  std::swap(point.gradient.transmit, point.gradient.receive);
  std::swap(point.gradient.transmit_slide, point.gradient.receive_slide);
}

}  // namespace seaglint
