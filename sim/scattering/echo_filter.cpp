// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/echo_filter.h"

#include <algorithm>
#include <array>

namespace seaglint {

bool EchoFilter::keeps(int part, int bounces, Mechanism mechanism) const {
  if (only.empty() && without.empty()) return true;
  const std::array<int, 3> of{part, bounces, static_cast<int>(mechanism)};
  const auto meets = [&](const EchoSelector& s) { return of[static_cast<std::size_t>(s.kind)] == s.value; };
  if (std::any_of(without.begin(), without.end(), meets)) return false;
  return std::all_of(only.begin(), only.end(), [&](const EchoSelector& named) {
    return std::any_of(only.begin(), only.end(), [&](const EchoSelector& s) { return s.kind == named.kind && meets(s); });
  });
}

}  // namespace seaglint
