// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>

#include "classify/dataset/format/layout.h"
#include "sim/core/process/error.h"
#include "tools/bindings/bindings.h"
#include "tools/pipeline/pipeline.h"

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

}  // namespace

void bind_sample(py::module_& module) {
  py::class_<Pipeline>(module, "Pipeline")
      .def(py::init([](const Scenario& scenario) {
        return interruptible<std::unique_ptr<Pipeline>>(
            [&](const StopFlag&) { return std::make_unique<Pipeline>(scenario); });
      }))
      .def("__len__", [](const Pipeline& pipeline) { return pipeline.plan().size(); })
      .def("sample", &sample);
}

}  // namespace seaglint
