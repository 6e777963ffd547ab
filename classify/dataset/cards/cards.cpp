// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/cards/cards.h"

#include <fmt/format.h>

#include <fstream>

#include "classify/dataset/cards/columns_file.h"
#include "classify/dataset/cards/croissant.h"
#include "classify/dataset/cards/hub_card.h"
#include "classify/dataset/directory/data_card.h"
#include "classify/dataset/directory/dataset_reader.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/printable.h"
#include "sim/scenario/sample_plan.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

void require_own_file(const fs::path& file, bool is_own) {
  std::error_code error;
  if (is_own || !fs::exists(fs::symlink_status(file, error))) return;
  throw InputError(
      fmt::format("{}: was not written by seaglint, or was changed since; move it away or remove it", file.string()));
}

std::string first_line(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

void require_own_files(const fs::path& directory) {
  const fs::path card = directory / kDataCardFile, croissant = directory / kCroissantFile,
                 columns = directory / kColumnsFile;
  require_own_file(card, fs::is_regular_file(card) && is_unchanged_card(read_file(card)));
  require_own_file(croissant, fs::is_regular_file(croissant) && is_croissant_of_seaglint(read_file(croissant)));
  require_own_file(columns, fs::is_regular_file(columns) && first_line(columns).starts_with(table_header()));
}

}  // namespace

std::string program_citation(const std::string& version) {
  return fmt::format(
      "@software{{seaglint,\n  title = {{seaglint}},\n  author = {{{{The seaglint authors}}}},\n  version = {{{}}}\n}}",
      version);
}

void write_cards(const DatasetReader& reader, const Publication& publication, const StopFlag* stop) {
  const fs::path& directory = reader.directory();
  require_own_files(directory);
  const Scenario scenario = read_scenario(directory / kScenarioFile);
  const SamplePlan plan(scenario);
  const Manifest& manifest = reader.manifest();
  if (manifest.samples != plan.size())
    throw InputError(fmt::format("{}: {} samples, the scenario has {}", (directory / kManifestFile).string(),
                                 manifest.samples, plan.size()));
  if (!is_identifier(manifest.program_version))
    throw InputError(fmt::format("{}: program_version: {}: must be letters, digits, -, . and +",
                                 (directory / kManifestFile).string(), in_quotes(manifest.program_version)));
  const std::string citation = program_citation(manifest.program_version);
  const StoredAxes axes = reader.shard(0).axes;
  write_columns_file(reader, directory / kColumnsFile, stop);
  const std::string title = publication.name.empty() ? scenario.name : publication.name;
  write_file(directory / kDataCardFile,
             signed_card(hub_front_matter(publication, title, manifest.samples) +
                         data_card(scenario, plan, manifest, axes) + publication_sections(publication, citation)));
  write_file(directory / kCroissantFile, croissant_json(reader, scenario, publication, citation));
  for (const char* file : {kDataCardFile, kCroissantFile, kColumnsFile}) remove_leftovers(directory, file);
}

}  // namespace seaglint
