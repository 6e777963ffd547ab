// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/beams/contribution_filter.h"

#include <algorithm>
#include <array>

namespace seaglint {
namespace {

bool selected(const EchoFilter& filter, int part, int bounces, Mechanism mechanism) {
  const auto &only = filter.only, &without = filter.without;
  if (only.empty() && without.empty()) return true;
  const std::array<int, 3> of{part, bounces, static_cast<int>(mechanism)};
  const auto meets = [&](const EchoSelector& s) { return of[static_cast<std::size_t>(s.kind)] == s.value; };
  if (std::any_of(without.begin(), without.end(), meets)) return false;
  return std::all_of(only.begin(), only.end(), [&](const EchoSelector& named) {
    return std::any_of(only.begin(), only.end(),
                       [&](const EchoSelector& s) { return s.kind == named.kind && meets(s); });
  });
}

}  // namespace

bool EchoFilter::is_cavity(int part) const {
  return std::find(cavities.begin(), cavities.end(), part) != cavities.end();
}

bool EchoFilter::keeps(int part, int bounces, Mechanism mechanism) const {
  return !is_cavity(part) && selected(*this, part, bounces, mechanism);
}

bool EchoFilter::keeps_edge(int part, int part_beyond, int bounces) const {
  if (is_cavity(part) && is_cavity(part_beyond)) return false;
  return selected(*this, is_cavity(part) ? part_beyond : part, bounces, Mechanism::kEdge);
}

bool EchoFilter::keeps_cavity(int part) const { return selected(*this, part, 1, Mechanism::kPhysicalOptics); }

}  // namespace seaglint
