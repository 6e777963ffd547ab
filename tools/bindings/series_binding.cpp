// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/motion/statistics.h"
#include "sim/sea/realisation.h"
#include "sim/sea/statistics.h"
#include "tools/bindings/bindings.h"
#include "tools/options/command_options.h"
#include "tools/pipeline/moving_bodies.h"
#include "tools/pipeline/warnings.h"

namespace py = pybind11;

namespace seaglint {
namespace {

// The surface at t = 0, step, 2 step, ...
struct SeaRows {
  ChosenSea sea;
  SeaSummary summary;
  std::vector<double> shape;       // elevation, its linear part, slope_x, slope_y
  std::vector<double> kinematics;  // velocity x, y, z, acceleration x, y, z; or empty
};

SeaRows sea_rows(const Scenario& scenario, const SeaChoice& choice, const std::array<double, 2>& at, std::size_t count,
                 double step_s, bool kinematics, const StopFlag& stop) {
  SeaRows rows{choose_sea(scenario, choice), {}, {}, {}};
  rows.summary = summarise(rows.sea.state, rows.sea.field);
  SurfaceSeries series(rows.sea.field, at[0], at[1], 0, step_s,
                       kinematics ? SurfaceQuantities::kKinematics : SurfaceQuantities::kElevationAndSlope);
  rows.shape.reserve(4 * count);
  rows.kinematics.reserve(kinematics ? 6 * count : 0);
  for (std::size_t n = 0; n < count; ++n, series.advance()) {
    if (stop) throw Interrupted();
    const SurfaceState surface = series.state();
    rows.shape.insert(rows.shape.end(),
                      {surface.elevation, surface.elevation_linear, surface.slope_x, surface.slope_y});
    if (!kinematics) continue;
    for (const Vec3& v : {surface.velocity, surface.acceleration})
      rows.kinematics.insert(rows.kinematics.end(), v.data(), v.data() + 3);
  }
  return rows;
}

py::dict statistics_of(const SeaSummary& summary) {
  py::dict statistics;
  statistics["significant_wave_height_m"] = summary.significant_wave_height_m;
  statistics["mean_period_s"] = summary.mean_period_s;
  statistics["skewness"] = summary.skewness;
  statistics["rms_slope"] = std::sqrt(summary.slope_variance);
  statistics["cutoff_rad_s"] = summary.cutoff_rad_s;
  statistics["second_order_cutoff_rad_s"] = summary.second_order_cutoff_rad_s;
  statistics["energy_fraction_above_cutoff"] = summary.energy_fraction_above_cutoff;
  statistics["direction_r1"] = summary.direction_r1;
  statistics["steepness"] = summary.steepness;
  statistics["ursell"] = summary.ursell;
  return statistics;
}

py::dict state_of(const ChosenSea& sea) {
  py::dict state;
  state["significant_wave_height_m"] = sea.state.significant_wave_height_m;
  state["peak_period_s"] = sea.state.peak_period_s;
  state["gamma"] = sea.state.gamma;
  state["propagation_deg"] = sea.state.propagation_deg;
  state["depth_m"] = sea.state.depth_m;
  state["order"] = sea.state.order;
  state["components"] = sea.field.components().size();
  return state;
}

py::dict sea(const Scenario& scenario, const SeaChoice& choice, const std::array<double, 2>& at, std::size_t count,
             double step_s, bool kinematics) {
  SeaRows rows = interruptible<SeaRows>(
      [&](const StopFlag& stop) { return sea_rows(scenario, choice, at, count, step_s, kinematics, stop); });
  const auto size = static_cast<py::ssize_t>(count);
  py::dict result;
  result["shape"] = array_of(std::move(rows.shape), {size, 4});
  if (kinematics) result["kinematics"] = array_of(std::move(rows.kinematics), {size, 2, 3});
  result["statistics"] = statistics_of(rows.summary);
  result["state"] = state_of(rows.sea);
  return result;
}

constexpr std::size_t kDegreesOfFreedom = 6;

// [degree of freedom][body][time]: roll, pitch, yaw in degrees, surge, sway, heave in metres.
std::vector<double> motion_values(const MovingBodies& scene, std::size_t count, double step_s, const StopFlag& stop) {
  const std::size_t bodies = scene.bodies.size();
  std::vector<double> values(kDegreesOfFreedom * bodies * count);
  for (std::size_t b = 0; b < bodies; ++b) {
    for (std::size_t n = 0; n < count; ++n) {
      if (stop) throw Interrupted();
      const MotionSample motion = motion_at(scene.bodies[b], step_s * static_cast<double>(n));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        values[(axis * bodies + b) * count + n] = degrees(motion.angles[axis]);
        values[((axis + 3) * bodies + b) * count + n] = motion.translation[axis];
      }
    }
  }
  return values;
}

// [angle][mean, rms, largest in degrees, mean period in seconds][body]
std::vector<double> angle_figures(const MovingBodies& scene, double duration_s) {
  const std::size_t bodies = scene.bodies.size();
  std::vector<double> figures(3 * 4 * bodies);
  for (std::size_t b = 0; b < bodies; ++b) {
    const std::array<AngleStatistics, 3> statistics = angle_statistics(scene.bodies[b].trajectory, duration_s);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const AngleStatistics& angle = statistics[axis];
      const std::array<double, 4> row{degrees(angle.mean), degrees(angle.rms), degrees(angle.largest),
                                      angle.mean_period_s};
      for (std::size_t i = 0; i < row.size(); ++i) figures[(axis * 4 + i) * bodies + b] = row[i];
    }
  }
  return figures;
}

struct MotionRows {
  MovingBodies scene;
  std::vector<double> values, figures;
  std::vector<std::string> notes;
};

py::dict motion(const Scenario& scenario, const SeaChoice& choice, double duration_s, std::size_t count, double step_s,
                int threads) {
  MotionRows rows = interruptible<MotionRows>([&](const StopFlag& stop) {
    MotionRows made;
    const auto note = [&](const TargetSpec& target, const Body& body) {
      if (std::string reading = motion_file_note(target, body); !reading.empty())
        made.notes.push_back(std::move(reading));
      if (std::string finding = hull_warning(target, body); !finding.empty()) made.notes.push_back(std::move(finding));
    };
    made.scene = simulate_bodies(scenario, choice, duration_s, threads, stop, note);
    for (std::string& sentence : uncovered_waves(made.scene)) made.notes.push_back(std::move(sentence));
    made.values = motion_values(made.scene, count, step_s, stop);
    made.figures = angle_figures(made.scene, duration_s);
    return made;
  });
  const auto bodies = static_cast<py::ssize_t>(rows.scene.bodies.size());
  std::vector<std::string> names;
  for (const NamedTrajectory& body : rows.scene.bodies) names.push_back(body.body);
  py::dict result;
  result["bodies"] = names;
  result["values"] = array_of(std::move(rows.values),
                              {static_cast<py::ssize_t>(kDegreesOfFreedom), bodies, static_cast<py::ssize_t>(count)});
  result["figures"] = array_of(std::move(rows.figures), {3, 4, bodies});
  result["notes"] = rows.notes;
  result["state"] = state_of(rows.scene.sea);
  return result;
}

}  // namespace

void bind_series(py::module_& module) {
  py::class_<SeaChoice>(module, "SeaChoice").def(py::init<std::size_t, std::size_t>());
  module.def("uniform_time_count", &uniform_time_count);
  module.def("sea_warnings", [](const Scenario& scenario) { return sea_warnings(scenario, sea_states(scenario.sea)); });
  module.def("sea", &sea);
  module.def("motion", &motion);
}

}  // namespace seaglint
