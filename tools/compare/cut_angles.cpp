// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/cut_angles.h"

#include <fmt/format.h>

#include <cmath>

#include "sim/core/process/error.h"

namespace seaglint {

double azimuth_of(const RcsCut& cut, double phi_deg) {
  return std::remainder((phi_deg - cut.phi_offset_deg) / cut.phi_scale, 360);
}

ViewPoint view_point(const RcsCut& cut, const FieldValue& value) {
  return {value.frequency_hz, azimuth_of(cut, value.phi_deg), 90 - value.theta_deg};
}

const DeclaredTransmitter& stated_transmitter(const RcsCut& cut) {
  if (cut.transmitter) return *cut.transmitter;
  throw InputError(fmt::format(
      "{}: neither the file nor its name says where the incident wave comes from: give --incidence monostatic "
      "or --incidence THETA,PHI",
      cut.name));
}

std::optional<FixedTransmitter> fixed_transmitter(const RcsCut& cut) {
  const DeclaredTransmitter& transmitter = stated_transmitter(cut);
  if (transmitter.is_monostatic) return std::nullopt;
  return FixedTransmitter{azimuth_of(cut, transmitter.phi_deg), 90 - transmitter.theta_deg};
}

}  // namespace seaglint
