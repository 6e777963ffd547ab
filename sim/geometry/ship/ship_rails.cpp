// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/ship/ship_rails.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/geometry/shapes/solids.h"

namespace seaglint {
namespace {

constexpr double kRailHeight = 1.1, kPostSpacing = 2.1;

// Posts and three bars along a line of points on a deck.
void add_rail(MeshBuilder& builder, const std::vector<Vec3>& line, double width) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec3 &from = line[i], &to = line[i + 1];
    const int bays = std::max(1, static_cast<int>(std::lround((to - from).norm() / kPostSpacing)));
    for (int k = 0; k < bays + (i + 2 == line.size() ? 1 : 0); ++k) {
      const Vec3 foot = from + (to - from) * k / bays;
      add_bar(builder, foot - Vec3(0, 0, 0.05), foot + Vec3(0, 0, kRailHeight), width);
    }
    // The bars are thinner than the posts and end within them, so that two bars in line do not touch.
    const Vec3 inset = 0.005 * (to - from).normalized();
    for (double up : {0.38, 0.74, 1.07})
      add_bar(builder, from + inset + Vec3(0, 0, up), to - inset + Vec3(0, 0, up), 0.8 * width);
  }
}

void add_deck_rails(MeshBuilder& builder, const HullSurface& hull, double width) {
  // Along the flight deck there are nets instead.
  for (double side : {1.0, -1.0}) {
    builder.begin_part(side > 0 ? "rails_port" : "rails_starboard");
    std::vector<Vec3> line;
    double x = -45.5;
    while (x < 46.6) {
      const double at = hull.x_of(x);
      line.push_back({at, side * (hull.deck_half_breadth(at) - 0.14), hull.deck_height(at)});
      x += 4.2;
    }
    add_rail(builder, line, width);
  }
}

void add_roof_rails(MeshBuilder& builder, const HullSurface& hull, const ShipHouses& houses, double width) {
  builder.begin_part("roof_rails");
  const auto along = [&](const Deckhouse& house, double from, double to) {
    for (double side : {1.0, -1.0}) {
      const double y = side * (house.half_width_at(hull, house.roof) - 0.12);
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
  athwart(houses.aft, houses.aft.aft_at(hull, houses.aft.roof) + 0.2, 6.4);
  athwart(houses.forward, houses.forward.aft_at(hull, houses.forward.roof) + 0.2, 7.2);
  athwart(houses.bridge, houses.bridge.fore_at(hull, houses.bridge.roof) - 0.2, 3.4);
  athwart(houses.radar_house, houses.radar_house.aft_at(hull, houses.radar_house.roof) + 0.2, 2.0);
}

// Upright or leaning ladder between two points, its rungs along `across`.
void add_ladder(MeshBuilder& builder, const Vec3& foot, const Vec3& head, const Vec3& across, double width) {
  const Vec3 half = 0.22 * across;
  add_bar(builder, foot - half, head - half, width);
  add_bar(builder, foot + half, head + half, width);
  const int rungs = static_cast<int>((head - foot).norm() / 0.34);
  for (int k = 1; k < rungs; ++k) {
    const Vec3 at = foot + (head - foot) * k / rungs;
    add_bar(builder, at - half, at + half, 0.6 * width);
  }
}

void add_ladders(MeshBuilder& builder, const HullSurface& hull, const ShipHouses& houses, double width) {
  builder.begin_part("ladders");
  const auto on_side = [&](const Deckhouse& house, double x, double from) {
    for (double side : {1.0, -1.0}) {
      const Pose low = house.on_side(hull, side, x, from), high = house.on_side(hull, side, x, house.roof);
      add_ladder(builder, low * Vec3(0.2, 0, 0), high * Vec3(0.2, 0, 0.4), Vec3::UnitX(), width);
    }
  };
  const double deck = hull.form().freeboard_m;
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
void add_nets(MeshBuilder& builder, const HullSurface& hull, double width) {
  builder.begin_part("flight_deck_nets");
  for (double side : {1.0, -1.0}) {
    double x = -70.6;
    while (x < -47.5) {
      const auto at = [&](double design_x, double out, double down) {
        const double place = hull.x_of(design_x);
        return Vec3(place, side * (hull.deck_half_breadth(place) + out), hull.deck_height(place) - down);
      };
      add_bar(builder, at(x, -0.1, 0.12), at(x, 1.25, -0.06), width);
      add_bar(builder, at(x + 2.3, -0.1, 0.12), at(x + 2.3, 1.25, -0.06), width);
      for (double out : {0.35, 0.78, 1.2})
        add_bar(builder, at(x, out, 0.06 - 0.1 * out), at(x + 2.3, out, 0.06 - 0.1 * out), 0.7 * width);
      x += 2.4;
    }
  }
}

}  // namespace

void add_rails(MeshBuilder& builder, const HullSurface& hull, const ShipHouses& houses) {
  const double width = hull.form().rail_width_m;
  add_deck_rails(builder, hull, width);
  add_roof_rails(builder, hull, houses, width);
  add_ladders(builder, hull, houses, width);
  add_nets(builder, hull, width);
}

}  // namespace seaglint
