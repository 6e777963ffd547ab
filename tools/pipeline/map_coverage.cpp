// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/map_coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <variant>

#include "radar/rvmap/rv_map.h"
#include "sim/core/numbers/constants.h"
#include "sim/scattering/observation/observation.h"

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

// Recorded translations of a body in range, until duration_s after t = 0, m.
Span drift_of(const Body& body, const Vec3& r_hat, double duration_s) {
  Span drift;
  const auto* series = std::get_if<AttitudeSeries>(&body.model);
  if (series == nullptr || !body.spec.translations) return drift;
  const double begin_s = body.spec.series_start_s;
  for (std::size_t n = 0; n < series->time.size(); ++n) {
    const double before_s = series->time[n > 0 ? n - 1 : 0],
                 after_s = series->time[std::min(n + 1, series->time.size() - 1)];
    if (after_s >= begin_s && before_s <= begin_s + duration_s)
      drift.include(-r_hat.dot(series->samples[n].translation));
  }
  return drift;
}

// Times of a scenario, s.
struct Durations {
  double interval_s = 0;     // of one map
  double realisation_s = 0;  // until the end of the last interval
};

void extend(Reach& reach, const Target& target, const Vec3& r_hat, const Durations& durations) {
  for (const PointSpec& point : target.spec.points) {
    const double range = -r_hat.dot(Vec3(point.position_m)), velocity = -r_hat.dot(Vec3(point.velocity_mps));
    reach.range_m.include(range);
    reach.range_m.include(range + velocity * durations.interval_s);
    reach.velocity_mps.include(velocity);
  }
  std::map<const BodyModel*, Span> sizes;
  for (const auto& model : target.models) {
    if (sizes.contains(model.get())) continue;
    const Span mesh = extent_of(model->prepared->mesh, r_hat),
               drift = drift_of(*model->motion, r_hat, durations.realisation_s);
    sizes[model.get()] = {mesh.low + drift.low, mesh.high + drift.high};
  }
  const double relative_velocity_mps = -r_hat.dot(target.relative_velocity_mps);
  for (std::size_t i = 0; i < target.rest_positions.size(); ++i) {
    const Vec3& rest = target.rest_positions[i];
    const Span& body = sizes[target.models[i].get()];
    for (const double passed_m : {0.0, relative_velocity_mps * durations.interval_s}) {
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
  const double interval_s = train.time_s.back();
  const Durations durations{interval_s, pipeline.plan().last_start_s() + interval_s};
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
      extend(reach, targets[t], r_hat, durations);
      for (const std::size_t companion : targets[t].companions) extend(reach, targets[companion], r_hat, durations);
      if (!platform.motion_compensated) {
        const double own_mps = r_hat.dot(Vec3(platform.velocity_mps));
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
