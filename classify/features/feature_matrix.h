// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Features of many maps, the input of the classifiers.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace seaglint {

// Rows of features, row-major; all values finite.
struct FeatureMatrix {
  std::vector<std::string> names;  // one per column
  std::vector<float> values;

  std::size_t columns() const { return names.size(); }
  std::size_t rows() const { return names.empty() ? 0 : values.size() / names.size(); }
  std::span<const float> row(std::size_t i) const { return {values.data() + i * columns(), columns()}; }
};

// The given rows, in the given order.
FeatureMatrix select_rows(const FeatureMatrix& matrix, std::span<const std::size_t> rows);
// Concatenates the columns of both (equal numbers of rows).
FeatureMatrix join_columns(const FeatureMatrix& left, const FeatureMatrix& right);

// Reads the feature columns of embeddings.csv: hand-made features, then embedding and logit of the network. Throws
// InputError naming file and line if it is not a table of these samples.
FeatureMatrix read_embeddings(const std::filesystem::path& file, std::span<const std::int64_t> samples);

}  // namespace seaglint
