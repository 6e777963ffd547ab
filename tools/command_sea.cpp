// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

#include "seaglint_version.h"
#include "sim/core/constants.h"
#include "sim/core/error.h"
#include "sim/core/file.h"
#include "sim/sea/wave_field.h"
#include "tools/command.h"
#include "tools/series_times.h"

namespace seaglint {

namespace {

struct SeaArguments {
  ScenarioArguments scenario;
  std::string output;
  std::vector<double> at{0, 0};
  double duration_s = 600;
  double step_s = 0.1;
};

// What the series holds, as comment lines above it.
std::string header(const Scenario& scenario, const SeaState& state, const WaveField& field,
                   const SeaArguments& arguments) {
  const SeaSummary summary = summarize(state, field);
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "# seaglint {} sea, scenario {}, seed {}, sea state 0, realisation 0\n", kVersion, scenario.name,
                 scenario.seed);
  fmt::format_to(
      out,
      "# significant_wave_height_m {}, peak_period_s {}, gamma {}, propagation_deg {:.10g}, order {}, {} components\n",
      state.significant_wave_height_m, state.peak_period_s, state.gamma, degrees(state.propagation_rad), state.order,
      field.components().size());
  fmt::format_to(out, "# reached: 4 sqrt(m0) {:.12g} m, skewness {:.4g}, RMS slope of the linear waves {:.4g}\n",
                 summary.significant_wave_height_m, summary.skewness, std::sqrt(summary.slope_variance));
  fmt::format_to(
      out, "# cut-off {:.4g} rad/s, above it {:.3g} % of the spectrum's energy; second order up to {:.4g} rad/s\n",
      summary.cutoff_rad_s, 100 * summary.energy_share_above_cutoff, summary.second_order_cutoff_rad_s);
  fmt::format_to(out, "# at x {} m, y {} m of the target frame\n", arguments.at[0], arguments.at[1]);
  return text;
}

void write_sea(const SeaArguments& arguments, const StopFlag& stop) {
  const Scenario scenario = arguments.scenario.read();
  const SeaState state = sea_states(scenario.sea).front();
  const WaveField field = realize_sea(state, scenario.seed, realisation_index(0, 0));
  const std::size_t count = uniform_time_count(arguments.duration_s, arguments.step_s);

  std::string text = header(scenario, state, field, arguments);
  text += "time_s,elevation_m,elevation_linear_m,slope_x,slope_y\n";
  SurfaceSeries series(field, arguments.at[0], arguments.at[1], 0, arguments.step_s);
  for (std::size_t n = 0; n < count; ++n, series.advance()) {
    if (stop) throw Interrupted();
    const SurfaceState surface = series.state();
    fmt::format_to(std::back_inserter(text), "{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n",
                   arguments.step_s * static_cast<double>(n), surface.elevation, surface.elevation_linear,
                   surface.slope_x, surface.slope_y);
  }
  write_file(arguments.output, text);
}

}  // namespace

void add_sea(CLI::App& app, Shell& shell) {
  CLI::App* command =
      app.add_subcommand("sea", "Write the elevation and slope of the scenario's first sea state over time");
  auto arguments = std::make_shared<SeaArguments>();
  add_scenario_arguments(*command, arguments->scenario);
  command->add_option("-o,--output", arguments->output, "CSV file to write")->required();
  command->add_option("--at", arguments->at, "Place X,Y in the target frame, m")
      ->delimiter(',')
      ->expected(2)
      ->check(number_within(-1e4, 1e4));
  add_threads_option(*command, shell);
  add_time_options(*command, arguments->duration_s, arguments->step_s);
  command->footer("Example:\n  seaglint sea scenarios/quick.yaml --at 40,0 --duration-s 100 -o sea.csv");
  command->callback([arguments, &shell] { shell.work = [arguments, &shell] { write_sea(*arguments, shell.stop); }; });
}

}  // namespace seaglint
