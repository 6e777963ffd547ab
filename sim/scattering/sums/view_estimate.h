// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// How uncertain the echo of a view is, from its own trace and at one wavenumber: its change with flat facets, by small
// displacements of the vertices, and by cavities (hh and vv), and the difference of hv and vh.

#include <array>
#include <optional>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/scattering/radiation/contribution.h"

namespace seaglint {

// Rms displacement of every coordinate of the vertices, in wavelengths, whose effect is estimated.
inline constexpr double kVertexNoise = 1.0 / 2000;
// A path within a cavity has at least so many reflections, by walls of one part, and at most so many wavelengths
// between them.
inline constexpr int kCavityReflections = 4;
inline constexpr double kCavityWavelengths = 10;

using CoPolar = std::array<Complex, 2>;  // hh, vv, m

class ViewEstimate {
 public:
  explicit ViewEstimate(double wavenumber) : k_(wavenumber) {}

  double wavenumber() const { return k_; }

  // Contributions to an estimate: of curved footprints, and of those behind reflectors.
  static bool concerns(const Contribution& contribution) {
    const Footprint* footprint = contribution.footprint();
    return footprint && (footprint->curvature || contribution.source.bounces > 1);
  }
  // Adds a contribution that an estimate concerns: its scattering matrix, one way, and that of its flat facets with
  // flat reflectors, m. Footprints of one beam on one panel count as one contribution if they follow each other.
  void add(const Contribution& contribution, const ScatteringMatrix& smooth, const ScatteringMatrix& flat);
  void end_beam();  // the next footprint is of another beam
  // Adds those of another path with its hh and vv times the factor, hv and vh times `cross`.
  void add(const ViewEstimate& other, const CoPolar& factor = {1, 1}, const Complex& cross = 1);

  // Of one part, or of all.
  struct Sums {
    CoPolar flat_less_smooth{};               // m
    std::array<double, 2> flat_change{};      // sum of |flat - smooth| over the beams, m
    std::array<double, 2> displaced_power{};  // sum of the expected square of the change by kVertexNoise, m^2
    CoPolar in_cavity{};                      // contributions of paths within cavities, m
    Complex non_reciprocal{};                 // (hv - vh) / 2 of the beams, for one antenna, m
    double non_reciprocal_size = 0;           // sum of its magnitude over the beams, m
  };
  Sums all() const;
  // Index of the part with the largest of a quantity of the sums; 0 where it is 0 for all.
  template <typename Quantity>
  std::size_t largest_part(const Quantity& quantity) const {
    std::size_t largest = 0;
    for (std::size_t i = 1; i < parts_.size(); ++i) {
      if (quantity(parts_[i]) > quantity(parts_[largest])) largest = i;
    }
    return largest;
  }
  // By part index; those of the last parts may be missing.
  const std::vector<Sums>& parts() const { return parts_; }

 private:
  // One beam on one panel.
  struct Beam {
    int facet = -1;
    double psi0 = 0;
    std::uint8_t bounces = 0;
    std::uint16_t part = 0;
    double phase_change = 0;  // rms, by kVertexNoise, rad
    bool in_cavity = false;
    CoPolar smooth{}, flat{};
    Complex non_reciprocal{};
  };

  double k_;
  std::vector<Sums> parts_;
  std::optional<Beam> beam_;
};

}  // namespace seaglint
