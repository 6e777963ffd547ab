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
#include "sim/core/process/standard_output.h"
#include "sim/motion/ship/ship_particulars.h"
#include "sim/motion/statistics.h"
#include "sim/sea/realisation.h"
#include "tools/cli/arguments.h"
#include "tools/cli/command.h"
#include "tools/figure/figure.h"
#include "tools/figure/motion_figures.h"
#include "tools/options/series_times.h"
#include "tools/pipeline/motion_summary.h"
#include "tools/pipeline/moving_bodies.h"
#include "tools/pipeline/output_files.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {

namespace {

struct MotionArguments {
  ScenarioArguments scenario;
  std::string output;
  std::string spectrum, figure, frames, rao, rao_reference;
  double duration_s = 100;
  double step_s = 0.1;
};

void write_pictures(const MotionArguments& arguments, const Scenario& scenario, const MovingBodies& scene) {
  const std::string title = fmt::format("{}: Hs {:.3g} m, Tp {:.3g} s towards {:.4g} deg", scenario.name,
                                        scene.sea.state.significant_wave_height_m, scene.sea.state.peak_period_s,
                                        degrees(scene.sea.state.propagation_rad));
  if (!arguments.figure.empty()) write_motion_figure(scene.bodies, arguments.duration_s, title, arguments.figure);
  if (!arguments.frames.empty()) {
    const double period = std::min(scene.sea.state.peak_period_s, arguments.duration_s);
    write_motion_frames(scene.bodies, scene.sea.field, period, title, arguments.frames);
  }
  if (arguments.rao.empty()) return;
  for (const Body& body : scene.targets) {
    if (const auto* ship = std::get_if<ShipParticulars>(&body.model)) {
      write_rao_figure(*ship, scene.sea.state.propagation_rad, scene.sea.state.depth_m,
                       {arguments.rao_reference, body.spec},
                       fmt::format("{}: waves towards {:.4g} deg, speed {:.3g} m/s", scenario.name,
                                   degrees(scene.sea.state.propagation_rad), ship->speed),
                       arguments.rao);
      return;
    }
  }
  throw InputError("--rao: no target of the scenario has motion.model: ship");
}

// The degrees of freedom of every target's first body.
std::vector<TargetMotion> motions_of(const Scenario& scenario, const std::vector<NamedTrajectory>& bodies,
                                     double duration_s) {
  std::vector<TargetMotion> motions;
  for (const TargetSpec& target : scenario.targets) {
    const auto first = std::ranges::find_if(bodies, [&](const NamedTrajectory& body) {
      return body.body == target.name || body.body == target.name + "_1";
    });
    if (!target.mesh.empty() && first != bodies.end())
      motions.push_back({&target, motion_rms(first->trajectory, duration_s)});
  }
  return motions;
}

void write_motion(const MotionArguments& arguments, const CommandContext& context) {
  for (const std::string& file : {arguments.figure, arguments.frames, arguments.rao}) require_figure(file);
  const std::vector<std::string> outputs{arguments.output, arguments.spectrum, arguments.figure, arguments.frames,
                                         arguments.rao};
  require_outputs(outputs, {arguments.scenario.file, arguments.rao_reference});
  const Scenario scenario = arguments.scenario.read();
  require_outputs(outputs, files_of(scenario));
  report_spectrum_table(scenario);
  warn(sea_warnings(scenario, sea_states(scenario.sea)));
  const std::size_t count = uniform_time_count(arguments.duration_s, arguments.step_s);
  const MovingBodies scene =
      simulate_bodies(scenario, {}, arguments.duration_s, context.threads, context.stop, report_motion);
  const std::vector<NamedTrajectory>& bodies = scene.bodies;
  const SeaState& state = scene.sea.state;
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "# seaglint {} motion, scenario {}, seed {}, sea state 0, realisation 0\n", kVersion,
                 on_one_line(scenario.name), scenario.seed);
  fmt::format_to(out, "# significant_wave_height_m {}, peak_period_s {}, gamma {}, propagation_deg {:.10g}, order {}\n",
                 state.significant_wave_height_m, state.peak_period_s, state.gamma, degrees(state.propagation_rad),
                 state.order);
  for (const std::string& sentence : uncovered_waves(scene)) fmt::format_to(out, "# {}\n", on_one_line(sentence));
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
  write_pictures(arguments, scenario, scene);
  if (!arguments.spectrum.empty()) write_file(arguments.spectrum, spectrum_csv(bodies, arguments.duration_s));
  write_file(arguments.output, text);
  print_out("{}", motion_statistics(bodies, arguments.duration_s));
  if (arguments.duration_s >= kStatisticsStep_s)
    report_rest(scenario, motions_of(scenario, bodies, arguments.duration_s));
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
  command.add_option("--figure", arguments->figure, "Picture (.png or .svg) of the first 100 s of all angles");
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
