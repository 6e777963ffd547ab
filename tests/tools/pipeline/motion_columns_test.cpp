// SPDX-License-Identifier: BSD-3-Clause
// The columns with the truth: motion of the target in the middle of the interval.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {
namespace {

TEST(MotionColumns, AreTheFirstBodysMotionInMidInterval) {
  const Pipeline pipeline(parse_scenario(R"(
seaglint: 1
radar: {pulses: 64, pri_jitter_us: 10}
sea: {significant_wave_height_m: 2, components: 64}
targets:
  array: {label: 0, mesh: assets/icosahedral_reflector.glb, motion: {model: float, translations: true, yaw_rate_std_deg_s: 3},
          layout: {line: {count: 2}}}
  points: {label: 1, points: [{position_m: [0, 0, 0], velocity_mps: [1, 0, 0]}]}
dataset: {maps_per_case: 2, realisations_per_case: 1}
)",
                                         "columns.yaml"));
  SampleAddress at;
  at.interval = 1;
  const std::size_t sample = pipeline.plan().sample(at);
  const SampleRecord record = pipeline.generate_sample(sample).stored.record;
  const PulseTrain train = pipeline.pulse_train(sample);
  const double middle_s = record.start_s + 0.5 * (train.time_s.front() + train.time_s.back());
  const Trajectory& first = pipeline.scene(0, 0)->bodies[0].front();
  const auto at_time = [&](double t) {
    const MotionSample motion = first.sample(t);
    return std::array{degrees(motion.angles.x()), degrees(motion.angles.y()), degrees(motion.angles.z()),
                      motion.translation.z()};
  };
  const std::array stored{record.roll_deg, record.pitch_deg, record.yaw_deg, record.heave_m};
  const std::array rates{record.roll_rate_deg_s, record.pitch_rate_deg_s, record.yaw_rate_deg_s, record.heave_rate_mps};
  EXPECT_EQ(stored, at_time(middle_s));
  constexpr double kStep = 1e-4;  // s; the central difference of the cubic, with (kStep w)^2 / 6 of the rate
  for (std::size_t i = 0; i < 4; ++i) {
    const double rate = (at_time(middle_s + kStep)[i] - at_time(middle_s - kStep)[i]) / (2 * kStep);
    EXPECT_NE(rate, 0);
    EXPECT_NEAR(rates[i], rate, 1e-5 * std::abs(rate) + 1e-9) << i;
  }

  at.target = 1;
  const SampleRecord points = pipeline.generate_sample(pipeline.plan().sample(at)).stored.record;
  EXPECT_EQ(points.roll_deg, 0);
  EXPECT_EQ(points.heave_rate_mps, 0);
}

}  // namespace
}  // namespace seaglint
