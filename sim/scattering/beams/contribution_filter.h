// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Which echoes count: by the part they leave the target from, their number of bounces, and their mechanism.

#include <cstdint>
#include <vector>

namespace seaglint {

// By which current an echo arises.
enum class Mechanism : std::uint8_t {
  kPhysicalOptics,  // surface currents of geometrical optics
  kDiffraction,     // fringe currents at sharp edges
};

struct ContributionSelector {
  enum class Kind : std::uint8_t { kPart, kBounces, kMechanism } kind = Kind::kPart;
  int value = 0;  // index of the part, number of bounces, or the mechanism's number
};

// Empty: everything counts. `included`: an echo must meet a selector of every kind that is named. `without`: it must
// meet none.
struct ContributionFilter {
  std::vector<ContributionSelector> included, excluded;
  // Parts whose echoes are found from the field inside (sim/cavity): beams end at their walls, what walls and edges of
  // theirs return does not count.
  std::vector<int> cavities;

  bool is_cavity(int part) const;
  bool accepts(int part, int bounces, Mechanism mechanism) const;
  // An edge counts as its first facet's. Between a cavity and another part it is the rim, which stays.
  bool accepts_edge(int part, int other_part, int bounces) const;
  // Whether the echo of a cavity as a whole counts, by selectors of parts.
  bool accepts_cavity(int part) const;
};

}  // namespace seaglint
