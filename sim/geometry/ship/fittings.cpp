// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/ship/fittings.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/geometry/surface/facets.h"

namespace seaglint {

namespace {

double lean(double slope_deg, double height) { return height * std::tan(radians(slope_deg)); }

}  // namespace

std::vector<Vec3> octagon(double aft, double fore, double half_width, double aft_chamfer, double fore_chamfer,
                          double z) {
  const double a = aft, f = fore, w = half_width, ca = aft_chamfer, cf = fore_chamfer;
  return {{a, -w + ca, z}, {a + ca, -w, z}, {f - cf, -w, z}, {f, -w + cf, z},
          {f, w - cf, z},  {f - cf, w, z},  {a + ca, w, z},  {a, w - ca, z}};
}

double between(Random& random, double low, double high) { return low + (high - low) * random.uniform(); }

Pose moved(const Pose& pose, double x, double y, double z) { return pose * Pose{{x, y, z}, Mat3::Identity()}; }

std::vector<Vec3> shifted(std::vector<Vec3> polygon, const Vec3& by) {
  for (Vec3& p : polygon) p += by;
  return polygon;
}

double Deckhouse::half_width_at(double z) const { return half_width - lean(side_slope, z - foot); }

double Deckhouse::fore_at(double z) const { return fore - lean(fore_slope, z - foot); }

double Deckhouse::aft_at(double z) const { return aft + lean(aft_slope, z - foot); }

Pose Deckhouse::on_side(double side, double design_x, double z) const {
  const double s = radians(side_slope);
  Pose pose;
  pose.p = {design_x, side * half_width_at(z), z};
  pose.R.col(0) = Vec3(0, side * std::cos(s), std::sin(s));
  pose.R.col(2) = Vec3(0, -side * std::sin(s), std::cos(s));
  pose.R.col(1) = pose.R.col(2).cross(pose.R.col(0));
  return pose;
}

std::vector<Vec3> Deckhouse::ring(double z) const {
  const double half = half_width_at(z), most = 0.9 * half;
  return octagon(aft_at(z), fore_at(z), half, std::min(aft_chamfer, most), std::min(fore_chamfer, most), z);
}

void add_house(MeshBuilder& builder, const Deckhouse& house) {
  builder.begin_part(house.name);
  add_frustum(builder, house.ring(house.foot), house.ring(house.roof));
}

// A row of panes 3 cm in front of the bridge's front and front corners, each at least half a metre wide.
void add_windows(MeshBuilder& builder, const Deckhouse& bridge) {
  const double storey = std::min(1.0, (bridge.roof - bridge.foot) / 2.5);
  const auto bottom = bridge.ring(bridge.roof - 1.7 * storey), top = bridge.ring(bridge.roof - 0.7 * storey);
  constexpr std::array<int, 5> kMostPanes{5, 3, 6, 3, 5};  // side, corner, front, corner, side
  for (std::size_t w = 0; w < kMostPanes.size(); ++w) {
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
    const int panes = std::clamp(static_cast<int>((b - a).norm() / 0.5), 1, kMostPanes[w]);
    for (int k = 0; k < panes; ++k) {
      const double from = (k + 0.08) / panes, to = (k + 0.92) / panes;
      const auto at = [&](double s, const Vec3& left, const Vec3& right) -> Vec3 {
        return left + s * (right - left) + 0.03 * out;
      };
      add_plate(builder, {at(from, a, b), at(to, a, b), at(to, d, c), at(from, d, c)}, 0.08);
    }
  }
}

void add_glass_windows(MeshBuilder& builder, const Deckhouse& bridge) {
  builder.begin_part("windows");
  builder.begin_material("window_glass");
  add_windows(builder, bridge);
  builder.begin_material("pec");
}

// Open-fronted cabinets (fire hoses, breathing sets, telephones) of slightly different sizes at irregular spacing.
void add_cabinets(MeshBuilder& builder, const Deckhouse& house, double from, double to, double spacing, double height) {
  int n = 0;
  for (double side : {1.0, -1.0}) {
    double x = from + (side > 0 ? 0.0 : 0.4 * spacing);
    while (x < to) {
      const double size = 0.45 + 0.08 * (n % 4);
      const Pose wall = house.on_side(side, x, height + 0.25 * (n % 2));
      add_open_box(builder, moved(wall, 0.5 * size - 0.06, 0, 0), {size, size + 0.1, size + 0.15}, 0.025);
      x += spacing * (n++ % 3 == 1 ? 1.25 : 0.9);
    }
  }
}

void add_doors(MeshBuilder& builder, const Deckhouse& house, double height, const std::vector<double>& places) {
  for (double side : {1.0, -1.0}) {
    for (double x : places) {
      const Pose wall = house.on_side(side, x, height);
      add_box(builder, moved(wall, 0.01, 0, 0.25), {0.14, 0.8, 1.75});
      add_box(builder, moved(wall, 0.05, 0, 2.08), {0.3, 1.0, 0.05});
      for (double up : {0.5, 1.1, 1.7}) add_box(builder, moved(wall, 0.09, 0.32, up), {0.12, 0.1, 0.08});
    }
  }
}

void add_liferafts(MeshBuilder& builder, const Deckhouse& house, double z, const std::vector<double>& places,
                   int per_rack) {
  // A single one on a narrow roof is a canister for six, not for twenty-five.
  const double size = per_rack == 1 && house.half_width_at(z) < 2 ? 0.6 : 1;
  for (double side : {1.0, -1.0}) {
    for (double x : places) {
      for (int k = 0; k < per_rack; ++k) {
        const Vec3 middle(x + 1.7 * (k - 0.5 * (per_rack - 1)), side * (house.half_width_at(z) - 0.55 * size),
                          z + 0.72 * size);
        const Vec3 half(0.68 * size, 0, 0);
        add_cone(builder, middle - half, middle + half, 0.34 * size, 0.34 * size, 12);
        for (double at : {-0.45, 0.45})
          add_box(builder, upright(middle + Vec3(at, 0, -0.85) * size), Vec3(0.1, 0.72, 0.6) * size);
      }
    }
  }
}

// Brackets with lamps, loudspeakers and signal boxes: an upright plate, a shelf and a cheek at right angles.
void add_brackets(MeshBuilder& builder, const Deckhouse& house, double z, const std::vector<double>& places) {
  int n = 0;
  for (double side : {1.0, -1.0}) {
    for (double x : places) {
      const Pose wall = house.on_side(side, x, z);
      // The shelf looks up for one and down for the next, the cheek is fore or aft.
      const double angle = n % 4 == 0 ? 0 : n % 4 == 1 ? 0.5 * kPi : n % 4 == 2 ? kPi : 1.5 * kPi;
      const Pose bracket = moved(wall, 0.02, 0, 0) * Pose{Vec3::Zero(), axis_rotation(angle, Vec3::UnitX())};
      const double leg = 0.32 + 0.05 * (n % 3);
      add_corner_plates(builder, bracket, {leg, leg, leg}, 0.03);
      ++n;
    }
  }
}

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

// Box with a lid that overhangs, on low feet.
void add_locker(MeshBuilder& builder, const Pose& pose, const Vec3& size) {
  add_box(builder, pose * upright({0, 0, -0.1}), size + Vec3(0, 0, 0.1));
  add_box(builder, pose * upright({0, 0, size.z() - 0.02}), {size.x() + 0.08, size.y() + 0.08, 0.06});
}

// Ventilator: a trunk with a hood that opens to one side.
void add_ventilator(MeshBuilder& builder, const Pose& pose, double height, double size) {
  add_box(builder, pose * upright({0, 0, -0.1}), {0.6 * size, 0.6 * size, height + 0.12});
  add_open_box(builder, pose * upright({0.15 * size, 0, height}), Vec3(0.95, 0.75, 0.65) * size, 0.03);
}

// Two upright plates at right angles on a bed plate: screens, splinter shields, ready-use stowages.
void add_shield(MeshBuilder& builder, const Pose& pose, double leg, double height) {
  add_corner_plates(builder, pose * upright({-0.4 * leg, -0.4 * leg, 0.04}), {leg, leg, height}, 0.06);
}

namespace {

constexpr double kRailHeight = 1.1, kPostSpacing = 2.1;

}  // namespace

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
  const double size = std::min(1.0, half_span / 1.3);  // of what stands on it
  for (double side : {1.0, -1.0}) {
    const Vec3 end(0, side * tip.y(), tip.z());
    add_bar(builder, centre, centre + end, width);
    add_bar(builder, centre - Vec3(0, 0, 0.9 * size), centre + 0.6 * end, 0.6 * width);
    for (double s : {0.55, 0.8, 0.97}) {
      const Vec3 foot = centre + s * end;
      add_cone(builder, foot - Vec3(0, 0, 0.1 * size), foot + Vec3(0, 0, size), 0.05 * size, 0.05 * size, 8);
      add_box(builder, upright(foot + Vec3(0, 0, -0.32 * size)), Vec3(0.22, 0.22, 0.26) * size);
    }
  }
}

void add_plated_frustum(MeshBuilder& builder, const std::vector<Vec3>& lower, const std::vector<Vec3>& upper,
                        const Plating& plating, Random& random) {
  const std::size_t sides = lower.size();
  Vec3 foot_middle = Vec3::Zero(), top_middle = Vec3::Zero();
  double height = 0;
  std::vector<int> parts;  // plates along each side
  for (std::size_t i = 0; i < sides; ++i) {
    foot_middle += lower[i] / static_cast<double>(sides);
    top_middle += upper[i] / static_cast<double>(sides);
    height = std::max(height, (upper[i] - lower[i]).norm());
    const double length = (lower[(i + 1) % sides] - lower[i]).norm();
    parts.push_back(std::max(1, static_cast<int>(std::lround(length / plating.plate))));
  }
  const int levels = std::max(1, static_cast<int>(std::lround(height / plating.plate)));
  // Rings of vertices from foot to top; the corners and both rims stay fair.
  std::vector<std::vector<std::uint32_t>> rings;
  for (int k = 0; k <= levels; ++k) {
    const double up = static_cast<double>(k) / levels;
    std::vector<std::uint32_t> ring;
    for (std::size_t i = 0; i < sides; ++i) {
      const Vec3 a = lower[i] + up * (upper[i] - lower[i]);
      const std::size_t j = (i + 1) % sides;
      const Vec3 b = lower[j] + up * (upper[j] - lower[j]);
      const Vec3 outward = (lower[j] - lower[i]).cross(upper[i] - lower[i]).normalized();
      for (int n = 0; n < parts[i]; ++n) {
        const double dent = n > 0 && k > 0 && k < levels ? plating.dent * (2 * random.uniform() - 1) : 0;
        ring.push_back(builder.vertex(a + (b - a) * n / parts[i] + dent * outward));
      }
    }
    rings.push_back(std::move(ring));
  }
  const std::size_t around = rings[0].size();
  for (int k = 0; k < levels; ++k) {
    for (std::size_t n = 0; n < around; ++n) {
      const std::size_t next = (n + 1) % around;
      builder.quad(rings[k][n], rings[k][next], rings[k + 1][next], rings[k + 1][n]);
    }
  }
  const std::uint32_t bottom = builder.vertex(foot_middle), top = builder.vertex(top_middle);
  for (std::size_t n = 0; n < around; ++n) {
    const std::size_t next = (n + 1) % around;
    builder.triangle(bottom, rings[0][next], rings[0][n]);
    builder.triangle(top, rings[levels][n], rings[levels][next]);
  }
}

void add_plated_house(MeshBuilder& builder, const Deckhouse& house, const Plating& plating, Random& random) {
  builder.begin_part(house.name);
  add_plated_frustum(builder, house.ring(house.foot), house.ring(house.roof), plating, random);
}

void add_radar_scanner(MeshBuilder& builder, const Vec3& foot, double length, double yaw) {
  const double size = std::min(1.0, length / 1.6);
  add_cone(builder, foot - Vec3(0, 0, 0.1), foot + Vec3(0, 0, 0.45 * size), 0.22 * size, 0.18 * size, 10);
  add_box(builder, upright(foot + Vec3(0, 0, 0.42 * size), yaw), {0.2 * size, length, 0.22 * size});
}

void add_pole_mast(MeshBuilder& builder, const Vec3& foot, double height, int scanners, Random& random) {
  const double size = std::min(1.0, height / 5), radius = 0.1 * size + 0.02 * height;
  add_cone(builder, foot - Vec3(0, 0, 0.3), foot + Vec3(0, 0, height), radius, 0.4 * radius, 12);
  add_yard(builder, foot + Vec3(0, 0, 0.78 * height), std::min(3.2, 0.32 * height), 0.6 * radius);
  for (int k = 0; k < scanners; ++k) {
    // Each on a platform ahead of the mast.
    const Vec3 at = foot + Vec3(radius + 0.5 * size, 0, (0.35 + 0.22 * k) * height);
    add_bar(builder, foot + Vec3(0, 0, at.z() - foot.z() - 0.06), at - Vec3(0, 0, 0.06), 0.16 * size);
    add_box(builder, upright(at - Vec3(0, 0, 0.08)), {0.9 * size, 1.1 * size, 0.06});
    add_radar_scanner(builder, at, (k == 0 ? 2.4 : 1.8) * size, 2 * kPi * random.uniform());
  }
  // Lights on brackets, all round.
  for (double up : {0.55, 0.66, 0.9, 0.97}) {
    const double yaw = 2 * kPi * random.uniform();
    const Vec3 out = radius * 1.6 * Vec3(std::cos(yaw), std::sin(yaw), 0), at = foot + Vec3(0, 0, up * height) + out;
    add_box(builder, upright(at - out, yaw), {2.6 * radius, 0.2 * size, 0.03});
    add_cone(builder, at, at + Vec3(0, 0, 0.25 * size), 0.09 * size, 0.09 * size, 8);
  }
}

void add_dome(MeshBuilder& builder, const Vec3& foot, double radius) {
  const double stand = std::min(0.9, 3 * radius);
  add_cone(builder, foot - Vec3(0, 0, 0.2), foot + Vec3(0, 0, stand), 0.5 * radius, 0.4 * radius, 12);
  add_sphere(builder, foot + Vec3(0, 0, stand - 0.1 + radius), radius, 2);
}

void add_whip(MeshBuilder& builder, const Vec3& foot, double height) {
  add_cone(builder, foot - Vec3(0, 0, 0.1), foot + Vec3(0, 0, 0.5), 0.08, 0.06, 8);
  add_cone(builder, foot + Vec3(0, 0, 0.45), foot + Vec3(0, 0, height), 0.04, 0.02, 6);
}

void add_crane(MeshBuilder& builder, const Crane& crane) {
  const Vec3 head = crane.foot + Vec3(0, 0, crane.pedestal);
  const double r = crane.radius;
  add_cone(builder, crane.foot - Vec3(0, 0, 0.3), head, r, r, 16);
  const Pose slew = upright(head, crane.heading);
  add_cone(builder, slew * Vec3(0, 0, -0.1), slew * Vec3(0, 0, 0.5 * r), 1.35 * r, 1.35 * r, 16);
  add_box(builder, slew * upright({-0.3 * r, 0, 0.4 * r}), {2.4 * r, 1.9 * r, 2.4 * r});
  if (r > 0.6) add_box(builder, slew * upright({1.1 * r, 1.3 * r, 0.5}), {1.2, 1.1, 1.6});
  // Gantry with sheaves behind, jib of two chords with struts ahead.
  add_bar(builder, slew * Vec3(-0.6 * r, 0.7 * r, 2.7 * r), slew * Vec3(-0.9 * r, 0.25 * r, 4.6 * r), 0.25 * r);
  add_bar(builder, slew * Vec3(-0.6 * r, -0.7 * r, 2.7 * r), slew * Vec3(-0.9 * r, -0.25 * r, 4.6 * r), 0.25 * r);
  const Vec3 along(std::cos(crane.elevation), 0, std::sin(crane.elevation));
  const auto chord = [&](double side, double s) {
    return slew * (Vec3(1.05 * r, 0, 0.9 * r) + s * crane.jib * along + Vec3(0, side * (0.75 - 0.5 * s) * r, 0));
  };
  for (double side : {1.0, -1.0}) add_bar(builder, chord(side, 0), chord(side, 1), 0.32 * r);
  const int struts = std::max(3, static_cast<int>(crane.jib / 3));
  for (int k = 1; k <= struts; ++k) {
    const double from = (k - 0.7) / struts, to = static_cast<double>(k) / struts;
    add_bar(builder, chord(1, to), chord(-1, to), 0.16 * r);
    add_bar(builder, chord(k % 2 == 0 ? 1 : -1, from), chord(k % 2 == 0 ? -1 : 1, to), 0.12 * r);
  }
  // Hoist and luffing ropes, and the hook.
  const Vec3 tip = 0.5 * (chord(1, 0.98) + chord(-1, 0.98));
  add_bar(builder, slew * Vec3(-0.9 * r, 0, 4.5 * r), tip, 0.06);
  add_bar(builder, tip, tip - Vec3(0, 0, 2.0), 0.06);
  const double hook = std::min(0.8, 0.9 * r);
  add_box(builder, upright(tip - Vec3(0, 0, 1.95 + hook), crane.heading), {0.6 * hook, 0.4 * hook, hook});
}

void add_hatch(MeshBuilder& builder, const Vec3& centre, const Vec3& size, int panels, Random& random) {
  const double length = size.x(), width = size.y(), height = size.z();
  add_box(builder, upright(centre - Vec3(0, 0, 0.2)), {length, width, height + 0.2});
  // Panels fold in pairs; each overhangs the coaming.
  for (int k = 0; k < panels; ++k) {
    const double x = (k + 0.5) / panels - 0.5;
    const double thickness = 0.55 + 0.05 * random.uniform();
    add_box(builder, upright(centre + Vec3(x * length, 0, height - 0.02)),
            {length / panels - 0.12, width + 0.5, thickness});
  }
  // Stays of the coaming, upright triangular plates.
  const int stays = std::max(2, static_cast<int>(length / 3));
  for (double side : {1.0, -1.0}) {
    for (int k = 0; k < stays; ++k) {
      const Vec3 at = centre + Vec3(((k + 0.5) / stays - 0.5) * length, side * (0.5 * width - 0.02), -0.05);
      const Vec3 foot = at + Vec3(0, side * 0.6, 0), head = at + Vec3(0, side * 0.1, 0.9 * height);
      side > 0 ? add_plate(builder, {at, foot, head}, 0.03) : add_plate(builder, {foot, at, head}, 0.03);
    }
  }
}

void add_rescue_boat(MeshBuilder& builder, const Pose& base) {
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
}

void add_lifeboat(MeshBuilder& builder, const Pose& base, double length) {
  const auto ring = [&](double ends, double half, double up) {
    return std::vector<Vec3>{base * Vec3(-ends, -0.45 * half, up), base * Vec3(-0.6 * ends, -half, up),
                             base * Vec3(0.6 * ends, -half, up),   base * Vec3(ends, -0.4 * half, up),
                             base * Vec3(ends, 0.4 * half, up),    base * Vec3(0.6 * ends, half, up),
                             base * Vec3(-0.6 * ends, half, up),   base * Vec3(-ends, 0.45 * half, up)};
  };
  const double l = 0.5 * length, b = 0.19 * length;
  add_frustum(builder, ring(0.8 * l, 0.45 * b, 0), ring(l, b, 0.19 * length));
  add_frustum(builder, ring(0.97 * l, 0.95 * b, 0.185 * length), ring(0.7 * l, 0.55 * b, 0.36 * length));
  add_box(builder, base * upright({-0.35 * length, 0, 0.33 * length}), {0.14 * length, 0.14 * length, 0.1 * length});
  add_cone(builder, base * Vec3(-0.46 * length, 0, -0.02), base * Vec3(-0.46 * length, 0, 0.1 * length), 0.12, 0.12, 8);
}

void add_davit(MeshBuilder& builder, const Vec3& foot, const Vec3& outboard, double spread, double height) {
  for (double at : {-0.5 * spread, 0.5 * spread}) {
    const Vec3 low = foot + Vec3(at, 0, -0.1), head = low + Vec3(0, 0, height);
    add_bar(builder, low, head, 0.3);
    add_bar(builder, head - 0.1 * outboard - Vec3(0, 0, 0.15), head + 2.5 * outboard + Vec3(0, 0, 0.35), 0.26);
    add_bar(builder, head + 1.9 * outboard + Vec3(0, 0, 0.25), head + 1.9 * outboard - Vec3(0, 0, 1.0), 0.08);
  }
}

void add_deck_rail(MeshBuilder& builder, const HullSurface& hull, double side, double from, double to, double width) {
  const int bays = std::max(1, static_cast<int>(std::lround((to - from) / 4.2)));
  std::vector<Vec3> line;
  for (int k = 0; k <= bays; ++k) {
    const double x = from + (to - from) * k / bays;
    const double y = std::max(0.1, hull.deck_half_breadth(x) - 0.14);
    line.push_back({x, side * y, hull.deck_height(x, y)});
  }
  add_rail(builder, line, width);
}

void add_side_rails(MeshBuilder& builder, const HullSurface& hull, double width, double from, double to) {
  if (!(width > 0)) return;
  builder.begin_part("rails");
  for (double side : {1.0, -1.0}) add_deck_rail(builder, hull, side, from, to, width);
}

void add_mooring_gear(MeshBuilder& builder, const HullSurface& hull, const std::vector<double>& places, double height) {
  // On the deck, or on the flat roof of a block of this height.
  const auto at = [&](double x, double y) {
    return Vec3(x, y, height > 0 ? hull.deck_edge_height(x) + height : hull.deck_height(x, y));
  };
  for (double x : places) {
    const double y = std::max(1.6, hull.deck_half_breadth(x)) - 1.35;
    const double along = std::atan2(hull.deck_half_breadth(x + 1) - hull.deck_half_breadth(x - 1), 2.0);
    for (double side : {1.0, -1.0}) {
      add_bitts(builder, upright(at(x, side * y), side * along));
      add_fairlead(builder, upright(at(x - 2.2, side * (hull.deck_half_breadth(x - 2.2) - 0.7)), side * along));
    }
  }
}

void add_windlasses(MeshBuilder& builder, const Vec3& middle, double spacing, double size) {
  for (double side : {1.0, -1.0}) {
    const Pose base = upright(middle + Vec3(0, 0.5 * side * spacing, 0));
    add_box(builder, base * upright({0, 0, -0.1}), Vec3(1.6, 1.1, 0.25) * size);
    add_cone(builder, base * Vec3(0, -0.9 * size, 0.7 * size), base * Vec3(0, 0.9 * size, 0.7 * size), 0.42 * size,
             0.42 * size, 14);
    for (double y : {-0.62, 0.0, 0.62})
      add_cone(builder, base * Vec3(0, (y - 0.04) * size, 0.7 * size), base * Vec3(0, (y + 0.04) * size, 0.7 * size),
               0.62 * size, 0.62 * size, 14);
    add_box(builder, base * upright(Vec3(-0.9, 0.2, 0) * size), Vec3(0.7, 0.9, 0.9) * size);
  }
}

void add_deck_block(MeshBuilder& builder, const HullSurface& hull, const DeckBlock& block, const Plating& plating,
                    Random& random) {
  builder.begin_part(block.name);
  const int bays = std::clamp(static_cast<int>(std::lround((block.to - block.from) / (2 * plating.plate))), 2, 40);
  const double stem = hull.lines().stem_at_deck - 0.15;
  std::vector<Vec3> lower, upper;
  const auto add = [&](int k, double side) {
    const double x = std::min(stem, block.from + (block.to - block.from) * k / bays);
    const double z = hull.deck_edge_height(x), y = std::max(0.12, hull.deck_half_breadth(x) - block.inset);
    lower.push_back({x, side * y, z - 0.08});
    upper.push_back({x, side * std::max(0.08, y - block.lean), z + block.height});
  };
  for (int k = 0; k <= bays; ++k) add(k, -1);
  for (int k = bays; k >= 0; --k) add(k, 1);
  add_plated_frustum(builder, lower, upper, plating, random);
}

namespace {

// Panes in a row on one wall of a house between two of its ring's vertices.
void add_panes(MeshBuilder& builder, const Deckhouse& house, std::size_t wall, double sill, double height, int panes) {
  const auto bottom = house.ring(sill), top = house.ring(sill + height);
  const std::size_t next = (wall + 1) % bottom.size();
  const Vec3 &a = bottom[wall], &b = bottom[next], &c = top[next], &d = top[wall];
  const Vec3 out = 0.03 * (b - a).cross(d - a).normalized();
  for (int k = 0; k < panes; ++k) {
    const double from = (k + 0.25) / panes, to = (k + 0.75) / panes;
    const auto at = [&](double s, const Vec3& left, const Vec3& right) -> Vec3 {
      return left + s * (right - left) + out;
    };
    add_plate(builder, {at(from, a, b), at(to, a, b), at(to, d, c), at(from, d, c)}, 0.08);
  }
}

// Floor, parapet and brackets of an open bridge wing to one side.
void add_bridge_wing(MeshBuilder& builder, const Vec3& root, double side, double width) {
  const Pose base = upright(root + Vec3(0, 0.5 * side * width, 0));
  add_box(builder, base, {3.0, width, 0.16});
  add_box(builder, base * upright({1.46, 0, 0.02}), {0.06, width - 0.02, 1.15});
  add_box(builder, base * upright({-1.46, 0, 0.02}), {0.06, width - 0.02, 1.15});
  add_box(builder, base * upright({0, side * (0.5 * width - 0.04), 0.03}), {2.94, 0.06, 1.13});
  add_cone(builder, base * Vec3(0.5, side * 0.3 * width, 0.1), base * Vec3(0.5, side * 0.3 * width, 1.35), 0.16, 0.12,
           8);
  for (double at : {-1.1, 0.9}) {
    const Vec3 head = base * Vec3(at, side * (0.5 * width - 0.2), 0.05),
               high = base * Vec3(at, -side * 0.5 * width, 0.05);
    const Vec3 low = high - Vec3(0, 0, std::min(1.6, 0.5 * width));
    side > 0 ? add_plate(builder, {low, head, high}, 0.04) : add_plate(builder, {high, head, low}, 0.04);
  }
}

}  // namespace

Deckhouse add_accommodation(MeshBuilder& builder, const Accommodation& block, Random& random) {
  double z = block.foot - 0.3, fore = block.fore, aft = block.aft, half = block.half_width;
  const auto house_of = [&](const std::string& name, double height) {
    const double chamfer = std::min(0.4, 0.15 * half);
    return Deckhouse{.name = name,
                     .aft = aft,
                     .fore = fore,
                     .half_width = half,
                     .foot = z,
                     .roof = z + height,
                     .side_slope = block.side_slope,
                     .fore_slope = block.fore_slope,
                     .aft_slope = 0.5,
                     .fore_chamfer = chamfer,
                     .aft_chamfer = 0.8 * chamfer};
  };
  const auto rails_of = [&](const Deckhouse& house) {
    if (!(block.rail_width > 0)) return;
    const double y = house.half_width_at(house.roof) - 0.12, roof = house.roof;
    const double x = house.aft_at(roof) + 0.2, end = house.fore_at(roof) - 0.6;
    for (double side : {1.0, -1.0}) add_rail(builder, {{x, side * y, roof}, {end, side * y, roof}}, block.rail_width);
    add_rail(builder, {{x, -y + 0.3, roof}, {x, y - 0.3, roof}}, block.rail_width);
  };
  for (int k = 0; k < block.tiers; ++k) {
    const Deckhouse house = house_of("accommodation", block.tier + (k == 0 ? 0.3 : 0));
    add_plated_house(builder, house, block.plating, random);
    const double sill = house.roof - 1.55;
    builder.begin_part("windows");
    builder.begin_material("window_glass");
    add_panes(builder, house, 3, sill, 0.7, std::max(2, static_cast<int>(2 * half / 2.6)));
    for (std::size_t wall : {1u, 5u})
      add_panes(builder, house, wall, sill, 0.7, std::max(2, static_cast<int>((fore - aft) / 3)));
    builder.begin_material("pec");
    builder.begin_part("doors");
    add_doors(builder, house, house.foot + (k == 0 ? 0.3 : 0.02), {aft + 0.25 * (fore - aft)});
    const double cabinets = aft + 0.45 * (fore - aft), spacing = between(random, 3.5, 4.5);
    if (fore - 1.5 > cabinets + 0.4 * spacing) {
      builder.begin_part("cabinets");
      add_cabinets(builder, house, cabinets, fore - 1.5, spacing, house.foot + 1.2);
    }
    builder.begin_part("stairs");
    for (double side : {1.0, -1.0}) {
      const double y = side * (0.55 * half + 0.1 * random.uniform());
      add_ladder(builder, {aft - 1.7, y, house.foot + 0.3}, {aft + 0.1, y, house.roof - 0.05}, Vec3::UnitY(), 0.08);
    }
    builder.begin_part("rails");
    // The deck above overhangs the walls aft.
    add_box(builder, upright({aft - 0.6, 0, house.roof - 0.1}), {1.8, 1.86 * half, 0.12});
    rails_of(house);
    z = house.roof - 0.05;
    fore -= block.step;
    half -= 0.01;
  }
  aft += 0.25 * (fore - aft);
  half *= 0.86;
  const Deckhouse wheelhouse{.name = "wheelhouse",
                             .aft = aft,
                             .fore = fore - 0.3,
                             .half_width = half,
                             .foot = z,
                             .roof = z + block.tier + 0.2,
                             .side_slope = 1,
                             .fore_slope = -6,
                             .aft_slope = 1,
                             .fore_chamfer = std::min(1.2, 0.3 * half),
                             .aft_chamfer = 0.3};
  add_plated_house(builder, wheelhouse, block.plating, random);
  add_glass_windows(builder, wheelhouse);
  builder.begin_part("doors");
  add_doors(builder, wheelhouse, wheelhouse.foot + 0.05, {aft + 1.0});
  if (block.wing > half) {
    builder.begin_part("bridge_wings");
    for (double side : {1.0, -1.0})
      add_bridge_wing(builder, {fore - 2.2, side * (half - 0.3), wheelhouse.foot + 0.1}, side, block.wing - half + 0.3);
  }
  builder.begin_part("rails");
  rails_of(wheelhouse);
  return wheelhouse;
}

}  // namespace seaglint
