// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The bodies of a scenario and their motion in one sea realisation.

#include <memory>
#include <vector>

#include "sim/motion/kinematics/trajectory.h"
#include "sim/scenario/sample_plan.h"
#include "sim/scenario/scenario.h"
#include "sim/sea/wave_field.h"
#include "tools/pipeline/body_model.h"

namespace seaglint {

// A target as loaded: bodies of one mesh, or ideal points.
struct Target {
  TargetSpec spec;
  std::vector<std::shared_ptr<const BodyModel>> models;  // of each body; empty for points
  std::vector<double> radii_m;          // largest distance of each body's vertices from its origin; empty for points
  std::vector<Vec3> rest_positions;     // of the bodies' origins, target frame; empty for points and parts
  std::size_t first_body = 0;           // bodies are numbered over all targets but parts, in order
  std::vector<std::size_t> companions;  // indices of its companions, which follow the targets of the scenario
  // of a companion, in the frame of the target that it accompanies, which may be under way
  Vec3 relative_velocity_mps = Vec3::Zero();
};

// Loads the targets of a scenario without variations in its order, then one more target per companion, moved to its
// place. Throws InputError for a mesh that is missing or invalid, and for a material that is missing, invalid or not
// defined at the radar's frequencies.
std::vector<Target> load_targets(const Scenario& scenario, const SamplePlan& plan, LoadedBodies* loaded = nullptr);

// Full width, m, of the range window that contains the response of every target of the scenario at every aspect, with
// all values that its plan draws. It is one number for all samples: a window fitted to the target would reveal its
// size. Throws InputError when the echo from the window would last beyond the next pulse.
double range_window_m(const Scenario& scenario, const SamplePlan& plan, const std::vector<Target>& targets);

// One sea realisation with the motion of every body, from t = 0 to the end of the last interval.
struct Scene {
  WaveField sea;
  std::vector<std::vector<Trajectory>> bodies;                   // [target][body]; none for points and parts
  std::shared_ptr<const std::vector<Target>> targets = nullptr;  // those that move, as a Pipeline loads them
};

// Generates the scene over the intervals of the plan, at least at_least_s long; a longer scene begins with the same
// values.
Scene make_scene(const Scenario& scenario, const SamplePlan& plan, const std::vector<Target>& targets, int sea_state,
                 int realisation, double at_least_s = 0);

}  // namespace seaglint
