// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/contact_sheet.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "sim/core/process/error.h"
#include "sim/scenario/sample_plan.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

namespace {

// Calls visit(number, coordinates) for every point of a grid, the last axis fastest.
template <class Visit>
void visit_points(std::span<const std::size_t> sizes, std::size_t total, const Visit& visit) {
  std::vector<std::size_t> at(sizes.size(), 0);
  for (std::size_t point = 0; point < total; ++point) {
    visit(point, at);
    for (std::size_t axis = at.size(); axis-- > 0;) {
      if (++at[axis] < sizes[axis]) break;
      at[axis] = 0;
    }
  }
}

}  // namespace

std::vector<std::vector<std::size_t>> spread_points(std::span<const std::size_t> sizes, std::size_t count) {
  const std::size_t total = std::accumulate(sizes.begin(), sizes.end(), std::size_t{1}, std::multiplies<>());
  SEAGLINT_CHECK(total >= 1, "a grid without points");
  std::vector<std::vector<int>> used;
  for (const std::size_t size : sizes) used.emplace_back(size, 0);
  std::vector<double> nearest(total, std::numeric_limits<double>::infinity());  // squared; of a chosen point 0
  std::vector<std::vector<std::size_t>> chosen;
  while (chosen.size() < std::min(count, total)) {
    std::pair<int, double> best{std::numeric_limits<int>::max(), 0};
    std::vector<std::size_t> next;
    visit_points(sizes, total, [&](std::size_t point, const std::vector<std::size_t>& at) {
      if (nearest[point] == 0) return;
      int uses = 0;
      for (std::size_t axis = 0; axis < at.size(); ++axis) uses += used[axis][at[axis]];
      const std::pair<int, double> rank{uses, -nearest[point]};
      if (rank >= best) return;
      best = rank;
      next = at;
    });
    for (std::size_t axis = 0; axis < next.size(); ++axis) ++used[axis][next[axis]];
    visit_points(sizes, total, [&](std::size_t point, const std::vector<std::size_t>& at) {
      double distance = 0;
      for (std::size_t axis = 0; axis < at.size(); ++axis) {
        if (at[axis] == next[axis]) continue;
        const double apart =
            (static_cast<double>(at[axis]) - static_cast<double>(next[axis])) / static_cast<double>(sizes[axis] - 1);
        distance += apart * apart;
      }
      nearest[point] = std::min(nearest[point], distance);
    });
    chosen.push_back(std::move(next));
  }
  return chosen;
}

namespace {

// Numbers of the samples in the order of the sheet: for each sea and view one of every class.
std::vector<std::size_t> chosen_samples(const Scenario& scenario, const SamplePlan& plan, std::size_t count) {
  const DatasetSpec& spec = scenario.dataset;
  const auto number = [](int value) { return static_cast<std::size_t>(std::max(1, value)); };
  const std::vector<std::size_t> sizes{
      plan.sea_states().size(), plan.views().size(), number(spec.realisations_per_case),
      number(spec.maps_per_case / std::max(1, spec.realisations_per_case) / std::max(1, spec.maps_per_interval)),
      number(spec.maps_per_interval)};
  std::vector<std::vector<int>> targets(spec.classes.size());  // by label
  for (const int target : plan.classes())
    targets[static_cast<std::size_t>(scenario.targets[static_cast<std::size_t>(target)].label)].push_back(target);
  std::erase_if(targets, [](const std::vector<int>& some) { return some.empty(); });

  const std::size_t classes = targets.size();
  const std::vector<std::vector<std::size_t>> points = spread_points(sizes, (count + classes - 1) / classes);
  struct Place {
    std::vector<std::size_t> point;
    std::size_t turn = 0, of_class = 0, sample = 0;
  };
  std::vector<Place> places;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t label = k % classes, turn = k / classes, which = turn % points.size();
    const std::size_t again = turn / points.size(), in_class = targets[label].size();
    if (again >= in_class) continue;  // all of this class's maps are there
    const std::vector<std::size_t>& at = points[which];
    const SampleAddress address{.sea_state = static_cast<int>(at[0]),
                                .realisation = static_cast<int>(at[2]),
                                .view = static_cast<int>(at[1]),
                                .interval = static_cast<int>(at[3]),
                                .target = targets[label][(which + again) % in_class],
                                .clutter = static_cast<int>(at[4])};
    places.push_back({at, again, label, plan.sample(address)});
  }
  std::ranges::sort(places, {}, [](const Place& p) { return std::tuple(p.point, p.turn, p.of_class); });
  std::vector<std::size_t> samples;
  for (const Place& place : places) samples.push_back(place.sample);
  return samples;
}

struct ReadSamples {
  std::vector<Sample> samples;  // in the order asked for
  StoredAxes axes;
};

ReadSamples read_samples(const ContactSheetRequest& request, const std::vector<std::size_t>& numbers) {
  const std::vector<ManifestShard>& shards = request.reader.manifest().shards;
  ReadSamples read;
  read.samples.resize(numbers.size());
  for (std::size_t s = 0; s < shards.size(); ++s) {
    const auto is_here = [&](std::size_t sample) {
      return sample >= shards[s].first_sample && sample < shards[s].first_sample + shards[s].samples;
    };
    if (std::ranges::none_of(numbers, is_here)) continue;
    if (request.stop && *request.stop) throw Interrupted();
    Shard shard = request.reader.shard(s);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (is_here(numbers[i])) read.samples[i] = std::move(shard.samples[numbers[i] - shards[s].first_sample]);
    }
    read.axes = std::move(shard.axes);
  }
  return read;
}

// The window of all targets; none where the whole map is to be shown, with the reason.
std::pair<std::optional<MapWindow>, std::string> common_window(const ReadSamples& read) {
  std::optional<MapWindow> all;
  std::size_t without = 0;
  for (const Sample& sample : read.samples) {
    const TargetWindow own = target_window(sample, read.axes);
    if (!own.window && own.reason.empty()) return {std::nullopt, "whole maps: a target fills its map"};
    without += !own.window;
    if (!own.window) continue;
    if (!all) all = own.window;
    const auto join = [](AxisRange& a, const AxisRange& b) {
      a = {std::min(a.first, b.first), std::max(a.second, b.second)};
    };
    join(all->x, own.window->x);
    join(all->y, own.window->y);
  }
  if (!all) return {std::nullopt, "whole maps: no scattering centre is the strongest cell of its map"};
  std::string text = "window of all targets that are shown";
  if (without > 0) text += fmt::format(", {} of them without centres above clutter and noise", without);
  return {all, text};
}

}  // namespace

ContactSheet contact_sheet(const ContactSheetRequest& request) {
  const Manifest& manifest = request.reader.manifest();
  const Scenario scenario = read_scenario(request.reader.directory() / kScenarioFile);
  const SamplePlan plan(scenario);
  if (plan.size() != request.reader.size()) {
    throw InputError(fmt::format("{}: has {} samples, the manifest {}",
                                 (request.reader.directory() / kScenarioFile).string(), plan.size(),
                                 request.reader.size()));
  }
  const ReadSamples read = read_samples(request, chosen_samples(scenario, plan, request.samples));
  const auto [window, window_text] = request.whole || is_sea_alone(scenario)
                                         ? std::pair{std::optional<MapWindow>(), std::string("whole maps")}
                                         : common_window(read);
  const bool one_elevation = std::ranges::all_of(read.samples, [&](const Sample& s) {
    return s.record.elevation_deg == read.samples.front().record.elevation_deg;
  });
  ContactSheet sheet;
  for (const Sample& sample : read.samples) {
    const SampleRecord& record = sample.record;
    const std::string& of_class = manifest.classes.at(static_cast<std::size_t>(record.label));
    Heatmap map;
    map.title =
        fmt::format("{}{}, sample {}", of_class,
                    of_class == record.target_name ? "" : fmt::format(" ({})", record.target_name), record.sample);
    map.x.label = "range (m)";
    map.y.label = "velocity (m/s)";
    map.colour = level_axis("|RV|");
    map.map = levels_in(read.axes, sample.magnitude, window);
    map.notes = {fmt::format("Hs {:.3g} m", record.significant_wave_height_m),
                 fmt::format("azimuth {:.4g} deg", record.azimuth_deg)};
    if (!one_elevation) map.notes.push_back(fmt::format("elevation {:.3g} deg", record.elevation_deg));
    const bool scr = std::isfinite(record.scr_per_pulse_db);
    if (scr) map.notes.push_back(fmt::format("SCR {:.3g} dB", record.scr_per_pulse_db));
    sheet.text += fmt::format(
        "  sample {:>6}  {:<12} {:<12} Hs {:.3g} m, Tp {:.3g} s, azimuth {:.4g} deg, elevation {:.3g} deg{}\n",
        record.sample, of_class, record.target_name, record.significant_wave_height_m, record.peak_period_s,
        record.azimuth_deg, record.elevation_deg, scr ? fmt::format(", SCR {:.3g} dB", record.scr_per_pulse_db) : "");
    sheet.figure.maps.push_back(std::move(map));
  }
  const int classes = static_cast<int>(manifest.classes.size());
  sheet.figure.style = request.style;
  sheet.figure.columns = request.style == FigureStyle::kPaper ? 2 : classes == 3 ? 3 : std::clamp(classes, 4, 6);
  std::vector<std::string>& notes = sheet.figure.notes;
  notes = radar_print(scenario.radar);
  if (one_elevation) notes.push_back(fmt::format("elevation {:.3g} deg", read.samples.front().record.elevation_deg));
  notes.push_back("positive velocity = receding");
  if (std::ranges::any_of(read.samples, [](const Sample& s) { return std::isfinite(s.record.scr_per_pulse_db); }))
    notes.push_back("SCR per pulse, of each map");
  if (scenario.radar.carrier_count > 1 && !scenario.map.clean)
    notes.push_back("bands along the velocity: pedestal of the hop code");
  notes.push_back(window_text);
  notes.push_back(fmt::format("{} of {} maps of {}, seed {}", read.samples.size(), manifest.samples, manifest.scenario,
                              manifest.seed));
  notes.push_back(fmt::format("seaglint {}", manifest.program_version));
  return sheet;
}

}  // namespace seaglint
