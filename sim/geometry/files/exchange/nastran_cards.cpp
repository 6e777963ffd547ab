// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/exchange/nastran_cards.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/words.h"

namespace seaglint {

namespace {

constexpr std::size_t kSmall = 8, kLarge = 16;  // columns

std::string upper(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return result;
}

bool is_label(std::string_view field) { return field.starts_with('+') || field.starts_with('*'); }

// The part of a line in front of column `end`, removed from the front of `rest`, which begins at `column`. A tab leads
// to the next multiple of eight.
std::string_view columns(std::string_view& rest, std::size_t& column, std::size_t end) {
  std::size_t length = 0;
  for (; length < rest.size() && column < end; ++length)
    column = rest[length] == '\t' ? (column / 8 + 1) * 8 : column + 1;
  const std::string_view part = rest.substr(0, length);
  rest.remove_prefix(length);
  return trimmed(part);
}

}  // namespace

std::optional<double> parse_nastran_real(std::string_view text) {
  if (text.find_first_not_of("0123456789+-.eEdD") != std::string_view::npos) return std::nullopt;
  // A sign behind a digit or the point begins an exponent.
  const std::size_t sign = text.find_last_of("+-");
  const bool is_exponent = sign != std::string_view::npos && sign > 0 && !std::isalpha(text[sign - 1]);
  return is_exponent ? parse_number(fmt::format("{}e{}", text.substr(0, sign), text.substr(sign)))
                     : parse_written_number(text);
}

struct NastranCards::Line {
  std::string_view first, label;  // field 1 and field 10
  std::vector<std::string_view> fields;
};

NastranCards::NastranCards(TextSource source) : source_(std::move(source)), rest_(source_.text()) { begin(); }

void NastranCards::begin() {
  for (std::string_view text = rest_; !text.empty();) {
    std::string_view line = next_line(text);
    const std::string word = upper(next_word(line));
    if (word != "BEGIN") continue;
    const std::string_view what = next_word(line);
    if (upper(what) != "BULK") source_.fail(what, fmt::format("BEGIN {}: superelements are not read", shown(what)));
    if (has_begin_) source_.fail(what, "a second BEGIN BULK: superelements are not read");
    has_begin_ = true;
    rest_ = text;
  }
}

NastranCards::Line NastranCards::split(std::string_view line) const {
  Line parts;
  const bool is_free = line.find(',') != std::string_view::npos;
  if (!is_free) {
    std::size_t column = 0;
    std::string_view rest = line;
    parts.first = columns(rest, column, kSmall);
    const std::size_t width = parts.first.ends_with('*') || parts.first.starts_with('*') ? kLarge : kSmall;
    for (std::size_t end = kSmall + width; end <= 72; end += width) parts.fields.push_back(columns(rest, column, end));
    parts.label = columns(rest, column, 80);
    return parts;
  }
  std::vector<std::string_view> fields;
  for (std::string_view rest = line;;) {
    const std::size_t comma = rest.find(',');
    fields.push_back(trimmed(rest.substr(0, comma)));
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  parts.first = fields[0];
  const std::size_t count = parts.first.ends_with('*') || parts.first.starts_with('*') ? 4 : 8;
  for (std::size_t i = 1; i <= count; ++i) parts.fields.push_back(i < fields.size() ? fields[i] : std::string_view());
  if (fields.size() > count + 1) parts.label = fields[count + 1];
  for (std::size_t i = count + 2; i < fields.size(); ++i) {
    if (!fields[i].empty()) source_.fail(fields[i], fmt::format("more than {} fields in one line", count + 2));
  }
  return parts;
}

// The next line that is neither blank nor a comment, without a comment at its end.
bool NastranCards::next_content(std::string_view& line) {
  while (!rest_.empty()) {
    std::string_view text = next_line(rest_);
    const std::size_t dollar = text.find('$');
    if (dollar != std::string_view::npos && trimmed(text.substr(0, dollar)).empty())
      comments_after_.push_back(text.substr(dollar));
    line = text.substr(0, dollar);
    if (!trimmed(line).empty()) return true;
  }
  return false;
}

void NastranCards::add(const Line& line) {
  for (std::size_t i = 0; i < line.fields.size() && fields_.size() < kMostFields; ++i)
    fields_.push_back(line.fields[i]);
}

bool NastranCards::next() {
  comments_ = std::exchange(comments_after_, {});
  std::string_view text;
  const bool has_line = next_content(text);
  comments_.insert(comments_.end(), comments_after_.begin(), comments_after_.end());
  comments_after_.clear();
  fields_.clear();
  name_.clear();
  if (!has_line) return false;

  line_ = trimmed(text);
  Line line = split(text);
  if (line.first.empty() || is_label(line.first))
    source_.fail(line_, "a continuation line without a card before it: no NASTRAN bulk data?");
  name_ = upper(line.first);
  // Free field without commas: a name alone, or blanks between name and value as in INCLUDE 'file'.
  const std::size_t blank = name_.find_first_of(" \t");
  if (blank != std::string::npos) name_.resize(blank);
  if (name_ == "ENDDATA") return false;
  if (name_.ends_with('*')) name_.pop_back();
  fields_.push_back(line.first);
  add(line);

  while (next_content(text)) {
    const Line more = split(text);
    const std::string_view first = more.first;
    if (!first.empty() && !is_label(first)) {
      rest_ = source_.text().substr(static_cast<std::size_t>(text.data() - source_.text().data()));
      break;
    }
    if (is_label(line.label) && line.label.size() > 1 && first.size() > 1 && line.label.substr(1) != first.substr(1)) {
      source_.fail(first, fmt::format("continuation {} where {} should follow: sort the cards", in_quotes(first),
                                      in_quotes(line.label)));
    }
    add(more);
    line = more;
  }
  return true;
}

std::string_view NastranCards::field(std::size_t i) const {
  return i >= 1 && i <= fields_.size() ? fields_[i - 1] : std::string_view();
}

std::int64_t NastranCards::integer(std::size_t i, std::optional<std::int64_t> fallback) const {
  const std::string_view text = field(i);
  if (text.empty()) {
    if (fallback) return *fallback;
    source_.fail(line_, fmt::format("{}: field {} is empty: must be an integer", name_, i));
  }
  const std::optional<std::int64_t> value = parse_integer(text);
  if (!value) source_.fail(text, fmt::format("{}: value {}: must be an integer", name_, in_quotes(text)));
  return *value;
}

double NastranCards::real(std::size_t i) const {
  const std::string_view text = field(i);
  if (text.empty()) return 0;
  const std::optional<double> value = parse_nastran_real(text);
  if (!value) source_.fail(text, fmt::format("{}: value {}: must be a number", name_, in_quotes(text)));
  return *value;
}

Vec3 NastranFrames::cartesian(Kind kind, const Vec3& point) {
  if (kind == Kind::kRectangular) return point;
  const double r = point.x(), theta = radians(point.y());
  if (kind == Kind::kCylindrical) return {r * std::cos(theta), r * std::sin(theta), point.z()};
  // theta from the z axis, phi about it (MSC Nastran Quick Reference Guide, CORD2S).
  const double phi = radians(point.z());
  return {r * std::sin(theta) * std::cos(phi), r * std::sin(theta) * std::sin(phi), r * std::cos(theta)};
}

void NastranFrames::add(const NastranCards& card) {
  const std::int64_t number = card.integer(2);
  const TextSource& source = card.source();
  if (number <= 0) source.fail(card.field(2), fmt::format("{} {}: must be greater than 0", card.name(), number));
  const bool is_known = card.name() == "CORD2R" || card.name() == "CORD2C" || card.name() == "CORD2S";
  if (!is_known) {
    others_.insert(number);
    return;
  }
  Frame frame;
  frame.kind = card.name() == "CORD2C"   ? Kind::kCylindrical
               : card.name() == "CORD2S" ? Kind::kSpherical
                                         : Kind::kRectangular;
  frame.reference = card.integer(3, 0);
  frame.at = card.at();
  for (int i = 0; i < 3; ++i) {
    const auto field = static_cast<std::size_t>(4 + i);
    frame.a[i] = card.real(field);
    frame.b[i] = card.real(field + 3);
    frame.c[i] = card.real(field + 6);
  }
  if (!frames_.try_emplace(number, frame).second)
    source.fail(card.field(2), fmt::format("{} {} is given twice", card.name(), number));
}

std::optional<Vec3> NastranFrames::in_base(std::int64_t system, const Vec3& point) const {
  if (system == 0) return point;
  const auto found = frames_.find(system);
  if (found == frames_.end()) return std::nullopt;
  const Frame& frame = found->second;
  return Vec3(frame.a + frame.R * cartesian(frame.kind, point));
}

// The axes of a system whose reference is resolved.
void NastranFrames::place(Frame& frame, const TextSource& source) const {
  for (Vec3* point : {&frame.a, &frame.b, &frame.c}) {
    const std::optional<Vec3> base = in_base(frame.reference, *point);
    if (!base) {
      source.fail(std::string_view(frame.at, frame.at),
                  fmt::format("coordinate system {}, which it refers to, is not given", frame.reference));
    }
    *point = *base;
  }
  const Vec3 z = frame.b - frame.a, y = z.cross(frame.c - frame.a);
  if (!(y.norm() > 1e-9 * z.norm() * (frame.c - frame.a).norm()))
    source.fail(std::string_view(frame.at, frame.at), "the three points of the coordinate system are on one line");
  frame.R.col(2) = z.normalized();
  frame.R.col(1) = y.normalized();
  frame.R.col(0) = frame.R.col(1).cross(frame.R.col(2));
  frame.is_resolved = true;
}

void NastranFrames::resolve(const TextSource& source) {
  for (auto& [number, first] : frames_) {
    std::vector<Frame*> chain;
    for (Frame* frame = &first; !frame->is_resolved;) {
      chain.push_back(frame);
      const auto next = frames_.find(frame->reference);
      if (next == frames_.end()) break;
      frame = &next->second;
      if (chain.size() > frames_.size())
        source.fail(std::string_view(first.at, first.at), fmt::format("coordinate system {} refers to itself", number));
    }
    for (; !chain.empty(); chain.pop_back()) place(*chain.back(), source);
  }
}

}  // namespace seaglint
