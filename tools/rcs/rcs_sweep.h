// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/linear.h"

namespace seaglint {

// What was computed: scattering matrices hh, hv, vh, vv in metres over frequency and aspect, by one or several models.
struct RcsSweep {
  std::vector<double> frequency_hz, azimuth_deg, elevation_deg;
  struct Model {
    std::string name;  // in legends and tables
    // [view][frequency], view = elevation * azimuths + azimuth
    std::vector<std::vector<std::array<Complex, 4>>> matrices;
  };
  std::vector<Model> models;
  std::optional<Vec3> transmitter;  // its direction where it stands still while the sweep is the receiver's

  std::size_t views() const { return azimuth_deg.size() * elevation_deg.size(); }
};

// The unit vector from the body to a radar there.
inline Vec3 direction_at(double azimuth_deg, double elevation_deg) {
  const double az = radians(azimuth_deg), el = radians(elevation_deg);
  return {std::cos(el) * std::cos(az), std::cos(el) * std::sin(az), std::sin(el)};
}

}  // namespace seaglint
