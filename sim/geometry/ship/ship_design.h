// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The kinds of ships: proportions with their sources, and the individual ship of a seed.

#include "sim/core/numbers/random.h"
#include "sim/geometry/ship/hull.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

struct ShipRange {
  double lowest = 0, highest = 0;

  double at(double u) const { return lowest + u * (highest - lowest); }
};

// Proportions of a kind of ship, laden, and the shape of its hull per length and beam (sim/geometry/ship/README.md has
// the sources).
struct ShipKindForm {
  ShipRange length_to_beam;  // length overall over beam at the waterline
  ShipRange beam_to_draught;
  ShipRange depth_to_draught;  // depth: keel to deck amidships
  ShipRange block;             // coefficient, on length and beam at the waterline
  ShipRange gm_to_beam;        // metacentric height over beam, laden
  double light_gm_to_beam;     // of the lightest loading
  double light_draught;        // of the lightest loading, per laden draught
  HullLines shape;             // lengths along x per length overall, breadths per beam, heights per freeboard
};
const ShipKindForm& form_of(ShipKind kind);

// One ship: dimensions in m.
struct ShipDesign {
  ShipSpec spec;
  double length = 0, beam = 0, depth = 0;
  double laden_draught = 0, draught = 0;  // the latter with the loading
  double loading = 1;                     // 0 lightest to 1 laden
  double metacentric_height = 0;
  double trim = 0;  // rad, bow up
  HullLines lines;
  double rail_width = 0;  // 0: no rails
};

// Throws InputError for a length or loading out of range, with the range of the kind.
ShipDesign design_of(const ShipSpec& spec, Random& random);

// What stands on the hull of each kind, added to the hull.
void add_corvette(MeshBuilder& builder, const HullSurface& hull, const ShipDesign& ship, Random& random);
void add_patrol_boat(MeshBuilder& builder, const HullSurface& hull, const ShipDesign& ship, Random& random);
void add_container_ship(MeshBuilder& builder, const HullSurface& hull, const ShipDesign& ship, Random& random);
void add_tanker(MeshBuilder& builder, const HullSurface& hull, const ShipDesign& ship, Random& random);
void add_bulk_carrier(MeshBuilder& builder, const HullSurface& hull, const ShipDesign& ship, Random& random);
void add_ferry(MeshBuilder& builder, const HullSurface& hull, const ShipDesign& ship, Random& random);
void add_fishing_vessel(MeshBuilder& builder, const HullSurface& hull, const ShipDesign& ship, Random& random);
void add_tug(MeshBuilder& builder, const HullSurface& hull, const ShipDesign& ship, Random& random);
void add_inflatable_boat(MeshBuilder& builder, const HullSurface& hull, const ShipDesign& ship, Random& random);

}  // namespace seaglint
