// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/ship/ship_weapons.h"

#include <cmath>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/shapes/solids.h"

namespace seaglint {
namespace {

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

}  // namespace

void add_weapons(MeshBuilder& builder, const HullSurface& hull, const ShipHouses& houses) {
  add_gun(builder, hull);
  add_vertical_launchers(builder, hull);
  builder.begin_part("close_in_weapon");
  add_close_in_weapon(builder, {hull.x_of(-43.2), 0, houses.aft.roof}, kPi);
  add_canisters(builder, hull, houses.forward);
  add_decoy_launchers(builder, hull, houses);
}

}  // namespace seaglint
