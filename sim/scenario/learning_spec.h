// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The `dataset`, `features`, `learning` and `report` sections of a scenario.

#include <string>
#include <vector>

namespace seaglint {

inline constexpr int kMinClasses = 2, kMaxClasses = 10;
// The class names of a scenario that gives none, by label.
inline const std::vector<std::string>& default_classes() {
  static const std::vector<std::string> names{"array", "ship"};
  return names;
}

struct DatasetSpec {
  std::vector<std::string> classes = default_classes();
  int maps_per_case = 100;
  int realisations_per_case = 10;
  int maps_per_interval = 1;
  double interval_spacing_s = 10;
  int maps_per_shard = 20;
  double train_fraction = 0.7;
  bool complex_maps = false;
  bool echoes = false;

  bool operator==(const DatasetSpec&) const = default;
};

struct FeatureSpec {
  double dynamic_range_db = 30;
  int max_centres = 64;
  double clean_gain = 1;
  double range_scale_m = 40;
  double velocity_scale_mps = 0.5;
  bool weighted_fit = false;

  bool operator==(const FeatureSpec&) const = default;
};

// Values of one column that are tested on and never trained on.
struct HoldOutSpec {
  std::string column;
  std::vector<std::string> values;  // texts, numbers or LOW:HIGH, both included; 1 to 1000

  bool operator==(const HoldOutSpec&) const = default;
};

// How maps are divided into training and test maps (classify/model/division.h).
struct SplitSpec {
  std::string by = "sea";             // column whose values are on one side each
  std::vector<HoldOutSpec> hold_out;  // at most 100 columns

  bool operator==(const SplitSpec&) const = default;
};

enum class Fusion { kSplit, kInSample };

struct LearningSpec {
  SplitSpec split;
  Fusion fusion = Fusion::kSplit;
  double network_fraction = 0.6;
  int epochs = 60;
  int patience = 10;
  int batch_size = 32;
  double learning_rate = 0.002;
  int embedding_size = 8;
  int threads = 1;
  double map_floor_db = -40;
  int trees = 200;
  int max_depth = 6;
  double tree_learning_rate = 0.05;
  double subsample = 0.8;
  double colsample_bytree = 0.8;
  int tree_seed = 42;
  bool refit = false;
  int split_repeats = 1;
  int bootstrap_samples = 1000;

  bool operator==(const LearningSpec&) const = default;
};

// kPaper: the report also judges the claims of the paper whose pipeline this is.
enum class ReportClaims { kNone, kPaper };

struct ReportSpec {
  ReportClaims claims = ReportClaims::kNone;

  bool operator==(const ReportSpec&) const = default;
};

}  // namespace seaglint
