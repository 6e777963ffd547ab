// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/report_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "tools/pipeline/train.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

template <class Distance>
int nearest(std::size_t count, Distance distance) {
  int best = 0;
  for (std::size_t i = 1; i < count; ++i) {
    if (distance(i) < distance(static_cast<std::size_t>(best))) best = static_cast<int>(i);
  }
  return best;
}

// Numbers of the samples that the report shows: every class at two aspects.
std::vector<std::size_t> shown_samples(const Scenario& scenario, const SamplePlan& plan) {
  const std::vector<SeaState>& states = plan.sea_states();
  const std::vector<View>& aspects = plan.views();
  SampleAddress address;
  address.sea_state =
      nearest(states.size(), [&](std::size_t i) { return std::abs(states[i].significant_wave_height_m - 1); });
  std::vector<int> chosen;
  for (const double azimuth_deg : {80.0, 170.0}) {
    chosen.push_back(nearest(aspects.size(), [&](std::size_t i) {
      return std::abs(std::remainder(aspects[i].azimuth_rad - radians(azimuth_deg), 2 * kPi));
    }));
  }
  if (chosen[0] == chosen[1]) chosen.pop_back();
  std::vector<std::size_t> samples;
  for (const int view : chosen) {
    for (int label = static_cast<int>(scenario.dataset.classes.size()) - 1; label >= 0; --label) {
      const auto target = std::ranges::find(plan.classes(), label,
                                            [&](int t) { return scenario.targets[static_cast<std::size_t>(t)].label; });
      if (target == plan.classes().end()) continue;
      address.view = view;
      address.target = *target;
      samples.push_back(plan.sample(address));
    }
  }
  return samples;
}

}  // namespace

LineFit fit_line(const std::vector<StoredCentre>& centres) {
  LineFit fit;
  const double n = static_cast<double>(centres.size());
  double r = 0, v = 0;
  for (const StoredCentre& c : centres) {
    r += c[0] / n;
    v += c[1] / n;
  }
  double rr = 0, rv = 0, vv = 0;
  for (const StoredCentre& c : centres) {
    rr += (c[0] - r) * (c[0] - r);
    rv += (c[0] - r) * (c[1] - v);
    vv += (c[1] - v) * (c[1] - v);
  }
  fit.slope = rr > 0 ? rv / rr : 0;
  fit.intercept = v - fit.slope * r;
  // A line through n uncorrelated points explains 1 / (n - 1) of their variance; the adjusted R^2 (Ezekiel 1930)
  // corrects for it.
  const bool defined = centres.size() >= 3 && rr > 0 && vv > 0;
  fit.explained =
      defined ? 1 - (1 - rv * rv / (rr * vv)) * (n - 1) / (n - 2) : std::numeric_limits<double>::quiet_NaN();
  return fit;
}

ReportCollector::ReportCollector(const Scenario& scenario, const SamplePlan& plan)
    : wanted_(shown_samples(scenario, plan)) {
  data_.shown.resize(wanted_.size());
  data_.classes = static_cast<int>(scenario.dataset.classes.size());
  const std::size_t states = plan.classes().size() * plan.views().size() * plan.sea_states().size();
  of_each_state_ = std::max<std::size_t>(1, (kMostMaps + states - 1) / states);
  data_.handmade.names = {"mwr", "ccf", "sigma_r_m", "sigma_v_mps"};
}

void ReportCollector::add(const Shard& shard) {
  data_.axes = shard.axes;
  for (const Sample& sample : shard.samples) {
    const SampleRecord& record = sample.record;
    data_.rows.push_back({record, fit_line(sample.centre_list)});
    if (seen_[{record.target, record.view, record.sea_state}]++ < of_each_state_)
      data_.maps.push_back(explorer_map(sample, shard.axes));
    for (const double value : {record.mwr, record.ccf, record.sigma_r_m, record.sigma_v_mps}) {
      data_.handmade.values.push_back(static_cast<float>(value));
    }
    const auto place = std::find(wanted_.begin(), wanted_.end(), static_cast<std::size_t>(record.sample));
    if (place != wanted_.end()) {
      data_.shown_wave_height_m = record.significant_wave_height_m;
      data_.shown[static_cast<std::size_t>(place - wanted_.begin())] = {sample, shard.axes};
    }
  }
}

ReportData ReportCollector::with_embeddings(const FeatureMatrix& embeddings) const {
  return with_fused(join_columns(data_.handmade, embeddings));
}

ReportData ReportCollector::with_fused(FeatureMatrix fused) const {
  ReportData data = data_;
  data.fused = std::move(fused);
  return data;
}

std::vector<std::int64_t> ReportCollector::samples() const {
  std::vector<std::int64_t> samples;
  for (const ReportRow& row : data_.rows) samples.push_back(row.record.sample);
  return samples;
}

ReportData load_report_data(const fs::path& directory, const Scenario& scenario, const SamplePlan& plan,
                            const StopFlag* stop) {
  const DatasetReader reader(directory / "data");
  warn(data_set_warnings(reader));
  if (reader.size() != plan.size()) {
    throw InputError(fmt::format("{}: {} maps, but scenario.yaml makes {}", (directory / "data").string(),
                                 reader.size(), plan.size()));
  }
  ReportCollector collector(scenario, plan);
  for (std::size_t i = 0; i < reader.shards(); ++i) {
    if (stop && *stop) throw Interrupted();
    collector.add(reader.shard(i));
  }
  return collector.with_fused(read_embeddings(directory / "model" / kEmbeddingsFile, collector.samples()));
}

}  // namespace seaglint
