// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// In which degrees of freedom the targets of a scenario move, and which keys would move them in the others.

#include <array>
#include <string>
#include <vector>

#include "sim/motion/body.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {

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
