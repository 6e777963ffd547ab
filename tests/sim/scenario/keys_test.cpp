// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <regex>
#include <string>
#include <string_view>

#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/text/words.h"
#include "sim/scenario/fields.h"
#include "sim/scenario/keys.h"
#include "sim/scenario/scenario.h"
#include "tests/refusal.h"
#include "tests/sim/scenario/parsing.h"

namespace seaglint {
namespace {

using Json = nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using testing_scenarios::kPaper;

// As the core schema of YAML 1.2 reads it, which editors have.
Json json_of(const YamlNode& node) {
  Json json;
  switch (node.kind) {
    case YamlNode::Kind::kNull: break;
    case YamlNode::Kind::kList:
      json = Json::array();
      for (const YamlNode& item : node.items) json.push_back(json_of(item));
      break;
    case YamlNode::Kind::kMap:
      json = Json::object();
      for (const YamlEntry& entry : node.entries) json[entry.key] = json_of(entry.value);
      break;
    case YamlNode::Kind::kScalar:
      if (node.quoted) return node.text;
      if (node.text == "true" || node.text == "false") return node.text == "true";
      if (const auto whole = parse_integer(node.text)) return *whole;
      if (const auto number = parse_number(node.text)) return *number;
      json = node.text;
  }
  return json;
}

// Validation by the keywords of JSON Schema that the schema uses (draft 7).
class Validator {
 public:
  Validator() : root_(Json::parse(scenario_schema())) {}

  // The path of the first value that is not valid, "/" for the whole; empty for a valid text.
  std::string fault(const std::string& yaml) const {
    std::string path;
    if (is_valid(json_of(parse_yaml(yaml, "test.yaml")), root_, path)) return "";
    return path.empty() ? "/" : path;
  }

 private:
  static bool has_type(const Json& value, const std::string& type) {
    return type == "object"    ? value.is_object()
           : type == "array"   ? value.is_array()
           : type == "string"  ? value.is_string()
           : type == "boolean" ? value.is_boolean()
           : type == "number"  ? value.is_number()
           : type == "integer" ? value.is_number_integer()
                               : throw std::logic_error(type);
  }

  bool is_valid(const Json& value, const Json& schema, std::string& path) const {
    for (const auto& [keyword, of] : schema.items())
      if (!holds(value, schema, keyword, of, path)) return false;
    return true;
  }

  bool holds(const Json& value, const Json& schema, const std::string& keyword, const Json& of,
             std::string& path) const {
    const bool is_bound = keyword.ends_with("inimum") || keyword.ends_with("aximum");
    if (is_bound && !value.is_number()) return true;
    if (keyword == "minimum") return value >= of;
    if (keyword == "maximum") return value <= of;
    if (keyword == "exclusiveMinimum") return value > of;
    if (keyword == "exclusiveMaximum") return value < of;
    if (keyword == "type")
      return of.is_string() ? has_type(value, of)
                            : std::ranges::any_of(of, [&](const Json& type) { return has_type(value, type); });
    if (keyword == "const") return value == of;
    if (keyword == "enum") return std::ranges::find(of, value) != of.end();
    if (keyword == "pattern")
      return !value.is_string() || std::regex_search(value.get<std::string>(), std::regex(of.get<std::string>()));
    if (keyword == "anyOf") {
      std::string ignored;
      return std::ranges::any_of(of, [&](const Json& form) { return is_valid(value, form, ignored); });
    }
    if (keyword == "$ref") return is_valid(value, root_["definitions"]["drawn"], path);
    if (keyword == "minItems") return !value.is_array() || value.size() >= of;
    if (keyword == "maxItems") return !value.is_array() || value.size() <= of;
    if (keyword == "minProperties") return !value.is_object() || value.size() >= of;
    if (keyword == "maxProperties") return !value.is_object() || value.size() <= of;
    if (keyword == "items")
      return !value.is_array() ||
             std::ranges::all_of(value, [&](const Json& item) { return is_valid(item, of, path); });
    if (keyword == "required")
      return std::ranges::all_of(of, [&](const Json& key) { return value.contains(key.get<std::string>()); });
    if (keyword == "propertyNames" || keyword == "additionalProperties" || keyword == "properties") {
      if (!value.is_object()) return true;
      for (const auto& [key, property] : value.items()) {
        const bool is_stated = schema.contains("properties") && schema["properties"].contains(key);
        const std::string before = std::exchange(path, path + "/" + key);
        if (keyword == "propertyNames" && !is_valid(key, of, path)) return false;
        if (keyword == "properties" && is_stated && !is_valid(property, of[key], path)) return false;
        if (keyword == "additionalProperties" && !is_stated && (of == false || !is_valid(property, of, path)))
          return false;
        path = before;
      }
      return true;
    }
    EXPECT_THAT((std::vector<std::string>{"description", "title", "$schema", "definitions"}),
                testing::Contains(keyword));
    return true;
  }

  Json root_;
};

TEST(KeyList, HaveAMeaningEachAndAUnitWhereTheirNameEndsWithOne) {
  const std::vector<KeyEntry> keys = scenario_keys();
  EXPECT_GT(keys.size(), 200u);
  for (const KeyEntry& key : keys) {
    EXPECT_GE(key.meaning.size(), 8u) << key.key;
    EXPECT_THAT(key.meaning, testing::EndsWith(".")) << key.key;
    EXPECT_EQ(key.unit, unit_of(key.key)) << key.key;
    EXPECT_HAS(key.allowed, key.unit) << key.key;
  }
  const auto entry = [&](const std::string& name) { return *std::ranges::find(keys, name, &KeyEntry::key); };
  EXPECT_EQ(entry("radar.carrier_ghz").unit, "GHz");
  EXPECT_EQ(entry("radar.carrier_ghz").drawn, std::nullopt);
  EXPECT_EQ(entry("sea.cutoff_rad_s").unit, "rad/s");
  EXPECT_EQ(entry("sea.spreading.s").unit, "");
  EXPECT_EQ(entry("targets.NAME.scale").standard, "1");
  EXPECT_EQ(entry("targets.NAME.scale").drawn, DrawnPer::kSea);
  EXPECT_EQ(entry("targets.NAME.offset_m").drawn, std::nullopt);
  EXPECT_EQ(entry("targets.NAME.label").standard, "required");
}

TEST(KeyList, AreFoundByNameSectionAndWord) {
  EXPECT_THAT(list_keys("sea.swell.gamma"), StartsWith("sea.swell.gamma "));
  EXPECT_HAS(list_keys("sea.swell.gamma"), "    May be drawn, once per sea.\n");
  EXPECT_THAT(list_keys("radar.carrier_ghz"), Not(HasSubstr("drawn")));
  const std::string by_word = list_keys("JITTER");
  EXPECT_HAS(by_word, "radar.pri_jitter_us           0  within 0 and 10000000 us\n");
  EXPECT_HAS(by_word, "once per observation");
  const std::string by_meaning = list_keys("jonswap");
  for (const char* key : {"sea.spectrum ", "sea.gamma ", "sea.swell.gamma "}) EXPECT_HAS(by_meaning, key);
  EXPECT_THAT(by_meaning, Not(HasSubstr("radar.")));
  EXPECT_THROW(list_keys("seaa.gamma"), InputError);
}

TEST(KeySchema, IsTheCommittedFile) {
  EXPECT_EQ(read_file(SEAGLINT_SOURCE_DIR "/scenarios/schema.json"), scenario_schema())
      << "make it again: seaglint keys --schema > scenarios/schema.json";
  EXPECT_LT(scenario_schema().size(), 200'000u);
}

TEST(KeySchema, AcceptsEveryShippedScenarioAndItsEffectiveForm) {
  namespace fs = std::filesystem;
  const Validator validator;
  EXPECT_EQ(validator.fault(kPaper), "");
  for (const auto& entry : fs::recursive_directory_iterator(SEAGLINT_SOURCE_DIR "/scenarios")) {
    if (entry.path().extension() != ".yaml") continue;
    const std::string text = read_file(entry.path());
    EXPECT_EQ(validator.fault(text), "") << entry.path();
    EXPECT_EQ(validator.fault(effective_yaml(read_scenario(entry.path()))), "") << entry.path();
    const std::string modeline = "# yaml-language-server: $schema=", first = text.substr(0, text.find('\n'));
    ASSERT_THAT(first, StartsWith(modeline)) << entry.path();
    EXPECT_TRUE(fs::exists(entry.path().parent_path() / first.substr(modeline.size()))) << entry.path();
  }
}

TEST(KeySchema, RefusesWhatTheReaderRefuses) {
  const Validator validator;
  const std::string start = "seaglint: 1\ntargets: {a: {label: 1, mesh: a.obj, ", close = "}}\n";
  EXPECT_EQ(validator.fault(start + "scale: uniform(1 2)" + close), "");
  EXPECT_EQ(validator.fault(start + "solver: {crease_deg: auto}" + close), "");
  for (const auto& [keys, path] : std::vector<std::pair<std::string, std::string>>{
           {"scale: 0", "/targets/a/scale"},
           {"scale: wide", "/targets/a/scale"},
           {"offset_m: [1, 2]", "/targets/a/offset_m"},
           {"offset_m: uniform(1 2)", "/targets/a/offset_m"},
           {"label: uniform(0 1)", "/targets/a/label"},
           {"unit: furlong", "/targets/a/unit"},
           {"sclae: 2", "/targets/a/sclae"},
           {"solver: {crease_deg: none}", "/targets/a/solver/crease_deg"},
           {"solver: {max_bounces: 2.5}", "/targets/a/solver/max_bounces"},
           {"solver: {ray_spacing_m: 1e-6}", "/targets/a/solver/ray_spacing_m"},
           {"points: [{amplitude_m: 1}]", "/targets/a/points"}}) {
    EXPECT_THAT(validator.fault(start + keys + close), StartsWith(path)) << keys;
    EXPECT_THROW(parse_scenario(start + keys + close, "wrong.yaml"), InputError) << keys;
  }
  for (const std::string wrong :
       {"targets: {a: {label: 1, mesh: a.obj}}\n", "seaglint: 2\ntargets: {a: {label: 1, mesh: a.obj}}\n",
        "seaglint: 1\n", "seaglint: 1\ntargets: []\n", "seaglint: 1\ntargets: {a b: {label: 1, mesh: a.obj}}\n"}) {
    EXPECT_NE(validator.fault(wrong), "") << wrong;
    EXPECT_THROW(parse_scenario(wrong, "wrong.yaml"), InputError) << wrong;
  }
}

TEST(VariedKeys, AreTheSweepsThenTheDrawnKeys) {
  const Scenario scenario = parse_scenario(R"yaml(
seaglint: 1
view: {azimuth_deg: 10:170:10, elevation_deg: normal(3 0.5)}
sea: {significant_wave_height_m: [0.1, 2], peak_period_s: [8], gamma: dnv_rule, propagation_deg: uniform(0 360)}
targets:
  a: {label: 1, mesh: a.obj, layout: {line: {count: integers(2 5), spacing_m: 9}}, motion: {model: "choice(fixed, ship)"}}
  b: {label: 0, mesh: a.obj, layout: {line: {count: same(targets.a.layout.line.count), spacing_m: 9}}}
clutter: {scr_db: uniform(10 20)}
)yaml",
                                           "varied.yaml");
  const std::vector<VariedKey> keys = varied_keys(scenario);
  std::vector<std::string> texts;
  for (const VariedKey& key : keys) texts.push_back(key.key_path + " " + key.text());
  EXPECT_THAT(texts, ElementsAre("view.azimuth_deg 10 to 170 in 17 values", "sea.significant_wave_height_m 0.1, 2",
                                 "clutter.scr_db uniform(10, 20), once per map",
                                 "sea.propagation_deg uniform(0, 360), once per sea",
                                 "targets.a.layout.line.count integers(2, 5), once per sea",
                                 "targets.a.motion.model choice(fixed, ship), once per sea",
                                 "targets.b.layout.line.count same(targets.a.layout.line.count), once per sea",
                                 "view.elevation_deg normal(3, 0.5), once per observation"));
  EXPECT_THAT(keys[0].trial_values(), ElementsAre("90", "10", "170"));
  EXPECT_THAT(keys[1].trial_values(), ElementsAre("2", "0.1"));
  EXPECT_THAT(keys[4].trial_values(), ElementsAre("3", "2", "5"));
  EXPECT_THAT(keys[5].trial_values(), ElementsAre("fixed", "ship"));
  EXPECT_THAT(keys[7].trial_values(), ElementsAre("3", "-1.5", "7.5"));
}

TEST(VariedKeys, AreNoneOfAScenarioWithOneValueOfEachKey) {
  EXPECT_TRUE(varied_keys(parse_scenario("seaglint: 1\ntargets: {a: {label: 1, mesh: a.obj}}\n", "one.yaml")).empty());
}

// Round trip of every field: changed to another allowed value, written, read back, compared bit by bit.

// All values, exactly.
struct Collector : PathVisitor {
  std::map<std::string, std::string> values;

  void value(const char* key, const KeyField& value, const char*) override {
    std::string& text = values[path_of(key)] = value_as_yaml(value);
    if (const auto* number = std::get_if<NumberField>(&value)) text = fmt::format("{:a}", number->value);
    if (const auto* ratio = std::get_if<RatioField>(&value)) text = fmt::format("{:a}", ratio->fraction);
    if (const auto* sweep = std::get_if<SweepField>(&value))
      for (const double number : sweep->values) text += fmt::format(" {:a}", number);
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
    const double low = std::max(bound.lowest, -1e5), high = std::min(bound.highest, low + 1e5);
    return low + (high - low) * random_.uniform();
  }

  Random random_;
  bool words_only_;
};

Scenario full_scenario() {
  Scenario scenario;
  scenario.name = "full";
  scenario.looks.count = 2;
  TargetSpec ship;
  ship.name = "ship-1";
  ship.label = 1;
  ship.mesh = "ship.glb";
  ship.forward = "+y";
  ship.offset_m = {1, 2, 3};
  ship.motion.rotation_centre_m = {1, 2, 3};
  ship.motion.model = MotionModel::kSeries;
  ship.motion.speed_mps = 5;
  ship.companions = {{"array", 0, 0, true}};
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
  TargetSpec floats = array;
  floats.name = "floats";
  floats.layout->jitter_m = 1;
  floats.layout->tether_slack = 0.1;
  floats.motion.model = MotionModel::kFloat;
  floats.motion.translations = true;
  floats.motion.drift = DriftSpec{};
  TargetSpec made;
  made.name = "made";
  made.ship = ShipSpec{.loading = 0.5};
  TargetSpec decoy;
  decoy.name = "decoy";
  decoy.decoy = DecoySpec{.seam_errors_deg = {1, 2, 3}};
  TargetSpec points;
  points.name = "points";
  points.points.resize(2);
  scenario.sea.depth_m = 30;
  scenario.clutter.sea_state = 3;
  scenario.targets = {ship, array, ring, floats, made, decoy, points};
  scenario.dataset.classes = {"null", "true", "1e3", "d", "e", "f", "g", "h", "i", "k"};  // one for every label
  return scenario;
}

std::map<std::string, std::string> values_of(Scenario scenario) {
  Collector collector;
  visit_fields(scenario, collector);
  return collector.values;
}

// Without the speed of floats and fixed bodies, drift and ropes of what is no float, tows by what has no speed, and
// tows of what moves by itself.
void correct_motions(Scenario& scenario) {
  const auto drifts = [&](const std::string& name) {
    return std::ranges::any_of(scenario.targets, [&](const TargetSpec& target) {
      const MotionModel model = target.motion.model;
      return target.name == name && (model == MotionModel::kFixed || model == MotionModel::kFloat);
    });
  };
  for (TargetSpec& target : scenario.targets) {
    const bool is_float = target.motion.model == MotionModel::kFloat;
    if (is_float || target.motion.model == MotionModel::kFixed) target.motion.speed_mps = 0;
    for (CompanionSpec& companion : target.companions)
      companion.towed = companion.towed && target.motion.speed_mps > 0 && drifts(companion.target);
    if (!is_float) target.motion.drift.reset();
    if (target.layout && (!is_float || !target.motion.translations || is_raft(target.layout)))
      target.layout->tether_slack.reset();
  }
}

// Mutated values may contradict each other; these are corrected.
void make_consistent(Scenario& scenario) {
  scenario.radar.pulse_width_us = scenario.radar.pri_us / 3;
  if (scenario.radar.pulse_width_us < 0.001 || scenario.radar.pulse_width_us > 1e6) {
    scenario.radar.pri_us = 100.1;
    scenario.radar.pulse_width_us = 0.7;
  }
  scenario.radar.pri_jitter_us = scenario.radar.pri_us / 3.1 * (0.5 + 0.4 / (1 + scenario.radar.pri_jitter_us));
  // Looks that follow one another, all of them within the time to the next interval.
  LookSpec& looks = scenario.looks;
  looks.spacing_s = std::max(looks.spacing_s, 2e-6 * scenario.radar.pri_us);
  scenario.radar.pulses =
      std::min(scenario.radar.pulses, static_cast<int>(0.5e6 * looks.spacing_s / scenario.radar.pri_us) + 1);
  looks.count = std::min(looks.count, 2 + static_cast<int>(5000 / looks.spacing_s));
  scenario.dataset.interval_spacing_s = std::max(scenario.dataset.interval_spacing_s, looks.count * looks.spacing_s);
  scenario.map.range_span_m = std::min(scenario.map.range_span_m, 90 * scenario.radar.pri_us);
  if (scenario.sea_reflection.enabled && scenario.seed % 2 == 0)
    scenario.sea_reflection.surface_profile = SurfaceProfileKind::kMean;
  if (scenario.sea_reflection.enabled && scenario.sea_reflection.surface_profile == SurfaceProfileKind::kWaves) {
    scenario.radar.carrier_ghz = std::min(scenario.radar.carrier_ghz, 5.1);
    scenario.radar.platform.velocity_mps = {};
    scenario.sea_reflection.paths = SeaPaths::kAll;
    for (double& elevation : scenario.view.elevation_deg) elevation = std::fmod(elevation, 9.9);
    for (TargetSpec& target : scenario.targets) target.motion.waves = WaveSharing::kSameField;
  }
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
    if (has_mesh(target)) scenario.radar.intra_pulse_motion = false;
    // A support floats; without one the decoy has any model.
    if (target.decoy && scenario.seed % 2 == 0) target.decoy->support = DecoySupport::kNone;
    if (target.decoy && target.decoy->support != DecoySupport::kNone) {
      target.motion.model = MotionModel::kFloat;
      target.motion.origin_above_waterline_m = 0.1 + std::abs(target.motion.origin_above_waterline_m);
    }
    if (target.ship && target.motion.model == MotionModel::kFloat) target.motion.origin_above_waterline_m = 0;
    if (target.ship) {
      const auto [lowest, highest, reference] = kShipLengths_m[static_cast<std::size_t>(target.ship->kind)];
      target.ship->length_m = lowest + (highest - lowest) * target.ship->length_m / 500;
    }
    for (CompanionSpec& companion : target.companions) companion.target = "array";
    for (TargetSpec& array : scenario.targets)
      if (!target.companions.empty() && array.name == "array")
        array.solver.wavefront_range_m = target.solver.wavefront_range_m;
    if (target.motion.drift && scenario.seed % 2 == 0) {
      target.motion.model = MotionModel::kFloat;
      target.motion.translations = true;
      target.layout->bodies = LayoutBodies::kIndependent;
      if (scenario.seed % 4 == 0) target.motion.drift->spread_mps = 0;
      if (scenario.seed % 4 != 0) target.layout->tether_slack.reset();
    }
  }
  correct_motions(scenario);
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
    if (round % 4 == 1) scenario.targets.erase(scenario.targets.begin(), scenario.targets.end() - 1);  // all but points
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
    for (TargetSpec& target : scenario.targets) {
      if (target.decoy && target.decoy->support != DecoySupport::kNone) target.motion.model = MotionModel::kFloat;
      if (target.ship) target.motion.model = MotionModel::kShip;
    }
    correct_motions(scenario);
    EXPECT_EQ(values_of(parse_scenario(effective_yaml(scenario), "effective.yaml")), values_of(scenario));
  }
}

}  // namespace
}  // namespace seaglint
