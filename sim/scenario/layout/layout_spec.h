// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The `layout` of a target: how many bodies of one mesh it consists of, their places on the water, and what differs
// between them.

#include <cstdint>
#include <optional>

namespace seaglint {

enum class LayoutBodies { kIndependent, kRigid };
enum class LayoutShape { kLine, kRing, kGrid, kRandom };
inline constexpr const char* kLayoutShapeNames[] = {"line", "ring", "grid", "random"};

inline constexpr int kMostBodies = 1000;  // of one layout

// Equal spacings along x of the target frame.
struct LineLayout {
  int count = 1;          // 1 <= x <= kMostBodies
  double spacing_m = 40;  // 0 < x <= 10000
  double centre_x_m = 0;  // of the line, target frame, |x| <= 1e5
  double centre_y_m = 0;
};

// A given number of bodies over a given area, length_m along x and width_m along y of the target frame.
struct AreaLayout {
  LayoutShape shape = LayoutShape::kRandom;
  int count = 4;              // 1 <= x <= kMostBodies
  double length_m = 120;      // 0 <= x <= 10000
  double width_m = 40;        // 0 <= x <= 10000; of a line without effect
  double min_distance_m = 0;  // between any two bodies, 0 <= x <= 10000
  double centre_x_m = 0;      // of the area, |x| <= 1e5
  double centre_y_m = 0;
};

// Bounds of a quantity that is drawn for every body, uniform between them; lowest <= highest.
struct BodyRange {
  double lowest = 0;
  double highest = 0;
};

// Either a line or an area.
struct LayoutSpec {
  std::optional<LineLayout> line = {};
  std::optional<AreaLayout> area = {};
  LayoutBodies bodies = LayoutBodies::kIndependent;  // each body moves by itself, or all move as one rigid raft
  std::optional<BodyRange> heights_m = {};     // above the height of motion.origin_above_waterline_m, -10 <= x <= 100
  std::optional<BodyRange> headings_deg = {};  // of the bodies at rest, turned about z, -360 <= x <= 360
  std::optional<BodyRange> scales = {};        // factors by which their meshes are enlarged, 1e-3 <= x <= 1e3
  std::uint64_t seed = 0;                      // of random places, heights, headings and scales
};

}  // namespace seaglint
