// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/map_coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "radar/rvmap/rv_map.h"
#include "sim/core/numbers/constants.h"
#include "sim/scattering/beams/bistatic_geometry.h"

namespace seaglint {
namespace {

constexpr std::size_t kMaxLines = 10;

struct Span {
  double low = 0, high = 0;

  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  // Within the cells of the axis; a single cell contains everything.
  bool within(const std::vector<double>& axis) const {
    const double half = axis.size() > 1 ? (axis[1] - axis[0]) / 2 : std::numeric_limits<double>::infinity();
    return low >= axis.front() - half && high <= axis.back() + half;
  }
};

// Extent of a target with its companions in range and velocity.
struct Reach {
  Span range_m, velocity_mps;
};

// Of a mesh in range, relative to its origin, m.
Span extent_of(const TriangleMesh& mesh, const Vec3& r_hat) {
  Span extent;
  for (const Vec3& vertex : mesh.vertices) extent.include(-r_hat.dot(vertex));
  return extent;
}

void extend(Reach& reach, const Target& target, const Vec3& r_hat, double interval_s) {
  for (const PointSpec& point : target.spec.points) {
    const double range = -r_hat.dot(Vec3(point.position_m.data())),
                 velocity = -r_hat.dot(Vec3(point.velocity_mps.data()));
    reach.range_m.include(range);
    reach.range_m.include(range + velocity * interval_s);
    reach.velocity_mps.include(velocity);
  }
  std::map<const BodyModel*, Span> sizes;
  for (const auto& model : target.models) {
    if (!sizes.contains(model.get())) sizes[model.get()] = extent_of(model->prepared->mesh, r_hat);
  }
  const double relative_velocity_mps = -r_hat.dot(target.relative_velocity_mps);
  for (std::size_t i = 0; i < target.rest_positions.size(); ++i) {
    const Vec3& rest = target.rest_positions[i];
    const Span& body = sizes[target.models[i].get()];
    for (const double passed_m : {0.0, relative_velocity_mps * interval_s}) {
      reach.range_m.include(-r_hat.dot(rest) + passed_m + body.low);
      reach.range_m.include(-r_hat.dot(rest) + passed_m + body.high);
    }
    if (relative_velocity_mps != 0) reach.velocity_mps.include(relative_velocity_mps);
  }
}

}  // namespace

std::vector<std::string> map_coverage_warnings(const Pipeline& pipeline) {
  const Scenario& scenario = pipeline.scenario();
  const std::vector<Target>& targets = pipeline.targets();
  const PulseTrain train = make_pulse_train(scenario.radar, pipeline.window_m(), scenario.seed, 0);
  const MapGrid grid = map_grid(train, scenario.map);
  const PlatformSpec& platform = scenario.radar.platform;
  std::vector<std::string> lines;
  std::size_t more = 0;
  const auto add_line = [&](const std::string& line) {
    if (lines.size() < kMaxLines) {
      lines.push_back(line);
    } else {
      ++more;
    }
  };
  for (const int number : pipeline.plan().classes()) {
    const auto t = static_cast<std::size_t>(number);
    for (const View& view : pipeline.plan().views()) {
      const Vec3 r_hat = direction_to_radar(view.azimuth_rad, view.elevation_rad);
      Reach reach;
      extend(reach, targets[t], r_hat, train.time_s.back());
      for (const std::size_t companion : targets[t].companions)
        extend(reach, targets[companion], r_hat, train.time_s.back());
      if (!platform.motion_compensated) {
        const double own_mps = r_hat.dot(Vec3(platform.velocity_mps.data()));
        reach.velocity_mps = {reach.velocity_mps.low + own_mps, reach.velocity_mps.high + own_mps};
      }
      const std::string who = fmt::format("targets.{} at azimuth {:g} deg", scenario.targets[t].name, view.azimuth_deg);
      if (!reach.range_m.within(grid.range_m)) {
        add_line(
            fmt::format("{} reaches from {:.1f} to {:.1f} m, the map from {:.1f} to {:.1f} m: raise map.range_span_m",
                        who, reach.range_m.low, reach.range_m.high, grid.range_m.front(), grid.range_m.back()));
      }
      if (!reach.velocity_mps.within(grid.velocity_mps)) {
        const double unambiguous = train.unambiguous_velocity_mps();
        const bool folds = std::max(-reach.velocity_mps.low, reach.velocity_mps.high) > unambiguous;
        add_line(fmt::format(
            "{} moves at {:.2f} to {:.2f} m/s, the map shows {:.2f} to {:.2f} m/s (unambiguous within +-{:.2f}): {}",
            who, reach.velocity_mps.low, reach.velocity_mps.high, grid.velocity_mps.front(), grid.velocity_mps.back(),
            unambiguous, folds ? "shorten radar.pri_us" : "raise map.velocity_span_mps"));
      }
    }
  }
  if (more > 0) lines.push_back(fmt::format("and {} more like these", more));
  return lines;
}

}  // namespace seaglint
