// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "sim/core/process/error.h"
#include "tools/compare/cut_angles.h"
#include "tools/compare/main_contribution.h"
#include "tools/compare/suggestions.h"
#include "tools/compare/table_sweeps.h"
#include "tools/compare/view_groups.h"
#include "tools/rcs/rcs_views.h"
#include "tools/rcs/sweep_files.h"

namespace seaglint {
namespace {

// Cuts of one transmitter are solved together.
using TransmitterKey = std::tuple<bool, double, double>;

TransmitterKey key_of(const DeclaredTransmitter& transmitter) {
  if (transmitter.is_monostatic) return {true, 0, 0};
  return {false, transmitter.theta_deg, transmitter.phi_deg};
}

std::map<TransmitterKey, std::vector<const RcsCut*>> by_transmitter(const FieldTable& table) {
  std::map<TransmitterKey, std::vector<const RcsCut*>> groups;
  for (const RcsCut& cut : table.cuts) groups[key_of(stated_transmitter(cut))].push_back(&cut);
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
      return std::find(values.begin(), values.end(), value) != values.end();
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

bool has_phases(const PairedCut& cut) { return !cut.amplitude_m.empty() && !cut.models[0].amplitude_m.empty(); }

// Fits all cuts with phases and brings their references into the phase of the compared values.
std::optional<Alignment> align(std::vector<PairedCut>& cuts, int threads) {
  std::vector<AlignmentPoint> points;
  for (const PairedCut& cut : cuts) {
    for (std::size_t i = 0; has_phases(cut) && i < cut.places.size(); ++i) points.push_back(point_of(cut, i));
  }
  if (points.empty()) return std::nullopt;
  const Alignment alignment = fit_alignment(points, threads);
  for (PairedCut& cut : cuts) {
    for (std::size_t i = 0; has_phases(cut) && i < cut.places.size(); ++i)
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

// Levels further below the strongest of an export are rounding: single precision is 144 dB.
constexpr double kRounding_db = 120;

// The highest level of the export in an element, or in all.
double highest_of(const std::vector<PairedCut>& cuts, std::optional<Polarisation> element = std::nullopt) {
  double highest = -1e300;
  for (const PairedCut& cut : cuts) {
    if (!element || cut.element == *element) highest = std::max(highest, std::ranges::max(cut.level_dbsm));
  }
  return highest;
}

// Removes the cuts of elements that are rounding in both, as the cross-polar ones of a symmetric body.
void omit_rounding(ExportComparison& comparison) {
  const double rounding = highest_of(comparison.cuts) - kRounding_db;
  for (const Polarisation element : {Polarisation::kHh, Polarisation::kHv, Polarisation::kVh, Polarisation::kVv}) {
    const auto silent = [&](const PairedCut& cut) {
      return cut.element != element ||
             (std::ranges::max(cut.level_dbsm) < rounding && std::ranges::max(cut.models[0].level_dbsm) < rounding);
    };
    if (!std::ranges::all_of(comparison.cuts, silent)) continue;
    if (std::erase_if(comparison.cuts, [&](const PairedCut& cut) { return cut.element == element; }) > 0)
      comparison.omitted.push_back(fmt::format("{} is not compared: it is {:g} dB or more below the strongest in both",
                                               kPolarisationNames[static_cast<int>(element)], kRounding_db));
  }
}

ElementStatistics statistics_of(const std::vector<PairedCut>& cuts, Polarisation element, double floor_db) {
  constexpr std::size_t kWorst = 5;
  ElementStatistics statistics;
  statistics.element = element;
  const double highest = std::max(highest_of(cuts, element), highest_of(cuts) - kRounding_db);
  const double floor = highest - floor_db;
  DifferenceSum sum;
  std::vector<double> sizes;
  std::vector<ElementStatistics::Worst> all;
  for (const PairedCut& cut : cuts) {
    if (cut.element != element) continue;
    add_extrema(cut, highest, floor, statistics);
    for (std::size_t i = 0; i < cut.places.size(); ++i) {
      const double difference = sum.add(cut.models[0].level_dbsm[i], cut.level_dbsm[i], floor, cut.x[i]);
      sizes.push_back(std::abs(difference));
      all.push_back({difference, cut.places[i], {}});
      if (has_phases(cut)) sum.add_phases(cut.models[0].amplitude_m[i], cut.amplitude_m[i]);
    }
  }
  const Difference difference = sum.difference();
  statistics.pairs = difference.points;
  statistics.bias_db = difference.bias_db;
  statistics.mean_abs_db = difference.mean_db;
  statistics.rms_db = difference.rms_db;
  if (difference.correlation) statistics.correlation = std::abs(*difference.correlation);
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(0.95 * static_cast<double>(sizes.size()))) - 1;
  std::nth_element(sizes.begin(), sizes.begin() + rank, sizes.end());
  statistics.p95_db = sizes[static_cast<std::size_t>(rank)];
  const std::size_t count = std::min(kWorst, all.size());
  std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count), all.end(),
                    [](const auto& a, const auto& b) { return std::abs(a.difference_db) > std::abs(b.difference_db); });
  statistics.worst.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
  return statistics;
}

ExportComparison finished(ExportComparison comparison, const ComparisonSettings& settings, int threads) {
  omit_rounding(comparison);
  if (!settings.as_is) comparison.alignment = align(comparison.cuts, threads);
  for (const Polarisation element : {Polarisation::kHh, Polarisation::kHv, Polarisation::kVh, Polarisation::kVv}) {
    if (std::any_of(comparison.cuts.begin(), comparison.cuts.end(),
                    [&](const PairedCut& cut) { return cut.element == element; }))
      comparison.elements.push_back(statistics_of(comparison.cuts, element, settings.floor_db));
  }
  comparison.warnings = suggestions(comparison.cuts, comparison.alignment, settings.floor_db);
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

}  // namespace

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
                                     const ComparisonSettings& settings, int threads, const StopFlag& stop,
                                     const std::function<void(const std::string&)>& say) {
  ExportComparison comparison{table.name, table.reader, "seaglint", table.notes, {}, {}, {}, {}, {}, {}, {}};
  for (const auto& [key, cuts] : by_transmitter(table)) {
    RcsRequest solved = request;
    solved.transmitter = fixed_transmitter(*cuts.front());
    for (const ViewGrid& grid : grids_of(cuts)) {
      solved.frequency_hz = grid.frequency_hz;
      solved.azimuth_deg = grid.azimuth_deg;
      solved.elevation_deg = grid.elevation_deg;
      RcsSweep sweep = requested_sweep(solved);
      say(fmt::format("{}: frequencies {}, directions {}, {}", table.name, grid.frequency_hz.size(), sweep.views(),
                      solved.transmitter
                          ? fmt::format("transmitter at azimuth {:g} deg, elevation {:g} deg",
                                        solved.transmitter->azimuth_deg, solved.transmitter->elevation_deg)
                          : std::string("monostatic")));
      sweep = compute_rcs(solved, target, threads, &stop).sweep;
      append_cuts(sweep, comparison.solved);
      for (const RcsCut* cut : cuts) pair(sweep, *cut, comparison.cuts);
    }
  }
  comparison = finished(std::move(comparison), settings, threads);
  if (std::any_of(table.cuts.begin(), table.cuts.end(),
                  [](const RcsCut& cut) { return !cut.transmitter->is_monostatic; }))
    return comparison;
  for (ElementStatistics& statistics : comparison.elements) {
    for (ElementStatistics::Worst& worst : statistics.worst)
      worst.main = main_contribution(request, target, worst.place, statistics.element, stop);
  }
  return comparison;
}

ExportComparison compare_with_table(const FieldTable& table, const FieldTable& other,
                                    const ComparisonSettings& settings, int threads) {
  ExportComparison comparison{table.name, table.reader, other.name, table.notes, {}, {}, {}, {}, {}, {}, {}};
  for (const RcsCut& cut : table.cuts) {
    for (const RcsCut& values : other.cuts) {
      if (values.element != cut.element) continue;
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

}  // namespace seaglint
