// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/directory/data_card.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "classify/dataset/format/layout.h"
#include "classify/dataset/format/manifest.h"
#include "sim/core/process/printable.h"
#include "sim/scenario/layout/layout.h"

namespace seaglint {

namespace {

std::string join(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += fmt::format("{}{:g}", text.empty() ? "" : ", ", value);
  return text;
}

// "2", or "2 (guarded ship)" where the scenario names the classes.
std::string label_text(const Scenario& scenario, int label) {
  const std::vector<std::string>& classes = scenario.dataset.classes;
  if (classes == default_classes()) return fmt::format("{}", label);
  return fmt::format("{} ({})", label, markdown_text(classes[static_cast<std::size_t>(label)]));
}

// A row for each target; a part has no label and no samples.
std::string targets_table(const Scenario& scenario, const SamplePlan& plan) {
  std::string table = "| target | label | samples | made of |\n|---|---|---|---|\n";
  for (const TargetSpec& target : scenario.targets) {
    std::string made_of =
        target.mesh.empty() ? fmt::format("{} ideal points", target.points.size()) : markdown_text(target.mesh);
    const std::string scale = value_text(scenario, "targets." + target.name + ".scale",
                                         target.scale == 1 ? "" : fmt::format("{:g}", target.scale));
    if (!scale.empty()) made_of += ", scale " + markdown_text(scale);
    made_of += layout_text(target.layout);
    const bool is_part = target.role == TargetRole::kPart;
    table += fmt::format("| {} | {} | {} | {} |\n", markdown_text(target.name),
                         is_part ? "part of others" : label_text(scenario, target.label),
                         is_part ? 0 : samples_per_target(plan), made_of);
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
                               ? join({values.begin(), values.end()})
                               : fmt::format("{:.4g} to {:.4g}", *values.begin(), *values.rbegin());
  const std::string distribution = value_text(scenario, key, "");
  return markdown_text(distribution.empty() ? text : fmt::format("{} ({})", text, distribution));
}

std::string clutter_level(const Scenario& scenario) {
  const ClutterSpec& clutter = scenario.clutter;
  if (!clutter.enabled) return "There is no clutter.";
  if (clutter.level == ClutterLevel::kNrl)
    return "The clutter has the sea's own level, so its ratio to the target tells the target's size too (`scr_*_db`).";
  return fmt::format("The clutter is set relative to the target (SCR in dB: {}).",
                     markdown_text(value_text(scenario, "clutter.scr_db", fmt::format("{:g}", clutter.scr_db))));
}

// The arrays of a shard with n samples.
std::string arrays_table(const Scenario& scenario, const StoredAxes& axes) {
  const std::size_t velocities = axes.velocity_mps.size(), ranges = axes.range_m.size();
  std::string table = "| array | type | shape | units | meaning |\n|---|---|---|---|---|\n";
  const auto add = [&](const StoredArray& array, const char* type, const std::string& shape) {
    table += fmt::format("| `{}` | {} | {} | {} | {} |\n", array.path, type, shape, array.units,
                         markdown_text(array.description));
  };
  add(kMaps, "float32", fmt::format("n, {}, {}", velocities, ranges));
  if (scenario.dataset.complex_maps) add(kComplexMaps, "float32", fmt::format("n, {}, {}, 2", velocities, ranges));
  if (scenario.dataset.echoes) add(kEchoes, "float64", fmt::format("n, {}, frequencies, 2", scenario.radar.pulses));
  add(kVelocityAxis, "float64", fmt::format("{}", velocities));
  add(kRangeAxis, "float64", fmt::format("{}", ranges));
  add(kHopCodes, "uint16", fmt::format("n, {}", scenario.radar.pulses));
  add(kCentres, "float32", fmt::format("n, {}, 3", scenario.features.max_centres));
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
    "`seaglint merge DIR` makes one file of all shards, `seaglint export DIR -o FILE.npz` arrays for NumPy, `--as "
    "webdataset` tar archives.\n"
    "`manifest.json` lists the shards in order with their SHA-256. `centres` is zero beyond `samples/centres`.\n\n";

}  // namespace

std::size_t samples_per_target(const SamplePlan& plan) { return plan.size() / plan.classes().size(); }

std::string data_set_summary(const Scenario& scenario, const SamplePlan& plan, const Manifest& manifest) {
  const std::size_t seas = plan.sea_states().size() * static_cast<std::size_t>(scenario.dataset.realisations_per_case);
  const bool draws_views = std::ranges::any_of(
      scenario.variations, [](const Variation& variation) { return variation.key_path.starts_with("view."); });
  return fmt::format(
      "{} range-velocity maps of {} radar targets at sea ({} independent sea realisations, {}), for the "
      "classification of targets by their label. Synthetic: simulated by seaglint {} with seed {}; nothing was "
      "measured.",
      manifest.samples, plan.classes().size(), seas,
      draws_views ? "a view drawn for each observation" : fmt::format("{} views", plan.views().size()),
      manifest.program_version, manifest.seed);
}

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
      "* {} maps per case (sea state and view) and target, from {} independent seas; intervals {:g} s apart.\n"
      "* A map has {} velocity cells ({:.3f} to {:.3f} m/s, positive = receding) and {} range cells ({:.2f} to {:.2f} "
      "m, positive = farther).\n"
      "* Values are |RV| in metres: a point scatterer of amplitude a = sqrt(sigma / 4 pi) peaks at a.\n\n"
      "## Arrays\n\nOf a shard with n samples:\n\n",
      sea_values(scenario, plan, "sea.significant_wave_height_m", &SeaState::significant_wave_height_m),
      sea_values(scenario, plan, "sea.peak_period_s", &SeaState::peak_period_s),
      sea_values(scenario, plan, "sea.propagation_deg", &SeaState::propagation_deg),
      markdown_text(value_text(scenario, "view.azimuth_deg", join(scenario.view.azimuth_deg))),
      markdown_text(value_text(scenario, "view.elevation_deg", join(scenario.view.elevation_deg))), set.maps_per_case,
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

std::string signed_card(const std::string& text) { return text + kSignature + sha256(text) + kSignatureEnd; }

bool is_unchanged_card(const std::string& text) {
  const std::size_t place = text.rfind(kSignature);
  return place != std::string::npos && text == signed_card(text.substr(0, place));
}

bool has_front_matter(const std::string& text) { return text.starts_with("---\n"); }

}  // namespace seaglint
