// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Responses and motions of a scenario's targets, and how far two responses are apart.

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/relative_difference.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {

// H of a target in the first interval of the scenario.
inline std::vector<Complex> response_of(const Pipeline& pipeline, int target) {
  SampleAddress at;
  at.target = target;
  return pipeline.response(at, pipeline.pulse_train(0)).response.values;
}

// The bodies of a scenario in one sea, as `seaglint motion` has them.
struct MovingBodies {
  Scene scene;
  std::vector<NamedTrajectory> bodies;
};
inline MovingBodies moving_bodies(const Scenario& scenario, const SeaChoice& choice, double duration_s) {
  const std::vector<Target> targets =
      load_targets({.scenario = scenario, .plan = SamplePlan(scenario), .use = TargetUse::kMotion});
  Scene scene = make_scene({.scenario = scenario, .targets = targets, .sea = choice, .at_least_s = duration_s});
  std::vector<NamedTrajectory> bodies = named_bodies(targets, scene);
  return {std::move(scene), std::move(bodies)};
}

// Relative L2 difference of a from b, dB; at least -300.
inline double relative_difference_db(const std::vector<Complex>& a, const std::vector<Complex>& b) {
  return 20 * std::log10(std::max(relative_difference(a, b), 1e-15));
}

}  // namespace seaglint
