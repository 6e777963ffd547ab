// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/ship/ship_deck_fittings.h"

#include <cmath>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/geometry/shapes/solids.h"

namespace seaglint {
namespace {

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

struct Spot {
  double x, y;  // design metres
  double yaw;   // degrees
};

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

void add_foredeck(MeshBuilder& builder, const HullSurface& hull) {
  const auto on_deck = [&](const Spot& s) {
    const double x = hull.x_of(s.x);
    return upright({x, hull.y_of(s.y), hull.deck_height(x)}, radians(s.yaw));
  };
  builder.begin_part("foredeck_lockers");
  for (const Spot& s : {Spot{57.5, 2.8, 10},
                        {57.5, -2.8, -10},
                        {51.0, 3.6, 12},
                        {51.0, -3.6, -12},
                        {42.0, 5.9, 4},
                        {42.0, -5.9, -4},
                        {32.0, 6.6, 0},
                        {32.0, -6.6, 0}}) {
    add_locker(builder, on_deck(s), {1.6, 0.8, 0.95});
  }
  builder.begin_part("foredeck_ventilators");
  for (const Spot& s : {Spot{64.5, 0.0, 0},
                        {58.8, 0.9, 130},
                        {58.8, -0.9, -130},
                        {42.5, 3.6, 40},
                        {42.5, -3.6, -40},
                        {31.6, 3.2, 75},
                        {31.6, -3.2, -75}}) {
    add_ventilator(builder, on_deck(s), 1.25);
  }
  builder.begin_part("foredeck_shields");
  for (const Spot& s : {Spot{40.2, 7.0, 0},
                        {40.2, -7.0, -90},
                        {33.5, 7.4, 25},
                        {33.5, -7.4, -115},
                        {49.3, 4.6, -20},
                        {49.3, -4.6, -70}}) {
    add_shield(builder, on_deck(s), 0.7, 1.5);
  }
}

void add_flight_deck(MeshBuilder& builder, const HullSurface& hull) {
  const auto on_deck = [&](const Spot& s) {
    const double x = hull.x_of(s.x);
    return upright({x, hull.y_of(s.y), hull.deck_height(x)}, radians(s.yaw));
  };
  builder.begin_part("flight_deck_gear");
  for (const Spot& s : {Spot{-48.2, 7.2, 45},
                        {-48.2, -7.2, -135},
                        {-53.0, 7.4, 60},
                        {-53.0, -7.4, -150},
                        {-69.5, 5.6, 100},
                        {-69.5, -5.6, 170}}) {
    add_shield(builder, on_deck(s), 0.55, 0.9);
  }
  for (const Spot& s : {Spot{-49.3, 5.4, 12}, {-49.3, -5.4, -12}, {-70.0, 2.5, 90}, {-70.0, -2.5, 90}})
    add_locker(builder, on_deck(s), {1.2, 0.6, 0.75});
  // Recovery grid and its track, a few centimetres proud.
  const Pose grid = on_deck({-58.0, 0, 0});
  add_cone(builder, grid * Vec3(0, 0, -0.1), grid * Vec3(0, 0, 0.04), 1.6, 1.6, 20);
  add_bar(builder, grid * Vec3(1.0, 0.5, 0.0), on_deck({-47.2, 0.5, 0}) * Vec3(0, 0, 0.02), 0.07);
  add_bar(builder, grid * Vec3(1.0, -0.5, 0.0), on_deck({-47.2, -0.5, 0}) * Vec3(0, 0, 0.02), 0.07);
}

// Lockers, shields and ventilators on the roofs, turned in all directions.
void add_roof_fittings(MeshBuilder& builder, const HullSurface& hull, const ShipHouses& houses) {
  const auto on = [&](const Spot& s, double z) { return upright({hull.x_of(s.x), hull.y_of(s.y), z}, radians(s.yaw)); };
  const double forward = houses.forward.roof, bridge = houses.bridge.roof, aft = houses.aft.roof,
               core = houses.core.roof;
  const double flag = houses.flag_deck.roof, radar = houses.radar_house.roof;
  builder.begin_part("roof_shields");
  for (const Spot& s : {Spot{-7.5, 6.4, 20},
                        {-7.5, -6.4, -80},
                        {-1.0, 6.6, 110},
                        {-1.0, -6.6, 160},
                        {5.5, 6.7, -10},
                        {5.5, -6.7, -100},
                        {11.0, 6.6, 70},
                        {11.0, -6.6, 200}}) {
    add_shield(builder, on(s, forward), 0.6, 1.0);
  }
  for (const Spot& s : {Spot{16.2, 4.9, 95}, {16.2, -4.9, 175}, {24.0, 3.9, -5}, {24.0, -3.9, -75}})
    add_shield(builder, on(s, bridge), 0.5, 0.7);
  for (const Spot& s : {Spot{-45.0, 5.2, 150},
                        {-45.0, -5.2, 120},
                        {-38.6, 7.0, 30},
                        {-38.6, -7.0, -120},
                        {-31.0, 7.1, 85},
                        {-31.0, -7.1, 215},
                        {-24.0, 7.0, -20},
                        {-24.0, -7.0, -65},
                        {-19.8, 6.9, 15},
                        {-19.8, -6.9, -105}}) {
    add_shield(builder, on(s, aft), 0.6, 1.0);
  }
  builder.begin_part("roof_lockers");
  for (const Spot& s : {Spot{-2.5, 4.6, 0}, {-2.5, -4.6, 0}, {8.0, 6.2, 90}, {8.0, -6.2, 90}})
    add_locker(builder, on(s, forward), {1.4, 0.7, 0.9});
  for (const Spot& s :
       {Spot{-40.5, 2.6, 0}, {-40.5, -2.6, 0}, {-28.2, 5.0, 35}, {-28.2, -5.0, -35}, {-34.5, 5.6, 0}, {-34.5, -5.6, 0}})
    add_locker(builder, on(s, aft), {1.4, 0.8, 0.95});
  for (const Spot& s : {Spot{-11.0, 2.9, 0}, {-11.0, -2.9, 0}, {-17.0, 2.4, 90}, {-17.0, -2.4, 90}})
    add_locker(builder, on(s, core), {1.1, 0.7, 0.8});
  builder.begin_part("roof_ventilators");
  for (const Spot& s : {Spot{-4.8, 6.0, 60}, {-4.8, -6.0, -60}, {3.5, 6.3, 135}, {3.5, -6.3, -135}})
    add_ventilator(builder, on(s, forward), 0.9);
  for (const Spot& s : {Spot{-21.5, 5.4, 25},
                        {-21.5, -5.4, -25},
                        {-30.0, 4.6, 100},
                        {-30.0, -4.6, -100},
                        {-43.8, 3.4, 150},
                        {-43.8, -3.4, -150}})
    add_ventilator(builder, on(s, aft), 1.1);
  for (const Spot& s : {Spot{2.2, 2.2, 180}, {2.2, -2.2, 180}, {12.8, 2.4, 70}, {12.8, -2.4, -70}})
    add_ventilator(builder, on(s, flag), 0.6);
  for (const Spot& s : {Spot{-36.0, 1.9, 160}, {-36.0, -1.9, -160}, {-30.6, 1.8, 20}, {-30.6, -1.8, -20}})
    add_ventilator(builder, on(s, radar), 0.35);
  for (const Spot& s : {Spot{15.6, 2.2, 170}, {15.6, -2.2, -170}, {22.8, 1.9, 30}, {22.8, -1.9, -30}})
    add_ventilator(builder, on(s, bridge), 0.45);
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

}  // namespace

void add_deck_fittings(MeshBuilder& builder, const HullSurface& hull, const ShipHouses& houses) {
  add_mooring_gear(builder, hull);
  add_foredeck(builder, hull);
  add_flight_deck(builder, hull);
  add_roof_fittings(builder, hull, houses);
  add_boat(builder, hull, 1.0);
  add_boat(builder, hull, -1.0);
}

}  // namespace seaglint
