// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/keys.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>

#include "sim/core/process/file.h"
#include "sim/core/text/words.h"
#include "sim/scenario/fields.h"
#include "tests/sim/scenario/parsing.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using testing_scenarios::kPaper;
using Json = nlohmann::json;

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
    for (const auto& [keyword, of] : schema.items()) {
      if (!holds(value, schema, keyword, of, path)) return false;
    }
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
    EXPECT_THAT(key.allowed, HasSubstr(key.unit)) << key.key;
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
  EXPECT_THAT(list_keys("sea.swell.gamma"), HasSubstr("    May be drawn, once per sea.\n"));
  EXPECT_THAT(list_keys("radar.carrier_ghz"), Not(HasSubstr("drawn")));
  const std::string by_word = list_keys("JITTER");
  EXPECT_THAT(by_word, HasSubstr("radar.pri_jitter_us  0  within 0 and 10000000 us\n"));
  EXPECT_THAT(by_word, HasSubstr("once per observation"));
  const std::string by_meaning = list_keys("jonswap");
  for (const char* key : {"sea.spectrum ", "sea.gamma ", "sea.swell.gamma "}) EXPECT_THAT(by_meaning, HasSubstr(key));
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
        "seaglint: 1\n", "seaglint: 1\ntargets: {}\n", "seaglint: 1\ntargets: {a b: {label: 1, mesh: a.obj}}\n"}) {
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

}  // namespace
}  // namespace seaglint
