// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// metrics.json of a run and benchmark.json of a benchmark within its directory: written, and read for the report.

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "classify/model/study.h"
#include "sim/scenario/scenario.h"
#include "tools/evaluate/claims.h"
#include "tools/report/report_data.h"

namespace seaglint {

inline constexpr const char* kBenchmarkFile = "benchmark.json";

// How a run was made.
struct RunRecord {
  int threads = 0;
  std::size_t maps_made = 0, maps_kept = 0;             // kept: from an earlier run
  std::vector<std::pair<std::string, double>> seconds;  // by stage, wall clock
};

// The network of a study as a report names it.
struct NetworkRecord {
  std::size_t parameters = 0;
  int epochs = 0;
  std::vector<double> training_loss;  // by epoch
};
NetworkRecord record_of(const Network& network);

// What metrics.json states: the study without its models, embeddings and splits.
struct RunNumbers {
  Study study;
  NetworkRecord network;
  RunRecord run;
  std::string version;                  // of the program that trained
  std::vector<std::string> processors;  // that made the maps
  std::string scenario_sha256;          // of the data set
};

// What a report shows.
struct RunResults {
  ReportData data;
  RunNumbers numbers;
};

// The run's numbers. Throws InputError for a directory that is no finished run, for numbers that differ from those of
// its model, as tables and figures would be of two trainings, and for contents that are no study of the scenario.
RunNumbers read_metrics(const std::filesystem::path& directory, const Scenario& scenario);

// The content of DIR/model/metrics.json with the members `run` and `report`, the numbers that only the report has:
// features by class, wave height and aspect, maps shown.
void write_metrics(const std::filesystem::path& directory, const RunRecord& run, const ReportData& data);

// A benchmark.json as a report shows it, in per cent with intervals in brackets.
struct StoredBenchmark {
  std::string folder;  // within the run's directory
  BenchmarkRecord record;
  std::string division;
  std::vector<std::string> heights;  // of the columns after the first of every row
  struct Row {
    std::string name;
    bool leaks = false;
    std::vector<std::string> values;  // of all maps, then by wave height
  };
  std::vector<Row> baselines, floor;
  std::vector<Claim> claims;
};
StoredBenchmark read_benchmark_file(const std::filesystem::path& file);  // throws InputError

// Those in folders of the run's directory, by name.
std::vector<StoredBenchmark> read_benchmarks(const std::filesystem::path& run);

}  // namespace seaglint
