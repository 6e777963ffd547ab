// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/directory/dataset_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>

#include "classify/dataset/directory/data_card.h"
#include "classify/dataset/directory/dataset_reader.h"
#include "classify/dataset/format/layout.h"
#include "classify/dataset/format/manifest.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/printable.h"
#include "sim/core/process/progress.h"
#include "sim/core/text/words.h"
#include "sim/motion/target_motion.h"
#include "sim/scenario/layout/layout.h"
#include "sim/scenario/writer.h"

namespace seaglint {

DrawnKeys drawn_keys(const Scenario& scenario) {
  DrawnKeys keys;
  for (const Variation& variation : scenario.variations)
    (variation.distribution.is_numeric() ? keys.numbers : keys.words).push_back(variation.key_path);
  return keys;
}

namespace {

// 53 bits, which a double holds, of the random numbers that give the sea its phases.
std::int64_t sea_id(std::uint64_t seed, std::uint64_t sea_key) {
  return static_cast<std::int64_t>(Random({seed, Stream::kWavePhase, sea_key}).bits() >> 11);
}

}  // namespace

SampleRecord planned_record(const Scenario& scenario, const SamplePlan& plan, std::size_t sample) {
  return planned_record(scenario, plan, sample, plan.address(sample));
}

SampleRecord planned_record(const Scenario& scenario, const SamplePlan& plan, std::size_t sample,
                            const SampleAddress& at) {
  const Scenario drawn = plan.drawn(scenario, at);
  const TargetSpec& target = drawn.targets[static_cast<std::size_t>(at.target)];
  const SeaState state = plan.sea_state(at);
  const View view = plan.view(at);
  std::size_t first_body = 0;  // bodies are numbered over all targets but parts, in order
  for (const int t : plan.classes()) {
    if (t == at.target) break;
    const TargetSpec& before = drawn.targets[static_cast<std::size_t>(t)];
    if (before.points.empty()) first_body += body_count(before.layout);
  }

  SampleRecord record;
  record.sample = static_cast<std::int64_t>(sample);
  record.label = target.label;
  record.target = at.target;
  record.target_name = target.name;
  record.layout = layout_name(target.layout);
  record.bodies = static_cast<std::int64_t>(body_count(target.layout));
  record.group = plan.group(at);
  record.sea_state = at.sea_state;
  record.significant_wave_height_m = state.significant_wave_height_m;
  record.peak_period_s = state.peak_period_s;
  record.gamma = state.gamma;
  record.propagation_deg = state.propagation_deg;
  record.swell_wave_height_m = state.swell.significant_wave_height_m;
  record.depth_m = std::isinf(state.depth_m) ? 0 : state.depth_m;
  record.view = at.view;
  record.azimuth_deg = view.azimuth_deg;
  record.elevation_deg = view.elevation_deg;
  record.realisation = at.realisation;
  record.interval = at.interval;
  record.start_s = plan.start_s(at);
  record.seed = static_cast<std::int64_t>(scenario.seed);
  const std::uint64_t sea = sea_key(static_cast<std::size_t>(at.sea_state), static_cast<std::size_t>(at.realisation));
  record.sea_key = static_cast<std::int64_t>(sea);
  record.sea_id = sea_id(scenario.seed, sea);
  record.first_motion_key = static_cast<std::int64_t>(body_index(sea, first_body));
  record.radar_key = static_cast<std::int64_t>(sample);
  for (const Variation& variation : scenario.variations) {
    const std::string value = drawn_value(variation, scenario.seed, plan.draw_place(at));
    if (variation.distribution.is_numeric()) {
      record.drawn_numbers.push_back({variation.key_path, parse_number(value).value()});
    } else {
      record.drawn_words.push_back({variation.key_path, value});
    }
  }
  return record;
}

std::span<const SampleColumn> planned_columns() {
  const std::span<const SampleColumn> all = sample_columns();
  const auto last = std::find_if(
      all.begin(), all.end(), [](const SampleColumn& column) { return std::string_view(column.name) == "radar_key"; });
  return all.first(static_cast<std::size_t>(last - all.begin()) + 1);
}

std::vector<std::string> record_mismatches(const SampleRecord& record, const SampleRecord& planned) {
  std::vector<std::string> found;
  for (const SampleColumn& column : planned_columns()) {
    std::visit(
        [&](auto member) {
          if (record.*member != planned.*member)
            found.push_back(fmt::format("{} {}, by the scenario {}", column.name, record.*member, planned.*member));
        },
        column.member);
  }
  if (!same_drawn(record, planned)) found.emplace_back("the drawn values are not those of the scenario");
  return found;
}

namespace fs = std::filesystem;

namespace {

// The part of the scenario that determines the maps: all but learning and split.
std::string maps_yaml(Scenario scenario) {
  scenario.learning = {};
  scenario.dataset.train_fraction = DatasetSpec{}.train_fraction;
  return effective_yaml(scenario);
}

bool is_empty_or_absent(const fs::path& directory) {
  if (!is_there(directory)) return true;
  std::error_code error;
  if (!fs::is_directory(directory, error)) {
    throw InputError(fmt::format("{}: is a file, not a directory", directory.string()));
  }
  const bool empty = fs::is_empty(directory, error);
  if (error) throw WorkError(fmt::format("{}: {}", directory.string(), error.message()));
  return empty;
}

std::set<std::string> file_names(const fs::path& directory) {
  std::set<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(directory, error), end; !error && it != end; it.increment(error))
    names.insert(it->path().filename());
  if (error) throw WorkError(fmt::format("{}: {}", directory.string(), error.message()));
  return names;
}

// A directory to be resumed contains only files of a data set. That of a run also has a scenario.yaml; its data set is
// a subdirectory.
void require_own_directory(const fs::path& directory) {
  if (is_empty_or_absent(directory)) return;
  for (const std::string& name : file_names(directory)) {
    if (is_dataset_file(name)) continue;
    const fs::path of_run = directory / "data";
    const bool is_run = is_there(of_run / kScenarioFile);
    throw InputError(fmt::format("{}: the directory contains {}, which is no file of a data set{}", directory.string(),
                                 name, is_run ? "; the run's data set is " + of_run.string() : ""));
  }
}

// Writes a file; another process that finishes the same data set writes the same bytes and may have removed this
// process's temporary file.
void write_in_company(const fs::path& file, const std::string& content) {
  try {
    write_file(file, content);
  } catch (const WorkError&) {
    std::error_code error;
    if (!fs::is_regular_file(file, error) || read_file(file) != content) throw;
  }
}

// A card that a user changed or that has metadata of `seaglint card` is kept.
bool is_replaceable_card(const fs::path& file) {
  if (!is_there(file)) return true;
  const std::string text = read_file(file);
  return is_unchanged_card(text) && !has_front_matter(text);
}

// Removes the temporary files of killed processes.
void remove_temporaries(const fs::path& directory) {
  for (const std::string& name : file_names(directory)) {
    // `verify` reports files that cannot be removed.
    if (is_temporary(name)) remove_leftover(directory / name);
  }
}

bool same_row(const SampleRecord& a, const SampleRecord& b) {
  const auto same = [&](const SampleColumn& column) {
    return std::visit(
        [&](auto member) {
          // Rows without clutter contain NaN, which is not equal to itself.
          return a.*member == b.*member || (a.*member != a.*member && b.*member != b.*member);
        },
        column.member);
  };
  return std::all_of(sample_columns().begin(), sample_columns().end(), same) && same_drawn(a, b);
}

// True if the file contains this shard, with the file's checksum: its bytes depend only on the content, so that equal
// content means equal bytes.
bool holds(const fs::path& file, const Shard& content, std::string& sha256) {
  Shard there;
  try {
    const ShardFile loaded = load_shard(file);
    there = read_shard(loaded);
    sha256 = loaded.sha256;
  } catch (const std::runtime_error&) {
    return false;
  }
  const auto same = [](const Sample& a, const Sample& b) {
    return same_row(a.record, b.record) && a.magnitude == b.magnitude && a.complex_values == b.complex_values &&
           a.echo == b.echo && a.hop_code == b.hop_code && a.centre_list == b.centre_list;
  };
  return there.origin == content.origin && there.classes == content.classes && there.axes == content.axes &&
         std::equal(there.samples.begin(), there.samples.end(), content.samples.begin(), content.samples.end(), same);
}

// True if the shard has the arrays that the scenario stores, and no others.
bool has_arrays_of(const DatasetSpec& dataset, const Shard& shard) {
  return std::ranges::all_of(shard.samples, [&](const Sample& sample) {
    return sample.complex_values.empty() != dataset.complex_maps && sample.echo.empty() != dataset.echoes;
  });
}

}  // namespace

bool is_dataset_file(const std::string& name) {
  for (const char* own : kSingleFiles) {
    if (name == own) return true;
  }
  return name.ends_with(".h5") || name.ends_with(".npz") || name.starts_with('.') || is_temporary(name);
}

DatasetWriter::DatasetWriter(fs::path directory, const Scenario& scenario, const SamplePlan& plan, bool resume,
                             std::string program_version)
    : directory_(std::move(directory)),
      scenario_(scenario),
      plan_(plan),
      origin_{std::move(program_version), processor_kind()},
      scenario_yaml_(effective_yaml(scenario)),
      known_(plan_.shards()) {
  if (!resume && !is_empty_or_absent(directory_)) {
    throw InputError(
        fmt::format("{}: the directory is not empty; go on with what is there by --resume", directory_.string()));
  }
  require_own_directory(directory_);
  made_here_ = !fs::exists(directory_);
  begun_here_ = is_empty_or_absent(directory_);
  make_directory(directory_);
  const fs::path scenario_file = directory_ / kScenarioFile;
  bool same_text = false;
  if (fs::exists(scenario_file)) {
    same_text = read_file(scenario_file) == scenario_yaml_;
    const std::string there = maps_yaml(read_scenario(scenario_file)), here = maps_yaml(scenario_);
    if (there != here) {
      throw InputError(fmt::format("{}: the directory contains another scenario ({}); choose another directory",
                                   scenario_file.string(), first_difference(there, here)));
    }
  }
  earlier_ = manifest_there();
  require_same_inputs(directory_, scenario_);
  if (!same_text) write_file(scenario_file, scenario_yaml_);
  write_input_list(directory_, scenario_);
}

void DatasetWriter::roll_back() {
  if (!begun_here_) return;
  for (const std::string& name : file_names(directory_)) {
    if (name != kScenarioFile && name != kInputsFile) return;
  }
  std::error_code ignored;  // a file that cannot be removed is complete and names its scenario
  for (const char* own : {kInputsFile, kScenarioFile}) fs::remove(directory_ / own, ignored);
  if (made_here_) fs::remove(directory_, ignored);
}

fs::path DatasetWriter::shard_file(std::size_t shard) const { return directory_ / shard_name(shard); }

void DatasetWriter::require_version(const fs::path& file, const std::string& version) const {
  if (version == origin_.program_version) return;
  throw InputError(fmt::format(
      "{}: made by seaglint {}, this is seaglint {}, whose maps may differ; go on with that version or choose another "
      "directory",
      file.string(), version, origin_.program_version));
}

Manifest DatasetWriter::manifest_there() const {
  const fs::path file = directory_ / kManifestFile;
  if (!fs::exists(file)) return {};
  try {
    Manifest manifest = read_manifest(file);
    require_version(file, manifest.program_version);
    return manifest;
  } catch (const InputError&) {
    if (fs::exists(file)) throw;
    return {};  // removed by another process in the meantime
  }
}

void DatasetWriter::invalidate_manifest() {
  if (earlier_.shards.empty()) return;
  const fs::path file = directory_ / kManifestFile;
  std::error_code error;
  fs::remove(file, error);
  if (error) throw WorkError(fmt::format("{}: cannot remove: {}", file.string(), error.message()));
  earlier_ = {};
}

bool DatasetWriter::complete(std::size_t shard) {
  known_[shard].sound = false;
  const fs::path file = shard_file(shard);
  if (!fs::is_regular_file(file)) return false;
  const ShardFile loaded = load_shard(file);
  Shard content;
  try {
    content = read_shard(loaded);
  } catch (const UnsupportedFormat&) {
    throw;
  } catch (const InputError&) {
    return false;
  }
  require_version(file, content.origin.program_version);
  const ShardRange range = plan_.shard(shard);
  if (content.samples.size() != range.count || !has_arrays_of(scenario_.dataset, content)) return false;
  for (std::size_t i = 0; i < range.count; ++i) {
    const SampleRecord planned = planned_record(scenario_, plan_, range.first + i);
    if (!record_mismatches(content.samples[i].record, planned).empty()) return false;
  }
  if (content.classes != scenario_.dataset.classes || (axes_ && *axes_ != content.axes)) return false;
  const bool is_recorded = shard < earlier_.shards.size();
  if (is_recorded ? earlier_.shards[shard].sha256 != loaded.sha256
                  : !is_as_written(loaded, content, scenario_.features.max_centres))
    return false;
  axes_ = content.axes;
  known_[shard] = {true, content.origin.processor, loaded.sha256};
  return true;
}

void DatasetWriter::put(std::size_t shard, Shard content) {
  const fs::path file = shard_file(shard);
  content.origin = origin_;
  content.classes = scenario_.dataset.classes;
  const std::scoped_lock lock(mutex_, hdf5_mutex());
  invalidate_manifest();
  std::string written;
  try {
    written = write_shard(file, content, scenario_.features.max_centres);
  } catch (const WorkError&) {
    // Another process may have written the same shard at the same time.
    if (!holds(file, content, written)) throw;
  }
  axes_ = content.axes;
  known_[shard] = {true, origin_.processor, written};
}

bool DatasetWriter::still_sound(std::size_t shard) {
  const Known before = known_[shard];
  if (!before.sound) return complete(shard);
  try {
    if (sha256_file(shard_file(shard)) == before.sha256) return true;
  } catch (const InputError&) {
    known_[shard].sound = false;
    return false;
  }
  // One processor gives one shard, byte for byte.
  if (complete(shard) && known_[shard].processor != before.processor) return true;
  known_[shard].sound = false;
  return false;
}

Manifest DatasetWriter::manifest() const {
  Manifest manifest;
  manifest.scenario = scenario_.name;
  manifest.scenario_sha256 = sha256(scenario_yaml_);
  manifest.program_version = origin_.program_version;
  manifest.classes = scenario_.dataset.classes;
  manifest.seed = scenario_.seed;
  manifest.samples = plan_.size();
  manifest.rows = axes_->velocity_mps.size();
  manifest.columns = axes_->range_m.size();
  std::set<std::string> processors;
  for (std::size_t i = 0; i < plan_.shards(); ++i) {
    const ShardRange range = plan_.shard(i);
    manifest.shards.push_back({shard_name(i), range.first, range.count, known_[i].sha256});
    processors.insert(known_[i].processor);
  }
  manifest.processors.assign(processors.begin(), processors.end());
  return manifest;
}

std::vector<std::size_t> DatasetWriter::finish() {
  // The directory is listed once: a query per file by a thousand parts would overload a file server.
  const std::set<std::string> there = file_names(directory_);
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < plan_.shards(); ++i) {
    if (!there.contains(shard_name(i))) missing.push_back(i);
  }
  if (!missing.empty()) return missing;
  // Another process may have removed or rewritten it.
  if (!earlier_.shards.empty()) earlier_ = manifest_there();
  Progress progress("checking shards", plan_.shards());
  for (std::size_t i = 0; i < plan_.shards(); ++i) {
    if (!still_sound(i)) missing.push_back(i);
    progress.advance();
  }
  if (!missing.empty()) return missing;

  const Manifest whole = manifest();
  if (const fs::path card = directory_ / kDataCardFile; is_replaceable_card(card))
    write_in_company(card, signed_card(data_card(scenario_, plan_, whole, *axes_)));
  write_in_company(directory_ / kManifestFile, to_json(whole));
  remove_temporaries(directory_);
  return {};
}

}  // namespace seaglint
