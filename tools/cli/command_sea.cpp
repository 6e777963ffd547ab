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
#include "sim/core/process/printable.h"
#include "sim/motion/ship/ship.h"
#include "sim/motion/statistics.h"
#include "sim/sea/realisation.h"
#include "sim/sea/statistics.h"
#include "sim/sea/wave_field.h"
#include "tools/cli/command_line.h"
#include "tools/figure/figure.h"
#include "tools/figure/motion_figures.h"
#include "tools/figure/sea_figures.h"
#include "tools/options/command_options.h"
#include "tools/pipeline/scene.h"
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
  report_sea(scenario, sea_states(scenario.sea));
  const auto [state, field] = choose_sea(scenario, {});
  const SeaSummary summary = summarise(state, field);
  const std::string lines = description(scenario, state, field, summary);
  const std::string series = as_comment(lines) + series_csv(field, arguments, context.stop);

  std::string statistics;
  if (!arguments.spectrum.empty() || !arguments.figure.empty()) {
    if (total_wave_height(state) == 0) throw InputError("sea.significant_wave_height_m: flat water has no spectrum");
    const SeaEnsemble ensemble = make_ensemble({.state = state,
                                                .seed = scenario.seed,
                                                .realisations = arguments.realisations,
                                                .duration_s = arguments.duration_s,
                                                .step_s = arguments.step_s,
                                                .threads = thread_count(context.threads),
                                                .stop = &context.stop});
    statistics = ensemble_text(ensemble, summary);
    if (!arguments.figure.empty()) {
      const std::string title = fmt::format("{}: Hs {:.3g} m, Tp {:.3g} s, seed {}", scenario.name,
                                            total_wave_height(state), state.peak_period_s, scenario.seed);
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
                     "Picture (.png, .svg or .pdf) of elevation, spectrum, exceedance of crests and slope");
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

namespace {

struct MotionArguments {
  ScenarioArguments scenario;
  std::string output;
  std::string spectrum, figure, frames, rao, rao_reference;
  double duration_s = 100;
  double step_s = 0.1;
};

// The bodies of a scenario in its first sea realisation.
struct MovingBodies {
  std::vector<Target> targets;
  Scene scene;
  std::vector<NamedTrajectory> named;
};

void write_pictures(const MotionArguments& arguments, const Scenario& scenario, const MovingBodies& moving) {
  const SeaState& state = moving.scene.state;
  const std::string title =
      fmt::format("{}: Hs {:.3g} m, Tp {:.3g} s towards {:.4g} deg, seed {}", scenario.name,
                  state.significant_wave_height_m, state.peak_period_s, degrees(state.propagation_rad), scenario.seed);
  if (!arguments.figure.empty()) write_motion_figure(moving.named, arguments.duration_s, title, arguments.figure);
  if (!arguments.frames.empty()) {
    const double period = std::min(state.peak_period_s, arguments.duration_s);
    write_motion_frames(moving.named, moving.scene.sea, period, title, arguments.frames);
  }
  if (arguments.rao.empty()) return;
  for (const Target& target : moving.targets) {
    if (target.rest_positions.empty()) continue;
    const Body& body = *target.models.front()->motion;
    if (const auto* ship = std::get_if<ShipParticulars>(&body.model)) {
      write_rao_figure(*ship, state.propagation_rad, state.depth_m, {arguments.rao_reference, body.spec},
                       fmt::format("{}: waves towards {:.4g} deg, speed {:.3g} m/s", scenario.name,
                                   degrees(state.propagation_rad), ship->speed),
                       arguments.rao);
      return;
    }
  }
  throw InputError("--rao: no target of the scenario has motion.model: ship");
}

void write_motion(const MotionArguments& arguments, const CommandContext& context) {
  for (const std::string& file : {arguments.figure, arguments.frames, arguments.rao}) require_figure(file);
  const std::vector<std::string> outputs{arguments.output, arguments.spectrum, arguments.figure, arguments.frames,
                                         arguments.rao};
  require_outputs(outputs, {arguments.scenario.file, arguments.rao_reference});
  const Scenario scenario = arguments.scenario.read();
  require_outputs(outputs, files_of(scenario));
  report_sea(scenario, sea_states(scenario.sea));
  const std::size_t count = uniform_time_count(arguments.duration_s, arguments.step_s);
  MovingBodies moving;
  moving.targets = load_targets(
      {.scenario = scenario, .plan = SamplePlan(scenario), .use = TargetUse::kMotion, .stop = &context.stop});
  report_motion(moving.targets);
  moving.scene = make_scene({.scenario = scenario,
                             .targets = moving.targets,
                             .at_least_s = arguments.duration_s,
                             .threads = context.threads,
                             .stop = &context.stop});
  moving.named = named_bodies(moving.targets, moving.scene);
  const std::vector<NamedTrajectory>& bodies = moving.named;
  const SeaState& state = moving.scene.state;
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "# seaglint {} motion, scenario {}, seed {}, sea state 0, realisation 0\n", kVersion,
                 on_one_line(scenario.name), scenario.seed);
  fmt::format_to(out, "# significant_wave_height_m {}, peak_period_s {}, gamma {}, propagation_deg {:.10g}, order {}\n",
                 state.significant_wave_height_m, state.peak_period_s, state.gamma, degrees(state.propagation_rad),
                 state.order);
  for (const std::string& sentence : uncovered_waves(moving.targets, moving.scene.sea))
    fmt::format_to(out, "# {}\n", on_one_line(sentence));
  text += "time_s,body,roll_deg,pitch_deg,yaw_deg,surge_m,sway_m,heave_m\n";
  for (std::size_t n = 0; n < count; ++n) {
    if (context.stop) throw Interrupted();
    const double t = arguments.step_s * static_cast<double>(n);
    for (const NamedTrajectory& body : bodies) {
      const MotionSample motion = motion_at(body, t);
      fmt::format_to(out, "{:.9g},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", t, body.body,
                     degrees(motion.angles.x()), degrees(motion.angles.y()), degrees(motion.angles.z()),
                     motion.translation.x(), motion.translation.y(), motion.translation.z());
    }
  }
  write_pictures(arguments, scenario, moving);
  if (!arguments.spectrum.empty()) write_file(arguments.spectrum, spectrum_csv(bodies, arguments.duration_s));
  write_file(arguments.output, text);
  print_out("{}", motion_statistics(bodies, arguments.duration_s));
  if (arguments.duration_s < kStatisticsStep_s) return;
  std::vector<TargetMotion> motions;
  for (std::size_t t = 0; t < moving.targets.size(); ++t) {
    if (moving.scene.bodies[t].empty()) continue;
    motions.push_back({&scenario.targets[t], motion_rms(moving.scene.bodies[t].front(), arguments.duration_s)});
  }
  report_rest(scenario, motions);
}

}  // namespace

void add_motion(CommandOptions& program, CommandContext& context) {
  CommandOptions command = program.add_command(
      "motion",
      "Write the angles and translations of every body in the scenario's first sea state, their spectra and "
      "statistics");
  auto arguments = std::make_shared<MotionArguments>();
  add_scenario_arguments(command, arguments->scenario);
  command.add_option("-o,--output", arguments->output, "CSV file to write").required();
  command.add_option("--spectrum", arguments->spectrum, "CSV file for the spectra of the series' angles");
  command.add_option("--figure", arguments->figure, "Picture (.png, .svg or .pdf) of the first 100 s of all angles");
  command.add_option(
      "--snapshots", arguments->frames,
      "Figure with five snapshots over one wave period: first and last body in the waves, seen from starboard");
  const CommandOption rao =
      command.add_option("--rao", arguments->rao,
                         "Figure of the first ship's response amplitude operators for the scenario's wave direction");
  command.add_option("--rao-reference", arguments->rao_reference, "VERES .re1 or WAMIT .4 to draw beside them")
      .needs(rao);
  add_threads_option(command, context);
  add_time_options(command, arguments->duration_s, arguments->step_s);
  command.footer(
      "Example:\n  seaglint motion scenarios/quick.yaml --duration-s 60 -o motion.csv\n"
      "  seaglint motion scenarios/quick.yaml --figure motion.png --snapshots snapshots.png -o motion.csv");
  command.callback(
      [arguments, &context] { context.work = [arguments, &context] { write_motion(*arguments, context); }; });
}

}  // namespace seaglint
