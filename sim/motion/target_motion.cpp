// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/target_motion.h"

#include <fmt/format.h>

#include "sim/core/process/error.h"
#include "sim/core/process/parallel.h"
#include "sim/motion/simulate.h"
#include "sim/sea/realisation.h"

namespace seaglint {

namespace {

constexpr std::uint64_t kMaxBodies = 65536;  // of a scenario; a line holds up to 1000
constexpr std::uint64_t kIndependentSeas = std::uint64_t{1} << 48;

}  // namespace

std::vector<Vec2> layout_positions(const TargetSpec& target) {
  std::vector<Vec2> places;
  const LineLayout line = target.line.value_or(LineLayout{});
  for (int i = 0; i < line.count; ++i)
    places.emplace_back(line.centre_x_m + (i - 0.5 * (line.count - 1)) * line.spacing_m, line.centre_y_m);
  return places;
}

std::uint64_t body_index(std::uint64_t sea_index, std::size_t body) {
  SEAGLINT_CHECK(body < kMaxBodies, fmt::format("body {}", body));
  return sea_index * kMaxBodies + body;
}

std::vector<Trajectory> simulate_target(const TargetSpec& target, const Body& body, const SeaState& state,
                                        const WaveField& sea, double duration_s, std::uint64_t seed,
                                        std::uint64_t sea_index, std::size_t first_body, int threads) {
  const std::vector<Vec2> places = layout_positions(target);
  std::vector<Trajectory> trajectories(places.size());
  parallel_for(places.size(), thread_count(threads), [&](std::size_t i) {
    const std::uint64_t index = body_index(sea_index, first_body + i);
    const Vec3 rest = rest_position(target.motion, places[i].x(), places[i].y());
    if (target.motion.waves == WaveSharing::kIndependent) {
      const WaveField own = realise_sea(state, seed, kIndependentSeas + index);
      trajectories[i] = simulate_motion(body, rest, own, duration_s, seed, index);
    } else {
      trajectories[i] = simulate_motion(body, rest, sea, duration_s, seed, index);
    }
  });
  return trajectories;
}

}  // namespace seaglint
