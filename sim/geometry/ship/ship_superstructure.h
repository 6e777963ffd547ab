// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Deckhouses, bridge with wings, funnel, hangar.
// Positions are given on the 144 m design and scaled by HullSurface.

#include <string>

#include "sim/geometry/mesh/mesh_builder.h"
#include "sim/geometry/shapes/solids.h"
#include "sim/geometry/ship/ship_hull.h"

namespace seaglint {

// A deckhouse: an eight-cornered frustum whose walls lean inwards. Heights above the waterline; slopes from the
// vertical in degrees.
struct Deckhouse {
  std::string name;
  double aft = 0, fore = 0;   // at the foot, design metres
  double half_width = 0;      // at the foot, design metres
  double foot = 0, roof = 0;  // m above the waterline
  double side_slope = 8, fore_slope = 12, aft_slope = 6;
  double fore_chamfer = 2.5, aft_chamfer = 0.8;  // cut off the corners, m

  double half_width_at(const HullSurface& hull, double z) const;
  double fore_at(const HullSurface& hull, double z) const;
  double aft_at(const HullSurface& hull, double z) const;

  // On the side wall at design x and height z: local +x out of the wall, +z up along it. side = +1 port, -1 starboard.
  Pose on_side(const HullSurface& hull, double side, double design_x, double z) const;
};

// Everything stands on one of these.
struct ShipHouses {
  Deckhouse forward, bridge, flag_deck, core, aft, radar_house;
};
ShipHouses ship_houses(const HullSurface& hull);

void add_superstructure(MeshBuilder& builder, const HullSurface& hull, const ShipHouses& houses);

}  // namespace seaglint
