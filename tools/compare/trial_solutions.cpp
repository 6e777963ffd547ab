// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/trial_solutions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "sim/core/numbers/quantile.h"
#include "sim/core/process/error.h"
#include "tools/rcs/like_program.h"

namespace seaglint {
namespace {

constexpr std::size_t kViews = 8;
constexpr double kPoor_db = 1.5, kOtherUnit_db = 8, kDynamic_db = 40;
constexpr double kRounding_db = 120;  // a symmetric body has no cross-polar echo but rounding

double median_of(std::vector<double> values) { return quartiles(std::move(values)).median; }

// Transmitter, frequency and direction of a value in the file's angles.
using ViewKey = std::tuple<bool, double, double, double, double, double>;

ViewKey key_of(const RcsCut& cut, const FieldValue& value) {
  const DeclaredTransmitter transmitter = cut.transmitter.value_or(DeclaredTransmitter{});
  const bool fixed = !transmitter.is_monostatic;
  return {fixed,
          fixed ? transmitter.theta_deg : 0,
          fixed ? transmitter.phi_deg : 0,
          value.frequency_hz,
          value.theta_deg,
          value.phi_deg};
}

// The table's values at kViews of its views, spread evenly over those that are not weak.
FieldTable few_views(const FieldTable& table) {
  double highest = -1e300;
  for (const RcsCut& cut : table.cuts) {
    for (const FieldValue& value : cut.values) highest = std::max(highest, value.level_dbsm);
  }
  const auto strong = [&](const FieldValue& value) { return value.level_dbsm >= highest - kDynamic_db; };
  std::set<ViewKey> all;
  for (const RcsCut& cut : table.cuts) {
    for (const FieldValue& value : cut.values) {
      if (strong(value)) all.insert(key_of(cut, value));
    }
  }
  const std::vector<ViewKey> keys(all.begin(), all.end());
  std::set<ViewKey> chosen;
  for (std::size_t i = 0; i < kViews && !keys.empty(); ++i)
    chosen.insert(keys[(2 * i + 1) * keys.size() / (2 * kViews)]);
  FieldTable few = table;
  for (RcsCut& cut : few.cuts)
    std::erase_if(cut.values,
                  [&](const FieldValue& value) { return !strong(value) || !chosen.contains(key_of(cut, value)); });
  std::erase_if(few.cuts, [](const RcsCut& cut) { return cut.values.empty(); });
  return few;
}

// compared - export by quantity, frequency and path gradient, of levels that are not weak.
using PlaceKey = std::tuple<std::size_t, double, double, double, double>;

std::map<PlaceKey, double> differences_of(const std::vector<PairedCut>& cuts) {
  double highest = -1e300;
  for (const PairedCut& cut : cuts) {
    for (const double level : cut.level_dbsm) highest = std::max(highest, level);
  }
  std::map<PlaceKey, double> differences;
  for (const PairedCut& cut : cuts) {
    for (std::size_t i = 0; i < cut.places.size(); ++i) {
      if (cut.level_dbsm[i] < highest - kDynamic_db || cut.models[0].level_dbsm[i] < highest - kRounding_db) continue;
      const PairedCut::Place& p = cut.places[i];
      differences[{cut.quantity(), p.frequency_hz, p.path_gradient.x(), p.path_gradient.y(), p.path_gradient.z()}] =
          cut.models[0].level_dbsm[i] - cut.level_dbsm[i];
    }
  }
  return differences;
}

std::vector<double> values_of(const std::map<PlaceKey, double>& differences, bool absolute) {
  std::vector<double> values;
  for (const auto& [key, value] : differences) values.push_back(absolute ? std::abs(value) : value);
  return values;
}

// Solutions of few views, next to those of the whole table.
class Trials {
 public:
  explicit Trials(const TrialRequest& request)
      : request_(request), few_(few_views(request.table)), whole_(differences_of(request.cuts)) {}

  // The trial with another request; absent where the mesh is none for the solver, as of another size.
  std::optional<Trial> with(RcsRequest other) {
    other.uncertainty = false;
    std::map<PlaceKey, double> after;
    try {
      after = differences_of(request_.solve(few_, other));
    } catch (const InputError&) {
      return std::nullopt;
    }
    std::vector<double> before;
    for (const auto& [key, difference] : after) {
      const auto there = whole_.find(key);
      if (there != whole_.end()) before.push_back(std::abs(there->second));
    }
    if (before.empty()) return std::nullopt;
    std::set<std::tuple<double, double, double, double>> views;
    for (const auto& [key, difference] : after)
      views.insert({std::get<1>(key), std::get<2>(key), std::get<3>(key), std::get<4>(key)});
    return Trial{"", "", views.size(), median_of(before), median_of(values_of(after, true)), false};
  }
  double median_abs() const { return median_of(values_of(whole_, true)); }
  double median() const { return median_of(values_of(whole_, false)); }

 private:
  const TrialRequest& request_;
  FieldTable few_;
  std::map<PlaceKey, double> whole_;
};

struct MeshUnit {
  const char* name;
  double metres;
};
constexpr MeshUnit kUnits[] = {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};

double metres_of(const std::string& name) {
  for (const MeshUnit& unit : kUnits) {
    if (name == unit.name) return unit.metres;
  }
  return name == "km" ? 1000 : 1;
}

// The request with its mesh in another unit: the file read anew, or the given mesh scaled.
RcsRequest in_unit(RcsRequest request, const MeshUnit& unit) {
  if (request.mesh) {
    request.mesh = std::make_shared<const TriangleMesh>(enlarged(*request.mesh, unit.metres / metres_of(request.unit)));
  } else {
    request.unit = unit.name;
  }
  return request;
}

// The best of the units whose change of level fits the median difference; absent if none helps.
std::optional<Trial> best_unit(const TrialRequest& request, Trials& trials) {
  constexpr double kLeast = 8, kMost = 50;  // dB per decade of size: from an edge's or less to a flat plate's and more
  constexpr double kQuarter = 0.25, kLeastGain_db = 6;
  std::optional<Trial> best;
  for (const MeshUnit& unit : kUnits) {
    const double decades = std::log10(unit.metres / metres_of(request.request.unit));
    if (decades == 0) continue;
    const double slope = -trials.median() / decades;
    if (slope < kLeast || slope > kMost) continue;
    std::optional<Trial> trial = trials.with(in_unit(request.request, unit));
    if (!trial || trial->after_db > kQuarter * trial->before_db || trial->after_db > trial->before_db - kLeastGain_db)
      continue;
    trial->option = fmt::format("--unit {}", unit.name);
    trial->meaning = fmt::format("the mesh is in {}, not in {}", unit.name, request.request.unit);
    trial->helps = true;
    if (!best || trial->after_db < best->after_db) best = trial;
  }
  return best;
}

bool same_settings(const RcsRequest& a, const RcsRequest& b) {
  return a.crease_deg == b.crease_deg && a.edges == b.edges && a.max_bounces == b.max_bounces;
}

void add_programs(const TrialRequest& request, Trials& trials, std::vector<Trial>& all) {
  constexpr double kClearly = 0.7, kLeastGain_db = 0.3;
  const LikeProgram* const writer = like_program_of_reader(request.table.reader);
  std::vector<RcsRequest> tried{request.request};
  for (const LikeProgram& program : kLikePrograms) {
    if (writer != nullptr && writer != &program) continue;
    const RcsRequest other = solved_like(request.request, program);
    if (std::ranges::any_of(tried, [&](const RcsRequest& one) { return same_settings(one, other); })) continue;
    tried.push_back(other);
    std::optional<Trial> trial = trials.with(other);
    if (!trial) continue;
    trial->option = fmt::format("--like {}", program.name);
    trial->meaning = program.described;
    trial->helps = trial->after_db < kClearly * trial->before_db && trial->after_db < trial->before_db - kLeastGain_db;
    all.push_back(*trial);
  }
}

}  // namespace

std::vector<Trial> trial_solutions(const TrialRequest& request) {
  if (request.cuts.empty() || !request.request.cavities.parts.empty()) return {};
  Trials trials(request);
  if (!(trials.median_abs() > kPoor_db)) return {};
  request.say(fmt::format("{}: the median difference is {:.1f} dB: {} views with other settings", request.table.name,
                          trials.median_abs(), kViews));
  constexpr double kBeyondDoubt = 0.1;  // of the median difference before
  std::optional<Trial> unit;
  if (std::abs(trials.median()) > kOtherUnit_db) unit = best_unit(request, trials);
  if (unit && unit->after_db < kBeyondDoubt * unit->before_db) return {*unit};
  std::vector<Trial> all;
  if (request.request.like.empty()) add_programs(request, trials, all);
  const auto better = [&](const Trial& trial) { return trial.helps && trial.after_db <= unit->after_db; };
  if (unit && std::ranges::none_of(all, better)) return {*unit};
  return all;
}

bool is_unit(const Trial& trial) { return trial.helps && trial.option.starts_with("--unit"); }

std::vector<std::string> trial_sentences(const std::vector<Trial>& trials) {
  if (trials.empty()) return {};
  const Trial* best = nullptr;
  std::vector<std::string> all;
  for (const Trial& trial : trials) {
    all.push_back(fmt::format("{} ({:.1f} dB)", trial.option, trial.after_db));
    if (trial.helps && (best == nullptr || trial.after_db < best->after_db)) best = &trial;
  }
  if (best == nullptr)
    return {fmt::format("the median difference of {} views is {:.1f} dB, not less with {}", trials[0].views,
                        trials[0].before_db, fmt::join(all, ", "))};
  return {fmt::format("with {} the median difference of {} views falls from {:.1f} to {:.1f} dB: {}", best->option,
                      best->views, best->before_db, best->after_db, best->meaning)};
}

}  // namespace seaglint
