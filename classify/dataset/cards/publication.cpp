// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/cards/publication.h"

#include <algorithm>
#include <array>
#include <chrono>

#include "sim/core/process/printable.h"
#include "sim/core/text/words.h"

namespace seaglint {

namespace {

bool is_letter_or_digit(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }

bool are_digits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

std::string name_problem(const std::string& name) {
  if (name.empty() || utf8_prefix(name) != name.size()) return "must be text in UTF-8";
  const bool has_control =
      std::any_of(name.begin(), name.end(), [](char c) { return c >= 0 && (c < ' ' || c == 127); });
  return has_control ? "must be one line without control characters" : "";
}

std::string licence_problem(const std::string& licence) {
  if (is_url(licence)) return url_problem(licence);
  return is_identifier(licence) ? ""
                                : "must be an identifier of the SPDX list such as CC-BY-4.0, LicenseRef-NAME, or a URL";
}

bool is_identifier(std::string_view text) {
  return !text.empty() && is_letter_or_digit(text.front()) && std::all_of(text.begin(), text.end(), [](char c) {
    return is_letter_or_digit(c) || c == '-' || c == '.' || c == '+';
  });
}

bool is_url(std::string_view text) { return text.starts_with("https://") || text.starts_with("http://"); }

std::string url_problem(const std::string& url) {
  const std::size_t begin = url.find("//");
  const bool is_printable = std::all_of(url.begin(), url.end(), [](char c) {
    return c > ' ' && c < 127 && std::string_view("<>\"{}|\\^`").find(c) == std::string_view::npos;
  });
  return is_url(url) && url.size() > begin + 2 && is_printable ? "" : "must begin with https:// or http://";
}

std::string date_problem(const std::string& date) {
  constexpr const char* kProblem = "must be a date YYYY-MM-DD";
  const std::string_view text = date;
  if (text.size() != 10 || text[4] != '-' || text[7] != '-') return kProblem;
  const std::array parts{text.substr(0, 4), text.substr(5, 2), text.substr(8, 2)};
  if (!std::all_of(parts.begin(), parts.end(), are_digits)) return kProblem;
  const auto number = [](std::string_view part) { return static_cast<unsigned>(*parse_natural(part)); };
  const std::chrono::year_month_day day{std::chrono::year(static_cast<int>(number(parts[0]))),
                                        std::chrono::month(number(parts[1])), std::chrono::day(number(parts[2]))};
  return day.ok() ? "" : kProblem;
}

std::string version_problem(const std::string& version) {
  std::string_view rest = version;
  int parts = 0;
  while (parts < 4) {
    const std::size_t end = std::min(rest.find('.'), rest.size());
    if (!are_digits(rest.substr(0, end)) || (end > 1 && rest.front() == '0')) break;
    ++parts;
    if (end == rest.size()) return parts == 3 ? "" : "must be MAJOR.MINOR.PATCH, such as 1.0.0";
    rest.remove_prefix(end + 1);
  }
  return "must be MAJOR.MINOR.PATCH, such as 1.0.0";
}

}  // namespace seaglint
