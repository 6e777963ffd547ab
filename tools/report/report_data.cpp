// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/report_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/scenario/sample_plan.h"
#include "tools/pipeline/train.h"

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

// The samples the report shows, by their numbers: both classes at two aspects.
std::vector<std::size_t> shown_samples(const Scenario& scenario, const SamplePlan& plan) {
  const std::vector<SeaState> states = sea_states(scenario.sea);
  const std::vector<View> aspects = views(scenario.view);
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
    for (const int label : {1, 0}) {
      const auto target = std::find_if(scenario.targets.begin(), scenario.targets.end(),
                                       [&](const TargetSpec& t) { return t.label == label; });
      if (target == scenario.targets.end()) continue;
      address.view = view;
      address.target = static_cast<int>(target - scenario.targets.begin());
      samples.push_back(plan.sample(address));
    }
  }
  return samples;
}

// embeddings.csv: five columns about the sample, four hand-made features, then the network's.
FeatureMatrix read_embeddings(const fs::path& file, const std::vector<ReportRow>& rows) {
  std::istringstream text(read_file(file));
  const auto fail = [&](std::size_t line, const std::string& why) {
    throw InputError(fmt::format("{}:{}: {}", file.string(), line, why));
  };
  const auto fields = [](const std::string& line) {
    std::vector<std::string> values;
    std::istringstream stream(line);
    for (std::string value; std::getline(stream, value, ',');) values.push_back(value);
    return values;
  };
  constexpr std::size_t kAbout = 5;
  std::string line;
  std::getline(text, line);
  const std::vector<std::string> names = fields(line);
  if (names.size() < kAbout + 5 || names[0] != "sample") fail(1, "not a table of embeddings");
  FeatureMatrix matrix{{names.begin() + kAbout, names.end()}, {}};
  for (std::size_t row = 0; row < rows.size(); ++row) {
    std::getline(text, line);
    const std::vector<std::string> values = fields(line);
    if (values.size() != names.size() || values[0] != std::to_string(rows[row].record.sample)) {
      fail(row + 2, fmt::format("expected {} values of sample {}", names.size(), rows[row].record.sample));
    }
    for (std::size_t k = kAbout; k < values.size(); ++k) {
      char* end = nullptr;
      matrix.values.push_back(std::strtof(values[k].c_str(), &end));
      if (end == values[k].c_str() || !std::isfinite(matrix.values.back()))
        fail(row + 2, fmt::format("\"{}\" is not a number", values[k]));
    }
  }
  return matrix;
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
  // A line through n loose points explains 1 / (n - 1) of their variance; the adjusted share (Ezekiel 1930) does not.
  const bool defined = centres.size() >= 3 && rr > 0 && vv > 0;
  fit.explained =
      defined ? 1 - (1 - rv * rv / (rr * vv)) * (n - 1) / (n - 2) : std::numeric_limits<double>::quiet_NaN();
  return fit;
}

ReportData load_report_data(const fs::path& directory, const Scenario& scenario, const StopFlag* stop) {
  const DatasetReader reader(directory / "data");
  const SamplePlan plan(scenario);
  if (reader.size() != plan.size()) {
    throw InputError(fmt::format("{}: {} maps, but scenario.yaml makes {}", (directory / "data").string(),
                                 reader.size(), plan.size()));
  }
  const std::vector<std::size_t> wanted = shown_samples(scenario, plan);
  ReportData data;
  data.shown.resize(wanted.size());
  data.handmade.names = {"mwr", "ccf", "sigma_r_m", "sigma_v_mps"};
  for (std::size_t i = 0; i < reader.shards(); ++i) {
    if (stop && *stop) throw Interrupted();
    Shard shard = reader.shard(i);
    for (Sample& sample : shard.samples) {
      const SampleRecord& record = sample.record;
      data.rows.push_back({record, fit_line(sample.centre_list)});
      for (const double value : {record.mwr, record.ccf, record.sigma_r_m, record.sigma_v_mps}) {
        data.handmade.values.push_back(static_cast<float>(value));
      }
      const auto place = std::find(wanted.begin(), wanted.end(), static_cast<std::size_t>(record.sample));
      if (place != wanted.end()) {
        data.shown_wave_height_m = record.significant_wave_height_m;
        data.shown[static_cast<std::size_t>(place - wanted.begin())] = {std::move(sample), shard.axes};
      }
    }
  }
  data.fused = read_embeddings(directory / "model" / kEmbeddingsFile, data.rows);
  return data;
}

}  // namespace seaglint
