// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/regenerate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "classify/dataset/format/drawn_columns.h"
#include "seaglint_version.h"

namespace seaglint {

namespace {

// Tolerance for another kind of processor, which may round transforms differently: fraction of the map's peak and of a
// measured column.
constexpr double kOtherProcessor = 1e-5;

bool agree(double a, double b, double tolerance) {
  return a == b || (std::isnan(a) && std::isnan(b)) ||
         std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b));
}

// Columns of a regenerated row that differ from the stored ones.
std::string different_columns(const SampleRecord& stored, const SampleRecord& again, double tolerance) {
  std::string names;
  for (const SampleColumn& column : sample_columns()) {
    const bool same = std::visit(
        [&](auto member) {
          const auto &a = stored.*member, &b = again.*member;
          if constexpr (std::is_same_v<std::decay_t<decltype(a)>, double>) {
            return agree(a, b, tolerance);
          } else {
            return a == b;
          }
        },
        column.member);
    if (!same) names += (names.empty() ? "" : ", ") + std::string(column.name);
  }
  if (!same_drawn(stored, again)) names += (names.empty() ? "" : ", ") + std::string("drawn values");
  return names;
}

// Largest difference of two maps; infinite when their sizes differ or one contains NaN.
double largest_difference(const std::vector<float>& a, const std::vector<float>& b) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  if (a.size() != b.size()) return kInfinite;
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = std::abs(static_cast<double>(a[i]) - b[i]);
    if (std::isnan(difference)) return kInfinite;
    largest = std::max(largest, difference);
  }
  return largest;
}

}  // namespace

StoredSample stored_sample(const DatasetReader& reader, std::size_t number) {
  const std::vector<ManifestShard>& shards = reader.manifest().shards;
  const auto after = std::find_if(shards.begin(), shards.end(),
                                  [&](const ManifestShard& s) { return number < s.first_sample + s.samples; });
  Shard shard = reader.shard(static_cast<std::size_t>(after - shards.begin()));
  return {std::move(shard.samples[number - after->first_sample]), std::move(shard.axes), std::move(shard.origin)};
}

double reproduction_tolerance(const Provenance& origin) {
  return origin == Provenance{kVersion, processor_kind()} ? 0 : kOtherProcessor;
}

std::vector<std::string> differences(const Sample& stored, const Sample& again, double tolerance) {
  std::vector<std::string> found;
  const auto compare = [&](const char* name, const std::vector<float>& a, const std::vector<float>& b) {
    const double largest = largest_difference(a, b);
    if (!(largest <= tolerance * stored.record.peak_m))
      found.push_back(fmt::format("its {} differs by up to {:.3g} of its peak", name, largest / stored.record.peak_m));
  };
  compare("map", stored.magnitude, again.magnitude);
  if (!stored.complex_values.empty() && !again.complex_values.empty())
    compare("complex map", stored.complex_values, again.complex_values);
  if (!stored.echo.empty() && !again.echo.empty() && tolerance == 0 && stored.echo != again.echo)
    found.emplace_back("its echo differs");
  if (stored.hop_code != again.hop_code) found.emplace_back("its hop code differs");
  if (const std::string columns = different_columns(stored.record, again.record, tolerance); !columns.empty())
    found.push_back("other " + columns);
  return found;
}

}  // namespace seaglint
