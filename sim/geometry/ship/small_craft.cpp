// SPDX-License-Identifier: BSD-3-Clause
// What stands on the decks of corvettes, patrol boats, fishing vessels, tugs and rigid inflatable boats.
#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/geometry/ship/fittings.h"
#include "sim/geometry/ship/ship_design.h"

namespace seaglint {

namespace {

// A turret with one barrel, pointing ahead. size: m, of its height.
void add_turret(MeshBuilder& builder, const Vec3& foot, double size) {
  add_cone(builder, foot - Vec3(0, 0, 0.2), foot + Vec3(0, 0, 0.25 * size), 0.65 * size, 0.6 * size, 14);
  add_frustum(builder,
              shifted(octagon(-0.8 * size, 0.75 * size, 0.62 * size, 0.2 * size, 0.35 * size, 0.22 * size), foot),
              shifted(octagon(-0.55 * size, 0.25 * size, 0.35 * size, 0.15 * size, 0.2 * size, 1.05 * size), foot));
  add_cone(builder, foot + Vec3(0.3, 0, 0.68) * size, foot + Vec3(2.3, 0, 0.9) * size, 0.07 * size, 0.05 * size, 10);
}

// Pyramid mast of flat faces with a pole, platforms and antennas, on a house's roof.
void add_pyramid_mast(MeshBuilder& builder, const Vec3& foot, double height, double half, Random& random) {
  builder.begin_part("mast");
  std::vector<Vec3> low = octagon(foot.x() - half, foot.x() + half, half, 0.3 * half, 0.3 * half, foot.z() - 0.3);
  std::vector<Vec3> high = octagon(foot.x() - 0.35 * half, foot.x() + 0.35 * half, 0.35 * half, 0.1 * half, 0.1 * half,
                                   foot.z() + 0.62 * height);
  add_frustum(builder, low, high);
  const Vec3 top(foot.x(), 0, foot.z() + 0.6 * height);
  add_cone(builder, top, top + Vec3(0, 0, 0.4 * height), 0.16, 0.07, 10);
  add_platform(builder, top - Vec3(0, 0, 0.05), 0.5 * half + 0.3, 0.36 * half, 0);
  add_yard(builder, top + Vec3(0, 0, 0.12 * height), 1.1 * half, 0.1);
  builder.begin_part("antennas");
  for (double up : {0.25, 0.45}) {
    const double x = half * (1 - up) + 0.6;
    add_bar(builder, foot + Vec3(0.2, 0, up * height - 0.05), foot + Vec3(x + 0.2, 0, up * height - 0.05), 0.16);
    add_radar_scanner(builder, foot + Vec3(x, 0, up * height), up < 0.3 ? 2.2 : 1.6, 2 * kPi * random.uniform());
  }
  add_cone(builder, top + Vec3(0, 0, 0.38 * height), top + Vec3(0, 0, 0.38 * height + 0.7), 0.25, 0.25, 12);
}

// Lockers, ventilators and shields along both sides of the deck, from x = from to x = to.
struct DeckGear {
  double from = 0, to = 0;
  int count = 8;
  double size = 1;  // of each, per its size on ships
};

void add_deck_gear(MeshBuilder& builder, const HullSurface& hull, const DeckGear& gear, Random& random) {
  builder.begin_part("deck_gear");
  for (int k = 0; k < gear.count; ++k) {
    const double x = gear.from + (gear.to - gear.from) * (k + random.uniform()) / gear.count;
    const double side = k % 2 == 0 ? 1 : -1, inboard = between(random, 0.7, 1.1) * gear.size;
    const double y = side * (hull.deck_half_breadth(x) - inboard), yaw = 2 * kPi * random.uniform();
    const Pose pose = upright({x, y, hull.deck_height(x, y)}, yaw);
    if (k % 3 == 0) add_locker(builder, pose, Vec3(0.8, 0.5, 0.6) * gear.size);
    if (k % 3 == 1) add_ventilator(builder, pose, between(random, 0.4, 0.8) * gear.size, gear.size);
    if (k % 3 == 2) add_shield(builder, pose, 0.4 * gear.size, 0.6 * gear.size);
  }
}

// A frame across the deck: two legs and a beam, with braces forward.
void add_gantry(MeshBuilder& builder, const Vec3& middle, double half, double height, double width) {
  for (double side : {1.0, -1.0}) {
    const Vec3 foot = middle + Vec3(0, side * half, -0.1), head = middle + Vec3(0, side * 0.85 * half, height);
    add_bar(builder, foot, head, width);
    add_bar(builder, foot + Vec3(0.45 * height, 0, 0), head - Vec3(0, 0, 0.15 * height), 0.6 * width);
  }
  add_bar(builder, middle + Vec3(0, -0.9 * half, height), middle + Vec3(0, 0.9 * half, height), width);
  for (double y : {-0.5, 0.0, 0.5})
    add_box(builder, upright(middle + Vec3(0, y * half, height - 0.7)), {0.3, 0.2, 0.65});
}

// Winch with two drums on a bed.
void add_winch(MeshBuilder& builder, const Pose& base, double size) {
  add_box(builder, base * upright({0, 0, -0.1}), Vec3(1.4, 2.6, 0.25) * size);
  for (double y : {-0.75, 0.75}) {
    add_cone(builder, base * Vec3(0, (y - 0.5) * size, 0.65 * size), base * Vec3(0, (y + 0.5) * size, 0.65 * size),
             0.3 * size, 0.3 * size, 12);
    for (double end : {-0.52, 0.52})
      add_cone(builder, base * Vec3(0, (y + end - 0.04) * size, 0.65 * size),
               base * Vec3(0, (y + end + 0.04) * size, 0.65 * size), 0.58 * size, 0.58 * size, 14);
  }
  add_box(builder, base * upright(Vec3(-0.9, 0, 0) * size), Vec3(0.5, 1.0, 0.9) * size);
}

// The wheelhouse of a boat: one storey on the deck, glazed, with a door in either side.
Deckhouse add_wheelhouse(MeshBuilder& builder, double aft, double fore, double half_width, double deck,
                         Random& random) {
  const Deckhouse house{.name = "wheelhouse",
                        .aft = aft,
                        .fore = fore,
                        .half_width = half_width,
                        .foot = deck - 0.2,
                        .roof = deck + 2.25,
                        .side_slope = 2,
                        .fore_slope = between(random, -8, 12),
                        .aft_slope = 1,
                        .fore_chamfer = 0.3 * half_width,
                        .aft_chamfer = 0.1};
  add_plated_house(builder, house, {1.2, 0.002}, random);
  add_glass_windows(builder, house);
  builder.begin_part("doors");
  add_doors(builder, house, house.foot + 0.2, {aft + 0.7});
  return house;
}

}  // namespace

void add_corvette(MeshBuilder& builder, const HullSurface& hull, const ShipDesign& ship, Random& random) {
  const double length = ship.length, breadth = hull.deck_half_breadth(0), slope = between(random, 4, 9);
  const Plating plating{1.8, 0.002};
  const double foot = std::min(hull.deck_edge_height(-0.18 * length), hull.deck_edge_height(0.15 * length)) - 0.3;
  const auto house = [&](const char* name, double aft, double fore, double half, double from, double to) {
    return Deckhouse{.name = name,
                     .aft = aft * length,
                     .fore = fore * length,
                     .half_width = half * breadth,
                     .foot = from,
                     .roof = to,
                     .side_slope = slope,
                     .fore_slope = slope + between(random, 2, 8),
                     .aft_slope = slope,
                     .fore_chamfer = 0.3 * half * breadth,
                     .aft_chamfer = 0.5};
  };
  const double tier = between(random, 2.5, 2.9);
  const Deckhouse main = house("deckhouse", -0.17, 0.17, 0.93, foot, foot + tier + 0.3);
  const Deckhouse bridge = house("bridge", 0.02, 0.145, 0.74, main.roof - 0.2, main.roof + tier);
  const Deckhouse aft = house("aft_house", -0.15, -0.03, 0.55, main.roof - 0.2, main.roof + 0.8 * tier);
  for (const Deckhouse* each : {&main, &bridge, &aft}) add_plated_house(builder, *each, plating, random);
  add_glass_windows(builder, bridge);
  add_pyramid_mast(builder, {0.035 * length, 0, bridge.roof}, between(random, 9, 12), 1.5, random);
  builder.begin_part("funnel");
  add_frustum(builder, octagon(-0.12 * length, -0.065 * length, 0.3 * breadth, 0.5, 0.8, aft.roof - 0.2),
              octagon(-0.118 * length, -0.075 * length, 0.24 * breadth, 0.4, 0.6, aft.roof + 3.2));
  if (ship.spec.detail == ShipDetail::kHull) return;
  builder.begin_part("gun");
  add_turret(builder, {0.3 * length, 0, hull.deck_height(0.3 * length, 0)}, between(random, 1.8, 2.2));
  builder.begin_part("missile_canisters");
  for (double side : {1.0, -1.0}) {
    const Pose base =
        upright({-0.2 * length - 1.5 * side, -0.5 * side, hull.deck_height(-0.2 * length, 0)}, side * radians(90));
    for (double y : {-0.5, 0.5}) {
      for (double z : {0.9, 1.75})
        add_box(builder, base * Pose{{0, y, z}, axis_rotation(radians(-12), Vec3::UnitY())}, {4.2, 0.72, 0.72});
    }
    for (double x : {-1.4, 1.4}) add_bar(builder, base * Vec3(x, 0, -0.1), base * Vec3(x, 0, 1.2), 0.2);
  }
  builder.begin_part("close_in_weapon");
  const Vec3 ciws(-0.145 * length, 0, aft.roof);
  add_cone(builder, ciws - Vec3(0, 0, 0.1), ciws + Vec3(0, 0, 0.9), 0.8, 0.6, 14);
  add_box(builder, upright(ciws + Vec3(0, 0, 0.85), between(random, -0.5, 0.5) + kPi), {1.1, 0.8, 0.9});
  add_sphere(builder, ciws + Vec3(0, 0, 2.2), 0.45, 1);
  builder.begin_part("satellite_domes");
  for (double side : {1.0, -1.0})
    add_dome(builder, {-0.02 * length, side * 0.62 * breadth, main.roof}, between(random, 0.5, 0.8));
  for (double side : {1.0, -1.0}) add_whip(builder, {0.03 * length, side * 0.6 * breadth, bridge.roof - 0.1}, 6);
  builder.begin_part("boats");
  for (double side : {1.0, -1.0}) {
    const Vec3 davit(-0.09 * length, side * 0.62 * breadth, main.roof);
    add_davit(builder, davit, {0, 0.5 * side, 0}, 3.2, 2.8);
    add_rescue_boat(builder, upright(davit + Vec3(0, side * 0.12 * breadth, 0.5)));
  }
  builder.begin_part("wall_fittings");
  add_doors(builder, main, foot + 0.3, {0.08 * length, -0.1 * length});
  add_cabinets(builder, main, -0.14 * length, 0.11 * length, between(random, 3.2, 4.5), foot + 1.2);
  add_brackets(builder, main, main.roof - 0.7, {-0.12 * length, -0.04 * length, 0.05 * length, 0.1 * length});
  add_liferafts(builder, main, main.roof, {-0.04 * length});
  add_deck_gear(builder, hull, {-0.42 * length, -0.22 * length, 8}, random);
  add_deck_gear(builder, hull, {0.2 * length, 0.4 * length, 8}, random);
  builder.begin_part("mooring_gear");
  add_mooring_gear(builder, hull, {-0.44 * length, -0.25 * length, 0.24 * length, 0.38 * length}, 0);
  builder.begin_part("windlasses");
  add_windlasses(builder, {0.41 * length, 0, hull.deck_height(0.41 * length, 0.8)}, 1.6, 0.6);
  add_bulwark(builder, hull, {.from = 0.36 * length, .to = 0.49 * length, .bays = 9, .height = 0.9});
  add_side_rails(builder, hull, 0.8 * ship.rail_width, -0.47 * length, 0.35 * length);
  if (!(ship.rail_width > 0)) return;
  builder.begin_part("rails");
  for (double side : {1.0, -1.0}) {
    const double y = side * (main.half_width_at(main.roof) - 0.12);
    add_rail(builder, {{-0.16 * length, y, main.roof}, {0.01 * length, y, main.roof}}, ship.rail_width);
  }
}

void add_patrol_boat(MeshBuilder& builder, const HullSurface& hull, const ShipDesign& ship, Random& random) {
  const double length = ship.length, breadth = hull.deck_half_breadth(0), scale = std::clamp(length / 34, 0.6, 1.4);
  const Plating plating{1.2, 0.0015};
  const double foot = std::min(hull.deck_edge_height(-0.14 * length), hull.deck_edge_height(0.1 * length)) - 0.2,
               tier = 2.3 * std::sqrt(scale);
  const Deckhouse main{.name = "deckhouse",
                       .aft = -0.2 * length,
                       .fore = between(random, 0.12, 0.18) * length,
                       .half_width = 0.76 * breadth,
                       .foot = foot,
                       .roof = foot + tier,
                       .side_slope = between(random, 3, 8),
                       .fore_slope = between(random, 18, 32),
                       .aft_slope = 4,
                       .fore_chamfer = 0.2 * breadth,
                       .aft_chamfer = 0.2};
  const Deckhouse wheelhouse{.name = "wheelhouse",
                             .aft = -0.09 * length,
                             .fore = 0.08 * length,
                             .half_width = 0.6 * breadth,
                             .foot = main.roof - 0.15,
                             .roof = main.roof + 0.95 * tier,
                             .side_slope = between(random, 4, 9),
                             .fore_slope = between(random, 12, 28),
                             .aft_slope = 4,
                             .fore_chamfer = 0.2 * breadth,
                             .aft_chamfer = 0.2};
  for (const Deckhouse* each : {&main, &wheelhouse}) add_plated_house(builder, *each, plating, random);
  add_glass_windows(builder, wheelhouse);
  builder.begin_part("mast");
  const Vec3 mast(-0.05 * length, 0, wheelhouse.roof);
  // Tripod with a platform.
  const double height = 4.5 * scale;
  add_bar(builder, mast + Vec3(0.3, 0, -0.2), mast + Vec3(-0.2, 0, height), 0.18);
  for (double side : {1.0, -1.0})
    add_bar(builder, mast + Vec3(-1.1 * scale, side * 0.8 * scale, -0.2), mast + Vec3(-0.2, 0.1 * side, 0.9 * height),
            0.12);
  add_platform(builder, mast + Vec3(-0.1, 0, 0.5 * height), 0.55, 0.2, 0);
  add_yard(builder, mast + Vec3(-0.2, 0, 0.8 * height), 1.3 * scale, 0.07);
  builder.begin_part("antennas");
  add_bar(builder, mast + Vec3(0, 0, 0.45 * height - 0.05), mast + Vec3(0.9, 0, 0.45 * height - 0.05), 0.1);
  add_radar_scanner(builder, mast + Vec3(0.8, 0, 0.45 * height), 1.8, 2 * kPi * random.uniform());
  add_dome(builder, mast + Vec3(-1.4 * scale, 0.35 * breadth, 0), 0.3 * scale);
  for (double side : {1.0, -1.0}) add_whip(builder, mast + Vec3(0.5, side * 0.5 * wheelhouse.half_width, 0), 4);
  if (ship.spec.detail == ShipDetail::kHull) return;
  builder.begin_part("gun");
  add_turret(builder, {0.27 * length, 0, hull.deck_height(0.27 * length, 0)}, between(random, 0.9, 1.1) * scale);
  const double cradle = -0.36 * length;
  if (length > 25) {
    builder.begin_part("boat");
    add_rescue_boat(builder, upright({cradle, 0, hull.deck_height(cradle, 0) + 0.45}));
    for (double x : {-1.6, 1.4})
      add_box(builder, upright({cradle + x, 0, hull.deck_height(cradle, 0) - 0.1}), {0.2, 1.5, 0.7});
    add_crane(builder, {.foot = {-0.26 * length, 0.5 * breadth, hull.deck_height(-0.26 * length, 0.5 * breadth)},
                        .pedestal = 1.6,
                        .radius = 0.22,
                        .jib = 4.5,
                        .heading = kPi + between(random, -0.2, 0.2),
                        .elevation = 0.15});
  }
  builder.begin_part("wall_fittings");
  add_doors(builder, main, foot + 0.2, {-0.12 * length});
  const bool is_boat = length < 25;
  if (!is_boat) add_cabinets(builder, main, -0.1 * length, 0.06 * length, 2.6, foot + 0.9);
  add_liferafts(builder, main, main.roof, {-0.15 * length}, length > 28 ? 2 : 1);
  const double gear = is_boat ? 0.6 : 1;
  add_deck_gear(builder, hull, {-0.45 * length, -0.24 * length, is_boat ? 4 : 6, gear}, random);
  add_deck_gear(builder, hull, {0.2 * length, 0.36 * length, is_boat ? 2 : 5, gear}, random);
  builder.begin_part("mooring_gear");
  add_mooring_gear(builder, hull, {-0.36 * length, 0.22 * length}, 0);
  add_side_rails(builder, hull, 0.8 * ship.rail_width, -0.47 * length, 0.44 * length);
}

void add_fishing_vessel(MeshBuilder& builder, const HullSurface& hull, const ShipDesign& ship, Random& random) {
  const double length = ship.length, scale = std::clamp(length / 28, 0.55, 2.0);
  const double aft = between(random, -0.02, 0.06) * length, fore = aft + between(random, 0.18, 0.24) * length;
  const double half = 0.7 * hull.deck_half_breadth(fore),
               deck = std::min(hull.deck_height(aft, half), hull.deck_height(fore, half));
  // Below 20 m a wheelhouse stands on the deck, as high as people.
  const bool is_boat = length < 20;
  const double rise = is_boat ? scale : std::sqrt(scale);
  const Deckhouse bridge = is_boat
                               ? add_wheelhouse(builder, aft, fore, 0.8 * hull.deck_half_breadth(fore), deck, random)
                               : add_accommodation(builder,
                                                   {.aft = aft,
                                                    .fore = fore,
                                                    .half_width = half,
                                                    .foot = deck,
                                                    .tiers = length < 26   ? 1
                                                             : length < 50 ? 2
                                                                           : 3,
                                                    .tier = 2.4,
                                                    .step = 0.3,
                                                    .fore_slope = 4,
                                                    .side_slope = 2,
                                                    .plating = {1.2, 0.002},
                                                    .rail_width = 0.8 * ship.rail_width},
                                                   random);
  builder.begin_part("antennas");
  add_pole_mast(builder, {bridge.aft + 0.5, 0, bridge.roof}, between(random, 5, 7) * rise, is_boat ? 1 : 2, random);
  add_dome(builder, {bridge.aft + 0.6, 0.6 * bridge.half_width, bridge.roof}, is_boat ? 0.18 : 0.35);
  for (double side : {1.0, -1.0})
    add_whip(builder, {bridge.fore - 0.8, side * 0.6 * bridge.half_width, bridge.roof},
             between(random, 4, 6) * (is_boat ? scale : 1));
  builder.begin_part("whaleback");
  add_deck_block(builder, hull,
                 {.name = "whaleback",
                  .from = 0.34 * length,
                  .to = hull.lines().stem_at_deck,
                  .height = 1.0 * scale,
                  .inset = 0.03},
                 {1.2, 0.002}, random);
  if (ship.spec.detail == ShipDetail::kHull) return;
  const double stern = hull.lines().stern_at_deck;
  builder.begin_part("gantry");
  const double gantry = stern + 0.05 * length, leg = 0.75 * hull.deck_half_breadth(gantry);
  add_gantry(builder, {gantry, 0, hull.deck_height(gantry, leg)}, leg, between(random, 3.2, 4.4) * rise, 0.26 * scale);
  builder.begin_part("net_drum");
  const double r = 0.75 * scale, w = 0.4 * hull.deck_half_breadth(-0.32 * length);
  const Pose drum = upright({-0.32 * length, 0, hull.deck_height(-0.32 * length, w)});
  add_cone(builder, drum * Vec3(0, -w, 1.3 * r), drum * Vec3(0, w, 1.3 * r), 0.75 * r, 0.75 * r, 16);
  for (double side : {1.0, -1.0}) {
    add_cone(builder, drum * Vec3(0, side * (w - 0.04), 1.3 * r), drum * Vec3(0, side * (w + 0.04), 1.3 * r), 1.25 * r,
             1.25 * r, 16);
    add_bar(builder, drum * Vec3(0, side * (w + 0.15), -0.1), drum * Vec3(0, side * (w + 0.15), 1.5 * r), 0.22 * scale);
  }
  builder.begin_part("winches");
  add_winch(builder,
            upright({aft - 0.07 * length, 0, hull.deck_height(aft - 0.07 * length, 0)}, between(random, -0.05, 0.05)),
            0.75 * scale);
  builder.begin_part("gallows");
  for (double side : {1.0, -1.0}) {
    const double x = -0.22 * length, y = side * (hull.deck_half_breadth(x) - 0.5), z = hull.deck_height(x, y);
    for (double at : {-0.7, 0.7})
      add_bar(builder, {x + at * scale, y, z - 0.1}, {x + 0.1 * at * scale, y + 0.1 * side, z + 2.4 * scale},
              0.18 * scale);
    add_box(builder, upright({x, y + 0.05 * side, z + 2.2 * scale}), Vec3(0.5, 0.3, 0.4) * scale);
    // Trawl door hanging at the gallows: inclined, as stowed.
    const double lean = 0.12 * side;
    const auto at = [&](double dx, double up) {
      return Vec3(x + dx * scale, y + 0.35 * side + lean * up * 0.3, z + 0.3 + up * scale);
    };
    side > 0 ? add_plate(builder, {at(0.8, 0), at(-0.8, 0), at(-0.8, 1.3), at(0.8, 1.3)}, 0.08)
             : add_plate(builder, {at(-0.8, 0), at(0.8, 0), at(0.8, 1.3), at(-0.8, 1.3)}, 0.08);
  }
  builder.begin_part("derrick");
  const Vec3 mast(aft - 0.02 * length, 0, deck);
  add_cone(builder, mast - Vec3(0, 0, 0.2), mast + Vec3(0, 0, 7.0 * rise), 0.17 * scale, 0.1 * scale, 10);
  add_cone(builder, mast + Vec3(-0.1, 0, 1.2), mast + Vec3(-0.22 * length, 0, 5.0 * rise), 0.1 * scale, 0.07 * scale,
           8);
  add_bar(builder, mast + Vec3(0, 0, 6.8 * rise), mast + Vec3(-0.215 * length, 0, 4.9 * rise), 0.04);
  builder.begin_part("hatches");
  add_hatch(builder, {-0.13 * length, 0, hull.deck_height(-0.13 * length, 0)}, Vec3(1.6, 1.8, 0.55) * scale, 1, random);
  builder.begin_part("liferafts");
  add_liferafts(builder, bridge, bridge.roof, {0.5 * (bridge.aft + bridge.fore)}, 1);
  add_deck_gear(builder, hull,
                {-0.42 * length, (is_boat ? -0.04 : 0.3) * length, is_boat ? 4 : 10, is_boat ? scale : 1}, random);
  builder.begin_part("windlasses");
  add_windlasses(builder, {0.40 * length, 0, hull.deck_edge_height(0.40 * length) + 1.0 * scale}, 1.1 * scale,
                 0.4 * scale);
  const double bulwark = is_boat ? 0.65 : 0.9;
  add_bulwark(builder, hull,
              {.from = stern + 0.1, .to = 0.33 * length, .bays = 14, .height = bulwark, .aft_height = bulwark});
}

void add_tug(MeshBuilder& builder, const HullSurface& hull, const ShipDesign& ship, Random& random) {
  const double length = ship.length, scale = length / 30;
  const double aft = between(random, -0.08, -0.03) * length, fore = aft + between(random, 0.27, 0.32) * length;
  const double half = 0.66 * hull.deck_half_breadth(fore),
               deck = std::min(hull.deck_height(aft, half), hull.deck_height(fore, half));
  const int tiers = length < 25 ? 1 : 2;
  const Deckhouse bridge = add_accommodation(builder,
                                             {.aft = aft,
                                              .fore = fore,
                                              .half_width = half,
                                              .foot = deck,
                                              .tiers = tiers,
                                              .tier = 2.4,
                                              .step = 0.09 * length,
                                              .fore_slope = 3,
                                              .side_slope = 2,
                                              .plating = {1.2, 0.002},
                                              .rail_width = 0.8 * ship.rail_width},
                                             random);
  builder.begin_part("antennas");
  add_pole_mast(builder, {bridge.aft + 0.7, 0, bridge.roof}, between(random, 5.5, 7.5) * (tiers == 1 ? 0.7 : 1), 1,
                random);
  for (double side : {1.0, -1.0})
    add_whip(builder, {bridge.aft + 0.5, side * 0.6 * bridge.half_width, bridge.roof}, 4.5);
  builder.begin_part("funnels");
  const double top = deck + 2.6 + 2.4 * tiers;
  for (double side : {1.0, -1.0}) {
    const Vec3 place(0, side * 0.75 * half, 0);
    add_frustum(builder, shifted(octagon(aft + 0.3, aft + 2.2 * scale, 0.5 * scale, 0.2, 0.2, deck + 2.3), place),
                shifted(octagon(aft + 0.2, aft + 1.7 * scale, 0.42 * scale, 0.15, 0.15, top), place));
    add_cone(builder, {aft + 0.9 * scale, side * 0.75 * half, top - 0.2},
             {aft + 0.7 * scale, side * 0.75 * half, top + 0.9}, 0.2, 0.19, 10);
  }
  if (ship.spec.detail == ShipDetail::kHull) return;
  builder.begin_part("winches");
  add_winch(builder, upright({fore + 0.07 * length, 0, hull.deck_height(fore + 0.07 * length, 0)}), 0.9 * scale);
  add_winch(builder, upright({aft - 0.09 * length, 0, hull.deck_height(aft - 0.09 * length, 0)}), 0.9 * scale);
  builder.begin_part("staple");
  for (double x : {0.40, -0.33}) {
    const double at = x * length, z = hull.deck_height(at, 0.6 * scale);
    for (double side : {1.0, -1.0})
      add_cone(builder, {at, side * 0.6 * scale, z - 0.1}, {at, side * 0.6 * scale, z + 1.4 * scale}, 0.2 * scale,
               0.2 * scale, 12);
    add_cone(builder, {at, -0.62 * scale, z + 1.35 * scale}, {at, 0.62 * scale, z + 1.35 * scale}, 0.2 * scale,
             0.2 * scale, 12);
  }
  // Fenders: a row of tyres along either side, a roll around the bow.
  builder.begin_part("fenders");
  const double tyre = 0.55 * std::sqrt(scale);
  for (double side : {1.0, -1.0}) {
    for (double x = -0.42 * length; x < 0.24 * length; x += 1.75 * tyre * 1.6) {
      const double z = hull.deck_edge_height(x) - 0.62 * tyre, y = hull.deck_half_breadth(x);
      add_cone(builder, {x, side * (y - 0.12), z}, {x, side * (y + 0.22), z}, 0.9 * tyre, 0.8 * tyre, 14);
    }
    double x = 0.28 * length;
    const double stem = hull.lines().stem_at_deck - 0.05;
    while (x < stem - 0.2) {
      const double next = std::min(stem, x + 0.045 * length);
      const Vec3 from(x, side * hull.deck_half_breadth(x), hull.deck_edge_height(x) - 0.35),
          to(next, side * hull.deck_half_breadth(next), hull.deck_edge_height(next) - 0.35);
      add_cone(builder, from, to, 0.36 * scale, 0.355 * scale, 10);
      x = next;
    }
  }
  builder.begin_part("fire_monitors");
  for (double side : {1.0, -1.0}) {
    const Vec3 foot(bridge.fore - 0.6, side * 0.45 * bridge.half_width, bridge.roof);
    add_cone(builder, foot - Vec3(0, 0, 0.1), foot + Vec3(0, 0, 0.8), 0.12, 0.12, 8);
    add_cone(builder, foot + Vec3(-0.1, 0, 0.85), foot + Vec3(0.9, side * 0.25, 1.25), 0.11, 0.08, 8);
  }
  builder.begin_part("boat");
  add_crane(builder, {.foot = {aft - 0.02 * length, 0.7 * half, deck},
                      .pedestal = tiers == 1 ? 1.9 : 2.6,
                      .radius = 0.22,
                      .jib = tiers == 1 ? 3.2 : 4.5,
                      .heading = kPi + between(random, -0.3, 0.3),
                      .elevation = 0.2});
  builder.begin_part("liferafts");
  add_liferafts(builder, bridge, bridge.roof, {bridge.aft + 1.0}, 1);
  add_deck_gear(builder, hull, {-0.42 * length, -0.12 * length, tiers == 1 ? 5 : 8, tiers == 1 ? 0.7 : 1}, random);
  add_bulwark(
      builder, hull,
      {.from = hull.lines().stern_at_deck + 0.1, .to = 0.485 * length, .bays = 18, .height = 0.9, .aft_height = 0.8});
}

void add_inflatable_boat(MeshBuilder& builder, const HullSurface& hull, const ShipDesign& ship, Random& random) {
  const double length = ship.length, scale = length / 7.5, radius = between(random, 0.24, 0.28) * std::sqrt(scale);
  // Tubes along both sides of the deck, drawn together at the bow, with cones aft.
  builder.begin_part("tubes");
  builder.begin_material("rubber_tube");
  for (double side : {1.0, -1.0}) {
    const double stern = hull.lines().stern_at_deck - 0.02 * length;
    std::vector<Vec3> line;
    const auto at = [&](double x) {
      const double inside = std::clamp(x, hull.lines().stern_at_deck, hull.lines().stem_at_deck);
      return Vec3(x, side * std::max(0.06, hull.deck_half_breadth(inside) - 0.1 * radius),
                  hull.deck_edge_height(inside) + 0.05 * radius);
    };
    constexpr int kPieces = 14;
    const double bow = hull.lines().stem_at_deck - 0.4 * radius;
    for (int k = 0; k <= kPieces; ++k) line.push_back(at(stern + (bow - stern) * k / kPieces));
    add_sphere(builder, line.back(), 0.99 * radius, 1);
    add_cone(builder, line[0] - Vec3(0.09 * length, 0, 0), line[0] + Vec3(0.01, 0, 0), 0.35 * radius, radius, 16);
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const Vec3 along = 0.02 * radius * (line[k + 1] - line[k]).normalized();
      add_cone(builder, line[k] - along, line[k + 1] + along, radius * (1 - 0.0004 * static_cast<double>(k)),
               radius * (1 - 0.0004 * static_cast<double>(k + 1)), 16);
    }
  }
  const double deck = hull.deck_height(-0.1 * length, 0);
  builder.begin_part("console");
  builder.begin_material("grp_sheet");
  const double x = between(random, -0.08, 0.02) * length;
  // From 9.5 m on the console is as wide as three people, under a roof.
  const bool is_large = length > 9.5;
  const double wide = is_large ? 1.8 : 1;
  add_frustum(builder, octagon(x, x + 0.8 * wide, 0.4 * wide, 0.05, 0.2, deck - 0.05),
              octagon(x + 0.05, x + 0.5 * wide, 0.36 * wide, 0.04, 0.15, deck + 1.0));
  if (is_large) {
    add_box(builder, upright({x - 0.05, 0, deck + 2.05}), {2.1, 1.7, 0.06});
    builder.begin_material("pec");
    for (double at : {-0.8, 0.7}) {
      for (double side : {1.0, -1.0})
        add_cone(builder, {x + at, side * 0.62, deck - 0.05}, {x + at, side * 0.62, deck + 2.1}, 0.03, 0.03, 8);
    }
  }
  builder.begin_material("window_glass");
  add_plate(builder,
            {{x + 0.42 * wide, -0.33 * wide, deck + 0.97},
             {x + 0.42 * wide, 0.33 * wide, deck + 0.97},
             {x + 0.42 * wide - 0.2, 0.3 * wide, deck + 1.4},
             {x + 0.42 * wide - 0.2, -0.3 * wide, deck + 1.4}},
            0.02);
  builder.begin_part("seats");
  builder.begin_material("grp_sheet");
  const int seats = length < 6.5 ? 1 : is_large ? 4 + 2 * static_cast<int>((length - 9) / 2) : 3;
  // In pairs, the last of an odd number in the middle.
  const auto seat = [&](int k) {
    const double side = k + 1 == seats && k % 2 == 0 ? 0 : k % 2 == 0 ? 1 : -1;
    return Vec3(x - 0.55 - 0.85 * (k / 2), side * (is_large ? 0.45 : 0.35), deck);
  };
  const double last = hull.lines().stern_at_deck + 0.12 * length;
  for (int k = 0; k < seats; ++k) {
    if (seat(k).x() < last) continue;
    add_box(builder, upright(seat(k) - Vec3(0, 0, 0.05)), {0.6, 0.34, 0.75});
    add_box(builder, upright(seat(k) + Vec3(-0.24, 0, 0.65)), {0.1, 0.32, 0.45});
  }
  // Crew: torso and head.
  builder.begin_part("crew");
  builder.begin_material("human_body");
  const int crew = std::min(seats, (is_large ? 3 : 1) + static_cast<int>(random.below(3)));
  for (int k = 0; k < crew; ++k) {
    if (seat(k).x() < last) continue;
    const Vec3 body = seat(k) + Vec3(0.05, 0, 0);
    add_cone(builder, body + Vec3(0, 0, 0.68), body + Vec3(0, 0, 1.3), 0.17, 0.2, 10);
    add_sphere(builder, body + Vec3(0, 0, 1.45), 0.13, 1);
  }
  builder.begin_material("pec");
  // Frame over the stern with radar, light and aerials.
  builder.begin_part("frame");
  const double stern = hull.lines().stern_at_deck + 0.08 * length, half = 0.8 * hull.deck_half_breadth(stern),
               height = between(random, 1.5, 1.9) * std::sqrt(scale);
  for (double side : {1.0, -1.0}) {
    add_cone(builder, {stern, side * half, deck - 0.05}, {stern - 0.25, side * 0.75 * half, deck + height}, 0.03, 0.03,
             8);
    add_cone(builder, {stern + 0.5, side * half, deck - 0.05}, {stern - 0.2, side * 0.76 * half, deck + 0.95 * height},
             0.025, 0.025, 8);
  }
  add_cone(builder, {stern - 0.25, -0.78 * half, deck + height}, {stern - 0.25, 0.78 * half, deck + height}, 0.03, 0.03,
           8);
  if (length > 6)
    add_cone(builder, {stern - 0.25, 0, deck + height - 0.02}, {stern - 0.25, 0, deck + height + 0.22}, 0.26, 0.24, 16);
  add_whip(builder, {stern - 0.25, 0.6 * half, deck + height}, 2.0);
  builder.begin_part("engines");
  const int engines = length < 6 ? 1 : 2;
  for (int k = 0; k < engines; ++k) {
    const double y = engines == 1 ? 0 : (k == 0 ? 0.33 : -0.33), end = hull.lines().stern_at_deck;
    add_frustum(builder, shifted(octagon(end - 0.42, end + 0.12, 0.2, 0.06, 0.06, deck - 0.1), {0, y, 0}),
                shifted(octagon(end - 0.5, end + 0.1, 0.22, 0.1, 0.1, deck + 0.62), {0, y, 0}));
  }
}

}  // namespace seaglint
