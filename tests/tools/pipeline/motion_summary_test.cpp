// SPDX-License-Identifier: BSD-3-Clause
// Which degrees of freedom of a target are 0 is said with the key that would move them.
#include "tools/pipeline/moving_bodies.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace seaglint {
namespace {

using testing::ContainsRegex;
using testing::StartsWith;

// A hull and a float with these keys of `motion`, in waves of 0.5 and 1 m.
Scenario bodies(const std::string& ship, const std::string& buoy, const std::string& sea = "") {
  return parse_scenario(fmt::format(R"(
seaglint: 1
sea: {{significant_wave_height_m: [0.5, 1], components: 64{}}}
targets:
  ship: {{label: 1, mesh: assets/combatant_144m.glb, motion: {{{}}}}}
  buoy: {{label: 0, mesh: assets/icosahedral_reflector.glb, motion: {{{}}}}}
dataset: {{maps_per_case: 2, realisations_per_case: 2}}
)",
                                    sea, ship, buoy),
                        "bodies.yaml");
}

TEST(MotionSummary, NamesWhatIsZeroAndTheKeyThatMovesIt) {
  const Pipeline pipeline(bodies("model: ship", "model: float"));
  const std::vector<TargetMotion> all = target_motions(pipeline);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(rest_text(all[0]), "surge, sway, heave are 0 without targets.ship.motion.translations: true");
  EXPECT_EQ(rest_text(all[1]),
            "yaw is 0 without targets.buoy.motion.yaw_rate_std_deg_s; surge, sway, heave are 0 without "
            "targets.buoy.motion.translations: true");
  EXPECT_THAT(motion_text(all[0]), ContainsRegex("^roll [0-9.]+, pitch [0-9.]+, yaw [0-9.]+ deg rms$"));
  EXPECT_THAT(motion_text(all[1]), ContainsRegex("^roll [0-9.]+, pitch [0-9.]+ deg rms$"));
}

TEST(MotionSummary, IsSilentWhereAllDegreesOfFreedomMove) {
  const Pipeline pipeline(
      bodies("model: ship, translations: true", "model: float, translations: true, yaw_rate_std_deg_s: 2"));
  for (const TargetMotion& motion : target_motions(pipeline)) {
    EXPECT_EQ(rest_text(motion), "");
    EXPECT_THAT(motion_text(motion),
                ContainsRegex("yaw [0-9.]+ deg rms; surge [0-9.]+, sway [0-9.]+, heave [0-9.]+ m"));
  }
}

// A long-crested head sea excites neither roll nor yaw nor sway of a hull that is symmetric.
TEST(MotionSummary, NamesTheSeaWhereItsDirectionLeavesADegreeOfFreedomAtRest) {
  const Pipeline pipeline(bodies("model: ship, translations: true", "model: fixed", ", propagation_deg: 180"));
  const std::vector<TargetMotion> all = target_motions(pipeline);
  EXPECT_THAT(rest_text(all[0]), StartsWith("roll, yaw, sway are 0 in these waves (sea.significant_wave_height_m, sea."
                                            "propagation_deg, sea.spreading)"));
  EXPECT_EQ(rest_text(all[1]), "does not move: targets.buoy.motion.model is fixed");
  EXPECT_EQ(motion_text(all[1]), "");
}

}  // namespace
}  // namespace seaglint
