// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/text/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"

namespace seaglint {

namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";

}  // namespace

bool remove_byte_order_mark(std::string& bytes) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  if (!bytes.starts_with(kMark)) return false;
  bytes.erase(0, kMark.size());
  return true;
}

std::string plain_lines(std::string bytes) {
  remove_byte_order_mark(bytes);
  if (bytes.find('\n') == std::string::npos) std::replace(bytes.begin(), bytes.end(), '\r', '\n');
  return bytes;
}

std::string_view next_word(std::string_view& text) {
  const std::size_t begin = std::min(text.find_first_not_of(kBlanks), text.size());
  const std::size_t end = std::min(text.find_first_of(kBlanks, begin), text.size());
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::string_view word = next_word(text); !word.empty(); word = next_word(text)) words.push_back(word);
  return words;
}

std::string_view next_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::string_view trimmed(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  std::size_t begin = 0, end = text.size();
  while (begin < end && is_blank(text[begin])) ++begin;
  while (end > begin && is_blank(text[end - 1])) --end;
  if (begin == end) return text.substr(0, 0);
  return text.substr(begin, end - begin);
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return lower;
}

namespace {

// The whole text as one number. A plus sign is allowed before digits, not before another sign.
template <typename Number>
std::optional<Number> whole(std::string_view text) {
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (text.starts_with('-')) return std::nullopt;
  }
  Number value{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

constexpr std::int64_t kExact = std::int64_t{1} << 53;  // all smaller integers are doubles
constexpr int kExactPower = 22;                         // 10^0 to 10^22 are doubles

// The number mantissa * 10^exponent.
struct Decimal {
  std::int64_t mantissa = 0;
  int exponent = 0;
};

// The digits of a number that parse_number() accepts; nullopt when they exceed what a double holds exactly.
std::optional<Decimal> decimal_of(std::string_view text) {
  Decimal decimal;
  const std::size_t e = text.find_first_of("eEdD");
  if (e != std::string_view::npos) {
    const std::optional<std::int64_t> exponent = parse_integer(text.substr(e + 1));
    if (!exponent || std::abs(*exponent) > 100) return std::nullopt;
    decimal.exponent = static_cast<int>(*exponent);
  }
  bool after_point = false;
  for (const char c : text.substr(0, e)) {
    if (c == '.' || c == ',') after_point = true;
    if (c < '0' || c > '9') continue;
    decimal.mantissa = 10 * decimal.mantissa + (c - '0');
    if (decimal.mantissa > kExact) return std::nullopt;
    if (after_point) --decimal.exponent;
  }
  if (text.starts_with('-')) decimal.mantissa = -decimal.mantissa;
  return decimal;
}

// from + i step by integers over a common power of ten; the only rounding is that of the last operation.
class DecimalGrid {
 public:
  static std::optional<DecimalGrid> of(std::string_view from, std::string_view step, std::size_t last) {
    const std::optional<Decimal> a = decimal_of(from), b = decimal_of(step);
    if (!a || !b) return std::nullopt;
    DecimalGrid grid;
    grid.exponent_ = std::min(a->exponent, b->exponent);
    const auto first = scaled(*a, grid.exponent_), next = scaled(*b, grid.exponent_);
    if (std::abs(grid.exponent_) > kExactPower || !first || !next) return std::nullopt;
    if (last > 0 && std::abs(*next) > (kExact - std::abs(*first)) / static_cast<std::int64_t>(last))
      return std::nullopt;
    grid.from_ = *first;
    grid.step_ = *next;
    return grid;
  }

  double at(std::size_t i) const {
    const auto sum = static_cast<double>(from_ + static_cast<std::int64_t>(i) * step_);
    double power = 1;
    for (int n = 0; n < std::abs(exponent_); ++n) power *= 10;
    return exponent_ < 0 ? sum / power : sum * power;
  }

 private:
  // The mantissa for a lower exponent; nullopt when it exceeds kExact.
  static std::optional<std::int64_t> scaled(const Decimal& decimal, int exponent) {
    std::int64_t mantissa = decimal.mantissa;
    for (int n = decimal.exponent; n > exponent && mantissa != 0; --n) {
      if (std::abs(mantissa) > kExact / 10) return std::nullopt;
      mantissa *= 10;
    }
    return mantissa;
  }

  std::int64_t from_ = 0, step_ = 0;
  int exponent_ = 0;
};

}  // namespace

std::optional<double> parse_any_number(std::string_view text) { return whole<double>(text); }

std::optional<double> parse_number(std::string_view text) {
  const std::optional<double> value = whole<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<double> parse_written_number(std::string_view text) {
  if (const std::optional<double> value = parse_any_number(text)) return value;
  constexpr std::size_t kLongest = 64;
  if (text.size() > kLongest || text.find_first_not_of("0123456789+-.,eEdD") != std::string_view::npos)
    return std::nullopt;
  std::string usual(text);
  const auto commas = std::count(usual.begin(), usual.end(), ',');
  if (commas > 1 || (commas == 1 && usual.find('.') != std::string::npos)) return std::nullopt;
  for (char& c : usual) c = c == ',' ? '.' : c == 'D' || c == 'd' ? 'e' : c;
  return parse_any_number(usual);
}

std::optional<std::int64_t> parse_integer(std::string_view text) { return whole<std::int64_t>(text); }
std::optional<std::uint64_t> parse_natural(std::string_view text) { return whole<std::uint64_t>(text); }

std::optional<int> significant_decimals(std::string_view text) {
  std::optional<Decimal> decimal = decimal_of(text);
  if (!decimal) return std::nullopt;
  while (decimal->mantissa != 0 && decimal->mantissa % 10 == 0) decimal->mantissa /= 10, ++decimal->exponent;
  return decimal->mantissa == 0 ? 0 : std::max(0, -decimal->exponent);
}

std::vector<double> parse_range(std::string_view text, std::size_t max_count) {
  const auto fail = [&](const std::string& bound) {
    throw InputError(fmt::format("value {}: must be {}", in_quotes(text), bound));
  };
  std::vector<std::string_view> words;
  std::vector<double> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(':', begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    const std::optional<double> part = parse_number(words.back());
    if (!part) fail("a number or from:to:step");
    parts.push_back(*part);
    begin = end + 1;
  }
  if (parts.size() == 1) return parts;
  if (parts.size() != 3) fail("a number or from:to:step");

  const double from = parts[0];
  const double to = parts[1];
  const double step = parts[2];
  if (step == 0) fail("from:to:step with a step other than 0");
  const double steps = (to - from) / step;
  if (steps < 0) fail("from:to:step with a step that leads from the first value to the second");
  if (!(steps < static_cast<double>(max_count))) fail(fmt::format("a range of at most {} values", max_count));

  constexpr double kOfAStep = 1e-9;
  const auto last = static_cast<std::size_t>(steps + kOfAStep);
  const std::optional<DecimalGrid> grid = DecimalGrid::of(words[0], words[2], last);
  std::vector<double> values(last + 1);
  for (std::size_t i = 0; i <= last; ++i) values[i] = grid ? grid->at(i) : from + static_cast<double>(i) * step;
  if (std::abs(steps - static_cast<double>(last)) <= kOfAStep) values.back() = to;
  return values;
}

}  // namespace seaglint
