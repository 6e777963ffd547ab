// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/directory/data_card.h"

#include <fmt/format.h>

#include "sim/core/text/escape.h"

namespace seaglint {

namespace {

std::string join(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += fmt::format("{}{:g}", text.empty() ? "" : ", ", value);
  return text;
}

std::string targets_table(const Scenario& scenario) {
  std::string table = "| target | label | made of |\n|---|---|---|\n";
  for (const TargetSpec& target : scenario.targets) {
    std::string made_of =
        target.mesh.empty() ? fmt::format("{} ideal points", target.points.size()) : markdown_text(target.mesh);
    if (target.line) made_of += fmt::format(", {} in line, {:g} m apart", target.line->count, target.line->spacing_m);
    table += fmt::format("| {} | {} | {} |\n", markdown_text(target.name), target.label, made_of);
  }
  return table;
}

std::string columns_table() {
  std::string table = "| column | units | meaning |\n|---|---|---|\n";
  for (const SampleColumn& column : sample_columns()) {
    table += fmt::format("| `{}` | {} | {} |\n", column.name, column.unit, column.description);
  }
  return table;
}

// Unique wave heights of the sea states, also of those from a spectrum table.
std::vector<double> wave_heights(const SamplePlan& plan) {
  std::vector<double> heights;
  for (const SeaState& state : plan.sea_states()) {
    if (heights.empty() || heights.back() != state.significant_wave_height_m) {
      heights.push_back(state.significant_wave_height_m);
    }
  }
  return heights;
}

std::string clutter_level(const ClutterSpec& clutter) {
  if (!clutter.enabled) return "There is no clutter.";
  if (clutter.level == ClutterLevel::kNrl)
    return "The clutter has the sea's own level, so its ratio to the target tells the target's size too (`scr_*_db`).";
  return fmt::format("The clutter is set relative to the target (SCR {:g} dB).", clutter.scr_db);
}

}  // namespace

std::string data_card(const Scenario& scenario, const SamplePlan& plan, const Manifest& manifest,
                      const StoredAxes& axes) {
  const DatasetSpec& set = scenario.dataset;
  std::string text = fmt::format("# Data set {}\n\n", markdown_code(scenario.name));
  text += fmt::format(
      "{} range-velocity maps of ships (label 1) and corner-reflector arrays (label 0), simulated by seaglint {} with "
      "seed {}.\n"
      "Nothing here was measured: these are the echoes that the scenario's physics gives (`{}`).\n\n",
      manifest.samples, markdown_text(manifest.program_version), manifest.seed, "scenario.yaml");
  text += targets_table(scenario);
  text += fmt::format(
      "\n* Significant wave heights: {} m. Views: azimuth {} deg, elevation {} deg.\n"
      "* {} maps per case (sea state and view) and class, from {} independent seas; intervals {:g} s apart.\n"
      "* A map has {} velocity cells ({:.3f} to {:.3f} m/s, positive = receding) and {} range cells ({:.2f} to {:.2f} "
      "m, positive = farther).\n"
      "* Values are |RV| in metres: a point scatterer of amplitude a = sqrt(sigma / 4 pi) peaks at a.\n\n",
      join(wave_heights(plan)), join(scenario.view.azimuth_deg), join(scenario.view.elevation_deg), set.maps_per_case,
      set.realisations_per_case, set.interval_spacing_s, axes.velocity_mps.size(), axes.velocity_mps.front(),
      axes.velocity_mps.back(), axes.range_m.size(), axes.range_m.front(), axes.range_m.back());
  text +=
      "## Reading\n\n"
      "```python\n"
      "import h5py\n"
      "with h5py.File(\"shard_00000.h5\") as shard:\n"
      "    maps = shard[\"maps\"][:]               # [sample][velocity][range], metres\n"
      "    range_m = shard[\"axes/range_m\"][:]\n"
      "    velocity = shard[\"axes/velocity_mps\"][:]\n"
      "    label = shard[\"samples/label\"][:]\n"
      "```\n\n"
      "`seaglint merge DIR` makes one file of all shards, `seaglint export DIR -o FILE.npz` arrays for NumPy.\n"
      "`manifest.json` lists the shards in order with their SHA-256. `hop_code` contains the carrier number of every "
      "pulse, `centres` the\n"
      "scattering centres (range, velocity, amplitude), zero beyond `samples/centres`.\n\n"
      "## Columns of `samples/`\n\n";
  text += columns_table();
  text += fmt::format(
      "\n## Splitting\n\n"
      "All maps of one `group` (one sea realisation: both classes, all views, all its intervals) share a sea and must "
      "lie on one side of\n"
      "a split. A random split of the rows cuts through groups and looks better than it is.\n\n"
      "## What gives the class away\n\n"
      "{} The absolute level of a map tells the target's size: `peak_m` and\n"
      "`energy_m2` separate the classes by themselves. A classifier of shape and motion must be given maps divided by "
      "their own energy.\n\n"
      "## Reproduction\n\n"
      "`seaglint generate scenario.yaml -o DIR` with the same version makes the same bytes on the same kind of "
      "processor\n"
      "({}), for any number of threads and parts. Mesh paths in `scenario.yaml` start at the working directory.\n",
      clutter_level(scenario.clutter), markdown_code(fmt::format("{}", fmt::join(manifest.processors, "; "))));
  return text;
}

}  // namespace seaglint
