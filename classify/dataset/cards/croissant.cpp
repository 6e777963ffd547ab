// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/cards/croissant.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "classify/dataset/cards/columns_file.h"
#include "classify/dataset/directory/data_card.h"
#include "classify/dataset/directory/dataset_reader.h"
#include "classify/dataset/directory/dataset_writer.h"
#include "classify/dataset/directory/export.h"
#include "classify/dataset/format/layout.h"
#include "classify/dataset/format/manifest.h"
#include "sim/scenario/sample_plan.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

using nlohmann::ordered_json;

constexpr const char* kProgram = "seaglint";
constexpr const char* kClasses = "classes";
constexpr const char* kSamples = "samples";

// The context of the specification's appendix 1, with the prefixes of its section "Namespaces" and the terms of its
// text that the appendix leaves out (as in the data sets that MLCommons publishes with it).
ordered_json context() {
  ordered_json terms = {{"@language", "en"}, {"@vocab", "https://schema.org/"}};
  terms["cr"] = "http://mlcommons.org/croissant/";
  terms["dct"] = "http://purl.org/dc/terms/";
  terms["sc"] = "https://schema.org/";
  terms["conformsTo"] = "dct:conformsTo";
  for (const char* term :
       {"citeAs",     "column",        "extract",  "field",   "fileObject", "fileProperty", "fileSet",  "format",
        "includes",   "isLiveDataset", "jsonPath", "key",     "md5",        "parentField",  "path",     "recordSet",
        "references", "regex",         "repeated", "replace", "separator",  "source",       "subField", "transform"})
    terms[term] = fmt::format("cr:{}", term);
  for (const char* term : {"data", "examples"}) terms[term] = {{"@id", fmt::format("cr:{}", term)}, {"@type", "@json"}};
  terms["dataType"] = {{"@id", "cr:dataType"}, {"@type", "@vocab"}};
  return terms;
}

ordered_json licence_value(const std::string& licence) {
  if (is_url(licence)) return licence;
  if (licence.starts_with("LicenseRef-")) return {{"@type", "sc:CreativeWork"}, {"name", licence}};
  return "https://spdx.org/licenses/" + licence;
}

ordered_json reference(const std::string& id) { return {{"@id", id}}; }

ordered_json file_object(const fs::path& file, const std::string& format, const std::string& description,
                         const std::string& sha256) {
  const std::string name = file.filename();
  ordered_json object{{"@type", "cr:FileObject"}, {"@id", name}, {"name", name}, {"description", description}};
  object["contentUrl"] = name;
  object["contentSize"] = fmt::format("{} B", fs::file_size(file));
  object["encodingFormat"] = format;
  object["sha256"] = sha256;
  return object;
}

ordered_json distribution(const DatasetReader& reader) {
  const fs::path& directory = reader.directory();
  ordered_json files = ordered_json::array();
  const auto add = [&](const char* name, const char* format, const char* description) {
    const fs::path file = directory / name;
    if (fs::is_regular_file(file)) files.push_back(file_object(file, format, description, sha256_file(file)));
  };
  add(kColumnsFile, "text/csv", "columns of all samples, with shard and row of each map");
  add(kScenarioFile, "application/yaml", "scenario: every key with its value");
  add(kInputsFile, "text/plain", "SHA-256 of the files that the scenario names");
  add(kManifestFile, "application/json", "shards in order, version, seed");
  if (fs::is_regular_file(directory / kMergedFile) && !merged_file_of_another_manifest(reader))
    add(kMergedFile, "application/x-hdf5", "all shards as one file, whose maps are read from the shards");
  for (const ManifestShard& shard : reader.manifest().shards) {
    files.push_back(file_object(
        directory / shard.file, "application/x-hdf5",
        fmt::format("samples {} to {}", shard.first_sample, shard.first_sample + shard.samples - 1), shard.sha256));
  }
  return files;
}

// Labels of the scenario's targets with the names of the classes or, where it gives none, of the targets.
ordered_json classes(const Scenario& scenario, std::size_t per_target) {
  const bool are_named = scenario.dataset.classes != default_classes();
  std::map<int, std::string> names;
  std::map<int, std::size_t> counts;
  for (const TargetSpec& target : scenario.targets) {
    if (target.role == TargetRole::kPart) continue;
    std::string& name = names[target.label];
    if (are_named) {
      name = scenario.dataset.classes[static_cast<std::size_t>(target.label)];
    } else {
      name += (name.empty() ? "" : ", ") + target.name;
    }
    counts[target.label] += per_target;
  }
  const auto id = [](const char* field) { return fmt::format("{}/{}", kClasses, field); };
  const auto field = [&](const char* name, const char* type, const char* description) {
    return ordered_json{
        {"@type", "cr:Field"}, {"@id", id(name)}, {"name", name}, {"description", description}, {"dataType", type}};
  };
  ordered_json set{{"@type", "cr:RecordSet"}, {"@id", kClasses}, {"name", kClasses}};
  set["description"] = "classes of the targets";
  set["dataType"] = "sc:Enumeration";
  set["key"] = reference(id("label"));
  set["field"] = {
      field("label", "sc:Integer", "value of the column label"),
      field("name", "sc:Text", are_named ? "name of the class" : "targets of the scenario that are of this class"),
      field("samples", "sc:Integer", "samples of this class")};
  set["data"] = ordered_json::array();
  for (const auto& [label, name] : names)
    set["data"].push_back({{id("label"), label}, {id("name"), name}, {id("samples"), counts[label]}});
  return set;
}

std::string with_unit(const TableEntry& entry) {
  if (entry.unit.empty()) return entry.description;
  return entry.description + (entry.unit == "1" ? "; dimensionless" : "; unit " + entry.unit);
}

ordered_json samples(const DrawnKeys& drawn, const std::vector<std::string>& classes) {
  ordered_json set{{"@type", "cr:RecordSet"}, {"@id", kSamples}, {"name", kSamples}};
  set["description"] = "one record for each map: its class, sea, view, keys, signal-to-clutter ratios and features";
  set["key"] = reference(fmt::format("{}/sample", kSamples));
  std::vector<TableEntry> entries(table_entries().begin(), table_entries().end());
  std::ranges::copy(drawn_entries(drawn), std::back_inserter(entries));
  for (TableEntry& entry : entries) {
    if (entry.name == "label") entry.description = label_description(classes);
    const std::string type = fmt::format("sc:{}", entry.type);
    ordered_json field{{"@type", "cr:Field"}, {"@id", fmt::format("{}/{}", kSamples, entry.name)}};
    field["name"] = entry.name;
    field["description"] = with_unit(entry);
    const bool is_label = entry.name == "label";
    field["dataType"] = is_label ? ordered_json{type, "cr:Label"} : ordered_json(type);
    field["source"] = {{"fileObject", reference(kColumnsFile)}, {"extract", {{"column", entry.name}}}};
    if (is_label) field["references"] = {{"field", reference(fmt::format("{}/label", kClasses))}};
    set["field"].push_back(field);
  }
  return set;
}

std::string array_text(const StoredArray& array) {
  return fmt::format("{} ({}; {})", array.path, array.description, array.units);
}

std::string description(const Manifest& manifest, const Scenario& scenario, const SamplePlan& plan) {
  std::string arrays = array_text(kMaps);
  if (scenario.dataset.complex_maps) arrays += ", " + array_text(kComplexMaps);
  for (const StoredArray& array : {kVelocityAxis, kRangeAxis, kHopCodes, kCentres}) arrays += ", " + array_text(array);
  return fmt::format(
      "{} A map has {} velocity cells and {} range cells. Arrays of the HDF5 shards: {}, and the columns of the record "
      "set {} in /samples. All samples of one group (one sea realisation) belong on one side of a split.",
      data_set_summary(scenario, plan, manifest), manifest.rows, manifest.columns, arrays, kSamples);
}

}  // namespace

std::string croissant_json(const DatasetReader& reader, const Scenario& scenario, const Publication& publication,
                           const std::string& citation) {
  const Manifest& manifest = reader.manifest();
  const SamplePlan plan(scenario);
  ordered_json json;
  json["@context"] = context();
  json["@type"] = "sc:Dataset";
  json["conformsTo"] = "http://mlcommons.org/croissant/1.0";
  json["name"] = publication.name.empty() ? scenario.name : publication.name;
  json["description"] = description(manifest, scenario, plan);
  if (!publication.licence.empty()) json["license"] = licence_value(publication.licence);
  if (!publication.url.empty()) json["url"] = publication.url;
  for (const std::string& name : publication.creators)
    json["creator"].push_back({{"@type", "sc:Person"}, {"name", name}});
  for (const std::string& name : publication.organisations)
    json["creator"].push_back({{"@type", "sc:Organization"}, {"name", name}});
  if (!publication.date.empty()) json["datePublished"] = publication.date;
  if (!publication.version.empty()) json["version"] = publication.version;
  json["keywords"] = {"radar", "range-velocity map", "frequency agility", "sea clutter", "synthetic"};
  json["citeAs"] = citation;
  json["isLiveDataset"] = false;
  json["isBasedOn"] = {
      {"@type", "sc:SoftwareApplication"}, {"name", kProgram}, {"softwareVersion", manifest.program_version}};
  json["distribution"] = distribution(reader);
  json["recordSet"] = {classes(scenario, samples_per_target(plan)),
                       samples(drawn_keys(scenario), scenario.dataset.classes)};
  return json.dump(2) + "\n";
}

std::vector<std::string> missing_properties(const Publication& publication) {
  std::vector<std::string> missing;
  if (publication.licence.empty()) missing.push_back("license");
  if (publication.url.empty()) missing.push_back("url");
  if (publication.creators.empty() && publication.organisations.empty()) missing.push_back("creator");
  if (publication.date.empty()) missing.push_back("datePublished");
  return missing;
}

bool is_croissant_of_seaglint(const std::string& text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("isBasedOn")) return false;
  const auto& made_by = json["isBasedOn"];
  return made_by.is_object() && made_by.value("name", nlohmann::json()) == kProgram;
}

}  // namespace seaglint
