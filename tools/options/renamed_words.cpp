// SPDX-License-Identifier: BSD-3-Clause
#include "tools/options/renamed_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace seaglint {
namespace {

constexpr RenamedWord kWords[] = {
    {"rcs", "--range-m", "--wavefront-range-m"},
    {"rcs", "--height-m", "--origin-height-m"},
    {"rcs", "--wave-height-m", "--significant-wave-height-m"},
    {"rcs", "--cavity-patches", "--cavity-patches-per-wavelength"},
    {"rcs", "--export-centres", "--export-scattering-centres"},
    {"rcs", "--export-range-db", "--export-dynamic-range-db"},
    {"motion", "--frames", "--snapshots"},
    {"mesh make ship", "--panel-m", "--plate-length-m"},
    {"mesh make ship", "--plating-m", "--plate-dent-m"},
    {"mesh info", "--wedge-deg", "--min-wedge-angle-deg"},
    {"verify", "--remake", "--regenerate"},
    {"", "remake", "regenerate"},
};

constexpr RenamedOptionValue kValues[] = {
    {"--sea-paths", "direct", "direct_only"},
    {"--sea-paths", "multipath", "multipath_only"},
};

}  // namespace

std::span<const RenamedWord> renamed_words() { return kWords; }
std::span<const RenamedOptionValue> renamed_option_values() { return kValues; }

std::optional<std::string> renamed_word(std::string_view command, std::string_view word) {
  const auto found =
      std::ranges::find_if(kWords, [&](const RenamedWord& old) { return old.command == command && old.word == word; });
  if (found == std::end(kWords)) return std::nullopt;
  return fmt::format("renamed to {}", found->now);
}

std::string renamed_value_error(std::string_view option, std::string_view value) {
  const auto found = std::ranges::find_if(
      kValues, [&](const RenamedOptionValue& old) { return old.option == option && old.value == value; });
  return found == std::end(kValues) ? "" : fmt::format("value '{}': renamed to '{}'", value, found->now);
}

}  // namespace seaglint
