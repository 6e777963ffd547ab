// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "classify/dataset/format/shard.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/motion/statistics.h"
#include "sim/sea/realisation.h"
#include "sim/sea/statistics.h"
#include "tools/bindings/bindings.h"
#include "tools/options/command_options.h"
#include "tools/pipeline/pipeline.h"
#include "tools/pipeline/warnings.h"

namespace py = pybind11;

namespace seaglint {
namespace {

// Columns of the sample as the data set stores them, by name.
py::dict columns_of(const SampleRecord& record) {
  py::dict columns;
  for (const SampleColumn& column : sample_columns())
    std::visit([&](const auto member) { columns[column.name] = record.*member; }, column.member);
  visit_drawn(record, [&](const std::string& key, const auto& value) { columns[py::str(key)] = value; });
  return columns;
}

py::array_t<double> centres_of(const std::vector<ScatteringCentre>& centres) {
  std::vector<double> rows;
  for (const ScatteringCentre& c : centres) rows.insert(rows.end(), {c.range_m, c.velocity_mps, c.amplitude_m});
  return array_of(std::move(rows), {static_cast<py::ssize_t>(centres.size()), 3});
}

py::dict sample(const Pipeline& pipeline, std::size_t number) {
  GeneratedSample made =
      interruptible<GeneratedSample>([&](const StopFlag& stop) { return pipeline.generate_sample(number, &stop); });
  const auto size = [](const auto& axis) { return static_cast<py::ssize_t>(axis.size()); };
  RvMap& map = made.received.map;
  py::dict result;
  const py::ssize_t ranges = size(map.range_m), velocities = size(map.velocity_mps);
  const py::ssize_t pulses = size(made.train.carrier_hz);
  const py::ssize_t frequencies = size(made.received.echo) / std::max<py::ssize_t>(pulses, 1);
  result["map"] = array_of(std::move(map.values), {velocities, ranges});
  result["range_m"] = array_of(std::move(map.range_m));
  result["velocity_mps"] = array_of(std::move(map.velocity_mps));
  result["echo"] = array_of(std::move(made.received.echo), {pulses, frequencies});
  result["carrier_hz"] = copy_of(made.train.carrier_hz);
  result["pulse_time_s"] = copy_of(made.train.time_s);
  result["hop_code"] = copy_of(made.train.code);
  result["centres"] = centres_of(made.centres);
  result["columns"] = columns_of(made.stored.record);
  return result;
}

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

py::dict state_of(const SeaState& sea, std::size_t components) {
  py::dict state;
  state["significant_wave_height_m"] = sea.significant_wave_height_m;
  state["peak_period_s"] = sea.peak_period_s;
  state["gamma"] = sea.gamma;
  state["propagation_deg"] = sea.propagation_deg;
  state["depth_m"] = sea.depth_m;
  state["order"] = sea.order;
  state["components"] = components;
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
  result["state"] = state_of(rows.sea.state, rows.sea.field.components().size());
  return result;
}

// Motion of every body at 0, step, 2 step, ...
struct MotionRows {
  SeaState state;
  std::size_t components = 0;  // of the sea
  std::vector<std::string> names, notes;
  std::vector<double> values;   // [roll, pitch, yaw in degrees, surge, sway, heave in metres][body][time]
  std::vector<double> figures;  // [angle][mean, rms, largest in degrees, mean period in seconds][body]
};

MotionRows motion_rows(const Scenario& scenario, const SeaChoice& choice, double duration_s, std::size_t count,
                       double step_s, int threads, const StopFlag& stop) {
  const std::vector<Target> targets =
      load_targets({.scenario = scenario, .plan = SamplePlan(scenario), .use = TargetUse::kMotion, .stop = &stop});
  const Scene scene = make_scene({.scenario = scenario,
                                  .targets = targets,
                                  .sea = choice,
                                  .at_least_s = duration_s,
                                  .threads = threads,
                                  .stop = &stop});
  const std::vector<NamedTrajectory> all = named_bodies(targets, scene);
  const std::size_t bodies = all.size();
  MotionRows rows{scene.state, scene.sea.components().size(), {}, motion_file_notes(targets), {}, {}};
  for (const auto& notes : {motion_warnings(targets), uncovered_waves(targets, scene.sea)})
    rows.notes.insert(rows.notes.end(), notes.begin(), notes.end());
  rows.values.resize(6 * bodies * count);
  rows.figures.resize(3 * 4 * bodies);
  for (std::size_t b = 0; b < bodies; ++b) {
    rows.names.push_back(all[b].body);
    for (std::size_t n = 0; n < count; ++n) {
      if (stop) throw Interrupted();
      const MotionSample motion = motion_at(all[b], step_s * static_cast<double>(n));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        rows.values[(axis * bodies + b) * count + n] = degrees(motion.angles[axis]);
        rows.values[((axis + 3) * bodies + b) * count + n] = motion.translation[axis];
      }
    }
    const std::array<AngleStatistics, 3> statistics = angle_statistics(all[b].trajectory, duration_s);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const AngleStatistics& angle = statistics[axis];
      const std::array<double, 4> row{degrees(angle.mean), degrees(angle.rms), degrees(angle.largest),
                                      angle.mean_period_s};
      for (std::size_t i = 0; i < row.size(); ++i) rows.figures[(axis * 4 + i) * bodies + b] = row[i];
    }
  }
  return rows;
}

py::dict motion(const Scenario& scenario, const SeaChoice& choice, double duration_s, std::size_t count, double step_s,
                int threads) {
  MotionRows rows = interruptible<MotionRows>(
      [&](const StopFlag& stop) { return motion_rows(scenario, choice, duration_s, count, step_s, threads, stop); });
  const auto bodies = static_cast<py::ssize_t>(rows.names.size());
  py::dict result;
  result["bodies"] = rows.names;
  result["values"] = array_of(std::move(rows.values), {6, bodies, static_cast<py::ssize_t>(count)});
  result["figures"] = array_of(std::move(rows.figures), {3, 4, bodies});
  result["notes"] = rows.notes;
  result["state"] = state_of(rows.state, rows.components);
  return result;
}

}  // namespace

void bind_scene(py::module_& module) {
  py::class_<Pipeline>(module, "Pipeline")
      .def(py::init([](const Scenario& scenario) {
        return interruptible<std::unique_ptr<Pipeline>>(
            [&](const StopFlag& stop) { return std::make_unique<Pipeline>(scenario, SamplePlan(scenario), &stop); });
      }))
      .def("__len__", [](const Pipeline& pipeline) { return pipeline.plan().size(); })
      .def("sample", &sample);
  py::class_<SeaChoice>(module, "SeaChoice").def(py::init<std::size_t, std::size_t>());
  module.def("uniform_time_count", &uniform_time_count);
  module.def("sea_warnings", [](const Scenario& scenario) { return sea_warnings(scenario, sea_states(scenario.sea)); });
  module.def("sea", &sea);
  module.def("motion", &motion);
}

}  // namespace seaglint
