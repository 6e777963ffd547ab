// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/ship/make_ship.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/shapes/generators.h"

namespace seaglint {

namespace {

// Design offsets in metres on the 144 m ship; the waterline is 1.4 m shorter aft and 8 m forward than the deck.
constexpr double kSternAtWater = -70.6, kSternAtDeck = -72.0, kStemAtWater = 64.0, kStemAtDeck = 72.0;
constexpr double kDeckToWaterBeam = 1.085;  // flare of about 7 deg amidships
constexpr double kKnuckle = 0.68;           // of the side's height

double smooth_step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// Fraction of the change from waterline breadth to deck breadth at height v: nearly linear amidships, hollow with a
// knuckle in the forebody.
double section(double u, double v) {
  const double forward = smooth_step(0.5, 0.92, u);
  const double power = 1.12 + 0.75 * forward;
  const double at_knuckle = std::pow(kKnuckle, 1.12) + 0.20 * forward;
  if (v <= kKnuckle) return at_knuckle * std::pow(v / kKnuckle, power);
  return at_knuckle + (1.0 - at_knuckle) * (v - kKnuckle) / (1.0 - kKnuckle);
}

// Transverse vertices of deck, lid and transom, as fractions of the half-breadth from starboard to port.
constexpr std::array<double, 5> kAcross{-1.0, -0.5, 0.0, 0.5, 1.0};

}  // namespace

double HullSurface::waterline_half_breadth(double u) const {
  const double middle = 0.48;
  const double shape = u > middle ? 1.0 - std::pow((u - middle) / (1.0 - middle), 2.0)
                                  : 1.0 - 0.20 * std::pow((middle - u) / middle, 2.2);
  return 0.5 * form_.beam_m * std::max(0.0, shape);
}

double HullSurface::deck_half_breadth_at(double u) const {
  const double middle = 0.52;
  const double shape = u > middle ? 1.0 - std::pow((u - middle) / (1.0 - middle), 2.9)
                                  : 1.0 - 0.16 * std::pow((middle - u) / middle, 2.4);
  return 0.5 * form_.beam_m * kDeckToWaterBeam * std::max(0.0, shape);
}

double HullSurface::deck_height(double x) const {
  const double s = 2.0 * x / form_.length_m;
  const double rise =
      s > 0 ? (form_.bow_height_m - form_.freeboard_m) * s * s : (form_.stern_height_m - form_.freeboard_m) * s * s;
  return form_.freeboard_m + rise;
}

double HullSurface::deck_half_breadth(double x) const {
  return deck_half_breadth_at((x - x_of(kSternAtDeck)) / x_of(kStemAtDeck - kSternAtDeck));
}

Vec3 HullSurface::side(double u, double v) const {
  const double stern = x_of(kSternAtWater + (kSternAtDeck - kSternAtWater) * v);
  // The stem is raked and slightly hollow.
  const double stem = x_of(kStemAtWater + (kStemAtDeck - kStemAtWater) * std::pow(v, 1.25));
  const double b0 = waterline_half_breadth(u), b1 = deck_half_breadth_at(u);
  const double deck_x = x_of(kSternAtDeck + (kStemAtDeck - kSternAtDeck) * u);
  return {stern + (stem - stern) * u, b0 + (b1 - b0) * section(u, v), v * deck_height(deck_x)};
}

void add_hull(MeshBuilder& builder, const HullSurface& hull) {
  const ShipForm& form = hull.form();
  const int stations = std::max(24, static_cast<int>(std::lround(form.length_m / form.panel_m)));
  const int levels = std::max(3, static_cast<int>(std::lround(form.bow_height_m / form.panel_m)));

  // Plates are closer together towards the stem, where the sections change.
  const auto u_of = [&](int i) {
    const double t = static_cast<double>(i) / stations;
    return t + 0.06 * t * (1.0 - t);
  };
  builder.begin_part("hull");

  // Welded plating is dented by millimetres between the frames; the dents differ from side to side. Waterline, deck
  // edge and ends stay fair.
  const auto dent_at = [&](int i, int k, int side) {
    const auto bits = philox4x32(
        {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(side), 0}, {144, 0});
    return form.plating_m * (bits[0] / 2147483648.0 - 1.0);
  };
  std::vector<std::vector<std::array<std::uint32_t, 2>>> sides;  // [level][station]{starboard, port}
  for (int k = 0; k <= levels; ++k) {
    std::vector<std::array<std::uint32_t, 2>> row;
    for (int i = 0; i <= stations; ++i) {
      const Vec3 port = hull.side(u_of(i), static_cast<double>(k) / levels);
      const bool is_free = k > 0 && k < levels && i > 0 && i < stations;
      std::array<std::uint32_t, 2> pair{};
      for (int s = 0; s < 2; ++s) {
        const double sign = s == 0 ? -1.0 : 1.0;
        if (s == 1 && i == stations) {
          pair[1] = pair[0];
        } else {
          pair[s] = builder.vertex(
              {port.x(), i == stations ? 0.0 : sign * (port.y() + (is_free ? dent_at(i, k, s) : 0.0)), port.z()});
        }
      }
      row.push_back(pair);
    }
    sides.push_back(std::move(row));
  }
  // A quad that may have two equal vertices at the stem.
  const auto patch = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    if (a != b && b != c && c != a) builder.triangle(a, b, c);
    if (a != c && c != d && d != a) builder.triangle(a, c, d);
  };
  for (int k = 0; k < levels; ++k) {
    for (int i = 0; i < stations; ++i) {
      const auto &low = sides[k], &high = sides[k + 1];
      patch(low[i][0], low[i + 1][0], high[i + 1][0], high[i][0]);
      patch(low[i + 1][1], low[i][1], high[i][1], high[i + 1][1]);
    }
  }

  // Points across the ship between the two sides of a station at a level; the ends are the sides' own vertices.
  const auto across = [&](int k, int i) {
    std::array<std::uint32_t, kAcross.size()> line{};
    const auto [starboard, port] = sides[k][i];
    line.fill(starboard);
    line.back() = port;
    if (starboard == port) return line;
    const Vec3 rim = builder.vertices()[port];
    for (std::size_t j = 1; j + 1 < kAcross.size(); ++j)
      line[j] = builder.vertex({rim.x(), kAcross[j] * rim.y(), rim.z()});
    return line;
  };
  std::vector<std::array<std::uint32_t, kAcross.size()>> deck, lid, transom;
  for (int i = 0; i <= stations; ++i) {
    deck.push_back(across(levels, i));
    lid.push_back(across(0, i));
  }
  for (int k = 0; k <= levels; ++k) transom.push_back(k == 0 ? lid[0] : k == levels ? deck[0] : across(k, 0));
  for (std::size_t j = 0; j + 1 < kAcross.size(); ++j) {
    for (int i = 0; i < stations; ++i) {
      patch(deck[i][j], deck[i + 1][j], deck[i + 1][j + 1], deck[i][j + 1]);
      patch(lid[i][j + 1], lid[i + 1][j + 1], lid[i + 1][j], lid[i][j]);
    }
    for (int k = 0; k < levels; ++k) patch(transom[k][j + 1], transom[k][j], transom[k + 1][j], transom[k + 1][j + 1]);
  }
}

void add_bulwark(MeshBuilder& builder, const HullSurface& hull) {
  constexpr double kHeight = 1.1, kThickness = 0.08, kSunk = 0.06, kFrom = 46.0, kTo = 71.2;
  constexpr int kBays = 17;
  for (double side : {1.0, -1.0}) {
    builder.begin_part(side > 0 ? "bulwark_port" : "bulwark_starboard");
    std::vector<std::array<std::uint32_t, 4>> sections;
    for (int i = 0; i <= kBays; ++i) {
      const double x = hull.x_of(kFrom + (kTo - kFrom) * i / kBays);
      const double z = hull.deck_height(x), y = std::max(hull.deck_half_breadth(x) - 0.05, 0.02 + kThickness);
      // The bulwark continues the flare and ends in a slope.
      const double height = i == 0 ? 0.25 : kHeight, lean = 0.12 * height;
      const auto at = [&](double offset, double up) { return builder.vertex({x, side * (y + offset), z + up}); };
      sections.push_back({at(0, -kSunk), at(lean, height), at(lean - kThickness, height), at(-kThickness, -kSunk)});
    }
    const auto face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
      side > 0 ? builder.quad(d, c, b, a) : builder.quad(a, b, c, d);
    };
    for (int i = 0; i < kBays; ++i) {
      for (int k = 0; k < 4; ++k)
        face(sections[i][k], sections[i + 1][k], sections[i + 1][(k + 1) % 4], sections[i][(k + 1) % 4]);
    }
    const auto &first = sections.front(), &last = sections.back();
    face(first[0], first[1], first[2], first[3]);
    face(last[3], last[2], last[1], last[0]);

    // Stays: upright triangular plates across, every bay.
    for (int i = 1; i < kBays - 2; ++i) {
      const double x = hull.x_of(kFrom + (kTo - kFrom) * (i + 0.5) / kBays);
      const double z = hull.deck_height(x), y = hull.deck_half_breadth(x) - 0.05;
      const Vec3 foot(x, side * (y - 0.75), z - 0.03), root(x, side * (y - 0.04), z - 0.03),
          head(x, side * (y + 0.05), z + 0.95);
      side > 0 ? add_plate(builder, {foot, root, head}, 0.02) : add_plate(builder, {root, foot, head}, 0.02);
    }
  }
}

namespace {

double lean(double slope_deg, double height) { return height * std::tan(radians(slope_deg)); }

// The outline of a house at a height.
std::vector<Vec3> ring(const Deckhouse& house, const HullSurface& hull, double z) {
  return octagon(house.aft_at(hull, z), house.fore_at(hull, z), house.half_width_at(hull, z), house.aft_chamfer,
                 house.fore_chamfer, z);
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

std::vector<Vec3> octagon(double aft, double fore, double half_width, double aft_chamfer, double fore_chamfer,
                          double z) {
  const double a = aft, f = fore, w = half_width, ca = aft_chamfer, cf = fore_chamfer;
  return {{a, -w + ca, z}, {a + ca, -w, z}, {f - cf, -w, z}, {f, -w + cf, z},
          {f, w - cf, z},  {f - cf, w, z},  {a + ca, w, z},  {a, w - ca, z}};
}

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
