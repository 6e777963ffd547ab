// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The bodies of a scenario and how they move in one sea realisation.

#include <memory>
#include <string>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/motion/body.h"
#include "sim/motion/kinematics/trajectory.h"
#include "sim/scattering/target/scatterer.h"
#include "sim/scenario/sample_plan.h"
#include "sim/scenario/scenario.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

// A target as loaded: one mesh shared by its bodies, or ideal points.
struct Target {
  TargetSpec spec;
  TriangleMesh mesh;                           // empty for points
  std::vector<std::string> doubts;             // about the mesh, a sentence each
  std::shared_ptr<const Scatterer> scatterer;  // of the mesh; null for points
  Body body;                                   // how it moves; unused for points
  std::vector<Vec3> rest_positions;            // of the bodies' origins, target frame; empty for points
  std::size_t first_body = 0;                  // bodies are counted over all targets, in order
  std::vector<std::size_t> companions;         // its companions, as further targets behind those of the scenario
  // of a companion, in the frame of the target that it stands with, which makes way of its own
  Vec3 relative_velocity_mps = Vec3::Zero();
};

// How a target moves, from its mesh and the files its motion names. Throws InputError naming the target.
Body load_body(const Scenario& scenario, const TargetSpec& spec, const TriangleMesh& mesh);

// Throws InputError for a mesh that is missing or unsound, and for a material that is missing, unsound or not known at
// the radar's frequencies. The targets of the scenario, in its order, then one more for each companion, moved to where
// it stands.
std::vector<Target> load_targets(const Scenario& scenario, const SamplePlan& plan);

// Full width of the range window that holds the response of every target of the scenario, wherever it is seen from. It
// is one number for all samples: a window that followed the target would tell its size. Throws InputError when its echo
// would not be over before the next pulse is sent.
double range_window_m(const Scenario& scenario, const std::vector<Target>& targets);

// One sea realisation with the motion of every body, from t = 0 to the end of the last interval.
struct Scene {
  WaveField sea;
  std::vector<std::vector<Trajectory>> bodies;  // [target][body]; none for points
};

// Longer than its intervals need where at_least_s says so; the beginning is the same.
Scene make_scene(const Scenario& scenario, const SamplePlan& plan, const std::vector<Target>& targets, int sea_state,
                 int realisation, double at_least_s = 0);

}  // namespace seaglint
