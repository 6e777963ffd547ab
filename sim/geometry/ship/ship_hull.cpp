// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/ship/ship_hull.h"

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/random.h"
#include "sim/geometry/shapes/solids.h"

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

}  // namespace seaglint
