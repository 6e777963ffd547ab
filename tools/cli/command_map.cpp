// SPDX-License-Identifier: BSD-3-Clause
// One range-velocity map of a scenario: its figure, its scattering centres and its features.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "classify/features/feature_vector.h"
#include "classify/features/scattering_centres.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/standard_output.h"
#include "sim/scenario/sample_plan.h"
#include "tools/cli/arguments.h"
#include "tools/cli/command.h"
#include "tools/figure/figure.h"
#include "tools/figure/rv_figure.h"
#include "tools/pipeline/map_coverage.h"
#include "tools/pipeline/map_products.h"
#include "tools/pipeline/pipeline.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {
namespace {

void print_result(const ReceivedInterval& received, const std::vector<ScatteringCentre>& centres,
                  const FeatureVector& features) {
  print_out("  range_m  velocity_mps  amplitude_m\n");
  for (const ScatteringCentre& c : centres)
    print_out("{:9.3f} {:13.4f} {:12.4g}\n", c.range_m, c.velocity_mps, c.amplitude_m);
  print_out("centres {}{}, MWR {:.4g} (m/s)^2, CCF {:.4g}, sigma_r {:.4g} m, sigma_v {:.4g} m/s\n", features.centres,
            features.degenerate ? " (too few to say much)" : "", features.mwr, features.ccf, features.sigma_r,
            features.sigma_v);
  if (!std::isnan(received.scr.per_pulse_db)) {
    print_out("SCR per pulse {:.2f} dB, peak cell {:.2f} dB, extent {:.2f} dB\n", received.scr.per_pulse_db,
              received.scr.peak_cell_db, received.scr.scr_extent_db);
  }
  if (!std::isnan(received.scr.snr_per_pulse_db)) print_out("SNR per pulse {:.2f} dB\n", received.scr.snr_per_pulse_db);
  if (received.map.unused_carriers > 0) print_out("carriers without a pulse: {}\n", received.map.unused_carriers);
}

struct Arguments : ScenarioArguments {
  std::size_t sample = 0;
  std::string output;
  std::string product = "rv";
};

// Profiles of single pulses as a heat map over time, dB against the largest value.
Heatmap profile_figure(const RangeProfiles& profiles, const std::string& title) {
  const double peak = *std::max_element(profiles.magnitude_m.begin(), profiles.magnitude_m.end());
  Heatmap figure;
  figure.title = title;
  figure.x.label = "range against the reference point (m), positive = farther";
  figure.y.label = "time in the interval (ms)";
  figure.colour = {"|HRRP| against the peak (dB)", AxisRange{-40, 0}, false};
  figure.x_cells = profiles.range_m;
  for (const double t : profiles.time_s) figure.y_cells.push_back(1e3 * t);
  for (const double m : profiles.magnitude_m) figure.values.push_back(std::max(-40.0, 20 * std::log10(m / peak)));
  return figure;
}

void show_map(const Arguments& arguments) {
  require_figure(arguments.output);
  const Scenario scenario = arguments.read();
  const SamplePlan plan(scenario);
  const std::size_t sample = arguments.sample;
  if (sample >= plan.size())
    throw InputError(fmt::format("--sample {}: the scenario has samples 0 to {}", sample, plan.size() - 1));
  const Pipeline pipeline(scenario, plan);
  report_motion_files(pipeline);
  report_spectrum_table(scenario);
  warn(mesh_warnings(pipeline));
  warn(motion_warnings(pipeline));
  warn(sea_warnings(scenario, plan.sea_states()));
  const SampleAddress address = plan.address(sample);
  const TargetSpec& target = scenario.targets[static_cast<std::size_t>(address.target)];
  const View view = plan.view(address);
  const std::string title =
      fmt::format("{}: sample {}, {}, Hs {:g} m, azimuth {:g} deg, elevation {:g} deg", scenario.name, sample,
                  target.name, plan.sea_state(address).significant_wave_height_m, view.azimuth_deg, view.elevation_deg);
  if (arguments.product == "isar" || arguments.product == "hrrp") {
    const FullBandInterval band = full_band_interval(pipeline, sample);
    if (arguments.product == "isar") {
      write_figure(rv_figure(band.image, {}, title + ", whole band every pulse"), arguments.output);
    } else {
      write_figure(profile_figure(range_profiles(band, scenario.map), title), arguments.output);
    }
    return;
  }
  warn(band_warnings(pipeline));
  warn(map_coverage_warnings(pipeline));  // throws if the map has too many cells
  const GeneratedSample made = pipeline.generate_sample(sample);
  write_figure(rv_figure(made.received.map, made.centres, title), arguments.output);
  print_result(made.received, made.centres, made.features);
}

}  // namespace

void add_map(CommandOptions& program, CommandContext& context) {
  CommandOptions command =
      program.add_command("map", "Draw one range-velocity map, list its scattering centres and features");
  auto arguments = std::make_shared<Arguments>();
  add_scenario_arguments(command, *arguments);
  command.add_option("--sample", arguments->sample, "Number of the sample in the scenario's plan").show_default();
  command.add_option("-o,--output", arguments->output, "Picture, .png or .svg").required();
  command
      .add_option(
          "--product", arguments->product,
          "rv: range-velocity map; isar, hrrp: ISAR image or range profiles of the target alone, full synthetic "
          "bandwidth in every pulse")
      .one_of({"rv", "isar", "hrrp"})
      .show_default();
  add_threads_option(command, context);
  command.footer(
      "Example:\n  seaglint map scenarios/points.yaml --sample 0 -o map.png\n"
      "  seaglint map scenarios/points.yaml --sample 0 --set map.clean=true -o clean.png");
  command.callback([arguments, &context] {
    context.uninterruptible = true;
    context.work = [arguments] { show_map(*arguments); };
  });
}

}  // namespace seaglint
