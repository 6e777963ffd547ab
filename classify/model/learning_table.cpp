// SPDX-License-Identifier: BSD-3-Clause
#include "classify/model/learning_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "classify/dataset/format/sample.h"
#include "classify/features/feature_vector.h"
#include "sim/core/process/error.h"

namespace seaglint {
namespace {

struct Band {
  double power = 0;
  std::size_t cells = 0;
};

int distance_band(double distance_m) {
  return static_cast<int>(std::upper_bound(std::begin(kBlankedDistancesM), std::end(kBlankedDistancesM), distance_m) -
                          std::begin(kBlankedDistancesM));
}

}  // namespace

std::vector<double> blanked_levels_db(const Sample& sample, const StoredAxes& axes) {
  double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
  for (const StoredCentre& centre : sample.centre_list) {
    nearest = std::min(nearest, static_cast<double>(centre[0]) - kBlankedMarginM);
    farthest = std::max(farthest, static_cast<double>(centre[0]) + kBlankedMarginM);
  }
  const std::size_t columns = axes.range_m.size(), rows = axes.velocity_mps.size();
  std::vector<Band> bands(kBlankedDistances * kBlankedVelocities);
  Band all;
  for (std::size_t r = 0; r < columns; ++r) {
    const double outside = std::max(nearest - axes.range_m[r], axes.range_m[r] - farthest);
    if (outside <= 0) continue;
    // Without a centre nothing is blanked and the distance is infinite.
    Band* const column = &bands[static_cast<std::size_t>(distance_band(outside)) * kBlankedVelocities];
    for (std::size_t v = 0; v < rows; ++v) {
      const double power = std::pow(static_cast<double>(sample.magnitude[v * columns + r]), 2);
      for (Band* band : {column + v * kBlankedVelocities / rows, &all}) {
        band->power += power;
        ++band->cells;
      }
    }
  }
  std::vector<double> levels_db(bands.size(), 0.0);
  if (!(all.power > 0)) return levels_db;
  const double mean = all.power / static_cast<double>(all.cells);
  constexpr double kLowest = 1e-10;  // -100 dB
  for (std::size_t i = 0; i < bands.size(); ++i) {
    if (bands[i].cells > 0)
      levels_db[i] = 10 * std::log10(std::max(bands[i].power / static_cast<double>(bands[i].cells) / mean, kLowest));
  }
  return levels_db;
}

namespace {

double decibel(double power) { return 10 * std::log10(std::max(power, 1e-300)); }

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Target over clutter and noise together, dB: 1/R = 1/SCR + 1/SNR, without a term that does not exist; 300 without
// either.
double signal_to_rest_db(const SampleRecord& record) {
  double inverse = 0;
  for (const double ratio_db : {record.scr_per_pulse_db, record.snr_per_pulse_db}) {
    if (!std::isnan(ratio_db)) inverse += std::pow(10, -0.1 * ratio_db);
  }
  return std::clamp(-decibel(inverse), -300.0, 300.0);
}

// Levels of one map that a classifier could use instead of the target's motion.
struct MapLevels {
  double floor_db = 0;         // median cell below the map's energy
  double pedestal_db = 0;      // median over velocity in the strongest cell's range, below that cell
  double above_threshold = 0;  // cells within 20 dB of the strongest
};

MapLevels map_levels(const Sample& sample, const StoredAxes& axes) {
  const std::size_t columns = axes.range_m.size(), rows = axes.velocity_mps.size();
  std::vector<double> power(sample.magnitude.size());
  double total = 0;
  for (std::size_t i = 0; i < power.size(); ++i) {
    power[i] = static_cast<double>(sample.magnitude[i]) * sample.magnitude[i];
    total += power[i];
  }
  const std::size_t peak = static_cast<std::size_t>(std::max_element(power.begin(), power.end()) - power.begin());
  std::vector<double> column(rows);
  for (std::size_t v = 0; v < rows; ++v) column[v] = power[v * columns + peak % columns];
  MapLevels levels;
  levels.above_threshold = static_cast<double>(
      std::count_if(power.begin(), power.end(), [&](double value) { return value >= 0.01 * power[peak]; }));
  levels.pedestal_db = decibel(median(column)) - decibel(power[peak]);
  levels.floor_db = decibel(median(power)) - decibel(total);
  return levels;
}

// How often the hop code uses each carrier, in at most 16 bands.
std::vector<float> carrier_counts(const std::vector<std::uint16_t>& code, std::size_t carriers, std::size_t bands) {
  std::vector<float> counts(bands, 0.0f);
  for (const std::uint16_t carrier : code) counts[std::min<std::size_t>(carrier, carriers - 1) * bands / carriers] += 1;
  return counts;
}

enum ProbeIndex {
  kPower,
  kPeak,
  kRatio,
  kFloor,
  kPedestal,
  kAbove,
  kCentreCount,
  kHopCode,
  kOrder,
  kMwr,
  kCcf,
  kSigmaR,
  kSigmaV,
  kBlanked,
  kProbes
};

std::vector<Probe> empty_probes(std::size_t bands) {
  std::vector<Probe> probes(kProbes);
  probes[kPower] = {"total power", ProbeKind::kScale, "energy of the map, dB", {{"energy_db"}, {}}};
  probes[kPeak] = {"peak", ProbeKind::kScale, "strongest cell, dB", {{"peak_db"}, {}}};
  probes[kRatio] = {"signal to clutter and noise",
                    ProbeKind::kRatio,
                    "target's echo over clutter and noise, mean over pulses and frequencies, dB",
                    {{"ratio_db"}, {}}};
  probes[kFloor] = {"floor", ProbeKind::kShape, "median cell below the map's energy, dB", {{"floor_db"}, {}}};
  probes[kPedestal] = {"pedestal",
                       ProbeKind::kShape,
                       "median over velocity at the strongest cell's range, below that cell, dB",
                       {{"pedestal_db"}, {}}};
  probes[kAbove] = {"cells above threshold", ProbeKind::kShape, "cells within 20 dB of the strongest", {{"cells"}, {}}};
  probes[kCentreCount] = {"number of centres", ProbeKind::kShape, "scattering centres found", {{"centres"}, {}}};
  probes[kHopCode] = {"hop code", ProbeKind::kBlind, "how often each carrier is used", {{}, {}}};
  for (std::size_t band = 0; band < bands; ++band)
    probes[kHopCode].features.names.push_back(fmt::format("carrier_{}", band));
  probes[kOrder] = {
      "sample order", ProbeKind::kBlind, "number of the sample, and whether it is odd", {{"sample", "odd"}, {}}};
  probes[kMwr] = {"MWR alone", ProbeKind::kFeature, "residual of the line", {{"mwr"}, {}}};
  probes[kCcf] = {"CCF alone", ProbeKind::kFeature, "contrast of the spreads", {{"ccf"}, {}}};
  probes[kSigmaR] = {"sigma_r alone",
                     ProbeKind::kFeature,
                     "range spread of the centres found: the target's length and layout, not its motion",
                     {{"sigma_r_m"}, {}}};
  probes[kSigmaV] = {
      "sigma_v alone", ProbeKind::kFeature, "velocity spread of the centres found: motion", {{"sigma_v_mps"}, {}}};
  probes[kBlanked] = {"blanked map",
                      ProbeKind::kShape,
                      "cells more than 6 m outside of the centres' ranges, relative to their mean: what the target "
                      "leaks into the rest of its map",
                      {{}, {}}};
  for (int distance = 0; distance < kBlankedDistances; ++distance) {
    for (int velocity = 0; velocity < kBlankedVelocities; ++velocity)
      probes[kBlanked].features.names.push_back(fmt::format("distance_{}_velocity_{}_db", distance, velocity));
  }
  return probes;
}

}  // namespace

const char* name(ProbeKind kind) {
  switch (kind) {
    case ProbeKind::kBlind: return "blind";
    case ProbeKind::kScale: return "scale";
    case ProbeKind::kRatio: return "ratio";
    case ProbeKind::kShape: return "shape";
    case ProbeKind::kFeature: return "feature";
  }
  return "";
}

CentreList centres_of(const Sample& sample) {
  CentreList centres;
  for (const auto& [range_m, velocity_mps, amplitude_m] : sample.centre_list)
    centres.push_back({range_m, velocity_mps, amplitude_m});
  return centres;
}

FeatureMatrix motion_matrix(std::span<const CentreList> centres) {
  FeatureMatrix matrix{{kMotionFeatureNames.begin(), kMotionFeatureNames.end()}, {}};
  for (const CentreList& of_map : centres) {
    const MotionFeatures motion = motion_features(of_map);
    for (const double feature : {motion.rotation_per_s, motion.residual_mps, motion.explained, motion.on_line})
      matrix.values.push_back(static_cast<float>(feature));
  }
  return matrix;
}

LearningTable load_learning_table(const DatasetReader& data, const StopFlag* stop,
                                  const std::function<void(const Shard&)>& use,
                                  const std::vector<std::string>& classes) {
  LearningTable table;
  table.classes = classes;
  table.handmade.names = {"mwr", "ccf", "sigma_r_m", "sigma_v_mps"};
  std::size_t carriers = 1;
  std::vector<std::vector<std::uint16_t>> codes;
  table.probes = empty_probes(0);

  for (std::size_t i = 0; i < data.shards(); ++i) {
    if (stop && *stop) throw Interrupted();
    const Shard shard = data.shard(i);
    if (use) use(shard);
    for (const Sample& sample : shard.samples) {
      const SampleRecord& record = sample.record;
      std::vector<std::string> faults = sample_faults(sample);
      if (record.label < 0 || record.label >= static_cast<std::int64_t>(classes.size()))
        faults.push_back(classes.size() == 2 ? "label is neither 0 nor 1"
                                             : fmt::format("label is not within 0 and {}", classes.size() - 1));
      if (!faults.empty()) {
        throw InputError(fmt::format("{}: sample {}: {}", (data.directory() / data.manifest().shards[i].file).string(),
                                     record.sample, faults.front()));
      }
      table.groups.push_back({record.group, record.sea_state});
      table.samples.push_back(record.sample);
      table.labels.push_back(static_cast<int>(record.label));
      table.maps.push_back({0, record});
      for (const double feature : {record.mwr, record.ccf, record.sigma_r_m, record.sigma_v_mps})
        table.handmade.values.push_back(static_cast<float>(feature));
      table.degenerate += record.degenerate != 0 ? 1 : 0;
      table.centres.push_back(centres_of(sample));
      const MapLevels levels = map_levels(sample, shard.axes);
      const auto add = [&](ProbeIndex probe, double value) {
        table.probes[probe].features.values.push_back(static_cast<float>(value));
      };
      add(kPower, decibel(record.energy_m2));
      add(kPeak, 2 * decibel(record.peak_m));
      add(kRatio, signal_to_rest_db(record));
      add(kFloor, levels.floor_db);
      add(kPedestal, levels.pedestal_db);
      add(kAbove, levels.above_threshold);
      add(kCentreCount, static_cast<double>(record.centres));
      add(kOrder, static_cast<double>(record.sample));
      add(kOrder, static_cast<double>(record.sample % 2));
      add(kMwr, record.mwr);
      add(kCcf, record.ccf);
      add(kSigmaR, record.sigma_r_m);
      add(kSigmaV, record.sigma_v_mps);
      for (const double level : blanked_levels_db(sample, shard.axes)) add(kBlanked, level);
      codes.push_back(sample.hop_code);
      for (const std::uint16_t carrier : sample.hop_code) carriers = std::max<std::size_t>(carriers, carrier + 1u);
    }
  }

  table.extended = join_columns(table.handmade, motion_matrix(table.centres));
  const std::size_t bands = std::min<std::size_t>(carriers, 16);
  table.probes[kHopCode].features.names = empty_probes(bands)[kHopCode].features.names;
  for (const auto& code : codes) {
    const std::vector<float> counts = carrier_counts(code, carriers, bands);
    auto& values = table.probes[kHopCode].features.values;
    values.insert(values.end(), counts.begin(), counts.end());
  }
  return table;
}

void append(LearningTable& table, LearningTable&& more) {
  const auto move_to = [](auto& values, auto& others) {
    values.insert(values.end(), std::make_move_iterator(others.begin()), std::make_move_iterator(others.end()));
    others = {};
  };
  for (std::size_t i = 0; i < table.probes.size(); ++i) {
    FeatureMatrix &features = table.probes[i].features, &others = more.probes[i].features;
    if (features.names != others.names) {
      throw InputError(fmt::format("data sets of {} and {} bands of carriers: must use equally many carriers",
                                   features.columns(), others.columns()));
    }
    move_to(features.values, others.values);
  }
  move_to(table.groups, more.groups);
  move_to(table.samples, more.samples);
  move_to(table.labels, more.labels);
  const std::size_t data_set = table.maps.empty() ? 0 : table.maps.back().data_set + 1;
  for (DataRow& map : more.maps) map.data_set += data_set;
  move_to(table.maps, more.maps);
  move_to(table.handmade.values, more.handmade.values);
  move_to(table.extended.values, more.extended.values);
  move_to(table.centres, more.centres);
  table.degenerate += more.degenerate;
}

void require_learnable(const LearningTable& table, const std::string& data) {
  std::vector<std::size_t> maps(table.classes.size());
  for (const int label : table.labels) ++maps[static_cast<std::size_t>(label)];
  const auto missing = static_cast<std::size_t>(std::ranges::find(maps, 0u) - maps.begin());
  if (missing < maps.size() && maps.size() == 2) {
    throw InputError(fmt::format("{}: all {} maps carry the label {}; learning needs both classes", data, table.rows(),
                                 1 - missing));
  }
  if (missing < maps.size()) {
    throw InputError(fmt::format("{}: none of {} maps is of class {} ({}); learning needs all {} classes", data,
                                 table.rows(), missing, table.classes[missing], maps.size()));
  }
  for (std::size_t column = 0; column < table.handmade.columns(); ++column) {
    for (std::size_t row = 1; row < table.rows(); ++row)
      if (table.handmade.row(row)[column] != table.handmade.row(0)[column]) return;
  }
  throw InputError(fmt::format("{}: every feature has one value in all {} maps: nothing can be learnt from {}", data,
                               table.rows(), fmt::join(table.handmade.names, ", ")));
}

}  // namespace seaglint
