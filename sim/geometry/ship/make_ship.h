// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Mesh of a generic naval combatant of about 144 m, with the scattering features of a ship at grazing elevation; no
// particular ship.

#include <string>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/geometry/shapes/generators.h"

namespace seaglint {

enum class ShipDetail {
  kHull,      // hull and houses
  kFittings,  // and masts, weapons, boats, deck fittings
  kRails,     // and rails, ladders, nets
};

// Positions along and across the ship scale with length and beam; fittings keep their size.
struct ShipForm {
  double length_m = 144;        // overall, 90 <= x <= 200
  double beam_m = 17.5;         // at the waterline, 12 <= x <= 25
  double freeboard_m = 5.8;     // amidships, 4 <= x <= 9
  double bow_height_m = 9.8;    // of the deck above the water, freeboard <= x <= 14
  double stern_height_m = 5.2;  // of the deck above the water, 3 <= x <= 9
  double panel_m = 1.5;         // length of a hull plate, 0.5 <= x <= 6
  double plating_m = 0.004;     // largest displacement of a hull plate's vertex, 0 <= x <= 0.05
  double rail_width_m = 0.045;  // 0.02 <= x <= 0.1
  ShipDetail detail = ShipDetail::kRails;
};

// Body frame, origin amidships on the centreline at the waterline z = 0, where the hull is cut and closed. Every part
// is closed and faces outwards, with normals where the surface is smooth; adjacent parts overlap slightly, so that no
// two faces coincide. Deterministic: equal forms give equal meshes. Throws InputError for a value out of range.
TriangleMesh make_ship(const ShipForm& form = {});

// Its parts: moulded hull, houses, and what is on their walls and along the edges of the decks. Positions are given on
// the 144 m design and scaled by HullSurface.

// Moulded surface: u = 0 at the transom to 1 at the stem, v = 0 at the waterline to 1 at the deck.
class HullSurface {
 public:
  explicit HullSurface(const ShipForm& form) : form_(form) {}

  Vec3 side(double u, double v) const;  // port side, y >= 0
  // Height and half-breadth of the deck at body x, m.
  double deck_height(double x) const;
  double deck_half_breadth(double x) const;

  // Positions on the 144 m by 17.5 m design, scaled to this form, m.
  double x_of(double design_x) const { return design_x * form_.length_m / 144.0; }
  double y_of(double design_y) const { return design_y * form_.beam_m / 17.5; }

  const ShipForm& form() const { return form_; }

 private:
  double waterline_half_breadth(double u) const;
  double deck_half_breadth_at(double u) const;

  ShipForm form_;
};

// One closed part: plated sides, transom, deck and a lid at z = 0.
void add_hull(MeshBuilder& builder, const HullSurface& hull);

// Bulwark along the forecastle's edge with its stays.
void add_bulwark(MeshBuilder& builder, const HullSurface& hull);

// A deckhouse: a frustum on an octagon, its walls inclined inwards. Heights above the waterline; wall slopes from the
// vertical in degrees.
struct Deckhouse {
  std::string name;
  double aft = 0, fore = 0;   // at the foot, design metres
  double half_width = 0;      // at the foot, design metres
  double foot = 0, roof = 0;  // m above the waterline
  double side_slope = 8, fore_slope = 12, aft_slope = 6;
  double fore_chamfer = 2.5, aft_chamfer = 0.8;  // chamfer of the vertical edges, m

  double half_width_at(const HullSurface& hull, double z) const;
  double fore_at(const HullSurface& hull, double z) const;
  double aft_at(const HullSurface& hull, double z) const;

  // Pose on the side wall at design x and height z: +x is the outward normal, +z points up along the wall. side = +1
  // port, -1 starboard.
  Pose on_side(const HullSurface& hull, double side, double design_x, double z) const;
};

// The eight vertices of a horizontal rectangle with chamfered corners, counter-clockwise from the starboard quarter, m.
std::vector<Vec3> octagon(double aft, double fore, double half_width, double aft_chamfer, double fore_chamfer,
                          double z);

// The houses that carry all fittings.
struct ShipHouses {
  Deckhouse forward, bridge, flag_deck, core, aft, radar_house;
};
ShipHouses ship_houses(const HullSurface& hull);

// Deckhouses, bridge with wings, funnel, hangar.
void add_superstructure(MeshBuilder& builder, const HullSurface& hull, const ShipHouses& houses);

// Fittings on the walls: cabinets, doors, liferafts, fire stations, lamps.
void add_wall_fittings(MeshBuilder& builder, const HullSurface& hull, const ShipHouses& houses);

// Rails of posts and bars, ladders, and the nets around the flight deck.
void add_rails(MeshBuilder& builder, const HullSurface& hull, const ShipHouses& houses);

}  // namespace seaglint
