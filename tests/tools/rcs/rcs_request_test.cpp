// SPDX-License-Identifier: BSD-3-Clause
// Requests for a sweep: contradictions, selections, settings of other programs.
#include "tools/rcs/rcs_request.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <unistd.h>
#include <cmath>
#include <limits>
#include <memory>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/field_tables/field_table.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/refusal.h"
#include "tools/rcs/rcs_table.h"
#include "tools/rcs/rcs_target.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

namespace fs = std::filesystem;

constexpr double kLengthM = 0.5, kWidthM = 0.3, kFrequencyHz = 10e9;

class PlateRequest : public testing::Test {
 protected:
  PlateRequest() : folder_(fs::path(testing::TempDir()) / ("rcs_request_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
    request_.target = folder_ / "plate.glb";
    write_mesh(request_.target, make_plate(kLengthM, kWidthM));
    request_.frequency_hz = {kFrequencyHz};
    request_.azimuth_deg = {0};
  }
  ~PlateRequest() override { fs::remove_all(folder_); }

  std::string refusal() const {
    try {
      requested_sweep(request_);
      prepare_rcs_target(request_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  RcsCut read_again(const RcsSweep& sweep, const Scatterer& scatterer) const {
    const fs::path file = folder_ / "table.V.csv";
    write_file(file, rcs_table(request_, scatterer, sweep));
    return read_field_table(file, {}).cuts.at(0);
  }

  fs::path folder_;
  RcsRequest request_;
};

// Normal incidence on a plate of area A: 4 pi (A / lambda)^2.
TEST_F(PlateRequest, HasThePlatesEchoAtNormalIncidence) {
  const double expected = dbsm(kLengthM * kWidthM * kFrequencyHz / kSpeedOfLight);
  request_.physical_optics_too = true;
  const RcsTarget target = prepare_rcs_target(request_);
  const RcsResult result = compute_rcs(request_, target, 1);
  ASSERT_EQ(result.sweep.models.size(), 2u);
  EXPECT_FALSE(result.sweep.models[0].edge_diffraction);
  EXPECT_TRUE(result.sweep.models[1].edge_diffraction);
  EXPECT_NEAR(dbsm(result.sweep.models[0].matrices[0][0][0]), expected, 1e-6);
  EXPECT_NEAR(dbsm(result.sweep.models[1].matrices[0][0][3]), expected, 0.1);
}

// The plate as two files in different units, which share an edge: the same echo, and no edge between them.
TEST_F(PlateRequest, HasTheEchoOfAllItsFilesTogether) {
  request_.azimuth_deg = {0, 20, 50};
  const auto echo = [&] { return compute_rcs(request_, prepare_rcs_target(request_), 1).sweep.models.back().matrices; };
  const auto whole = echo();
  const TriangleMesh plate = read_mesh(request_.target);
  const Bounds box = bounds(plate);
  const auto write_half = [&](const char* name, double from, double to, double scale) {
    std::string text;
    for (const double y : {from, to}) {
      for (const double z : {box.lower.z(), box.upper.z()})
        text += fmt::format("v {} {} {}\n", box.lower.x() * scale, y * scale, z * scale);
    }
    write_file(folder_ / name, text + "f 1 3 4 2\n");
    return folder_ / name;
  };
  const double middle = 0.3 * box.lower.y() + 0.7 * box.upper.y();
  set_target_files(request_, std::vector<GeometryFile>{{write_half("left.obj", box.lower.y(), middle, 1), "m"},
                                                       {write_half("right.obj", middle, box.upper.y(), 1000), "mm"}});
  EXPECT_EQ(request_.target, "left.obj + right.obj");
  ASSERT_TRUE(request_.mesh);
  EXPECT_THAT(request_.mesh->part_names, testing::ElementsAre("left", "right"));
  const auto halves = echo();
  // Rays are traced in single precision, 6e-8 of the plate's length, whose phase is 2 k L = 210 rad.
  const double tolerance = 6e-8 * 2 * (2 * kPi * kFrequencyHz / kSpeedOfLight) * kLengthM;
  for (std::size_t view = 0; view < 3; ++view) {
    for (const std::size_t element : {0, 3})
      EXPECT_LT(std::abs(halves[view][0][element] - whole[view][0][element]), tolerance * std::abs(whole[0][0][0]));
  }
}

TEST_F(PlateRequest, WritesATableWithItsTransmitter) {
  const RcsTarget target = prepare_rcs_target(request_);
  const RcsCut monostatic = read_again(compute_rcs(request_, target, 1).sweep, *target.prepared.scatterer);
  ASSERT_TRUE(monostatic.transmitter);
  EXPECT_TRUE(monostatic.transmitter->is_monostatic);
  ASSERT_EQ(monostatic.values.size(), 1u);

  request_.transmitter = FixedTransmitter{-20, 30.5};
  const RcsCut bistatic = read_again(compute_rcs(request_, target, 1).sweep, *target.prepared.scatterer);
  ASSERT_TRUE(bistatic.transmitter);
  EXPECT_FALSE(bistatic.transmitter->is_monostatic);
  EXPECT_EQ(bistatic.transmitter->theta_deg, 59.5);
  EXPECT_EQ(bistatic.transmitter->phi_deg, 340);
}

TEST_F(PlateRequest, IsRefusedWhenContradictory) {
  EXPECT_EQ(refusal(), "");
  request_.exports.centres = folder_ / "centres.csv";
  request_.azimuth_deg = {0, 1};
  EXPECT_THAT(refusal(), HasSubstr("one frequency, azimuth and elevation; there are 2 rows"));
  request_.exports.centres.clear();
  request_.selection.only = {"part=mast"};
  EXPECT_THAT(refusal(), HasSubstr("no part 'mast'"));
  request_.azimuth_deg.clear();
  EXPECT_THAT(refusal(), HasSubstr("no frequency, azimuth or elevation"));
}

TEST_F(PlateRequest, IsRefusedWithWhatItsMethodDoesNotHave) {
  request_.ray_spacing_m = 0.01;
  EXPECT_EQ(refusal(), "--ray-spacing-m: value 0.01: valid only with --method rays; beams have --min-patch-m");
  request_.method = SolverMethod::kRays;
  EXPECT_EQ(refusal(), "");
  request_.cavities.parts = {"duct"};
  EXPECT_EQ(refusal(), "--cavity does not support --method rays: only beams end at the walls of cavities");
  EXPECT_THROW(solver_method_of("ray"), InputError);
  EXPECT_EQ(solver_method_of("rays"), SolverMethod::kRays);
}

TEST_F(PlateRequest, IsTracedWithItsMethod) {
  request_.method = SolverMethod::kRays;
  request_.ray_spacing_m = 0.01;
  const RcsTarget target = prepare_rcs_target(request_);
  const TracingSettings settings = settings_of(request_, target, true);
  EXPECT_EQ(settings.method, SolverMethod::kRays);
  EXPECT_EQ(settings.ray_spacing_m, 0.01);
}

TEST_F(PlateRequest, HeadsItsTableWithAMethodOtherThanBeams) {
  const RcsTarget target = prepare_rcs_target(request_);
  const RcsSweep sweep = compute_rcs(request_, target, 1).sweep;
  const auto head = [&] { return rcs_table(request_, *target.prepared.scatterer, sweep); };
  EXPECT_THAT(head(), testing::AllOf(HasSubstr(", min_patch_m 2.04083e-05\n"), testing::Not(HasSubstr("method"))));
  request_.method = SolverMethod::kRays;
  EXPECT_THAT(head(), HasSubstr(", min_patch_m 2.04083e-05, method rays, ray_spacing_m 4.37321e-05\n"));
  EXPECT_EQ(read_again(sweep, *target.prepared.scatterer).values.size(), 1u);
}

TEST_F(PlateRequest, HeadsItsTableWithTheMaterialsThatTheMeshNames) {
  const auto head = [&] { return rcs_heading(request_, *prepare_mesh(request_).scatterer, "rcs"); };
  EXPECT_THAT(head(), HasSubstr("# material pec, contributions: all\n"));
  auto mesh = std::make_shared<TriangleMesh>(make_plate(1, 1));
  mesh->materials = {{"stainless_steel"}};
  request_.mesh = mesh;
  EXPECT_THAT(head(), HasSubstr("# material pec, of the mesh: stainless_steel, contributions: all\n"));
  request_.materials = {{"*", "aluminium", ""}};
  EXPECT_THAT(head(), HasSubstr("# material *=aluminium, contributions: all\n"));
}

TEST_F(PlateRequest, WarnsOfReceiversBehindTheTarget) {
  EXPECT_TRUE(request_warnings(request_).empty());
  request_.transmitter = FixedTransmitter{150, 0};
  ASSERT_EQ(request_warnings(request_).size(), 1u);
  EXPECT_THAT(request_warnings(request_).front(), HasSubstr("receivers up to 150 deg from the transmitter"));
}

// A box 8 m by 3 m from z = -1 to 2 m, with a mast on it, 0.2 m by 0.3 m.
class HullInWater : public testing::Test {
 protected:
  HullInWater() {
    request_.target = "hull";
    request_.mesh = hull_from(-1);
    request_.frequency_hz = {kFrequencyHz};
    request_.azimuth_deg = {0, 25, 90, 140};
    request_.elevation_deg = {3};
    request_.by_part = true;
  }

  static std::shared_ptr<const TriangleMesh> hull_from(double bottom_m) {
    MeshBuilder builder;
    builder.begin_part("hull");
    add_box(builder, upright({0, 0, bottom_m}), {8, 3, 2 - bottom_m});
    builder.begin_part("mast");
    add_box(builder, upright({1, 0.2, 2}), {0.2, 0.3, 1.5});
    return std::make_shared<TriangleMesh>(builder.take());
  }
  RcsSweep sweep() const { return compute_rcs(request_, prepare_rcs_target(request_), 1).sweep; }
  std::string refusal() const {
    return refusal_of([&] { prepare_rcs_target(request_); });
  }

  RcsRequest request_;
};

// Rays are traced in single precision, 6e-8 of 8 m, whose phase is 2 k L.
TEST_F(HullInWater, HasTheEchoOfTheHullThatEndsAtTheWaterline) {
  const double tolerance = 6e-8 * 2 * (2 * kPi * kFrequencyHz / kSpeedOfLight) * 8;
  const RcsSweep uncut = sweep();
  request_.waterline_m = 0;
  const PreparedTarget cut = prepare_mesh(request_);
  EXPECT_EQ(bounds(cut.mesh).lower.z(), 0);
  EXPECT_NEAR(surface_area(cut.mesh), 2 * (8 * 3 + 8 * 2 + 3 * 2) + 2 * (0.2 * 0.3 + 0.2 * 1.5 + 0.3 * 1.5), 1e-9);
  EXPECT_THAT(cut.warnings, testing::Contains(HasSubstr("46 m^2 of its surface, down to 1 m below the water, is cut "
                                                        "off at the waterline, z = 0 m")));
  const RcsSweep above = sweep();
  request_.waterline_m.reset();
  request_.mesh = hull_from(0);
  const RcsSweep drawn = sweep();
  for (std::size_t view = 0; view < 4; ++view) {
    const auto of = [&](const RcsSweep& from, std::size_t e) { return from.models.back().matrices[view][0][e]; };
    for (const std::size_t e : kCoPolar) {
      EXPECT_LT(std::abs(of(above, e) - of(drawn, e)), tolerance * std::abs(of(drawn, e))) << view << ' ' << e;
      EXPECT_GT(std::abs(of(uncut, e) - of(drawn, e)), 0.01 * std::abs(of(drawn, e))) << view << ' ' << e;
    }
  }
}

// The waterline is that of the placed mesh: here of one in millimetres, 1 m higher.
TEST_F(HullInWater, IsCutAsItIsPlaced) {
  request_.waterline_m = 0;
  const TriangleMesh expected = prepare_mesh(request_).mesh;
  request_.scale = 1e-3;
  request_.mesh = std::make_shared<TriangleMesh>(enlarged(*request_.mesh, 1000));
  request_.offset_m = {0, 0, 1};
  request_.waterline_m = 1;
  const PreparedTarget placed = prepare_mesh(request_);
  EXPECT_EQ(bounds(placed.mesh).lower.z(), 1);
  EXPECT_NEAR(surface_area(placed.mesh), surface_area(expected), 1e-9);
  EXPECT_THAT(rcs_heading(request_, *placed.scatterer, "rcs"),
              HasSubstr("hull unit m scale 0.001 offset_m 0,0,1 waterline_m 1: "));
}

TEST_F(HullInWater, IsRefusedWhereAllOfItIsBelowOrTheSeaReflects) {
  const char* below = "else the whole target is under water";
  for (const double height : {3.5, 4.0, std::numeric_limits<double>::quiet_NaN()}) {
    request_.waterline_m = height;
    EXPECT_HAS(refusal(), "--waterline-m: value ");
    EXPECT_HAS(refusal(), "must be less than 3.5, " + std::string(below));
  }
  request_.waterline_m = 3.4;
  EXPECT_EQ(refusal(), "accepted");
  request_.sea.reflection = true;
  request_.sea.height_m = 0.5;
  EXPECT_HAS(refusal(), "--waterline-m 3.4: with --sea-reflection the water is where --origin-height-m says: z = -0.5");
}

// Nothing is below: as without the option.
TEST_F(HullInWater, IsUnchangedWhereNothingIsBelow) {
  const RcsSweep plain = sweep();
  request_.waterline_m = -1;
  EXPECT_EQ(sweep().models.back().matrices, plain.models.back().matrices);
}

TEST(LikePrograms, SetFacetsEdgesAndBounces) {
  EXPECT_THAT(like_names(), ElementsAre("hfss", "feko", "cst"));
  const RcsRequest hfss = solved_like({}, like_program("hfss"));
  EXPECT_EQ(hfss.crease_deg, 0);
  EXPECT_FALSE(hfss.edges);
  EXPECT_EQ(hfss.max_bounces, 3);
  EXPECT_EQ(solver_text(hfss), "flat facets, no edge diffraction, at most 3 bounces, method beams (--like hfss)");
  const RcsRequest cst = solved_like({}, like_program("cst"));
  EXPECT_FALSE(cst.crease_deg);
  EXPECT_FALSE(cst.edges);
  EXPECT_EQ(solver_text({}),
            "surfaces smooth as the mesh says, with edge diffraction, at most 40 bounces, method beams");
}

TEST(LikePrograms, LeaveWhatIsGiven) {
  RcsRequest request;
  request.crease_deg = 12;
  request.max_bounces = 5;
  const RcsRequest kept =
      solved_like(request, like_program("hfss"), {.crease = true, .edges = true, .max_bounces = true});
  EXPECT_EQ(kept.crease_deg, 12);
  EXPECT_TRUE(kept.edges);
  EXPECT_EQ(kept.max_bounces, 5);
  EXPECT_EQ(solved_like(request, like_program("hfss"), {.max_bounces = true}).crease_deg, 0);
}

TEST(LikePrograms, AreRecognisedByTheReaderOfAFile) {
  EXPECT_STREQ(like_program_of_reader("an export of PyAEDT")->name, "hfss");
  EXPECT_STREQ(like_program_of_reader("an HFSS table")->name, "hfss");
  EXPECT_STREQ(like_program_of_reader("a FEKO far field")->name, "feko");
  EXPECT_STREQ(like_program_of_reader("a CST farfield table")->name, "cst");
  EXPECT_EQ(like_program_of_reader("a table of seaglint rcs"), nullptr);
  try {
    like_program("xpatch");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("like: value 'xpatch': must be one of hfss, feko, cst"));
  }
}

}  // namespace
}  // namespace seaglint
