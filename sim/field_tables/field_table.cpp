// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/field_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"

namespace seaglint {

RcsCut& cut_for(FieldTable& table, std::size_t quantity, const std::optional<DeclaredTransmitter>& transmitter) {
  const auto place = std::find_if(table.cuts.begin(), table.cuts.end(), [&](const RcsCut& cut) {
    return cut.quantity() == quantity && cut.transmitter == transmitter;
  });
  if (place != table.cuts.end()) return *place;
  RcsCut& cut = table.cuts.emplace_back();
  cut.element = element_of_quantity(quantity);
  cut.total = is_total(quantity);
  cut.transmitter = transmitter;
  return cut;
}

std::string reading_of(const FieldTable& table) {
  std::string text = fmt::format("{}: read as {}", table.name, table.reader);
  for (const std::string& note : table.notes) text += "; " + note;
  return text;
}

void require_elements(const FieldTableSettings& settings, const std::string& file, const char* format) {
  if (!settings.elements.empty()) return;
  throw InputError(
      fmt::format("{}: {} does not say which polarisation was transmitted, nor does its name (HP, VP): give "
                  "--reference-polarisation h or v, or "
                  "one element, hh, hv, vh or vv",
                  file, format));
}

bool total_transmits_v(const FieldTableSettings& settings, const std::string& file, const char* format) {
  require_elements(settings, file, format);
  const std::vector<Polarisation>& wanted = settings.elements;
  if (wanted.size() == 2 && transmits_v(wanted[0]) == transmits_v(wanted[1])) return transmits_v(wanted[0]);
  throw InputError(
      fmt::format("{}: {} with the total cross section alone, the sum over both received polarisations: give "
                  "--reference-polarisation h or v, the one that was transmitted",
                  file, format));
}

std::string total_note(bool transmitted_v) {
  return fmt::format("total of both received polarisations, {} transmitted", transmitted_v ? "v" : "h");
}

bool fold_direction(double& theta_deg, double& phi_deg) {
  theta_deg = std::remainder(theta_deg, 360);
  const bool negative = theta_deg < 0;
  if (negative) {
    theta_deg = -theta_deg;
    phi_deg += 180;
  }
  phi_deg = std::fmod(phi_deg, 360);
  if (phi_deg < 0) phi_deg += 360;
  return negative;
}

FieldValue level_value(double frequency_hz, double theta_deg, double phi_deg, double level_dbsm, int line) {
  FieldValue value{frequency_hz, theta_deg, phi_deg, level_dbsm, {}, line};
  fold_direction(value.theta_deg, value.phi_deg);
  return value;
}

FieldValue field_value(Polarisation element, double frequency_hz, double theta_deg, double phi_deg, Complex component_m,
                       int line) {
  FieldValue value{frequency_hz, theta_deg, phi_deg, 0, {}, line};
  const bool folded = fold_direction(value.theta_deg, value.phi_deg);
  const bool opposite = is_cross(element) != folded;
  value.amplitude_m = opposite ? -component_m : component_m;
  value.level_dbsm = std::max(dbsm(component_m), kMinLevel_dbsm);
  return value;
}

}  // namespace seaglint
