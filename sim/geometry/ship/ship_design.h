// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The individual ship of a kind and a seed, and what stands on its hull.

#include "sim/core/numbers/random.h"
#include "sim/geometry/ship/hull.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

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

// Lines of the combatant, a frigate or destroyer of this length overall and beam at the waterline, m, without an
// underwater body.
HullLines combatant_lines(double length, double beam);
// Adds its hull and all that stands on it. Positions along and across the ship scale with length and beam of the lines,
// laid out for 144 m by 17.5 m; fittings keep their size. rail_width: m.
void add_combatant(MeshBuilder& builder, const HullLines& lines, ShipDetail detail, double rail_width);

// What stands on the hull of each other kind, added to the hull.
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
