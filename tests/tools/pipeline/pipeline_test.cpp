// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "tests/map_levels.h"
#include "tests/refusal.h"
#include "tests/relative_difference.h"
#include "tests/temporary_folder.h"
#include "tools/pipeline/generate.h"
#include "tools/pipeline/imaging.h"
#include "tools/pipeline/pipeline.h"
#include "tools/pipeline/scenario_check.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// One sample: the truth in its columns, the products of its interval (with the whole synthetic bandwidth in every pulse
// there is no pedestal, and the target's own motion), and its interruption.

// One point of 2 m, 30 m nearer than the reference point, approaching at 1.5 m/s, viewed from ahead.
const char* const kOnePoint = R"(
seaglint: 1
radar: {pulses: 64}
view: {azimuth_deg: 0, elevation_deg: 0}
targets: {point: {label: 1, points: [{position_m: [30, 0, 0], amplitude_m: 2, velocity_mps: [1.5, 0, 0]}]}}
map: {range_oversampling: 4, velocity_oversampling: 4}
dataset: {maps_per_case: 1, realisations_per_case: 1}
)";

TEST(FullBand, ImageHasThePointAndNoPedestal) {
  const Pipeline pipeline(parse_scenario(kOnePoint, "point.yaml"));
  const FullBandInterval band = full_band_interval(pipeline, 0);
  const PulseTrain hopping = make_pulse_train(pipeline.scenario().radar, pipeline.window_m(), 42, 0);
  EXPECT_NEAR(band.train.band_centre_hz(), hopping.band_centre_hz(), 1);
  EXPECT_NEAR(band.train.synthetic_bandwidth_hz(), hopping.synthetic_bandwidth_hz(), 1);
  const Peak peak = peak_of(band.image);
  const double cell_m = band.train.range_resolution_m() / 4, cell_mps = band.train.velocity_resolution_mps() / 4;
  EXPECT_NEAR(peak.range_m, -30, cell_m / 2 + 1e-9);
  EXPECT_NEAR(peak.velocity_mps, -1.5, cell_mps / 2 + 1e-9);
  EXPECT_NEAR(peak.level, 2, 0.1);  // an eighth of a lobe off its peak, in range and velocity
  // More than two lobes of the Hann taper from the point only the velocity sidelobes remain, at its range and -13 dB or
  // less.
  for (std::size_t v = 0; v < band.image.velocity_mps.size(); ++v) {
    for (std::size_t r = 0; r < band.image.columns(); ++r)
      if (std::abs(band.image.range_m[r] + 30) > 6) {
        EXPECT_LT(std::abs(band.image.at(v, r)), 2e-2 * peak.level);
      }
  }
}

TEST(FullBand, FollowsUncompensatedPlatformMotion) {
  const char* const moving = "platform: {velocity_mps: [0.8, 0, 0], motion_compensated: ";
  double step_mps = 0;
  const auto velocity = [&](const char* compensated) {
    std::string text = kOnePoint;
    text.replace(text.find("pulses: 64"), 10, std::string("pulses: 64, ") + moving + compensated + "}");
    const FullBandInterval band = full_band_interval(Pipeline(parse_scenario(text, "point.yaml")), 0);
    step_mps = band.image.velocity_mps[1] - band.image.velocity_mps[0];
    return peak_of(band.image).velocity_mps;
  };
  // A radar ahead that recedes from the target; each peak lies on the map's cells.
  const double difference = velocity("false") - velocity("true");
  EXPECT_NEAR(difference, 0.8, step_mps);
}

// A ship that rolls: at its largest rate of roll the image is upright, and its window holds the ship.
TEST(Isar, PlansIntervalWindowAndHeightByTheShipsMotion) {
  const Pipeline pipeline(parse_scenario(R"(
seaglint: 1
name: ship
view: {azimuth_deg: 90, elevation_deg: 2}
sea: {significant_wave_height_m: 2, peak_period_s: 8, propagation_deg: 120}
targets: {ship: {label: 1, mesh: assets/combatant_144m.glb, motion: {model: ship}}}
dataset: {maps_per_case: 1, realisations_per_case: 1}
)",
                                         "ship.yaml"));
  const IsarPlan plan = isar_plan(pipeline, 0);
  ASSERT_TRUE(plan.cross_range);
  EXPECT_EQ(plan.no_cross_range, "");
  EXPECT_GT(std::abs(plan.cross_range->up), 0.9);
  EXPECT_NEAR(plan.cross_range->rate_rad_s * plan.duration_s, plan.cross_range->angle_rad, 1e-12);
  EXPECT_LE(plan.cross_range->cell_m, 34.4 / 8);
  EXPECT_GE(plan.cross_range->cell_m, 0.7);
  EXPECT_NEAR(plan.sampling.pulses * 250e-6, plan.duration_s, 250e-6);
  EXPECT_LT(plan.sampling.offset_s, 8);
  EXPECT_LT(plan.range_m.first, -10);
  EXPECT_GT(plan.range_m.second, 10);
  EXPECT_LT(plan.range_m.second, 30);
  // The velocity of the mast's top, 34.4 m over the origin, is that of the axis.
  const double top_mps = plan.cross_range->origin_mps + 34.4 * plan.cross_range->rate_rad_s * plan.cross_range->up;
  EXPECT_GT(top_mps, plan.velocity_mps.first);
  EXPECT_LT(top_mps, plan.velocity_mps.second);
  EXPECT_EQ(plan.sampling.map->range_taper, Taper::kHamming);
}

TEST(Isar, OfPointsHasNoCrossRange) {
  const IsarPlan plan = isar_plan(Pipeline(parse_scenario(kOnePoint, "point.yaml")), 0);
  EXPECT_FALSE(plan.cross_range);
  EXPECT_NE(plan.no_cross_range, "");
  EXPECT_LT(plan.velocity_mps.first, -1.5);
  EXPECT_GT(plan.velocity_mps.second, -1.5);
  EXPECT_LT(plan.range_m.first, -30);
  EXPECT_GT(plan.range_m.second, -30);
}

TEST(RangeProfiles, OverTimeAreThoseOfSinglePulsesWithTheirPeaksNamed) {
  const Pipeline pipeline(parse_scenario(kOnePoint, "point.yaml"));
  const RangeProfiles profiles =
      profiles_over(pipeline, 0, {.duration_s = 4, .count = 4, .map = pipeline.scenario().map});
  ASSERT_EQ(profiles.time_s, (std::vector<double>{0, 1, 2, 3}));
  const std::vector<NamedPeak> peaks = named_peaks(pipeline, 0, profiles, 3);
  ASSERT_EQ(peaks.size(), 1u);
  EXPECT_EQ(peaks[0].name, "point 1");
  EXPECT_NEAR(peaks[0].range_m, -30, 0.2);
  EXPECT_NEAR(peaks[0].magnitude_m, 2, 0.1);
}

TEST(RangeProfiles, FollowThePoint) {
  const Pipeline pipeline(parse_scenario(kOnePoint, "point.yaml"));
  const RangeProfiles profiles = range_profiles(full_band_interval(pipeline, 0), pipeline.scenario().map);
  ASSERT_EQ(profiles.time_s.size(), 64u);
  const std::size_t cells = profiles.range_m.size();
  ASSERT_EQ(profiles.magnitude_m.size(), 64 * cells);
  for (const std::size_t n : {0u, 63u}) {
    const auto begin = profiles.magnitude_m.begin() + static_cast<std::ptrdiff_t>(n * cells);
    const auto top = std::max_element(begin, begin + static_cast<std::ptrdiff_t>(cells));
    EXPECT_NEAR(profiles.range_m[static_cast<std::size_t>(top - begin)], -30 - 1.5 * profiles.time_s[n],
                0.5 * 0.7495 / 4 + 1e-9);
    EXPECT_NEAR(*top, 2, 0.1);
  }
}

// The samples over time are of one solution on their finer grid of frequencies, of which the map's are a part.
TEST(SampledInterval, HasTheColumnsAndTheSpectrumOfTheSamplesMap) {
  const Pipeline pipeline(parse_scenario(R"(
seaglint: 1
radar: {pulses: 32}
sea: {significant_wave_height_m: 1, components: 64}
targets:
  reflector: {label: 0, mesh: assets/icosahedral_reflector.glb, motion: {model: float}}
dataset: {maps_per_case: 1, realisations_per_case: 1}
)",
                                         "reflector.yaml"));
  constexpr double kBand = 1e-4;  // the solver's interpolation over a band whose ends are off by less than a step
  const SampledInterval interval = sampled_interval(pipeline, 0);
  const SampleRecord record = pipeline.generate_sample(0).stored.record;
  EXPECT_NEAR(interval.record.scr_per_pulse_db, record.scr_per_pulse_db, 1e-6);
  EXPECT_NEAR(interval.record.peak_m, record.peak_m, kBand * record.peak_m);
  EXPECT_EQ(interval.record.centres, record.centres);
  const PulseTrain train = pipeline.pulse_train(0);
  std::vector<Complex> expected = pipeline.response(pipeline.plan().address(0), train).response.values;
  for (std::size_t i = 0; i < expected.size(); ++i) expected[i] *= train.chirp_spectrum[i % train.frequencies()];
  EXPECT_LT(relative_difference(spectrum_of(interval.target, train), expected), kBand);
}

TEST(MotionColumns, AreTheFirstBodysMotionInMidInterval) {
  const Pipeline pipeline(parse_scenario(R"(
seaglint: 1
radar: {pulses: 64, pri_jitter_us: 10}
sea: {significant_wave_height_m: 2, components: 64}
targets:
  array: {label: 0, mesh: assets/icosahedral_reflector.glb, motion: {model: float, translations: true, yaw_rate_std_deg_s: 3},
          layout: {line: {count: 2}}}
  points: {label: 1, points: [{position_m: [0, 0, 0], velocity_mps: [1, 0, 0]}]}
dataset: {maps_per_case: 2, realisations_per_case: 1}
)",
                                         "columns.yaml"));
  SampleAddress at;
  at.interval = 1;
  const std::size_t sample = pipeline.plan().sample(at);
  const SampleRecord record = pipeline.generate_sample(sample).stored.record;
  const PulseTrain train = pipeline.pulse_train(sample);
  const double middle_s = record.start_s + 0.5 * (train.time_s.front() + train.time_s.back());
  const Trajectory& first = pipeline.scene(at)->bodies[0].front();
  const auto at_time = [&](double t) {
    const MotionSample motion = first.sample(t);
    return std::array{degrees(motion.angles.x()), degrees(motion.angles.y()), degrees(motion.angles.z()),
                      motion.translation.z()};
  };
  const std::array stored{record.roll_deg, record.pitch_deg, record.yaw_deg, record.heave_m};
  const std::array rates{record.roll_rate_deg_s, record.pitch_rate_deg_s, record.yaw_rate_deg_s, record.heave_rate_mps};
  EXPECT_EQ(stored, at_time(middle_s));
  constexpr double kStep = 1e-4;  // s; the central difference of the cubic, with (kStep w)^2 / 6 of the rate
  for (std::size_t i = 0; i < 4; ++i) {
    const double rate = (at_time(middle_s + kStep)[i] - at_time(middle_s - kStep)[i]) / (2 * kStep);
    EXPECT_NE(rate, 0);
    EXPECT_NEAR(rates[i], rate, 1e-5 * std::abs(rate) + 1e-9) << i;
  }

  at.target = 1;
  const SampleRecord points = pipeline.generate_sample(pipeline.plan().sample(at)).stored.record;
  EXPECT_EQ(points.roll_deg, 0);
  EXPECT_EQ(points.heave_rate_mps, 0);
}

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

// Samples of scenarios with drawn values: each is that of the scenario with its values written out.

const char* const kPoints = R"yaml(
seaglint: 1
radar: {pulses: 32, hop_code: "choice(random, balanced)"}
view: {azimuth_deg: uniform(0 90), elevation_deg: 1}
sea: {significant_wave_height_m: uniform(0.5 1.5)}
clutter: {scr_db: uniform(10 25)}
targets:
  near: {label: 1, points: [{position_m: [15, 0, 0], amplitude_m: 2}]}
  far: {label: 0, points: [{position_m: [-10, 0, 0], amplitude_m: "uniform(1, 3)"}]}
dataset: {maps_per_case: 4, realisations_per_case: 2}
)yaml";

SampleRecord record_of(const Scenario& scenario, std::size_t sample) {
  return Pipeline(scenario, SamplePlan(scenario)).generate_sample(sample).stored.record;
}

double number(const SampleRecord& record, const std::string& key) {
  for (const auto& drawn : record.drawn_numbers)
    if (drawn.key == key) return drawn.value;
  return std::nan("");
}

TEST(DrawnSamples, HaveTheirValuesAsColumns) {
  const Scenario scenario = parse_scenario(kPoints, "points.yaml");
  const Pipeline pipeline(scenario, SamplePlan(scenario));
  std::set<double> ratios, amplitudes;
  for (std::size_t i = 0; i < pipeline.plan().size(); ++i) {
    const GeneratedSample made = pipeline.generate_sample(i);
    const SampleRecord& record = made.stored.record;
    ASSERT_EQ(record.drawn_numbers.size(), 4u);
    ASSERT_EQ(record.drawn_words.size(), 1u);
    EXPECT_EQ(record.azimuth_deg, number(record, "view.azimuth_deg"));
    EXPECT_EQ(record.significant_wave_height_m, number(record, "sea.significant_wave_height_m"));
    EXPECT_NEAR(record.scr_per_pulse_db, number(record, "clutter.scr_db"), 1e-6);
    // The peak of a point is its amplitude but for 15 % up to half a cell beside the peak of a Hann lobe in range, 1 %
    // of clutter 10 dB below one pulse and some 40 dB below the peak, and carriers that no pulse uses.
    const double amplitude = record.label == 1 ? 2 : number(record, "targets.far.points.0.amplitude_m");
    EXPECT_NEAR(record.peak_m, amplitude, 0.25 * amplitude);
    if (record.label == 0) amplitudes.insert(amplitude);
    ratios.insert(record.scr_per_pulse_db);
  }
  EXPECT_EQ(amplitudes.size(), 2u);  // one per sea
}

// Writing the values into the file gives the same maps, except for those keyed by the number of the view's values.
TEST(DrawnSamples, AreThoseOfTheWrittenOutScenario) {
  const Scenario scenario = parse_scenario(kPoints, "points.yaml");
  const SamplePlan plan(scenario);
  for (const std::size_t i : {0u, 3u, 7u}) {
    const SampleRecord drawn = record_of(scenario, i), fixed = record_of(plan.drawn(scenario, plan.address(i)), i);
    EXPECT_EQ(drawn.peak_m, fixed.peak_m);
    EXPECT_EQ(drawn.energy_m2, fixed.energy_m2);
    EXPECT_EQ(drawn.scr_per_pulse_db, fixed.scr_per_pulse_db);
    EXPECT_EQ(drawn.azimuth_deg, fixed.azimuth_deg);
  }
}

// The response is that of the interval's first map, clutter and noise are the map's own; in any order.
TEST(DrawnSamples, OfOneIntervalShareTheTargetsResponse) {
  const Scenario scenario = parse_scenario(kPoints, "points.yaml", {{"dataset.maps_per_interval", "2"}});
  const Pipeline pipeline(scenario, SamplePlan(scenario)), other(scenario, SamplePlan(scenario));
  ASSERT_EQ(pipeline.plan().size(), 8u);
  for (std::size_t first = 0; first < 8; first += 2) {
    const GeneratedSample a = pipeline.generate_sample(first), b = pipeline.generate_sample(first + 1);
    EXPECT_EQ(a.train.code, b.train.code);
    EXPECT_EQ(a.stored.record.azimuth_deg, b.stored.record.azimuth_deg);
    EXPECT_EQ(a.stored.record.label, b.stored.record.label);
    EXPECT_NE(a.stored.record.scr_per_pulse_db, b.stored.record.scr_per_pulse_db);
    EXPECT_NE(a.stored.magnitude, b.stored.magnitude);
    // Alone, without the first.
    EXPECT_EQ(other.generate_sample(first + 1).stored.magnitude, b.stored.magnitude);
  }
}

TEST(DrawnSamples, WithValuesThatContradictEachOtherAreRefusedBeforeTheFirst) {
  std::string text = kPoints;
  text.replace(text.find("uniform(0.5 1.5)}"), 17, "uniform(0.1 7), peak_period_s: uniform(5 15)}");
  text.replace(text.find("maps_per_case: 4, realisations_per_case: 2"), 42,
               "maps_per_case: 100, realisations_per_case: 100");
  const Scenario scenario = parse_scenario(text, "points.yaml");
  EXPECT_HAS(refusal_of([&] { const Pipeline pipeline(scenario, SamplePlan(scenario)); }), "of the drawn values");
}

// Warnings of one target whose recorded motion drifts at 2 m/s along x for 40 s, seen from ahead.
std::vector<std::string> warnings_of_drift(const std::string& motion, double spacing_s) {
  const TemporaryFolder folder;
  std::string series = "time_s,roll_deg,pitch_deg,surge_m,sway_m,heave_m\n";
  for (int n = 0; n <= 400; ++n) series += fmt::format("{:.1f},0,0,{:.1f},0,0\n", 0.1 * n, 412300 + 0.2 * n);
  write_file(folder.path() / "drift.csv", series);
  const Pipeline pipeline(parse_scenario(
      fmt::format("seaglint: 1\nview: {{azimuth_deg: 0, elevation_deg: 2}}\nmap: {{range_span_m: 60}}\ntargets:\n"
                  "  a: {{label: 0, mesh: assets/icosahedral_reflector.glb,\n"
                  "      motion: {{model: series, file: drift.csv{}}}}}\n"
                  "  b: {{label: 1, points: [{{position_m: [0, 0, 0]}}]}}\n"
                  "dataset: {{maps_per_case: 2, realisations_per_case: 1, interval_spacing_s: {}}}\n",
                  motion, spacing_s),
      (folder.path() / "drift.yaml").string()));
  return map_coverage_warnings(pipeline);
}

// The mean position is removed: the body is within 40 m of the origin, at first 40 m astern, where the map ends at 30
// m.
TEST(MapCoverage, NamesRecordedMotionThatLeavesTheMap) {
  EXPECT_THAT(warnings_of_drift("", 1), IsEmpty());  // without translations
  EXPECT_THAT(warnings_of_drift(", translations: true", 1),
              ElementsAre(HasSubstr("targets.a at azimuth 0 deg reaches from")));
  EXPECT_THAT(warnings_of_drift(", translations: true, series_start_s: 15", 1), IsEmpty());
  EXPECT_THAT(warnings_of_drift(", translations: true, series_start_s: 5", 30),
              ElementsAre(HasSubstr("raise map.range_span_m")));
  EXPECT_THAT(warnings_of_drift(", translations: true, position: keep, series_start_s: 15", 1),
              ElementsAre(HasSubstr("-412")));
}

// What `check` says of a scenario: how much of it there is, what moves and what does not.

double bytes_of(const std::filesystem::path& directory) {
  double bytes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory))
    if (entry.is_regular_file()) bytes += static_cast<double>(entry.file_size());
  return bytes;
}

TEST(WorkEstimate, HasTheSizeOfTheDataSetWithinAFactorOfTwo) {
  const std::vector<std::vector<Override>> cases{
      {},
      {{"dataset.echoes", "true"}},
      {{"dataset.complex_maps", "true"}, {"dataset.maps_per_shard", "3"}},
      {{"radar.pulses", "16"}, {"map.range_span_m", "20"}, {"features.max_centres", "3"}},
      {{"sea.peak_period_s", "uniform(7, 9)"}, {"radar.hop_code", "choice(random, stepped)"}}};
  for (const std::vector<Override>& overrides : cases) {
    const TemporaryFolder folder;
    const Pipeline pipeline(read_scenario(SEAGLINT_SOURCE_DIR "/scenarios/points.yaml", overrides));
    generate_dataset(pipeline, folder.path() / "data", {1, 1, false, 1});
    const double bytes = bytes_of(folder.path() / "data"), estimate = stored_bytes(pipeline);
    EXPECT_LT(estimate, 2 * bytes) << overrides.size();
    EXPECT_GT(estimate, bytes / 2) << overrides.size();
  }
}

TEST(WorkEstimate, OfMoreMapsIsInProportion) {
  const auto estimate = [](const char* maps) {
    return estimate_work(
        Pipeline(read_scenario(SEAGLINT_SOURCE_DIR "/scenarios/points.yaml",
                               {{"dataset.maps_per_case", maps}, {"dataset.realisations_per_case", "5"}})));
  };
  const WorkEstimate few = estimate("10"), many = estimate("1000");
  EXPECT_GT(few.processor_s, 0);
  EXPECT_GT(many.processor_s, 10 * few.processor_s);  // 100 times the maps of as many seas
  EXPECT_FALSE(many.is_bound);
}

TEST(WorkEstimate, IsABoundWhereOneMapTakesLongerThanTheLimit) {
  const Pipeline pipeline(read_scenario(SEAGLINT_SOURCE_DIR "/scenarios/points.yaml"));
  const WorkEstimate work = estimate_work(pipeline, {.processor_s = 0});
  EXPECT_TRUE(work.is_bound);
  EXPECT_GT(work.processor_s, 0);
  EXPECT_GT(work.bytes, 0);
}

// A plate across the line of sight returns no cross polarisation.
TEST(WorkEstimate, HasTheReasonWhereNoMapCanBeMade) {
  const TemporaryFolder folder;
  write_file(folder.path() / "plate.obj", "v 0 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n");
  write_file(folder.path() / "plate.yaml",
             "seaglint: 1\nradar: {polarisation: hv}\nview: {azimuth_deg: 0, elevation_deg: 0}\ntargets:\n  plate: "
             "{label: 1, mesh: plate.obj, solver: {edges: false}}\n");
  const WorkEstimate work = estimate_work(Pipeline(read_scenario(folder.path() / "plate.yaml")));
  EXPECT_HAS(work.failure, "plate.yaml:5:10: targets.plate: sample ");
  EXPECT_HAS(work.failure, "has no power");
}

TEST(ScenarioSummary, CountsSeasAndMapsAndListsWhatVariesAndMoves) {
  const Pipeline pipeline(parse_scenario(R"(
seaglint: 1
radar: {pulses: 32}
view: {azimuth_deg: 0:350:10, elevation_deg: uniform(1 5)}
sea: {significant_wave_height_m: [0.1, 3], peak_period_s: loguniform(7 9), components: 64}
targets:
  still: {label: 0, mesh: assets/icosahedral_reflector.glb}
  pair: {label: 1, points: [{position_m: [9, 0, 0]}, {position_m: [-9, 0, 0]}]}
dataset: {maps_per_case: 24, realisations_per_case: 4, maps_per_interval: 2, interval_spacing_s: 5}
)",
                                         "summary.yaml"));
  const std::string text = scenario_summary(pipeline, {7200, false, 3.2e6, {}}, 4);
  EXPECT_EQ(
      text,
      "seas                8: 4 realisations of each sea state, 3 intervals of each 5 s apart and view, 2 maps of "
      "each interval\n"
      "swept               view.azimuth_deg 0 to 350 in 36 values\n"
      "                    sea.significant_wave_height_m 0.1, 3\n"
      "drawn               sea.peak_period_s loguniform(7, 9), once per sea\n"
      "                    view.elevation_deg uniform(1, 5), once per observation\n"
      "moves               still: does not move: targets.still.motion.model is fixed\n"
      "                    pair: 2 points with velocities of their own in any sea\n"
      "clutter             20 dB below the target per pulse; texture of shape 2; velocity 0 m/s, spread 0.5 m/s in any "
      "sea; noise 30 dB below it\n"
      "work                about 2 h of processor, 30 min on 4 threads, 3.2 MB of maps\n");
}

TEST(ScenarioSummary, HasTheMeanPowerOfClutterAndNoiseThatEchoesHave) {
  const Pipeline pipeline(parse_scenario(R"(
seaglint: 1
radar: {pulses: 16}
view: {azimuth_deg: 0, elevation_deg: 3}
sea: {significant_wave_height_m: 1.5, peak_period_s: 7, propagation_deg: 0, components: 64}
targets:
  buoy: {label: 0, points: [{position_m: [0, 0, 0]}]}
  pair: {label: 1, points: [{position_m: [9, 0, 0]}, {position_m: [-9, 0, 0]}]}
clutter: {level: nrl, noise_level: thermal, doppler: sea_state, texture_shape: 1000}
dataset: {maps_per_case: 40, realisations_per_case: 40}
)",
                                         "level.yaml"));
  const std::string text = scenario_summary(pipeline, {}, 1);
  const auto number_after = [&](const std::string& words) {
    return std::stod(text.substr(text.find(words) + words.size()));
  };
  double clutter = 0, noise = 0;
  const std::size_t samples = pipeline.plan().size();
  for (std::size_t i = 0; i < samples; ++i) {
    const PulseTrain train = pipeline.pulse_train(i);
    const SampleAddress at = pipeline.plan().address(i);
    const Echo echo = pipeline.echo(i, train, pipeline.response(at, train), pipeline.scenario().clutter);
    clutter += mean_power(echo.clutter) / static_cast<double>(samples);
    noise += mean_power(echo.noise) / static_cast<double>(samples);
  }
  // Speckle of 528 scatterers in 80 maps: 0.5 %; the mean of |P|^2 over the band is 1 within 1 %.
  EXPECT_HAS(text, "(nrl, vv, elevation 3 deg, Douglas sea state 3.70) on 197.9 m x 39");
  EXPECT_NEAR(number_after(": mean |Y|^2 ") / clutter, 1, 0.03);
  EXPECT_NEAR(number_after("thermal noise, mean |Y|^2 ") / noise, 1, 0.02);
  EXPECT_HAS(text, "; velocity -");
  EXPECT_HAS(text, " at Hs 1.5 m, azimuth 0 deg; ");
}

// At 9.4 GHz, 2 deg, 20 km and 1.5 deg of beam, vv: shape 1.6 along the waves (clutter_test.cpp), and (pi/2) U^2/g
// sqrt(4), U^2/g = Hs / 0.22, of the length.
TEST(ClutterWarnings, NameTextureFarFromMeasuredClutter) {
  const auto warnings = [](const std::string& clutter, double carrier_ghz = 9.4,
                           const std::string& bands = "hop_count: 4") {
    return clutter_warnings(Pipeline(parse_scenario(fmt::format(R"(
seaglint: 1
radar: {{carrier_ghz: {}, {}, pulses: 16, range_km: 20, link_budget: {{beamwidth_deg: 1.5}}}}
view: {{azimuth_deg: 0, elevation_deg: 2}}
sea: {{significant_wave_height_m: 1.5, peak_period_s: 7, propagation_deg: 0, components: 64}}
targets: {{buoy: {{label: 0, points: [{{position_m: [0, 0, 0]}}]}}}}
clutter: {{{}}}
)",
                                                                carrier_ghz, bands, clutter),
                                                    "texture.yaml")));
  };
  EXPECT_THAT(warnings("scr_db: 10"), testing::IsEmpty());
  EXPECT_THAT(warnings("texture_shape: 2"), testing::IsEmpty());
  EXPECT_THAT(warnings("texture_shape: 100"),
              testing::ElementsAre("clutter.texture_shape: 100, where measured clutter has about 1.6 in this scene"));
  EXPECT_THAT(warnings("texture_shape: 100", 16), testing::IsEmpty());
  EXPECT_THAT(
      warnings("texture_correlation_m: 2"),
      testing::ElementsAre("clutter.texture_correlation_m: 2, where measured clutter has about 15 in this scene"));
  EXPECT_THAT(warnings("doppler: wave_resolved, texture_correlation_m: 2"), testing::IsEmpty());
  // Of a cell of 30 m, by its many scatterers.
  EXPECT_THAT(warnings("doppler: wave_resolved, texture_shape: 0.1", 9.4,
                       "hop_count: 1, hop_step_mhz: 5, bandwidth_mhz: 5, pulse_width_us: 4, sampling_mhz: 10"),
              testing::Contains(testing::HasSubstr("clutter.texture_shape: 0.1: with texture: waves the power in a "
                                                   "cell of ")));
}

}  // namespace
}  // namespace seaglint
