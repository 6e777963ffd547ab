// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/ship/ship_superstructure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sim/core/numbers/constants.h"

namespace seaglint {
namespace {

double lean(double slope_deg, double height) { return height * std::tan(radians(slope_deg)); }

// The eight vertices of a house at a height, counter-clockwise from the starboard quarter.
std::vector<Vec3> ring(const Deckhouse& house, const HullSurface& hull, double z) {
  const double a = house.aft_at(hull, z), f = house.fore_at(hull, z), w = house.half_width_at(hull, z);
  const double ca = house.aft_chamfer, cf = house.fore_chamfer;
  return {{a, -w + ca, z}, {a + ca, -w, z}, {f - cf, -w, z}, {f, -w + cf, z},
          {f, w - cf, z},  {f - cf, w, z},  {a + ca, w, z},  {a, w - ca, z}};
}

void add_house(MeshBuilder& builder, const Deckhouse& house, const HullSurface& hull) {
  builder.begin_part(house.name);
  add_frustum(builder, ring(house, hull, house.foot), ring(house, hull, house.roof));
}

// A row of panes 3 cm in front of the bridge's front and front corners.
void add_windows(MeshBuilder& builder, const Deckhouse& bridge, const HullSurface& hull) {
  builder.begin_part("bridge_windows");
  const double low = bridge.roof - 1.7, high = bridge.roof - 0.7;
  const auto bottom = ring(bridge, hull, low), top = ring(bridge, hull, high);
  constexpr std::array<int, 5> kPanes{5, 3, 6, 3, 5};  // side, corner, front, corner, side
  for (std::size_t w = 0; w < kPanes.size(); ++w) {
    const std::size_t i = 1 + w;
    Vec3 a = bottom[i], b = bottom[i + 1], c = top[i + 1], d = top[i];
    // The side walls are glazed in their forward third only.
    if (w == 0) {
      a += 0.62 * (b - a), d += 0.62 * (c - d);
    }
    if (w == 4) {
      b = a + 0.38 * (b - a), c = d + 0.38 * (c - d);
    }
    const Vec3 out = (b - a).cross(d - a).normalized();
    for (int k = 0; k < kPanes[w]; ++k) {
      const double from = (k + 0.08) / kPanes[w], to = (k + 0.92) / kPanes[w];
      const auto at = [&](double s, const Vec3& left, const Vec3& right) -> Vec3 {
        return left + s * (right - left) + 0.03 * out;
      };
      add_plate(builder, {at(from, a, b), at(to, a, b), at(to, d, c), at(from, d, c)}, 0.08);
    }
  }
}

// Open platforms to both sides of the bridge with a solid bulwark: floor and walls are perpendicular.
void add_bridge_wings(MeshBuilder& builder, const Deckhouse& bridge, const HullSurface& hull) {
  builder.begin_part("bridge_wings");
  const double x = hull.x_of(21.4), z = bridge.foot + 0.35, root = bridge.half_width_at(hull, z) - 0.5;
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

void add_funnel(MeshBuilder& builder, const HullSurface& hull, const Deckhouse& aft) {
  Deckhouse funnel{"funnel", -27.0, -18.6, 3.3, aft.roof - 0.25, aft.roof + 6.6, 9, 14, 5, 1.4, 0.9};
  add_house(builder, funnel, hull);
  // Uptakes, and intake boxes with louvres on either side.
  for (double x : {-25.2, -23.4, -21.9}) {
    const Vec3 foot(hull.x_of(x), 0, funnel.roof - 0.3);
    add_cone(builder, foot, foot + Vec3(-0.5, 0, 1.9), 0.62, 0.58, 14);
  }
  builder.begin_part("intakes");
  for (double side : {1.0, -1.0}) {
    for (double z : {aft.roof + 0.8, aft.roof + 2.6}) {
      const Pose wall = funnel.on_side(hull, side, -22.8, z);
      add_open_box(builder, wall * Pose{{0.18, 0, 0}, Mat3::Identity()}, {0.5, 3.2, 1.3}, 0.06);
      for (int k = 1; k < 5; ++k)
        add_box(builder, wall * Pose{{0.18, 0, 0.26 * k}, Mat3::Identity()}, {0.36, 3.18, 0.03});
    }
  }
}

void add_hangar(MeshBuilder& builder, const HullSurface& hull, const Deckhouse& aft) {
  builder.begin_part("hangar_door");
  const double low = hull.deck_height(hull.x_of(aft.aft)) + 0.15, high = low + 4.6;
  const auto at = [&](double y, double z) { return Vec3(aft.aft_at(hull, z) - 0.06, y, z); };
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
  const double x = aft.aft_at(hull, aft.roof), low_z = aft.roof - 1.7, high_z = aft.roof - 0.3;
  add_frustum(builder, {{x - 1.0, 3.6, low_z}, {x + 0.6, 3.6, low_z}, {x + 0.6, 5.6, low_z}, {x - 1.0, 5.6, low_z}},
              {{x - 0.8, 3.8, high_z}, {x + 0.6, 3.8, high_z}, {x + 0.6, 5.4, high_z}, {x - 0.8, 5.4, high_z}});
}

}  // namespace

double Deckhouse::half_width_at(const HullSurface& hull, double z) const {
  return hull.y_of(half_width) - lean(side_slope, z - foot);
}
double Deckhouse::fore_at(const HullSurface& hull, double z) const {
  return hull.x_of(fore) - lean(fore_slope, z - foot);
}
double Deckhouse::aft_at(const HullSurface& hull, double z) const { return hull.x_of(aft) + lean(aft_slope, z - foot); }

Pose Deckhouse::on_side(const HullSurface& hull, double side, double design_x, double z) const {
  const double s = radians(side_slope);
  Pose pose;
  pose.p = {hull.x_of(design_x), side * half_width_at(hull, z), z};
  pose.R.col(0) = Vec3(0, side * std::cos(s), std::sin(s));
  pose.R.col(2) = Vec3(0, -side * std::sin(s), std::cos(s));
  pose.R.col(1) = pose.R.col(2).cross(pose.R.col(0));
  return pose;
}

ShipHouses ship_houses(const HullSurface& hull) {
  const double deck = hull.form().freeboard_m, foot = std::min(deck, hull.deck_height(hull.x_of(-47))) - 0.35;
  ShipHouses h;
  h.forward = {"deckhouse_1", -9.0, 30.0, 8.75, foot, deck + 5.6, 8, 14, 6, 3.6, 0.6};
  h.bridge = {"bridge", 13.5, 27.6, 6.9, h.forward.roof - 0.3, h.forward.roof + 3.3, 10, 17, 5, 2.6, 0.8};
  h.flag_deck = {"flag_deck", 0.5, 14.5, 5.6, h.forward.roof - 0.3, h.forward.roof + 2.4, 7, 9, 9, 0.8, 1.2};
  h.core = {"deckhouse_2", -19.0, -8.0, 4.4, foot, deck + 4.9, 6, 7, 7, 0.3, 0.3};
  h.aft = {"hangar", -46.5, -17.8, 8.45, foot, deck + 6.0, 7.5, 6, 5, 0.6, 1.0};
  h.radar_house = {"radar_house", -37.0, -29.5, 3.4, h.aft.roof - 0.3, h.aft.roof + 2.9, 9, 11, 9, 0.8, 0.8};
  return h;
}

void add_superstructure(MeshBuilder& builder, const HullSurface& hull, const ShipHouses& houses) {
  for (const Deckhouse* house :
       {&houses.forward, &houses.bridge, &houses.flag_deck, &houses.core, &houses.aft, &houses.radar_house}) {
    add_house(builder, *house, hull);
  }
  add_windows(builder, houses.bridge, hull);
  add_bridge_wings(builder, houses.bridge, hull);
  add_funnel(builder, hull, houses.aft);
  add_hangar(builder, hull, houses.aft);
}

}  // namespace seaglint
