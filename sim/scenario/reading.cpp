// SPDX-License-Identifier: BSD-3-Clause
// Reads a scenario: tree, fields, tables and consistency, in this order; its draws and its input files.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <set>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dispersion.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/names.h"
#include "sim/scenario/fields.h"
#include "sim/scenario/material_spec.h"

namespace seaglint {

namespace fs = std::filesystem;

std::string value_text(const Scenario& scenario, const std::string& key_path, std::string value) {
  const auto drawn = std::ranges::find(scenario.variations, key_path, &Variation::key_path);
  if (drawn == scenario.variations.end()) return value;
  return fmt::format("{}, drawn per {}", drawn->text(), name(drawn->per));
}

std::string place_of(const Scenario& scenario, const std::string& key_path) {
  return scenario.document ? scenario.document->place_of(key_path) : key_path;
}

namespace {

constexpr std::size_t kMaxTableBytes = 10'000'000, kMaxHopCodeBytes = std::size_t{64} << 20;

// Default name of a scenario: its file name, printable characters only.
std::string name_of_file(const fs::path& file) {
  std::string name = file.stem().string();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, '_');
  for (std::size_t i = utf8_prefix(name); i < name.size(); i = utf8_prefix(name)) name[i] = '_';
  return name.empty() ? "scenario" : name;
}

// The file named by a key.
fs::path file_of(const Scenario& scenario, const std::string& name, const std::string& key) {
  return find_file(name, scenario.folder, place_of(scenario, key));
}

// Reads the file of `sea.table`, unless `known` has read it; null without a table.
std::shared_ptr<const SpectrumTable> find_spectrum_table(const Scenario& scenario, const Scenario* known) {
  if (scenario.sea.spectrum != SpectrumKind::kTable || scenario.sea.table.empty()) return nullptr;
  const auto file_and_time = [](const SeaSpec& sea) { return std::pair(sea.table, sea.table_time); };
  if (known && known->sea.table_values && file_and_time(known->sea) == file_and_time(scenario.sea))
    return known->sea.table_values;
  return std::make_shared<SpectrumTable>(read_spectrum_table(
      TextSource::read(file_of(scenario, scenario.sea.table, "sea.table"), kMaxTableBytes), scenario.sea.table_time));
}

// Reads the file of `radar.hop_code_file`, likewise.
std::shared_ptr<const std::vector<int>> find_hop_codes(const Scenario& scenario, const Scenario* known) {
  const RadarSpec& radar = scenario.radar;
  if (radar.hop_code != HopCode::kFile || radar.hop_code_file.empty()) return nullptr;
  if (known && known->radar.hop_codes) return known->radar.hop_codes;
  const fs::path file = file_of(scenario, radar.hop_code_file, "radar.hop_code_file");
  return std::make_shared<std::vector<int>>(
      read_hop_code(TextSource::read(file, kMaxHopCodeBytes), radar.pulses, radar.carrier_count));
}

// Reads the tables that the keys name unless `known` has them, and records the contradictions between keys.
void complete(Scenario& scenario, const ScenarioDocument& document, ErrorList& errors, const Scenario* known) {
  errors.check({"sea.table", "sea.spectrum"},
               [&] { scenario.sea.table_values = find_spectrum_table(scenario, known); });
  errors.check({"radar.hop_code_file", "radar.hop_code", "radar.pulses", "radar.hop_count"},
               [&] { scenario.radar.hop_codes = find_hop_codes(scenario, known); });
  check_contradictions(scenario, document, errors);
}

// `targets: {}`: one target without bodies, which has a class of its own.
void add_sea_alone(Scenario& scenario) {
  TargetSpec sea;
  sea.name = kSeaAlone;
  scenario.targets.push_back(std::move(sea));
  scenario.dataset.classes = {kSeaAlone};
}

// Reads a document without distributions.
Scenario read_values(const ScenarioDocument& document, ErrorList& errors, const Scenario* known = nullptr) {
  Scenario scenario = read_fields(document, errors);
  scenario.folder = fs::path(document.file_name).parent_path();
  if (scenario.targets.empty() && !errors.concerns("targets")) add_sea_alone(scenario);
  complete(scenario, document, errors, known);
  if (scenario.name.empty()) scenario.name = name_of_file(document.file_name);
  return scenario;
}

std::vector<std::string> middles(const std::vector<Variation>& variations) {
  std::vector<std::string> values;
  for (const Variation& variation : variations) values.push_back(variation.distribution.middle());
  return values;
}

// Scenarios with one drawn key at one of its ends, the others in their middles; the first end with errors of each key
// adds them to `errors`.
void visit_ends(const ScenarioDocument& document, const Scenario& scenario, ErrorList& errors,
                const std::function<void(const Scenario&)>& visit) {
  const std::vector<std::string> middle = middles(scenario.variations);
  for (std::size_t i = 0; i < middle.size(); ++i) {
    const Variation& variation = scenario.variations[i];
    if (!variation.is_written()) continue;  // check_scatter() reads pairs that occur
    for (const std::string& end : variation.distribution.ends()) {
      std::vector<std::string> values = middle;
      values[i] = end;
      const bool is_read = errors.attempt({variation.key_path}, [&] {
        try {
          ErrorList of_end(document);
          const Scenario read = read_values(with_values(document, scenario.variations, values), of_end, &scenario);
          of_end.throw_if_any();
          visit(read);
        } catch (const InputError& error) {
          std::vector<std::string> messages = messages_of(error);
          for (std::string& message : messages)
            message += fmt::format("; where {}, drawn by {}, is {}", variation.key_path, variation.text(), end);
          throw_input_errors(std::move(messages));
        }
      });
      if (!is_read) break;
    }
  }
}

// Reads the diagram of sea.scatter_diagram that a document names; null without one. Records an error for a file that is
// missing or wrong and for heights and periods beside it; null then.
std::shared_ptr<ScatterDiagram> find_scatter_diagram(const ScenarioDocument& document, ErrorList& errors) {
  const YamlNode* sea = document.root.find("sea");
  const YamlNode* node = sea == nullptr ? nullptr : sea->find(kScatterDiagram);
  if (node == nullptr || node->kind != YamlNode::Kind::kScalar) return nullptr;  // the reader refuses lists and maps
  std::shared_ptr<ScatterDiagram> diagram;
  errors.check({kScatterKey}, [&] {
    const fs::path folder = fs::path(document.file_name).parent_path();
    diagram = std::make_shared<ScatterDiagram>(read_scatter_diagram(
        TextSource::read(find_file(node->text, folder, document.place_of(kScatterKey)), kMaxTableBytes)));
  });
  for (const Alternatives& group : kAlternatives) {
    if (std::ranges::find(group.keys, kScatterDiagram) == std::end(group.keys)) continue;
    for (const std::string_view key : group.keys) {
      if (key.empty() || key == kScatterDiagram || sea->find(key) == nullptr) continue;
      errors.attempt({kScatterKey}, [&] {
        document.fail_at(fmt::format("sea.{}", key),
                         "not allowed here: sea.scatter_diagram gives wave heights and periods");
      });
      diagram = nullptr;
    }
  }
  return diagram;
}

// True if the waves of any state of a sea break.
bool is_breaking(const SeaSpec& sea) {
  return std::ranges::any_of(sea_states(sea), [](const SeaState& state) {
    return state.significant_wave_height_m > breaking_height(2 * kPi / state.peak_period_s, state.depth_m);
  });
}

// Removes the cells in which waves may break (breaking_height()) with the document's other keys of `sea`, of those that
// are drawn, `variations`, with any end. Throws InputError if no cell is left.
void exclude_breaking(const ScenarioDocument& document, const std::vector<Variation>& variations,
                      ScatterDiagram& diagram) {
  ScenarioDocument of_sea = document;
  std::erase_if(of_sea.root.entries, [](const YamlEntry& entry) { return entry.key != "sea"; });
  std::vector<Variation> drawn = variations;
  std::erase_if(drawn, [](const Variation& variation) { return !variation.key_path.starts_with("sea."); });
  std::vector<std::vector<std::string>> choices(1);
  for (const Variation& variation : drawn) choices.front().push_back(variation.distribution.middle());
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    for (const std::string& end : drawn[i].distribution.ends()) {
      choices.push_back(choices.front());
      choices.back()[i] = end;
    }
  }
  for (const Variation& of_pair : scatter_variations(std::make_shared<ScatterDiagram>(diagram)))
    drawn.push_back(of_pair);
  std::vector<bool> is_excluded;
  for (const ScatterCell& cell : diagram.cells) {
    const auto breaks = [&](std::vector<std::string> values) {
      values.push_back(fmt::format("{}", cell.highest_height_m));
      values.push_back(fmt::format("{}", cell.lowest_period_s));
      const ScenarioDocument steepest = with_values(of_sea, drawn, values);
      ErrorList errors(steepest);  // of keys that the whole scenario is refused for
      SeaSpec sea = read_fields(steepest, errors).sea;
      sea.propagation_deg = {0};
      return !errors.concerns("sea") && is_breaking(sea);
    };
    is_excluded.push_back(std::ranges::any_of(choices, breaks));
  }
  exclude_cells(diagram, is_excluded);
  if (diagram.cells.empty())
    document.fail_at(kScatterKey, "all of its seas break: their heights exceed L/7 of a period");
}

// Of each wave height of a diagram: the highest waves with the shortest and the longest period, the lowest with the
// longest.
std::vector<SeaPair> extreme_pairs(const ScatterDiagram& diagram) {
  std::vector<SeaPair> pairs;
  for (std::size_t i = 0; i < diagram.cells.size(); ++i) {  // by height, then by period
    const ScatterCell& cell = diagram.cells[i];
    const bool is_first = i == 0 || diagram.cells[i - 1].lowest_height_m != cell.lowest_height_m;
    const bool is_last = i + 1 == diagram.cells.size() || diagram.cells[i + 1].lowest_height_m != cell.lowest_height_m;
    if (is_first) pairs.push_back({cell.highest_height_m, cell.lowest_period_s});
    if (is_last) pairs.push_back({cell.highest_height_m, cell.highest_period_s});
    if (is_last) pairs.push_back({cell.lowest_height_m, cell.highest_period_s});
  }
  return pairs;
}

// Reads the scenario with the extreme pairs of each height of its diagram, the other drawn keys in their middles.
void check_scatter(const ScenarioDocument& document, const Scenario& scenario, const ScatterDiagram& diagram,
                   ErrorList& errors) {
  for (const SeaPair& pair : extreme_pairs(diagram)) {
    std::vector<std::string> values = middles(scenario.variations);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Distribution& distribution = scenario.variations[i].distribution;
      if (distribution.kind == DistributionKind::kScatter)
        values[i] = fmt::format("{}", distribution.is_period ? pair.period_s : pair.significant_wave_height_m);
    }
    ErrorList of_pair(document);
    read_values(with_values(document, scenario.variations, values), of_pair, &scenario);
    const bool is_read = errors.attempt({kScatterKey}, [&] {
      of_pair.throw_if_any(fmt::format("; where sea.scatter_diagram has waves of {:.6g} m with {} {:.6g}",
                                       pair.significant_wave_height_m, diagram.period_key, pair.period_s));
    });
    if (!is_read) break;
  }
}

// The scenario with these values of keys and without variations; records errors.
Scenario with_key_values(const Scenario& scenario, const std::vector<KeyValue>& values, ErrorList& errors) {
  Scenario other = scenario;
  other.variations.clear();
  assign(other, values, *scenario.document, errors);
  complete(other, *scenario.document, errors, &scenario);
  return other;
}

// Those of the scenario itself. Records an error for each that is missing.
void add_input_files(const Scenario& scenario, std::vector<InputFile>& files, ErrorList& errors) {
  const auto add_file = [&](const std::string& key, const fs::path& path) {
    const bool known = std::any_of(files.begin(), files.end(),
                                   [&](const InputFile& file) { return file.key == key && file.path == path; });
    if (!known) files.push_back({key, path});
  };
  const auto add = [&](const std::string& name, const std::string& key) {
    errors.attempt({key}, [&] {
      if (!name.empty()) add_file(key, file_of(scenario, name, key));
    });
  };
  if (scenario.radar.hop_code == HopCode::kFile) add(scenario.radar.hop_code_file, "radar.hop_code_file");
  if (scenario.sea.spectrum == SpectrumKind::kTable) add(scenario.sea.table, "sea.table");
  add(scenario.sea.scatter_diagram, kScatterKey);
  for (const TargetSpec& target : scenario.targets) {
    const std::string path = "targets." + target.name;
    add(target.mesh, path + ".mesh");
    add(target.motion.sections, path + ".motion.sections");
    add(target.motion.file, path + ".motion.file");
    const auto add_material = [&](const std::string& name, const std::string& key) {
      errors.attempt({key}, [&] {
        if (const auto file = find_material_file(name, scenario.folder, place_of(scenario, key))) add_file(key, *file);
      });
    };
    add_material(target.material, path + ".material");
    for (std::size_t i = 0; i < target.part_materials.size(); ++i) {
      add_material(target.part_materials[i].material, fmt::format("{}.part_materials.{}.material", path, i));
    }
  }
}

}  // namespace

Scenario read_scenario(const fs::path& file, const std::vector<Override>& overrides) {
  return parse_scenario(read_file(file, kMaxYamlBytes), file.string(), overrides);
}

Scenario parse_scenario(const std::string& yaml, const std::string& file_name, const std::vector<Override>& overrides) {
  const auto read = std::make_shared<ScenarioDocument>(ScenarioDocument{file_name, {}, parse_yaml(yaml, file_name)});
  ScenarioDocument& document = *read;
  ErrorList errors(document);
  for (const Override& override_value : overrides)
    errors.attempt({override_value.key_path}, [&] { apply_override(document, override_value); });
  std::vector<Variation> variations = find_variations(document, errors);
  for (const Variation& variation : variations) document.drawn_keys.push_back(variation.key_path);
  const std::shared_ptr<ScatterDiagram> diagram = find_scatter_diagram(document, errors);
  if (diagram && errors.check({kScatterKey}, [&] { exclude_breaking(document, variations, *diagram); })) {
    for (Variation& of_pair : scatter_variations(diagram)) variations.push_back(std::move(of_pair));
    std::ranges::sort(variations, {}, &Variation::key_path);
  }
  Scenario scenario = read_values(with_values(document, variations, middles(variations)), errors);
  errors.throw_if_any();
  scenario.document = read;
  scenario.variations = std::move(variations);
  std::set<std::string> companions;  // with any drawn values
  const auto collect = [&companions](const Scenario& of) {
    for (const TargetSpec& target : of.targets) {
      for (const CompanionSpec& companion : target.companions) companions.insert(companion.target);
    }
  };
  collect(scenario);
  visit_ends(document, scenario, errors, collect);
  if (diagram) check_scatter(document, scenario, *diagram, errors);
  errors.check({"targets"}, [&] { check_parts(scenario, companions, document); });
  errors.throw_if_any();
  return scenario;
}

Scenario drawn_scenario(const Scenario& scenario, const DrawPlace& place) {
  if (scenario.variations.empty()) return scenario;
  std::vector<KeyValue> values;
  for (const Variation& variation : scenario.variations)
    values.push_back({variation.key_path, drawn_value(variation, scenario.seed, place)});
  const ScenarioDocument& document = *scenario.document;
  ErrorList errors(document);
  Scenario drawn = with_key_values(scenario, values, errors);
  if (errors.is_empty()) return drawn;
  // Messages quote the drawn values.
  std::vector<std::string> texts, all;
  for (const KeyValue& value : values) {
    texts.push_back(text_of(value.value));
    all.push_back(fmt::format("{} {}", value.key_path, texts.back()));
  }
  const ScenarioDocument with_texts = with_values(document, scenario.variations, texts);
  ErrorList quoting(with_texts);
  read_values(with_texts, quoting, &scenario);
  const std::string end = fmt::format("; of the drawn values {}", fmt::join(all, ", "));
  quoting.throw_if_any(end);
  errors.throw_if_any(end);
  return drawn;
}

Scenario scenario_with(const Scenario& scenario, const std::vector<KeyValue>& values) {
  ErrorList errors(*scenario.document);
  Scenario other = with_key_values(scenario, values, errors);
  errors.throw_if_any();
  return other;
}

fs::path find_mesh(const Scenario& scenario, const TargetSpec& target) {
  return file_of(scenario, target.mesh, fmt::format("targets.{}.mesh", target.name));
}

std::vector<InputFile> input_files(const Scenario& scenario) {
  const ScenarioDocument none;
  const ScenarioDocument& document = scenario.document ? *scenario.document : none;
  std::vector<InputFile> files;
  ErrorList errors(document);
  add_input_files(scenario, files, errors);
  errors.throw_if_any();
  if (scenario.variations.empty()) return files;
  visit_ends(document, scenario, errors, [&](const Scenario& end) {
    ErrorList of_end(document);
    add_input_files(end, files, of_end);
    of_end.throw_if_any();
  });
  errors.throw_if_any();
  return files;
}

}  // namespace seaglint
