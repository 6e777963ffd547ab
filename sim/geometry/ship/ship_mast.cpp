// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/ship/ship_mast.h"

#include <array>
#include <cmath>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/shapes/solids.h"

namespace seaglint {
namespace {

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
    return std::vector<Vec3>{{x - half, -half + chamfer, z}, {x - half + chamfer, -half, z},
                             {x + half - chamfer, -half, z}, {x + half, -half + chamfer, z},
                             {x + half, half - chamfer, z},  {x + half - chamfer, half, z},
                             {x - half + chamfer, half, z},  {x - half, half - chamfer, z}};
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

}  // namespace

void add_masts(MeshBuilder& builder, const HullSurface& hull, const ShipHouses& houses) {
  add_enclosed_mast(builder, hull, houses.flag_deck.roof);
  add_lattice_mast(builder, hull, houses.core.roof);
  add_volume_radar(builder, hull, houses.radar_house.roof);
  add_domes_and_whips(builder, hull, houses);
}

}  // namespace seaglint
