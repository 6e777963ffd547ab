// SPDX-License-Identifier: BSD-3-Clause
// Changes of a sweep's levels.
#include "tools/rcs/rcs_uncertainty.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>

#include "sim/core/process/error.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/geometry/shapes/generators.h"

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

// Two plates 1 km apart: more than 10^10 rays 5 mm apart would fit over both. Every trace is divided into other tiles,
// whose sums have other rounding.
TEST(ConvergedSweep, EndsAtTheLargestNumberOfRays) {
  TriangleMesh plates = make_plate(7, 3);
  plates.append(transformed(plates, Mat3::Identity(), Vec3(0, 700, 700)));
  RcsRequest request;
  request.mesh = std::make_shared<const TriangleMesh>(plates);
  request.frequency_hz = {1e9};
  request.azimuth_deg = {1};
  request.edges = false;
  request.method = SolverMethod::kRays;
  request.ray_spacing_m = 0.04;
  const RcsTarget target = prepare_rcs_target(request);
  const ConvergedSweep swept = converge_rcs(request, target, 1e-300, 1, nullptr, [](const std::string&) {});
  EXPECT_FALSE(swept.converged);
  ASSERT_EQ(swept.series.size(), 3u);
  EXPECT_EQ(swept.series.back().size_m, 0.01);
  EXPECT_TRUE(swept.result.sweep.coarser);
  EXPECT_THAT(convergence_warning(request, swept),
              testing::AllOf(testing::HasSubstr("after 2 halvings of the distance between rays; rays 0.005 m apart"),
                             testing::HasSubstr("more than 1e+10")));
  request.ray_spacing_m = 0.008;
  EXPECT_THROW(converge_rcs(request, target, 1, 1, nullptr, [](const std::string&) {}), InputError);
}

}  // namespace
}  // namespace seaglint
