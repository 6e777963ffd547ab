// SPDX-License-Identifier: BSD-3-Clause
// The whole job (data set, learning, report, cards, evaluation, benchmark) with every key that can be drawn.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "classify/dataset/directory/dataset_reader.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/file.h"
#include "sim/scenario/keys.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"
#include "tools/evaluate/evaluate.h"
#include "tools/report/report.h"
#include "tools/run/benchmark.h"
#include "tools/run/run.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// A hull with its motion in waves, floating reflectors and ideal points; 24 maps of 8 seas.
constexpr const char* kScenario = R"yaml(seaglint: 1
name: drawn
radar: {pulses: 16, hop_count: 2, bandwidth_mhz: 5, hop_step_mhz: 5, sampling_mhz: 10}
view: {azimuth_deg: 40, elevation_deg: 5}
sea: {significant_wave_height_m: 1, peak_period_s: 8, components: 16, order: 1}
targets:
  hull: {label: 1, mesh: hull.obj, motion: {model: ship, spin_up_s: 10}}
  corner: {label: 0, mesh: corner.obj, layout: {line: {count: 2, spacing_m: 20}}, motion: {model: float, spin_up_s: 10}}
  dots: {label: 0, points: [{position_m: [0, 0, 2], amplitude_m: 1}]}
dataset: {maps_per_case: 8, realisations_per_case: 8, maps_per_shard: 12}
learning: {epochs: 1, trees: 4, bootstrap_samples: 20, embedding_size: 2}
)yaml";

// A box, 24 x 4 x 3 m with 1 m of draught, and a trihedral of three triangles on a float.
constexpr const char* kHull = R"obj(v -12 -2 -1
v 12 -2 -1
v 12 2 -1
v -12 2 -1
v -12 -2 2
v 12 -2 2
v 12 2 2
v -12 2 2
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
)obj";
constexpr const char* kCorner = R"obj(v 0 0 0.2
v 0.6 0 0.2
v 0 0.6 0.2
v 0 0 0.8
f 1 2 3
f 1 3 4
f 1 4 2
)obj";

struct DrawnKey {
  std::string key;  // NAME stands for the target
  std::string distribution, target = "hull";
  std::vector<Override> with = {};  // what the key needs

  std::string path() const {
    const auto replaced = [](const std::string& text, const std::string& part, const std::string& value) {
      const std::size_t at = text.find(part);
      if (at == std::string::npos) return text;
      return fmt::format("{}{}{}", text.substr(0, at), value, text.substr(at + part.size()));
    };
    return replaced(replaced(key, "NAME", target), ".N.", ".0.");
  }
};

const std::vector<DrawnKey>& drawn_job_keys() {
  const Override area{"targets.corner.layout", "{area: {count: 3, length_m: 60, width_m: 20}}"};
  const Override spread{"sea.spreading.kind", "cos2s"}, wrapped{"sea.spreading.kind", "wrapped_normal"};
  const Override wind{"sea.peak_period_s", "wind_and_fetch"};
  const Override swell{"sea.swell.significant_wave_height_m", "0.5"};
  const Override swell_spread{"sea.swell.spreading.kind", "cos2s"};
  const Override wrapped_swell{"sea.swell.spreading.kind", "wrapped_normal"};
  const Override reflection{"sea_reflection.enabled", "true"};
  // Maps, so that no draw of paths or waves is in one job with propagation over the waves.
  const Override all_paths{"sea_reflection", "{enabled: true, paths: all}"};
  const Override common_waves{"targets.hull.motion", "{model: ship, waves: same_field}"};
  const Override of_sea{"clutter.level", "nrl"}, budget{"radar.link_budget", "{}"}, range{"radar.range_km", "10"};
  const Override companion{"targets.corner.companions", "[{target: dots, x_m: 3, y_m: 1}]"};
  const Override under_way{"targets.hull.motion.speed_mps", "2"},
      tow{"targets.hull.companions", "[{target: corner, x_m: -30}]"};
  const Override breeze{"targets.corner.motion.drift.wind_mps", "10"},
      stream{"targets.corner.motion.drift.current_mps", "0.5"};
  const Override bretschneider{"sea.spectrum", "bretschneider"};
  const Override series{"targets.hull.motion", "{model: series, file: series.csv}"};
  const Override free{"targets.corner.motion.translations", "true"}, rays{"targets.corner.solver.method", "rays"};
  const Override still{"targets.corner.motion", "{model: fixed}"}, fixed{"targets.hull.motion.model", "fixed"};
  const Override higher{"targets.corner.layout.heights.highest_m", "1"};
  const Override wider{"targets.corner.layout.headings.highest_deg", "180"};
  const Override hh{"radar.polarisation", "hh"}, of_state{"clutter.doppler", "sea_state"};
  const Override series_with_translations{"targets.hull.motion",
                                          "{model: series, file: series.csv, translations: true}"};
  const Override boat{"targets.hull",
                      "{label: 1, ship: {kind: inflatable_boat, detail: hull}, motion: {model: ship, "
                      "spin_up_s: 10}}"};
  const auto decoy = [](const char* keys) {
    return Override{"targets.corner",
                    fmt::format("{{label: 0, decoy: {{{}}}, motion: {{model: float, spin_up_s: 10}}}}", keys)};
  };
  const Override octahedral = decoy("kind: octahedral"), cluster = decoy("kind: trihedral_cluster"),
                 lens = decoy("kind: luneburg_lens, leg_m: 0.2");
  const Override soft = decoy("kind: octahedral, rounding_mm: 20"),
                 dented = decoy("kind: octahedral, dented_panels: 2");
  const Override afloat = decoy("kind: octahedral, support: float"),
                 towed = decoy("kind: octahedral, support: tow, tether_m: 4");
  static const std::vector<DrawnKey> keys{
      {"view.azimuth_deg", "uniform(10, 170)"},
      {"view.elevation_deg", "uniform(2, 6)"},
      {"radar.hop_code", "choice(random, balanced, stepped)"},
      {"radar.pri_jitter_us", "uniform(0, 5)"},
      {"radar.polarisation", "choice(hh, hv, vv)"},
      {"looks.spacing_s", "uniform(0.1, 0.4)", "", {{"looks.count", "2"}}},
      {"sea.spectrum", "choice(jonswap, bretschneider)"},
      {"sea.significant_wave_height_m", "loguniform(0.5, 2)"},
      {"sea.peak_period_s", "uniform(7, 10)"},
      {"sea.wind.speed_mps", "uniform(5, 9)", "", {wind}},
      {"sea.wind.fetch_km", "uniform(50, 200)", "", {wind}},
      {"sea.steepness", "uniform(0.01, 0.04)"},
      {"sea.energy_period_s", "uniform(7, 9)"},
      {"sea.zero_crossing_period_s", "uniform(6, 8)"},
      {"sea.gamma", "normal(3.3, 0.5, 1, 7)"},
      {"sea.normalisation", "choice(exact, dnv)"},
      {"sea.propagation_deg", "uniform(0, 360)"},
      {"sea.coming_from_deg", "uniform(0, 360)"},
      {"sea.spreading.kind", "choice(none, cos2s)"},
      {"sea.spreading.s", "uniform(5, 20)", "", {spread}},
      {"sea.spreading.width_deg", "uniform(10, 40)", "", {wrapped}},
      {"sea.swell.significant_wave_height_m", "uniform(0, 1)"},
      {"sea.swell.peak_period_s", "uniform(11, 14)", "", {swell}},
      {"sea.swell.energy_period_s", "uniform(10, 13)", "", {swell}},
      {"sea.swell.zero_crossing_period_s", "uniform(9, 11)", "", {swell}},
      {"sea.swell.coming_from_deg", "uniform(0, 360)", "", {swell}},
      {"sea.swell.gamma", "uniform(3, 7)", "", {swell}},
      {"sea.swell.propagation_deg", "uniform(0, 360)", "", {swell}},
      {"sea.swell.components", "integers(8, 16)", "", {swell}},
      {"sea.swell.spreading.kind", "choice(none, cos2s)", "", {swell}},
      {"sea.swell.spreading.s", "uniform(5, 20)", "", {swell, swell_spread}},
      {"sea.swell.spreading.width_deg", "uniform(10, 40)", "", {swell, wrapped_swell}},
      {"sea.depth_m", "uniform(20, 50)"},
      {"sea.amplitude", "choice(fixed, random)"},
      {"sea.order", "integers(1, 2)"},
      {"sea.components", "integers(12, 20)"},
      {"sea.cutoff_rad_s", "uniform(4, 8)"},
      {"sea.second_order_cutoff_rad_s", "uniform(2, 3)", "", {{"sea.order", "2"}}},
      {"sea_reflection.enabled", "choice(true, false)"},
      {"sea_reflection.surface", "choice(sea_water, conductor)", "", {reflection}},
      {"sea_reflection.temperature_c", "uniform(0, 25)", "", {reflection}},
      {"sea_reflection.salinity_psu", "uniform(5, 35)", "", {reflection}},
      {"sea_reflection.roughness", "choice(miller_brown_vegh, ament, none)", "", {reflection}},
      {"sea_reflection.paths", "choice(all, direct_only)", "", {reflection}},
      {"sea_reflection.surface_profile", "choice(mean, waves)", "", {all_paths, common_waves}},
      {"targets.NAME.points.N.amplitude_m", "loguniform(0.5, 2)", "dots"},
      {"targets.NAME.mesh", "choice(hull.obj, corner.obj)", "hull", {fixed}},
      {"targets.NAME.ship.kind", "choice(inflatable_boat, tug)", "hull", {boat}},
      {"targets.NAME.ship.length_m", "uniform(6, 10)", "hull", {boat}},
      {"targets.NAME.ship.loading", "uniform(0, 1)", "hull", {boat}},
      {"targets.NAME.ship.detail", "choice(hull, fittings)", "hull", {boat}},
      {"targets.NAME.ship.seed", "integers(1, 1000000)", "hull", {boat}},
      {"targets.NAME.decoy.kind", "choice(icosahedral, octahedral)", "corner", {decoy("kind: octahedral, leg_m: 0.4")}},
      {"targets.NAME.decoy.leg_m", "uniform(0.3, 0.6)", "corner", {octahedral}},
      {"targets.NAME.decoy.panel", "choice(triangular, square, circular)", "corner", {octahedral}},
      {"targets.NAME.decoy.pose", "choice(rain_catcher, point_up)", "corner", {octahedral}},
      {"targets.NAME.decoy.cells", "integers(3, 6)", "corner", {cluster}},
      {"targets.NAME.decoy.boresight_elevation_deg", "uniform(-5, 5)", "corner", {cluster}},
      {"targets.NAME.decoy.cap_half_angle_deg", "uniform(50, 80)", "corner", {lens}},
      {"targets.NAME.decoy.lens_loss_db", "uniform(0, 2)", "corner", {lens}},
      {"targets.NAME.decoy.angle_error_deg", "uniform(0, 2)", "corner", {octahedral}},
      {"targets.NAME.decoy.surface_error_mm", "uniform(0, 2)", "corner", {octahedral}},
      {"targets.NAME.decoy.rounding_mm", "uniform(5, 20)", "corner", {octahedral}},
      {"targets.NAME.decoy.inflatable", "choice(true, false)", "corner", {soft}},
      {"targets.NAME.decoy.missing_panels", "integers(0, 3)", "corner", {octahedral}},
      {"targets.NAME.decoy.dented_panels", "integers(0, 3)", "corner", {octahedral}},
      {"targets.NAME.decoy.dent_depth", "uniform(0.02, 0.1)", "corner", {dented}},
      {"targets.NAME.decoy.frame_mm", "uniform(5, 20)", "corner", {octahedral}},
      {"targets.NAME.decoy.support", "choice(none, float, raft)", "corner", {octahedral}},
      {"targets.NAME.decoy.float_shape", "choice(disc, sphere)", "corner", {afloat}},
      {"targets.NAME.decoy.float_m", "uniform(0.6, 1)", "corner", {afloat}},
      {"targets.NAME.decoy.tether_m", "uniform(4, 6)", "corner", {towed}},
      {"targets.NAME.decoy.seed", "integers(1, 1000000)", "corner", {octahedral}},
      {"targets.NAME.unit", "choice(m, ft)", "corner"},
      {"targets.NAME.orientation.forward", "choice(+x, -x)"},
      {"targets.NAME.orientation.up", "choice(+z, +y)", "hull", {fixed}},
      {"targets.NAME.scale", "uniform(0.8, 1.2)"},
      {"targets.NAME.material", "choice(pec, aluminium)"},
      {"targets.NAME.sheet_thickness_mm", "uniform(0, 2)", "corner"},
      {"targets.NAME.layout.line.count", "integers(1, 3)", "corner"},
      {"targets.NAME.layout.line.spacing_m", "uniform(10, 30)", "corner"},
      {"targets.NAME.layout.line.centre_x_m", "uniform(-5, 5)", "corner"},
      {"targets.NAME.layout.line.centre_y_m", "uniform(-5, 5)", "corner"},
      {"targets.NAME.layout.area.shape", "choice(line, ring, random)", "corner", {area}},
      {"targets.NAME.layout.area.count", "integers(2, 4)", "corner", {area}},
      {"targets.NAME.layout.area.length_m", "uniform(40, 80)", "corner", {area}},
      {"targets.NAME.layout.area.width_m", "uniform(10, 30)", "corner", {area}},
      {"targets.NAME.layout.area.min_distance_m", "uniform(0, 5)", "corner", {area}},
      {"targets.NAME.layout.area.centre_x_m", "uniform(-5, 5)", "corner", {area}},
      {"targets.NAME.layout.area.centre_y_m", "uniform(-5, 5)", "corner", {area}},
      {"targets.NAME.layout.bodies", "choice(independent, rigid)", "corner", {still}},
      {"targets.NAME.layout.heights.lowest_m", "uniform(0, 0.5)", "corner", {higher}},
      {"targets.NAME.layout.heights.highest_m", "uniform(0, 0.5)", "corner"},
      {"targets.NAME.layout.headings.lowest_deg", "uniform(0, 90)", "corner", {wider}},
      {"targets.NAME.layout.headings.highest_deg", "uniform(0, 90)", "corner"},
      {"targets.NAME.layout.scales.lowest", "uniform(0.5, 1)", "corner"},
      {"targets.NAME.layout.scales.highest", "uniform(1, 2)", "corner"},
      {"targets.NAME.layout.jitter_m", "uniform(0, 1)", "corner"},
      {"targets.NAME.layout.tether_slack", "uniform(0.01, 0.1)", "corner", {free}},
      {"targets.NAME.layout.seed", "integers(0, 1000000)", "corner", {area}},
      {"targets.NAME.motion.model", "choice(fixed, ship)"},
      {"targets.NAME.motion.heading", "choice(auto, keep)", "hull", {series}},
      {"targets.NAME.motion.position", "choice(auto, keep)", "hull", {series_with_translations}},
      {"targets.NAME.motion.translations", "choice(true, false)"},
      {"targets.NAME.motion.roll_period_s", "uniform(5, 9)"},
      {"targets.NAME.motion.pitch_period_s", "uniform(4, 6)"},
      {"targets.NAME.motion.yaw_period_s", "uniform(20, 40)"},
      {"targets.NAME.motion.roll_damping", "uniform(0.05, 0.2)"},
      {"targets.NAME.motion.roll_quadratic_damping", "uniform(0, 0.5)"},
      {"targets.NAME.motion.pitch_damping", "uniform(0.1, 0.3)", "corner"},
      {"targets.NAME.motion.yaw_damping", "uniform(0.05, 0.2)"},
      {"targets.NAME.motion.yaw_rate_std_deg_s", "uniform(1, 3)", "corner"},
      {"targets.NAME.motion.length_m", "uniform(22, 26)"},
      {"targets.NAME.motion.beam_m", "uniform(3.5, 4.5)"},
      {"targets.NAME.motion.draught_m", "uniform(0.8, 1.2)"},
      {"targets.NAME.motion.heave_period_s", "uniform(1, 2)", "corner", {free}},
      {"targets.NAME.motion.heave_damping", "uniform(0.1, 0.3)", "corner", {free}},
      {"targets.NAME.motion.effective_slope", "uniform(0.7, 1)", "corner"},
      {"targets.NAME.motion.metacentric_height_m", "uniform(0.5, 1.5)"},
      {"targets.NAME.motion.roll_gyradius_m", "uniform(1.3, 1.8)"},
      {"targets.NAME.motion.pitch_gyradius_m", "uniform(5, 7)"},
      {"targets.NAME.motion.yaw_gyradius_m", "uniform(5, 7)"},
      {"targets.NAME.motion.speed_mps", "uniform(0, 5)"},
      {"targets.NAME.motion.drift.wind_mps", "uniform(2, 12)", "corner"},
      {"targets.NAME.motion.drift.wind_towards_deg", "uniform(0, 360)", "corner", {breeze}},
      {"targets.NAME.motion.drift.leeway", "uniform(0.01, 0.06)", "corner", {breeze}},
      {"targets.NAME.motion.drift.current_mps", "uniform(0, 1)", "corner"},
      {"targets.NAME.motion.drift.current_towards_deg", "uniform(0, 360)", "corner", {stream}},
      {"targets.NAME.motion.drift.spread_mps", "uniform(0, 0.1)", "corner"},
      {"targets.NAME.motion.diameter_m", "uniform(0.5, 1)", "corner"},
      {"targets.NAME.motion.origin_above_waterline_m", "uniform(0.5, 1)", "corner"},
      {"targets.NAME.motion.waves", "choice(same_field, independent)"},
      {"targets.NAME.motion.step_s", "choice(0.02, 0.05)", "corner"},
      {"targets.NAME.motion.spin_up_s", "uniform(5, 20)"},
      {"targets.NAME.solver.method", "choice(beams, rays)", "corner"},
      {"targets.NAME.solver.ray_spacing_m", "uniform(0.01, 0.02)", "corner", {rays}},
      {"targets.NAME.solver.min_patch_m", "uniform(0.01, 0.02)"},
      {"targets.NAME.solver.max_bounces", "integers(1, 6)", "corner"},
      {"targets.NAME.solver.max_aspect_change_deg", "uniform(0.1, 0.5)"},
      {"targets.NAME.solver.crease_deg", "choice(auto, 10)"},
      {"targets.NAME.solver.edges", "choice(true, false)"},
      {"targets.NAME.solver.wavefront_range_m", "uniform(5000, 20000)"},
      {"targets.NAME.companions.N.x_m", "uniform(1, 5)", "corner", {companion}},
      {"targets.NAME.companions.N.y_m", "uniform(1, 5)", "corner", {companion}},
      {"targets.NAME.companions.N.towed", "choice(true, false)", "hull", {under_way, tow}},
      {"clutter.level", "choice(scr, nrl)", "", {budget, range}},
      {"clutter.scr_db", "uniform(10, 25)"},
      {"clutter.scr_definition", "choice(per_pulse, peak_cell, extent)"},
      {"clutter.enabled", "choice(true, false)"},
      {"clutter.noise_level", "choice(cnr, snr)"},
      {"clutter.cnr_db", "uniform(10, 30)"},
      {"clutter.snr_db", "uniform(10, 30)", "", {{"clutter.noise_level", "snr"}}},
      {"clutter.texture_shape", "uniform(0.5, 5)"},
      {"clutter.texture_correlation_time_s", "uniform(1, 5)"},
      {"clutter.texture_correlation_m", "uniform(2, 20)"},
      {"clutter.texture", "choice(independent, waves)", "", {{"clutter.doppler", "wave_resolved"}}},
      {"clutter.doppler", "choice(prescribed, sea_state, wave_resolved)"},
      {"clutter.doppler_mean_mps", "uniform(-1, 1)"},
      {"clutter.doppler_spread_mps", "uniform(0.2, 1)"},
      {"clutter.hh_velocity_factor", "uniform(1, 2)", "", {hh, of_state}},
      {"clutter.sea_state", "uniform(1, 4)", "", {of_sea, budget, range}},
  };
  return keys;
}

// Keys of files, of how a file is read, and of lists of numbers.
constexpr const char* kNotDrawn = R"(
targets.NAME.label targets.NAME.role targets.NAME.points.N.position_m targets.NAME.points.N.velocity_mps
targets.NAME.part_materials.N.part targets.NAME.part_materials.N.material targets.NAME.companions.N.target
targets.NAME.motion.rotation_centre_m targets.NAME.motion.file targets.NAME.motion.series_start_s
targets.NAME.motion.wamit_ulen_m targets.NAME.motion.wamit_heading targets.NAME.motion.wamit_time_factor
targets.NAME.decoy.seam_errors_deg targets.NAME.motion.sections targets.NAME.motion.rao_scale targets.NAME.motion.rao_phase_deg
targets.NAME.motion.rao_rotations targets.NAME.motion.rao_follows_long_waves targets.NAME.motion.wamit_body
targets.NAME.motion.wamit_xbody_m targets.NAME.motion.wamit_first_column targets.NAME.offset_m sea.table
sea.table_time sea.scatter_diagram
)";

class DrawnJob : public testing::Test {
 protected:
  DrawnJob() {
    write_file(folder_.path() / "scenario.yaml", kScenario);
    write_file(folder_.path() / "hull.obj", kHull);
    write_file(folder_.path() / "corner.obj", kCorner);
    std::string series = "time_s,roll_deg,pitch_deg,yaw_deg,surge_m,sway_m,heave_m\n";
    for (int i = 0; i <= 1200; ++i)
      series += fmt::format("{},{:.4f},{:.4f},40,0,0,{:.4f}\n", 0.1 * i, 2 * std::sin(0.07 * i), std::sin(0.05 * i),
                            0.3 * std::cos(0.06 * i));
    write_file(folder_.path() / "series.csv", series);
  }

  static std::vector<Override> overrides_of(const std::vector<DrawnKey>& keys) {
    std::vector<Override> overrides;
    for (const DrawnKey& key : keys) overrides.insert(overrides.end(), key.with.begin(), key.with.end());
    for (const DrawnKey& key : keys) overrides.push_back({key.path(), "\"" + key.distribution + "\""});
    return overrides;
  }

  // The data set, learning, report and evaluation, and what they state of the keys.
  void do_job(const std::vector<DrawnKey>& keys) {
    const Scenario scenario = read_scenario(folder_.path() / "scenario.yaml", overrides_of(keys));
    const fs::path run = folder_.path() / "run";
    fs::remove_all(run);
    run_scenario(scenario, run, {.resume = false, .threads = 1});
    EvaluateRequest request;
    request.model = run / "model";
    request.data_sets = {run / "data"};
    request.trained_rows = true;
    for (const DrawnKey& key : keys) request.by.push_back(key.path());
    const json evaluation = json::parse(evaluate_model(request).json);
    const json metrics = json::parse(read_file(run / "metrics.json"));
    const std::string card = read_file(run / "data" / "README.md"), page = read_file(run / "report.html");
    for (const DrawnKey& key : keys) {
      EXPECT_HAS(card, fmt::format("`{}`", key.path()));
      const auto by = std::ranges::find_if(evaluation.at("by"),
                                           [&](const json& column) { return column.at("column") == key.path(); });
      ASSERT_NE(by, evaluation.at("by").end());
      EXPECT_LE(by->at("bins").size(), 8u);
      if (key.key == "sea.significant_wave_height_m" || key.path().ends_with("seed")) continue;
      const json& drawn = metrics.at("fused").at("group").at("by_condition");
      EXPECT_TRUE(std::ranges::any_of(drawn, [&](const json& c) { return c.at("column") == key.path(); }));
    }
    EXPECT_LE(metrics.at("handmade").at("group").at("by_wave_height").size(), 8u);
    EXPECT_HAS(page, "</html>");
  }

  // Whether what a key needs replaces a map that has the other key, which needs another one.
  static bool replaces(const DrawnKey& key, const DrawnKey& other) {
    return std::ranges::any_of(key.with, [&](const Override& need) {
      const auto is_same = [&](const Override& same) {
        return same.key_path == need.key_path && same.value == need.value;
      };
      return other.path().starts_with(need.key_path + ".") && std::ranges::none_of(other.with, is_same);
    });
  }

  TemporaryFolder folder_;
};

TEST_F(DrawnJob, HasADistributionForEveryKeyThatCanBeDrawn) {
  std::istringstream names(kNotDrawn);
  const std::set<std::string> not_drawn{std::istream_iterator<std::string>(names), {}};
  for (const KeyEntry& entry : scenario_keys()) {
    const std::string section = entry.key.substr(0, entry.key.find('.'));
    const bool is_of_radar = entry.key == "radar.hop_code" || entry.key == "radar.pri_jitter_us" ||
                             entry.key == "radar.polarisation" || entry.key == "looks.spacing_s";
    if (section != "view" && section != "sea" && section != "sea_reflection" && section != "targets" &&
        section != "clutter" && !is_of_radar)
      continue;
    if (not_drawn.contains(entry.key)) continue;
    EXPECT_NE(std::ranges::find(drawn_job_keys(), entry.key, &DrawnKey::key), drawn_job_keys().end()) << entry.key;
  }
}

// Every key once, in jobs of several keys that do not contradict each other; of one key where the variable is 1.
TEST_F(DrawnJob, IsDoneWithEveryKey) {
  const char* const text = std::getenv("SEAGLINT_KEYS_PER_JOB");
  const std::size_t most = text != nullptr ? std::stoul(text) : 12;
  std::vector<std::vector<DrawnKey>> jobs;
  for (const DrawnKey& key : drawn_job_keys()) {
    const auto fits = [&](std::vector<DrawnKey> job) {
      for (const DrawnKey& other : job)
        if (replaces(other, key) || replaces(key, other)) return false;
      job.push_back(key);
      try {
        return job.size() <= most &&
               read_scenario(folder_.path() / "scenario.yaml", overrides_of(job)).variations.size() == job.size();
      } catch (const InputError&) {
        return false;
      }
    };
    const auto job = std::ranges::find_if(jobs, fits);
    if (job != jobs.end())
      job->push_back(key);
    else
      jobs.push_back({key});
  }
  for (const std::vector<DrawnKey>& job : jobs) {
    std::string paths;
    for (const DrawnKey& key : job) paths += fmt::format(" {}", key.path());
    SCOPED_TRACE(paths);
    try {
      do_job(job);
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
    }
  }
}

TEST_F(DrawnJob, IsDoneWithPairsOfAScatterDiagram) {
  write_file(folder_.path() / "scatter.csv",
             read_file(SEAGLINT_SOURCE_DIR "/tests/cases/tables/scatter_synthetic.csv"));
  const Scenario scenario = read_scenario(folder_.path() / "scenario.yaml",
                                          {{"sea", "{scatter_diagram: scatter.csv, components: 16, order: 1}"},
                                           {"view.azimuth_deg", "\"uniform(10, 170)\""}});
  const fs::path run = folder_.path() / "run";
  run_scenario(scenario, run, {.resume = false, .threads = 1});
  write_report(run, scenario, 1, nullptr);
  const json metrics = json::parse(read_file(run / "metrics.json"));
  std::vector<std::string> drawn;
  for (const json& condition : metrics.at("fused").at("group").at("by_condition"))
    drawn.push_back(condition.at("column"));
  EXPECT_THAT(drawn, testing::ElementsAre("sea.peak_period_s", "view.azimuth_deg"));
}

// Pairs that contradict each other are refused; they are drawn again.
TEST_F(DrawnJob, AndItsBenchmarkAreDoneWithRandomPairs) {
  const std::vector<DrawnKey>& all = drawn_job_keys();
  Random random({1, Stream::kTest, 0});
  for (int pairs = 0, tries = 0; pairs < 3 && tries < 60; ++tries) {
    const std::vector<DrawnKey> pair{all[random.below(static_cast<std::uint32_t>(all.size()))],
                                     all[random.below(static_cast<std::uint32_t>(all.size()))]};
    SCOPED_TRACE(fmt::format("{}, {}", pair[0].path(), pair[1].path()));
    if (pair[0].path() == pair[1].path()) continue;
    std::optional<Scenario> scenario;
    try {
      scenario = read_scenario(folder_.path() / "scenario.yaml", overrides_of(pair));
    } catch (const InputError&) {
      continue;
    }
    ++pairs;
    do_job(pair);
    write_report(folder_.path() / "run", *scenario, 1, nullptr);
    fs::remove_all(folder_.path() / "benchmark");
    EXPECT_HAS(run_benchmark(*scenario, false, folder_.path() / "benchmark", false, 1), "claims");
  }
}

}  // namespace
}  // namespace seaglint
