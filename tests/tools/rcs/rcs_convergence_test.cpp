// SPDX-License-Identifier: BSD-3-Clause
// Changes of a sweep's levels.
#include "tools/rcs/rcs_convergence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace seaglint {
namespace {

// hh doubles in the second view (6.02 dB); vv falls from 70 to 100 dB below its highest, which the floor at 60 dB
// hides.
TEST(LevelChange, IsThatOfLevelsAboveTheFloor) {
  RcsSweep sweep;
  sweep.frequency_hz = {10e9};
  sweep.azimuth_deg = {0, 10};
  sweep.elevation_deg = {5};
  const auto model = [](double hh, double vv) {
    return RcsSweep::Model{"po", false, {{std::array<Complex, 4>{1, 0, 0, 1}}, {std::array<Complex, 4>{hh, 0, 0, vv}}}};
  };
  const RcsSweep::Model coarse = model(0.1, 1e-3 / 3.16), fine = model(0.2, 1e-5);
  const LevelChange change = level_change(sweep, fine, coarse);
  EXPECT_NEAR(change.largest_db, 20 * std::log10(2.0), 1e-9);
  EXPECT_NEAR(change.mean_db, 20 * std::log10(2.0) / 4, 1e-9);  // of two views and two elements
  EXPECT_EQ(change.view, 1u);
  EXPECT_EQ(change.element, 0u);
  sweep.models = {fine};
  sweep.coarser = coarse;
  EXPECT_EQ(convergence_cells(sweep, 1, 0), ",6.0206,-30.0063");
}

TEST(HalvedSize, IsThatOfTheSizeOfItsMethod) {
  RcsRequest request;
  request.min_patch_m = 0.001;
  request.ray_spacing_m = 0.02;
  const RcsRequest finer_beams = at_step(request, {0.0005, 0, {}});
  EXPECT_EQ(finer_beams.min_patch_m, 0.0005);
  EXPECT_EQ(finer_beams.ray_spacing_m, 0.02);
  request.method = SolverMethod::kRays;
  const RcsRequest finer_rays = at_step(request, {0.01, 0, {}});
  EXPECT_EQ(finer_rays.min_patch_m, 0.001);
  EXPECT_EQ(finer_rays.ray_spacing_m, 0.01);
  EXPECT_EQ(convergence_header(SolverMethod::kBeams), ",hh_patch_change_db,vv_patch_change_db");
  EXPECT_EQ(convergence_header(SolverMethod::kRays), ",hh_spacing_change_db,vv_spacing_change_db");
}

TEST(ConvergedSweep, WarnsOfTheChangeThatIsLeft) {
  RcsRequest request;
  ConvergedSweep sweep;
  sweep.series.resize(kMostHalvings + 1);
  sweep.series.back().change.largest_db = -0.25;
  EXPECT_EQ(convergence_warning(request, sweep), "levels still change by 0.25 dB after 6 halvings of the patches");
  request.method = SolverMethod::kRays;
  EXPECT_THAT(convergence_warning(request, sweep), testing::EndsWith("6 halvings of the distance between rays"));
}

}  // namespace
}  // namespace seaglint
