// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/draws/distribution.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "sim/core/numbers/reproducible_functions.h"
#include "sim/core/process/error.h"
#include "sim/core/text/words.h"
#include "sim/scenario/files/scatter_diagram.h"

namespace seaglint {

namespace {

constexpr std::size_t kMaxChoices = 1000, kMaxWordBytes = 64;
constexpr double kMaxWhole = 2147483647;  // integers fit into int
constexpr double kNormalDeviations = 9;   // beyond those of any draw
constexpr double kLeastFraction = 0.01;   // of a normal distribution between its limits

constexpr std::array<const char*, 5> kNames{"uniform", "loguniform", "normal", "integers", "choice"};
constexpr std::array<const char*, 5> kForms{
    "uniform(a, b) with a < b", "loguniform(a, b) with 0 < a < b",
    "normal(mean, std) or normal(mean, std, low, high) with std > 0, low < high and at least 1 % of it between them",
    "integers(a, b) with whole numbers a < b", "choice(x, y, ...) of 2 to 1000 different values of at most 64 bytes"};

std::vector<std::string> separated(std::string_view text) {
  std::vector<std::string> values;
  std::string value;
  for (const char c : text) {
    if (c != ',' && c != ' ') {
      value += c;
    } else if (!value.empty()) {
      values.push_back(std::move(value));
      value.clear();
    }
  }
  if (!value.empty()) values.push_back(std::move(value));
  return values;
}

bool is_whole(double x) { return x == std::round(x) && std::abs(x) <= kMaxWhole; }

// Fraction of the normal distribution below x, |error| < 1e-15.
double normal_fraction(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

bool is_valid(const Distribution& d) {
  const std::vector<double>& n = d.numbers;
  switch (d.kind) {
    case DistributionKind::kUniform: return n.size() == 2 && n[0] < n[1];
    case DistributionKind::kLogUniform: return n.size() == 2 && 0 < n[0] && n[0] < n[1];
    case DistributionKind::kIntegers: return n.size() == 2 && n[0] < n[1] && is_whole(n[0]) && is_whole(n[1]);
    case DistributionKind::kNormal:
      if (n.size() == 2) return n[1] > 0;
      return n.size() == 4 && n[1] > 0 && n[2] < n[3] &&
             normal_fraction((n[3] - n[0]) / n[1]) - normal_fraction((n[2] - n[0]) / n[1]) >= kLeastFraction;
    case DistributionKind::kChoice:
      return d.values.size() >= 2 && d.values.size() <= kMaxChoices &&
             std::set<std::string>(d.values.begin(), d.values.end()).size() == d.values.size() &&
             std::all_of(d.values.begin(), d.values.end(),
                         [](const std::string& value) { return value.size() <= kMaxWordBytes; });
    case DistributionKind::kScatter: break;
  }
  return false;
}

// Of the uniform number u within 0 and 1, in the logarithm; by functions with the same bits on every machine.
double between_logarithmically(double low, double high, double u) {
  return std::clamp(low * reproducible_exp(u * reproducible_log(high / low)), low, high);
}

std::string of_pair(const SeaPair& pair, bool is_period) {
  return fmt::format("{}", is_period ? pair.period_s : pair.significant_wave_height_m);
}

}  // namespace

std::string Distribution::text() const {
  if (kind == DistributionKind::kScatter) return kScatterKey;
  return fmt::format("{}({})", kNames[static_cast<std::size_t>(kind)], fmt::join(values, ", "));
}

bool Distribution::is_numeric() const {
  return std::all_of(values.begin(), values.end(), [](const std::string& value) { return parse_number(value); });
}

std::string Distribution::draw(Random& random) const {
  switch (kind) {
    case DistributionKind::kUniform:
      return fmt::format("{}", numbers[0] + (numbers[1] - numbers[0]) * random.uniform());
    case DistributionKind::kLogUniform:
      return fmt::format("{}", between_logarithmically(numbers[0], numbers[1], random.uniform()));
    case DistributionKind::kIntegers: {
      const auto count = static_cast<std::uint32_t>(numbers[1] - numbers[0]) + 1;
      return fmt::format("{}", static_cast<std::int64_t>(numbers[0]) + random.below(count));
    }
    case DistributionKind::kNormal: {
      double value = 0;
      do {
        value = numbers[0] + numbers[1] * random.normal();
      } while (numbers.size() == 4 && (value < numbers[2] || value > numbers[3]));
      return fmt::format("{}", value);
    }
    case DistributionKind::kScatter: return of_pair(diagram->draw(random), is_period);
    case DistributionKind::kChoice: break;
  }
  return values[random.below(static_cast<std::uint32_t>(values.size()))];
}

std::string Distribution::middle() const {
  switch (kind) {
    case DistributionKind::kUniform: return fmt::format("{}", 0.5 * numbers[0] + 0.5 * numbers[1]);
    case DistributionKind::kLogUniform: return fmt::format("{}", between_logarithmically(numbers[0], numbers[1], 0.5));
    case DistributionKind::kIntegers: return fmt::format("{}", std::floor(0.5 * (numbers[0] + numbers[1])));
    case DistributionKind::kNormal:
      return fmt::format("{}", numbers.size() == 4 ? std::clamp(numbers[0], numbers[2], numbers[3]) : numbers[0]);
    case DistributionKind::kScatter: return of_pair(diagram->likeliest(), is_period);
    case DistributionKind::kChoice: break;
  }
  return values.front();
}

std::vector<std::string> Distribution::ends() const {
  if (kind == DistributionKind::kChoice) return values;
  if (kind == DistributionKind::kScatter) {
    double lowest = std::numeric_limits<double>::infinity(), highest = 0;
    for (const ScatterCell& cell : diagram->cells) {
      lowest = std::min(lowest, is_period ? cell.lowest_period_s : cell.lowest_height_m);
      highest = std::max(highest, is_period ? cell.highest_period_s : cell.highest_height_m);
    }
    return {fmt::format("{}", lowest), fmt::format("{}", highest)};
  }
  if (kind != DistributionKind::kNormal) return {values[0], values[1]};
  if (numbers.size() == 4) return {values[2], values[3]};
  return {fmt::format("{}", numbers[0] - kNormalDeviations * numbers[1]),
          fmt::format("{}", numbers[0] + kNormalDeviations * numbers[1])};
}

std::optional<Distribution> parse_distribution(std::string_view text) {
  const std::size_t open = text.find('(');
  if (open == std::string_view::npos) return std::nullopt;
  const auto name = std::find(kNames.begin(), kNames.end(), text.substr(0, open));
  if (name == kNames.end()) return std::nullopt;
  const auto kind = static_cast<std::size_t>(name - kNames.begin());
  if (text.back() != ')') {
    throw InputError(fmt::format("must be {}, in quotes or with blanks for commas within braces", kForms[kind]));
  }
  Distribution read;
  read.kind = static_cast<DistributionKind>(kind);
  read.values = separated(text.substr(open + 1, text.size() - open - 2));
  bool numbers = true;
  if (read.kind != DistributionKind::kChoice) {
    for (const std::string& value : read.values) {
      const std::optional<double> number = parse_number(value);
      numbers = numbers && number;
      read.numbers.push_back(number.value_or(0));
    }
  }
  if (!numbers || !is_valid(read)) throw InputError(fmt::format("must be {}", kForms[kind]));
  return read;
}

}  // namespace seaglint
