// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/tracing/contribution_filter.h"

#include <algorithm>
#include <array>

namespace seaglint {
namespace {

bool selected(const ContributionFilter& filter, int part, int bounces, Mechanism mechanism) {
  const auto &only = filter.included, &without = filter.excluded;
  if (only.empty() && without.empty()) return true;
  const std::array<int, 3> of{part, bounces, static_cast<int>(mechanism)};
  const auto meets = [&](const ContributionSelector& s) { return of[static_cast<std::size_t>(s.kind)] == s.value; };
  if (std::any_of(without.begin(), without.end(), meets)) return false;
  return std::all_of(only.begin(), only.end(), [&](const ContributionSelector& named) {
    return std::any_of(only.begin(), only.end(),
                       [&](const ContributionSelector& s) { return s.kind == named.kind && meets(s); });
  });
}

}  // namespace

bool ContributionFilter::is_cavity(int part) const {
  return std::find(cavities.begin(), cavities.end(), part) != cavities.end();
}

bool ContributionFilter::accepts(int part, int bounces, Mechanism mechanism) const {
  return !is_cavity(part) && selected(*this, part, bounces, mechanism);
}

bool ContributionFilter::accepts_edge(int part, int other_part, int bounces, Mechanism mechanism) const {
  if (is_cavity(part) && is_cavity(other_part)) return false;
  return selected(*this, is_cavity(part) ? other_part : part, bounces, mechanism);
}

bool ContributionFilter::accepts_cavity(int part) const { return selected(*this, part, 1, Mechanism::kPhysicalOptics); }

}  // namespace seaglint
