// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "sim/core/text/names.h"
#include "sim/scenario/sample_plan.h"
#include "sim/scenario/scenario.h"
#include "sim/scenario/writer.h"
#include "tools/bindings/bindings.h"

namespace py = pybind11;

namespace seaglint {
namespace {

std::vector<Override> overrides_of(const std::vector<std::pair<std::string, std::string>>& pairs) {
  std::vector<Override> overrides;
  for (const auto& [key, value] : pairs) overrides.push_back({key, value});
  return overrides;
}

}  // namespace

void bind_scenario(py::module_& module) {
  using Pairs = std::vector<std::pair<std::string, std::string>>;
  py::class_<Scenario>(module, "Scenario")
      .def_static("read",
                  [](const std::string& file, const Pairs& set) {
                    return read_scenario(find_input(file, "scenarios"), overrides_of(set));
                  })
      .def_static("parse", [](const std::string& yaml, const std::string& name,
                              const Pairs& set) { return parse_scenario(yaml, name, overrides_of(set)); })
      .def_property_readonly("name", [](const Scenario& scenario) { return scenario.name; })
      .def_property_readonly("seed", [](const Scenario& scenario) { return scenario.seed; })
      .def_property_readonly("targets",
                             [](const Scenario& scenario) {
                               std::vector<std::string> names;
                               for (const TargetSpec& target : scenario.targets) names.push_back(target.name);
                               return names;
                             })
      .def("yaml", [](const Scenario& scenario) { return effective_yaml(scenario); })
      .def("__len__", [](const Scenario& scenario) { return SamplePlan(scenario).size(); });
}

}  // namespace seaglint
