// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/transmitter_note.h"

#include <fmt/format.h>

#include "sim/core/process/error.h"
#include "sim/core/text/number.h"

namespace seaglint {
namespace {

constexpr const char* kMonostatic = "monostatic";
constexpr const char* kAzimuth = "transmitter at azimuth ";
constexpr const char* kElevation = " deg, elevation ";
constexpr const char* kEnd = " deg";

double angle(const std::string& text) {
  const std::optional<double> value = parse_number(text);
  if (!value) throw InputError(fmt::format("'{}': must be a number", text));
  return *value;
}

}  // namespace

std::string transmitter_note(const std::optional<FixedTransmitter>& transmitter) {
  if (!transmitter) return kMonostatic;
  return fmt::format("{}{:.9g}{}{:.9g}{}", kAzimuth, transmitter->azimuth_deg, kElevation, transmitter->elevation_deg,
                     kEnd);
}

std::optional<NotedTransmitter> read_transmitter_note(const std::string& line) {
  if (!line.starts_with(kMethodNote)) return std::nullopt;
  const auto clause = [](const std::string& text) { return fmt::format(", {}", text); };
  if (line.find(clause(kMonostatic) + ",") != std::string::npos) return NotedTransmitter{};
  const std::string azimuth = clause(kAzimuth), elevation = kElevation, end = std::string(kEnd) + ",";
  const std::size_t at = line.find(azimuth), middle = line.find(elevation, at),
                    last = line.find(end, middle + elevation.size());
  if (at == std::string::npos || middle == std::string::npos || last == std::string::npos) return std::nullopt;
  const std::size_t first = at + azimuth.size(), second = middle + elevation.size();
  const double elevation_deg = angle(line.substr(second, last - second));
  return NotedTransmitter{FixedTransmitter{angle(line.substr(first, middle - first)), elevation_deg}};
}

}  // namespace seaglint
