// SPDX-License-Identifier: BSD-3-Clause
// Estimates of a sweep's uncertainty, and the convergence with the smallest patch.
#include "tools/rcs/rcs_uncertainty.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>

#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/field_tables/field_table.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/geometry/shapes/generators.h"
#include "tools/rcs/rcs_table.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace fs = std::filesystem;

// A sweep of views with these echoes and estimates, hh equal to vv.
RcsSweep sweep_of(const std::vector<double>& echo, const std::vector<ViewUncertainty>& uncertainty) {
  RcsSweep sweep;
  sweep.frequency_hz = {10e9};
  sweep.elevation_deg = {5};
  sweep.models = {{"po", false, {}}};
  for (std::size_t view = 0; view < echo.size(); ++view) {
    sweep.azimuth_deg.push_back(10 * static_cast<double>(view));
    sweep.models[0].matrices.push_back({std::array<Complex, 4>{echo[view], 0, 0, echo[view]}});
  }
  sweep.uncertainty = uncertainty;
  return sweep;
}

ViewUncertainty flat_less_smooth(float by, std::uint16_t part) {
  ViewUncertainty view;
  view.flat_less_smooth = {by, by};
  view.flat_part = part;
  return view;
}

const std::vector<std::string> kParts{"hull", "mast"};

TEST(UncertaintyWarnings, NameTheNumberOfViewsTheWorstOneAndItsPart) {
  // 0, 20 lg 1.5 = 3.5, 20 lg 0.5 = -6.0 dB
  const RcsSweep sweep = sweep_of({1, 2, 2}, {flat_less_smooth(0, 0), flat_less_smooth(1, 0), flat_less_smooth(-1, 1)});
  EXPECT_NEAR(flat_over_smooth_db(sweep, 2, 1), 20 * std::log10(0.5), 1e-6);
  EXPECT_THAT(uncertainty_warnings(sweep, kParts),
              ElementsAre(testing::AllOf(HasSubstr("part 'mast': with flat facets"), HasSubstr("2 of 3 views"),
                                         HasSubstr("-6.0 dB at azimuth 20, elevation 5 deg, hh"))));
}

TEST(UncertaintyWarnings, IgnoreViewsThirtyDecibelsBelowTheHighest) {
  EXPECT_THAT(uncertainty_warnings(sweep_of({1, 0.03}, {{}, flat_less_smooth(0.03F, 0)}), kParts), IsEmpty());
  EXPECT_EQ(uncertainty_warnings(sweep_of({1, 0.04}, {{}, flat_less_smooth(0.04F, 0)}), kParts).size(), 1u);
  EXPECT_THAT(uncertainty_warnings(sweep_of({0}, {{}}), kParts), IsEmpty());
}

TEST(UncertaintyWarnings, NameDisplacedVerticesAndCavities) {
  ViewUncertainty view;
  view.displaced = {0.5, 1.2F};
  view.displaced_part = 1;
  view.in_cavity[0] = {0, 1.8F};
  EXPECT_THAT(uncertainty_warnings(sweep_of({2}, {view}), kParts),
              ElementsAre(testing::AllOf(HasSubstr("part 'mast'"), HasSubstr("most by 0.6 at azimuth 0")),
                          testing::AllOf(HasSubstr("part 'hull': 4 or more reflections"), HasSubstr("most 0.9 at"))));
}

TEST(UncertaintyWarnings, NameTheDifferenceOfCrossPolarisationsForOneAntenna) {
  ViewUncertainty view;
  view.non_reciprocal = 0.8F;
  view.non_reciprocal_part = 1;
  RcsSweep sweep = sweep_of({2}, {view});
  EXPECT_THAT(uncertainty_warnings(sweep, kParts),
              ElementsAre(testing::AllOf(HasSubstr("part 'mast': hv and vh"), HasSubstr("most 0.4 at"))));
  sweep.transmitter = Vec3::UnitX();
  EXPECT_THAT(uncertainty_warnings(sweep, kParts), IsEmpty());
}

class UncertainCylinder : public testing::Test {
 protected:
  UncertainCylinder() : folder_(fs::path(testing::TempDir()) / ("rcs_uncertainty_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
    request_.target = folder_ / "cylinder.obj";
    write_mesh(request_.target, make_cylinder(0.5, 1, 48));
    request_.frequency_hz = {10e9, 10.1e9};
    request_.azimuth_deg = {20, 21, 22};
    request_.uncertainty = true;
  }
  ~UncertainCylinder() override { fs::remove_all(folder_); }

  fs::path folder_;
  RcsRequest request_;
};

// The estimate is that of the same polygons but for the smallest patches.
TEST_F(UncertainCylinder, HasTheEchoOfFlatFacetsAfterThePromisedColumns) {
  constexpr double kSmallestPatches_db = 0.1, kPrinted = 1e-4;
  const RcsTarget target = prepare_rcs_target(request_);
  const RcsSweep sweep = compute_rcs(request_, target, 1).sweep;
  ASSERT_TRUE(sweep.flat);
  RcsRequest flat = request_;
  flat.uncertainty = false;
  flat.crease_deg = 0;
  const RcsSweep of_flat = compute_rcs(flat, prepare_rcs_target(flat), 1).sweep;
  EXPECT_EQ(sweep.flat->matrices, of_flat.models.back().matrices);
  EXPECT_EQ(compute_rcs(request_, target, 2).sweep.flat->matrices, sweep.flat->matrices);

  const std::vector<std::string> warnings = uncertainty_warnings(sweep, target.prepared.mesh.part_names);
  ASSERT_EQ(warnings.size(), 1u);
  const std::string table = rcs_table(request_, *target.prepared.scatterer, sweep, warnings);
  EXPECT_THAT(table, HasSubstr("# warning: part '" + target.prepared.mesh.part_names[0] + "': with flat facets"));
  EXPECT_THAT(table, HasSubstr(",hh_dbsm,vv_dbsm,hh_flat_over_smooth_db,vv_flat_over_smooth_db,hh_vertex_change,"
                               "vv_vertex_change\n"));
  for (std::size_t view = 0; view < sweep.views(); ++view) {
    const double computed =
        dbsm(of_flat.models.back().matrices[view][0][3]) - dbsm(sweep.models.back().matrices[view][0][3]);
    EXPECT_NEAR(flat_over_smooth_db(sweep, view, 1), computed, kSmallestPatches_db);
    EXPECT_NEAR(std::stod(uncertainty_cells(sweep, view, 0).substr(uncertainty_cells(sweep, view, 0).find(',', 1) + 1)),
                computed, kPrinted);
  }
  // Still a reference, with or without these columns.
  write_file(folder_ / "table.V.csv", table);
  EXPECT_EQ(read_field_table(folder_ / "table.V.csv", {}).cuts.at(0).values.size(), sweep.rows());
}

TEST_F(UncertainCylinder, IsDrawn) {
  const RcsSweep sweep = compute_rcs(request_, prepare_rcs_target(request_), 1).sweep;
  write_figure(uncertainty_plots(sweep), folder_ / "azimuth.svg");
  EXPECT_THAT(read_file(folder_ / "azimuth.svg"), HasSubstr("to flat facets"));
  request_.azimuth_deg = {20};
  EXPECT_EQ(uncertainty_plots(compute_rcs(request_, prepare_rcs_target(request_), 1).sweep).plots.size(), 2u);
  request_.frequency_hz = {10e9};
  EXPECT_TRUE(uncertainty_plots(compute_rcs(request_, prepare_rcs_target(request_), 1).sweep).plots.empty());
}

TEST_F(UncertainCylinder, IsRefusedWhereAllFacetsAreFlat) {
  request_.crease_deg = 0;
  EXPECT_THROW(requested_sweep(request_), InputError);
}

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
