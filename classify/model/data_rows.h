// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Rows of one or more data sets with the values of their columns: what divisions and scores by column read, and the
// ranges of features and conditions over the training maps.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "classify/dataset/format/shard.h"

namespace seaglint {

// The metadata of a map and the data set, numbered from 0 in the order given, that it is from.
struct DataRow {
  std::size_t data_set = 0;
  SampleRecord record;
};

// Appends the rows of a shard.
void append_rows(std::vector<DataRow>& rows, std::size_t data_set, const Shard& shard);

// The values of one column, one per row: numbers, or texts for a column of text.
struct ColumnOfRows {
  std::string name;
  std::string unit;  // "1" if dimensionless, "" for text
  bool is_text = false;
  std::vector<double> numbers;  // NaN where the quantity is undefined, e.g. an SCR without clutter
  std::vector<std::string> texts;
};

// `name`: a column of the samples (sample_columns()), a key that the scenarios draw ("sea.peak_period_s"; undefined or
// "" in rows of a data set that does not), "data_set" for the number of the data set, or "sea" for the
// number of the sea realisation (sea_numbers()). Throws InputError for any other name, with the nearest one.
ColumnOfRows column_of(std::span<const DataRow> rows, const std::string& name);

// Number of each row's sea realisation, ascending in (seed, sea_key): maps of different data sets with the same seed
// and key are in the same sea.
std::vector<std::int64_t> sea_numbers(std::span<const DataRow> rows);

// The values of these numeric columns in one row.
std::vector<float> values_of(const SampleRecord& record, std::span<const std::string> names);

// Rows of a column with one value or, in a continuous column, within one interval.
struct ColumnBin {
  std::string text;   // "0.5", "2 to 4.5", "ring"; "undefined" for NaN
  double lowest = 0;  // of the bin's numbers; NaN for text and for undefined values
  double highest = 0;
  double mean = 0;                // of the bin's numbers; the value itself where there is one
  std::vector<std::size_t> rows;  // ascending
};

// One bin per value, ascending, for text and for at most most_values numbers; else `bins` bins of numbers with equal
// numbers of rows, as far as rows of equal values stay together. Undefined values have a bin of their own, the last.
std::vector<ColumnBin> bins_of(const ColumnOfRows& column, std::size_t most_values, std::size_t bins);

inline constexpr std::size_t kMostBins = 8;         // of a drawn or measured quantity
inline constexpr std::size_t kMostSweptBins = 100;  // of a swept quantity

// A quantity by which tables, curves and scores are divided: a column with its bins.
struct Condition {
  std::string name;
  std::string unit;  // as that of the column
  std::vector<ColumnBin> bins;
};

// A column of these rows. A swept quantity is constant in each case (data set, sea state and view): one bin per value,
// up to kMostSweptBins of them. Any other quantity: as bins_of() with at most kMostBins values or bins. Errors as
// column_of().
Condition condition_of(std::span<const DataRow> rows, const std::string& name);

// The significant wave height, then every key that the scenarios draw, but that of the wave height and seeds; then
// azimuth, elevation and peak period where they are swept.
std::vector<Condition> conditions_of(std::span<const DataRow> rows);

inline constexpr const char* kWaveHeightColumn = "significant_wave_height_m";

// 5, 50 and 95 % quantiles of one class; NaN without a defined value.
using ClassQuantiles = std::array<double, 3>;

// Values of one column over the training maps.
struct ValueRange {
  std::string name;
  std::string unit;
  double lowest = 0;  // NaN when the column is undefined in every training map
  double highest = 0;
  std::vector<ClassQuantiles> by_label;  // of label 0, 1, ...

  bool has_undefined = false;  // some training map has no value

  // True for a value below `lowest` or above `highest` by more than 0.1 % of the larger magnitude of both (a measured
  // ratio of 50.0004 dB is within 50 to 50 dB), for one that is defined where no training map's is, and for an
  // undefined one where all are defined.
  bool excludes(double value) const;
};

// Range of a numeric column over these rows; labels of all rows.
ValueRange range_of(const ColumnOfRows& column, std::span<const std::size_t> rows, std::span<const int> labels,
                    std::size_t classes);

// Columns of a data set that describe the conditions of a map: every real-valued one that is neither a time, a level
// nor among `features`; the number of centres.
std::vector<std::string> condition_names(std::span<const std::string> features);

}  // namespace seaglint
