// SPDX-License-Identifier: BSD-3-Clause
// The combatant, a frigate or destroyer of 144 m by 17.5 m: hull, houses, masts, weapons, deck fittings, rails.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/geometry/ship/fittings.h"
#include "sim/geometry/ship/ship_design.h"

namespace seaglint {

namespace {

constexpr double kLength = 144, kBeam = 17.5;  // of the design, m

// The hull, with positions on the design scaled to it, m.
class CombatantHull : public HullSurface {
 public:
  using HullSurface::HullSurface;

  double x_of(double design_x) const { return design_x * length() / kLength; }
  double y_of(double design_y) const { return design_y * lines().beam / kBeam; }
  std::vector<double> places(std::vector<double> design_x) const {
    for (double& x : design_x) x = x_of(x);
    return design_x;
  }
};

// The houses that carry all fittings.
struct ShipHouses {
  Deckhouse forward, bridge, flag_deck, core, aft, radar_house;
};

// Open platforms to both sides of the bridge with a solid bulwark: floor and walls are perpendicular.
void add_bridge_wings(MeshBuilder& builder, const Deckhouse& bridge, const CombatantHull& hull) {
  builder.begin_part("bridge_wings");
  const double x = hull.x_of(21.4), z = bridge.foot + 0.35, root = bridge.half_width_at(z) - 0.5;
  for (double side : {1.0, -1.0}) {
    const double tip = hull.y_of(9.3), y = 0.5 * (root + tip), width = tip - root;
    const Pose base = upright({x, side * y, z});
    add_box(builder, base, {3.2, width, 0.16});
    add_box(builder, base * upright({1.56, 0, 0.02}), {0.06, width - 0.02, 1.15});
    add_box(builder, base * upright({-1.56, 0, 0.02}), {0.06, width - 0.02, 1.15});
    add_box(builder, base * upright({0, side * (0.5 * width - 0.04), 0.03}), {3.14, 0.06, 1.13});
    // Pelorus, searchlight and a chart box.
    add_cone(builder, base * Vec3(0.5, side * 0.5, 0.1), base * Vec3(0.5, side * 0.5, 1.35), 0.16, 0.12, 8);
    add_box(builder, base * upright({-1.1, side * 0.45, 0.1}), {0.55, 0.7, 1.5});
    // Brackets below.
    for (double at : {-1.2, 0.0, 1.2}) {
      const Vec3 head = base * Vec3(at, side * (0.5 * width - 0.2), 0.05),
                 root_high = base * Vec3(at, -side * 0.5 * width, 0.05);
      const Vec3 root_low = root_high - Vec3(0, 0, 1.2);
      side > 0 ? add_plate(builder, {root_low, head, root_high}, 0.04)
               : add_plate(builder, {root_high, head, root_low}, 0.04);
    }
  }
}

void add_funnel(MeshBuilder& builder, const CombatantHull& hull, const Deckhouse& aft) {
  const Deckhouse funnel{.name = "funnel",
                         .aft = hull.x_of(-27.0),
                         .fore = hull.x_of(-18.6),
                         .half_width = hull.y_of(3.3),
                         .foot = aft.roof - 0.25,
                         .roof = aft.roof + 6.6,
                         .side_slope = 9,
                         .fore_slope = 14,
                         .aft_slope = 5,
                         .fore_chamfer = 1.4,
                         .aft_chamfer = 0.9};
  add_house(builder, funnel);
  // Uptakes, and intake boxes with louvres on either side.
  for (double x : {-25.2, -23.4, -21.9}) {
    const Vec3 foot(hull.x_of(x), 0, funnel.roof - 0.3);
    add_cone(builder, foot, foot + Vec3(-0.5, 0, 1.9), 0.62, 0.58, 14);
  }
  builder.begin_part("intakes");
  for (double side : {1.0, -1.0}) {
    for (double z : {aft.roof + 0.8, aft.roof + 2.6}) {
      const Pose wall = funnel.on_side(side, hull.x_of(-22.8), z);
      add_open_box(builder, wall * Pose{{0.18, 0, 0}, Mat3::Identity()}, {0.5, 3.2, 1.3}, 0.06);
      for (int k = 1; k < 5; ++k)
        add_box(builder, wall * Pose{{0.18, 0, 0.26 * k}, Mat3::Identity()}, {0.36, 3.18, 0.03});
    }
  }
}

void add_hangar(MeshBuilder& builder, const CombatantHull& hull, const Deckhouse& aft) {
  builder.begin_part("hangar_door");
  const double low = hull.deck_edge_height(aft.aft) + 0.15, high = low + 4.6;
  const auto at = [&](double y, double z) { return Vec3(aft.aft_at(z) - 0.06, y, z); };
  // Five slats, each projecting slightly beyond the one below.
  for (int k = 0; k < 5; ++k) {
    const double from = low + (high - low) * k / 5.0 + 0.02, to = low + (high - low) * (k + 1) / 5.0 - 0.02;
    add_plate(builder, {at(3.0, from), at(-3.0, from), at(-3.0, to), at(3.0, to)}, 0.12);
  }
  // Posts and lintel around the door, the landing officer's box above.
  add_bar(builder, at(3.25, low - 0.3), at(3.25, high + 0.2), 0.35);
  add_bar(builder, at(-3.25, low - 0.3), at(-3.25, high + 0.2), 0.35);
  add_bar(builder, at(3.5, high + 0.2), at(-3.5, high + 0.2), 0.3);
  // Its sides are inclined: vertical ones would form a right-angled dihedral with the wall, with a specular flash at 2
  // deg of elevation.
  builder.begin_part("flight_control");
  const double x = aft.aft_at(aft.roof), low_z = aft.roof - 1.7, high_z = aft.roof - 0.3;
  add_frustum(builder, {{x - 1.0, 3.6, low_z}, {x + 0.6, 3.6, low_z}, {x + 0.6, 5.6, low_z}, {x - 1.0, 5.6, low_z}},
              {{x - 0.8, 3.8, high_z}, {x + 0.6, 3.8, high_z}, {x + 0.6, 5.4, high_z}, {x - 0.8, 5.4, high_z}});
}

ShipHouses ship_houses(const CombatantHull& hull) {
  const double deck = hull.lines().freeboard, foot = std::min(deck, hull.deck_edge_height(hull.x_of(-47))) - 0.35;
  // Ends and half-width at the foot are those of the design.
  const auto house = [&](Deckhouse design) {
    design.aft = hull.x_of(design.aft), design.fore = hull.x_of(design.fore);
    design.half_width = hull.y_of(design.half_width);
    return design;
  };
  ShipHouses h;
  h.forward = house({.name = "deckhouse_1",
                     .aft = -9.0,
                     .fore = 30.0,
                     .half_width = 8.75,
                     .foot = foot,
                     .roof = deck + 5.6,
                     .side_slope = 8,
                     .fore_slope = 14,
                     .aft_slope = 6,
                     .fore_chamfer = 3.6,
                     .aft_chamfer = 0.6});
  h.bridge = house({.name = "bridge",
                    .aft = 13.5,
                    .fore = 27.6,
                    .half_width = 6.9,
                    .foot = h.forward.roof - 0.3,
                    .roof = h.forward.roof + 3.3,
                    .side_slope = 10,
                    .fore_slope = 17,
                    .aft_slope = 5,
                    .fore_chamfer = 2.6,
                    .aft_chamfer = 0.8});
  h.flag_deck = house({.name = "flag_deck",
                       .aft = 0.5,
                       .fore = 14.5,
                       .half_width = 5.6,
                       .foot = h.forward.roof - 0.3,
                       .roof = h.forward.roof + 2.4,
                       .side_slope = 7,
                       .fore_slope = 9,
                       .aft_slope = 9,
                       .fore_chamfer = 0.8,
                       .aft_chamfer = 1.2});
  h.core = house({.name = "deckhouse_2",
                  .aft = -19.0,
                  .fore = -8.0,
                  .half_width = 4.4,
                  .foot = foot,
                  .roof = deck + 4.9,
                  .side_slope = 6,
                  .fore_slope = 7,
                  .aft_slope = 7,
                  .fore_chamfer = 0.3,
                  .aft_chamfer = 0.3});
  h.aft = house({.name = "hangar",
                 .aft = -46.5,
                 .fore = -17.8,
                 .half_width = 8.45,
                 .foot = foot,
                 .roof = deck + 6.0,
                 .side_slope = 7.5,
                 .fore_slope = 6,
                 .aft_slope = 5,
                 .fore_chamfer = 0.6,
                 .aft_chamfer = 1.0});
  h.radar_house = house({.name = "radar_house",
                         .aft = -37.0,
                         .fore = -29.5,
                         .half_width = 3.4,
                         .foot = h.aft.roof - 0.3,
                         .roof = h.aft.roof + 2.9,
                         .side_slope = 9,
                         .fore_slope = 11,
                         .aft_slope = 9,
                         .fore_chamfer = 0.8,
                         .aft_chamfer = 0.8});
  return h;
}

void add_superstructure(MeshBuilder& builder, const CombatantHull& hull, const ShipHouses& houses) {
  for (const Deckhouse* house :
       {&houses.forward, &houses.bridge, &houses.flag_deck, &houses.core, &houses.aft, &houses.radar_house}) {
    add_house(builder, *house);
  }
  builder.begin_part("bridge_windows");
  add_windows(builder, houses.bridge);
  add_bridge_wings(builder, houses.bridge, hull);
  add_funnel(builder, hull, houses.aft);
  add_hangar(builder, hull, houses.aft);
}

// Bay openings in the forward house's flanks for torpedo tubes: deep open boxes that project slightly.
void add_bays(MeshBuilder& builder, const CombatantHull& hull, const Deckhouse& house) {
  for (double side : {1.0, -1.0}) {
    const Pose wall = house.on_side(side, hull.x_of(-5.0), hull.lines().freeboard + 0.9);
    add_open_box(builder, moved(wall, 0.1, 0, 0), {0.7, 4.2, 2.2}, 0.06);
    for (int k = 0; k < 3; ++k) {
      const Vec3 breech = wall * Vec3(0.2, -1.6, 0.5 + 0.45 * k);
      add_cone(builder, breech, breech + wall.R * Vec3(0, 3.2, 0), 0.19, 0.19, 10);
    }
  }
}

// Anchors in their pockets on the bow.
void add_anchors(MeshBuilder& builder, const CombatantHull& hull) {
  for (double side : {1.0, -1.0}) {
    const Vec3 on_hull = hull.side(0.935, 0.72), below = hull.side(0.935, 0.5), ahead = hull.side(0.955, 0.72);
    Vec3 up = on_hull - below, along = ahead - on_hull;
    Vec3 centre = on_hull;
    for (Vec3* v : {&up, &along, &centre}) v->y() *= side;
    Pose pose;
    pose.p = centre;
    pose.R.col(2) = up.normalized();
    const Vec3 out = side > 0 ? Vec3(up.cross(along)) : Vec3(along.cross(up));
    pose.R.col(0) = -out.normalized();
    if (pose.R.col(0).y() * side < 0) pose.R.col(0) *= -1;
    pose.R.col(1) = pose.R.col(2).cross(pose.R.col(0));
    add_box(builder, pose * upright({0.05, 0, -0.9}), {0.5, 0.3, 1.8});
    add_box(builder, pose * upright({0.12, 0, -1.1}), {0.55, 1.7, 0.4});
    add_open_box(builder, pose * upright({0.05, 0, 0.7}), {0.4, 0.9, 0.8}, 0.06);
  }
}

void add_wall_fittings(MeshBuilder& builder, const CombatantHull& hull, const ShipHouses& houses) {
  const double deck = hull.lines().freeboard;
  builder.begin_part("cabinets");
  add_cabinets(builder, houses.forward, hull.x_of(1.5), hull.x_of(25), 4.1, deck + 1.1);
  add_cabinets(builder, houses.forward, hull.x_of(0.5), hull.x_of(25), 4.6, deck + 3.9);
  add_cabinets(builder, houses.aft, hull.x_of(-43.5), hull.x_of(-20), 4.0, deck + 1.1);
  add_cabinets(builder, houses.aft, hull.x_of(-44.5), hull.x_of(-20), 4.4, deck + 4.1);
  add_cabinets(builder, houses.flag_deck, hull.x_of(2.5), hull.x_of(12), 3.2, houses.forward.roof + 0.7);
  add_cabinets(builder, houses.radar_house, hull.x_of(-35.5), hull.x_of(-30.5), 2.4, houses.aft.roof + 0.9);
  add_cabinets(builder, houses.core, hull.x_of(-17.5), hull.x_of(-9.5), 2.7, deck + 1.3);
  builder.begin_part("doors");
  add_doors(builder, houses.forward, deck + 0.3, hull.places({24.6, 9.9, -0.9}));
  add_doors(builder, houses.aft, deck + 0.2, hull.places({-22.2, -33.4, -44.6}));
  add_doors(builder, houses.bridge, houses.forward.roof, hull.places({15.2}));
  add_doors(builder, houses.flag_deck, houses.forward.roof, hull.places({6.9}));
  builder.begin_part("liferafts");
  add_liferafts(builder, houses.forward, houses.forward.roof, hull.places({2.0, 24.0}));
  add_liferafts(builder, houses.aft, houses.aft.roof, hull.places({-26.6, -42.6}));
  builder.begin_part("brackets");
  add_brackets(builder, houses.forward, deck + 5.0, hull.places({-7.0, 3.6, 13.3, 20.2, 25.8}));
  add_brackets(builder, houses.aft, deck + 5.3, hull.places({-45.2, -39.7, -31.6, -25.7, -20.4}));
  add_brackets(builder, houses.bridge, houses.bridge.roof - 1.3, hull.places({14.6, 16.4, 18.0}));
  builder.begin_part("torpedo_bays");
  add_bays(builder, hull, houses.forward);
  builder.begin_part("anchors");
  add_anchors(builder, hull);
}

void add_deck_rails(MeshBuilder& builder, const CombatantHull& hull, double width) {
  // Along the flight deck there are nets instead.
  for (double side : {1.0, -1.0}) {
    builder.begin_part(side > 0 ? "rails_port" : "rails_starboard");
    std::vector<Vec3> line;
    double x = -45.5;
    while (x < 46.6) {
      const double at = hull.x_of(x);
      line.push_back({at, side * (hull.deck_half_breadth(at) - 0.14), hull.deck_edge_height(at)});
      x += 4.2;
    }
    add_rail(builder, line, width);
  }
}

void add_roof_rails(MeshBuilder& builder, const CombatantHull& hull, const ShipHouses& houses, double width) {
  builder.begin_part("roof_rails");
  const auto along = [&](const Deckhouse& house, double from, double to) {
    for (double side : {1.0, -1.0}) {
      const double y = side * (house.half_width_at(house.roof) - 0.12);
      add_rail(builder, {{hull.x_of(from), y, house.roof}, {hull.x_of(to), y, house.roof}}, width);
    }
  };
  const auto athwart = [&](const Deckhouse& house, double x, double half) {
    add_rail(builder, {{x, -half, house.roof}, {x, half, house.roof}}, width);
  };
  along(houses.forward, -7.8, 17.5);
  along(houses.aft, -45.0, -19.2);
  along(houses.bridge, 14.6, 23.5);
  along(houses.flag_deck, 1.6, 13.0);
  along(houses.radar_house, -35.6, -31.0);
  athwart(houses.aft, houses.aft.aft_at(houses.aft.roof) + 0.2, 6.4);
  athwart(houses.forward, houses.forward.aft_at(houses.forward.roof) + 0.2, 7.2);
  athwart(houses.bridge, houses.bridge.fore_at(houses.bridge.roof) - 0.2, 3.4);
  athwart(houses.radar_house, houses.radar_house.aft_at(houses.radar_house.roof) + 0.2, 2.0);
}

void add_ladders(MeshBuilder& builder, const CombatantHull& hull, const ShipHouses& houses, double width) {
  builder.begin_part("ladders");
  const auto on_side = [&](const Deckhouse& house, double x, double from) {
    for (double side : {1.0, -1.0}) {
      const Pose low = house.on_side(side, hull.x_of(x), from), high = house.on_side(side, hull.x_of(x), house.roof);
      add_ladder(builder, low * Vec3(0.2, 0, 0), high * Vec3(0.2, 0, 0.4), Vec3::UnitX(), width);
    }
  };
  const double deck = hull.lines().freeboard;
  on_side(houses.forward, 17.2, deck + 0.05);
  on_side(houses.forward, -3.0, deck + 3.3);
  on_side(houses.aft, -28.9, deck + 0.05);
  on_side(houses.aft, -41.2, deck + 0.05);
  on_side(houses.flag_deck, 4.4, houses.forward.roof + 0.05);
  on_side(houses.bridge, 14.3, houses.forward.roof + 0.05);
  on_side(houses.radar_house, -33.4, houses.aft.roof + 0.05);
  const double mast = hull.x_of(8.2) - 3.45, lattice = hull.x_of(-13.6);
  add_ladder(builder, {mast, 0.9, houses.flag_deck.roof}, {mast + 0.72, 0.9, houses.flag_deck.roof + 5.5},
             Vec3::UnitY(), width);
  add_ladder(builder, {lattice - 1.55, 0, houses.core.roof}, {lattice - 1.0, 0, houses.core.roof + 6.0}, Vec3::UnitY(),
             width);
  add_ladder(builder, {hull.x_of(-27.4), 1.2, houses.aft.roof}, {hull.x_of(-27.4) + 0.6, 1.2, houses.aft.roof + 6.4},
             Vec3::UnitY(), width);
}

// Frames hinged down to just below the deck, with bars for the net.
void add_nets(MeshBuilder& builder, const CombatantHull& hull, double width) {
  builder.begin_part("flight_deck_nets");
  for (double side : {1.0, -1.0}) {
    double x = -70.6;
    while (x < -47.5) {
      const auto at = [&](double design_x, double out, double down) {
        const double place = hull.x_of(design_x);
        return Vec3(place, side * (hull.deck_half_breadth(place) + out), hull.deck_edge_height(place) - down);
      };
      add_bar(builder, at(x, -0.1, 0.12), at(x, 1.25, -0.06), width);
      add_bar(builder, at(x + 2.3, -0.1, 0.12), at(x + 2.3, 1.25, -0.06), width);
      for (double out : {0.35, 0.78, 1.2})
        add_bar(builder, at(x, out, 0.06 - 0.1 * out), at(x + 2.3, out, 0.06 - 0.1 * out), 0.7 * width);
      x += 2.4;
    }
  }
}

void add_rails(MeshBuilder& builder, const CombatantHull& hull, const ShipHouses& houses, double width) {
  add_deck_rails(builder, hull, width);
  add_roof_rails(builder, hull, houses, width);
  add_ladders(builder, hull, houses, width);
  add_nets(builder, hull, width);
}

// Enclosed forward mast with its pole, lattice mast amidships, radars and antennas.

void add_enclosed_mast(MeshBuilder& builder, const CombatantHull& hull, double foot) {
  const double x = hull.x_of(8.2), top = foot + 12.5;
  builder.begin_part("mast_1");
  const auto ring = [&](double half, double chamfer, double z) {
    return octagon(x - half, x + half, half, chamfer, chamfer, z);
  };
  add_frustum(builder, ring(3.3, 0.9, foot - 0.3), ring(2.55, 0.75, foot + 5.8));
  add_frustum(builder, ring(2.35, 0.7, foot + 5.5), ring(1.25, 0.35, top));

  // Four array faces on the upper mast's walls.
  builder.begin_part("array_faces");
  const double slope = std::atan2(1.1, top - foot - 5.5);
  for (int k = 0; k < 4; ++k) {
    const double z = foot + 8.4, out = 2.35 - (z - foot - 5.5) * std::tan(slope);
    Pose wall = upright({x, 0, 0}, 0.5 * kPi * k);
    wall.p = wall * Vec3(out, 0, z);
    wall.R = wall.R * axis_rotation(-slope, Vec3::UnitY());
    std::vector<Vec3> outline;
    for (int c = 0; c < 8; ++c) {
      const double angle = kPi / 8 + 0.25 * kPi * c;
      outline.push_back(wall * Vec3(0.22, 1.15 * std::cos(angle), 1.15 * std::sin(angle)));
    }
    add_plate(builder, outline, 0.4);
  }

  builder.begin_part("mast_platforms");
  add_platform(builder, {x, 0, foot + 5.62}, 2.95, 2.5, 0);
  add_platform(builder, {x, 0, top - 0.1}, 1.75, 1.3, 0);
  builder.begin_part("pole_mast");
  add_cone(builder, {x, 0, top - 0.3}, {x, 0, top + 7.0}, 0.32, 0.12, 12);
  add_platform(builder, {x, 0, top + 2.9}, 0.75, 0.3, 0.25 * kPi);
  builder.begin_part("yards");
  add_yard(builder, {x, 0, top + 1.6}, 4.6, 0.14);
  add_yard(builder, {x, 0, top + 4.6}, 3.0, 0.11);
  add_yard(builder, {x - 0.6, 0, foot + 6.6}, 5.6, 0.16);

  // Navigation radars on brackets forward, a beacon cylinder at the top, boxes of electronic support around the lower
  // platform.
  builder.begin_part("antennas");
  for (const auto& [up, length, yaw] : {std::array<double, 3>{6.4, 2.6, 0.35}, {9.3, 1.9, 1.1}}) {
    const Vec3 at(x + (up > 8 ? 2.1 : 3.2), 0, foot + up);
    add_bar(builder, {x + 1.0, 0, foot + up}, at + Vec3(0.3, 0, 0), 0.22);
    add_cone(builder, at, at + Vec3(0, 0, 0.45), 0.22, 0.18, 10);
    add_box(builder, upright(at + Vec3(0, 0, 0.42), yaw), {0.22, length, 0.24});
  }
  add_cone(builder, {x, 0, top + 6.9}, {x, 0, top + 8.1}, 0.28, 0.28, 14);
  for (int k = 0; k < 4; ++k) {
    const Pose corner = upright({x, 0, foot + 5.68}, 0.25 * kPi + 0.5 * kPi * k);
    add_open_box(builder, corner * upright({3.5, 0, 0}), {0.6, 0.9, 0.8}, 0.04);
    add_box(builder, corner * upright({3.0, 0.75, 0}), {0.4, 0.4, 0.55});
  }
}

void add_lattice_mast(MeshBuilder& builder, const CombatantHull& hull, double foot) {
  const double x = hull.x_of(-13.6);
  constexpr double kHeight = 11.0, kFootHalf = 1.35, kTopHalf = 0.5;
  constexpr int kBays = 6;
  builder.begin_part("lattice_mast");
  const auto corner = [&](int k, double s) {
    const double half = kFootHalf + (kTopHalf - kFootHalf) * s;
    const double sx = (k == 0 || k == 3) ? -1 : 1, sy = k < 2 ? -1 : 1;
    return Vec3(x + sx * half, sy * half, foot - 0.3 + (kHeight + 0.3) * s);
  };
  for (int k = 0; k < 4; ++k) {
    add_bar(builder, corner(k, 0), corner(k, 1), 0.16);
    for (int bay = 0; bay < kBays; ++bay) {
      const double low = static_cast<double>(bay) / kBays, high = static_cast<double>(bay + 1) / kBays;
      const int next = (k + 1) % 4;
      add_bar(builder, corner(k, high), corner(next, high), 0.09);
      add_bar(builder, corner((k + bay) % 2 == 0 ? k : next, low), corner((k + bay) % 2 == 0 ? next : k, high), 0.08);
    }
  }
  add_platform(builder, {x, 0, foot + kHeight - 0.05}, 1.1, 0.5, 0);
  add_platform(builder, {x, 0, foot + 6.1}, 1.5, 0.9, 0);
  add_yard(builder, {x, 0, foot + 9.0}, 3.4, 0.12);
  add_cone(builder, {x, 0, foot + kHeight - 0.1}, {x, 0, foot + kHeight + 4.2}, 0.13, 0.06, 8);
  // Surveillance radar: a bent plate on its drive.
  add_cone(builder, {x, 0, foot + kHeight}, {x, 0, foot + kHeight + 0.7}, 0.42, 0.34, 12);
  builder.begin_part("surveillance_radar");
  const Pose head = upright({x + 0.45, 0, foot + kHeight + 0.65}, radians(20));
  for (int k = -2; k <= 2; ++k) {
    const Pose panel = head * upright({0.07 * k * k, 0.62 * k, 0}, radians(13.0 * k));
    add_box(builder, panel * Pose{Vec3::Zero(), axis_rotation(radians(-12), Vec3::UnitY())}, {0.12, 0.66, 1.15});
  }
  add_bar(builder, head * Vec3(-0.5, 0, 0.1), head * Vec3(0.1, 0, 0.6), 0.2);
}

void add_volume_radar(MeshBuilder& builder, const CombatantHull& hull, double roof) {
  const double x = hull.x_of(-33.2);
  builder.begin_part("volume_radar");
  add_cone(builder, {x, 0, roof - 0.2}, {x, 0, roof + 1.0}, 1.15, 0.85, 16);
  const Pose head = upright({x, 0, roof + 0.9}, radians(-55));
  const Pose tilted = head * Pose{{0.5, 0, 0.2}, axis_rotation(radians(-15), Vec3::UnitY())};
  add_box(builder, tilted, {0.55, 6.4, 3.0});
  add_bar(builder, head * Vec3(-0.9, 0, 0), head * Vec3(0.4, 0, 1.6), 0.4);
  for (int k = -3; k <= 3; ++k) add_box(builder, tilted * upright({-0.38, 0.9 * k, 0.15}), {0.3, 0.08, 2.7});
}

void add_domes_and_whips(MeshBuilder& builder, const CombatantHull& hull, const ShipHouses& houses) {
  builder.begin_part("satellite_domes");
  for (double side : {1.0, -1.0}) {
    const Vec3 foot(hull.x_of(2.6), side * hull.y_of(4.3), houses.flag_deck.roof);
    add_cone(builder, foot - Vec3(0, 0, 0.2), foot + Vec3(0, 0, 1.0), 0.55, 0.45, 12);
    add_sphere(builder, foot + Vec3(0, 0, 1.75), 0.95, 2);
  }
  builder.begin_part("fire_control");
  const Vec3 director(hull.x_of(19.5), 0, houses.bridge.roof);
  add_cone(builder, director - Vec3(0, 0, 0.2), director + Vec3(0, 0, 1.1), 0.8, 0.6, 14);
  add_box(builder, upright(director + Vec3(0, 0, 1.05), radians(25)), {0.9, 1.7, 1.1});
  add_cone(builder, director + Vec3(0.3, 0.1, 1.6), director + Vec3(1.0, 0.42, 1.75), 0.5, 0.62, 14);

  builder.begin_part("whips");
  struct Whip {
    double x, y, z, lean_x, lean_y;
  };
  const double bridge = houses.bridge.roof, aft = houses.aft.roof;
  for (const Whip& w :
       {Whip{16, 4.2, bridge, -0.5, 1.2}, Whip{16, -4.2, bridge, -0.5, -1.2}, Whip{-19.5, 6.0, aft, 0, 1.6},
        Whip{-19.5, -6.0, aft, 0, -1.6}, Whip{-38.5, 5.6, aft, -1.0, 1.2}, Whip{-38.5, -5.6, aft, -1.0, -1.2}}) {
    const Vec3 foot(hull.x_of(w.x), hull.y_of(w.y), w.z - 0.1);
    add_cone(builder, foot, foot + Vec3(0, 0, 0.7), 0.16, 0.12, 8);
    add_cone(builder, foot + Vec3(0, 0, 0.6), foot + Vec3(w.lean_x, w.lean_y, 7.5), 0.05, 0.03, 6);
  }
  builder.begin_part("flagstaffs");
  const double bow = hull.x_of(71.0), stern = hull.x_of(-71.3);
  add_cone(builder, {bow, 0, hull.deck_edge_height(bow) - 0.1}, {bow + 0.3, 0, hull.deck_edge_height(bow) + 3.4}, 0.05,
           0.04, 6);
  add_cone(builder, {stern, 0, hull.deck_edge_height(stern) - 0.1},
           {stern - 0.6, 0, hull.deck_edge_height(stern) + 3.0}, 0.05, 0.04, 6);
}

void add_masts(MeshBuilder& builder, const CombatantHull& hull, const ShipHouses& houses) {
  add_enclosed_mast(builder, hull, houses.flag_deck.roof);
  add_lattice_mast(builder, hull, houses.core.roof);
  add_volume_radar(builder, hull, houses.radar_house.roof);
  add_domes_and_whips(builder, hull, houses);
}

// Gun, vertical launchers, close-in weapon, canisters, decoy launchers.

void add_gun(MeshBuilder& builder, const CombatantHull& hull) {
  const double x = hull.x_of(46.5), z = hull.deck_edge_height(x - 2.5);
  builder.begin_part("gun");
  add_cone(builder, {x, 0, z - 0.4}, {x, 0, z + 0.75}, 2.0, 1.9, 20);
  // Faceted shield.
  const auto ring = [&](double aft, double fore, double half, double chamfer, double up) {
    return std::vector<Vec3>{
        {x - aft, -half, z + up},           {x + fore - chamfer, -half, z + up}, {x + fore, -half + chamfer, z + up},
        {x + fore, half - chamfer, z + up}, {x + fore - chamfer, half, z + up},  {x - aft, half, z + up}};
  };
  add_frustum(builder, ring(2.2, 2.1, 1.75, 0.8, 0.65), ring(2.45, 2.3, 1.95, 0.9, 1.4));
  add_frustum(builder, ring(2.40, 2.25, 1.90, 0.9, 1.38), ring(1.7, 0.5, 1.1, 0.5, 3.2));
  builder.begin_part("gun_barrel");
  const Vec3 trunnion(x + 1.2, 0, z + 2.1), aim = Vec3(std::cos(radians(4)), 0, std::sin(radians(4)));
  add_cone(builder, trunnion, trunnion + 1.6 * aim, 0.34, 0.26, 12);
  add_cone(builder, trunnion + 1.5 * aim, trunnion + 6.4 * aim, 0.15, 0.12, 12);
  add_cone(builder, trunnion + 6.3 * aim, trunnion + 6.9 * aim, 0.18, 0.18, 12);
}

void add_vertical_launchers(MeshBuilder& builder, const CombatantHull& hull) {
  const double x = hull.x_of(36.0), z = hull.deck_edge_height(x);
  builder.begin_part("vertical_launchers");
  add_box(builder, upright({x, 0, z - 0.5}), {7.6, 7.4, 1.15});
  for (int i = 0; i < 8; ++i) {
    for (int k = 0; k < 6; ++k) {
      if (k == 2 && i % 4 == 3) continue;
      add_box(builder, upright({x - 3.15 + 0.9 * i, -2.85 + 1.1 * k + (k > 2 ? 0.2 : 0), z + 0.6}), {0.78, 0.86, 0.13});
    }
  }
  // Breakwater ahead of the gun: two slanted plates with stays behind.
  builder.begin_part("breakwater");
  const double bx = hull.x_of(54.5);
  for (double side : {1.0, -1.0}) {
    const Vec3 tip(bx + 2.2, -0.03 * side, hull.deck_edge_height(bx) - 0.1),
        end(bx - 0.8, side * (hull.deck_half_breadth(bx - 0.8) - 0.9), hull.deck_edge_height(bx) - 0.1);
    const Vec3 up(-0.25, 0, 1.35);
    side > 0 ? add_plate(builder, {tip, end, end + up, tip + up}, 0.05)
             : add_plate(builder, {end, tip, tip + up, end + up}, 0.05);
    for (double s : {0.2, 0.45, 0.7, 0.92}) {
      const Vec3 root = tip + s * (end - tip) + Vec3(-0.02, 0, 0.02), heel = root - Vec3(0.9, 0, 0),
                 head = root + 0.9 * up;
      add_plate(builder, {heel, root, head}, 0.03);
    }
  }
}

void add_close_in_weapon(MeshBuilder& builder, const Vec3& foot, double yaw) {
  const Pose base = upright(foot, yaw);
  add_box(builder, base * upright({0, 0, -0.2}), {2.6, 2.6, 0.75});
  add_cone(builder, base * Vec3(0, 0, 0.5), base * Vec3(0, 0, 1.2), 0.95, 0.75, 14);
  add_box(builder, base * upright({-0.1, 0.62, 1.1}), {0.9, 0.18, 1.3});
  add_box(builder, base * upright({-0.1, -0.62, 1.1}), {0.9, 0.18, 1.3});
  add_box(builder, base * upright({-0.15, 0, 1.35}), {1.2, 0.95, 0.8});
  add_cone(builder, base * Vec3(-0.1, 0, 2.1), base * Vec3(-0.1, 0, 3.1), 0.48, 0.48, 14);
  add_sphere(builder, base * Vec3(-0.1, 0, 3.1), 0.48, 1);
  add_cone(builder, base * Vec3(0.4, 0, 1.75), base * Vec3(2.1, 0, 1.85), 0.16, 0.14, 10);
}

// Two pairs of canisters on an inclined frame, pointing athwartships.
void add_canisters(MeshBuilder& builder, const CombatantHull& hull, const Deckhouse& forward) {
  builder.begin_part("missile_canisters");
  for (double side : {1.0, -1.0}) {
    const Pose base = upright({hull.x_of(side > 0 ? -4.0 : -7.0), -side * 0.8, forward.roof}, side * radians(90));
    const Pose tilted = base * Pose{{0, 0, 0.75}, axis_rotation(radians(-14), Vec3::UnitY())};
    for (double y : {-0.45, 0.45}) {
      for (double z : {0.0, 0.86}) add_box(builder, tilted * upright({0, y, z}), {4.7, 0.74, 0.74});
    }
    for (double x : {-1.7, 1.7}) {
      for (double y : {-0.85, 0.85}) add_bar(builder, base * Vec3(x, y, -0.1), tilted * Vec3(x, y, 1.5), 0.12);
      add_bar(builder, base * Vec3(x, -0.95, 0.5), base * Vec3(x, 0.95, 0.5), 0.12);
    }
  }
}

void add_decoy_launchers(MeshBuilder& builder, const CombatantHull& hull, const ShipHouses& houses) {
  builder.begin_part("decoy_launchers");
  struct Place {
    double x, y, z, yaw;
  };
  const double aft = houses.aft.roof, flag = houses.flag_deck.roof;
  for (const Place& p : {Place{-41.0, 6.2, aft, 50}, Place{-41.0, -6.2, aft, -50}, Place{11.8, 4.2, flag, 60},
                         Place{11.8, -4.2, flag, -60}}) {
    const Pose base = upright({hull.x_of(p.x), hull.y_of(p.y), p.z}, radians(p.yaw));
    add_box(builder, base * upright({0, 0, -0.1}), {1.1, 1.3, 0.45});
    for (int row = 0; row < 2; ++row) {
      for (int k = 0; k < 3; ++k) {
        const Vec3 breech = base * Vec3(-0.25 + 0.4 * row, -0.4 + 0.4 * k, 0.3);
        add_cone(builder, breech, breech + base.R * Vec3(0.75, 0, 0.75), 0.13, 0.13, 8);
      }
    }
  }
}

void add_weapons(MeshBuilder& builder, const CombatantHull& hull, const ShipHouses& houses) {
  add_gun(builder, hull);
  add_vertical_launchers(builder, hull);
  builder.begin_part("close_in_weapon");
  add_close_in_weapon(builder, {hull.x_of(-43.2), 0, houses.aft.roof}, kPi);
  add_canisters(builder, hull, houses.forward);
  add_decoy_launchers(builder, hull, houses);
}

// Fittings on the decks: bitts, fairleads, windlasses, lockers, ventilators, splinter shields, boats and their bays.

void add_mooring_gear(MeshBuilder& builder, const CombatantHull& hull) {
  builder.begin_part("mooring_gear");
  for (double side : {1.0, -1.0}) {
    for (double design_x : {67.0, 60.5, 50.0, 41.5, 31.5, -49.5, -58.0, -66.0}) {
      const double x = hull.x_of(design_x), z = hull.deck_edge_height(x), y = hull.deck_half_breadth(x);
      const double along = std::atan2(hull.deck_half_breadth(x + 1) - hull.deck_half_breadth(x - 1), 2.0);
      if (y < 2.5) continue;
      add_bitts(builder, upright({x, side * (y - 1.35), z}, side * along));
      if (design_x < 45)
        add_fairlead(builder,
                     upright({x - 2.6, side * (hull.deck_half_breadth(x - 2.6) - 0.5), hull.deck_edge_height(x - 2.6)},
                             side * along));
    }
  }
  builder.begin_part("windlasses");
  for (double side : {1.0, -1.0}) {
    const Vec3 foot(hull.x_of(61.5), side * 1.5, hull.deck_edge_height(hull.x_of(61.5)));
    add_cone(builder, foot - Vec3(0, 0, 0.2), foot + Vec3(0, 0, 0.45), 0.75, 0.7, 14);
    add_cone(builder, foot + Vec3(0, 0, 0.4), foot + Vec3(0, 0, 1.1), 0.42, 0.5, 14);
    add_bar(builder, foot + Vec3(0.6, 0, 0.14),
            Vec3(hull.x_of(66.0), side * 0.9, hull.deck_edge_height(hull.x_of(66.0)) + 0.12), 0.16);
  }
}

enum class Fitting { kLocker, kVentilator, kShield };

// A fitting to port and its like to starboard, turned differently. x, y: design metres, y = 0: one alone; yaw.
struct Pair {
  double x, y;
  double port_deg, starboard_deg;
};

Pose on_deck(const CombatantHull& hull, double x, double y, double yaw_deg) {
  return upright({hull.x_of(x), hull.y_of(y), hull.deck_edge_height(hull.x_of(x))}, radians(yaw_deg));
}

void add_fittings(MeshBuilder& builder, const CombatantHull& hull, const ShipHouses& h) {
  using enum Fitting;
  // On the roof of a house, or on the deck. size: m, of a locker; leg and height of a shield; height of a ventilator.
  const auto add = [&](const char* part, const Deckhouse* house, Fitting kind, const Vec3& size,
                       const std::vector<Pair>& pairs) {
    builder.begin_part(part);
    for (const auto& [x, y, port_deg, starboard_deg] : pairs) {
      for (const double side : {1.0, -1.0}) {
        if (y == 0 && side < 0) continue;
        const double yaw_deg = side > 0 ? port_deg : starboard_deg;
        const Pose pose = house == nullptr
                              ? on_deck(hull, x, side * y, yaw_deg)
                              : upright({hull.x_of(x), hull.y_of(side * y), house->roof}, radians(yaw_deg));
        if (kind == kLocker) add_locker(builder, pose, size);
        if (kind == kVentilator) add_ventilator(builder, pose, size.x());
        if (kind == kShield) add_shield(builder, pose, size.x(), size.y());
      }
    }
  };
  add("foredeck_lockers", nullptr, kLocker, {1.6, 0.8, 0.95},
      {{57.5, 2.8, 10, -10}, {51.0, 3.6, 12, -12}, {42.0, 5.9, 4, -4}, {32.0, 6.6, 0, 0}});
  add("foredeck_ventilators", nullptr, kVentilator, {1.25, 0, 0},
      {{64.5, 0.0, 0, 0}, {58.8, 0.9, 130, -130}, {42.5, 3.6, 40, -40}, {31.6, 3.2, 75, -75}});
  add("foredeck_shields", nullptr, kShield, {0.7, 1.5, 0},
      {{40.2, 7.0, 0, -90}, {33.5, 7.4, 25, -115}, {49.3, 4.6, -20, -70}});
  add("flight_deck_gear", nullptr, kShield, {0.55, 0.9, 0},
      {{-48.2, 7.2, 45, -135}, {-53.0, 7.4, 60, -150}, {-69.5, 5.6, 100, 170}});
  add("flight_deck_gear", nullptr, kLocker, {1.2, 0.6, 0.75}, {{-49.3, 5.4, 12, -12}, {-70.0, 2.5, 90, 90}});
  // Recovery grid and its track, a few centimetres proud.
  const Pose grid = on_deck(hull, -58.0, 0, 0);
  add_cone(builder, grid * Vec3(0, 0, -0.1), grid * Vec3(0, 0, 0.04), 1.6, 1.6, 20);
  for (const double y : {0.5, -0.5})
    add_bar(builder, grid * Vec3(1.0, y, 0.0), on_deck(hull, -47.2, y, 0) * Vec3(0, 0, 0.02), 0.07);
  add("roof_shields", &h.forward, kShield, {0.6, 1.0, 0},
      {{-7.5, 6.4, 20, -80}, {-1.0, 6.6, 110, 160}, {5.5, 6.7, -10, -100}, {11.0, 6.6, 70, 200}});
  add("roof_shields", &h.bridge, kShield, {0.5, 0.7, 0}, {{16.2, 4.9, 95, 175}, {24.0, 3.9, -5, -75}});
  add("roof_shields", &h.aft, kShield, {0.6, 1.0, 0}, {{-45.0, 5.2, 150, 120}, {-38.6, 7.0, 30, -120}});
  add("roof_shields", &h.aft, kShield, {0.6, 1.0, 0},
      {{-31.0, 7.1, 85, 215}, {-24.0, 7.0, -20, -65}, {-19.8, 6.9, 15, -105}});
  add("roof_lockers", &h.forward, kLocker, {1.4, 0.7, 0.9}, {{-2.5, 4.6, 0, 0}, {8.0, 6.2, 90, 90}});
  add("roof_lockers", &h.aft, kLocker, {1.4, 0.8, 0.95},
      {{-40.5, 2.6, 0, 0}, {-28.2, 5.0, 35, -35}, {-34.5, 5.6, 0, 0}});
  add("roof_lockers", &h.core, kLocker, {1.1, 0.7, 0.8}, {{-11.0, 2.9, 0, 0}, {-17.0, 2.4, 90, 90}});
  add("roof_ventilators", &h.forward, kVentilator, {0.9, 0, 0}, {{-4.8, 6.0, 60, -60}, {3.5, 6.3, 135, -135}});
  add("roof_ventilators", &h.aft, kVentilator, {1.1, 0, 0},
      {{-21.5, 5.4, 25, -25}, {-30.0, 4.6, 100, -100}, {-43.8, 3.4, 150, -150}});
  add("roof_ventilators", &h.flag_deck, kVentilator, {0.6, 0, 0}, {{2.2, 2.2, 180, 180}, {12.8, 2.4, 70, -70}});
  add("roof_ventilators", &h.radar_house, kVentilator, {0.35, 0, 0}, {{-36.0, 1.9, 160, -160}, {-30.6, 1.8, 20, -20}});
  add("roof_ventilators", &h.bridge, kVentilator, {0.45, 0, 0}, {{15.6, 2.2, 170, -170}, {22.8, 1.9, 30, -30}});
}

// Rigid inflatable in the bay between the houses, under its davit.
void add_boat(MeshBuilder& builder, const CombatantHull& hull, double side) {
  builder.begin_part(side > 0 ? "boat_port" : "boat_starboard");
  const double x = hull.x_of(-13.4), z = hull.deck_edge_height(x), y = side * hull.y_of(6.9);
  const Pose base = upright({x, y, z + 1.0});
  add_rescue_boat(builder, base);
  for (double at : {-1.6, 1.6}) {
    add_box(builder, upright({x + at, y, z - 0.1}), {0.25, 1.5, 1.2});
    // Davit: post inboard, arm over the boat.
    const Vec3 foot(x + at, y - side * 1.9, z - 0.1), head = foot + Vec3(0, 0, 3.7);
    add_bar(builder, foot, head, 0.3);
    add_bar(builder, head - Vec3(0, side * 0.1, 0.15), head + Vec3(0, side * 2.5, 0.35), 0.26);
    add_bar(builder, head + Vec3(0, side * 1.9, 0.25), head + Vec3(0, side * 1.9, -1.0), 0.08);
  }
}

void add_deck_fittings(MeshBuilder& builder, const CombatantHull& hull, const ShipHouses& houses) {
  add_mooring_gear(builder, hull);
  add_fittings(builder, hull, houses);
  add_boat(builder, hull, 1.0);
  add_boat(builder, hull, -1.0);
}

}  // namespace

HullLines combatant_lines(double length, double beam) {
  HullLines lines;
  for (double* x : {&lines.stern_at_water, &lines.stern_at_deck, &lines.stem_at_water, &lines.stem_at_deck})
    *x *= length / kLength;
  lines.beam = beam;
  return lines;
}

void add_combatant(MeshBuilder& builder, const HullLines& lines, ShipDetail detail, double rail_width) {
  const CombatantHull hull(lines);
  const ShipHouses houses = ship_houses(hull);
  add_hull(builder, hull);
  add_superstructure(builder, hull, houses);
  if (detail >= ShipDetail::kFittings) {
    add_bulwark(builder, hull, {.from = hull.x_of(46.0), .to = hull.x_of(71.2)});
    add_masts(builder, hull, houses);
    add_weapons(builder, hull, houses);
    add_deck_fittings(builder, hull, houses);
    add_wall_fittings(builder, hull, houses);
  }
  if (detail >= ShipDetail::kRails) add_rails(builder, hull, houses, rail_width);
}

}  // namespace seaglint
