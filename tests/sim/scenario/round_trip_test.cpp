// SPDX-License-Identifier: BSD-3-Clause
// Round trip of every field: changed to another allowed value, written, read back, compared bit by bit.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <string_view>

#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace seaglint {
namespace {

// All values, exactly.
struct Collector : PathVisitor {
  std::map<std::string, std::string> values;

  void value(const char* key, const KeyField& value, const char*) override {
    std::string& text = values[path_of(key)] = value_as_yaml(value);
    if (const auto* number = std::get_if<NumberField>(&value)) text = fmt::format("{:a}", number->value);
    if (const auto* ratio = std::get_if<RatioField>(&value)) text = fmt::format("{:a}", ratio->fraction);
    if (const auto* sweep = std::get_if<SweepField>(&value)) {
      for (const double number : sweep->values) text += fmt::format(" {:a}", number);
    }
  }
};

// Another allowed value for every field, with as many digits as a double has.
class Mutator : public PathVisitor {
 public:
  explicit Mutator(std::uint64_t index, bool words_only = false)
      : random_({1, Stream::kTest, index}), words_only_(words_only) {}

  void value(const char* key, const KeyField& value, const char*) override {
    // Without the role, which decides whether there is a label.
    if (path_of(key) == "seaglint" || std::string_view(key) == "role") return;
    const bool is_words = std::holds_alternative<ChoiceField>(value) || std::holds_alternative<NaturalField>(value) ||
                          std::holds_alternative<NamesField>(value);
    if (!words_only_ || is_words) std::visit([&](const auto& field) { change(field); }, value);
  }

 private:
  void change(const NumberField& field) { field.value = draw(field.bound); }
  void change(const NumberOrAutoField& field) { field.value = draw(field.bound); }
  void change(const IntegerField& field) {
    const auto low = static_cast<std::int64_t>(std::ceil(field.bound.lowest));
    const auto high = static_cast<std::int64_t>(std::floor(field.bound.highest));
    field.value = static_cast<int>(low + random_.below(static_cast<std::uint32_t>(high - low)));
  }
  void change(const NaturalField& field) { field.value = random_.bits() >> 1; }
  void change(const FlagField& field) { field.value = !field.value; }
  void change(const TextField& field) { field.value += " \"'\\ #: \xc3\xa9 {[&*"; }
  void change(const ChoiceField& field) { field.index = (field.index + 1) % field.words.size(); }
  void change(const TripleField& field) {
    for (double& value : field.values) value = draw(field.bound);
  }
  void change(const RatioField& field) { field.fraction = random_.uniform(); }
  void change(const NamesField& field) {
    for (std::string& name : field.values) name += "_1-b c";
  }
  void change(const SweepField& field) {
    if (field.word > 0) return;
    field.values.resize(1 + random_.below(3));
    for (double& value : field.values) value = draw(field.bound);
  }
  void change(const HoldOutsField& field) {
    field.columns = {{"target_name", {"ring", "a \"line\": #1", "-3"}}, {"sea.peak_period_s", {"8:9.5"}}};
  }

  double draw(const Bound& bound) {
    const double low = std::max(bound.lowest, -1e5);
    const double high = std::min(bound.highest, low + 1e5);
    return low + (high - low) * random_.uniform();
  }

  Random random_;
  bool words_only_;
};

Scenario full_scenario() {
  Scenario scenario;
  scenario.name = "full";
  TargetSpec ship;
  ship.name = "ship-1";
  ship.label = 1;
  ship.mesh = "ship.glb";
  ship.forward = "+y";
  ship.offset_m = {1, 2, 3};
  ship.motion.rotation_centre_m = {1, 2, 3};
  ship.companions = {{"array", 0, 0}};
  ship.part_materials = {{"mast", "pec"}, {"hull*", "steel"}};
  TargetSpec array;
  array.name = "array";
  array.mesh = "null";
  array.layout = LayoutSpec{.line = LineLayout{},
                            .heights_m = BodyRange{1, 2},
                            .headings_deg = BodyRange{},
                            .scales = BodyRange{1, 1},
                            .seed = 3};
  TargetSpec ring = array;
  ring.name = "ring";
  ring.layout = LayoutSpec{.area = AreaLayout{}};
  TargetSpec points;
  points.name = "points";
  points.points.resize(2);
  scenario.sea.depth_m = 30;
  scenario.clutter.sea_state = 3;
  scenario.targets = {ship, array, ring, points};
  scenario.dataset.classes = {"null", "true", "1e3", "d", "e", "f", "g", "h", "i", "k"};  // one for every label
  return scenario;
}

std::map<std::string, std::string> values_of(Scenario scenario) {
  Collector collector;
  visit_fields(scenario, collector);
  return collector.values;
}

// Mutated values may contradict each other; these are corrected.
void make_consistent(Scenario& scenario) {
  scenario.radar.pulse_width_us = scenario.radar.pri_us / 3;
  if (scenario.radar.pulse_width_us < 0.001 || scenario.radar.pulse_width_us > 1e6) {
    scenario.radar.pri_us = 100.1;
    scenario.radar.pulse_width_us = 0.7;
  }
  scenario.radar.pri_jitter_us = scenario.radar.pri_us / 3.1 * (0.5 + 0.4 / (1 + scenario.radar.pri_jitter_us));
  scenario.map.range_span_m = std::min(scenario.map.range_span_m, 90 * scenario.radar.pri_us);
  if (scenario.sea_reflection.enabled) {
    scenario.radar.carrier_ghz = std::min(scenario.radar.carrier_ghz, 48.1);
    scenario.radar.hop_step_mhz = std::min(scenario.radar.hop_step_mhz, 30e3 / scenario.radar.carrier_count);
  }
  scenario.radar.bandwidth_mhz = std::min(scenario.radar.bandwidth_mhz, 1.3e3 * scenario.radar.carrier_ghz);
  scenario.radar.sampling_mhz = std::max(scenario.radar.bandwidth_mhz * 1.7, 8.3 / scenario.radar.pulse_width_us);
  for (TargetSpec& target : scenario.targets) {
    if (!target.layout) continue;
    for (const auto range : {&LayoutSpec::heights_m, &LayoutSpec::headings_deg, &LayoutSpec::scales}) {
      std::optional<BodyRange>& ends = (*target.layout).*range;
      if (ends && ends->lowest > ends->highest) std::swap(ends->lowest, ends->highest);
    }
    if (target.layout->area) target.layout->area->min_distance_m /= 1e9;
  }
  scenario.dataset.realisations_per_case = 7;
  scenario.dataset.maps_per_case = 7 * 13;
  scenario.dataset.maps_per_interval = 13;
  for (double& height : scenario.sea.significant_wave_height_m) height *= 1e-3;
  scenario.sea.swell.significant_wave_height_m *= 1e-3;
  scenario.sea.cutoff_rad_s = scenario.sea.period_rule == PeakPeriod::kGiven ? 20 + 0.7 * scenario.sea.cutoff_rad_s : 0;
  // Their peak periods are within bounds.
  SwellSpec& swell = scenario.sea.swell;
  for (Sweep* periods : {&scenario.sea.energy_period_s, &scenario.sea.zero_crossing_period_s})
    for (double& period : *periods) period = 0.6 + 0.65 * period;
  for (std::optional<double>* period : {&swell.energy_period_s, &swell.zero_crossing_period_s})
    if (*period) **period = 0.6 + 0.65 * **period;
  scenario.sea.components = 1 + scenario.sea.components % 1000;
  scenario.sea.swell.components = 1 + scenario.sea.swell.components % 1000;
  if (scenario.sea_reflection.enabled) {
    for (double& elevation : scenario.view.elevation_deg) elevation = std::max(std::abs(elevation), 1e-3);
    scenario.radar.platform.velocity_mps[2] = std::abs(scenario.radar.platform.velocity_mps[2]);
  }
  for (TargetSpec& target : scenario.targets) {
    // A part must be a companion; this one is the ship's.
    if (target.name == "array" && scenario.seed % 2 == 0) target.role = TargetRole::kPart;
    if (target.role == TargetRole::kPart) target.label = 0;
    if (!target.mesh.empty()) scenario.radar.intra_pulse_motion = false;
    for (CompanionSpec& companion : target.companions) companion.target = "array";
    for (TargetSpec& array : scenario.targets) {
      if (!target.companions.empty() && array.name == "array")
        array.solver.wavefront_range_m = target.solver.wavefront_range_m;
    }
    if (target.motion.model == MotionModel::kFixed || target.motion.model == MotionModel::kFloat)
      target.motion.speed_mps = 0;
  }
}

TEST(RoundTrip, EveryFieldComesBackToTheBit) {
  const auto defaults = values_of(full_scenario());
  std::map<std::string, int> changes;
  for (std::uint64_t round = 0; round < 200; ++round) {
    Scenario scenario = full_scenario();
    if (round % 4 == 3) {
      scenario.sea.period_rule = PeakPeriod::kDnvWindSea;
      scenario.sea.peak_period_s.clear();
    }
    if (round % 4 == 2) {
      scenario.sea.period_rule = PeakPeriod::kWindAndFetch;
      scenario.sea.peak_period_s.clear();
    }
    if (round % 8 == 1) {
      scenario.sea.energy_period_s = {7};
      scenario.sea.coming_from_deg = {10};
      scenario.sea.swell.zero_crossing_period_s = 9;
      scenario.sea.swell.coming_from_deg = 20;
    }
    if (round % 8 == 5) {
      scenario.sea.zero_crossing_period_s = {6};
      scenario.sea.swell.energy_period_s = 9;
    }
    // The choice after a table is JONSWAP, which has most keys; a table needs its file (spectrum_table_test.cpp).
    if (round % 2 == 0) scenario.sea.spectrum = SpectrumKind::kTable;
    if (round % 4 == 1) scenario.targets.erase(scenario.targets.begin(), scenario.targets.begin() + 3);  // the meshes
    Mutator mutator(round);
    visit_fields(scenario, mutator);
    make_consistent(scenario);
    const std::string yaml = effective_yaml(scenario);
    const auto expected = values_of(scenario);
    for (const auto& [path, value] : expected) {
      const auto standard = defaults.find(path);
      changes[path] += standard == defaults.end() || value != standard->second ? 1 : 0;
    }
    try {
      const Scenario read = parse_scenario(yaml, "effective.yaml");
      EXPECT_EQ(values_of(read), expected) << yaml;
      EXPECT_TRUE(read == scenario) << yaml;
    } catch (const InputError& error) {
      ADD_FAILURE() << error.what() << "\n" << yaml;
    }
  }
  // The mutation reached every field but the format's version.
  for (const auto& [path, count] : changes)
    EXPECT_TRUE(count > 0 || path == "seaglint" || path == "targets.ship-1.companions.0.target" ||
                (path.ends_with(".role") && path != "targets.array.role"))
        << path << " was never changed";
  EXPECT_GT(changes.size(), 120u);
}

TEST(RoundTrip, DefaultsRoundTripAndTheEffectiveScenarioIsIdempotent) {
  const Scenario scenario = full_scenario();
  const std::string yaml = effective_yaml(scenario);
  const Scenario read = parse_scenario(yaml, "effective.yaml");
  EXPECT_EQ(values_of(read), values_of(scenario));
  EXPECT_EQ(effective_yaml(read), yaml);
}

TEST(RoundTrip, EqualScenariosHaveTheSameKeysWhereverTheyWereRead) {
  const std::string text =
      "seaglint: 1\nname: a\ntargets:\n  a: {label: 1, points: [{position_m: [1, 2, 3]}]}\n"
      "  b: {role: part, label: 3, mesh: b.obj}\n  c: {label: 0, mesh: c.obj, companions: [{target: b}]}\n"
      "sea: {significant_wave_height_m: uniform(0.1 2)}\n";
  const Scenario scenario = parse_scenario(text, "here/a.yaml");
  EXPECT_TRUE(parse_scenario(text, "there/a.yaml") == scenario);
  EXPECT_TRUE(parse_scenario(effective_yaml(scenario), "a.yaml") == scenario);
  for (const Override& other : std::vector<Override>{{"name", "b"},
                                                     {"targets.c.unit", "cm"},
                                                     {"targets.c.label", "1"},
                                                     {"sea.depth_m", "8"},
                                                     {"targets.c.motion.waves", "independent"},
                                                     {"sea.significant_wave_height_m", "uniform(0.1 3)"}})
    EXPECT_FALSE(parse_scenario(text, "a.yaml", {other}) == scenario) << other.key_path;
}

TEST(RoundTrip, EveryAllowedWordIsRead) {
  // Each choice is written by name and read back by name; a name listed twice or out of order would not be recovered.
  for (int step = 0; step < 6; ++step) {
    Scenario scenario = full_scenario();
    scenario.clutter.enabled = false;  // its reflectivity is modelled for two of the polarisations
    for (int i = 0; i < step; ++i) {
      Mutator change(0, true);
      visit_fields(scenario, change);
    }
    if (scenario.sea.spectrum == SpectrumKind::kTable) scenario.sea.spectrum = SpectrumKind::kJonswap;
    if (scenario.radar.hop_code == HopCode::kFile) scenario.radar.hop_code = HopCode::kRandom;  // needs its file too
    EXPECT_EQ(values_of(parse_scenario(effective_yaml(scenario), "effective.yaml")), values_of(scenario));
  }
}

}  // namespace
}  // namespace seaglint
