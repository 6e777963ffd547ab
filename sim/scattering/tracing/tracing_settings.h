// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Settings of a trace: depth of the beams, edge diffraction, the smallest patches kept, and the selection of
// contributions.

#include <cstdint>
#include <span>
#include <vector>

#include "sim/scattering/scatterer/scatterer.h"
#include "sim/scenario/target_spec.h"

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

struct TracingSettings {
  // Side of the smallest illuminated patch kept, m; beams narrower than 3.6 times it are not followed to further
  // reflectors. 0 or coarser than that of a body by default: that.
  double min_patch_m = 0;
  int max_bounces = kDefaultBounces;  // 1 <= x <= kMaxBounces
  bool edges = false;                 // edge diffraction
  ContributionFilter filter = {};     // contributions that are summed; beams end at the walls of cavities only
  SolverMethod method = SolverMethod::kBeams;
  double ray_spacing_m = 0;  // distance between rays, m; 0: ray_spacing(). Used by rays alone
};

// Tracing settings of a target of a scenario.
TracingSettings tracing_settings(const SolverSpec& solver);

// Distance between rays, m: that of the settings, by default 1.5e-4 of the radius of the target's bounding sphere, 11
// mm on the 144 m ship.
double ray_spacing(const Scatterer& scatterer, const TracingSettings& settings = {});

// Side of the smallest illuminated patch kept on the smallest body, m: that of the settings, at most 0.7e-4 of the
// radius of that body's bounding sphere, 5 mm on the 144 m ship.
double min_patch(const Scatterer& scatterer, const TracingSettings& settings = {});

// A tenth of the amplitude k area / 2 pi of the smallest patch, m: end-point and edge contributions below it may be
// left out. On the ship they are -65 dB of the echo together.
double min_amplitude(const Scatterer& scatterer, const TracingSettings& settings, double k);

// Areas of the smallest illuminated patches kept, m^2. Each body has its own, so that the detail of one does not depend
// on what else is in a file. The scatterer must outlive them.
class SmallestAreas {
 public:
  SmallestAreas(const Scatterer& scatterer, const TracingSettings& settings);

  double on(int facet) const {
    return of_surface_[static_cast<std::size_t>(surface_of_[static_cast<std::size_t>(facet)])];
  }

 private:
  std::span<const std::int32_t> surface_of_;
  std::vector<double> of_surface_;
};

}  // namespace seaglint
