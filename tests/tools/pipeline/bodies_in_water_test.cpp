// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <set>
#include <utility>
#include <variant>

#include "sim/core/numbers/constants.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/placement/target_mesh.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/motion/target_motion.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"
#include "tests/tools/pipeline/target_responses.h"
#include "tools/pipeline/imaging.h"
#include "tools/pipeline/pipeline.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// What is below the water does not scatter: a body that the program cuts has the echo of one that is drawn to its
// waterline, and a mesh with other axes and another origin that of the mesh in the body frame.

// Heights below 1e-9 m are left out of facets, times 2 k = 670 1/m at 16 GHz: 7e-7 of the echo.
constexpr double kRounding_db = -120;
// Where the sea reflects, the submerged part enlarges the bounding sphere and with it the smallest patch, 0.7e-4 of its
// radius: a square of 0.4 mm in 40 m^2, at -80 dB of the area, of which the echo has the difference of two sizes.
constexpr double kPatches_db = -90;

class BodiesInWater : public testing::Test {
 protected:
  // A hull of 10 x 4 m with sloping sides, and a house, from z = -1 to 3 m; and as it is drawn to z = `waterline`.
  void write_hulls(double waterline) {
    write(folder_.path() / "whole.obj", -1);
    write(folder_.path() / "cut.obj", waterline);
  }

  Scenario scene_of(const std::string& targets, const std::string& more = "", double azimuth_deg = 75) const {
    return parse_scenario(fmt::format("seaglint: 1\n"
                                      "radar: {{pulses: 16, hop_count: 8}}\n"
                                      "view: {{azimuth_deg: {}, elevation_deg: 3}}\n"
                                      "sea: {{significant_wave_height_m: 1, components: 64}}\n"
                                      "targets:\n{}\n{}\n"
                                      "dataset: {{maps_per_case: 4, realisations_per_case: 2}}\n",
                                      azimuth_deg, targets, more),
                          (folder_.path() / "water.yaml").string());
  }
  static std::string target(const std::string& name, const std::string& mesh, const std::string& more) {
    return fmt::format("  {}: {{label: {}, mesh: {}, {}}}\n", name, name == "a" ? 0 : 1, mesh, more);
  }
  // Difference of the responses of the whole hull with `more` and of the cut one, dB.
  double difference_db(const std::string& more, const std::string& of_scenario = "") const {
    const Pipeline pipeline(scene_of(target("a", "whole.obj", more) + target("b", "cut.obj", more), of_scenario));
    return relative_difference_db(response_of(pipeline, 0), response_of(pipeline, 1));
  }

  static void write(const std::filesystem::path& file, double bottom) {
    TriangleMesh hull;
    const auto half_breadth = [](double z) { return 2 + 0.25 * z; };
    const auto add = [&](double low, double high, double half_length, const auto& half) {
      const auto first = static_cast<std::uint32_t>(hull.vertices.size());
      for (const double z : {low, high})
        for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
          hull.vertices.emplace_back(x * half_length, y * half(z), z);
      constexpr std::uint32_t kQuads[] = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7};
      for (const std::uint32_t* corner = kQuads; corner != std::end(kQuads); corner += 4)
        for (const int i : {1, 2})
          hull.triangles.push_back({first + corner[0], first + corner[i], first + corner[i + 1]});
    };
    add(bottom, 1, 5, half_breadth);
    add(1, 3, 2, [](double) { return 1.0; });
    hull.part_names = {"hull"};
    hull.materials = {Material{}};
    hull.triangle_part.assign(hull.triangles.size(), 0);
    hull.triangle_material.assign(hull.triangles.size(), 0);
    write_mesh(file, hull);
  }

  TemporaryFolder folder_;
};

TEST_F(BodiesInWater, OfAWholeHullHasTheEchoOfTheHullDrawnToItByBothMethods) {
  write_hulls(0);
  for (const std::string method : {"beams", "rays"}) {
    const double error_db = difference_db("motion: {model: fixed}, solver: {method: " + method +
                                          (method == "rays" ? ", ray_spacing_m: 0.004}" : "}"));
    fmt::print("by {}: {:.0f} dB\n", method, error_db);
    EXPECT_LT(error_db, kRounding_db) << method;
  }
}

// Where the sea reflects, the submerged part remains as an occluder without an echo.
TEST_F(BodiesInWater, HoldsWhereTheSeaReflectsToo) {
  write_hulls(0);
  for (const char* paths : {"all", "direct_only", "multipath_only"}) {
    const double error_db =
        difference_db("motion: {model: fixed}", fmt::format("sea_reflection: {{enabled: true, paths: {}}}", paths));
    EXPECT_LT(error_db, kPatches_db) << paths;
  }
}

TEST_F(BodiesInWater, GrowsWithTheMeshAndFollowsTheHeightOfEveryBody) {
  write_hulls(0);
  EXPECT_LT(difference_db("scale: 1.7, motion: {model: fixed}"), kRounding_db);
  write_hulls(-0.75);  // 0.75 m above the water
  EXPECT_LT(difference_db("motion: {model: float, diameter_m: 3}"), kRounding_db);
  EXPECT_LT(difference_db("layout: {line: {count: 2, spacing_m: 30}, bodies: rigid}, motion: {model: ship, length_m: "
                          "60, beam_m: 9}"),
            kRounding_db);
  EXPECT_LT(difference_db("offset_m: [1, 0, 0.75], motion: {model: fixed}"), kRounding_db);
  EXPECT_LT(difference_db("layout: {line: {count: 2, spacing_m: 30}, heights: {lowest_m: 0.75, highest_m: 0.75}}, "
                          "motion: {model: fixed}"),
            kRounding_db);
}

// Bodies of one layout in the water at different heights: the sum of two targets with one body each.
TEST_F(BodiesInWater, IsThatOfEachBodyOfALayout) {
  write_hulls(0);
  const Pipeline pipeline(scene_of(
      target("a", "whole.obj", "layout: {line: {count: 6, spacing_m: 20}, heights: {lowest_m: -0.9, highest_m: 2}}")));
  std::set<const PreparedTarget*> prepared;
  std::vector<double> lowest_m;
  const Target& layout = pipeline.targets()[0];
  for (std::size_t i = 0; i < layout.models.size(); ++i) {
    prepared.insert(layout.models[i]->prepared.get());
    const double rest_m = layout.rest_positions[i].z();
    EXPECT_NEAR(bounds(layout.models[i]->prepared->mesh).lower.z() + rest_m, std::max(0.0, rest_m - 1), 1e-12);
    lowest_m.push_back(rest_m);
  }
  EXPECT_LT(*std::ranges::min_element(lowest_m), 0.5);
  EXPECT_GT(*std::ranges::max_element(lowest_m), 1);
  EXPECT_GT(prepared.size(), 1u);
  EXPECT_LE(prepared.size(), 6u);
}

TEST_F(BodiesInWater, CutsCompanionsAndParts) {
  write_hulls(0);
  const auto scene = [&](const char* mesh) {
    return scene_of(
        "  host: {label: 1, points: [{position_m: [0, 0, 5]}], companions: [{target: guest, x_m: 12, y_m: 7}]}\n"
        "  guest: {role: part, mesh: " +
        std::string(mesh) + "}\n");
  };
  const Pipeline whole(scene("whole.obj")), cut(scene("cut.obj"));
  EXPECT_LT(relative_difference_db(response_of(whole, 0), response_of(cut, 0)), kRounding_db);
  EXPECT_THAT(mesh_warnings(whole), ElementsAre(HasSubstr("targets.guest.mesh: ")));
  EXPECT_THAT(mesh_warnings(cut), IsEmpty());
}

TEST_F(BodiesInWater, FollowsADrawnScale) {
  write_hulls(0);
  const Pipeline pipeline(scene_of(target("a", "whole.obj", "scale: uniform(0.5 2)") +
                                   target("b", "cut.obj", "scale: same(targets.a.scale)")));
  for (int realisation = 0; realisation < 2; ++realisation) {
    SampleAddress at;
    at.realisation = realisation;
    const auto first = pipeline.response(at, pipeline.pulse_train(0)).response.values;
    at.target = 1;
    EXPECT_LT(relative_difference_db(first, pipeline.response(at, pipeline.pulse_train(0)).response.values),
              kRounding_db);
  }
}

// The strip theory has the sections of the whole hull, not those of the cut one.
TEST_F(BodiesInWater, LeavesTheMotionOfTheWholeHull) {
  write_hulls(0);
  const Pipeline pipeline(scene_of(target("a", "whole.obj", "motion: {model: ship}")));
  const auto& ship = std::get<ShipParticulars>(pipeline.targets()[0].models[0]->motion->model);
  EXPECT_NEAR(ship.draught, 1, 1e-9);
  EXPECT_NEAR(ship.length, 10, 1e-9);
  EXPECT_NEAR(bounds(pipeline.targets()[0].models[0]->prepared->mesh).lower.z(), 0, 0);
}

TEST_F(BodiesInWater, IsReportedWithAreaAndDepthOfTheTarget) {
  write_hulls(0);
  EXPECT_THAT(mesh_warnings(Pipeline(scene_of(target("a", "whole.obj", "motion: {model: fixed}")))),
              ElementsAre(HasSubstr("targets.a.mesh: ")));
  // bottom 10 x 3.5, two sides 10 x sqrt(1 + 1/16), two ends of breadth 3.5 to 4
  EXPECT_HAS(mesh_warnings(Pipeline(scene_of(target("a", "whole.obj", "motion: {model: fixed}"))))[0],
             "63.1 m^2 of its surface, down to 1 m below the water, is cut off");
  EXPECT_THAT(mesh_warnings(Pipeline(scene_of(target("a", "cut.obj", "motion: {model: fixed}")))), IsEmpty());
}

TEST_F(BodiesInWater, NamesBodiesThatHover) {
  write_hulls(0);
  const auto warnings = [&](const std::string& more) {
    return motion_warnings(Pipeline(scene_of(target("a", "cut.obj", more))).targets());
  };
  const std::string ship = "motion: {model: ship, length_m: 10, beam_m: 4}";
  EXPECT_THAT(warnings(ship), IsEmpty());
  EXPECT_THAT(warnings(ship + ", offset_m: [0, 0, 2]"),
              ElementsAre(HasSubstr("targets.a.mesh: its lowest point is 2 m above the water")));
  EXPECT_THAT(warnings("motion: {model: float}"), ElementsAre(HasSubstr("0.75 m above the water")));
  EXPECT_THAT(warnings("motion: {model: float, origin_above_waterline_m: 0}"), IsEmpty());
  EXPECT_THAT(warnings("motion: {model: fixed}, offset_m: [0, 0, 2]"), IsEmpty());
  EXPECT_THAT(warnings("layout: {line: {count: 1}, heights: {lowest_m: 5, highest_m: 5}}, motion: {model: float}"),
              IsEmpty());
  // The reflectors of the shipped scenarios are above floats that are not part of the mesh.
  write_mesh(folder_.path() / "reflector.glb", make_icosahedral_reflector());
  EXPECT_THAT(motion_warnings(Pipeline(scene_of(target("a", "reflector.glb", "motion: {model: float}"))).targets()),
              IsEmpty());
}

TEST_F(BodiesInWater, RefusesBodiesThatAreUnderIt) {
  write_hulls(0);
  const auto complaint = [&](const std::string& more) {
    return refusal_of([&] { Pipeline pipeline(scene_of(target("a", "whole.obj", more))); });
  };
  EXPECT_HAS(complaint("offset_m: [0, 0, -5]"),
             "targets.a.mesh: its highest point is at z = -2 m: must be above 0, the water, else the whole "
             "target is under water; offset_m lifts it");
  EXPECT_HAS(complaint("motion: {model: float, origin_above_waterline_m: -4}"),
             "origin_above_waterline_m: value -4: must be greater than -3, else");
  EXPECT_HAS(complaint("layout: {line: {count: 1}, heights: {lowest_m: -4, highest_m: -4}}"),
             "targets.a.layout.heights: body 1 reaches up to -1 m above the water");
  // drawn: refused before the first map
  EXPECT_HAS(complaint("motion: {model: float, diameter_m: 3, origin_above_waterline_m: choice(-4 0)}"),
             "value -4: must be greater than -3");
  EXPECT_EQ(complaint("motion: {model: fixed}"), "accepted");
}

// The law of orientation and offset_m.
TEST_F(BodiesInWater, OfATurnedMeshOfAnotherOriginIsThatOfTheMeshInTheBodyFrame) {
  write_hulls(0);
  const TriangleMesh whole = read_mesh(folder_.path() / "whole.obj");
  for (const auto& [forward, up] : {std::pair{"+y", "+z"}, {"-x", "+z"}, {"+z", "+y"}, {"-y", "-x"}, {"+x", "-z"}}) {
    MeshPlacement placement;
    placement.forward = forward;
    placement.up = up;
    // p = R q + offset: the file has q = R^T (p - offset).
    const Mat3 to_file = rotation_of(placement).transpose();
    const Vec3 offset(0.5, -0.25, 1.125);
    TriangleMesh file = transformed(whole, to_file, -(to_file * offset));
    write_mesh(folder_.path() / "turned.obj", file);
    const Pipeline pipeline(
        scene_of(target("a", "whole.obj", "motion: {model: ship}") +
                 target("b", "turned.obj",
                        fmt::format("orientation: {{forward: {}, up: {}}}, offset_m: [0.5, -0.25, 1.125], motion: "
                                    "{{model: ship}}",
                                    forward, up))));
    EXPECT_LT(relative_difference_db(response_of(pipeline, 1), response_of(pipeline, 0)), kRounding_db)
        << forward << up;
  }
}

TEST_F(BodiesInWater, OfAShipWithOtherAxesIsAFindingThatNamesTheKey) {
  const std::string hulls = SEAGLINT_SOURCE_DIR "/tests/cases/hulls/";
  const auto findings = [&](const std::string& mesh, const std::string& more) {
    return motion_warnings(Pipeline(scene_of(target("a", mesh, more))).targets());
  };
  const std::string ship = "motion: {model: ship}";
  EXPECT_THAT(
      findings(hulls + "06_bow_along_y.obj", ship),
      ElementsAre(HasSubstr("targets.a.mesh: the hull is 12 m long (x), 30 m broad (y) and 6 m high (z): broader "
                            "than long; if its bow is not along x or its masts are not along z, "
                            "orientation.forward: +y (or -y) turns it")));
  EXPECT_THAT(findings(hulls + "06_bow_along_x.obj", ship), IsEmpty());
  EXPECT_THAT(findings(hulls + "06_bow_along_y.obj", ship + ", orientation: {forward: +y}"), IsEmpty());
  EXPECT_THAT(findings(hulls + "06_bow_along_x.obj", ship + ", orientation: {up: +y}"),
              ElementsAre(HasSubstr("6 m broad (y) and 12 m high (z): higher than broad")));
  EXPECT_THAT(findings(hulls + "06_bow_along_y.obj", "motion: {model: fixed}"), IsEmpty());
  // The combatant's masts reach further up than its beam is wide.
  EXPECT_THAT(findings("assets/combatant_144m.glb", ship), IsEmpty());
  // With its masts along y and the centreline in the plane z = 0.
  const TriangleMesh combatant = read_mesh(SEAGLINT_SOURCE_DIR "/assets/combatant_144m.glb");
  MeshPlacement on_side;
  on_side.up = "-y";
  write_mesh(folder_.path() / "side.glb", placed(combatant, on_side));
  EXPECT_THAT(findings("side.glb", ship + ", orientation: {forward: +x}"),
              ElementsAre(HasSubstr("orientation.up: +y")));
}

// Both hulls in the same waves: equal angles.
TEST_F(BodiesInWater, OfAShipWithItsBowAlongYMovesAsAlongX) {
  const std::string hulls = SEAGLINT_SOURCE_DIR "/tests/cases/hulls/";
  const Pipeline pipeline(
      scene_of(target("a", hulls + "06_bow_along_y.obj", "orientation: {forward: +y}, motion: {model: ship}") +
               target("b", hulls + "06_bow_along_x.obj", "motion: {model: ship}")));
  const auto scene = pipeline.scene({});
  for (const double t : {0.3, 1.7, 4.0}) {
    EXPECT_LT((scene->bodies[0][0].sample(t).angles - scene->bodies[1][0].sample(t).angles).norm(), 1e-12);
    EXPECT_GT(scene->bodies[0][0].sample(t).angles.norm(), 1e-4);
  }
}

TEST_F(BodiesInWater, OfAHullThatNoStripTheoryCarriesIsRefusedWithItsSizes) {
  write_hulls(0);
  EXPECT_HAS(refusal_of([&] {
               Pipeline pipeline(scene_of(target("a", "whole.obj", "motion: {model: ship, roll_period_s: 0.2}")));
             }),
             "; the hull is 10 m long and 4 m broad, with a draught of 1 m; the mesh is 10 m "
             "long (x), 4.5 m broad (y) and 4 m high (z)");
}

// Reflectors that are fixed to one raft: their phases, ranges and velocities follow its rotation about one point, and
// everything else is that of free reflectors.

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
  const auto scene = pipeline.scene({});
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
  const auto scene = one.scene({});
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
    const auto scene = pipeline.scene({.realisation = realisation});
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
    return refusal_of([&] { Pipeline{scene_of(line_of(4, 40, "rigid") + ", motion: {" + motion + "}")}; });
  };
  const std::string ship =
      "targets.t: motion.length_m, motion.beam_m: the reflectors of a rigid raft give no waterline; write both down";
  EXPECT_HAS(complaint("model: ship"), ship);
  EXPECT_HAS(complaint("model: ship, length_m: 134.6"), ship);
  EXPECT_HAS(complaint("model: float"),
             "targets.t: motion.diameter_m: the reflectors of a rigid raft give no waterplane; "
             "write it down");
}

// A raft with a slow yaw far from the reference point stays within the window.
TEST_F(RigidRaft, ReachesAsFarAsItCanTurn) {
  const Scenario scenario = scene_of(
      "layout: {line: {count: 2, spacing_m: 200, centre_y_m: 300}, bodies: rigid}, "
      "motion: {model: ship, length_m: 200, beam_m: 30}");
  EXPECT_GE(Pipeline(scenario).window_m(), 2 * (300 + 100));
}

// In the same mesh, made once, for another target: the caches distinguish them.
TEST_F(BodiesInWater, HaveTheMaterialsThatTheirMeshesNameUnlessTheScenarioAssignsOthers) {
  const Scenario scenario = scene_of(
      "  own: {label: 1, ship: {kind: inflatable_boat}, motion: {model: fixed}}\n"
      "  pec: {label: 0, ship: {kind: inflatable_boat}, motion: {model: fixed}, part_materials: [{part: '*', material: "
      "pec}]}");
  const Pipeline pipeline(scenario);
  EXPECT_THAT(
      material_notes(pipeline.targets()),
      ElementsAre(
          "targets.own.ship: materials as the mesh names them: rubber_tube, grp_sheet, window_glass, human_body; "
          "part_materials: [{part: '*', material: pec}] makes every face a perfect conductor"));
}

}  // namespace
}  // namespace seaglint
