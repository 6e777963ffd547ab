// SPDX-License-Identifier: BSD-3-Clause
// Reflectors that are fixed to one raft: their phases, ranges and velocities follow its rotation about one point, and
// everything else is that of free reflectors.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/motion/target_motion.h"
#include "tests/temporary_folder.h"
#include "tests/tools/pipeline/target_responses.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {
namespace {

constexpr const char* kReflector = SEAGLINT_SOURCE_DIR "/assets/icosahedral_reflector.glb";

// The target `t` in Hs 2 m, and `more` targets.
Scenario scene_of(const std::string& target, const std::string& more = "", double azimuth_deg = 60,
                  const std::filesystem::path& folder = "") {
  return parse_scenario(fmt::format(R"(
seaglint: 1
view: {{azimuth_deg: {}}}
sea: {{significant_wave_height_m: 2, peak_period_s: 8, components: 128}}
targets:
  t: {{label: 1, mesh: {}, {}}}
{}
clutter: {{enabled: false}}
dataset: {{maps_per_case: 16, realisations_per_case: 8}}
)",
                                    azimuth_deg, kReflector, target, more),
                        (folder / "raft.yaml").string());
}

std::string line_of(int count, double spacing_m, const char* bodies) {
  return fmt::format("layout: {{line: {{count: {}, spacing_m: {}}}, bodies: {}}}", count, spacing_m, bodies);
}

class RigidRaft : public testing::Test {
 protected:
  // A motion file over 20 s, steps of 0.1 s; angles in degrees at time t.
  void write_motion(const std::function<std::array<double, 3>(double)>& angles_deg) {
    std::ofstream file(folder_.path() / "motion.csv");
    file << "time_s,roll_deg,pitch_deg,yaw_deg\n";
    for (int n = 0; n <= 200; ++n) {
      const auto [roll, pitch, yaw] = angles_deg(0.1 * n);
      file << fmt::format("{:.1f},{:.12f},{:.12f},{:.12f}\n", 0.1 * n, roll, pitch, yaw);
    }
  }
  TemporaryFolder folder_;
};

// A yaw rate w gives a point at (x, 0) the range -x cos el cos az and the velocity -w x cos el sin az.
TEST_F(RigidRaft, VelocitiesGrowLinearlyAlongRangeAsOnARotatingLine) {
  const double rate_deg_s = 2, azimuth_deg = 60;
  write_motion([&](double t) { return std::array{0.0, 0.0, rate_deg_s * (t - 5)}; });
  const Scenario scenario = scene_of(
      line_of(4, 40, "rigid") + ", motion: {model: series, file: motion.csv, series_start_s: 4.968, heading: keep}", "",
      azimuth_deg, folder_.path());
  const Pipeline pipeline(scenario);  // yaw is 0 in the middle of the first interval
  SampleAddress first;
  const FullBandInterval band = full_band_interval(pipeline, pipeline.plan().sample(first));
  for (const double x : {-60.0, -20.0, 20.0, 60.0}) {
    const double el = radians(scenario.view.elevation_deg.front()), az = radians(azimuth_deg);
    const double range_m = -x * std::cos(el) * std::cos(az);
    const double velocity_mps = -radians(rate_deg_s) * x * std::cos(el) * std::sin(az);
    double peak = 0, peak_mps = 0;
    for (std::size_t v = 0; v < band.image.velocity_mps.size(); ++v) {
      for (std::size_t r = 0; r < band.image.columns(); ++r) {
        const double magnitude = std::abs(band.image.at(v, r));
        if (std::abs(band.image.range_m[r] - range_m) > 2 || magnitude <= peak) continue;
        peak = magnitude;
        peak_mps = band.image.velocity_mps[v];
      }
    }
    // Scattering centres lie within the reflector, 0.75 m from its middle, and a map has cells.
    const double cell_mps = band.image.velocity_mps[1] - band.image.velocity_mps[0];
    EXPECT_NEAR(peak_mps, velocity_mps, radians(rate_deg_s) * 0.75 + cell_mps) << x;
  }
}

// The same reflectors as one mesh that moves as one body; nothing goes from one to the other. Edges only where they are
// near each other: in one mesh of 40 m those of a reflector have errors of -36 dB (at rest too, and none in one of 4
// m).
TEST_F(RigidRaft, EchoesAsOneMeshThatHoldsItsReflectors) {
  write_motion([](double t) { return std::array{2 * std::sin(t), 1.5 * std::cos(0.8 * t), 3 * std::sin(0.5 * t)}; });
  const TriangleMesh one = read_mesh(kReflector);
  for (const double spacing_m : {4.0, 40.0}) {
    TriangleMesh whole;
    for (const double x : {-spacing_m / 2, spacing_m / 2})
      whole.append(transformed(one, Mat3::Identity(), Vec3(x, 0, 0)));
    write_mesh(folder_.path() / "whole.glb", whole);
    const std::string common = fmt::format(
        "solver: {{edges: {}}}, motion: {{model: series, file: motion.csv, rotation_centre_m: [23, 0, 1.5], "
        "origin_above_waterline_m: 0}}",
        spacing_m < 10);
    const Pipeline pipeline(scene_of(line_of(2, spacing_m, "rigid") + ", " + common,
                                     "  whole: {label: 0, mesh: whole.glb, " + common + "}", 60, folder_.path()));
    const double error_db = relative_difference_db(response_of(pipeline, 0), response_of(pipeline, 1));
    fmt::print("raft of two reflectors {} m apart against one mesh: {:.1f} dB\n", spacing_m, error_db);
    // The error of an interval against independent traces is -42 dB of a ship's echo (README.md); two intervals differ.
    EXPECT_LT(error_db, -36);
  }
}

TEST_F(RigidRaft, AtRestHasTheBytesOfFreeReflectorsAtRest) {
  const Pipeline free(scene_of(line_of(3, 17.3, "independent"))), raft(scene_of(line_of(3, 17.3, "rigid")));
  EXPECT_EQ(response_of(raft, 0), response_of(free, 0));
  EXPECT_EQ(raft.window_m(), free.window_m());
}

// The raft of a fair test: the combatant's motion, the floats' reflectors at the floats' heights.
TEST_F(RigidRaft, MovesAsTheShipWhoseDimensionsItHasWithTheFloatsGeometry) {
  const std::string ship = "motion: {model: ship, length_m: 134.6, beam_m: 17.5, translations: true}";
  const Pipeline pipeline(scene_of(line_of(4, 40, "rigid") + ", " + ship,
                                   "  ship: {label: 1, mesh: assets/combatant_144m.glb, " + ship + "}\n" +
                                       fmt::format("  array: {{label: 0, mesh: {}, {}, motion: {{model: float}}}}",
                                                   kReflector, line_of(4, 40, "independent"))));
  const auto scene = pipeline.scene(0, 0);
  const Trajectory& combatant = scene->bodies[1].front();
  for (std::size_t i = 0; i < 4; ++i) {
    const Trajectory& reflector = scene->bodies[0][i];
    const Vec3 rest = pipeline.targets()[0].rest_positions[i];
    EXPECT_EQ(rest, pipeline.targets()[2].rest_positions[i]);
    for (const double t : {0.0, 3.7, 9.9}) {
      EXPECT_EQ(reflector.sample(t).angles, combatant.sample(t).angles);
      EXPECT_EQ(reflector.sample(t).translation, combatant.sample(t).translation);
      const Pose pose = combatant.pose(t);
      EXPECT_LT((reflector.pose(t).p - (pose.p + pose.R * rest)).norm(), 1e-12);
    }
  }
}

TEST_F(RigidRaft, IsTheSameForAnyNumberOfThreadsAndInEveryRun) {
  const Scenario scenario = scene_of(line_of(4, 40, "rigid") + ", motion: {model: float, diameter_m: 10}");
  const Pipeline one(scenario), other(scenario);
  EXPECT_EQ(response_of(one, 0), response_of(other, 0));
  const Target& raft = one.targets()[0];
  const auto scene = one.scene(0, 0);
  const auto threaded = simulate_target({.target = raft.spec,
                                         .models = std::array{raft.models.front()->motion.get()},
                                         .state = scene->state,
                                         .sea = scene->sea,
                                         .duration_s = 10,
                                         .seed = scenario.seed,
                                         .threads = 3});
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(threaded[i].pose(7.7).p, scene->bodies[0][i].pose(7.7).p);
}

TEST_F(RigidRaft, IsOneInTheSeasThatDrawRigidBodies) {
  const Pipeline pipeline(
      scene_of("layout: {line: {count: 2, spacing_m: 40}, bodies: choice(independent rigid)}, "
               "motion: {model: float, diameter_m: 1}"));
  int rafts = 0;
  for (int realisation = 0; realisation < 8; ++realisation) {
    const auto scene = pipeline.scene(0, realisation);
    const std::vector<Trajectory>& bodies = scene->bodies[0];
    const bool rigid = is_raft((*scene->targets)[0].spec.layout);
    EXPECT_EQ(bodies[0].sample(5).angles == bodies[1].sample(5).angles, rigid);
    // The centre of flotation of a float is below its reflector, that of a raft between them.
    const Vec3 centre = rigid ? Vec3(20, 0, -0.75) : Vec3(0, 0, -0.75);
    const Pose pose = bodies[0].pose(5);
    EXPECT_LT((pose.p + pose.R * centre - (Vec3(-20, 0, 0.75) + centre)).norm(), 1e-12);
    rafts += rigid;
  }
  EXPECT_GT(rafts, 0);
  EXPECT_LT(rafts, 8);
}

TEST_F(RigidRaft, NeedsTheDimensionsThatNoMeshGives) {
  const auto complaint = [](const std::string& motion) {
    try {
      Pipeline{scene_of(line_of(4, 40, "rigid") + ", motion: {" + motion + "}")};
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string ship =
      "targets.t: motion.length_m, motion.beam_m: the reflectors of a rigid raft give no waterline; write both down";
  EXPECT_THAT(complaint("model: ship"), testing::HasSubstr(ship));
  EXPECT_THAT(complaint("model: ship, length_m: 134.6"), testing::HasSubstr(ship));
  EXPECT_THAT(complaint("model: float"),
              testing::HasSubstr("targets.t: motion.diameter_m: the reflectors of a rigid raft give no waterplane; "
                                 "write it down"));
}

// A raft with a slow yaw far from the reference point stays within the window.
TEST_F(RigidRaft, ReachesAsFarAsItCanTurn) {
  const Scenario scenario = scene_of(
      "layout: {line: {count: 2, spacing_m: 200, centre_y_m: 300}, bodies: rigid}, "
      "motion: {model: ship, length_m: 200, beam_m: 30}");
  EXPECT_GE(Pipeline(scenario).window_m(), 2 * (300 + 100));
}

}  // namespace
}  // namespace seaglint
