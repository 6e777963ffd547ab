// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/directory/dataset_writer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>

#include "classify/dataset/directory/dataset_reader.h"
#include "classify/dataset/format/manifest.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/printable.h"
#include "sim/core/process/progress.h"
#include "sim/core/text/words.h"
#include "sim/motion/target_motion.h"
#include "sim/scenario/layout/layout.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

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
  record.bodies = is_sea_alone(target) ? 0 : static_cast<std::int64_t>(body_count(target.layout));
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
  // 53 bits, which a double holds, of the random numbers that give the sea its phases.
  record.sea_id = static_cast<std::int64_t>(Random({scenario.seed, Stream::kWavePhase, sea}).bits() >> 11);
  record.first_motion_key = static_cast<std::int64_t>(body_index(sea, first_body));
  record.radar_key = static_cast<std::int64_t>(plan.look_key(sample, at.look));
  for (const Variation& variation : scenario.variations) {
    const ScalarValue value = drawn_value(variation, scenario.seed, plan.draw_place(at));
    const double* number = std::get_if<double>(&value);
    if (variation.distribution.is_numeric()) {
      record.drawn_numbers.push_back(
          {variation.key_path, number != nullptr ? *number : parse_number(text_of(value)).value()});
    } else {
      record.drawn_words.push_back({variation.key_path, text_of(value)});
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

namespace {

// "2", or "2 (guarded ship)" where the scenario names the classes.
std::string label_text(const Scenario& scenario, int label) {
  const std::vector<std::string>& classes = scenario.dataset.classes;
  if (classes == default_classes()) return fmt::format("{}", label);
  return fmt::format("{} ({})", label, markdown_text(classes[static_cast<std::size_t>(label)]));
}

// "generated tanker, 183 m, seed 3", or the distributions of its keys.
std::string ship_text(const Scenario& scenario, const TargetSpec& target) {
  const ShipSpec& ship = *target.ship;
  const auto text = [&](const char* key, const std::string& value) {
    return markdown_text(value_text(scenario, fmt::format("targets.{}.ship.{}", target.name, key), value));
  };
  return fmt::format("generated {}, {}, seed {}", text("kind", kShipKindNames[static_cast<std::size_t>(ship.kind)]),
                     text("length_m", ship.length_m > 0 ? fmt::format("{:g} m", ship.length_m) : "length of its seed"),
                     text("seed", fmt::format("{}", ship.seed)));
}

// "generated octahedral decoy, leg_m 0.5, seed 3", or the distributions of its keys.
std::string decoy_text(const Scenario& scenario, const TargetSpec& target) {
  const DecoySpec& decoy = *target.decoy;
  const auto text = [&](const char* key, const std::string& value) {
    return markdown_text(value_text(scenario, fmt::format("targets.{}.decoy.{}", target.name, key), value));
  };
  return fmt::format("generated {} decoy, leg_m {}, seed {}",
                     text("kind", kDecoyKindNames[static_cast<std::size_t>(decoy.kind)]),
                     text("leg_m", fmt::format("{:g}", decoy.leg_m)), text("seed", fmt::format("{}", decoy.seed)));
}

// A row for each target; a part has no label and no samples.
std::string targets_table(const Scenario& scenario, const SamplePlan& plan) {
  std::string table = "| target | label | samples | made of |\n|---|---|---|---|\n";
  for (const TargetSpec& target : scenario.targets) {
    std::string made_of = is_sea_alone(target)  ? "nothing: the sea alone"
                          : target.ship         ? ship_text(scenario, target)
                          : target.decoy        ? decoy_text(scenario, target)
                          : target.mesh.empty() ? fmt::format("{} ideal points", target.points.size())
                                                : markdown_text(target.mesh);
    const std::string scale = value_text(scenario, "targets." + target.name + ".scale",
                                         target.scale == 1 ? "" : fmt::format("{:g}", target.scale));
    if (!scale.empty()) made_of += ", scale " + markdown_text(scale);
    made_of += layout_text(target.layout);
    const bool is_part = target.role == TargetRole::kPart;
    table += fmt::format("| {} | {} | {} | {} |\n", markdown_text(target.name),
                         is_part ? "part of others" : label_text(scenario, target.label),
                         is_part ? 0 : plan.size() / plan.classes().size(), made_of);
  }
  return table;
}

std::string columns_table(const std::vector<std::string>& classes) {
  std::string table = "| column | units | meaning |\n|---|---|---|\n";
  for (const SampleColumn& column : sample_columns()) {
    table +=
        fmt::format("| `{}` | {} | {} |\n", column.name, column.unit, markdown_text(description_of(column, classes)));
  }
  return table;
}

// Empty without drawn keys.
std::string drawn_table(const Scenario& scenario) {
  if (scenario.variations.empty()) return "";
  std::string table =
      "\n## Columns of `drawn/`\n\nDrawn once per sea, per observation (sea, view and interval) or per map of an "
      "observation, common to all targets.\n\n| key | units | distribution | drawn per |\n|---|---|---|---|\n";
  for (const Variation& variation : scenario.variations) {
    table += fmt::format("| `{}` | {} | {} | {} |\n", variation.key_path, drawn_text(variation.key_path).units,
                         markdown_text(variation.text()), name(variation.per));
  }
  return table;
}

// A quantity of the seas, also one that follows from other keys: its values, of more than eight their range, with the
// distribution of its key. Of drawn seas the first kMostSeas.
std::string sea_values(const Scenario& scenario, const SamplePlan& plan, const std::string& key,
                       double SeaState::*member) {
  constexpr int kMostSeas = 500;
  constexpr std::size_t kMostValues = 8;
  const int states = static_cast<int>(plan.sea_states().size());
  const int realisations = scenario.variations.empty() ? 1 : scenario.dataset.realisations_per_case;
  std::set<double> values;
  for (int sea = 0; sea < std::min(states * realisations, std::max(states, kMostSeas)); ++sea)
    values.insert(plan.sea_state({.sea_state = sea % states, .realisation = sea / states}).*member);
  const std::string text = values.size() <= kMostValues
                               ? fmt::format("{:g}", fmt::join(values, ", "))
                               : fmt::format("{:.4g} to {:.4g}", *values.begin(), *values.rbegin());
  const std::string distribution = value_text(scenario, key, "");
  return markdown_text(distribution.empty() ? text : fmt::format("{} ({})", text, distribution));
}

std::string clutter_level(const Scenario& scenario) {
  const ClutterSpec& clutter = scenario.clutter;
  if (!clutter.enabled) return "There is no clutter.";
  if (is_absolute(clutter.level))
    return "The clutter has the sea's own level, so its ratio to the target tells the target's size too (`scr_*_db`).";
  return fmt::format("The clutter is set relative to the target (SCR in dB: {}).",
                     markdown_text(value_text(scenario, "clutter.scr_db", fmt::format("{:g}", clutter.scr_db))));
}

// The arrays of a shard with n samples.
std::string arrays_table(const Scenario& scenario, const StoredAxes& axes) {
  const std::size_t velocities = axes.velocity_mps.size(), ranges = axes.range_m.size();
  const std::string n = scenario.looks.count == 1 ? "n" : fmt::format("n, {}", scenario.looks.count);
  std::string table = "| array | type | shape | units | meaning |\n|---|---|---|---|---|\n";
  const auto add = [&](const StoredArray& array, const char* type, const std::string& shape) {
    table += fmt::format("| `{}` | {} | {} | {} | {} |\n", array.path, type, shape, array.units,
                         markdown_text(array.description));
  };
  add(kMaps, "float32", fmt::format("{}, {}, {}", n, velocities, ranges));
  if (scenario.dataset.complex_maps) add(kComplexMaps, "float32", fmt::format("{}, {}, {}, 2", n, velocities, ranges));
  if (scenario.dataset.echoes) add(kEchoes, "float64", fmt::format("{}, {}, frequencies, 2", n, scenario.radar.pulses));
  add(kVelocityAxis, "float64", fmt::format("{}", velocities));
  add(kRangeAxis, "float64", fmt::format("{}", ranges));
  add(kHopCodes, "uint16", fmt::format("{}, {}", n, scenario.radar.pulses));
  add(kCentres, "float32", fmt::format("{}, {}, 3", n, scenario.features.max_centres));
  if (scenario.looks.count > 1)
    table += fmt::format(
        "| `/looks/COLUMN` | int64, float64 | {} | | start and random key of every look, and what is measured in it or "
        "of its motion; `samples/` has those of the first look |\n",
        n);
  return table + "| `/samples/COLUMN` | int64, float64, text | n | | the columns below |\n";
}

constexpr const char* kSignature = "<!-- data card of seaglint, SHA-256 of the text above: ";
constexpr const char* kSignatureEnd = " -->\n";

constexpr const char* kReading =
    "## Reading\n\n"
    "```python\n"
    "import seaglint                            # the Python package of the program\n"
    "data = seaglint.Dataset(\".\")               # data[7], data.columns[\"label\"], data.torch_dataset()\n\n"
    "import h5py\n"
    "with h5py.File(\"shard_00000.h5\") as shard:\n"
    "    maps = shard[\"maps\"][:]               # [sample][velocity][range], metres\n"
    "    range_m = shard[\"axes/range_m\"][:]\n"
    "    velocity = shard[\"axes/velocity_mps\"][:]\n"
    "    label = shard[\"samples/label\"][:]\n"
    "```\n\n"
    "`seaglint merge DIR` makes one file of all shards, `seaglint export DIR -o FILE.npz` arrays for NumPy,\n"
    "`data.to_webdataset(DIR)` tar archives.\n"
    "`manifest.json` lists the shards in order with their SHA-256. `centres` is zero beyond `samples/centres`.\n\n";

// What the data are, in one paragraph without markup.
std::string data_set_summary(const Scenario& scenario, const SamplePlan& plan, const Manifest& manifest) {
  const std::size_t seas = plan.sea_states().size() * static_cast<std::size_t>(scenario.dataset.realisations_per_case);
  const bool draws_views = std::ranges::any_of(
      scenario.variations, [](const Variation& variation) { return variation.key_path.starts_with("view."); });
  const bool has_targets = !is_sea_alone(scenario);
  return fmt::format(
      "{} range-velocity maps of {} ({} independent sea realisations, {}){}. Synthetic: simulated by seaglint {} with "
      "seed {}; nothing was measured.",
      manifest.samples,
      has_targets ? fmt::format("{} radar targets at sea", plan.classes().size()) : "the sea without a target", seas,
      draws_views ? "a view drawn for each observation" : fmt::format("{} views", plan.views().size()),
      has_targets ? ", for the classification of targets by their label" : "", manifest.program_version, manifest.seed);
}

// The data card in Markdown: content, arrays, reading, splits, limitations.
std::string data_card(const Scenario& scenario, const SamplePlan& plan, const Manifest& manifest,
                      const StoredAxes& axes) {
  const DatasetSpec& set = scenario.dataset;
  std::string text =
      fmt::format("# Data set {}\n\n{}\n`scenario.yaml` has every key of the scenario with its value.\n\n",
                  markdown_code(scenario.name), markdown_text(data_set_summary(scenario, plan, manifest)));
  text += targets_table(scenario, plan);
  text += fmt::format(
      "\n* Sea: significant wave height (m) {}; peak period (s) {}; direction of propagation (deg) {}.\n"
      "* Views: azimuth (deg) {}; elevation (deg) {}.\n"
      "* {} {} per case (sea state and view) and target, from {} independent seas; intervals {:g} s apart.\n"
      "* A map has {} velocity cells ({:.3f} to {:.3f} m/s, positive = receding) and {} range cells ({:.2f} to {:.2f} "
      "m, positive = farther).\n"
      "* Values are |RV| in metres: a point scatterer of amplitude a = sqrt(sigma / 4 pi) peaks at a.\n\n"
      "## Arrays\n\nOf a shard with n samples:\n\n",
      sea_values(scenario, plan, "sea.significant_wave_height_m", &SeaState::significant_wave_height_m),
      sea_values(scenario, plan, "sea.peak_period_s", &SeaState::peak_period_s),
      sea_values(scenario, plan, "sea.propagation_deg", &SeaState::propagation_deg),
      markdown_text(
          value_text(scenario, "view.azimuth_deg", fmt::format("{:g}", fmt::join(scenario.view.azimuth_deg, ", ")))),
      markdown_text(value_text(scenario, "view.elevation_deg",
                               fmt::format("{:g}", fmt::join(scenario.view.elevation_deg, ", ")))),
      set.maps_per_case,
      scenario.looks.count == 1
          ? "maps"
          : fmt::format("samples of {} looks {} apart", scenario.looks.count,
                        value_text(scenario, "looks.spacing_s", fmt::format("{:g} s", scenario.looks.spacing_s))),
      set.realisations_per_case, set.interval_spacing_s, axes.velocity_mps.size(), axes.velocity_mps.front(),
      axes.velocity_mps.back(), axes.range_m.size(), axes.range_m.front(), axes.range_m.back());
  text += arrays_table(scenario, axes) + "\n" + kReading + "## Columns of `samples/`\n\n" + columns_table(set.classes) +
          drawn_table(scenario);
  text += fmt::format(
      "\n## Splitting\n\n"
      "All maps of one `group` (one sea realisation: all targets, views and intervals in it, {} maps) share a sea and "
      "must lie on one side of\n"
      "a split. A random split of the rows cuts through groups and looks better than it is.\n\n"
      "## Limitations\n\n"
      "All samples are simulated: what a classifier achieves on them is no statement about measured data.\n"
      "{} The absolute level of a map tells the target's size: `peak_m` and\n"
      "`energy_m2` separate targets of different size by themselves. A classifier of shape and motion must be given "
      "maps "
      "divided by their own energy.\n\n"
      "## Reproduction\n\n"
      "`seaglint generate scenario.yaml -o DIR` with the same version makes the same bytes on the same kind of "
      "processor\n"
      "({}), for any number of threads and parts. Mesh paths in `scenario.yaml` start at the working directory.\n",
      plan.size() / (plan.sea_states().size() * static_cast<std::size_t>(set.realisations_per_case)),
      clutter_level(scenario), markdown_code(fmt::format("{}", fmt::join(manifest.processors, "; "))));
  return text;
}

// The text with a last line, a comment, that has the checksum of the text above it.
std::string signed_card(const std::string& text) { return text + kSignature + sha256(text) + kSignatureEnd; }

// True for a text of signed_card(): the program wrote it, and nobody changed it.
bool is_unchanged_card(const std::string& text) {
  const std::size_t place = text.rfind(kSignature);
  return place != std::string::npos && text == signed_card(text.substr(0, place));
}

}  // namespace

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

// A card that a user changed or that has metadata of the Hugging Face Hub (Dataset.card() of the Python package) is
// kept.
bool is_replaceable_card(const fs::path& file) {
  if (!is_there(file)) return true;
  const std::string text = read_file(file);
  return is_unchanged_card(text) && !text.starts_with("---\n");
}

// Removes the temporary files of killed processes.
void remove_temporaries(const fs::path& directory) {
  for (const std::string& name : file_names(directory)) {
    // `verify` reports files that cannot be removed.
    if (is_temporary(name)) remove_leftover(directory / name);
  }
}

// True if the file contains this shard, with the file's checksum: its bytes depend only on the content.
bool holds(const fs::path& file, const Shard& content, int max_centres, std::string& sha256) {
  try {
    const ShardFile loaded = load_shard(file);
    read_shard(loaded);
    sha256 = loaded.sha256;
    return is_as_written(loaded, content, max_centres);
  } catch (const std::runtime_error&) {
    return false;
  }
}

// True if the shard has the arrays that the scenario stores, and no others.
bool has_arrays_of(const DatasetSpec& dataset, std::size_t looks, const Shard& shard) {
  return std::ranges::all_of(shard.samples, [&](const Sample& sample) {
    return sample.complex_values.empty() != dataset.complex_maps && sample.echo.empty() != dataset.echoes &&
           look_count(sample) == looks;
  });
}

}  // namespace

bool is_dataset_file(const std::string& name) {
  const bool is_single = std::ranges::find(kSingleFiles, name) != std::end(kSingleFiles);
  return is_single || name.ends_with(".h5") || name.ends_with(".npz") || name.starts_with('.') || is_temporary(name);
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
  if (content.samples.size() != range.count ||
      !has_arrays_of(scenario_.dataset, static_cast<std::size_t>(plan_.looks()), content))
    return false;
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
    if (!holds(file, content, scenario_.features.max_centres, written)) throw;
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
  manifest.looks = static_cast<std::uint64_t>(plan_.looks());
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
