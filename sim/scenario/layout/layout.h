// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The `layout` of a target: how many bodies of one mesh it consists of, their places on the water, heights, headings
// and sizes. A target without one is one body at the origin.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/numbers/linear.h"

namespace seaglint {

enum class LayoutBodies { kIndependent, kRigid };
enum class LayoutShape { kLine, kRing, kGrid, kRandom };
inline constexpr const char* kLayoutShapeNames[] = {"line", "ring", "grid", "random"};

inline constexpr int kMostBodies = 1000;  // of one layout

// Equal spacings along x of the target frame.
struct LineLayout {
  int count = 1;
  double spacing_m = 40;
  double centre_x_m = 0;
  double centre_y_m = 0;

  bool operator==(const LineLayout&) const = default;
};

// A given number of bodies over a given area, length_m along x and width_m along y of the target frame.
struct AreaLayout {
  LayoutShape shape = LayoutShape::kRandom;
  int count = 4;
  double length_m = 120;
  double width_m = 40;
  double min_distance_m = 0;
  double centre_x_m = 0;
  double centre_y_m = 0;

  bool operator==(const AreaLayout&) const = default;
};

// Bounds of a quantity that is drawn for every body, uniform between them; lowest <= highest.
struct BodyRange {
  double lowest = 0;
  double highest = 0;

  bool operator==(const BodyRange&) const = default;
};

// Either a line or an area.
struct LayoutSpec {
  std::optional<LineLayout> line = {};
  std::optional<AreaLayout> area = {};
  LayoutBodies bodies = LayoutBodies::kIndependent;
  std::optional<BodyRange> heights_m = {};
  std::optional<BodyRange> headings_deg = {};
  std::optional<BodyRange> scales = {};
  double jitter_m = 0;
  std::optional<double> tether_slack = {};
  std::uint64_t seed = 0;

  bool operator==(const LayoutSpec&) const = default;
};

using OptionalLayout = std::optional<LayoutSpec>;

// Number of bodies: 1 without a layout.
std::size_t body_count(const OptionalLayout& layout);

// Bodies that move as one rigid raft.
bool is_raft(const OptionalLayout& layout);

// Length of the ropes between the neighbours of a tethered line, m; nothing for other layouts.
std::optional<double> rope_length_m(const OptionalLayout& layout);

// Centre of the layout on the water, in T.
Vec2 layout_centre(const OptionalLayout& layout);

// The layout moved by this vector in the plane of the water; a target without one gets a line of one body.
void move_layout(OptionalLayout& layout, const Vec2& by);

// Rest positions on the water of the bodies, in T, m; without a layout one body at the origin.
//   line    equally spaced along x about the centre
//   ring    an ellipse with the area's axes, the first body ahead, at equal distances along it
//   grid    rows along x, filled one after the other, of round(sqrt(count length / width)) bodies each, from border to
//           border; the last row, with the rest, is centred
//   random  uniform over the area, one after the other, again where a body comes nearer than min_distance_m to another
// With jitter_m each body is displaced by normal deviates of that standard deviation in x and in y, of a raft within
// the raft. Depends on the layout alone. Throws InputError, without a place, when two bodies are nearer than
// min_distance_m.
std::vector<Vec2> layout_positions(const OptionalLayout& layout);

// Heights above the waterline's rest_height_m() and headings (rad, about z) of the bodies; zero where none are given.
std::vector<double> body_heights_m(const OptionalLayout& layout);
std::vector<double> body_headings_rad(const OptionalLayout& layout);

// Factors by which the bodies enlarge the mesh of a target: its `scale` times that of each body, 1 where none is given.
std::vector<double> body_scales(const OptionalLayout& layout, double target_scale);

// "line", "ring", "grid", "random"; "single" without a layout.
std::string layout_name(const OptionalLayout& layout);

// ", 4 in line, 40 m apart, on one rigid raft, of 0.5 to 2 times the mesh's size"; empty without a layout.
std::string layout_text(const OptionalLayout& layout);

}  // namespace seaglint
