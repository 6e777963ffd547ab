// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The `dataset`, `features` and `learning` sections of a scenario.

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
  // Names of label 0, 1, ...: kMinClasses to kMaxClasses, different when a space counts as '_'.
  std::vector<std::string> classes = default_classes();
  int maps_per_case = 100;         // per class; a case is (sea state, aspect); 1 <= x <= 1000000
  int realisations_per_case = 10;  // independent seas; 1 <= x <= 100000; times maps_per_interval divides maps_per_case
  int maps_per_interval = 1;       // of one response, each with its own clutter and noise; 1 <= x <= 1000
  double interval_spacing_s = 10;  // between the intervals of one realisation, 0.001 <= x <= 10000
  int maps_per_shard = 20;         // 1 <= x <= 10000
  double train_fraction = 0.7;     // `split: 7:3`, 0 < x < 1
  bool complex_maps = false;       // also store real and imaginary parts
  bool echoes = false;             // also store the target's echoes, of which `seaglint features` makes maps again
};

struct FeatureSpec {
  double dynamic_range_db = 30;     // centres below the strongest one, 1 <= x <= 100
  int max_centres = 64;             // 3 <= x <= 1000
  double clean_gain = 1;            // loop gain of CLEAN, 0.05 <= x <= 1
  double range_scale_m = 40;        // normalisation of sigma_r in CCF, > 0
  double velocity_scale_mps = 0.5;  // normalisation of sigma_v in CCF, > 0
  bool weighted_fit = false;        // weights in the line fit too; the residual is weighted as printed
};

// Values of one column that are tested on and never trained on.
struct HoldOutSpec {
  std::string column;
  std::vector<std::string> values;  // texts, numbers or LOW:HIGH, both included; 1 to 1000
};

// How maps are divided into training and test maps (classify/model/division.h).
struct SplitSpec {
  std::string by = "sea";             // column whose values are on one side each
  std::vector<HoldOutSpec> hold_out;  // at most 100 columns
};

enum class Fusion { kSplit, kInSample };

struct LearningSpec {
  SplitSpec split;
  Fusion fusion = Fusion::kSplit;
  double network_fraction = 0.6;  // of the training groups, for the network, when fusion is split; 0.1 <= x <= 0.9
  int epochs = 60;                // at most, 1 <= x <= 10000
  int patience = 10;              // epochs without a smaller loss of the validation rows, 1 <= x <= 10000
  int batch_size = 32;            // 1 <= x <= 4096
  double learning_rate = 0.002;   // of the network, 1e-6 <= x <= 1
  int embedding_size = 8;         // 1 <= x <= 512
  int threads = 1;                // of each network's training, whose result does not depend on it; 1 <= x <= 256
  double map_floor_db = -40;      // floor of the network's images, relative to the power of all centres, -120 <= x < 0
  int trees = 200;                // XGBoost parameters from here on: table II of the paper
  int max_depth = 6;
  double tree_learning_rate = 0.05;
  double subsample = 0.8;
  double colsample_bytree = 0.8;
  int tree_seed = 42;
  bool refit = false;            // fit the saved model to all rows that are not held out
  int split_repeats = 1;         // independent splits whose test predictions are pooled, 1 <= x <= 100
  int bootstrap_samples = 1000;  // of the grouped confidence intervals, 10 <= x <= 100000
};

}  // namespace seaglint
