// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/exchange/nastran_names.h"

#include <array>
#include <charconv>

#include "sim/core/text/number.h"
#include "sim/core/text/words.h"
#include "sim/geometry/files/exchange/shell_model.h"

namespace seaglint {
namespace {

// The whole number at the front of a text, removed from it.
std::optional<std::int64_t> leading_number(std::string_view& text) {
  while (text.starts_with(' ') || text.starts_with('\t')) text.remove_prefix(1);
  std::int64_t number = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
  return number;
}

// The text between the next two double quotes, removed with them from the front of `text`; empty without them.
std::string_view quoted(std::string_view& text) {
  const std::size_t begin = text.find('"');
  if (begin == std::string_view::npos) return {};
  const std::size_t end = text.find('"', begin + 1);
  if (end == std::string_view::npos) return {};
  const std::string_view name = text.substr(begin + 1, end - begin - 1);
  text.remove_prefix(end + 1);
  return name;
}

}  // namespace

void NastranNames::add(std::int64_t number, std::string_view name, bool overwrite) {
  name = trimmed(name);
  if (name.empty() || name.size() > kLongestName) return;
  if (overwrite)
    names_[number] = name;
  else
    names_.try_emplace(number, name);
}

void NastranNames::comment(std::string_view line) {
  std::string_view text = line;
  const std::string_view word = next_word(text);
  if (word == "$HMNAME") {
    const std::string_view kind = next_word(text);
    if (kind != "PROP" && kind != "COMP") return;
    const std::optional<std::int64_t> number = leading_number(text);
    const std::string_view name = quoted(text);
    // A component names the property of its elements behind its own name.
    const std::optional<std::int64_t> property = kind == "COMP" ? leading_number(text) : std::nullopt;
    if (number) add(property.value_or(*number), name, kind == "PROP");
    return;
  }
  constexpr std::string_view kAnsa = "$ANSA_NAME_COMMENT;", kRegion = "Elements and Element Properties for region";
  if (line.starts_with(kAnsa)) {
    text = line.substr(kAnsa.size());
    const std::optional<std::int64_t> number = leading_number(text);
    constexpr std::string_view kShell = ";PSHELL;";
    if (!number || !text.starts_with(kShell)) return;
    text.remove_prefix(kShell.size());
    add(*number, text.substr(0, text.find(';')), true);
    return;
  }
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos) return;
  const std::string_view name = trimmed(line.substr(colon + 1));
  if (line.find(kRegion) != std::string_view::npos) region_ = name;
  constexpr std::string_view kFemap = "Property ";
  const std::size_t property = line.find(kFemap);
  if (line.find("Femap") < property && property < colon) {
    text = line.substr(property + kFemap.size(), colon - property - kFemap.size());
    if (const std::optional<std::int64_t> number = parse_integer(trimmed(text))) add(*number, name, true);
  }
}

void NastranNames::property(std::int64_t number) {
  if (region_) add(number, *region_, false);
  region_.reset();
}

}  // namespace seaglint
