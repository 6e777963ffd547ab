// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

#include "seaglint_version.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/standard_output.h"
#include "sim/sea/realisation.h"
#include "sim/sea/statistics.h"
#include "sim/sea/wave_field.h"
#include "tools/cli/arguments.h"
#include "tools/cli/command.h"
#include "tools/figure/figure.h"
#include "tools/figure/sea_figures.h"
#include "tools/options/series_times.h"
#include "tools/pipeline/moving_bodies.h"
#include "tools/pipeline/output_files.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {

namespace {

struct SeaArguments {
  ScenarioArguments scenario;
  std::string output;
  std::string spectrum;
  std::string figure;
  std::vector<double> at{0, 0};
  bool kinematics = false;
  int realisations = 20;
  double duration_s = 600;
  double step_s = 0.1;
};

const char* name_of(Spreading spreading) {
  switch (spreading) {
    case Spreading::kCos2s: return "cos2s";
    case Spreading::kMitsuyasu: return "mitsuyasu";
    case Spreading::kWrappedNormal: return "wrapped_normal";
    case Spreading::kNone: break;
  }
  return "none";
}

// Description of the series, as lines without comment sign.
std::string description(const Scenario& scenario, const SeaState& state, const WaveField& field,
                        const SeaSummary& summary) {
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "seaglint {} sea, scenario {}, seed {}, sea state 0, realisation 0\n", kVersion, scenario.name,
                 scenario.seed);
  fmt::format_to(
      out,
      "significant_wave_height_m {}, peak_period_s {}, gamma {}, propagation_deg {:.10g}, order {}, {} components\n",
      state.significant_wave_height_m, state.peak_period_s, state.gamma, degrees(state.propagation_rad), state.order,
      field.components().size());
  const SwellSpec& swell = scenario.sea.swell;
  if (swell.significant_wave_height_m > 0) {
    fmt::format_to(out, "swell: significant_wave_height_m {}, peak_period_s {}, gamma {}, propagation_deg {}\n",
                   swell.significant_wave_height_m, swell.peak_period_s, swell.gamma, swell.propagation_deg);
  }
  if (!field.long_crested()) {
    fmt::format_to(out, "spreading {}; all components together: R1 {:.3f}\n", name_of(state.spreading.kind),
                   summary.direction_r1);
  }
  if (state.depth_m != kDeepWater)
    fmt::format_to(out, "depth_m {}, Ursell number {:.3g}\n", state.depth_m, summary.ursell);
  fmt::format_to(
      out, "reached: 4 sqrt(m0) {:.12g} m, T1 {:.4g} s, skewness {:.4g}, RMS slope of the linear waves {:.4g}\n",
      summary.significant_wave_height_m, summary.mean_period_s, summary.skewness, std::sqrt(summary.slope_variance));
  fmt::format_to(out,
                 "cut-off {:.4g} rad/s, above it {:.3g} % of the spectrum's energy; up to twice that the RMS slope "
                 "would be {:.4g}; second order up to {:.4g} rad/s\n",
                 summary.cutoff_rad_s, 100 * summary.energy_fraction_above_cutoff,
                 std::sqrt(summary.slope_variance + summary.slope_variance_next_octave),
                 summary.second_order_cutoff_rad_s);
  return text;
}

std::string as_comment(const std::string& lines) {
  std::string text = "# ";
  for (std::size_t i = 0; i < lines.size(); ++i) {
    text += lines[i];
    if (lines[i] == '\n' && i + 1 < lines.size()) text += "# ";
  }
  return text;
}

std::string series_csv(const WaveField& field, const SeaArguments& arguments, const StopFlag& stop) {
  std::string text = fmt::format("# at x {} m, y {} m of the target frame\n", arguments.at[0], arguments.at[1]);
  text += "time_s,elevation_m,elevation_linear_m,slope_x,slope_y";
  if (arguments.kinematics) {
    text += ",velocity_x_mps,velocity_y_mps,velocity_z_mps,acceleration_x_mps2,acceleration_y_mps2,acceleration_z_mps2";
  }
  text += "\n";
  const std::size_t count = uniform_time_count(arguments.duration_s, arguments.step_s);
  SurfaceSeries series(field, arguments.at[0], arguments.at[1], 0, arguments.step_s,
                       arguments.kinematics ? SurfaceQuantities::kKinematics : SurfaceQuantities::kElevationAndSlope);
  auto out = std::back_inserter(text);
  for (std::size_t n = 0; n < count; ++n, series.advance()) {
    if (stop) throw Interrupted();
    const SurfaceState surface = series.state();
    fmt::format_to(out, "{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}", arguments.step_s * static_cast<double>(n),
                   surface.elevation, surface.elevation_linear, surface.slope_x, surface.slope_y);
    if (arguments.kinematics) {
      for (const Vec3& v : {surface.velocity, surface.acceleration}) {
        fmt::format_to(out, ",{:.9g},{:.9g},{:.9g}", v.x(), v.y(), v.z());
      }
    }
    text += '\n';
  }
  return text;
}

void write_sea(const SeaArguments& arguments, const CommandContext& context) {
  require_figure(arguments.figure);
  const std::vector<std::string> outputs{arguments.output, arguments.spectrum, arguments.figure};
  require_outputs(outputs, {arguments.scenario.file});
  const Scenario scenario = arguments.scenario.read();
  require_outputs(outputs, files_of(scenario));
  report_spectrum_table(scenario);
  warn(sea_warnings(scenario, sea_states(scenario.sea)));
  const auto [state, field] = choose_sea(scenario, {});
  const SeaSummary summary = summarise(state, field);
  const std::string lines = description(scenario, state, field, summary);
  const std::string series = as_comment(lines) + series_csv(field, arguments, context.stop);

  std::string statistics;
  if (!arguments.spectrum.empty() || !arguments.figure.empty()) {
    if (total_wave_height(state) == 0) throw InputError("sea.significant_wave_height_m: flat water has no spectrum");
    const SeaEnsemble ensemble = make_ensemble(state, 0, scenario.seed, arguments.realisations, arguments.duration_s,
                                               arguments.step_s, thread_count(context.threads), context.stop);
    statistics = ensemble_text(ensemble, summary);
    if (!arguments.figure.empty()) {
      const std::string title =
          fmt::format("{}: Hs {:.3g} m, Tp {:.3g} s", scenario.name, total_wave_height(state), state.peak_period_s);
      write_sea_figure(state, field, summary, ensemble, title, arguments.figure);
    }
    if (!arguments.spectrum.empty()) write_file(arguments.spectrum, as_comment(lines) + spectrum_csv(ensemble));
  }
  write_file(arguments.output, series);
  print_out("{}{}", lines, statistics);
}

}  // namespace

void add_sea(CommandOptions& program, CommandContext& context) {
  CommandOptions command = program.add_command(
      "sea", "Write elevation and slope of the scenario's first sea state over time, its spectrum and its statistics");
  auto arguments = std::make_shared<SeaArguments>();
  add_scenario_arguments(command, arguments->scenario);
  command.add_option("-o,--output", arguments->output, "CSV file to write").required();
  command.add_option("--at", arguments->at, "Place X,Y in the target frame, m")
      .comma_separated(2)
      .number_within(-1e4, 1e4);
  command.add_flag("--kinematics", arguments->kinematics,
                   "Add velocity and acceleration of the water at the surface to the columns");
  command.add_option("--spectrum", arguments->spectrum,
                     "CSV file for the spectrum: the state's, and that of the realisations");
  command.add_option("--figure", arguments->figure,
                     "Picture (.png or .svg) of elevation, spectrum, exceedance of crests and slope");
  command
      .add_option("--realisations", arguments->realisations, "Realisations that --spectrum and --figure take together")
      .integer_within(1, 10000);
  add_threads_option(command, context);
  add_time_options(command, arguments->duration_s, arguments->step_s);
  command.footer(
      "Example:\n  seaglint sea scenarios/quick.yaml --at 40,0 --duration-s 100 -o sea.csv\n"
      "  seaglint sea scenarios/quick.yaml --realisations 100 --figure sea.png -o sea.csv");
  command.callback([arguments, command, &context] {
    command.require_any_of("--realisations", {"--spectrum", "--figure"});
    context.work = [arguments, &context] { write_sea(*arguments, context); };
  });
}

}  // namespace seaglint
