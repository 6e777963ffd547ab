// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/ship/hull.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/geometry/shapes/generators.h"

namespace seaglint {

namespace {

constexpr double kSectionPower = 1.12;   // of breadth over height, above the water
constexpr double kKnuckle = 0.68;        // of the side's height
constexpr double kEndCoefficient = 0.3;  // of the section at either end: a hollow V

double smooth_step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace

double PlanShape::at(double u) const {
  const double shape = u > fore  ? 1.0 - std::pow((u - fore) / (1.0 - fore), fore_power)
                       : u < aft ? 1.0 - aft_loss * std::pow((aft - u) / aft, aft_power)
                                 : 1.0;
  return std::max(0.0, shape);
}

HullSurface::HullSurface(const HullLines& lines) : lines_(lines) {
  if (!(lines.draught > 0)) return;
  // Volume = integral of 2 b t c over the waterline's length; it grows with the exponent of section_coefficient().
  const auto volume_at = [&](double power) {
    constexpr int kStations = 1000;
    end_power_ = power;
    double sum = 0;
    for (int i = 0; i < kStations; ++i) {
      const double u = (i + 0.5) / kStations;
      sum += lines.waterline.at(u) * keel_depth(u) * section_coefficient(u);
    }
    return lines.beam * sum / kStations;  // per length at the waterline
  };
  const double wanted = lines.block * lines.beam * lines.draught;
  double low = 0.3, high = 20;
  const double least = volume_at(low), most = volume_at(high);
  if (!(wanted >= least && wanted <= most)) {
    throw InputError(fmt::format("hull: block coefficient {:.4g}: must be within {:.4g} and {:.4g} for these lines",
                                 lines.block, lines.block * least / wanted, lines.block * most / wanted));
  }
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (volume_at(middle) < wanted ? low : high) = middle;
  }
}

double HullSurface::keel_depth(double u) const {
  const HullLines& h = lines_;
  if (u < h.keel_rise)
    return h.draught * (1 - (1 - h.transom_draught) * std::pow(1 - u / h.keel_rise, h.keel_rise_power));
  if (u > h.forefoot)
    return h.draught * (1 - (1 - h.forefoot_draught) * std::pow((u - h.forefoot) / (1 - h.forefoot), 2));
  return h.draught;
}

double HullSurface::section_coefficient(double u) const {
  const PlanShape& plan = lines_.waterline;
  const double s = u > plan.fore ? (u - plan.fore) / (1 - plan.fore) : u < plan.aft ? (plan.aft - u) / plan.aft : 0;
  return lines_.midship + (kEndCoefficient - lines_.midship) * std::pow(s, end_power_);
}

Vec3 HullSurface::below(double u, double p) const {
  const double c = section_coefficient(u), n = c / (1 - c);
  // Relative depth d and half-breadth 1 - d^n share the parameter: d + d^n = 2 p.
  double low = 0, high = 1;
  for (int i = 0; i < 50; ++i) {
    const double d = 0.5 * (low + high);
    (d + std::pow(d, n) < 2 * p ? low : high) = d;
  }
  const double d = p >= 1 ? 1 : low;
  const Vec3 water = side(u, 0);
  return {water.x(), p >= 1 ? 0 : water.y() * (1 - std::pow(d, n)), -d * keel_depth(u)};
}

double HullSurface::deck_edge_height(double x) const {
  const double s = 2.0 * x / length();
  const double rise =
      s > 0 ? (lines_.bow_height - lines_.freeboard) * s * s : (lines_.stern_height - lines_.freeboard) * s * s;
  return lines_.freeboard + rise;
}

double HullSurface::deck_half_breadth(double x) const {
  return 0.5 * lines_.beam * lines_.flare * lines_.deck.at(u_at_deck(x));
}

double HullSurface::deck_rise(double x, double y) const {
  const double edge = deck_half_breadth(x);
  return 4 * lines_.camber / (lines_.beam * lines_.flare) * std::max(0.0, edge * edge - y * y);
}

Vec3 HullSurface::side(double u, double v) const {
  const HullLines& h = lines_;
  const double stern = h.stern_at_water + (h.stern_at_deck - h.stern_at_water) * v;
  // The stem is raked and slightly hollow.
  const double stem = h.stem_at_water + (h.stem_at_deck - h.stem_at_water) * std::pow(v, h.stem_power);
  const double b0 = 0.5 * h.beam * h.waterline.at(u), b1 = 0.5 * h.beam * h.flare * h.deck.at(u);
  // Fraction of the change from waterline to deck breadth: nearly linear amidships, hollow with a knuckle in the
  // forebody.
  const double forward = smooth_step(0.5, 0.92, u);
  const double at_knuckle = std::pow(kKnuckle, kSectionPower) + h.knuckle_gain * forward;
  const double section = v <= kKnuckle ? at_knuckle * std::pow(v / kKnuckle, kSectionPower + h.hollow * forward)
                                       : at_knuckle + (1.0 - at_knuckle) * (v - kKnuckle) / (1.0 - kKnuckle);
  const double deck_x = h.stern_at_deck + (h.stem_at_deck - h.stern_at_deck) * u;
  return {stern + (stem - stern) * u, b0 + (b1 - b0) * section, v * deck_edge_height(deck_x)};
}

namespace {

// Vertices of the two sides of a station at a level, starboard and port; equal on the centreline.
using BothSides = std::array<std::uint32_t, 2>;
using Row = std::vector<BothSides>;         // from stern to stem
using Across = std::vector<std::uint32_t>;  // from starboard to port

class HullMesh {
 public:
  HullMesh(MeshBuilder& builder, const HullSurface& hull) : builder_(builder), hull_(hull) {
    const HullLines& h = hull.lines();
    stations_ = std::max(24, static_cast<int>(std::lround(hull.length() / h.panel)));
    levels_ = std::max(3, static_cast<int>(std::lround(h.bow_height / h.panel)));
    strips_ = h.camber > 0 ? 8 : 4;
    below_ = h.draught > 0 ? std::clamp(static_cast<int>(std::lround(2 * h.draught / h.panel)), 8, 16) : 0;
  }

  void add() {
    builder_.begin_part("hull");
    std::vector<Row> sides;
    for (int k = 0; k <= levels_; ++k) sides.push_back(row_above(k));
    for (int k = 0; k < levels_; ++k) add_strake(sides[k], sides[k + 1]);
    std::vector<Across> deck, bottom;
    for (int i = 0; i <= stations_; ++i) {
      deck.push_back(across(sides[levels_][i], true));
      if (below_ == 0) bottom.push_back(across(sides[0][i]));
    }
    std::vector<Across> transom;
    for (int k = 0; k <= levels_; ++k)
      transom.push_back(k == 0 && below_ == 0 ? bottom[0] : k == levels_ ? deck[0] : across(sides[k][0]));
    for (int j = 0; j < strips_; ++j) {
      for (int i = 0; i < stations_; ++i) {
        patch(deck[i][j], deck[i + 1][j], deck[i + 1][j + 1], deck[i][j + 1]);
        if (below_ == 0) patch(bottom[i][j + 1], bottom[i + 1][j + 1], bottom[i + 1][j], bottom[i][j]);
      }
      for (int k = 0; k < levels_; ++k)
        patch(transom[k][j + 1], transom[k][j], transom[k + 1][j], transom[k + 1][j + 1]);
    }
    if (below_ > 0) add_underwater_body(sides[0], transom[0]);
  }

 private:
  // Plates are closer together towards the stem, where the sections change.
  double u_of(int i) const {
    const double t = static_cast<double>(i) / stations_;
    return t + 0.06 * t * (1.0 - t);
  }

  // Welded plating is dented by millimetres between the frames; the dents differ from side to side. Waterline, deck
  // edge, keel and ends stay fair. k: level, counted down from the water for below = 1.
  std::array<double, 2> dents_at(int i, int k, std::uint32_t below) const {
    const bool is_free = k > 0 && k < (below == 0 ? levels_ : below_) && i > 0 && i < stations_;
    std::array<double, 2> dents{};
    for (std::uint32_t side = 0; is_free && side < 2; ++side) {
      const auto bits = philox4x32({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k), side, below},
                                   {hull_.lines().plating_key, 0});
      dents[side] = hull_.lines().dent * (bits[0] / 2147483648.0 - 1.0);
    }
    return dents;
  }

  Row row_above(int k) {
    Row row;
    for (int i = 0; i <= stations_; ++i) {
      const Vec3 port = hull_.side(u_of(i), static_cast<double>(k) / levels_);
      row.push_back(both_at(port, i == stations_, dents_at(i, k, 0)));
    }
    return row;
  }

  BothSides both_at(const Vec3& port, bool on_centreline, const std::array<double, 2>& dents) {
    if (on_centreline) {
      const std::uint32_t middle = builder_.vertex({port.x(), 0, port.z()});
      return {middle, middle};
    }
    const std::uint32_t starboard = builder_.vertex({port.x(), -(port.y() + dents[0]), port.z()});
    return {starboard, builder_.vertex({port.x(), port.y() + dents[1], port.z()})};
  }

  // A quad that may have two equal vertices.
  void patch(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    if (a != b && b != c && c != a) builder_.triangle(a, b, c);
    if (a != c && c != d && d != a) builder_.triangle(a, c, d);
  }

  void add_strake(const Row& low, const Row& high) {
    for (int i = 0; i < stations_; ++i) {
      patch(low[i][0], low[i + 1][0], high[i + 1][0], high[i][0]);
      patch(low[i + 1][1], low[i][1], high[i][1], high[i + 1][1]);
    }
  }

  // Points across the ship between the two sides of a station, level or on the deck; the ends are the sides' own
  // vertices.
  Across across(const BothSides& pair, bool on_deck = false) {
    const auto [starboard, port] = pair;
    Across line(static_cast<std::size_t>(strips_) + 1, starboard);
    line.back() = port;
    if (starboard == port) return line;
    const Vec3 rim = builder_.vertices()[port];
    for (int j = 1; j < strips_; ++j) {
      const double y = (2.0 * j / strips_ - 1.0) * rim.y();
      line[j] = builder_.vertex({rim.x(), y, rim.z() + (on_deck ? hull_.deck_rise(rim.x(), y) : 0)});
    }
    return line;
  }

  void add_underwater_body(const Row& waterline, const Across& at_water) {
    Row high = waterline;
    Across above = at_water;
    for (int k = 1; k <= below_; ++k) {
      Row low;
      for (int i = 0; i <= stations_; ++i)
        low.push_back(both_at(hull_.below(u_of(i), static_cast<double>(k) / below_), i == stations_ || k == below_,
                              dents_at(i, k, 1)));
      add_strake(low, high);
      const Across line = across(low[0]);
      for (int j = 0; j < strips_; ++j) patch(line[j + 1], line[j], above[j], above[j + 1]);
      high = std::move(low);
      above = line;
    }
  }

  MeshBuilder& builder_;
  const HullSurface& hull_;
  int stations_, levels_, below_;
  int strips_;  // across deck, lid and transom
};

}  // namespace

void add_hull(MeshBuilder& builder, const HullSurface& hull) { HullMesh(builder, hull).add(); }

void add_bulwark(MeshBuilder& builder, const HullSurface& hull, const Bulwark& bulwark) {
  constexpr double kThickness = 0.08, kSunk = 0.06;
  const auto& [from, to, bays, full_height, aft_height] = bulwark;
  for (double side : {1.0, -1.0}) {
    builder.begin_part(side > 0 ? "bulwark_port" : "bulwark_starboard");
    std::vector<std::array<std::uint32_t, 4>> sections;
    for (int i = 0; i <= bays; ++i) {
      const double x = from + (to - from) * i / bays;
      const double z = hull.deck_edge_height(x), y = std::max(hull.deck_half_breadth(x) - 0.05, 0.02 + kThickness);
      // The bulwark continues the flare and ends in a slope.
      const double height = i == 0 ? aft_height : full_height, lean = 0.12 * height;
      const auto at = [&](double offset, double up) { return builder.vertex({x, side * (y + offset), z + up}); };
      sections.push_back({at(0, -kSunk), at(lean, height), at(lean - kThickness, height), at(-kThickness, -kSunk)});
    }
    const auto face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
      side > 0 ? builder.quad(d, c, b, a) : builder.quad(a, b, c, d);
    };
    for (int i = 0; i < bays; ++i) {
      for (int k = 0; k < 4; ++k)
        face(sections[i][k], sections[i + 1][k], sections[i + 1][(k + 1) % 4], sections[i][(k + 1) % 4]);
    }
    const auto &first = sections.front(), &last = sections.back();
    face(first[0], first[1], first[2], first[3]);
    face(last[3], last[2], last[1], last[0]);

    // Stays: upright triangular plates across, every bay.
    for (int i = 1; i < bays - 2; ++i) {
      const double x = from + (to - from) * (i + 0.5) / bays;
      const double z = hull.deck_edge_height(x), y = hull.deck_half_breadth(x) - 0.05;
      const Vec3 foot(x, side * (y - 0.75), z - 0.03), root(x, side * (y - 0.04), z - 0.03),
          head(x, side * (y + 0.05), z + 0.95);
      side > 0 ? add_plate(builder, {foot, root, head}, 0.02) : add_plate(builder, {root, foot, head}, 0.02);
    }
  }
}

}  // namespace seaglint
