// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "classify/dataset/directory/dataset_writer.h"
#include "sim/scenario/scenario.h"
#include "tools/bindings/bindings.h"
#include "tools/pipeline/train.h"
#include "tools/pipeline/warnings.h"

namespace py = pybind11;

namespace seaglint {
namespace {

// `set`: key paths of the data set's scenario with their new values. The text of metrics.json and the warnings.
py::tuple train(const std::string& data_set, const std::string& model_directory,
                const std::vector<std::pair<std::string, std::string>>& set, int threads) {
  std::vector<Override> overrides;
  for (const auto& [key, value] : set) overrides.push_back({key, value});
  std::vector<std::string> warnings;
  const std::string metrics = interruptible<std::string>([&](const StopFlag& stop) {
    const DatasetReader data(data_set);
    warnings = data_set_warnings(data);
    const Scenario scenario = read_scenario(std::filesystem::path(data_set) / kScenarioFile, overrides);
    return train_model(data, scenario, model_directory, threads, &stop).metrics.dump();
  });
  return py::make_tuple(metrics, warnings);
}

}  // namespace

void bind_train(py::module_& module) { module.def("train", &train); }

}  // namespace seaglint
