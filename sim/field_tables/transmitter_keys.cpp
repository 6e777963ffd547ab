// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/transmitter_keys.h"

#include <fmt/format.h>

#include <map>
#include <string_view>

#include "sim/core/process/error.h"
#include "sim/core/text/number.h"
#include "sim/core/text/shown.h"
#include "sim/core/text/words.h"

namespace seaglint {
namespace {

constexpr const char* kKind = "transmitter";
constexpr const char* kMonostatic = "monostatic";
constexpr const char* kAzimuth = "transmitter_azimuth_deg";
constexpr const char* kElevation = "transmitter_elevation_deg";

bool is_key(const std::string& name) { return name == kKind || name == kAzimuth || name == kElevation; }

double angle_deg(const std::map<std::string, std::string>& keys, const char* name) {
  const auto place = keys.find(name);
  if (place == keys.end()) throw InputError(fmt::format("the key {} is missing", name));
  const std::optional<double> value = parse_number(place->second);
  if (!value) throw InputError(fmt::format("{}={}: must be a number", name, place->second));
  return *value;
}

}  // namespace

std::string transmitter_line(const std::optional<FixedTransmitter>& transmitter) {
  if (!transmitter) return fmt::format("# {}={}", kKind, kMonostatic);
  return fmt::format("# {}={:.9g} {}={:.9g}", kAzimuth, transmitter->azimuth_deg, kElevation,
                     transmitter->elevation_deg);
}

std::optional<TransmitterKeys> read_transmitter_line(const std::string& line) {
  if (!line.starts_with("# ")) return std::nullopt;
  std::map<std::string, std::string> keys;
  std::string_view rest = std::string_view(line).substr(2);
  for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) {
    const std::size_t equals = word.find('=');
    const std::string name(word.substr(0, equals));
    if (equals == std::string_view::npos || !is_key(name)) {
      if (keys.empty()) return std::nullopt;
      throw InputError(fmt::format("{}: no key of the transmitter", in_quotes(word)));
    }
    if (!keys.emplace(name, word.substr(equals + 1)).second)
      throw InputError(fmt::format("the key {} appears twice", name));
  }
  if (keys.empty()) return std::nullopt;
  const auto kind = keys.find(kKind);
  if (kind == keys.end())
    return TransmitterKeys{FixedTransmitter{angle_deg(keys, kAzimuth), angle_deg(keys, kElevation)}};
  if (kind->second != kMonostatic || keys.size() > 1)
    throw InputError(
        fmt::format("{}: must be {}={} or {}=A {}=B", line.substr(2), kKind, kMonostatic, kAzimuth, kElevation));
  return TransmitterKeys{};
}

}  // namespace seaglint
