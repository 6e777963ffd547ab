// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Motion in one sea realisation: of one body, and of all bodies of a target.

#include <cstdint>
#include <span>
#include <vector>

#include "sim/motion/body.h"
#include "sim/motion/kinematics/trajectory.h"
#include "sim/scenario/layout/layout.h"
#include "sim/scenario/target_spec.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

// Rest position of the mesh origin of a body at (x, y) on the water: at the waterline for a ship and a fixed body,
// spec.origin_above_waterline_m above it for a float, whose mesh has its origin in its middle.
Vec3 rest_position(const MotionSpec& spec, double x, double y);

// Motion of one body with its origin at rest_position (target frame), from t = 0 to the end of the step that contains
// duration_s. The random yaw of a float uses stream kFloatYaw of (seed, index). For `waves: independent` the caller
// passes a separate sea per body.
Trajectory simulate_motion(const Body& body, const Vec3& rest_position, const WaveField& sea, double duration_s,
                           std::uint64_t seed, std::uint64_t index);

// Origin of a rigid raft's frame at rest, in T: the centre of the layout on the water.
Vec3 raft_origin(const TargetSpec& target);

// A rigid raft whose motion.model is not fixed.
bool is_moving_raft(const TargetSpec& target);

// Rest height of the bodies' mesh origins above the water, m: motion.origin_above_waterline_m of floats and of moving
// rafts, so that a raft has the geometry of the floats; else 0, the waterline of a mesh.
double rest_height_m(const TargetSpec& target);

// Rest positions of the bodies' mesh origins, in T: layout_positions() at rest_height_m() and body_heights_m() above
// it.
std::vector<Vec3> rest_positions(const TargetSpec& target);

// Realisation index of a body's own random numbers; body counts from 0 over all targets of the scenario, in order
// (below 65536).
std::uint64_t body_index(std::uint64_t sea_index, std::size_t body);

// Mean velocity of a target's floats by wind and current, leeway W + C; zero without motion.drift. The leeway of
// floating objects is 1 to 6 % of the wind speed: Allen and Plourde, "Review of leeway", USCG R&D Center CG-D-08-99
// (1999); Breivik and Allen, J. Marine Systems 69 (2008) 99.
Vec3 mean_drift_mps(const MotionSpec& spec);
Vec3 current_mps(const MotionSpec& spec);  // C

// Velocity of each body: mean_drift_mps() and a normal deviate of spread_mps in x and in y, of stream kDrift of (seed,
// body_index()); of a raft one for all.
std::vector<Vec3> drift_velocities_mps(const TargetSpec& target, std::uint64_t seed, std::uint64_t sea_index,
                                       std::size_t first_body);

// What moves the bodies of a target.
struct TargetMotionRequest {
  const TargetSpec& target;
  std::span<const Body* const> models;  // the motion model of each body, or one for all
  const SeaState& state;
  const WaveField& sea;  // realise_sea(state, seed, sea_index)
  double duration_s = 0;
  std::uint64_t seed = 1, sea_index = 0;
  std::size_t first_body = 0;  // number of bodies of the targets before this one
  int threads = 1;             // 0 = all; without influence on the result
};

// One trajectory per body of the layout, from t = 0 to duration_s. A rigid raft (layout.bodies: rigid) has the first
// model: it moves in the waves at its origin, and each reflector with it. A free body with a height of its own is that
// far above its float, fixed to it. The floats of a tethered line hold each other (simulate_tethered_floats()). Bodies
// are turned by their headings. A float that has a speed_mps is towed at that speed through the waves. Drift is no part
// of the trajectories. The sea is common to all bodies unless the spec has `waves: independent`: then each body has a
// realisation of its own (index body_index + 2^48).
std::vector<Trajectory> simulate_target(const TargetMotionRequest& request);

}  // namespace seaglint
