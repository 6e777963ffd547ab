// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The moving bodies of a scenario in one sea realisation over any time, without their echoes, and the degrees of
// freedom in which they move.

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/motion/body.h"
#include "sim/scenario/scenario.h"
#include "sim/sea/wave_field.h"
#include "tools/figure/motion_figures.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {

// A realisation of one of the scenario's sea states, as the samples of the data set have it.
struct SeaChoice {
  std::size_t sea_state = 0;    // index into sea_states()
  std::size_t realisation = 0;  // below 1000000; the data set has those below dataset.realisations_per_case
};

struct ChosenSea {
  SeaState state;
  WaveField field;
};

// Throws InputError for a sea state or realisation beyond the last.
ChosenSea choose_sea(const Scenario& scenario, const SeaChoice& choice);

// Bodies of every mesh target but parts in the order of the file, `ship`, `array_1`, `array_2`, ..., and the motion
// model of each target's first body. A rigid raft is one body: its first reflector, whose angles and translations are
// the raft's.
struct MovingBodies {
  ChosenSea sea;
  std::vector<Body> targets;
  std::vector<NamedTrajectory> bodies;
};

// Motion from t = 0 to duration_s, that of the samples of this realisation; `loaded` gets every target with its motion
// model before it is simulated. Throws InputError for a mesh or motion file that is missing or invalid and for a
// scenario without meshes, Interrupted between targets when `stop` becomes true.
MovingBodies simulate_bodies(const Scenario& scenario, const SeaChoice& choice, double duration_s, int threads,
                             const StopFlag& stop, const std::function<void(const TargetSpec&, const Body&)>& loaded);

// Part of this sea's spectrum outside of the frequencies of a table of response amplitude operators, a sentence per
// target with such a table.
std::vector<std::string> uncovered_waves(const MovingBodies& scene);

// Angles and translations at a time within the simulated duration; a time beyond the last sample by rounding is the
// last sample's. A body at rest has no samples of its own.
MotionSample motion_at(const NamedTrajectory& body, double t);

// In which degrees of freedom the targets of a scenario move, and which keys would move them in the others.

// Motion of the first body of a target.
struct TargetMotion {
  const TargetSpec* target = nullptr;
  std::array<double, 6> rms{};  // motion_rms(); 0: at rest in that degree of freedom
};

// That of every mesh target, parts included, over 100 s of the first realisation of the sea state with the highest
// waves, with drawn keys at the middles of their distributions; of a recorded motion that is shorter, over the
// scenario's intervals. Without targets whose responses do not cover this sea.
std::vector<TargetMotion> target_motions(const Pipeline& pipeline);

// "roll 1.91, pitch 0.42, yaw 0.11 deg rms"; empty for a target at rest.
std::string motion_text(const TargetMotion& motion);

// The degrees of freedom that are 0, with the keys that would move them: "surge, sway, heave are 0 without
// targets.ship.motion.translations: true"; empty where none is.
std::string rest_text(const TargetMotion& motion);

// Warns of rest_text() of every mesh target unless it is empty, or the scenario says itself that the target is
// fixed.
void report_rest(const Scenario& scenario, const std::vector<TargetMotion>& motions);

}  // namespace seaglint
