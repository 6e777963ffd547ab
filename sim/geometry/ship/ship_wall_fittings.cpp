// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/ship/ship_wall_fittings.h"

#include <initializer_list>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/shapes/solids.h"

namespace seaglint {
namespace {

Pose moved(const Pose& wall, double out, double along, double up) {
  return wall * Pose{{out, along, up}, Mat3::Identity()};
}

// Open-fronted cabinets (fire hoses, breathing sets, telephones) of slightly different sizes at irregular spacing.
void add_cabinets(MeshBuilder& builder, const HullSurface& hull, const Deckhouse& house, double from, double to,
                  double spacing, double height) {
  int n = 0;
  for (double side : {1.0, -1.0}) {
    double x = from + (side > 0 ? 0.0 : 0.4 * spacing);
    while (x < to) {
      const double size = 0.45 + 0.08 * (n % 4);
      const Pose wall = house.on_side(hull, side, x, height + 0.25 * (n % 2));
      add_open_box(builder, moved(wall, 0.5 * size - 0.06, 0, 0), {size, size + 0.1, size + 0.15}, 0.025);
      x += spacing * (n++ % 3 == 1 ? 1.25 : 0.9);
    }
  }
}

void add_doors(MeshBuilder& builder, const HullSurface& hull, const Deckhouse& house, double height,
               std::initializer_list<double> places) {
  for (double side : {1.0, -1.0}) {
    for (double x : places) {
      const Pose wall = house.on_side(hull, side, x, height);
      add_box(builder, moved(wall, 0.01, 0, 0.25), {0.14, 0.8, 1.75});
      add_box(builder, moved(wall, 0.05, 0, 2.08), {0.3, 1.0, 0.05});
      for (double up : {0.5, 1.1, 1.7}) add_box(builder, moved(wall, 0.09, 0.32, up), {0.12, 0.1, 0.08});
    }
  }
}

// Canisters in cradles, three to a rack.
void add_liferafts(MeshBuilder& builder, const HullSurface& hull, const Deckhouse& house, double z,
                   std::initializer_list<double> places) {
  for (double side : {1.0, -1.0}) {
    for (double x : places) {
      for (int k = 0; k < 3; ++k) {
        const Vec3 middle(hull.x_of(x) + 1.7 * (k - 1), side * (house.half_width_at(hull, z) - 0.55), z + 0.72);
        add_cone(builder, middle - Vec3(0.68, 0, 0), middle + Vec3(0.68, 0, 0), 0.34, 0.34, 12);
        for (double at : {-0.45, 0.45}) add_box(builder, upright(middle + Vec3(at, 0, -0.85)), {0.1, 0.72, 0.6});
      }
    }
  }
}

// Brackets with lamps, loudspeakers and signal boxes: an upright plate, a shelf and a cheek at right angles.
void add_brackets(MeshBuilder& builder, const HullSurface& hull, const Deckhouse& house, double z,
                  std::initializer_list<double> places) {
  int n = 0;
  for (double side : {1.0, -1.0}) {
    for (double x : places) {
      const Pose wall = house.on_side(hull, side, x, z);
      // The shelf looks up for one and down for the next, the cheek is fore or aft.
      const double angle = n % 4 == 0 ? 0 : n % 4 == 1 ? 0.5 * kPi : n % 4 == 2 ? kPi : 1.5 * kPi;
      const Pose bracket = moved(wall, 0.02, 0, 0) * Pose{Vec3::Zero(), axis_rotation(angle, Vec3::UnitX())};
      const double leg = 0.32 + 0.05 * (n % 3);
      add_corner_plates(builder, bracket, {leg, leg, leg}, 0.03);
      ++n;
    }
  }
}

// Bay openings in the forward house's flanks for torpedo tubes: deep open boxes that project slightly.
void add_bays(MeshBuilder& builder, const HullSurface& hull, const Deckhouse& house) {
  for (double side : {1.0, -1.0}) {
    const Pose wall = house.on_side(hull, side, -5.0, hull.form().freeboard_m + 0.9);
    add_open_box(builder, moved(wall, 0.1, 0, 0), {0.7, 4.2, 2.2}, 0.06);
    for (int k = 0; k < 3; ++k) {
      const Vec3 breech = wall * Vec3(0.2, -1.6, 0.5 + 0.45 * k);
      add_cone(builder, breech, breech + wall.R * Vec3(0, 3.2, 0), 0.19, 0.19, 10);
    }
  }
}

// Anchors in their pockets on the bow.
void add_anchors(MeshBuilder& builder, const HullSurface& hull) {
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

}  // namespace

void add_wall_fittings(MeshBuilder& builder, const HullSurface& hull, const ShipHouses& houses) {
  const double deck = hull.form().freeboard_m;
  builder.begin_part("cabinets");
  add_cabinets(builder, hull, houses.forward, 1.5, 25, 4.1, deck + 1.1);
  add_cabinets(builder, hull, houses.forward, 0.5, 25, 4.6, deck + 3.9);
  add_cabinets(builder, hull, houses.aft, -43.5, -20, 4.0, deck + 1.1);
  add_cabinets(builder, hull, houses.aft, -44.5, -20, 4.4, deck + 4.1);
  add_cabinets(builder, hull, houses.flag_deck, 2.5, 12, 3.2, houses.forward.roof + 0.7);
  add_cabinets(builder, hull, houses.radar_house, -35.5, -30.5, 2.4, houses.aft.roof + 0.9);
  add_cabinets(builder, hull, houses.core, -17.5, -9.5, 2.7, deck + 1.3);
  builder.begin_part("doors");
  add_doors(builder, hull, houses.forward, deck + 0.3, {24.6, 9.9, -0.9});
  add_doors(builder, hull, houses.aft, deck + 0.2, {-22.2, -33.4, -44.6});
  add_doors(builder, hull, houses.bridge, houses.forward.roof, {15.2});
  add_doors(builder, hull, houses.flag_deck, houses.forward.roof, {6.9});
  builder.begin_part("liferafts");
  add_liferafts(builder, hull, houses.forward, houses.forward.roof, {2.0, 24.0});
  add_liferafts(builder, hull, houses.aft, houses.aft.roof, {-26.6, -42.6});
  builder.begin_part("brackets");
  add_brackets(builder, hull, houses.forward, deck + 5.0, {-7.0, 3.6, 13.3, 20.2, 25.8});
  add_brackets(builder, hull, houses.aft, deck + 5.3, {-45.2, -39.7, -31.6, -25.7, -20.4});
  add_brackets(builder, hull, houses.bridge, houses.bridge.roof - 1.3, {14.6, 16.4, 18.0});
  builder.begin_part("torpedo_bays");
  add_bays(builder, hull, houses.forward);
  builder.begin_part("anchors");
  add_anchors(builder, hull);
}

}  // namespace seaglint
