// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Section of a report with the result of a benchmark (tools/benchmark), whose directory is within that of the run.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace seaglint {

inline constexpr const char* kBenchmarkFile = "benchmark.json";

// HTML from the content of benchmark.json: accuracies of baselines and floor, in total and by wave height, and the
// claims of the paper. `report`: relative address of the benchmark's own report; no link if empty.
std::string benchmark_section(const nlohmann::ordered_json& benchmark, const std::string& report);

}  // namespace seaglint
