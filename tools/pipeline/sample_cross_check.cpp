// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/sample_cross_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/core/numbers/quantile.h"
#include "sim/core/process/progress.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {
namespace {

constexpr double kMostDb = 300;

SolverMethod other_than(SolverMethod method) {
  return method == SolverMethod::kBeams ? SolverMethod::kRays : SolverMethod::kBeams;
}

Scenario by_the_other_method(Scenario scenario) {
  for (TargetSpec& target : scenario.targets) target.solver.method = other_than(target.solver.method);
  return scenario;
}

bool has_solver(const Pipeline& pipeline, std::size_t target) {
  const auto is_mesh = [&](std::size_t t) { return !pipeline.targets()[t].models.empty(); };
  return is_mesh(target) || std::ranges::any_of(pipeline.targets()[target].companions, is_mesh);
}

SampleDifference difference_of(const Pipeline& pipeline, const Pipeline& other, std::size_t sample,
                               const StopFlag* stop) {
  const SampleAddress at = pipeline.plan().address(sample);
  const TargetSpec& target = pipeline.scenario().targets[static_cast<std::size_t>(at.target)];
  const PulseTrain train = pipeline.pulse_train(sample);
  const IntervalResult response = pipeline.response(at, train, stop), by_other = other.response(at, train, stop);
  const std::vector<float> map = pipeline.received_sample(sample, train, response).stored.magnitude,
                           other_map = other.received_sample(sample, train, by_other).stored.magnitude;
  const std::size_t cell = static_cast<std::size_t>(std::ranges::max_element(map) - map.begin());
  return {sample,
          target.name,
          target.solver.method,
          other_than(target.solver.method),
          relative_difference_db(response.response, by_other.response),
          std::clamp(20 * std::log10(static_cast<double>(other_map[cell]) / map[cell]), -kMostDb, kMostDb)};
}

const SampleDifference& largest_by(const std::vector<SampleDifference>& all, auto size) {
  return *std::ranges::max_element(all, {}, size);
}

}  // namespace

double SampleCrossCheck::median_response_db() const {
  std::vector<double> values;
  for (const SampleDifference& one : differences) values.push_back(one.response_db);
  return quartiles(std::move(values)).median;
}

std::vector<std::size_t> evenly_spread(std::size_t count, std::size_t size) {
  std::vector<std::size_t> samples(count);
  for (std::size_t n = 0; n < count; ++n) samples[n] = (2 * n + 1) * size / (2 * count);
  return samples;
}

SampleCrossCheck cross_check_samples(const Scenario& scenario, std::span<const std::size_t> samples, int threads,
                                     const StopFlag* stop) {
  const Pipeline pipeline(scenario), other(by_the_other_method(pipeline.scenario()));
  std::vector<std::optional<SampleDifference>> found(samples.size());
  Progress progress("cross-check", samples.size(), "samples");
  parallel_for(
      samples.size(), thread_count(threads),
      [&](std::size_t n) {
        if (has_solver(pipeline, static_cast<std::size_t>(pipeline.plan().address(samples[n]).target)))
          found[n] = difference_of(pipeline, other, samples[n], stop);
        progress.advance();
      },
      stop);
  SampleCrossCheck check;
  for (const auto& one : found) {
    if (one) {
      check.differences.push_back(*one);
    } else {
      ++check.points;
    }
  }
  return check;
}

double relative_difference_db(const FrequencyResponse& reference, const FrequencyResponse& other) {
  double difference2 = 0, reference2 = 0;
  for (std::size_t i = 0; i < reference.values.size(); ++i) {
    difference2 += std::norm(other.values[i] - reference.values[i]);
    reference2 += std::norm(reference.values[i]);
  }
  if (difference2 == 0) return -kMostDb;
  if (reference2 == 0) return kMostDb;
  return std::clamp(10 * std::log10(difference2 / reference2), -kMostDb, kMostDb);
}

std::string text_of(const SampleCrossCheck& check) {
  const std::vector<SampleDifference>& all = check.differences;
  std::string left_out = check.points > 0 ? fmt::format("{} sample{} of ideal points left out, which have no solver\n",
                                                        check.points, check.points == 1 ? "" : "s")
                                          : "";
  if (all.empty()) return left_out;
  std::size_t width = std::string_view("target").size();
  for (const SampleDifference& one : all) width = std::max(width, one.target.size());
  std::string text = fmt::format("{:>8}  {:<{}}  {:<6}  {:<5}  {:>11}  {:>17}\n", "sample", "target", width, "method",
                                 "other", "response_db", "strongest_cell_db");
  std::vector<double> cells;
  for (const SampleDifference& one : all) {
    text +=
        fmt::format("{:>8}  {:<{}}  {:<6}  {:<5}  {:>11.1f}  {:>+17.3f}\n", one.sample, one.target, width,
                    kSolverMethodNames[static_cast<std::size_t>(one.method)],
                    kSolverMethodNames[static_cast<std::size_t>(one.other)], one.response_db, one.strongest_cell_db);
    cells.push_back(std::abs(one.strongest_cell_db));
  }
  const SampleDifference& response = largest_by(all, [](const auto& one) { return one.response_db; });
  const SampleDifference& cell = largest_by(all, [](const auto& one) { return std::abs(one.strongest_cell_db); });
  return text +
         fmt::format(
             "relative difference of the response by the other method: median {:.1f} dB, largest {:.1f} dB (sample "
             "{})\n"
             "change of the strongest cell of the map: median of its magnitude {:.3f} dB, largest {:+.3f} dB (sample "
             "{})\n",
             check.median_response_db(), response.response_db, response.sample, quartiles(cells).median,
             cell.strongest_cell_db, cell.sample) +
         left_out;
}

}  // namespace seaglint
