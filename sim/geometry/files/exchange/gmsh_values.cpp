// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/exchange/gmsh_values.h"

#include <fmt/format.h>

#include <utility>

#include "sim/core/process/error.h"
#include "sim/core/text/number.h"
#include "sim/core/text/shown.h"
#include "sim/core/text/words.h"
#include "sim/geometry/files/polygons/binary_number.h"

namespace seaglint {
namespace {

// Whether the second line of the file, "2.2 1 8", declares binary values.
bool declares_binary(std::string_view text) {
  next_line(text);
  std::string_view line = next_line(text);
  next_word(line);
  return next_word(line) == "1";
}

}  // namespace

GmshValues::GmshValues(std::string bytes, std::string file) : file_(std::move(file)) {
  is_binary_ = declares_binary(bytes);
  if (is_binary_) {
    bytes_ = std::move(bytes);
    rest_ = bytes_;
  } else {
    source_.emplace(file_, std::move(bytes));
    rest_ = source_->text();
  }
  at_ = rest_.data();
  read_format();
}

std::string GmshValues::place(const char* at) const {
  return source_ ? source_->place({at, at}) : fmt::format("{}: byte {}", file_, at - bytes_.data());
}

void GmshValues::fail(const std::string& what) const { throw InputError(fmt::format("{}: {}", place(at_), what)); }

void GmshValues::fail_end() const {
  throw InputError(fmt::format("{}: ends within {}: the file is cut off", file_,
                               section_.empty() ? std::string("its header") : "$" + shown(section_)));
}

void GmshValues::read_format() {
  if (!next_section()) fail("is empty");
  if (section_ == "NOD") fail("version 1.0 of Gmsh's format is not read: save it as 2.2 or 4.1");
  if (section_ != "MeshFormat") fail("does not begin with $MeshFormat: is it a mesh of Gmsh?");
  const std::string_view version = take_word();
  if (version == "2.2" || version == "2.1" || version == "2.0" || version == "2")
    version_ = 2;
  else if (version == "4.1")
    version_ = 4;
  else
    fail(fmt::format("version {} of Gmsh's format is not read: save it as 2.2 or 4.1", shown(version, 20)));
  const std::int64_t kind = word(), size = word();
  if (kind != 0 && kind != 1) fail(fmt::format("file type {}: must be 0 or 1", kind));
  if (size != 8) fail(fmt::format("values of {} bytes: must be 8", size));
  if (is_binary_) {
    line();
    const char* bytes = take(4);
    swap_ = number_at<std::int32_t>(bytes, true) == 1;
    if (!swap_ && number_at<std::int32_t>(bytes, false) != 1) fail("the byte order is not that of a 1");
  }
  end_section();
}

bool GmshValues::next_section() {
  const std::size_t begin = rest_.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) return false;
  rest_.remove_prefix(begin);
  at_ = rest_.data();
  const std::string_view line = trimmed(next_line(rest_));
  if (!line.starts_with('$') || line.starts_with("$End"))
    fail(fmt::format("{} where a section begins with $", in_quotes(line.substr(0, 40))));
  section_ = line.substr(1);
  return true;
}

void GmshValues::end_section() {
  const std::string_view word = take_word();
  if (!word.starts_with("$End") || word.substr(4) != section_) {
    fail(fmt::format("{} where $End{} belongs: the section has another length than its counts",
                     in_quotes(word.substr(0, 40)), shown(section_)));
  }
}

// Binary sections may contain any bytes; the end is looked for behind a line end.
void GmshValues::skip_section() {
  const std::string end = fmt::format("$End{}", section_);
  std::size_t found = rest_.find(end);
  while (found != std::string_view::npos && found > 0 && rest_[found - 1] != '\n') found = rest_.find(end, found + 1);
  if (found == std::string_view::npos) fail_end();
  rest_.remove_prefix(found);
  end_section();
}

std::string_view GmshValues::take_word() {
  const std::string_view word = next_word(rest_);
  if (word.empty()) fail_end();
  at_ = word.data();
  return word;
}

std::int64_t GmshValues::integer_of(std::string_view word) const {
  const std::optional<std::int64_t> value = parse_integer(word);
  if (!value) fail(fmt::format("${}: value {}: must be an integer", shown(section_), in_quotes(word)));
  return *value;
}

const char* GmshValues::take(std::size_t size) {
  if (rest_.size() < size) fail_end();
  at_ = rest_.data();
  rest_.remove_prefix(size);
  return at_;
}

std::int64_t GmshValues::word() { return integer_of(take_word()); }

std::string_view GmshValues::line() {
  if (rest_.empty()) fail_end();
  return next_line(rest_);
}

std::int64_t GmshValues::small() { return is_binary_ ? number_at<std::int32_t>(take(4), swap_) : word(); }

std::int64_t GmshValues::large() { return is_binary_ ? number_at<std::int64_t>(take(8), swap_) : word(); }

double GmshValues::real() {
  if (is_binary_) return number_at<double>(take(8), swap_);
  const std::string_view text = take_word();
  const std::optional<double> value = parse_any_number(text);
  if (!value) fail(fmt::format("${}: value {}: must be a number", shown(section_), in_quotes(text)));
  return *value;
}

}  // namespace seaglint
