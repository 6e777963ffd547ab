// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/tracing/edge_illumination.h"

#include <algorithm>
#include <numeric>

namespace seaglint {

IlluminationByEdge::IlluminationByEdge(std::vector<std::vector<EdgeIllumination>> lists, std::size_t edge_count)
    : lists_(std::move(lists)), first_(edge_count + 1, 0) {
  for (const auto& list : lists_) {
    for (const EdgeIllumination& illumination : list) ++first_[static_cast<std::size_t>(illumination.edge) + 1];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  sorted_.resize(first_.back());
  for (const auto& list : lists_) {
    for (const EdgeIllumination& arrival : list) sorted_[next[arrival.edge]++] = &arrival;
  }
}

int IlluminationByEdge::edge_after(std::size_t arrivals) const {
  return static_cast<int>(std::lower_bound(first_.begin(), first_.end(), arrivals) - first_.begin());
}

}  // namespace seaglint
