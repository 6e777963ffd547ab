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
#include "sim/geometry/mesh_io.h"
#include "sim/motion/target_motion.h"
#include "tools/command.h"
#include "tools/scene.h"
#include "tools/series_times.h"

namespace seaglint {

namespace {

struct MotionArguments {
  ScenarioArguments scenario;
  std::string output;
  double duration_s = 100;
  double step_s = 0.1;
};

struct NamedTrajectory {
  std::string body;
  Trajectory trajectory;
};

// The bodies of every mesh target, in the order of the file: `ship`, `array_1`, `array_2`, ...
std::vector<NamedTrajectory> simulate_all(const Scenario& scenario, double duration_s, int threads,
                                          const StopFlag& stop) {
  const SeaState state = sea_states(scenario.sea).front();
  const std::uint64_t index = realisation_index(0, 0);
  const WaveField sea = realize_sea(state, scenario.seed, index);
  std::vector<NamedTrajectory> bodies;
  for (const TargetSpec& target : scenario.targets) {
    if (target.mesh.empty()) continue;
    if (stop) throw Interrupted();
    const Body body = load_body(scenario, target, read_mesh(find_mesh(scenario, target), target.unit));
    const std::vector<Trajectory> all =
        simulate_target(target, body, state, sea, duration_s, scenario.seed, index, bodies.size(), threads);
    for (std::size_t i = 0; i < all.size(); ++i) {
      bodies.push_back({target.line ? fmt::format("{}_{}", target.name, i + 1) : target.name, all[i]});
    }
  }
  if (bodies.empty()) throw InputError("targets: none of them is a mesh, so nothing moves in the waves");
  return bodies;
}

void write_motion(const MotionArguments& arguments, const Shell& shell) {
  const Scenario scenario = arguments.scenario.read();
  const std::size_t count = uniform_time_count(arguments.duration_s, arguments.step_s);
  const std::vector<NamedTrajectory> bodies = simulate_all(scenario, arguments.duration_s, shell.threads, shell.stop);

  const SeaState state = sea_states(scenario.sea).front();
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "# seaglint {} motion, scenario {}, seed {}, sea state 0, realisation 0\n", kVersion,
                 scenario.name, scenario.seed);
  fmt::format_to(out, "# significant_wave_height_m {}, peak_period_s {}, gamma {}, propagation_deg {:.10g}, order {}\n",
                 state.significant_wave_height_m, state.peak_period_s, state.gamma, degrees(state.propagation_rad),
                 state.order);
  text += "time_s,body,roll_deg,pitch_deg,yaw_deg,surge_m,sway_m,heave_m\n";
  for (std::size_t n = 0; n < count; ++n) {
    if (shell.stop) throw Interrupted();
    const double t = arguments.step_s * static_cast<double>(n);
    for (const NamedTrajectory& body : bodies) {
      // A body at rest has no samples of its own; the last time may pass the last sample by its rounding.
      const MotionSample motion = body.trajectory.sample(std::min(t, body.trajectory.end_s()));
      fmt::format_to(out, "{:.9g},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", t, body.body,
                     degrees(motion.angles.x()), degrees(motion.angles.y()), degrees(motion.angles.z()),
                     motion.shift.x(), motion.shift.y(), motion.shift.z());
    }
  }
  write_file(arguments.output, text);
}

}  // namespace

void add_motion(CLI::App& app, Shell& shell) {
  CLI::App* command =
      app.add_subcommand("motion", "Write the angles and translations of every body in the scenario's first sea state");
  auto arguments = std::make_shared<MotionArguments>();
  add_scenario_arguments(*command, arguments->scenario);
  command->add_option("-o,--output", arguments->output, "CSV file to write")->required();
  add_threads_option(*command, shell);
  add_time_options(*command, arguments->duration_s, arguments->step_s);
  command->footer("Example:\n  seaglint motion scenarios/quick.yaml --duration-s 60 -o motion.csv");
  command->callback([arguments, &shell] { shell.work = [arguments, &shell] { write_motion(*arguments, shell); }; });
}

}  // namespace seaglint
