// SPDX-License-Identifier: BSD-3-Clause
#include "classify/features/feature_vector.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/core/process/error.h"
#include "sim/core/text/text_table.h"
#include "sim/core/text/words.h"

namespace seaglint {

namespace {

constexpr double kCcfGuard = 1e-6;  // from the paper, avoids 0 / 0

// Least squares v = slope r + offset; centres at one range leave the slope undefined: 0 then.
VelocityLine fit_line(std::span<const ScatteringCentre> centres, const std::vector<double>& weight) {
  double sum = 0, mean_r = 0, mean_v = 0;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    sum += weight[i];
    mean_r += weight[i] * centres[i].range_m;
    mean_v += weight[i] * centres[i].velocity_mps;
  }
  mean_r /= sum;
  mean_v /= sum;
  double rr = 0, rv = 0;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    rr += weight[i] * (centres[i].range_m - mean_r) * (centres[i].range_m - mean_r);
    rv += weight[i] * (centres[i].range_m - mean_r) * (centres[i].velocity_mps - mean_v);
  }
  const double slope = rr > 1e-12 * sum ? rv / rr : 0;  // ranges within a micrometre count as equal
  return {slope, mean_v - slope * mean_r};
}

// Weights proportional to amplitude, with sum N_sc.
std::vector<double> amplitude_weights(std::span<const ScatteringCentre> centres) {
  double total = 0;
  for (const ScatteringCentre& centre : centres) total += centre.amplitude_m;
  const auto count = static_cast<double>(centres.size());
  std::vector<double> weight;
  for (const ScatteringCentre& centre : centres) weight.push_back(total > 0 ? count * centre.amplitude_m / total : 1);
  return weight;
}

}  // namespace

VelocityLine least_squares_line(std::span<const ScatteringCentre> centres, const FeatureSpec& spec) {
  if (centres.empty()) return {};
  return fit_line(centres, spec.weighted_fit ? amplitude_weights(centres) : std::vector<double>(centres.size(), 1.0));
}

FeatureVector compute_features(std::span<const ScatteringCentre> centres, const FeatureSpec& spec) {
  FeatureVector features;
  features.centres = static_cast<int>(centres.size());
  features.degenerate = centres.size() < 3;
  if (centres.empty()) return features;
  const auto count = static_cast<double>(centres.size());

  const std::vector<double> weight = amplitude_weights(centres);
  const VelocityLine line = least_squares_line(centres, spec);
  double mean_r = 0, mean_v = 0;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const double residual = line.residual(centres[i]);
    features.mwr += weight[i] * residual * residual / count;
    mean_r += centres[i].range_m / count;
    mean_v += centres[i].velocity_mps / count;
  }
  double variance_r = 0, variance_v = 0;
  for (const ScatteringCentre& centre : centres) {
    variance_r += (centre.range_m - mean_r) * (centre.range_m - mean_r) / count;
    variance_v += (centre.velocity_mps - mean_v) * (centre.velocity_mps - mean_v) / count;
  }
  features.sigma_r = std::sqrt(variance_r);
  features.sigma_v = std::sqrt(variance_v);
  const double s_r = features.sigma_r / spec.range_scale_m, s_v = features.sigma_v / spec.velocity_scale_mps;
  features.ccf = std::abs((s_r - s_v) / (s_r + s_v + kCcfGuard));
  return features;
}

namespace {

constexpr std::size_t kMostCentres = 64;  // 2,016 pairs
constexpr double kOneRange_m = 1e-6;      // ranges within a micrometre count as equal

struct Weighted {
  double value = 0, weight = 0;
};

// The smallest value up to which the weights reach half of their sum; 0 without values.
double weighted_median(std::vector<Weighted> all) {
  std::sort(all.begin(), all.end(), [](const Weighted& a, const Weighted& b) {
    return std::pair(a.value, a.weight) < std::pair(b.value, b.weight);
  });
  double total = 0, sum = 0;
  for (const Weighted& entry : all) total += entry.weight;
  for (const Weighted& entry : all) {
    sum += entry.weight;
    if (2 * sum >= total) return entry.value;
  }
  return 0;
}

}  // namespace

VelocityLine robust_velocity_line(std::span<const ScatteringCentre> centres) {
  const auto used = centres.first(std::min(centres.size(), kMostCentres));
  std::vector<Weighted> slopes, offsets;
  for (std::size_t i = 0; i < used.size(); ++i) {
    for (std::size_t k = i + 1; k < used.size(); ++k) {
      const double apart_m = used[k].range_m - used[i].range_m;
      if (std::abs(apart_m) < kOneRange_m) continue;
      slopes.push_back({(used[k].velocity_mps - used[i].velocity_mps) / apart_m,
                        used[i].amplitude_m * used[k].amplitude_m * std::abs(apart_m)});
    }
  }
  VelocityLine line;
  line.slope = weighted_median(std::move(slopes));
  for (const ScatteringCentre& centre : used)
    offsets.push_back({centre.velocity_mps - line.slope * centre.range_m, centre.amplitude_m});
  line.offset = weighted_median(std::move(offsets));
  return line;
}

constexpr double kOnLine_mps = 0.01;

MotionFeatures motion_features(std::span<const ScatteringCentre> centres) {
  MotionFeatures features;
  double sum = 0;
  for (const ScatteringCentre& centre : centres) sum += centre.amplitude_m;
  if (!(sum > 0)) return features;

  // The median velocity is the line of centres that are all at one range.
  std::vector<ScatteringCentre> at_one_range(centres.begin(), centres.end());
  for (ScatteringCentre& centre : at_one_range) centre.range_m = 0;
  const VelocityLine line = robust_velocity_line(centres), level = robust_velocity_line(at_one_range);
  double spread = 0;
  for (const ScatteringCentre& centre : centres) {
    const double weight = centre.amplitude_m / sum, residual = std::abs(line.residual(centre));
    features.residual_mps += weight * residual;
    spread += weight * std::abs(centre.velocity_mps - level.offset);
    if (residual <= kOnLine_mps) features.on_line += weight;
  }
  features.rotation_per_s = std::abs(line.slope);
  if (spread > 0) features.explained = std::max(0.0, 1 - features.residual_mps / spread);
  return features;
}

FeatureMatrix select_rows(const FeatureMatrix& matrix, std::span<const std::size_t> rows) {
  FeatureMatrix selected{matrix.names, {}};
  selected.values.reserve(rows.size() * matrix.columns());
  for (const std::size_t row : rows) {
    const auto values = matrix.row(row);
    selected.values.insert(selected.values.end(), values.begin(), values.end());
  }
  return selected;
}

FeatureMatrix join_columns(const FeatureMatrix& left, const FeatureMatrix& right) {
  SEAGLINT_CHECK(left.rows() == right.rows(), fmt::format("{} rows beside {}", left.rows(), right.rows()));
  FeatureMatrix joined{left.names, {}};
  joined.names.insert(joined.names.end(), right.names.begin(), right.names.end());
  joined.values.reserve(left.values.size() + right.values.size());
  for (std::size_t i = 0; i < left.rows(); ++i) {
    joined.values.insert(joined.values.end(), left.row(i).begin(), left.row(i).end());
    joined.values.insert(joined.values.end(), right.row(i).begin(), right.row(i).end());
  }
  return joined;
}

FeatureMatrix read_embeddings(const std::filesystem::path& file, std::span<const std::int64_t> samples) {
  constexpr std::size_t kAbout = 5;  // columns before the features
  const TextSource source = TextSource::read(file);
  std::string_view rest = source.text();
  const TextRow header = next_row(rest, ',');
  if (header.cells.size() < kAbout + 5 || header.cells[0] != "sample")
    source.fail(source.text(), "not a table of embeddings");
  const std::vector<std::string> names(header.cells.begin(), header.cells.end());
  const TextTable table = TextTable::below(source, rest, names, ',');
  if (table.rows() < samples.size()) {
    throw InputError(
        fmt::format("{}: {} rows: must be those of {} samples", file.string(), table.rows(), samples.size()));
  }
  FeatureMatrix matrix{{names.begin() + kAbout, names.end()}, {}};
  for (std::size_t row = 0; row < samples.size(); ++row) {
    if (parse_integer(table.text(row, 0)) != samples[row])
      table.fail(row, 0, fmt::format("must be sample {}", samples[row]));
    for (std::size_t k = kAbout; k < names.size(); ++k)
      matrix.values.push_back(static_cast<float>(
          table.number(row, k, std::numeric_limits<float>::lowest(), std::numeric_limits<float>::max())));
  }
  return matrix;
}

}  // namespace seaglint
