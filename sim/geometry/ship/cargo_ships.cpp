// SPDX-License-Identifier: BSD-3-Clause
// What stands on the decks of container ships, tankers, bulk carriers and ferries.
#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/geometry/ship/fittings.h"
#include "sim/geometry/ship/ship_design.h"

namespace seaglint {

namespace {

// Accommodation aft on ships of cargo: from x = aft to x = fore per length.
struct AftHouse {
  double aft, fore;
  double half_width;  // per half-breadth of the deck
  int tiers;
};

// Of the casing behind the house, with its gap.
double casing_length_m(double ship_length) { return std::min(0.055 * ship_length, 13.0); }

// Accommodation block with funnel, masts, domes, whips, liferafts and free-fall boat. Returns the wheelhouse.
Deckhouse add_aft_house(MeshBuilder& builder, const HullSurface& hull, const ShipDesign& ship, const AftHouse& place,
                        Random& random) {
  const double length = ship.length, fore = place.fore * length, aft = place.aft * length;
  const double middle = 0.5 * (aft + fore), breadth = hull.deck_half_breadth(middle);
  const double half = place.half_width * std::min(breadth, hull.deck_half_breadth(aft) - 0.3);
  const double deck = hull.deck_height(middle, half);
  const Accommodation block{.aft = aft,
                            .fore = fore,
                            .half_width = half,
                            .foot = deck,
                            .tiers = place.tiers,
                            .step = 0.1 + 0.3 * random.uniform(),
                            .wing = 0.97 * breadth,
                            .fore_slope = between(random, 0.2, 1.5),
                            .side_slope = between(random, 0.2, 1.0),
                            .plating = {2.4, 0.003},
                            .rail_width = ship.rail_width};
  const Deckhouse bridge = add_accommodation(builder, block, random);
  // Casing behind the house, half as high, and the funnel on it: inclined walls, rounded in plan.
  const double behind = std::max(aft - casing_length_m(length), hull.lines().stern_at_deck + 0.02 * length);
  const double width = std::max(1.2, 0.22 * breadth), roof = deck + 2.8 * place.tiers;
  const Deckhouse casing{.name = "casing",
                         .aft = behind,
                         .fore = aft - 0.8,
                         .half_width = width,
                         .foot = deck - 0.2,
                         .roof = deck + 2.8 * ((place.tiers + 1) / 2),
                         .side_slope = 0.5,
                         .fore_slope = 0.5,
                         .aft_slope = 0.5,
                         .fore_chamfer = 0.2,
                         .aft_chamfer = 0.2};
  const double long_side = casing.fore - casing.aft, inclination = between(random, 4, 8);
  const Deckhouse funnel{.name = "funnel",
                         .aft = behind + 0.1 * long_side,
                         .fore = behind + 0.75 * long_side,
                         .half_width = 0.8 * width,
                         .foot = casing.roof - 0.2,
                         .roof = roof + between(random, 1.0, 3.5),
                         .side_slope = inclination,
                         .fore_slope = 1.5 * inclination,
                         .aft_slope = 0.5 * inclination,
                         .fore_chamfer = 0.4 * width,
                         .aft_chamfer = 0.3 * width};
  add_plated_house(builder, casing, block.plating, random);
  add_plated_house(builder, funnel, block.plating, random);
  builder.begin_part("funnel");
  const double top_middle = 0.5 * (funnel.aft_at(funnel.roof) + funnel.fore_at(funnel.roof));
  const int pipes = 2 + static_cast<int>(random.below(3));
  for (int k = 0; k < pipes; ++k) {
    const Vec3 foot(top_middle + 0.5 * (k % 2) - 0.25, 0.5 * (k - 0.5 * (pipes - 1)), funnel.roof - 0.2);
    add_cone(builder, foot, foot + Vec3(-0.3, 0, between(random, 1.0, 2.0)), 0.28, 0.26, 12);
  }
  builder.begin_part("antennas");
  add_pole_mast(builder, {bridge.aft + 0.4 * (bridge.fore - bridge.aft), 0, bridge.roof}, between(random, 7, 11), 2,
                random);
  add_dome(builder, {bridge.aft + 1.5, 0.5 * bridge.half_width, bridge.roof}, between(random, 0.6, 1.0));
  add_dome(builder, {bridge.aft + 1.2, -0.6 * bridge.half_width, bridge.roof}, between(random, 0.4, 0.7));
  for (double side : {1.0, -1.0})
    add_whip(builder, {bridge.fore - 1.5, side * 0.7 * bridge.half_width, bridge.roof}, between(random, 5, 8));
  if (ship.spec.detail == ShipDetail::kHull) return bridge;
  builder.begin_part("boats");
  const double below_ramp = hull.deck_height(behind, 0.45 * breadth);
  const Vec3 ramp(behind - 1.0, 0.45 * breadth, below_ramp + 3.4);
  const Pose boat{ramp + Vec3(0.5, 0, 1.2), Mat3(rotation_from_angles(0, radians(30), kPi))};
  add_lifeboat(builder, boat, 6.5);
  for (double y : {-0.9, 0.9}) {
    add_bar(builder, ramp + Vec3(-3.0, y, -1.6), ramp + Vec3(3.6, y, 2.2), 0.3);
    add_bar(builder, {ramp.x() + 3.0, ramp.y() + y, below_ramp - 0.1}, ramp + Vec3(3.0, y, 1.8), 0.3);
  }
  // Rescue boats behind the house, inboard of the rails.
  const double stand = std::max(aft - 4.5, behind + 2);
  for (double side : {1.0, -1.0}) {
    const double inboard = std::max(0.35 * breadth, hull.deck_half_breadth(stand) - 3.4);
    const Vec3 davit(stand, side * inboard, hull.deck_height(stand, inboard));
    add_davit(builder, davit, {0, side, 0}, 3.2, 4.2);
    add_rescue_boat(builder, upright(davit + Vec3(0, side * 1.9, 1.8)));
  }
  return bridge;
}

// Forecastle block with windlasses, bulwark, foremast and mooring gear.
void add_forecastle(MeshBuilder& builder, const HullSurface& hull, const ShipDesign& ship, double from, double height,
                    Random& random) {
  const double stem = hull.lines().stem_at_deck;
  if (height > 0)
    add_deck_block(builder, hull, {.name = "forecastle", .from = from, .to = stem, .height = height}, {2.4, 0.003},
                   random);
  if (ship.spec.detail == ShipDetail::kHull) return;
  const double x = 0.5 * (from + stem), z = hull.deck_edge_height(x) + height;
  builder.begin_part("windlasses");
  const double size = std::clamp(ship.length / 180, 0.5, 1.6);
  add_windlasses(builder, {x, 0, z}, std::max(2.4 * size, 0.7 * hull.deck_half_breadth(x)), size);
  builder.begin_part("foremast");
  const Vec3 mast(from + 0.25 * (stem - from), 0, z - 0.2 * (x - from) / (stem - from));
  add_pole_mast(builder, mast, between(random, 7, 11), 0, random);
  builder.begin_part("mooring_gear");
  add_mooring_gear(builder, hull, {from + 0.3 * (stem - from), from + 0.6 * (stem - from)}, height);
  builder.begin_part("ventilators");
  for (double side : {1.0, -1.0})
    add_ventilator(
        builder,
        upright({from + 1.5, side * 0.5 * hull.deck_half_breadth(from), hull.deck_edge_height(from) + height},
                2 * kPi * random.uniform()),
        1.1);
}

}  // namespace

void add_container_ship(MeshBuilder& builder, const HullSurface& hull, const ShipDesign& ship, Random& random) {
  // 40-foot boxes of ISO 668: 12.19 m x 2.44 m x 2.59 m.
  constexpr double kBox = 12.19, kRow = 2.5, kTier = 2.59, kPitch = 14.6;
  const double length = ship.length, house_aft = -0.27 * length,
               house_fore = house_aft + std::clamp(0.055 * length, 9.0, 15.0);
  const int most_tiers = std::clamp(static_cast<int>(std::lround(length / 45)), 3, 8);
  add_aft_house(builder, hull, ship, {house_aft / length, house_fore / length, 0.92, most_tiers + 2}, random);
  const double from = 0.40 * length;
  add_forecastle(builder, hull, ship, from, 3.0, random);
  const double first = -0.475 * length, last = 0.39 * length;
  const double funnel = house_aft - casing_length_m(length) - 2;
  int bay = 0;
  for (double x = first; x + kBox < last; x += kPitch) {
    // The bays behind end at the casing, those ahead begin at the house.
    if (x + kBox > funnel && x < house_fore + 2.5) x = house_fore + 2.5;
    if (x + kBox > last) break;
    const double middle = x + 0.5 * kBox;
    const double breadth = std::min(hull.deck_half_breadth(x), hull.deck_half_breadth(x + kBox));
    const int rows = static_cast<int>(std::floor(2 * (breadth - 0.4) / kRow));
    if (rows < 2) continue;
    const double deck = hull.deck_height(middle, 0.5 * kRow * rows), hatch = deck + 1.7;
    ++bay;
    builder.begin_part("hatches");
    add_box(builder, upright({middle, 0, deck - 0.2}), {kBox + 0.6, kRow * rows - 0.8, 1.9});
    // Height of the stacks falls towards the bow, and each differs from its neighbour.
    const double ahead = std::clamp((x - house_fore) / (last - house_fore), 0.0, 1.0);
    const double mean = std::max(1.0, most_tiers * (1 - 0.35 * ahead) * (0.35 + 0.65 * ship.loading));
    builder.begin_part("containers");
    const int bay_tiers = std::max(1, static_cast<int>(std::lround(mean + random.uniform() - 0.7)));
    for (int row = 0; row < rows; ++row) {
      const int tiers = std::clamp(bay_tiers - (random.uniform() < 0.3 ? 1 : 0), 0, most_tiers);
      if (tiers == 0) continue;
      // Neighbours overlap by millimetres; doors and corner posts of each stand a few centimetres apart.
      const Vec3 place(middle + between(random, -0.05, 0.05), (row + 0.5 - 0.5 * rows) * kRow, hatch - 0.02);
      add_box(builder, upright(place),
              {kBox + between(random, -0.04, 0.02), kRow + 0.004 + 0.001 * (row % 2),
               kTier * tiers + between(random, -0.02, 0.02)});
    }
    if (ship.spec.detail == ShipDetail::kHull) continue;
    // Lashing bridge behind every second bay: posts, walkways and rails between the rows.
    if (bay % 2 == 0) continue;
    builder.begin_part("lashing_bridges");
    const double at = x - 1.2, half = 0.5 * kRow * rows;
    for (int row = 0; row <= rows; row += 2)
      add_bar(builder, {at, row * kRow - half, deck - 0.1}, {at, row * kRow - half, hatch + 2 * kTier}, 0.3);
    for (double up : {kTier, 2 * kTier})
      add_box(builder, upright({at, 0, hatch + up - 0.1}), {0.9, 2 * half + 0.5, 0.12});
  }
  add_side_rails(builder, hull, ship.rail_width, first, from);
  if (ship.spec.detail == ShipDetail::kHull) return;
  builder.begin_part("mooring_gear");
  add_mooring_gear(builder, hull, {-0.48 * length, -0.44 * length}, 0);
}

void add_tanker(MeshBuilder& builder, const HullSurface& hull, const ShipDesign& ship, Random& random) {
  const double length = ship.length, aft = -0.47 * length + 0.07 * length,
               fore = aft + std::clamp(0.07 * length, 9.0, 16.0);
  add_aft_house(builder, hull, ship,
                {aft / length, fore / length, 0.78, std::clamp(static_cast<int>(length / 45), 3, 6)}, random);
  const double from = 0.43 * length;
  add_forecastle(builder, hull, ship, from, 2.6, random);
  add_side_rails(builder, hull, ship.rail_width, -0.46 * length, from);
  if (ship.spec.detail == ShipDetail::kHull) return;
  const double deck = hull.deck_height(0, 0), breadth = hull.deck_half_breadth(0);
  const double first = fore + 4, last = from - 6;
  // Cargo lines along the deck on saddles, catwalk above.
  builder.begin_part("pipes");
  const int lines = 4 + static_cast<int>(random.below(3));
  for (int k = 0; k < lines; ++k) {
    const double y = 0.9 * (k - 0.5 * (lines - 1)) + 1.2, radius = between(random, 0.16, 0.32);
    add_cone(builder, {first, y, deck + 0.9}, {last - 3.0 * k, y, deck + 0.9}, radius, radius, 10);
  }
  for (double x = first + 2; x < last - 12; x += 11.5) {
    add_box(builder, upright({x, 1.2, deck - 0.1}), {0.25, 0.95 * lines, 0.75});
    for (double y : {-1.6, -3.0}) add_bar(builder, {x, y, deck - 0.1}, {x, y, deck + 2.4}, 0.16);
  }
  builder.begin_part("catwalk");
  add_box(builder, upright({0.5 * (first + last) - 4, -2.3, deck + 2.35}), {last - first - 12, 1.5, 0.1});
  if (ship.rail_width > 0) {
    for (double y : {-1.6, -3.0})
      add_rail(builder, {{first, y, deck + 2.45}, {0.5 * (first + last), y, deck + 2.45}, {last - 12, y, deck + 2.45}},
               ship.rail_width);
  }
  // Manifold amidships: lines athwartships with flanges over drip trays, and the hose crane.
  builder.begin_part("manifold");
  const int flanges = 4;
  for (int k = 0; k < flanges; ++k) {
    const double x = 2.4 * (k - 0.5 * (flanges - 1));
    add_cone(builder, {x, -(breadth - 3.2), deck + 1.6}, {x, breadth - 3.2, deck + 1.6}, 0.25, 0.25, 10);
    for (double side : {1.0, -1.0}) {
      add_cone(builder, {x, side * (breadth - 3.3), deck + 1.6}, {x, side * (breadth - 3.1), deck + 1.6}, 0.42, 0.42,
               12);
      const double y = breadth - 4.2;
      add_bar(builder, {x, side * y, hull.deck_height(x, y) - 0.1}, {x, side * y, deck + 1.5}, 0.2);
    }
  }
  for (double side : {1.0, -1.0}) {
    const Pose tray = upright({0, side * (breadth - 2.6), hull.deck_height(0, breadth - 2.6)});
    add_box(builder, tray * upright({0, 0, -0.2}), {2.4 * flanges + 2, 2.2, 0.3});
    for (double x : {-1.0, 1.0})
      add_box(builder, tray * upright({x * (1.2 * flanges + 0.95), 0, 0.05}), {0.05, 2.15, 0.5});
    for (double y : {-1.0, 1.0})
      add_box(builder, tray * upright({0, y * 1.05, 0.04}), {2.4 * flanges + 1.9, 0.05, 0.48});
  }
  builder.begin_part("cranes");
  const double pedestal = std::clamp(0.045 * length, 4.0, 11.0);
  for (double side : {1.0, -1.0})
    add_crane(builder, {.foot = {1.2 * flanges + 2.5, side * 0.45 * breadth, hull.deck_height(0, 0.45 * breadth)},
                        .pedestal = pedestal,
                        .radius = 0.8,
                        .jib = 0.9 * breadth,
                        .heading = side > 0 ? between(random, -0.2, 0.2) : kPi + between(random, -0.2, 0.2),
                        .elevation = between(random, 0.0, 0.15)});
  // Tank hatches, vents and monitors on both sides.
  builder.begin_part("tank_hatches");
  for (double x = first + 6; x < last - 8; x += std::max(14.0, 0.085 * length)) {
    for (double side : {1.0, -1.0}) {
      const double y = side * between(random, 0.35, 0.6) * breadth;
      const auto at = [&](double dx, double off, double up) {
        return Vec3(x + dx, off, hull.deck_height(x + dx, off) + up);
      };
      add_cone(builder, at(0, y, -0.1), at(0, y, 0.9), 0.65, 0.65, 14);
      add_cone(builder, at(0, y, 0.85), at(0, y, 1.0), 0.75, 0.72, 14);
      add_cone(builder, at(3, y, -0.1), at(3, y, 2.6), 0.13, 0.13, 8);
      add_box(builder, upright(at(3, y, 2.5)), {0.45, 0.45, 0.35});
      add_locker(builder, upright(at(-3, side * (breadth - 2.2), 0), side * between(random, -0.4, 0.4)),
                 {1.2, 0.7, 0.9});
      add_shield(builder, upright(at(6, side * (breadth - 1.8), 0), 2 * kPi * random.uniform()), 0.55, 0.9);
    }
  }
  builder.begin_part("mooring_gear");
  add_mooring_gear(builder, hull, {-0.46 * length, -0.30 * length, -0.1 * length, 0.12 * length, 0.3 * length}, 0);
}

void add_bulk_carrier(MeshBuilder& builder, const HullSurface& hull, const ShipDesign& ship, Random& random) {
  const double length = ship.length, aft = -0.40 * length, fore = aft + std::clamp(0.065 * length, 9.0, 14.0);
  add_aft_house(builder, hull, ship,
                {aft / length, fore / length, 0.82, std::clamp(static_cast<int>(length / 45), 3, 5)}, random);
  const double from = 0.43 * length;
  add_forecastle(builder, hull, ship, from, 2.6, random);
  add_side_rails(builder, hull, ship.rail_width, -0.46 * length, from);
  const int holds = std::clamp(static_cast<int>(std::lround(length / 30)), 3, 9);
  const double first = fore + 3, last = from - 2, pitch = (last - first) / holds, breadth = hull.deck_half_breadth(0);
  // Ships of up to about 200 m have cranes of their own.
  const bool is_geared = length < 205;
  for (int k = 0; k < holds; ++k) {
    const double middle = first + (k + 0.5) * pitch;
    const double width = 1.15 * std::min(breadth, hull.deck_half_breadth(middle + 0.4 * pitch));
    builder.begin_part("hatches");
    add_hatch(builder, {middle, 0, hull.deck_height(middle, 0.5 * width)},
              {0.66 * pitch, width, between(random, 1.3, 1.9)}, 4, random);
    if (ship.spec.detail == ShipDetail::kHull || k + 1 == holds) continue;
    const double gap = first + (k + 1) * pitch;
    if (is_geared) {
      builder.begin_part("cranes");
      // Stowed along the deck over the hatch ahead.
      add_crane(builder, {.foot = {gap, 0, hull.deck_height(gap, 0)},
                          .pedestal = between(random, 8.5, 10.5),
                          .radius = 1.25,
                          .jib = 0.86 * pitch,
                          .heading = between(random, -0.08, 0.08),
                          .elevation = between(random, -0.02, 0.05)});
    }
    builder.begin_part("ventilators");
    for (double side : {1.0, -1.0}) {
      const double deck = hull.deck_height(gap, 0.5 * width);
      add_ventilator(builder, upright({gap + 0.8, side * 0.5 * width, deck}, 2 * kPi * random.uniform()),
                     between(random, 1.2, 2.0));
      add_locker(builder, upright({gap - 0.6, side * 0.5 * width, deck}, between(random, -0.3, 0.3)), {1.3, 0.8, 1.0});
    }
  }
  if (ship.spec.detail == ShipDetail::kHull) return;
  builder.begin_part("deck_gear");
  for (double x = first; x < last; x += 0.06 * length) {
    for (double side : {1.0, -1.0}) {
      const double y = hull.deck_half_breadth(x) - 1.6;
      add_shield(builder,
                 upright({x + between(random, 0, 3), side * y, hull.deck_height(x, y)}, 2 * kPi * random.uniform()),
                 0.55, 0.9);
    }
  }
  builder.begin_part("mooring_gear");
  add_mooring_gear(builder, hull, {-0.46 * length, -0.28 * length, 0.0, 0.25 * length}, 0);
}

void add_ferry(MeshBuilder& builder, const HullSurface& hull, const ShipDesign& ship, Random& random) {
  const double length = ship.length, breadth = hull.deck_half_breadth(0);
  const Plating plating{2.4, 0.003};
  // Two blocks of decks over the full breadth, the upper one shorter; wheelhouse at its fore end.
  const int decks = length < 110 ? 1 : 2;
  const double lower_height = 2.9 * decks, from = -0.44 * length, to = 0.36 * length;
  add_deck_block(builder, hull,
                 {.name = "superstructure", .from = from, .to = to, .height = lower_height, .inset = 0.05, .lean = 0.1},
                 plating, random);
  const double roof = hull.deck_edge_height(0) + lower_height, half = breadth - between(random, 1.4, 2.4);
  const double fore = 0.33 * length;
  const Deckhouse upper{.name = "upper_decks",
                        .aft = -0.34 * length,
                        .fore = fore,
                        .half_width = half,
                        .foot = roof - 0.3,
                        .roof = roof + 2.9 * decks,
                        .side_slope = 0.4,
                        .fore_slope = between(random, 8, 20),
                        .aft_slope = 2,
                        .fore_chamfer = 0.12 * breadth + 1,
                        .aft_chamfer = 0.6};
  add_plated_house(builder, upper, plating, random);
  // Rows of windows: panes 3 cm proud of the side, of the lower block along its uppermost deck, where it is parallel.
  builder.begin_part("windows");
  builder.begin_material("window_glass");
  const double pane_height = 1.0;
  for (int deck = 0; deck < decks; ++deck) {
    const double sill = upper.foot + 1.4 + 2.9 * deck;
    for (double side : {1.0, -1.0}) {
      for (double x = upper.aft + 3; x < upper.fore - 6; x += 2.9)
        add_box(builder, upper.on_side(side, x, sill) * Pose{{-0.02, 0, 0}, Mat3::Identity()}, {0.1, 1.7, pane_height});
    }
  }
  const Deckhouse lower{.name = "superstructure",
                        .half_width = breadth - 0.05,
                        .foot = hull.deck_edge_height(0) - 0.08,
                        .side_slope = degrees(std::atan(0.1 / (lower_height + 0.08)))};
  for (double side : {1.0, -1.0}) {
    for (double x = -0.36 * length; x < 0.2 * length; x += 2.9)
      add_box(
          builder,
          lower.on_side(side, x, hull.deck_edge_height(x) + lower_height - 1.7) * Pose{{-0.02, 0, 0}, Mat3::Identity()},
          {0.1, 1.7, pane_height});
  }
  builder.begin_material("pec");
  const Accommodation bridge{.aft = fore - std::clamp(0.1 * length, 9.0, 16.0),
                             .fore = fore - 1.5 - 2.9 * decks * 0.3,
                             .half_width = 0.9 * half,
                             .foot = upper.roof,
                             .tiers = 1,
                             .step = 0.8,
                             .wing = 1.02 * breadth,
                             .fore_slope = 8,
                             .side_slope = 1,
                             .plating = plating,
                             .rail_width = ship.rail_width};
  const Deckhouse wheelhouse = add_accommodation(builder, bridge, random);
  builder.begin_part("antennas");
  add_pole_mast(builder, {wheelhouse.aft + 2, 0, wheelhouse.roof}, between(random, 8, 11), 2, random);
  for (double side : {1.0, -1.0})
    add_dome(builder, {wheelhouse.aft + 1, side * 0.5 * wheelhouse.half_width, wheelhouse.roof},
             between(random, 0.7, 1.2) * std::clamp(length / 130, 0.5, 1.0));
  // Funnels: one broad one amidships, or one at either side.
  const bool has_two = random.uniform() < 0.5;
  for (double side : {1.0, -1.0}) {
    if (!has_two && side < 0) continue;
    const double x = -0.2 * length, y = has_two ? side * 0.6 * half : 0;
    const double size = decks == 1 ? 0.65 : 1, w = (has_two ? 1.6 : 3.0) * size, top = upper.roof + 7.5 * size;
    builder.begin_part("funnel");
    add_plated_frustum(builder, shifted(octagon(x, x + 0.05 * length, w, 0.8, 0.8, upper.roof - 0.2), {0, y, 0}),
                       shifted(octagon(x - 1.2, x + 0.035 * length, 0.85 * w, 0.7, 0.7, top), {0, y, 0}), plating,
                       random);
    for (double dx : {0.8, 1.9, 3.0})
      add_cone(builder, {x + dx * size, y, top - 0.2}, {x + dx * size - 0.4, y, top + 1.1}, 0.4 * size, 0.38 * size,
               12);
  }
  if (ship.spec.detail == ShipDetail::kHull) return;
  // Lifeboats in davits along both sides of the upper block, above the lower block's roof.
  builder.begin_part("boats");
  const int boats = std::clamp(static_cast<int>(length / 45), 1, 5);
  for (double side : {1.0, -1.0}) {
    for (int k = 0; k < boats; ++k) {
      const double x = -0.2 * length + k * 0.09 * length;
      const Vec3 davit(x, side * (half + 0.35), roof);
      add_davit(builder, davit, {0, 0.6 * side, 0}, 5.5, 4.4);
      add_lifeboat(builder, upright(davit + Vec3(0, side * 1.15, 0.9)), 7.5);
    }
  }
  builder.begin_part("liferafts");
  Deckhouse raft_roof = upper;
  add_liferafts(builder, raft_roof, upper.roof, {-0.28 * length, 0.1 * length});
  builder.begin_part("deck_gear");
  for (int k = 0; k < 14; ++k) {
    const double x = between(random, -0.3, 0.18) * length, y = between(random, -0.8, 0.8) * half;
    if (k % 2 == 0)
      add_ventilator(builder, upright({x, y, upper.roof}, 2 * kPi * random.uniform()), between(random, 0.8, 1.8));
    else
      add_locker(builder, upright({x, y, upper.roof}, between(random, -0.5, 0.5)),
                 {between(random, 1.2, 3), between(random, 0.8, 2), between(random, 0.9, 2)});
  }
  // Stern ramp: two doors, folded up, with their frames.
  builder.begin_part("stern_ramp");
  const double stern = hull.lines().stern_at_deck, sill = hull.deck_edge_height(stern) - 0.3;
  for (double side : {1.0, -1.0}) {
    const double y = side * 0.45 * hull.deck_half_breadth(stern + 1);
    const auto at = [&](double dy, double up) { return Vec3(stern + 1.2 + 0.1 * up, y + dy, sill + up); };
    const double w = 0.36 * hull.deck_half_breadth(stern + 1);
    add_plate(builder, {at(w, 0), at(-w, 0), at(-w, 4.8), at(w, 4.8)}, 0.35);
    for (double dy : {-0.7 * w, 0.0, 0.7 * w})
      add_cone(builder, at(dy, 0.2) - Vec3(0.35, 0, 0), at(dy, 4.6) - Vec3(0.35, 0, 0), 0.14, 0.13, 10);
  }
  builder.begin_part("mooring_gear");
  add_mooring_gear(builder, hull, {0.40 * length, 0.44 * length}, 0);
  builder.begin_part("windlasses");
  const double bow = 0.42 * length, spacing = 0.5 * hull.deck_half_breadth(bow);
  add_windlasses(builder, {bow, 0, hull.deck_height(bow, 0.5 * spacing)}, spacing, 0.8);
  if (!(ship.rail_width > 0)) return;
  builder.begin_part("rails");
  for (double side : {1.0, -1.0}) {
    add_rail(builder, {{-0.42 * length, side * (breadth - 0.6), roof}, {-0.21 * length, side * (breadth - 0.5), roof}},
             ship.rail_width);
    add_rail(builder,
             {{upper.aft + 1, side * (half - 0.4), upper.roof}, {bridge.aft - 1, side * (half - 0.4), upper.roof}},
             ship.rail_width);
    add_deck_rail(builder, hull, side, to + 1, 0.47 * length, ship.rail_width);
  }
}

}  // namespace seaglint
