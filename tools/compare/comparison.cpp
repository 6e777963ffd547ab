// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"
#include "sim/core/process/parallel.h"
#include "tools/compare/cross_check.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_table.h"
#include "tools/rcs/rcs_target.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {
namespace {

// In this quantity, monostatic; absent where nothing contributes, and with cavities.
std::optional<MainContribution> main_contribution(const RcsRequest& request, const RcsTarget& target,
                                                  const PairedCut::Place& place, std::size_t quantity,
                                                  const StopFlag& stop) {
  if (!request.cavities.parts.empty()) return std::nullopt;
  RcsRequest monostatic = request;
  monostatic.transmitter.reset();
  const RcsView view{place.azimuth_deg, place.elevation_deg, place.frequency_hz};
  const GroupSums sums = group_sums(view_contributions(monostatic, target, view, 1, &stop).views[0].points,
                                    2 * kPi * place.frequency_hz / kSpeedOfLight);
  const auto size = [&](const auto& group) { return squared_magnitude(group.second, quantity); };
  const auto most = std::ranges::max_element(sums, {}, size);
  if (most == sums.end() || size(*most) == 0) return std::nullopt;
  return MainContribution{target.prepared.mesh.part_names[most->first.part], most->first.bounces,
                          kMechanismNames[static_cast<std::size_t>(most->first.mechanism)],
                          dbsm_of_area(4 * kPi * size(*most))};
}

// Cuts of one transmitter are solved together.
std::vector<std::vector<const RcsCut*>> by_transmitter(const FieldTable& table) {
  std::vector<std::vector<const RcsCut*>> groups;
  for (const RcsCut& cut : table.cuts) {
    const auto group = std::ranges::find_if(
        groups, [&](const auto& one) { return *one.front()->transmitter == stated_transmitter(cut); });
    (group == groups.end() ? groups.emplace_back() : *group).push_back(&cut);
  }
  return groups;
}

std::vector<ViewGrid> grids_of(const std::vector<const RcsCut*>& cuts) {
  std::vector<ViewPoint> points;
  for (const RcsCut* cut : cuts) {
    for (const FieldValue& value : cut->values) points.push_back(view_point(*cut, value));
  }
  return view_grids(points);
}

// The part of a solved grid at a cut of it.
RcsSweep part_of(const RcsSweep& sweep, const ViewGrid& cut) {
  RcsSweep part{cut.frequency_hz, cut.azimuth_deg, cut.elevation_deg, {}, {}, {}, 0, sweep.transmitter};
  for (const RcsSweep::Model& model : sweep.models) part.models.push_back({model.name, model.edge_diffraction, {}});
  if (sweep.flat) part.flat = RcsSweep::Model{sweep.flat->name, sweep.flat->edge_diffraction, {}};
  for (std::size_t view = 0; view < sweep.views(); ++view) {
    const auto has = [](const std::vector<double>& values, double value) {
      return std::ranges::find(values, value) != values.end();
    };
    if (!has(cut.azimuth_deg, sweep.azimuth_of(view)) || !has(cut.elevation_deg, sweep.elevation_of(view))) continue;
    for (std::size_t m = 0; m < sweep.models.size(); ++m)
      part.models[m].matrices.push_back(sweep.models[m].matrices[view]);
    if (sweep.flat) part.flat->matrices.push_back(sweep.flat->matrices[view]);
  }
  return part;
}

std::string place_of(const ViewGrid& cut) {
  std::string text;
  if (cut.azimuth_deg.size() == 1) text = fmt::format("azimuth {:g} deg", cut.azimuth_deg[0]);
  if (cut.elevation_deg.size() == 1)
    text += fmt::format("{}elevation {:g} deg", text.empty() ? "" : ", ", cut.elevation_deg[0]);
  return text;
}

// Pairs of an export's cut with a solved grid, along the grid's longest side.
void pair(const RcsSweep& sweep, const RcsCut& cut, std::vector<PairedCut>& all) {
  for (const ViewGrid& part : cuts_of({sweep.frequency_hz, sweep.azimuth_deg, sweep.elevation_deg})) {
    for (PairedCut& paired : paired_cuts(part_of(sweep, part), cut)) {
      paired.place = place_of(part);
      all.push_back(std::move(paired));
    }
  }
}

// A point of a paired cut for the fit.
AlignmentPoint point_of(const PairedCut& cut, std::size_t i) {
  const PairedCut::Place& place = cut.places[i];
  return {static_cast<std::size_t>(cut.element),
          place.frequency_hz,
          place.azimuth_deg,
          place.elevation_deg,
          place.path_gradient,
          cut.models[0].amplitude_m[i],
          cut.amplitude_m[i],
          cut.origin_m};
}

// Fits all cuts with phases and brings their references into the phase of the compared values.
std::optional<Alignment> align(std::vector<PairedCut>& cuts, int threads) {
  std::vector<AlignmentPoint> points;
  for (const PairedCut& cut : cuts) {
    for (std::size_t i = 0; cut.has_phases() && i < cut.places.size(); ++i) points.push_back(point_of(cut, i));
  }
  if (points.empty()) return std::nullopt;
  const Alignment alignment = fit_alignment(points, threads);
  for (PairedCut& cut : cuts) {
    for (std::size_t i = 0; cut.has_phases() && i < cut.places.size(); ++i)
      cut.amplitude_m[i] = aligned(alignment, point_of(cut, i));
  }
  return alignment;
}

// Adds the pairs of one cut to those of all, as sums of shifts and levels.
void add_pairs(ExtremumPairs& all, const ExtremumPairs& more) {
  const double n = static_cast<double>(all.paired), m = static_cast<double>(more.paired);
  if (m > 0) {
    all.mean_shift = (n * all.mean_shift + m * more.mean_shift) / (n + m);
    all.mean_db = (n * all.mean_db + m * more.mean_db) / (n + m);
  }
  all.count += more.count;
  all.paired += more.paired;
}

// Lobes within 40 dB of the element's maximum, nulls above its floor.
void add_extrema(const PairedCut& cut, double highest, double floor, ElementStatistics& statistics) {
  constexpr double kLobes_db = 40;
  if (cut.axis == CutAxis::kSeveral) return;
  const std::vector<double>& reference = cut.level_dbsm;
  const std::vector<double>& other = cut.models[0].level_dbsm;
  add_pairs(statistics.lobes, paired_extrema(lobes_of(cut.x, reference, highest - kLobes_db),
                                             lobes_of(cut.x, other, highest - kLobes_db)));
  add_pairs(statistics.nulls, paired_extrema(nulls_of(cut.x, reference, floor), nulls_of(cut.x, other, floor)));
  statistics.axis = cut.axis;
}

// A cross-polar echo below this is within the purity of an antenna or a mesh.
constexpr double kPurity_db = 40;

// The highest level of the export, or of the compared values, in a quantity, or in all.
double highest_of(const std::vector<PairedCut>& cuts, std::optional<std::size_t> quantity = std::nullopt,
                  bool compared = false) {
  double highest = -1e300;
  for (const PairedCut& cut : cuts) {
    if (!quantity || cut.quantity() == *quantity)
      highest = std::max(highest, std::ranges::max(compared ? cut.models[0].level_dbsm : cut.level_dbsm));
  }
  return highest;
}

// "zero", or how far a level is below the strongest.
std::string below_text(double level_dbsm, double strongest_dbsm) {
  if (level_dbsm <= kMinLevel_dbsm + 1) return "zero";
  return fmt::format("{:.1f} dB below the strongest", strongest_dbsm - level_dbsm);
}

// Removes the cuts of quantities that are zero or rounding on one side, as the cross-polar ones of a symmetric body:
// their difference is that of the floor. The strongest compared level is also that of elements which the export lacks.
void omit_rounding(ExportComparison& comparison) {
  double strongest_compared = highest_of(comparison.cuts, std::nullopt, true);
  for (const RcsCut& cut : comparison.solved) {
    for (const FieldValue& value : cut.values) strongest_compared = std::max(strongest_compared, value.level_dbsm);
  }
  const double strongest = highest_of(comparison.cuts);
  for (std::size_t quantity = 0; quantity < kQuantities; ++quantity) {
    const double reference = highest_of(comparison.cuts, quantity),
                 compared = highest_of(comparison.cuts, quantity, true);
    const auto is_silent = [](double level, double of_strongest) {
      return level <= kMinLevel_dbsm + 1 || level < of_strongest - kRounding_db;
    };
    const bool export_silent = is_silent(reference, strongest), other_silent = is_silent(compared, strongest_compared);
    if (!export_silent && !other_silent) continue;
    if (std::erase_if(comparison.cuts, [&](const PairedCut& cut) { return cut.quantity() == quantity; }) == 0) continue;
    const char* name = kQuantityNames[quantity];
    if (export_silent && other_silent) {
      comparison.omitted.push_back(
          fmt::format("{} is not compared: it is {:g} dB or more below the strongest in both", name, kRounding_db));
      continue;
    }
    const double other = export_silent ? strongest_compared - compared : strongest - reference;
    (other < kPurity_db ? comparison.one_sided : comparison.omitted)
        .push_back(fmt::format("{} is not compared: {} in the export, {} in {}", name, below_text(reference, strongest),
                               below_text(compared, strongest_compared), comparison.compared));
  }
}

// One pair of values of a quantity.
struct Pair {
  double difference_db = 0, reference_dbsm = 0;
  PairedCut::Place place;
};

// The smallest value that at least this fraction of the values do not exceed.
double at_most(std::vector<double> values, double fraction) {
  if (values.empty()) return 0;
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(fraction * static_cast<double>(values.size()))) - 1;
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

// The window of a quarter of an axis' range with the largest fraction of the squared differences, of all three axes.
ElementStatistics::Sector sector_of(std::vector<Pair> pairs) {
  constexpr std::size_t kLeast = 8;  // different values of an axis
  constexpr double kQuarter = 0.25;
  struct Axis {
    const char *name, *unit;
    double PairedCut::Place::*value;
    double scale;
  };
  constexpr std::array<Axis, 3> kAxes{{{"azimuth", "deg", &PairedCut::Place::azimuth_deg, 1},
                                       {"elevation", "deg", &PairedCut::Place::elevation_deg, 1},
                                       {"frequency", "GHz", &PairedCut::Place::frequency_hz, 1e-9}}};
  double all = 0;
  for (const Pair& pair : pairs) all += pair.difference_db * pair.difference_db;
  ElementStatistics::Sector sector;
  if (all == 0) return sector;
  const double rms = std::sqrt(all / static_cast<double>(pairs.size()));
  for (const Axis& axis : kAxes) {
    const auto at = [&](std::size_t i) { return axis.scale * (pairs[i].place.*axis.value); };
    std::ranges::stable_sort(pairs, {}, [&](const Pair& pair) { return pair.place.*axis.value; });
    std::set<double> different;
    for (std::size_t i = 0; i < pairs.size(); ++i) different.insert(at(i));
    if (different.size() < kLeast) continue;
    const double width = kQuarter * (*different.rbegin() - *different.begin());
    double sum = 0;
    for (std::size_t first = 0, end = 0; first < pairs.size(); ++first) {
      for (; end < pairs.size() && at(end) <= at(first) + width; ++end)
        sum += pairs[end].difference_db * pairs[end].difference_db;
      if (sum > sector.fraction * all) {
        sector = {axis.name, axis.unit, at(first), at(end - 1), sum / all};
        // Its ends are differences above the mean square.
        std::size_t low = first, high = end - 1;
        while (low < high && std::abs(pairs[low].difference_db) < rms) ++low;
        while (high > low && std::abs(pairs[high].difference_db) < rms) --high;
        sector.low = at(low);
        sector.high = at(high);
      }
      sum -= pairs[first].difference_db * pairs[first].difference_db;
    }
  }
  return sector;
}

// Percentiles, and where the differences are large.
void add_distribution(const std::vector<Pair>& pairs, ElementStatistics& statistics) {
  std::vector<double> sizes, about_bias, strong;
  std::set<double> frequencies;
  std::set<std::pair<double, double>> directions;
  const double weak = statistics.highest_dbsm - kStrong_db;
  for (const Pair& pair : pairs) {
    sizes.push_back(std::abs(pair.difference_db));
    about_bias.push_back(std::abs(pair.difference_db - statistics.difference.bias_db));
    if (pair.reference_dbsm >= weak) strong.push_back(sizes.back());
    frequencies.insert(pair.place.frequency_hz);
    directions.emplace(pair.place.azimuth_deg, pair.place.elevation_deg);
  }
  statistics.frequencies = frequencies.size();
  statistics.directions = directions.size();
  statistics.p90_db = at_most(sizes, 0.9);
  statistics.p95_db = at_most(std::move(sizes), 0.95);
  statistics.p90_about_bias_db = at_most(std::move(about_bias), 0.9);
  statistics.strong = strong.size();
  statistics.p90_strong_db = at_most(std::move(strong), 0.9);
  statistics.limit_db = std::max(1.0, statistics.p90_db);
  for (const Pair& pair : pairs) {
    if (std::abs(pair.difference_db) <= statistics.limit_db) continue;
    ++statistics.beyond;
    if (pair.reference_dbsm < weak) ++statistics.beyond_weak;
  }
  statistics.sector = sector_of(pairs);
}

// The pairs of the largest differences, largest first, `count` at most; of those within a fiftieth of the range of
// every axis the largest alone.
std::vector<Pair> worst_of(std::vector<Pair> pairs, std::size_t count) {
  constexpr std::array kNear{0.02, 0.02, 0.25};
  constexpr std::array kAxes{&PairedCut::Place::azimuth_deg, &PairedCut::Place::elevation_deg,
                             &PairedCut::Place::frequency_hz};
  std::array<double, kAxes.size()> near{};
  for (std::size_t a = 0; a < kAxes.size(); ++a) {
    const auto [low, high] = std::ranges::minmax(pairs, {}, [&](const Pair& pair) { return pair.place.*kAxes[a]; });
    near[a] = kNear[a] * (high.place.*kAxes[a] - low.place.*kAxes[a]);
  }
  std::vector<Pair> worst;
  while (worst.size() < count && !pairs.empty()) {
    worst.push_back(
        *std::ranges::max_element(pairs, {}, [](const Pair& pair) { return std::abs(pair.difference_db); }));
    std::erase_if(pairs, [&](const Pair& pair) {
      for (std::size_t a = 0; a < kAxes.size(); ++a) {
        if (std::abs(pair.place.*kAxes[a] - worst.back().place.*kAxes[a]) > near[a]) return false;
      }
      return true;
    });
  }
  return worst;
}

ElementStatistics statistics_of(const std::vector<PairedCut>& cuts, std::size_t quantity, double floor_db) {
  constexpr std::size_t kWorst = 5;
  ElementStatistics statistics;
  statistics.element = element_of_quantity(quantity);
  statistics.total = is_total(quantity);
  const double highest = std::max(highest_of(cuts, quantity), highest_of(cuts) - kRounding_db);
  const double floor = highest - floor_db;
  DifferenceSum sum;
  std::vector<Pair> pairs;
  for (const PairedCut& cut : cuts) {
    if (cut.quantity() != quantity) continue;
    add_extrema(cut, highest, floor, statistics);
    for (std::size_t i = 0; i < cut.places.size(); ++i) {
      const double difference = sum.add(cut.models[0].level_dbsm[i], cut.level_dbsm[i], floor, cut.x[i]);
      pairs.push_back({difference, cut.level_dbsm[i], cut.places[i]});
      if (cut.has_phases()) sum.add_phases(cut.models[0].amplitude_m[i], cut.amplitude_m[i]);
    }
  }
  statistics.difference = sum.difference();
  statistics.highest_dbsm = highest_of(cuts, quantity);
  add_distribution(pairs, statistics);
  for (const Pair& pair : worst_of(std::move(pairs), kWorst))
    statistics.worst.push_back({pair.difference_db, pair.place, pair.reference_dbsm, {}});
  return statistics;
}

ExportComparison finished(ExportComparison comparison, const ComparisonSettings& settings, int threads) {
  omit_rounding(comparison);
  if (!settings.as_is) comparison.alignment = align(comparison.cuts, threads);
  for (std::size_t quantity = 0; quantity < kQuantities; ++quantity) {
    if (std::ranges::count(comparison.cuts, quantity, &PairedCut::quantity) > 0)
      comparison.elements.push_back(statistics_of(comparison.cuts, quantity, settings.floor_db));
  }
  comparison.warnings = comparison.one_sided;
  if (comparison.alignment) {
    for (std::string& sentence : fitted_conventions(*comparison.alignment, comparison.cuts))
      comparison.warnings.push_back(std::move(sentence));
  }
  comparison.suggested = suggestions(comparison.cuts, settings.floor_db);
  comparison.warnings.insert(comparison.warnings.end(), comparison.suggested.begin(), comparison.suggested.end());
  return comparison;
}

// The values of `other` at the places of the cut: its own ones, or interpolated.
std::vector<RcsSweep> counterpart(const RcsCut& cut, const RcsCut& other, const ComparisonSettings& settings,
                                  int threads, std::optional<InterpolationQuality>& quality) {
  if (!settings.interpolation_radius_m) return table_sweeps(cut, other);
  std::vector<ViewPoint> places;
  for (const FieldValue& value : cut.values) places.push_back(view_point(cut, value));
  const InterpolatedCut interpolated = interpolated_cut(other, places, *settings.interpolation_radius_m, threads);
  quality = quality ? combined(*quality, interpolated.quality) : interpolated.quality;
  return table_sweeps(cut, interpolated.cut);
}

// The sweep of a request at a grid: one of those solved already, or solved and added to them.
const RcsSweep& solution_of(RcsRequest request, const ViewGrid& grid, const RcsTarget& target, const std::string& name,
                            TargetSolutions& solutions) {
  for (const TargetSolutions::Solved& solved : solutions.solved) {
    if (solved.transmitter == request.transmitter && solved.grid == grid) return solved.sweep;
  }
  request.frequency_hz = grid.frequency_hz;
  request.azimuth_deg = grid.azimuth_deg;
  request.elevation_deg = grid.elevation_deg;
  solutions.say(fmt::format(
      "{}: frequencies {}, directions {}, {}", name, grid.frequency_hz.size(), requested_sweep(request).views(),
      request.transmitter ? fmt::format("transmitter at azimuth {:g} deg, elevation {:g} deg",
                                        request.transmitter->azimuth_deg, request.transmitter->elevation_deg)
                          : std::string("monostatic")));
  RcsSweep sweep = compute_rcs(request, target, solutions.threads, &solutions.stop, solutions.say).sweep;
  return solutions.solved.emplace_back(TargetSolutions::Solved{request.transmitter, grid, std::move(sweep)}).sweep;
}

// A table that a target is solved at.
struct TargetSolution {
  const FieldTable& table;
  const RcsRequest& request;
  const RcsTarget& target;
  TargetSolutions& solutions;
};

// The quantities of a table with the other polarisation transmitted.
FieldTable other_transmitted(FieldTable table) {
  for (RcsCut& cut : table.cuts) cut.element = element_of(receives_v(cut.element), !transmits_v(cut.element));
  return table;
}

struct SolvedPairs {
  std::vector<PairedCut> pairs;  // of the table's values
  std::vector<RcsCut> solved;    // all elements at their places
};

SolvedPairs solved_pairs(const TargetSolution& solution) {
  SolvedPairs result;
  for (const std::vector<const RcsCut*>& cuts : by_transmitter(solution.table)) {
    RcsRequest solved = solution.request;
    solved.transmitter = fixed_transmitter(*cuts.front());
    for (const ViewGrid& grid : grids_of(cuts)) {
      const RcsSweep& sweep = solution_of(solved, grid, solution.target, solution.table.name, solution.solutions);
      append_cuts(sweep, result.solved);
      for (const RcsCut* cut : cuts) pair(sweep, *cut, result.pairs);
    }
  }
  return result;
}

// Median of |compared - export| of the levels within 40 dB of the highest.
double median_difference(const std::vector<PairedCut>& cuts) {
  constexpr double kDynamic_db = 40;
  const double weakest = highest_of(cuts) - kDynamic_db;
  std::vector<double> differences;
  for (const PairedCut& cut : cuts) {
    for (std::size_t i = 0; i < cut.places.size(); ++i) {
      if (cut.level_dbsm[i] >= weakest)
        differences.push_back(std::abs(cut.models[0].level_dbsm[i] - cut.level_dbsm[i]));
    }
  }
  return quartiles(std::move(differences)).median;
}

// A sentence where the values are those of the other polarisation transmitted, which many files do not state.
std::optional<std::string> suggest_other_transmitted(const TargetSolution& solution,
                                                     const std::vector<PairedCut>& pairs) {
  constexpr double kPoor_db = 1.5, kClearly = 0.25;
  const double as_is = median_difference(pairs);
  if (!(as_is > kPoor_db)) return std::nullopt;
  const FieldTable other = other_transmitted(solution.table);
  const double exchanged =
      median_difference(solved_pairs({other, solution.request, solution.target, solution.solutions}).pairs);
  if (!(exchanged < std::min(kClearly * as_is, kPoor_db))) return std::nullopt;
  const bool v = transmits_v(solution.table.cuts.front().element);
  const bool both =
      std::ranges::any_of(solution.table.cuts, [&](const RcsCut& cut) { return transmits_v(cut.element) != v; });
  return fmt::format("with {} the median difference falls from {:.1f} to {:.1f} dB: --reference-polarisation{}?",
                     both ? "both transmitted polarisations exchanged"
                          : fmt::format("{} transmitted instead of {}", v ? "h" : "v", v ? "v" : "h"),
                     as_is, exchanged,
                     both ? ""
                     : v  ? " h"
                          : " v");
}

bool is_perfect_conductor(const PreparedTarget& target) {
  return std::ranges::all_of(target.materials, [](const MaterialSpec& material) {
    return material.kind == SurfaceKind::kPec || material.kind == SurfaceKind::kSubmerged;
  });
}

// Exact and closed-form values of a target that is recognised, and trials where the agreement is poor.
void judge(const TargetSolution& solution, const ComparisonSettings& settings, ExportComparison& comparison) {
  const auto solve = [&](const FieldTable& table, const RcsRequest& request) {
    const RcsTarget target = prepare_rcs_target(at_frequencies_of({table}, request));
    TargetSolutions trials{solution.solutions.threads, solution.solutions.stop, [](const std::string&) {}};
    return solved_pairs({table, request, target, trials}).pairs;
  };
  if (std::optional<std::string> sentence = suggest_other_transmitted(solution, comparison.cuts)) {
    comparison.warnings = {*sentence};
    comparison.suggested = {*sentence};
    return;
  }
  comparison.trials =
      trial_solutions({solution.table, solution.request, comparison.cuts, solve, solution.solutions.say});
  // Of a mesh in another unit no other suggestion and no known value means anything.
  const bool other_unit = std::ranges::any_of(comparison.trials, is_unit);
  if (other_unit) comparison.warnings.clear();
  for (std::string& sentence : trial_sentences(comparison.trials)) comparison.warnings.push_back(std::move(sentence));
  if (other_unit) return;
  if (!is_perfect_conductor(solution.target.prepared)) return;
  comparison.known = known_values(comparison.cuts, canonical_bodies(solution.target.prepared.mesh), settings.floor_db);
}

// hv and vh of one export, in one file or two.
void warn_of_non_reciprocity(const std::vector<ExportComparison*>& parts) {
  constexpr double kDynamic_db = 60, kAllowed_db = 1;
  constexpr std::size_t kLeastPairs = 5;
  using Place = std::tuple<double, double, double>;
  std::array<std::map<Place, double>, 2> cross;  // hv, vh
  double highest = -1e300;
  for (const ExportComparison* part : parts) {
    for (const PairedCut& cut : part->cuts) {
      highest = std::max(highest, std::ranges::max(cut.level_dbsm));
      for (std::size_t i = 0; is_cross(cut.element) && i < cut.places.size(); ++i) {
        const PairedCut::Place& p = cut.places[i];
        const double twice_k = 4 * kPi * p.frequency_hz / kSpeedOfLight;
        if (p.path_gradient.norm() < (1 - 1e-9) * twice_k) continue;  // bistatic
        cross[cut.element == Polarisation::kHv ? 0 : 1][{p.frequency_hz, p.azimuth_deg, p.elevation_deg}] =
            cut.level_dbsm[i];
      }
    }
  }
  std::vector<double> differences;
  for (const auto& [place, hv] : cross[0]) {
    const auto vh = cross[1].find(place);
    if (vh != cross[1].end() && std::max(hv, vh->second) > highest - kDynamic_db)
      differences.push_back(std::abs(hv - vh->second));
  }
  if (differences.size() < kLeastPairs) return;
  const double median = quartiles(differences).median;
  if (median <= kAllowed_db) return;
  for (ExportComparison* part : parts)
    part->warnings.push_back(fmt::format(
        "hv and vh of the export differ by {:.1f} dB (median of {} places), which are equal by reciprocity: its "
        "cross-polar levels are no better than that",
        median, differences.size()));
}

}  // namespace

std::string MainContribution::group() const {
  return fmt::format("part {}, {} bounce{}, {}", part, bounces, bounces == 1 ? "" : "s", mechanism);
}

RcsRequest at_frequencies_of(const std::vector<FieldTable>& tables, RcsRequest request) {
  std::set<double> frequencies;  // ascending, each once
  for (const FieldTable& table : tables) {
    for (const RcsCut& cut : table.cuts) {
      for (const FieldValue& value : cut.values) frequencies.insert(value.frequency_hz);
    }
  }
  request.frequency_hz = {frequencies.begin(), frequencies.end()};
  request.azimuth_deg = {0};
  return request;
}

ExportComparison compare_with_target(const FieldTable& table, const RcsRequest& request, const RcsTarget& target,
                                     const ComparisonSettings& settings, TargetSolutions& solutions) {
  ExportComparison comparison{table.name, table.reader, "seaglint", table.notes};
  comparison.solver = request;
  const TargetSolution solution{table, request, target, solutions};
  SolvedPairs pairs = solved_pairs(solution);
  comparison.cuts = std::move(pairs.pairs);
  for (PairedCut& cut : comparison.cuts) cut.models.back().name = comparison.compared;
  comparison.solved = std::move(pairs.solved);
  comparison = finished(std::move(comparison), settings, solutions.threads);
  judge(solution, settings, comparison);
  if (std::any_of(table.cuts.begin(), table.cuts.end(),
                  [](const RcsCut& cut) { return !cut.transmitter->is_monostatic; }))
    return comparison;
  for (ElementStatistics& statistics : comparison.elements) {
    for (ElementStatistics::Worst& worst : statistics.worst)
      worst.main = main_contribution(request, target, worst.place, statistics.quantity(), solutions.stop);
  }
  return comparison;
}

ExportComparison compare_with_table(const FieldTable& table, const FieldTable& other,
                                    const ComparisonSettings& settings, int threads) {
  ExportComparison comparison{table.name, table.reader, other.name, table.notes};
  for (const RcsCut& cut : table.cuts) {
    const std::vector<RcsCut> sums = cut.total ? sums_for(cut, other) : std::vector<RcsCut>();
    std::vector<const RcsCut*> candidates;
    for (const RcsCut& values : other.cuts) candidates.push_back(&values);
    for (const RcsCut& values : sums) candidates.push_back(&values);
    for (const RcsCut* candidate : candidates) {
      const RcsCut& values = *candidate;
      if (values.quantity() != cut.quantity()) continue;
      if (stated_transmitter(cut) != stated_transmitter(values)) continue;
      const std::size_t first = comparison.cuts.size();
      for (const RcsSweep& sweep : counterpart(cut, values, settings, threads, comparison.interpolation))
        pair(sweep, cut, comparison.cuts);
      for (std::size_t i = first; i < comparison.cuts.size() && !values.has_phase(); ++i)
        comparison.cuts[i].models[0].amplitude_m.clear();
    }
  }
  if (comparison.cuts.empty())
    throw InputError(fmt::format(
        "{} and {} have no element, incident wave, direction and frequency in common{}", table.name, other.name,
        settings.interpolation_radius_m ? "" : "; nothing is interpolated without --interpolate METRES"));
  return finished(std::move(comparison), settings, threads);
}

void check_reciprocity(std::vector<ExportComparison>& comparisons) {
  const auto has = [](const ExportComparison& comparison, Polarisation element) {
    return std::ranges::any_of(comparison.cuts, [&](const PairedCut& cut) { return cut.element == element; });
  };
  std::map<std::string, std::vector<ExportComparison*>> halves;  // exports of one cross-polar element, by reader
  for (ExportComparison& comparison : comparisons) {
    const bool hv = has(comparison, Polarisation::kHv), vh = has(comparison, Polarisation::kVh);
    if (hv && vh) warn_of_non_reciprocity({&comparison});
    if (hv != vh) halves[comparison.reader].push_back(&comparison);
  }
  for (const auto& [reader, pair] : halves) {
    if (pair.size() == 2) warn_of_non_reciprocity(pair);
  }
}

}  // namespace seaglint
