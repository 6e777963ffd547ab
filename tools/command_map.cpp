// SPDX-License-Identifier: BSD-3-Clause
// One range-velocity map of a scenario: its picture, its scattering centres and its features.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>

#include "classify/dataset/plan.h"
#include "sim/core/constants.h"
#include "sim/core/error.h"
#include "sim/scattering/point_response.h"
#include "tools/command.h"
#include "tools/pipeline.h"
#include "tools/rv_figure.h"

namespace seaglint {
namespace {

void warn_outside(const TargetSpec& target, const Vec3& r_hat, const RvMap& map) {
  for (std::size_t i = 0; i < target.points.size(); ++i) {
    const double range = -r_hat.dot(Vec3(target.points[i].position_m.data()));
    const double velocity = -r_hat.dot(Vec3(target.points[i].velocity_mps.data()));
    if (range >= map.range_m.front() && range <= map.range_m.back() && velocity >= map.velocity_mps.front() &&
        velocity <= map.velocity_mps.back()) {
      continue;
    }
    fmt::print(stderr,
               "seaglint: warning: point {} at {:.2f} m, {:.2f} m/s lies outside the map ({:.2f} to {:.2f} m, {:.2f} "
               "to {:.2f} m/s)\n",
               i + 1, range, velocity, map.range_m.front(), map.range_m.back(), map.velocity_mps.front(),
               map.velocity_mps.back());
  }
}

void print_result(const ReceivedInterval& received, const std::vector<ScatteringCentre>& centres,
                  const FeatureVector& features) {
  fmt::print("  range_m  velocity_mps  amplitude_m\n");
  for (const ScatteringCentre& c : centres)
    fmt::print("{:9.3f} {:13.4f} {:12.4g}\n", c.range_m, c.velocity_mps, c.amplitude_m);
  fmt::print("centres {}{}, MWR {:.4g} (m/s)^2, CCF {:.4g}, sigma_r {:.4g} m, sigma_v {:.4g} m/s\n", features.centres,
             features.degenerate ? " (too few to say much)" : "", features.mwr, features.ccf, features.sigma_r,
             features.sigma_v);
  if (!std::isnan(received.scr.per_pulse_db)) {
    fmt::print("SCR per pulse {:.2f} dB, peak cell {:.2f} dB, extent {:.2f} dB\n", received.scr.per_pulse_db,
               received.scr.peak_cell_db, received.scr.extent_db);
  }
  if (received.map.empty_carriers > 0) fmt::print("carriers without a pulse: {}\n", received.map.empty_carriers);
}

void show_map(const Scenario& scenario, std::size_t sample, const std::string& file) {
  const std::size_t samples = SamplePlan(scenario).size();
  if (sample >= samples)
    throw InputError(fmt::format("--sample {}: the scenario has samples 0 to {}", sample, samples - 1));
  const Pipeline pipeline(scenario);
  const MadeSample made = pipeline.make(sample);
  const TargetSpec& target = scenario.targets[static_cast<std::size_t>(made.address.target)];
  const View view = views(scenario.view)[static_cast<std::size_t>(made.address.view)];

  warn_outside(target, direction_to_radar(view), made.received.map);
  const std::string title = fmt::format(
      "{}: sample {}, {}, Hs {:g} m, azimuth {:g} deg, elevation {:g} deg", scenario.name, sample, target.name,
      made.stored.record.significant_wave_height_m, degrees(view.azimuth_rad), degrees(view.elevation_rad));
  write_figure(rv_figure(made.received.map, made.centres, title), file);
  print_result(made.received, made.centres, made.features);
}

}  // namespace

void add_map(CLI::App& app, Shell& shell) {
  CLI::App* command =
      app.add_subcommand("map", "Draw one range-velocity map, list its scattering centres and features");
  struct Arguments : ScenarioArguments {
    std::size_t sample = 0;
    std::string output;
  };
  auto arguments = std::make_shared<Arguments>();
  add_scenario_arguments(*command, *arguments);
  command->add_option("--sample", arguments->sample, "Number of the sample in the scenario's plan")
      ->capture_default_str();
  command->add_option("-o,--output", arguments->output, "Picture, .png or .svg")->required();
  add_threads_option(*command, shell);
  command->footer("Example:\n  seaglint map scenarios/points.yaml --sample 0 -o map.png");
  command->callback([arguments, &shell] {
    shell.work = [arguments] { show_map(arguments->read(), arguments->sample, arguments->output); };
  });
}

}  // namespace seaglint
