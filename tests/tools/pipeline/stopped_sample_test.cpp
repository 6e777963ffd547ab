// SPDX-License-Identifier: BSD-3-Clause
// A sample that is stopped while its response is computed.
#include <gtest/gtest.h>

#include "sim/core/process/error.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {
namespace {

TEST(StoppedSample, ThrowsAndLeavesThePipelineAsItWas) {
  const Scenario scenario = parse_scenario(R"(
seaglint: 1
radar: {pulses: 16}
targets:
  reflector: {label: 0, mesh: assets/icosahedral_reflector.glb, motion: {model: float}}
dataset: {maps_per_case: 1, realisations_per_case: 1}
)",
                                           "reflector.yaml");
  const Pipeline stopped(scenario), undisturbed(scenario);
  const StopFlag stop = true;
  EXPECT_THROW(stopped.generate_sample(0, &stop), Interrupted);
  EXPECT_EQ(stopped.generate_sample(0).received.map.values, undisturbed.generate_sample(0).received.map.values);
}

}  // namespace
}  // namespace seaglint
