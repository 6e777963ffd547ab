// SPDX-License-Identifier: BSD-3-Clause
#include "classify/model/saved_model.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "classify/cnn/network.h"
#include "classify/dataset/format/manifest.h"
#include "classify/dataset/format/sample.h"
#include "classify/features/feature_vector.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/json.h"
#include "sim/core/text/text_table.h"
#include "sim/core/text/words.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

namespace {

using nlohmann::ordered_json;

constexpr const char* kFormat = "seaglint model 1";

AxisExtent extent_of(const std::vector<double>& axis) { return {axis.size(), axis.front(), axis.back()}; }

std::string axis_difference(const char* name, const AxisExtent& axis, const AxisExtent& of_model) {
  // Both are computed from the same settings: they differ by rounding only, in the last digits.
  const double tolerance = 1e-9 * (std::abs(of_model.first) + std::abs(of_model.last));
  if (axis.cells == of_model.cells && std::abs(axis.first - of_model.first) <= tolerance &&
      std::abs(axis.last - of_model.last) <= tolerance)
    return "";
  const auto text = [](const AxisExtent& extent) {
    return fmt::format("{} cells from {:.6g} to {:.6g}", extent.cells, extent.first, extent.last);
  };
  return fmt::format("{}: {} instead of {}", name, text(axis), text(of_model));
}

// JSON has no NaN: an undefined value is null.

double number(const ordered_json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

ordered_json to_object(const AxisExtent& axis) {
  return {{"cells", axis.cells}, {"first", axis.first}, {"last", axis.last}};
}
AxisExtent axis_from(const ordered_json& json, const std::string& file) {
  return {whole_number(json, "cells", file), json.at("first").get<double>(), json.at("last").get<double>()};
}

ordered_json to_array(const std::vector<ValueRange>& ranges, const std::vector<std::string>& classes) {
  ordered_json json = ordered_json::array();
  for (const ValueRange& range : ranges) {
    ordered_json entry{{"name", range.name},
                       {"units", range.unit},
                       {"lowest", number_or_null(range.lowest)},
                       {"highest", number_or_null(range.highest)},
                       {"undefined_in_some", range.has_undefined}};
    for (std::size_t label = 0; label < classes.size(); ++label)
      for (const double quantile : range.by_label[label])
        entry["quantiles_5_50_95"][classes[label]].push_back(number_or_null(quantile));
    json.push_back(std::move(entry));
  }
  return json;
}
std::vector<ValueRange> ranges_from(const ordered_json& json, const std::vector<std::string>& classes) {
  std::vector<ValueRange> ranges;
  for (const ordered_json& entry : json) {
    ValueRange range{entry.at("name").get<std::string>(),
                     entry.at("units").get<std::string>(),
                     number(entry.at("lowest")),
                     number(entry.at("highest")),
                     {},
                     entry.at("undefined_in_some").get<bool>()};
    for (const std::string& name : classes) {
      const ordered_json& quantiles = entry.at("quantiles_5_50_95").at(name);
      range.by_label.push_back({number(quantiles.at(0)), number(quantiles.at(1)), number(quantiles.at(2))});
    }
    ranges.push_back(std::move(range));
  }
  return ranges;
}

}  // namespace

StoredGrid grid_of(const StoredAxes& axes) { return {extent_of(axes.range_m), extent_of(axes.velocity_mps)}; }

std::string grid_difference(const StoredGrid& grid, const StoredGrid& of_model) {
  const std::string range = axis_difference("range_m", grid.range_m, of_model.range_m);
  return range.empty() ? axis_difference("velocity_mps", grid.velocity_mps, of_model.velocity_mps) : range;
}

std::string classes_difference(const std::vector<std::string>& classes, const std::vector<std::string>& of_model) {
  if (classes == of_model) return "";
  return fmt::format("{} instead of {}", fmt::join(classes, ", "), fmt::join(of_model, ", "));
}

std::map<std::string, SectionSettings> settings_of(const Scenario& scenario) {
  std::map<std::string, SectionSettings> settings;
  for (const char* section : {"map", "features", "learning"}) settings[section] = section_values(scenario, section);
  // The number of threads changes no result.
  std::erase_if(settings["learning"], [](const auto& entry) { return entry.first == "threads"; });
  return settings;
}

std::string settings_difference(const std::map<std::string, SectionSettings>& settings,
                                const std::map<std::string, SectionSettings>& of_model) {
  for (const char* section : {"map", "features"}) {
    std::map<std::string, std::pair<std::string, std::string>> values;  // here and of the model
    for (const auto& [key, value] : settings.at(section)) values[key].first = value;
    for (const auto& [key, value] : of_model.at(section)) values[key].second = value;
    for (const auto& [key, value] : values) {
      const auto& [here, there] = value;
      if (here != there)
        return fmt::format("{}.{}: {} instead of {}", section, key, here.empty() ? "absent" : here,
                           there.empty() ? "absent" : there);
    }
  }
  return "";
}

LearningSpec learning_spec(const ModelCard& card, const std::filesystem::path& file) {
  std::vector<Override> overrides;
  for (const auto& [key, value] : card.settings.at("learning")) overrides.push_back({"learning." + key, value});
  try {
    return parse_scenario(
               "seaglint: 1\ntargets: {any: {label: 0, points: [{position_m: [0, 0, 0], amplitude_m: 1}]}}\n",
               file.string(), overrides)
        .learning;
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: settings: {}", file.string(), error.what()));
  }
}

std::string to_json(const ModelCard& card) {
  ordered_json json;
  json["format"] = kFormat;
  json["program_version"] = card.program_version;
  json["seed"] = card.seed;
  json["classes"] = card.classes;
  json["features"] = card.features;
  json["embedding"] = card.embedding;
  json["grid"] = {{"range_m", to_object(card.grid.range_m)}, {"velocity_mps", to_object(card.grid.velocity_mps)}};
  for (const auto& [section, entries] : card.settings) {
    json["settings"][section] = ordered_json::object();
    for (const auto& [key, value] : entries) json["settings"][section][key] = value;
  }
  json["data_sets"] = ordered_json::array();
  for (const TrainingData& data : card.data_sets) {
    json["data_sets"].push_back({{"scenario", data.scenario},
                                 {"scenario_sha256", data.scenario_sha256},
                                 {"seed", data.seed},
                                 {"samples", data.samples}});
  }
  json["division"] = card.division;
  json["train_rows"] = card.train_rows;
  json["feature_ranges"] = to_array(card.feature_ranges, card.classes);
  json["condition_ranges"] = to_array(card.condition_ranges, card.classes);
  json["sha256"] = card.sha256;
  return json.dump(2) + "\n";
}

ModelCard read_model_card(const std::filesystem::path& file, const std::string& program_version) {
  const std::string text = read_file(file, std::size_t{16} << 20);
  check_json(text, file.string(), kMaxOrderedKeys);
  try {
    const ordered_json json = ordered_json::parse(text);
    const auto refuse = [&](const char* what, const std::string& found, const std::string& own) {
      throw InputError(fmt::format("{}: {} {}; this program applies models of {}: train it again by `seaglint train`",
                                   file.string(), what, shown(found), own));
    };
    if (json.at("format") != kFormat) refuse("format", json.at("format").dump(), fmt::format("\"{}\"", kFormat));
    ModelCard card;
    card.program_version = json.at("program_version").get<std::string>();
    if (card.program_version != program_version) refuse("program_version", card.program_version, program_version);
    card.classes = json.at("classes").get<std::vector<std::string>>();
    const std::set<std::string> different(card.classes.begin(), card.classes.end());
    if (different.size() != card.classes.size() || card.classes.size() < kMinClasses ||
        card.classes.size() > kMaxClasses || different.contains(""))
      throw InputError(fmt::format("{}: classes {}: must be {} to {} different names", file.string(),
                                   shown(fmt::format("{}", fmt::join(card.classes, ", "))), kMinClasses, kMaxClasses));
    const auto whole = [&](const ordered_json& object, const char* key) {
      return whole_number(object, key, file.string());
    };
    card.seed = whole(json, "seed");
    card.features = json.at("features").get<std::vector<std::string>>();
    card.embedding = json.at("embedding").get<std::vector<std::string>>();
    const ordered_json& grid = json.at("grid");
    card.grid = {axis_from(grid.at("range_m"), file.string()), axis_from(grid.at("velocity_mps"), file.string())};
    for (const char* section : {"map", "features", "learning"}) {
      SectionSettings& entries = card.settings[section];
      for (const auto& [key, value] : json.at("settings").at(section).items())
        entries.emplace_back(key, value.get<std::string>());
    }
    for (const ordered_json& entry : json.at("data_sets")) {
      card.data_sets.push_back({entry.at("scenario").get<std::string>(), entry.at("scenario_sha256").get<std::string>(),
                                whole(entry, "seed"), whole(entry, "samples")});
    }
    card.division = json.at("division").get<std::string>();
    card.train_rows = whole(json, "train_rows");
    card.feature_ranges = ranges_from(json.at("feature_ranges"), card.classes);
    card.condition_ranges = ranges_from(json.at("condition_ranges"), card.classes);
    card.sha256 = json.at("sha256").get<std::map<std::string, std::string>>();
    bool same_features = card.features.size() == card.feature_ranges.size();
    for (std::size_t i = 0; same_features && i < card.features.size(); ++i)
      same_features = card.features[i] == card.feature_ranges[i].name;
    if (!same_features) throw InputError(fmt::format("{}: feature_ranges: not those of features", file.string()));
    for (const auto* ranges : {&card.feature_ranges, &card.condition_ranges}) {
      for (const ValueRange& range : *ranges) {
        const ColumnOfRows column = column_of({}, range.name);
        if (column.is_text)
          throw InputError(fmt::format("{}: {}: a column of text has no range", file.string(), shown(range.name)));
        if (range.unit != column.unit)
          throw InputError(fmt::format("{}: {}: units {}, must be {}", file.string(), range.name, in_quotes(range.unit),
                                       in_quotes(column.unit)));
      }
    }
    return card;
  } catch (const ordered_json::exception& error) {
    throw InputError(fmt::format("{}: {}", file.string(), json_problem(error)));
  }
}

namespace fs = std::filesystem;

namespace {

std::string tree_file(const char* name) { return fmt::format("{}.json", name); }

// The files that model.json has checksums of.
std::vector<std::string> checked_files() {
  std::vector<std::string> files = model_files();
  std::erase(files, kModelFile);
  return files;
}

}  // namespace

SavedModel SavedModel::load(const fs::path& directory, const std::string& program_version) {
  const fs::path file = directory / kModelFile;
  if (fs::is_directory(directory) && !fs::exists(file)) {
    throw InputError(fmt::format("{}: no {}: not the model of `seaglint train`", directory.string(), kModelFile));
  }
  ModelCard card = read_model_card(file, program_version);
  for (const std::string& name : checked_files()) {
    const auto found = card.sha256.find(name);
    if (found == card.sha256.end() || found->second != sha256_file(directory / name))
      throw InputError(
          fmt::format("{}: damaged, or of another training than {}", (directory / name).string(), file.string()));
  }
  LearningSpec spec = learning_spec(card, file);
  std::vector<Booster> trees;
  for (const char* name : kModelNames) trees.push_back(Booster::load(directory / tree_file(name)));
  const std::size_t embedding = card.embedding.size(), features = card.features.size();
  const std::array<std::size_t, kModels> columns{features, embedding, features + embedding,
                                                 features + kMotionFeatureNames.size()};
  for (std::size_t i = 0; i < trees.size(); ++i) {
    if (trees[i].columns() != columns[i]) {
      throw InputError(fmt::format("{}: trees of {} columns, by {} {}",
                                   (directory / tree_file(kModelNames[i])).string(), trees[i].columns(), file.string(),
                                   columns[i]));
    }
  }
  Network network = Network::load(directory / kNetworkFile);
  const auto require_classes = [&](const fs::path& of, std::size_t classes) {
    if (classes == card.classes.size()) return;
    throw InputError(
        fmt::format("{}: of {} classes, by {} {}", of.string(), classes, file.string(), card.classes.size()));
  };
  for (std::size_t i = 0; i < trees.size(); ++i)
    require_classes(directory / tree_file(kModelNames[i]), trees[i].classes());
  require_classes(directory / kNetworkFile, network.classes());
  return {std::move(card), spec, std::move(network), std::move(trees)};
}

ModelCard describe_model(const Study& study, const LearningTable& table, const Scenario& scenario,
                         const StoredAxes& axes, const std::string& program_version) {
  ModelCard card;
  card.program_version = program_version;
  card.seed = scenario.seed;
  card.classes = table.classes;
  card.features = table.handmade.names;
  card.embedding = study.embeddings.names;
  card.grid = grid_of(axes);
  card.settings = settings_of(scenario);
  card.division = study.division;
  const std::vector<std::size_t>& train = study.splits.back().train;
  card.train_rows = train.size();
  const auto add_ranges = [&](const std::vector<std::string>& names, std::vector<ValueRange>& ranges) {
    for (const std::string& name : names)
      ranges.push_back(range_of(column_of(table.maps, name), train, table.labels, card.classes.size()));
  };
  add_ranges(card.features, card.feature_ranges);
  add_ranges(condition_names(card.features), card.condition_ranges);
  return card;
}

void save_model_card(ModelCard card, const fs::path& directory) {
  for (const std::string& name : checked_files()) card.sha256[name] = sha256_file(directory / name);
  write_file(directory / kModelFile, to_json(card));
}

TrainedRows read_trained_rows(const fs::path& directory) {
  const TextTable table(TextSource::read(directory / kSplitsFile),
                        {"data_set", "sample", "seed", "sea_key", "by_group"}, 1);
  TrainedRows trained;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.text(row, 4) != "train") continue;
    std::array<std::int64_t, 4> numbers{};
    for (std::size_t column = 0; column < 4; ++column) {
      const auto number = parse_integer(table.text(row, column));
      if (!number || (column == 0 && *number < 0)) table.fail(row, column, "must be a whole number");
      numbers[column] = *number;
    }
    trained.samples.insert({static_cast<std::size_t>(numbers[0]), numbers[1]});
    trained.seas.insert({numbers[2], numbers[3]});
  }
  return trained;
}

void require_applicable(const ModelCard& card, const fs::path& data_set, const Scenario& scenario,
                        const StoredAxes& axes) {
  const std::string grid = grid_difference(grid_of(axes), card.grid);
  if (!grid.empty()) throw InputError(fmt::format("{}: maps of another grid: {}", data_set.string(), grid));
  const std::string classes = classes_difference(scenario.dataset.classes, card.classes);
  if (!classes.empty()) throw InputError(fmt::format("{}: maps of other classes: {}", data_set.string(), classes));
  const std::string settings = settings_difference(settings_of(scenario), card.settings);
  if (!settings.empty())
    throw InputError(fmt::format("{}: features of other settings: {}", data_set.string(), settings));
}

void apply_model(const SavedModel& model, const Shard& shard, const fs::path& file, std::size_t data_set,
                 AppliedRows& result) {
  FeatureMatrix handmade{model.card.features, {}};
  std::vector<CentreList> maps;
  for (const Sample& sample : shard.samples) {
    std::vector<std::string> faults = sample_faults(sample);
    if (sample.record.label < 0 || sample.record.label >= static_cast<std::int64_t>(model.card.classes.size()))
      faults.push_back(
          fmt::format("label {}: the model has classes 0 to {}", sample.record.label, model.card.classes.size() - 1));
    if (!faults.empty())
      throw InputError(fmt::format("{}: sample {}: {}", file.string(), sample.record.sample, faults.front()));
    const std::vector<float> values = values_of(sample.record, model.card.features);
    handmade.values.insert(handmade.values.end(), values.begin(), values.end());
    maps.push_back(centres_of(sample));
  }
  const FeatureMatrix embeddings = embedding_matrix(model.network.embed(maps));
  const FeatureMatrix fused = join_columns(handmade, embeddings);
  const FeatureMatrix extended = join_columns(handmade, motion_matrix(maps));
  const std::array<const FeatureMatrix*, kModels> columns{&handmade, &embeddings, &fused, &extended};
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::vector<double> probabilities = model.trees[i].predict(*columns[i]);
    result.probabilities[i].insert(result.probabilities[i].end(), probabilities.begin(), probabilities.end());
  }
  result.features.names = model.card.features;
  result.features.values.insert(result.features.values.end(), handmade.values.begin(), handmade.values.end());
  append_rows(result.rows, data_set, shard);
}

}  // namespace seaglint
