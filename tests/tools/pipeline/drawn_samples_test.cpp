// SPDX-License-Identifier: BSD-3-Clause
// Samples of scenarios with drawn values: each is that of the scenario with its values written out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "sim/core/process/error.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {
namespace {

using testing::HasSubstr;

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
  try {
    const Pipeline pipeline(scenario, SamplePlan(scenario));
    ADD_FAILURE() << "not refused";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("of the drawn values"));
  }
}

}  // namespace
}  // namespace seaglint
