// SPDX-License-Identifier: BSD-3-Clause
#include "classify/model/scores.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/numbers/real_functions.h"

namespace seaglint {

namespace {

// Mann and Whitney's statistic over n0 n1, from mid-ranks; of values with label 0 or 1.
double area_under_roc(std::vector<std::pair<double, int>> sorted) {
  std::sort(sorted.begin(), sorted.end());
  double rank_sum = 0;
  std::size_t ships = 0;
  for (std::size_t begin = 0; begin < sorted.size();) {
    std::size_t end = begin;
    while (end < sorted.size() && sorted[end].first == sorted[begin].first) ++end;
    const double mid_rank = 0.5 * static_cast<double>(begin + end + 1);
    for (std::size_t i = begin; i < end; ++i) {
      if (sorted[i].second == 1) {
        rank_sum += mid_rank;
        ++ships;
      }
    }
    begin = end;
  }
  const double n1 = static_cast<double>(ships), n0 = static_cast<double>(sorted.size() - ships);
  if (n0 == 0 || n1 == 0) return kNan;
  return (rank_sum - 0.5 * n1 * (n1 + 1)) / (n0 * n1);
}

// Of the rows with label a or b, the mean of the areas over the probability of either.
double pair_area(std::span<const Prediction> predictions, int a, int b) {
  std::vector<std::pair<double, int>> of_a, of_b;
  for (const Prediction& p : predictions) {
    if (p.label != a && p.label != b) continue;
    of_a.emplace_back(p.of(a), p.label == a ? 1 : 0);
    of_b.emplace_back(p.of(b), p.label == b ? 1 : 0);
  }
  return (area_under_roc(std::move(of_a)) + area_under_roc(std::move(of_b))) / 2;
}

double area_under_roc(std::span<const Prediction> predictions, std::size_t classes) {
  if (classes == 2) {
    std::vector<std::pair<double, int>> values;
    for (const Prediction& p : predictions) values.emplace_back(p.probability, p.label);
    return area_under_roc(std::move(values));
  }
  double sum = 0;
  int pairs = 0;
  for (int b = 1; b < static_cast<int>(classes); ++b) {
    for (int a = 0; a < b; ++a) {
      const double area = pair_area(predictions, a, b);
      if (std::isnan(area)) continue;
      sum += area;
      ++pairs;
    }
  }
  return pairs == 0 ? kNan : sum / pairs;
}

// 2.5 and 97.5 % points of the accuracy when groups are drawn with replacement.
ConfidenceInterval bootstrap_accuracy(std::span<const Prediction> predictions, int samples, const RandomKey& key) {
  struct Tally {
    double right = 0;
    double rows = 0;
  };
  std::map<std::int64_t, Tally> by_group;
  for (const Prediction& p : predictions) {
    Tally& tally = by_group[p.group];
    tally.right += p.decision() == p.label ? 1 : 0;
    tally.rows += 1;
  }
  if (by_group.size() < 2) return {kNan, kNan};
  std::vector<Tally> groups;
  for (const auto& entry : by_group) groups.push_back(entry.second);
  Random random(key);
  std::vector<double> accuracies;
  for (int i = 0; i < samples; ++i) {
    Tally sum;
    for (std::size_t draw = 0; draw < groups.size(); ++draw) {
      const Tally& tally = groups[random.below(static_cast<std::uint32_t>(groups.size()))];
      sum.right += tally.right;
      sum.rows += tally.rows;
    }
    accuracies.push_back(sum.right / sum.rows);
  }
  std::sort(accuracies.begin(), accuracies.end());
  return {quantile(accuracies, 0.025), quantile(accuracies, 0.975)};
}

}  // namespace

int decision_of(std::span<const double> outputs) {
  if (outputs.size() == 1) return outputs[0] >= 0.5 ? 1 : 0;
  return static_cast<int>(std::max_element(outputs.begin(), outputs.end()) - outputs.begin());
}

int Prediction::decision() const {
  return decision_of(by_class.empty() ? std::span<const double>(&probability, 1) : std::span<const double>(by_class));
}

double Prediction::of(int which) const {
  if (by_class.empty()) return which == 1 ? probability : 1 - probability;
  return by_class[static_cast<std::size_t>(which)];
}

Prediction prediction_of(std::size_t row, std::int64_t group, int label, std::span<const double> outputs) {
  Prediction prediction{row, group, label, outputs[outputs.size() == 1 ? 0 : 1]};
  if (outputs.size() > 1) prediction.by_class.assign(outputs.begin(), outputs.end());
  return prediction;
}

std::vector<std::vector<RocPoint>> roc_curves(std::span<const Prediction> predictions) {
  const std::size_t classes = predictions.empty() ? 2 : predictions.front().classes();
  if (classes == 2) return {roc_curve(predictions)};
  std::vector<std::vector<RocPoint>> curves;
  for (int label = 0; label < static_cast<int>(classes); ++label) {
    std::vector<Prediction> against_rest;
    for (const Prediction& p : predictions)
      against_rest.push_back({p.row, p.group, p.label == label ? 1 : 0, p.of(label)});
    curves.push_back(roc_curve(against_rest));
  }
  return curves;
}

std::vector<RocPoint> roc_curve(std::span<const Prediction> predictions, std::size_t most) {
  std::vector<std::pair<double, int>> sorted;
  for (const Prediction& p : predictions) sorted.emplace_back(p.probability, p.label);
  std::sort(sorted.rbegin(), sorted.rend());
  std::array<std::int64_t, 2> total{}, above{};
  for (const auto& [probability, label] : sorted) ++total[label == 1 ? 1 : 0];
  if (total[0] == 0 || total[1] == 0) return {};
  std::vector<std::array<std::int64_t, 2>> corners{{0, 0}};  // declared label 1, of label 0 and 1
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    ++above[sorted[i].second == 1 ? 1 : 0];
    if (i + 1 < sorted.size() && sorted[i + 1].first == sorted[i].first) continue;
    if (corners.size() > 1) {
      const auto &a = corners[corners.size() - 2], &b = corners.back();
      if ((b[0] - a[0]) * (above[1] - b[1]) == (b[1] - a[1]) * (above[0] - b[0])) corners.pop_back();
    }
    corners.push_back(above);
  }
  std::vector<RocPoint> curve;
  for (const auto& c : corners)
    curve.push_back({static_cast<double>(c[0]) / static_cast<double>(total[0]),
                     static_cast<double>(c[1]) / static_cast<double>(total[1])});
  if (curve.size() <= most) return curve;
  const auto along = [](const RocPoint& p) { return p.false_alarms + p.detections; };
  const double step = 2 / static_cast<double>(most - 1);
  std::vector<RocPoint> kept{curve.front()};
  for (std::size_t i = 1; i + 1 < curve.size(); ++i)
    if (along(curve[i + 1]) > along(kept.back()) + step) kept.push_back(curve[i]);
  kept.push_back(curve.back());
  return kept;
}

Scores score(std::span<const Prediction> predictions, int bootstrap_samples, std::uint64_t seed,
             std::uint64_t bootstrap_index) {
  Scores scores;
  scores.rows = predictions.size();
  const std::size_t classes = predictions.empty() ? 2 : predictions.front().classes();
  scores.confusion.assign(classes, std::vector<std::size_t>(classes));
  std::map<std::int64_t, int> groups;
  double log_loss = 0;
  for (const Prediction& p : predictions) {
    groups[p.group] = 1;
    ++scores.confusion[static_cast<std::size_t>(p.label)][static_cast<std::size_t>(p.decision())];
    log_loss -= std::log(std::clamp(p.of(p.label), 1e-7, 1.0));
  }
  scores.groups = groups.size();
  const double n = static_cast<double>(scores.rows);
  std::size_t right = 0;
  for (std::size_t label = 0; label < classes; ++label) right += scores.confusion[label][label];
  scores.accuracy = scores.rows == 0 ? kNan : static_cast<double>(right) / n;
  scores.log_loss = scores.rows == 0 ? kNan : log_loss / n;
  scores.auc = area_under_roc(predictions, classes);
  scores.accuracy_95 = bootstrap_accuracy(predictions, bootstrap_samples, {seed, Stream::kBootstrap, bootstrap_index});
  return scores;
}

Calibration calibration(std::span<const Prediction> predictions) {
  constexpr std::size_t kBins = 10;
  Calibration result;
  for (std::size_t i = 0; i < kBins; ++i) result.bins.push_back({static_cast<double>(i) / kBins, 0, 0, 0});
  for (const Prediction& p : predictions) {
    const int stated = p.by_class.empty() ? 1 : p.decision();
    const auto place = static_cast<std::size_t>(std::clamp(p.of(stated), 0.0, 1.0) * kBins);
    CalibrationBin& bin = result.bins[std::min(place, kBins - 1)];
    ++bin.rows;
    bin.mean_probability += p.of(stated);
    bin.fraction += p.label == stated ? 1 : 0;
  }
  double sum = 0;
  for (CalibrationBin& bin : result.bins) {
    sum += std::abs(bin.mean_probability - bin.fraction);
    const double rows = static_cast<double>(bin.rows);
    bin.mean_probability = bin.rows == 0 ? kNan : bin.mean_probability / rows;
    bin.fraction = bin.rows == 0 ? kNan : bin.fraction / rows;
  }
  result.expected_error = predictions.empty() ? kNan : sum / static_cast<double>(predictions.size());
  return result;
}

ConditionScores score_by(const Condition& condition, std::span<const Prediction> predictions, int bootstrap_samples,
                         std::uint64_t seed, std::uint64_t bootstrap_index) {
  std::unordered_map<std::size_t, std::size_t> bin_of;  // by row
  for (std::size_t i = 0; i < condition.bins.size(); ++i)
    for (const std::size_t row : condition.bins[i].rows) bin_of[row] = i;
  std::vector<std::vector<Prediction>> of_bin(condition.bins.size());
  for (const Prediction& prediction : predictions) of_bin[bin_of.at(prediction.row)].push_back(prediction);
  ConditionScores result{condition.name, condition.unit, {}};
  for (std::size_t i = 0; i < of_bin.size(); ++i) {
    if (of_bin[i].empty()) continue;
    const ColumnBin& bin = condition.bins[i];
    result.bins.push_back({bin.text, bin.lowest, bin.highest, bin.mean,
                           score(of_bin[i], bootstrap_samples, seed, bootstrap_index + result.bins.size()),
                           roc_curves(of_bin[i])});
  }
  return result;
}

}  // namespace seaglint
