// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/directory/audit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "classify/dataset/directory/dataset_reader.h"
#include "classify/dataset/directory/dataset_writer.h"
#include "classify/dataset/directory/export.h"
#include "classify/dataset/format/manifest.h"
#include "classify/dataset/format/sample.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/progress.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

class Auditor {
 public:
  Auditor(const DatasetReader& reader, Audit& result) : reader_(reader), plan_(result.plan), result_(result) {}

  // Compares the directory's files and the manifest with the scenario's plan.
  void files() {
    const Manifest& manifest = this->manifest();
    if (const std::string yaml = read_file(reader_.directory() / kScenarioFile);
        sha256(yaml) != manifest.scenario_sha256) {
      fault(kScenarioFile, "is not the one that the manifest was written for");
    }
    if (manifest.samples != plan_.size())
      fault(kManifestFile, fmt::format("{} samples, the scenario has {}", manifest.samples, plan_.size()));
    if (manifest.classes != result_.scenario.dataset.classes)
      fault(kManifestFile, fmt::format("classes {}, the scenario has {}", fmt::join(manifest.classes, ", "),
                                       fmt::join(result_.scenario.dataset.classes, ", ")));
    if (manifest.seed != result_.scenario.seed)
      fault(kManifestFile, fmt::format("seed {}, the scenario has {}", manifest.seed, result_.scenario.seed));
    if (manifest.scenario != result_.scenario.name)
      fault(kManifestFile, fmt::format("scenario '{}', its name is '{}'", manifest.scenario, result_.scenario.name));
    std::set<std::string> listed;
    for (std::size_t i = 0; i < manifest.shards.size(); ++i) {
      const ManifestShard& shard = manifest.shards[i];
      if (!listed.insert(shard.file).second) fault(kManifestFile, fmt::format("lists {} twice", shard.file));
      if (i < plan_.shards() && shard.file != shard_name(i)) fault(shard.file, "by its number " + shard_name(i));
      if (i >= plan_.shards()) {
        fault(shard.file, "beyond the scenario's last shard");
      } else if (const ShardRange range = plan_.shard(i);
                 shard.first_sample != range.first || shard.samples != range.count) {
        fault(shard.file,
              fmt::format("samples {} to {} by the manifest, {} to {} by the scenario", shard.first_sample,
                          shard.first_sample + shard.samples - 1, range.first, range.first + range.count - 1));
      }
    }
    for (std::size_t i = manifest.shards.size(); i < plan_.shards(); ++i) fault(shard_name(i), "not in the manifest");
    for (const auto& entry : fs::directory_iterator(reader_.directory())) {
      const std::string name = entry.path().filename();
      if (is_temporary(name) && is_leftover(entry.path())) fault(name, "half-written; a resumed `generate` removes it");
      if (!is_dataset_file(name)) fault(name, "is no file of a data set");
      if (!name.ends_with(".h5") || listed.contains(name)) continue;
      if (is_merged(entry.path())) {
        merged_.emplace_back(entry.path(), reader_);
      } else {
        fault(name, "not in the manifest");
      }
    }
  }

  void shard(std::size_t index) {
    const std::string& name = manifest().shards[index].file;
    try {
      const Shard content = reader_.shard(index);
      ++result_.shards;
      processors_.insert(content.origin.processor);
      if (const std::string& version = content.origin.program_version; version != manifest().program_version)
        fault(name, fmt::format("made by version {}, by the manifest {}", version, manifest().program_version));
      if (content.classes != manifest().classes)
        fault(name, fmt::format("classes {}, by the manifest {}", fmt::join(content.classes, ", "),
                                fmt::join(manifest().classes, ", ")));
      if (!axes_) axes_ = content.axes;
      if (*axes_ != content.axes) fault(name, "other axes than the first shard");
      for (const Sample& sample : content.samples) check(name, sample);
      for (MergedFileVerifier& merged : merged_) merged.compare(index, content);
    } catch (const InputError& error) {
      result_.faults.push_back(error.what());
    }
  }

  // Checks the processors, one sea per group, one group per sea, and every sample once.
  void whole() {
    if (const auto& listed = manifest().processors; result_.shards == manifest().shards.size() &&
                                                    processors_ != std::set<std::string>(listed.begin(), listed.end()))
      fault(kManifestFile,
            fmt::format("processors {}, of the shards {}", fmt::join(listed, "; "), fmt::join(processors_, "; ")));
    for (const auto& [group, seas] : seas_of_group_) {
      if (seas.size() > 1)
        fault(fmt::format("group {}", group), fmt::format("contains {} sea realisations", seas.size()));
    }
    std::map<std::int64_t, std::set<std::int64_t>> groups_of_sea;
    for (const auto& [group, seas] : seas_of_group_) {
      for (const std::int64_t sea : seas) groups_of_sea[sea].insert(group);
    }
    for (const auto& [sea, groups] : groups_of_sea) {
      if (groups.size() > 1)
        fault(fmt::format("sea {}", sea), fmt::format("lies in {} groups: a split by group would leak", groups.size()));
    }
    result_.groups = seas_of_group_.size();
    for (const MergedFileVerifier& merged : merged_)
      result_.faults.insert(result_.faults.end(), merged.faults().begin(), merged.faults().end());
    if (planned_ < plan_.size())
      fault("data set", fmt::format("{} of {} samples are missing", plan_.size() - planned_, plan_.size()));
  }

 private:
  const Manifest& manifest() const { return reader_.manifest(); }

  void fault(const std::string& where, const std::string& what) {
    result_.faults.push_back(fmt::format("{}: {}", where, what));
  }

  void check(const std::string& file, const Sample& sample) {
    const SampleRecord& record = sample.record;
    const std::string where = fmt::format("{}, sample {}", file, record.sample);
    ++result_.samples;
    if (record.sample < 0 || static_cast<std::size_t>(record.sample) >= plan_.size()) {
      fault(where, fmt::format("the scenario has {} samples", plan_.size()));
      return;
    }
    ++planned_;
    const SampleRecord planned = planned_record(result_.scenario, plan_, static_cast<std::size_t>(record.sample));
    for (const std::string& what : record_mismatches(record, planned)) fault(where, what);
    ++result_.per_target[static_cast<std::size_t>(planned.target)];
    seas_of_group_[record.group].insert(record.sea_key);
    if (look_count(sample) != static_cast<std::size_t>(plan_.looks()))
      fault(where, fmt::format("{} looks, by the scenario {}", look_count(sample), plan_.looks()));
    check_map(where, sample);
    check_hop_code(where, sample);
    check_further_looks(where, sample);
  }

  void check_further_looks(const std::string& of_sample, const Sample& sample) {
    const auto number = static_cast<std::size_t>(sample.record.sample);
    SampleAddress at = plan_.address(number);
    for (const Sample& look : sample.further_looks) {
      if (++at.look == plan_.looks()) return;
      const std::string where = fmt::format("{}, look {}", of_sample, at.look);
      const SampleRecord planned = planned_record(result_.scenario, plan_, number, at);
      for (const std::string& what : record_mismatches(look.record, planned)) fault(where, what);
      check_map(where, look);
      check_hop_code(where, look);
    }
  }

  void check_hop_code(const std::string& where, const Sample& look) {
    const int carriers = result_.scenario.radar.carrier_count;
    const auto beyond = std::ranges::find_if(look.hop_code, [&](std::uint16_t carrier) { return carrier >= carriers; });
    if (beyond != look.hop_code.end())
      fault(where, fmt::format("hop code {}, the radar has carriers 0 to {}", *beyond, carriers - 1));
  }

  void check_map(const std::string& where, const Sample& sample) {
    const std::vector<std::string> found = sample_faults(sample);
    for (const std::string& what : found) fault(where, what);
    if (!found.empty()) return;
    const auto* bytes = reinterpret_cast<const char*>(sample.magnitude.data());
    const auto [other, fresh] =
        maps_.emplace(sha256(std::string_view(bytes, sample.magnitude.size() * sizeof(float))), sample.record.sample);
    if (!fresh) fault(where, fmt::format("the same map as sample {}", other->second));
  }

  const DatasetReader& reader_;
  const SamplePlan& plan_;
  Audit& result_;
  std::vector<MergedFileVerifier> merged_;  // merged files in the directory
  std::optional<StoredAxes> axes_;          // of the first valid shard
  std::set<std::string> processors_;        // of the valid shards
  std::size_t planned_ = 0;  // samples of the plan that were read; the reader ensures that none is repeated
  std::map<std::string, std::int64_t> maps_;  // sample of each map's checksum
  std::map<std::int64_t, std::set<std::int64_t>> seas_of_group_;
};

}  // namespace

Audit audit(const fs::path& directory, const StopFlag* stop) {
  const DatasetReader reader(directory, ScenarioMismatch::kAccept);
  Audit result(read_scenario(directory / kScenarioFile));
  Auditor auditor(reader, result);
  auditor.files();
  Progress progress("reading shards", reader.shards());
  for (std::size_t i = 0; i < reader.shards(); ++i) {
    if (stop && *stop) throw Interrupted();
    auditor.shard(i);
    progress.advance();
  }
  auditor.whole();
  return result;
}

}  // namespace seaglint
