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
#include "sim/geometry/files/mesh_io.h"
#include "sim/motion/ship/ship_particulars.h"
#include "sim/motion/target_motion.h"
#include "sim/scenario/sample_plan.h"
#include "sim/sea/realisation.h"
#include "tools/cli/arguments.h"
#include "tools/cli/command.h"
#include "tools/figure/figure.h"
#include "tools/figure/motion_figures.h"
#include "tools/options/series_times.h"
#include "tools/pipeline/output_files.h"
#include "tools/pipeline/scene.h"
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

// Moving bodies of the first sea state: those of every mesh target in the order of the file, `ship`, `array_1`,
// `array_2`, ..., and the motion model of each target.
struct MovingScene {
  SeaState state;
  WaveField sea;
  std::vector<Body> targets;
  std::vector<NamedTrajectory> bodies;
};

// Mean velocity of a body along x, without its motion in the waves, m/s.
double mean_speed(const Body& body) {
  if (const auto* ship = std::get_if<ShipParticulars>(&body.model)) return ship->speed;
  if (const auto* table = std::get_if<RaoTable>(&body.model)) return table->speed();
  return 0;
}

MovingScene simulate_all(const Scenario& scenario, const SeaState& state, double duration_s, int threads,
                         const StopFlag& stop) {
  MovingScene scene;
  scene.state = state;
  const std::uint64_t index = sea_key(0, 0);
  scene.sea = realise_sea(scene.state, scenario.seed, index);
  for (const TargetSpec& target : scenario.targets) {
    if (target.mesh.empty()) continue;
    if (stop) throw Interrupted();
    const TriangleMesh mesh = read_mesh(find_mesh(scenario, target), target.unit);
    scene.targets.push_back(load_body(scenario, target, mesh));
    report_motion_file(target, scene.targets.back());
    const std::vector<Trajectory> all = simulate_target(target, scene.targets.back(), scene.state, scene.sea,
                                                        duration_s, scenario.seed, index, scene.bodies.size(), threads);
    for (std::size_t i = 0; i < all.size(); ++i) {
      scene.bodies.push_back({target.line ? fmt::format("{}_{}", target.name, i + 1) : target.name, all[i], mesh,
                              mean_speed(scene.targets.back())});
    }
  }
  if (scene.bodies.empty()) throw InputError("targets: none of them is a mesh, so nothing moves in the waves");
  return scene;
}

// Part of this sea's spectrum outside the table of response amplitude operators, as text.
std::string coverage(const MovingScene& scene) {
  std::string text;
  for (const Body& body : scene.targets) {
    if (const auto* table = std::get_if<RaoTable>(&body.model)) {
      text += fmt::format("# {}: {:.3g} % of the waves' variance lies outside of its frequencies\n",
                          on_one_line(table->source()), 100 * table->uncovered_variance_fraction(scene.sea));
    }
  }
  return text;
}

void write_pictures(const MotionArguments& arguments, const Scenario& scenario, const MovingScene& scene) {
  const std::string title = fmt::format("{}: Hs {:.3g} m, Tp {:.3g} s towards {:.4g} deg", scenario.name,
                                        scene.state.significant_wave_height_m, scene.state.peak_period_s,
                                        degrees(scene.state.propagation_rad));
  if (!arguments.figure.empty()) write_motion_figure(scene.bodies, arguments.duration_s, title, arguments.figure);
  if (!arguments.frames.empty()) {
    const double period = std::min(scene.state.peak_period_s, arguments.duration_s);
    write_motion_frames(scene.bodies, scene.sea, period, title, arguments.frames);
  }
  if (arguments.rao.empty()) return;
  for (const Body& body : scene.targets) {
    if (const auto* ship = std::get_if<ShipParticulars>(&body.model)) {
      write_rao_figure(
          *ship, scene.state.propagation_rad, scene.state.depth_m,
          {arguments.rao_reference, {body.spec.wamit_ulen_m, body.spec.wamit_heading, body.spec.wamit_time_factor}},
          fmt::format("{}: waves towards {:.4g} deg, speed {:.3g} m/s", scenario.name,
                      degrees(scene.state.propagation_rad), ship->speed),
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
  const std::vector<SeaState> states = sea_states(scenario.sea);
  warn(sea_warnings(scenario, states));
  const std::size_t count = uniform_time_count(arguments.duration_s, arguments.step_s);
  const MovingScene scene = simulate_all(scenario, states.front(), arguments.duration_s, context.threads, context.stop);
  const std::vector<NamedTrajectory>& bodies = scene.bodies;
  const SeaState& state = scene.state;
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "# seaglint {} motion, scenario {}, seed {}, sea state 0, realisation 0\n", kVersion,
                 on_one_line(scenario.name), scenario.seed);
  fmt::format_to(out, "# significant_wave_height_m {}, peak_period_s {}, gamma {}, propagation_deg {:.10g}, order {}\n",
                 state.significant_wave_height_m, state.peak_period_s, state.gamma, degrees(state.propagation_rad),
                 state.order);
  text += coverage(scene);
  text += "time_s,body,roll_deg,pitch_deg,yaw_deg,surge_m,sway_m,heave_m\n";
  for (std::size_t n = 0; n < count; ++n) {
    if (context.stop) throw Interrupted();
    const double t = arguments.step_s * static_cast<double>(n);
    for (const NamedTrajectory& body : bodies) {
      // A body at rest has no samples of its own; the last time may pass the last sample by its rounding.
      const MotionSample motion = body.trajectory.sample(std::min(t, body.trajectory.end_s()));
      fmt::format_to(out, "{:.9g},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", t, body.body,
                     degrees(motion.angles.x()), degrees(motion.angles.y()), degrees(motion.angles.z()),
                     motion.translation.x(), motion.translation.y(), motion.translation.z());
    }
  }
  write_pictures(arguments, scenario, scene);
  if (!arguments.spectrum.empty()) write_file(arguments.spectrum, spectrum_csv(bodies, arguments.duration_s));
  write_file(arguments.output, text);
  print_out("{}", motion_statistics(bodies, arguments.duration_s));
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
