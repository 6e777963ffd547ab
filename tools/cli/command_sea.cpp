// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <string_view>

#include "seaglint_version.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/words.h"
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

// Which of a scenario's sea states a command takes, and what its figures have in common.
struct StateArguments {
  ScenarioArguments scenario;
  std::string state = "all", style = "screen";
};

void add_state_arguments(CommandOptions& command, StateArguments& arguments) {
  add_scenario_arguments(command, arguments.scenario);
  command
      .add_option("--state", arguments.state,
                  "Number of one of the scenario's sea states, from 0, or all: tables of several have a first column "
                  "sea_state")
      .show_default();
  add_style_option(command, arguments.style);
}

// Numbers of the states. Throws InputError.
std::vector<std::size_t> chosen_states(const StateArguments& arguments, std::size_t states) {
  std::vector<std::size_t> all(states);
  std::iota(all.begin(), all.end(), std::size_t{0});
  if (arguments.state == "all") return all;
  const std::optional<std::int64_t> number = parse_integer(arguments.state);
  if (!number || *number < 0 || *number >= static_cast<std::int64_t>(states)) {
    throw InputError(fmt::format("--state {}: must be all or a number within 0 and {}, the scenario's last",
                                 arguments.state, states - 1));
  }
  return {static_cast<std::size_t>(*number)};
}

// CSV tables of the states as one, with a first column for the state where there are several.
std::string joined(const std::vector<std::string>& tables, const std::vector<std::size_t>& states) {
  if (tables.size() == 1) return tables.front();
  std::string text;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    std::string_view rest = tables[i];
    const std::string_view header = next_line(rest);
    if (i == 0) text += fmt::format("sea_state,{}\n", header);
    while (!rest.empty()) text += fmt::format("{},{}\n", states[i], next_line(rest));
  }
  return text;
}

// Title and small print of the states' figures.
FigureText figure_text(const StateArguments& arguments, const Scenario& scenario, std::span<const SeaState> states) {
  const CommonOfStates common = common_of(states);
  FigureText text{scenario.name, {common.depth}, figure_style(arguments.style)};
  if (!common.quantities.empty()) text.title += fmt::format(": {}", fmt::join(common.quantities, ", "));
  const bool draws = std::ranges::any_of(scenario.variations,
                                         [](const Variation& drawn) { return drawn.key_path.starts_with("sea."); });
  if (draws) text.notes.push_back("drawn keys of the sea at the middles of their distributions");
  text.notes.push_back(fmt::format("seed {}, realisation 0", scenario.seed));
  text.notes.push_back(fmt::format("seaglint {}", kVersion));
  return text;
}

struct SeaArguments : StateArguments {
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
std::string description(const Scenario& scenario, std::size_t number, const SeaCase& sea) {
  const auto& [state, field, summary, ensemble] = sea;
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "seaglint {} sea, scenario {}, seed {}, sea state {}, realisation 0\n", kVersion, scenario.name,
                 scenario.seed, number);
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
  std::string text = "time_s,elevation_m,elevation_linear_m,slope_x,slope_y";
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
  const std::vector<SeaState> states = sea_states(scenario.sea);
  const std::vector<std::size_t> numbers = chosen_states(arguments, states.size());
  report_sea(scenario, states);
  const bool statistics = !arguments.spectrum.empty() || !arguments.figure.empty();
  std::vector<SeaCase> cases;
  std::vector<SeaState> chosen;
  std::vector<std::string> series, spectra;
  std::string lines, text;
  for (const std::size_t number : numbers) {
    ChosenSea sea = choose_sea(scenario, {.sea_state = number});
    SeaCase one{sea.state, std::move(sea.field), {}, {}};
    one.summary = summarise(one.state, one.field);
    const std::string about = description(scenario, number, one);
    lines += about;
    text += about;
    series.push_back(series_csv(one.field, arguments, context.stop));
    chosen.push_back(one.state);
    if (!statistics) continue;
    if (total_wave_height(one.state) == 0)
      throw InputError(fmt::format(
          "sea.significant_wave_height_m: flat water has no spectrum (sea state {}; --state takes another)", number));
    one.ensemble = make_ensemble({.state = one.state,
                                  .state_index = number,
                                  .seed = scenario.seed,
                                  .realisations = arguments.realisations,
                                  .duration_s = arguments.duration_s,
                                  .step_s = arguments.step_s,
                                  .threads = thread_count(context.threads),
                                  .stop = &context.stop});
    text += ensemble_text(one.ensemble, one.summary);
    spectra.push_back(spectrum_csv(one.ensemble));
    cases.push_back(std::move(one));
  }
  if (!arguments.figure.empty()) write_sea_figure(cases, figure_text(arguments, scenario, chosen), arguments.figure);
  if (!arguments.spectrum.empty()) write_file(arguments.spectrum, as_comment(lines) + joined(spectra, numbers));
  write_file(arguments.output,
             as_comment(lines) +
                 fmt::format("# at x {} m, y {} m of the target frame\n", arguments.at[0], arguments.at[1]) +
                 joined(series, numbers));
  print_out("{}", text);
}

}  // namespace

void add_sea(CommandOptions& program, CommandContext& context) {
  CommandOptions command = program.add_command(
      "sea", "Write elevation and slope of the scenario's sea states over time, their spectra and their statistics");
  auto arguments = std::make_shared<SeaArguments>();
  add_state_arguments(command, *arguments);
  command.add_option("-o,--output", arguments->output, "CSV file to write").required();
  command.add_option("--at", arguments->at, "Place X,Y in the target frame, m")
      .comma_separated(2)
      .number_within(-1e4, 1e4);
  command.add_flag("--kinematics", arguments->kinematics,
                   "Add velocity and acceleration of the water at the surface to the columns");
  command.add_option("--spectrum", arguments->spectrum,
                     "CSV file for the spectrum: the state's, and that of the realisations; of one --state a scenario "
                     "reads it (sea.spectrum: table)");
  command.add_option("--figure", arguments->figure,
                     "Picture (.png, .svg or .pdf) of elevation, spectrum, exceedance of crests and slope, of at most "
                     "six states");
  command
      .add_option("--realisations", arguments->realisations, "Realisations that --spectrum and --figure take together")
      .integer_within(1, 10000);
  add_threads_option(command, context);
  add_time_options(command, arguments->duration_s, arguments->step_s);
  command.footer(
      "Example:\n  seaglint sea scenarios/quick.yaml --at 40,0 --duration-s 100 -o sea.csv\n"
      "  seaglint sea scenarios/quick.yaml --realisations 100 --figure sea.png -o sea.csv\n"
      "  seaglint sea scenarios/quick.yaml --state 2 --spectrum spectrum.csv -o sea.csv");
  command.callback([arguments, command, &context] {
    command.require_any_of("--realisations", {"--spectrum", "--figure"});
    context.work = [arguments, &context] { write_sea(*arguments, context); };
  });
}

namespace {

struct MotionArguments : StateArguments {
  std::string output;
  std::string spectrum, figure, frames, rao, rao_reference;
  double duration_s = 100;
  double step_s = 0.1;
};

// The bodies of a scenario in the first realisations of its sea states.
struct MovingBodies {
  std::vector<Target> targets;
  std::vector<std::size_t> numbers;  // of the states
  std::vector<Scene> scenes;
  std::vector<MotionCase> cases;
};

MovingBodies moving_bodies(const MotionArguments& arguments, const Scenario& scenario, const CommandContext& context) {
  MovingBodies moving;
  const std::vector<SeaState> states = sea_states(scenario.sea);
  moving.numbers = chosen_states(arguments, states.size());
  report_sea(scenario, states);
  moving.targets = load_targets(
      {.scenario = scenario, .plan = SamplePlan(scenario), .use = TargetUse::kMotion, .stop = &context.stop});
  report_motion(moving.targets);
  std::vector<SeaState> chosen;
  for (const std::size_t number : moving.numbers) {
    moving.scenes.push_back(make_scene({.scenario = scenario,
                                        .targets = moving.targets,
                                        .sea = {.sea_state = number},
                                        .at_least_s = arguments.duration_s,
                                        .threads = context.threads,
                                        .stop = &context.stop}));
    chosen.push_back(moving.scenes.back().state);
  }
  const std::vector<std::string> names = state_names(chosen);
  for (std::size_t i = 0; i < moving.scenes.size(); ++i) {
    const Scene& scene = moving.scenes[i];
    moving.cases.push_back({names[i], named_bodies(moving.targets, scene), scene.sea, scene.state.peak_period_s});
  }
  return moving;
}

std::string motion_csv(const MotionArguments& arguments, const std::vector<NamedTrajectory>& bodies,
                       const StopFlag& stop) {
  std::string text = "time_s,body,roll_deg,pitch_deg,yaw_deg,surge_m,sway_m,heave_m\n";
  auto out = std::back_inserter(text);
  const std::size_t count = uniform_time_count(arguments.duration_s, arguments.step_s);
  for (std::size_t n = 0; n < count; ++n) {
    if (stop) throw Interrupted();
    const double t = arguments.step_s * static_cast<double>(n);
    for (const NamedTrajectory& body : bodies) {
      const MotionSample motion = motion_at(body, t);
      fmt::format_to(out, "{:.9g},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", t, body.body,
                     degrees(motion.angles.x()), degrees(motion.angles.y()), degrees(motion.angles.z()),
                     motion.translation.x(), motion.translation.y(), motion.translation.z());
    }
  }
  return text;
}

// Comment above the table: the states, and waves that the bodies' tables do not cover.
std::string motion_comment(const Scenario& scenario, const MovingBodies& moving) {
  std::string text;
  auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < moving.scenes.size(); ++i) {
    const SeaState& state = moving.scenes[i].state;
    fmt::format_to(out, "# seaglint {} motion, scenario {}, seed {}, sea state {}, realisation 0\n", kVersion,
                   on_one_line(scenario.name), scenario.seed, moving.numbers[i]);
    fmt::format_to(
        out, "# significant_wave_height_m {}, peak_period_s {}, gamma {}, propagation_deg {:.10g}, order {}\n",
        state.significant_wave_height_m, state.peak_period_s, state.gamma, degrees(state.propagation_rad), state.order);
    for (const std::string& sentence : uncovered_waves(moving.targets, moving.scenes[i].sea))
      fmt::format_to(out, "# {}\n", on_one_line(sentence));
  }
  return text;
}

void write_rao(const MotionArguments& arguments, const Scenario& scenario, const MovingBodies& moving,
               FigureText text) {
  for (const Target& target : moving.targets) {
    if (target.rest_positions.empty()) continue;
    const Body& body = *target.models.front()->motion;
    const auto* ship = std::get_if<ShipParticulars>(&body.model);
    if (ship == nullptr) continue;
    const double depth = moving.scenes.front().state.depth_m;
    RaoRequest request{*ship, {}, depth, {arguments.rao_reference, body.spec}};
    for (const Scene& scene : moving.scenes) {
      if (std::ranges::find(request.directions, scene.state.propagation_rad) == request.directions.end())
        request.directions.push_back(scene.state.propagation_rad);
    }
    text.title = fmt::format("{}, {}: response to regular waves", scenario.name, target.spec.name);
    if (request.directions.size() == 1)
      text.title += fmt::format(" towards {:.4g} deg", degrees(request.directions.front()));
    text.notes = {fmt::format("speed {:.3g} m/s", ship->speed),
                  depth == kDeepWater ? "deep water" : fmt::format("depth {:.4g} m", depth),
                  fmt::format("seaglint {}", kVersion)};
    return write_rao_figure(request, text, arguments.rao);
  }
  throw InputError("--rao: no target of the scenario has motion.model: ship");
}

void write_pictures(const MotionArguments& arguments, const Scenario& scenario, const MovingBodies& moving) {
  std::vector<SeaState> states;
  for (const Scene& scene : moving.scenes) states.push_back(scene.state);
  const FigureText text = figure_text(arguments, scenario, states);
  if (!arguments.figure.empty()) write_motion_figure(moving.cases, arguments.duration_s, text, arguments.figure);
  if (!arguments.frames.empty()) write_motion_frames(moving.cases, arguments.duration_s, text, arguments.frames);
  if (!arguments.rao.empty()) write_rao(arguments, scenario, moving, text);
}

// Degrees of freedom in which a target is at rest in every state.
void report_rest_of(const MotionArguments& arguments, const Scenario& scenario, const MovingBodies& moving) {
  if (arguments.duration_s < kStatisticsStep_s) return;
  std::vector<TargetMotion> motions;
  for (std::size_t t = 0; t < moving.targets.size(); ++t) {
    if (moving.scenes.front().bodies[t].empty()) continue;
    TargetMotion motion{&scenario.targets[t], {}};
    for (const Scene& scene : moving.scenes) {
      const std::array<double, 6> rms = motion_rms(scene.bodies[t].front(), arguments.duration_s);
      for (std::size_t i = 0; i < rms.size(); ++i) motion.rms[i] = std::max(motion.rms[i], rms[i]);
    }
    motions.push_back(motion);
  }
  report_rest(scenario, motions);
}

void write_motion(const MotionArguments& arguments, const CommandContext& context) {
  for (const std::string& file : {arguments.figure, arguments.frames, arguments.rao}) require_figure(file);
  const std::vector<std::string> outputs{arguments.output, arguments.spectrum, arguments.figure, arguments.frames,
                                         arguments.rao};
  require_outputs(outputs, {arguments.scenario.file, arguments.rao_reference});
  const Scenario scenario = arguments.scenario.read();
  require_outputs(outputs, files_of(scenario));
  uniform_time_count(arguments.duration_s, arguments.step_s);
  const MovingBodies moving = moving_bodies(arguments, scenario, context);
  std::vector<std::string> tables, spectra;
  std::string statistics;
  for (std::size_t i = 0; i < moving.cases.size(); ++i) {
    const auto& [name, bodies, sea, peak_period_s] = moving.cases[i];
    tables.push_back(motion_csv(arguments, bodies, context.stop));
    if (!arguments.spectrum.empty()) spectra.push_back(spectrum_csv(bodies, arguments.duration_s));
    if (!name.empty()) statistics += fmt::format("sea state {}: {}\n", moving.numbers[i], name);
    statistics += motion_statistics(bodies, arguments.duration_s);
  }
  write_pictures(arguments, scenario, moving);
  if (!arguments.spectrum.empty()) write_file(arguments.spectrum, joined(spectra, moving.numbers));
  write_file(arguments.output, motion_comment(scenario, moving) + joined(tables, moving.numbers));
  print_out("{}", statistics);
  report_rest_of(arguments, scenario, moving);
}

}  // namespace

void add_motion(CommandOptions& program, CommandContext& context) {
  CommandOptions command = program.add_command(
      "motion",
      "Write the angles and translations of every body in the scenario's sea states, their spectra and statistics");
  auto arguments = std::make_shared<MotionArguments>();
  add_state_arguments(command, *arguments);
  command.add_option("-o,--output", arguments->output, "CSV file to write").required();
  command.add_option("--spectrum", arguments->spectrum, "CSV file for the spectra of the series' angles");
  command.add_option("--figure", arguments->figure,
                     "Picture (.png, .svg or .pdf) of the first 100 s of all angles, of at most six states");
  command.add_option(
      "--snapshots", arguments->frames,
      "Picture of five snapshots over one wave period: first and last body in the waves, seen from starboard");
  const CommandOption rao =
      command.add_option("--rao", arguments->rao,
                         "Picture of the first ship's response amplitude operators for the scenario's wave directions");
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
