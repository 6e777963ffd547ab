// SPDX-License-Identifier: BSD-3-Clause
#include "classify/features/feature_matrix.h"

#include <fmt/format.h>

#include <limits>
#include <string_view>

#include "sim/core/process/error.h"
#include "sim/core/text/text_table.h"
#include "sim/core/text/words.h"

namespace seaglint {

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
