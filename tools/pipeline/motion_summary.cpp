// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/motion_summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/motion/simulate.h"
#include "sim/motion/statistics.h"
#include "sim/motion/target_motion.h"
#include "sim/scenario/files/scenario_document.h"
#include "sim/sea/realisation.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {

namespace {

constexpr double kDuration_s = 100;

// Motion of a body at the origin over 100 s, or over the scenario's intervals where its series ends before that.
Trajectory trial_motion(const Pipeline& pipeline, const Target& target, const WaveField& sea, std::uint64_t key) {
  const Scenario& scenario = pipeline.scenario();
  const auto simulated = [&](double duration_s) {
    return simulate_motion(*target.models.front()->motion, Vec3::Zero(), sea, duration_s, scenario.seed,
                           body_index(key, target.first_body));
  };
  try {
    return simulated(kDuration_s);
  } catch (const InputError&) {
    return simulated(pipeline.plan().last_start_s() + scenario.radar.pulses * scenario.radar.pri_us * 1e-6);
  }
}

// Why degree of freedom i of a moving target is 0.
std::string rest_reason(const TargetSpec& target, std::size_t i) {
  const MotionSpec& motion = target.motion;
  const std::string path = fmt::format("targets.{}.motion", target.name);
  if (i >= 3 && !motion.translations) return fmt::format("without {}.translations: true", path);
  if (motion.model == MotionModel::kSeries) return fmt::format("in its file ({}.file)", path);
  if (i == 2 && motion.model == MotionModel::kFloat && motion.yaw_rate_std_deg_s == 0)
    return fmt::format("without {}.yaw_rate_std_deg_s", path);
  if (motion.model == MotionModel::kRao)
    return fmt::format("in its table or in these waves ({}.file, sea.propagation_deg)", path);
  return "in these waves (sea.significant_wave_height_m, sea.propagation_deg, sea.spreading)";
}

// Whether the scenario has a section `motion` of the target.
bool has_motion_section(const Scenario& scenario, const TargetSpec& target) {
  const YamlNode* node = scenario.document ? &scenario.document->root : nullptr;
  for (const std::string& key : {std::string("targets"), target.name, std::string("motion")})
    node = node == nullptr ? nullptr : node->find(key);
  return node != nullptr;
}

}  // namespace

std::vector<TargetMotion> target_motions(const Pipeline& pipeline) {
  const Scenario& scenario = pipeline.scenario();
  const std::vector<SeaState>& states = pipeline.plan().sea_states();
  const auto highest = std::ranges::max_element(states, {}, total_wave_height);
  const std::uint64_t key = sea_key(static_cast<std::size_t>(highest - states.begin()), 0);
  const WaveField sea = realise_sea(*highest, scenario.seed, key);
  std::vector<TargetMotion> motions;
  for (std::size_t t = 0; t < scenario.targets.size(); ++t) {
    const Target& target = pipeline.targets()[t];
    if (target.models.empty()) continue;
    try {
      motions.push_back({&scenario.targets[t], motion_rms(trial_motion(pipeline, target, sea, key), kDuration_s)});
    } catch (const InputError&) {
      continue;  // its responses do not cover this sea
    }
  }
  return motions;
}

std::string motion_text(const TargetMotion& motion) {
  std::string text;
  for (const bool angles : {true, false}) {
    std::vector<std::string> parts;
    for (std::size_t i = angles ? 0 : 3; i < (angles ? 3u : 6u); ++i) {
      if (motion.rms[i] > 0)
        parts.push_back(
            fmt::format("{} {:.3g}", kDegreesOfFreedom[i], angles ? degrees(motion.rms[i]) : motion.rms[i]));
    }
    if (parts.empty()) continue;
    if (!text.empty()) text += "; ";
    text += fmt::format("{} {} rms", fmt::join(parts, ", "), angles ? "deg" : "m");
  }
  return text;
}

std::string rest_text(const TargetMotion& motion) {
  const TargetSpec& target = *motion.target;
  if (target.motion.model == MotionModel::kFixed)
    return fmt::format("does not move: targets.{0}.motion.model is fixed", target.name);
  std::vector<std::pair<std::string, std::vector<std::string>>> by_reason;
  for (std::size_t i = 0; i < motion.rms.size(); ++i) {
    if (motion.rms[i] > 0) continue;
    const std::string reason = rest_reason(target, i);
    auto known = std::ranges::find(by_reason, reason, &decltype(by_reason)::value_type::first);
    if (known == by_reason.end()) known = by_reason.insert(by_reason.end(), {reason, {}});
    known->second.emplace_back(kDegreesOfFreedom[i]);
  }
  std::string text;
  for (const auto& [reason, names] : by_reason)
    text += fmt::format("{}{} {} 0 {}", text.empty() ? "" : "; ", fmt::join(names, ", "),
                        names.size() == 1 ? "is" : "are", reason);
  return text;
}

void report_rest(const Scenario& scenario, const std::vector<TargetMotion>& motions) {
  for (const TargetMotion& motion : motions) {
    if (motion.target->motion.model == MotionModel::kFixed && has_motion_section(scenario, *motion.target)) continue;
    const std::string text = rest_text(motion);
    if (!text.empty()) warn(std::array{fmt::format("targets.{}: {}", motion.target->name, text)});
  }
}

}  // namespace seaglint
