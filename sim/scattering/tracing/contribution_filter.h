// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Selection of contributions by the part they leave the target from, their number of bounces and their mechanism.

#include <cstdint>
#include <vector>

namespace seaglint {

// Mechanism of a contribution. All but the first are edge diffraction.
enum class Mechanism : std::uint8_t {
  kPhysicalOptics,       // surface current of the geometrical-optics field
  kSingleDiffraction,    // convex edge, transmitter - edge - receiver
  kMultipleDiffraction,  // face-grazing waves between convex edges
  kReflectedEdge,        // edge with reflectors on the incident or the exit path
  kShadowBoundary,       // boundary terms of reflected beams
  kWallPenumbra,         // wall in the penumbra of the edge of a face
  kConcaveEdge,          // concave edge, and face-grazing waves that start, end or are diffracted at one
};
inline constexpr int kMechanisms = 7;

struct ContributionSelector {
  enum class Kind : std::uint8_t { kPart, kBounces, kMechanism } kind = Kind::kPart;
  int value = 0;  // part index, number of bounces, or numerical value of the mechanism

  bool operator==(const ContributionSelector&) const = default;
};

// Selects contributions; the default selects all. A contribution is selected when it matches, of every kind that occurs
// in `included`, at least one selector, and no selector of `excluded`. A selection does not change which beams are
// traced, except at cavities.
struct ContributionFilter {
  std::vector<ContributionSelector> included, excluded;
  // Parts solved by sim/cavity: beams end at their walls, and contributions of their walls and edges are not selected.
  std::vector<int> cavities;

  bool is_cavity(int part) const;
  bool accepts(int part, int bounces, Mechanism mechanism) const;
  // Of an edge between two parts the part of its first facet decides; at the rim of a cavity that of the part outside
  // it.
  bool accepts_edge(int part, int other_part, int bounces, Mechanism mechanism) const;
  // Whether the contribution of a cavity, as one bounce of physical optics on this part, is selected.
  bool accepts_cavity(int part) const;
};

}  // namespace seaglint
