// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/numbers/linear.h"

namespace seaglint {

inline constexpr double kMinPrinted_m2 = 1e-30;  // floor of printed levels, -300 dBsm

// Estimates of one view at one frequency (sim/scattering/sums/view_estimate.h) for hh and vv, and the indices of
// the parts that contribute most to each.
struct ViewUncertainty {
  std::array<std::complex<float>, 2> flat_less_smooth{};  // echo of flat facets less that of smooth surfaces, m
  std::array<std::complex<float>, 2> in_cavity{};         // of paths within the cavities of one part, m
  std::array<float, 2> displaced{};                       // rms change by small displacements of the vertices, m
  float non_reciprocal = 0;                               // |hv - vh| / 2 of one antenna's beams, m
  std::uint16_t flat_part = 0, cavity_part = 0, displaced_part = 0, non_reciprocal_part = 0;
};

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
  std::optional<Model> flat;  // the last model with all facets flat, of a request with `uncertainty`
  // By view, of the last model; empty where it is not computed. At frequency index `estimated`.
  std::vector<ViewUncertainty> uncertainty;
  std::size_t estimated = 0;
  std::optional<Vec3>
      transmitter;  // look direction of a fixed transmitter; the sweep is then over the receiver's directions
  std::optional<Model> coarser =
      {};  // of a converged sweep: the last model with patches, or distances between rays, twice as large

  std::size_t views() const { return azimuth_deg.size() * elevation_deg.size(); }
  std::size_t rows() const { return views() * frequency_hz.size(); }
  double azimuth_of(std::size_t view) const { return azimuth_deg[view % azimuth_deg.size()]; }
  double elevation_of(std::size_t view) const { return elevation_deg[view / azimuth_deg.size()]; }
};

}  // namespace seaglint
