// SPDX-License-Identifier: BSD-3-Clause
// Ships and decoys that the program makes as targets of a scenario: echo and motion of their mesh files, the same bytes
// in any order, errors with their place.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <variant>

#include "sim/core/process/error.h"
#include "sim/geometry/decoy/make_decoy.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/placement/hydrostatics.h"
#include "sim/geometry/ship/make_ship.h"
#include "sim/scenario/scenario.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"
#include "tests/tools/pipeline/target_responses.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {
namespace {

class GeneratedTargets : public testing::Test {
 protected:
  // A short interval of few carriers, in waves.
  Scenario parse(const std::string& targets, int seas = 1) const {
    return parse_scenario(fmt::format(R"(
seaglint: 1
radar: {{pulses: 16, hop_count: 2, bandwidth_mhz: 10, hop_step_mhz: 10, sampling_mhz: 20}}
view: {{azimuth_deg: 50, elevation_deg: 2}}
sea: {{significant_wave_height_m: 1, peak_period_s: 7, components: 24, order: 1}}
targets:
{}
dataset: {{maps_per_case: {}, realisations_per_case: {}}}
)",
                                      targets, seas, seas),
                          (folder_.path() / "made.yaml").string());
  }
  const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
};

// Positions lie on a grid that float32 has; a file rounds normals. At rest the echoes are equal but for that. In waves
// the attitudes differ in their last digits, by the metacentric height with 15 digits: a piece of a curved face at the
// limit of kMaxCurvedHalfPhase may be cut once more, 0.1 % of it.
TEST_F(GeneratedTargets, OfAShipHaveEchoAndMotionOfItsFile) {
  const Ship ship = make_ship({.kind = ShipKind::kPatrolBoat, .length_m = 20, .seed = 3});
  write_mesh(folder() / "boat.glb", ship.mesh);
  const double gm = hydrostatics_of(ship.mesh).metacentric_height_m(ship.centre_of_gravity_m);
  const Pipeline made(
      parse("  a: {label: 0, ship: {kind: patrol_boat, length_m: 20, seed: 3}, motion: {model: ship}}"));
  const Pipeline file(parse(
      fmt::format("  a: {{label: 0, mesh: boat.glb, motion: {{model: ship, metacentric_height_m: {:.15g}}}}}", gm)));
  EXPECT_LT(relative_difference_db(response_of(made, 0), response_of(file, 0)), -60);
  const Pipeline made_at_rest(
      parse("  a: {label: 0, ship: {kind: patrol_boat, length_m: 20, seed: 3}, motion: {model: fixed}}"));
  const Pipeline file_at_rest(parse("  a: {label: 0, mesh: boat.glb, motion: {model: fixed}}"));
  EXPECT_LT(relative_difference_db(response_of(made_at_rest, 0), response_of(file_at_rest, 0)), -120);
  const auto& of_made = std::get<ShipParticulars>(made.targets()[0].models[0]->motion->model);
  const auto& of_file = std::get<ShipParticulars>(file.targets()[0].models[0]->motion->model);
  EXPECT_NEAR(of_made.metacentric_height, gm, 1e-12);
  EXPECT_NEAR(of_made.roll.omega0, of_file.roll.omega0, 1e-6 * of_file.roll.omega0);
  EXPECT_GT(made.scene({})->bodies[0][0].sample(0.01).angles.norm(), 0);
}

// Positions of 0.5 to 2 m are rounded to float32 by up to 6e-8 m: 2 k 6e-8 m of phase in each of three reflections,
// 1.2e-4, -78 dB. An edge at the limit of a piece may be cut once more: -72 dB.
TEST_F(GeneratedTargets, OfADecoyHaveTheEchoOfItsFile) {
  const DecoySpec spec{.kind = DecoyKind::kOctahedral,
                       .leg_m = 0.4,
                       .seed = 5,
                       .angle_error_deg = 1,
                       .support = DecoySupport::kFloat,
                       .mast_m = 1.1};
  write_mesh(folder() / "decoy.glb", make_decoy(spec));
  const std::string motion = "motion: {model: float, origin_above_waterline_m: 1.1}";
  const auto difference_db = [&](const std::string& solver) {
    const Pipeline made(
        parse("  a: {label: 0, decoy: {kind: octahedral, leg_m: 0.4, seed: 5, angle_error_deg: 1, "
              "support: float}, " +
              motion + solver + "}"));
    const Pipeline file(parse("  a: {label: 0, mesh: decoy.glb, " + motion + solver + "}"));
    return relative_difference_db(response_of(made, 0), response_of(file, 0));
  };
  EXPECT_LT(difference_db(", solver: {edges: false}"), -78);
  EXPECT_LT(difference_db(""), -71);
}

// The material of the lens is in the file. Its middle is the origin: positions of 0.2 m on the lens are rounded by 6e-9
// m, and its circles by ten times that.
TEST_F(GeneratedTargets, OfALensHaveTheEchoOfItsFile) {
  const DecoySpec spec{.kind = DecoyKind::kLuneburgLens,
                       .leg_m = 0.2,
                       .lens_loss_db = 1.5,
                       .support = DecoySupport::kFloat,
                       .mast_m = 1.1};
  write_mesh(folder() / "lens.glb", make_decoy(spec));
  const std::string motion = "motion: {model: float, origin_above_waterline_m: 1.1}";
  const Pipeline made(parse(
      "  a: {label: 0, decoy: {kind: luneburg_lens, leg_m: 0.2, lens_loss_db: 1.5, support: float}, " + motion + "}"));
  const Pipeline file(parse("  a: {label: 0, mesh: lens.glb, " + motion + "}"));
  EXPECT_LT(relative_difference_db(response_of(made, 0), response_of(file, 0)), -78);
}

// GM and the roll period: 2 pi 0.40 B / sqrt(g GM) by the default of the ship model.
TEST_F(GeneratedTargets, OfAShipRollByTheMetacentreOfTheirMesh) {
  const Pipeline pipeline(parse("  a: {label: 0, ship: {kind: tug, seed: 2}, motion: {model: ship}}"));
  const auto& ship = std::get<ShipParticulars>(pipeline.targets()[0].models[0]->motion->model);
  const Ship made = make_ship({.kind = ShipKind::kTug, .seed = 2});
  const Hydrostatics h = hydrostatics_of(made.mesh);
  const double gm = h.metacentric_height_m(made.centre_of_gravity_m);
  EXPECT_NEAR(ship.metacentric_height, gm, 1e-9);
  EXPECT_NEAR(ship.roll.omega0 * 0.40 * ship.beam / std::sqrt(9.80665 * gm), 1, 1e-3);
  // The sections' beam is that between the stations; 1 %.
  EXPECT_NEAR(ship.beam / h.beam_m, 1, 0.01);
}

TEST_F(GeneratedTargets, OfALayoutAreIndividualsWhereTheirImperfectionsAreRandom) {
  const auto models_of = [&](const std::string& imperfections) {
    return Pipeline(parse("  a: {label: 0, decoy: {kind: octahedral, leg_m: 0.4, seed: 5" + imperfections +
                          "}, layout: {line: {count: 3, spacing_m: 10}}, motion: {model: float}}"))
        .targets()[0]
        .models;
  };
  const auto same = models_of(", frame_mm: 10"), others = models_of(", angle_error_deg: 1");
  EXPECT_EQ(same[0], same[1]);
  EXPECT_EQ(same[0], same[2]);
  const DecoySpec first{.kind = DecoyKind::kOctahedral, .leg_m = 0.4, .seed = 5, .angle_error_deg = 1};
  for (std::size_t body = 0; body < 3; ++body)
    EXPECT_EQ(others[body]->source->mesh.vertices, make_decoy(decoy_of_body(first, body)).vertices);
  EXPECT_NE(others[1]->source->mesh.vertices, others[0]->source->mesh.vertices);
  EXPECT_NE(others[1]->source->mesh.vertices, others[2]->source->mesh.vertices);
}

TEST_F(GeneratedTargets, DrawnInEverySeaAreTheSameInAnyOrder) {
  const Scenario scenario = parse(
      "  a: {label: 0, ship: {kind: inflatable_boat, detail: hull, seed: integers(1 1000)}, motion: {model: ship}}\n"
      "  b: {label: 1, decoy: {kind: octahedral, angle_error_deg: uniform(0 1), seed: integers(1 1000)}, motion: "
      "{model: "
      "float}, companions: [{target: c, x_m: 5}]}\n"
      "  c: {role: part, decoy: {kind: icosahedral, leg_m: uniform(0.3 0.4)}, motion: {model: float}}",
      3);
  const Pipeline forward(scenario), backward(scenario);
  std::vector<std::vector<float>> values;
  for (std::size_t i = 0; i < 6; ++i) values.push_back(forward.generate_sample(i).stored.magnitude);
  for (std::size_t i = 6; i-- > 0;) EXPECT_EQ(backward.generate_sample(i).stored.magnitude, values[i]) << i;
  // Another ship in every sea.
  const auto length = [&](int sea) {
    const SampleAddress at{.realisation = sea, .target = 0};
    return forward.scene(at)->targets->front().models.front()->box.upper.x();
  };
  EXPECT_NE(length(0), length(1));
  // The scene of a target has its bodies and those of its companions alone.
  const auto scene = forward.scene({.realisation = 1, .target = 1});
  EXPECT_TRUE(scene->bodies[0].empty());
  EXPECT_EQ(scene->bodies[1].size(), 1u);
}

TEST_F(GeneratedTargets, OutOfTheirBoundsAreRefusedWithTheirPlace) {
  const auto refusal = [&](const std::string& target) {
    return refusal_of([&] { Pipeline(parse("  a: {label: 0, " + target + "}")); });
  };
  EXPECT_HAS(refusal("ship: {kind: container_ship, length_m: 8}"),
             "made.yaml:7:23: targets.a.ship: length_m: value 8: must be within 110 and 400 for a container_ship; "
             "kinds of that length: inflatable_boat");
  EXPECT_HAS(refusal("ship: {kind: trawler}"),
             "targets.a.ship.kind: value 'trawler': must be one of frigate, corvette, patrol_boat, container_ship, "
             "tanker, bulk_carrier, fishing_vessel, ferry, tug, inflatable_boat");
  EXPECT_HAS(refusal("ship: {kind: tug}, mesh: boat.glb"),
             "targets.a: must have a mesh, a ship, a decoy or points, one of them only");
  EXPECT_HAS(refusal("ship: {kind: tug}, offset_m: [0, 0, 1]"), "targets.a.offset_m: not allowed here");
  EXPECT_HAS(refusal("decoy: {kind: icosahedral, panel: square}"), "targets.a.decoy: panel: not allowed here");
  EXPECT_HAS(refusal("decoy: {kind: octahedral, leg_m: 9}"), "targets.a.decoy.leg_m: value '9': must be");
  EXPECT_HAS(refusal("decoy: {kind: octahedral, leg_m: 2, support: float}, motion: {model: float}"),
             "targets.a.decoy: the reflector's middle is 0.75 m above the water: must be above");
}

}  // namespace
}  // namespace seaglint
