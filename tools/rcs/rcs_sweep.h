// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/numbers/linear.h"

namespace seaglint {

// Computed sweep: scattering matrices hh, hv, vh, vv in metres over frequency and aspect, of one or several models.
struct RcsSweep {
  std::vector<double> frequency_hz, azimuth_deg, elevation_deg;
  struct Model {
    std::string name;  // in legends and tables
    bool edge_diffraction = true;
    // [view][frequency], view = elevation * azimuths + azimuth
    std::vector<std::vector<std::array<Complex, 4>>> matrices;
  };
  std::vector<Model> models;
  std::optional<Vec3>
      transmitter;  // look direction of a fixed transmitter; the sweep is then over the receiver's directions

  std::size_t views() const { return azimuth_deg.size() * elevation_deg.size(); }
  std::size_t rows() const { return views() * frequency_hz.size(); }
  double azimuth_of(std::size_t view) const { return azimuth_deg[view % azimuth_deg.size()]; }
  double elevation_of(std::size_t view) const { return elevation_deg[view / azimuth_deg.size()]; }
};

}  // namespace seaglint
