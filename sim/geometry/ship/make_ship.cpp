// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/ship/make_ship.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <tuple>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/rotation.h"
#include "sim/core/process/error.h"
#include "sim/geometry/surface/facets.h"

namespace seaglint {

namespace {

// Enclosed forward mast with its pole, lattice mast amidships, radars and antennas.

// Square platform round a mast with upright gussets below and a rail-high coaming: right-angled corners looking up and
// down.
void add_platform(MeshBuilder& builder, const Vec3& centre, double half, double core, double yaw) {
  const Pose base = upright(centre, yaw);
  add_box(builder, base, {2 * half, 2 * half, 0.08});
  for (int k = 0; k < 4; ++k) {
    const Pose side = base * upright(Vec3::Zero(), 0.5 * kPi * k);
    const Vec3 root_low = side * Vec3(core - 0.1, 0.02, -0.7), root = side * Vec3(core - 0.1, 0.02, 0.02),
               tip = side * Vec3(half - 0.1, 0.02, 0.02);
    add_plate(builder, {root_low, tip, root}, 0.04);
    // The four sides of the coaming overlap at their ends, at different depths.
    add_box(builder, side * upright({half - 0.03, 0, 0.03}), {0.04, 2 * half - (k % 2 == 0 ? 0.06 : 0.08), 0.35});
  }
}

// A yard with its fore-and-aft brackets and dipoles at the ends.
void add_yard(MeshBuilder& builder, const Vec3& centre, double half_span, double width) {
  const Vec3 tip(0, half_span, 0.25 * half_span * 0.3);
  for (double side : {1.0, -1.0}) {
    const Vec3 end(0, side * tip.y(), tip.z());
    add_bar(builder, centre, centre + end, width);
    add_bar(builder, centre - Vec3(0, 0, 0.9), centre + 0.6 * end, 0.6 * width);
    for (double s : {0.55, 0.8, 0.97}) {
      const Vec3 foot = centre + s * end;
      add_cone(builder, foot - Vec3(0, 0, 0.1), foot + Vec3(0, 0, 1.0), 0.05, 0.05, 8);
      add_box(builder, upright(foot + Vec3(0, 0, -0.32)), {0.22, 0.22, 0.26});
    }
  }
}

void add_enclosed_mast(MeshBuilder& builder, const HullSurface& hull, double foot) {
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

void add_lattice_mast(MeshBuilder& builder, const HullSurface& hull, double foot) {
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

void add_volume_radar(MeshBuilder& builder, const HullSurface& hull, double roof) {
  const double x = hull.x_of(-33.2);
  builder.begin_part("volume_radar");
  add_cone(builder, {x, 0, roof - 0.2}, {x, 0, roof + 1.0}, 1.15, 0.85, 16);
  const Pose head = upright({x, 0, roof + 0.9}, radians(-55));
  const Pose tilted = head * Pose{{0.5, 0, 0.2}, axis_rotation(radians(-15), Vec3::UnitY())};
  add_box(builder, tilted, {0.55, 6.4, 3.0});
  add_bar(builder, head * Vec3(-0.9, 0, 0), head * Vec3(0.4, 0, 1.6), 0.4);
  for (int k = -3; k <= 3; ++k) add_box(builder, tilted * upright({-0.38, 0.9 * k, 0.15}), {0.3, 0.08, 2.7});
}

void add_domes_and_whips(MeshBuilder& builder, const HullSurface& hull, const ShipHouses& houses) {
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
  add_cone(builder, {bow, 0, hull.deck_height(bow) - 0.1}, {bow + 0.3, 0, hull.deck_height(bow) + 3.4}, 0.05, 0.04, 6);
  add_cone(builder, {stern, 0, hull.deck_height(stern) - 0.1}, {stern - 0.6, 0, hull.deck_height(stern) + 3.0}, 0.05,
           0.04, 6);
}

void add_masts(MeshBuilder& builder, const HullSurface& hull, const ShipHouses& houses) {
  add_enclosed_mast(builder, hull, houses.flag_deck.roof);
  add_lattice_mast(builder, hull, houses.core.roof);
  add_volume_radar(builder, hull, houses.radar_house.roof);
  add_domes_and_whips(builder, hull, houses);
}

// Gun, vertical launchers, close-in weapon, canisters, decoy launchers.

void add_gun(MeshBuilder& builder, const HullSurface& hull) {
  const double x = hull.x_of(46.5), z = hull.deck_height(x - 2.5);
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

void add_vertical_launchers(MeshBuilder& builder, const HullSurface& hull) {
  const double x = hull.x_of(36.0), z = hull.deck_height(x);
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
    const Vec3 tip(bx + 2.2, -0.03 * side, hull.deck_height(bx) - 0.1),
        end(bx - 0.8, side * (hull.deck_half_breadth(bx - 0.8) - 0.9), hull.deck_height(bx) - 0.1);
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
void add_canisters(MeshBuilder& builder, const HullSurface& hull, const Deckhouse& forward) {
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

void add_decoy_launchers(MeshBuilder& builder, const HullSurface& hull, const ShipHouses& houses) {
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

void add_weapons(MeshBuilder& builder, const HullSurface& hull, const ShipHouses& houses) {
  add_gun(builder, hull);
  add_vertical_launchers(builder, hull);
  builder.begin_part("close_in_weapon");
  add_close_in_weapon(builder, {hull.x_of(-43.2), 0, houses.aft.roof}, kPi);
  add_canisters(builder, hull, houses.forward);
  add_decoy_launchers(builder, hull, houses);
}

// Fittings on the decks: bitts, fairleads, windlasses, lockers, ventilators, splinter shields, boats and their bays.

// A pair of bollards on a bed plate.
void add_bitts(MeshBuilder& builder, const Pose& pose) {
  add_box(builder, pose * upright({0, 0, -0.15}), {1.5, 0.55, 0.22});
  for (double x : {-0.45, 0.45}) {
    add_cone(builder, pose * Vec3(x, 0, 0.04), pose * Vec3(x, 0, 0.62), 0.19, 0.19, 12);
    add_cone(builder, pose * Vec3(x, 0, 0.60), pose * Vec3(x, 0, 0.68), 0.23, 0.23, 12);
  }
}

// Roller fairlead: a frame open to the side.
void add_fairlead(MeshBuilder& builder, const Pose& pose) {
  add_box(builder, pose * upright({0, 0, -0.12}), {0.5, 1.3, 0.2});
  for (double y : {-0.5, 0.5}) add_box(builder, pose * upright({0, y, 0.05}), {0.4, 0.16, 0.5});
  for (double y : {-0.25, 0.25}) add_cone(builder, pose * Vec3(0, y, 0.05), pose * Vec3(0, y, 0.48), 0.1, 0.1, 8);
}

void add_mooring_gear(MeshBuilder& builder, const HullSurface& hull) {
  builder.begin_part("mooring_gear");
  for (double side : {1.0, -1.0}) {
    for (double design_x : {67.0, 60.5, 50.0, 41.5, 31.5, -49.5, -58.0, -66.0}) {
      const double x = hull.x_of(design_x), z = hull.deck_height(x), y = hull.deck_half_breadth(x);
      const double along = std::atan2(hull.deck_half_breadth(x + 1) - hull.deck_half_breadth(x - 1), 2.0);
      if (y < 2.5) continue;
      add_bitts(builder, upright({x, side * (y - 1.35), z}, side * along));
      if (design_x < 45)
        add_fairlead(builder,
                     upright({x - 2.6, side * (hull.deck_half_breadth(x - 2.6) - 0.5), hull.deck_height(x - 2.6)},
                             side * along));
    }
  }
  builder.begin_part("windlasses");
  for (double side : {1.0, -1.0}) {
    const Vec3 foot(hull.x_of(61.5), side * 1.5, hull.deck_height(hull.x_of(61.5)));
    add_cone(builder, foot - Vec3(0, 0, 0.2), foot + Vec3(0, 0, 0.45), 0.75, 0.7, 14);
    add_cone(builder, foot + Vec3(0, 0, 0.4), foot + Vec3(0, 0, 1.1), 0.42, 0.5, 14);
    add_bar(builder, foot + Vec3(0.6, 0, 0.14),
            Vec3(hull.x_of(66.0), side * 0.9, hull.deck_height(hull.x_of(66.0)) + 0.12), 0.16);
  }
}

// Box with a lid that overhangs, on low feet.
void add_locker(MeshBuilder& builder, const Pose& pose, const Vec3& size) {
  add_box(builder, pose * upright({0, 0, -0.1}), size + Vec3(0, 0, 0.1));
  add_box(builder, pose * upright({0, 0, size.z() - 0.02}), {size.x() + 0.08, size.y() + 0.08, 0.06});
}

// Ventilator: a trunk with a hood that opens to one side.
void add_ventilator(MeshBuilder& builder, const Pose& pose, double height) {
  add_box(builder, pose * upright({0, 0, -0.1}), {0.6, 0.6, height + 0.12});
  add_open_box(builder, pose * upright({0.15, 0, height}), {0.95, 0.75, 0.65}, 0.03);
}

// Two upright plates at right angles on a bed plate: screens, splinter shields, ready-use stowages.
void add_shield(MeshBuilder& builder, const Pose& pose, double leg, double height) {
  add_corner_plates(builder, pose * upright({-0.4 * leg, -0.4 * leg, 0.04}), {leg, leg, height}, 0.06);
}

enum class Fitting { kLocker, kVentilator, kShield };

// A fitting to port and its like to starboard, turned differently. x, y: design metres, y = 0: one alone; yaw.
struct Pair {
  double x, y;
  double port_deg, starboard_deg;
};

Pose on_deck(const HullSurface& hull, double x, double y, double yaw_deg) {
  return upright({hull.x_of(x), hull.y_of(y), hull.deck_height(hull.x_of(x))}, radians(yaw_deg));
}

void add_fittings(MeshBuilder& builder, const HullSurface& hull, const ShipHouses& h) {
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
void add_boat(MeshBuilder& builder, const HullSurface& hull, double side) {
  builder.begin_part(side > 0 ? "boat_port" : "boat_starboard");
  const double x = hull.x_of(-13.4), z = hull.deck_height(x), y = side * hull.y_of(6.9);
  const Pose base = upright({x, y, z + 1.0});
  const auto ring = [&](double half, double aft, double fore, double up) {
    return std::vector<Vec3>{base * Vec3(aft, -half, up),       base * Vec3(fore - 1.5, -half, up),
                             base * Vec3(fore, -0.15, up),      base * Vec3(fore, 0.15, up),
                             base * Vec3(fore - 1.5, half, up), base * Vec3(aft, half, up)};
  };
  add_frustum(builder, ring(0.5, -2.8, 2.6, 0.0), ring(0.95, -3.1, 3.3, 0.75));
  for (double s : {1.0, -1.0}) {
    add_cone(builder, base * Vec3(-3.2, s * 1.0, 0.85), base * Vec3(1.7, s * 1.0, 0.95), 0.26, 0.26, 10);
    add_cone(builder, base * Vec3(1.6, s * 1.0, 0.95), base * Vec3(3.4, s * 0.1, 1.15), 0.26, 0.2, 10);
  }
  add_box(builder, base * upright({-0.4, 0, 0.7}), {0.9, 0.7, 1.0});
  add_box(builder, base * upright({-2.9, 0, 0.5}), {0.5, 0.7, 0.95});
  for (double at : {-1.6, 1.6}) {
    add_box(builder, upright({x + at, y, z - 0.1}), {0.25, 1.5, 1.2});
    // Davit: post inboard, arm over the boat.
    const Vec3 foot(x + at, y - side * 1.9, z - 0.1), head = foot + Vec3(0, 0, 3.7);
    add_bar(builder, foot, head, 0.3);
    add_bar(builder, head - Vec3(0, side * 0.1, 0.15), head + Vec3(0, side * 2.5, 0.35), 0.26);
    add_bar(builder, head + Vec3(0, side * 1.9, 0.25), head + Vec3(0, side * 1.9, -1.0), 0.08);
  }
}

void add_deck_fittings(MeshBuilder& builder, const HullSurface& hull, const ShipHouses& houses) {
  add_mooring_gear(builder, hull);
  add_fittings(builder, hull, houses);
  add_boat(builder, hull, 1.0);
  add_boat(builder, hull, -1.0);
}

// Positions on a grid of 2^-16 m (15 um, a thousandth of a wavelength at 16 GHz), which float32 represents exactly up
// to 256 m: differences in the last bit of a sine between processors have no effect.
TriangleMesh on_grid(TriangleMesh mesh) {
  for (Vec3& p : mesh.vertices) p = (p * 65536.0).rounded() / 65536.0;
  return mesh;
}

// Facets of the hull and of fairings turn by less, the sides of pipes and masts, knuckles and box edges by 22 deg and
// more.
constexpr double kSmoothTurn_deg = 20;
// Surfaces that rise by less count as flat, m: positions on the grid bend a long flat face of four corners by as much,
// which is 1.2 deg of two-way phase at 16 GHz.
constexpr double kFlat_m = 3e-5;

}  // namespace

TriangleMesh make_ship(const ShipForm& form) {
  for (const auto& [value, min, max, name] : {std::tuple{form.length_m, 90.0, 200.0, "length"},
                                              {form.beam_m, 12.0, 25.0, "beam"},
                                              {form.freeboard_m, 4.0, 9.0, "freeboard"},
                                              {form.bow_height_m, form.freeboard_m, 14.0, "bow height"},
                                              {form.stern_height_m, 3.0, 9.0, "stern height"},
                                              {form.panel_m, 0.5, 6.0, "panel"},
                                              {form.plating_m, 0.0, 0.05, "plating"},
                                              {form.rail_width_m, 0.02, 0.1, "rail width"}}) {
    // Written so that a NaN fails.
    if (!(value >= min && value <= max))
      throw InputError(fmt::format("ship {}: {} is outside {}..{} m", name, value, min, max));
  }

  const HullSurface hull(form);
  const ShipHouses houses = ship_houses(hull);
  MeshBuilder builder;
  add_hull(builder, hull);
  add_superstructure(builder, hull, houses);
  if (form.detail >= ShipDetail::kFittings) {
    add_bulwark(builder, hull);
    add_masts(builder, hull, houses);
    add_weapons(builder, hull, houses);
    add_deck_fittings(builder, hull, houses);
    add_wall_fittings(builder, hull, houses);
  }
  if (form.detail >= ShipDetail::kRails) add_rails(builder, hull, houses);
  TriangleMesh ship = on_grid(builder.take());
  ship.corner_normals = crease_normals(ship, radians(kSmoothTurn_deg), kFlat_m);
  return ship;
}

}  // namespace seaglint
