// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/scenario_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "classify/dataset/directory/planned_record.h"
#include "classify/dataset/format/array_type.h"
#include "radar/rvmap/rv_map.h"
#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "tools/pipeline/motion_summary.h"
#include "tools/pipeline/trial_time.h"

namespace seaglint {

namespace {

constexpr double kEnoughSeconds = 1;   // of maps whose work is measured, beyond the first of every target
constexpr double kShardBytes = 130e3;  // of a shard without samples: attributes and headers of its arrays
constexpr double kOtherBytes = 20e3;   // scenario, manifest and data card

// Places within the sweeps of sea and view at which maps are timed: the middle of a sweep of aspects, often broadside,
// takes longest.
struct TimedPlace {
  double sea, view;
};
constexpr TimedPlace kPlaces[] = {{0.5, 0.3}, {0.2, 0.8}, {0.8, 0.1}, {0, 0.6}, {1, 0.9}};

int index_at(double place, std::size_t count) {
  return static_cast<int>(std::lround(place * static_cast<double>(count - 1)));
}

// Processor time of the maps of one interval and of the sea of one realisation, s.
struct MeasuredWork {
  double intervals_s = 0, seas_s = 0;  // sums
  int intervals = 0, seas = 0;
};

// Adds a map of every target, at a place within the sweeps; those of one interval share its response.
void measure(const Pipeline& pipeline, const TimedPlace& place, const StopFlag* stop, MeasuredWork& work) {
  const SamplePlan& plan = pipeline.plan();
  SampleAddress at{.sea_state = index_at(place.sea, plan.sea_states().size()),
                   .view = index_at(place.view, plan.views().size()),
                   .interval = index_at(place.sea, static_cast<std::size_t>(plan.intervals()))};
  const auto seconds = [](const auto& make) {
    const double begin_s = thread_seconds();
    make();
    return thread_seconds() - begin_s;
  };
  work.seas_s += seconds([&] { pipeline.scene(at.sea_state, at.realisation); });
  ++work.seas;
  for (const int target : plan.classes()) {
    if (*stop) throw Interrupted();
    at.target = target;
    at.clutter = 0;
    const double first_s = seconds([&] { pipeline.generate_sample(plan.sample(at), stop); });
    double other_s = 0;
    if (plan.maps_per_interval() > 1) {
      at.clutter = 1;
      other_s = seconds([&] { pipeline.generate_sample(plan.sample(at), stop); });
    }
    work.intervals_s += first_s + other_s * (plan.maps_per_interval() - 1);
    ++work.intervals;
  }
}

// "85 s", "12 min", "3.4 h", "5.1 days".
std::string duration_text(double seconds) {
  if (seconds < 90) return fmt::format("{:.2g} s", seconds);
  if (seconds < 90 * 60) return fmt::format("{:.2g} min", seconds / 60);
  if (seconds < 48 * 3600) return fmt::format("{:.2g} h", seconds / 3600);
  return fmt::format("{:.0f} days", seconds / 86400);
}

std::string size_text(double bytes) {
  if (bytes < 1e6) return fmt::format("{:.0f} kB", std::ceil(bytes / 1e3));
  if (bytes < 99.5e6) return fmt::format("{:.2g} MB", bytes / 1e6);
  return bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6) : fmt::format("{:.3g} GB", bytes / 1e9);
}

std::string line(const char* name, const std::string& text) {
  return fmt::format("{:<19} {}\n", name, on_one_line(text));
}

std::string sea_line(const Scenario& scenario, const SamplePlan& plan) {
  const auto states = plan.sea_states().size();
  const int realisations = scenario.dataset.realisations_per_case, intervals = plan.intervals();
  std::string text = fmt::format("{}: {} realisation{} of each sea state, {} interval{} of each",
                                 states * static_cast<std::size_t>(realisations), realisations,
                                 realisations == 1 ? "" : "s", intervals, intervals == 1 ? "" : "s");
  if (intervals > 1) text += fmt::format(" {:g} s apart", scenario.dataset.interval_spacing_s);
  text += " and view";
  if (plan.maps_per_interval() > 1) text += fmt::format(", {} maps of each interval", plan.maps_per_interval());
  return line("seas", text);
}

// A line for each key, the first with the name.
std::string key_lines(const Scenario& scenario, bool drawn) {
  std::string text;
  for (const VariedKey& key : varied_keys(scenario)) {
    if ((key.drawn != nullptr) == drawn)
      text += line(text.empty() ? (drawn ? "drawn" : "swept") : "", fmt::format("{} {}", key.key_path, key.text()));
  }
  return text.empty() ? line(drawn ? "drawn" : "swept", "nothing") : text;
}

constexpr const char* kModels[] = {"fixed", "ship", "float", "series", "rao"};

std::string motion_lines(const Pipeline& pipeline) {
  const auto& states = pipeline.plan().sea_states();
  const double height_m = total_wave_height(std::ranges::max(states, {}, total_wave_height));
  std::string text;
  const auto add = [&](const std::string& of) { text += line(text.empty() ? "moves" : "", of); };
  for (const TargetMotion& motion : target_motions(pipeline)) {
    const std::string moves = motion_text(motion), rests = rest_text(motion);
    const TargetSpec& target = *motion.target;
    if (moves.empty()) {
      add(fmt::format("{}: {}", target.name, rests));
      continue;
    }
    add(fmt::format("{}: {}, {} at Hs {:.3g} m{}{}", target.name,
                    kModels[static_cast<std::size_t>(target.motion.model)], moves, height_m, rests.empty() ? "" : "; ",
                    rests));
  }
  for (const TargetSpec& target : pipeline.scenario().targets) {
    if (target.mesh.empty())
      add(fmt::format("{}: {} points with velocities of their own in any sea", target.name, target.points.size()));
  }
  return text;
}

}  // namespace

double stored_bytes(const Pipeline& pipeline) {
  const Scenario& scenario = pipeline.scenario();
  const DatasetSpec& set = scenario.dataset;
  const PulseTrain train = make_pulse_train(scenario.radar, pipeline.window_m(), scenario.seed, 0);
  const MapGrid grid = map_grid(train, scenario.map);
  const auto cells = static_cast<double>(grid.range_m.size() * grid.velocity_mps.size());
  const auto pulses = static_cast<double>(train.pulses()), frequencies = static_cast<double>(train.frequencies());
  double each = cells * sizeof(float) * (set.complex_maps ? 3 : 1);
  if (set.echoes) each += pulses * frequencies * 2 * sizeof(double);
  each += pulses * sizeof(std::uint16_t) + static_cast<double>(scenario.features.max_centres) * sizeof(StoredCentre);
  for (const SampleColumn& column : sample_columns())
    each += static_cast<double>(std::holds_alternative<std::string SampleRecord::*>(column.member) ? kNameBytes
                                                                                                   : sizeof(double));
  const DrawnKeys drawn = drawn_keys(scenario);
  each += static_cast<double>(drawn.numbers.size() * sizeof(double) + drawn.words.size() * kNameBytes);
  const SamplePlan& plan = pipeline.plan();
  return static_cast<double>(plan.size()) * each + static_cast<double>(plan.shards()) * kShardBytes + kOtherBytes;
}

WorkEstimate estimate_work(const Pipeline& pipeline, const TrialLimit& limit) {
  const SamplePlan& plan = pipeline.plan();
  WorkEstimate estimate{0, false, stored_bytes(pipeline), {}};
  const TimeLimit time(limit.processor_s, limit.stop);
  const double begin_s = thread_seconds();
  MeasuredWork work;
  try {
    for (const TimedPlace& place : kPlaces) {
      measure(pipeline, place, time.flag(), work);
      if (thread_seconds() - begin_s > kEnoughSeconds) break;
    }
  } catch (const Interrupted&) {
    if (limit.stop != nullptr && *limit.stop) throw;
    if (work.intervals == 0) {
      work = {thread_seconds() - begin_s, 0, 1, 1};
      estimate.is_bound = true;
    }
  } catch (const InputError& error) {
    estimate.failure = error.what();
    return estimate;
  }
  const double intervals = static_cast<double>(plan.size()) / plan.maps_per_interval();
  const auto seas = static_cast<double>(plan.sea_states().size()) *
                    static_cast<double>(pipeline.scenario().dataset.realisations_per_case);
  estimate.processor_s = intervals * work.intervals_s / work.intervals + seas * work.seas_s / work.seas;
  return estimate;
}

std::string scenario_summary(const Pipeline& pipeline, const WorkEstimate& work, int threads) {
  const Scenario& scenario = pipeline.scenario();
  const double together = std::min(static_cast<double>(threads), static_cast<double>(pipeline.plan().size()));
  const std::string time =
      work.failure.empty() ? fmt::format("{} {} of processor, {} on {} thread{}, ",
                                         work.is_bound ? "more than" : "about", duration_text(work.processor_s),
                                         duration_text(work.processor_s / together), threads, threads == 1 ? "" : "s")
                           : "";
  return sea_line(scenario, pipeline.plan()) + key_lines(scenario, false) + key_lines(scenario, true) +
         motion_lines(pipeline) + line("work", fmt::format("{}{} of maps", time, size_text(work.bytes)));
}

}  // namespace seaglint
