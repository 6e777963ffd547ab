// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/layout/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"

namespace seaglint {

namespace {

constexpr int kMostTrials = 100;  // of random places, on average of the bodies of a layout

// Indices of the layout's random numbers.
enum Drawn : std::uint64_t { kPlaces, kHeights, kHeadings, kScales, kJitter };

Random random_of(const LayoutSpec& layout, Drawn what) { return Random({layout.seed, Stream::kLayout, what}); }

// Point i of n at equal steps from -length / 2 to length / 2; one point is in the middle.
double along(double length, int i, int n) { return n > 1 ? length * (static_cast<double>(i) / (n - 1) - 0.5) : 0; }

std::vector<Vec2> on_a_line(const AreaLayout& area) {
  std::vector<Vec2> places;
  for (int i = 0; i < area.count; ++i) places.emplace_back(along(area.length_m, i, area.count), 0);
  return places;
}

// By a polygon whose sides fall short of their arcs by up to 3e-8 on a circle.
std::vector<Vec2> on_a_ring(const AreaLayout& area) {
  constexpr int kCorners = 8192;
  const auto corner = [&](int i) {
    const double angle = 2 * kPi * i / kCorners;
    return Vec2(area.length_m / 2 * std::cos(angle), area.width_m / 2 * std::sin(angle));
  };
  std::vector<double> passed_m{0};  // along the polygon, up to every corner
  for (int i = 0; i < kCorners; ++i) passed_m.push_back(passed_m.back() + (corner(i + 1) - corner(i)).norm());
  std::vector<Vec2> places;
  int at = 0;
  for (int i = 0; i < area.count; ++i) {
    const double wanted_m = passed_m.back() * i / area.count;
    while (at + 1 < kCorners && passed_m[static_cast<std::size_t>(at) + 1] < wanted_m) ++at;
    const double from_m = passed_m[static_cast<std::size_t>(at)], to_m = passed_m[static_cast<std::size_t>(at) + 1];
    const double fraction = to_m > from_m ? (wanted_m - from_m) / (to_m - from_m) : 0;
    places.push_back((1 - fraction) * corner(at) + fraction * corner(at + 1));
  }
  return places;
}

std::vector<Vec2> on_a_grid(const AreaLayout& area) {
  const double ideal = area.width_m > 0 ? std::sqrt(area.count * area.length_m / area.width_m) : area.count;
  const int columns = std::clamp(static_cast<int>(std::lround(std::min<double>(ideal, area.count))), 1, area.count);
  const int rows = (area.count + columns - 1) / columns;
  const double step_m = columns > 1 ? area.length_m / (columns - 1) : 0;
  std::vector<Vec2> places;
  for (int i = 0; i < area.count; ++i) {
    const int row = i / columns, in_row = std::min(columns, area.count - row * columns);
    places.emplace_back(along(step_m * (in_row - 1), i % columns, in_row), along(area.width_m, row, rows));
  }
  return places;
}

bool is_free(const std::vector<Vec2>& places, const Vec2& place, double min_distance_m) {
  return std::ranges::none_of(places, [&](const Vec2& other) { return (place - other).norm() < min_distance_m; });
}

std::vector<Vec2> at_random(const AreaLayout& area, Random random) {
  std::vector<Vec2> places;
  for (int trials = kMostTrials * area.count; places.size() < static_cast<std::size_t>(area.count); --trials) {
    if (trials == 0) {
      throw InputError(fmt::format("{} bodies find no places {} m apart in {} by {} m", area.count, area.min_distance_m,
                                   area.length_m, area.width_m));
    }
    const double x = area.length_m * (random.uniform() - 0.5), y = area.width_m * (random.uniform() - 0.5);
    if (is_free(places, {x, y}, area.min_distance_m)) places.emplace_back(x, y);
  }
  return places;
}

std::vector<Vec2> places_in(const LayoutSpec& layout) {
  const AreaLayout& area = *layout.area;
  switch (area.shape) {
    case LayoutShape::kLine: return on_a_line(area);
    case LayoutShape::kRing: return on_a_ring(area);
    case LayoutShape::kGrid: return on_a_grid(area);
    case LayoutShape::kRandom: return at_random(area, random_of(layout, kPlaces));
  }
  return {};
}

void displace(std::vector<Vec2>& places, const LayoutSpec& layout) {
  if (layout.jitter_m == 0) return;
  Random random = random_of(layout, kJitter);
  for (Vec2& place : places) {
    const double x = random.normal(), y = random.normal();
    place += layout.jitter_m * Vec2(x, y);
  }
}

void require_distances(const std::vector<Vec2>& places, double min_distance_m) {
  constexpr double kRounding = 1e-12;  // relative
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double distance_m = (places[i] - places[j]).norm();
      if (distance_m < min_distance_m * (1 - kRounding)) {
        throw InputError(
            fmt::format("bodies {} and {} are {:.6g} m apart: must be at least {}", j, i, distance_m, min_distance_m));
      }
    }
  }
}

std::vector<double> drawn_between(const OptionalLayout& layout, const std::optional<BodyRange> LayoutSpec::*range,
                                  Drawn what, double otherwise = 0) {
  std::vector<double> values(body_count(layout), otherwise);
  if (!layout || !((*layout).*range)) return values;
  const BodyRange ends = *((*layout).*range);
  Random random = random_of(*layout, what);
  for (double& value : values) value = ends.lowest + (ends.highest - ends.lowest) * random.uniform();
  return values;
}

}  // namespace

std::size_t body_count(const OptionalLayout& layout) {
  if (!layout) return 1;
  return static_cast<std::size_t>(layout->area ? layout->area->count : layout->line->count);
}

bool is_raft(const OptionalLayout& layout) { return layout && layout->bodies == LayoutBodies::kRigid; }

std::optional<double> rope_length_m(const OptionalLayout& layout) {
  if (!layout || !layout->tether_slack || !layout->line) return std::nullopt;
  return layout->line->spacing_m * (1 + *layout->tether_slack);
}

Vec2 layout_centre(const OptionalLayout& layout) {
  if (!layout) return Vec2::Zero();
  if (layout->area) return {layout->area->centre_x_m, layout->area->centre_y_m};
  return {layout->line->centre_x_m, layout->line->centre_y_m};
}

void move_layout(OptionalLayout& layout, const Vec2& by) {
  if (!layout) layout = LayoutSpec{.line = LineLayout{}};
  const auto move = [&](auto& places) {
    places.centre_x_m += by.x();
    places.centre_y_m += by.y();
  };
  layout->area ? move(*layout->area) : move(*layout->line);
}

std::vector<Vec2> layout_positions(const OptionalLayout& layout) {
  if (!layout) return {Vec2::Zero()};
  const Vec2 centre = layout_centre(layout);
  std::vector<Vec2> places;
  if (layout->area) {
    places = places_in(*layout);
    displace(places, *layout);
    require_distances(places, layout->area->min_distance_m);
    for (Vec2& place : places) place += centre;
    return places;
  }
  const LineLayout& line = *layout->line;
  for (int i = 0; i < line.count; ++i)
    places.emplace_back(line.centre_x_m + (i - 0.5 * (line.count - 1)) * line.spacing_m, line.centre_y_m);
  displace(places, *layout);
  return places;
}

std::vector<double> body_heights_m(const OptionalLayout& layout) {
  return drawn_between(layout, &LayoutSpec::heights_m, kHeights);
}

std::vector<double> body_headings_rad(const OptionalLayout& layout) {
  std::vector<double> headings = drawn_between(layout, &LayoutSpec::headings_deg, kHeadings);
  for (double& heading : headings) heading = radians(heading);
  return headings;
}

std::vector<double> body_scales(const OptionalLayout& layout, double target_scale) {
  std::vector<double> scales = drawn_between(layout, &LayoutSpec::scales, kScales, 1);
  for (double& scale : scales) scale *= target_scale;
  return scales;
}

std::string layout_name(const OptionalLayout& layout) {
  if (!layout) return "single";
  return layout->area ? kLayoutShapeNames[static_cast<std::size_t>(layout->area->shape)] : "line";
}

std::string layout_text(const OptionalLayout& layout) {
  if (!layout) return "";
  std::string more = is_raft(layout) ? ", on one rigid raft" : "";
  if (layout->scales)
    more += fmt::format(", of {:g} to {:g} times the mesh's size", layout->scales->lowest, layout->scales->highest);
  if (layout->jitter_m > 0) more += fmt::format(", displaced by {:g} m rms", layout->jitter_m);
  if (const auto rope_m = rope_length_m(layout)) more += fmt::format(", joined by ropes of {:g} m", *rope_m);
  if (layout->line) {
    const LineLayout& line = *layout->line;
    return fmt::format(", {} in line, {:g} m apart{}", line.count, line.spacing_m, more);
  }
  const AreaLayout& area = *layout->area;
  return fmt::format(", {} in {} of {:g} by {:g} m{}", area.count,
                     area.shape == LayoutShape::kRandom ? "random places" : "a " + layout_name(layout), area.length_m,
                     area.width_m, more);
}

}  // namespace seaglint
