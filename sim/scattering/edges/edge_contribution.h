// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The echo of a stretch of an edge: a pattern per metre and the integral of the phase along it, at any frequency.
// Single diffraction, edge waves, what beams lack between two rims and what walls in penumbra do differ in what their
// amplitude does along the stretch.

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "sim/scattering/diffraction/wall_penumbra_term.h"
#include "sim/scattering/surfaces/footprint.h"

namespace seaglint {

// hh, hv, vh, vv per metre of edge, dimensionless; where sheets end k t (thick + thick_log ln(k t)) more, t their
// thickness.
struct EdgePattern {
  std::array<Complex, 4> sharp{}, thick{}, thick_log{};
  double thickness_m = 0;  // t; 0: neither is filled

  std::array<Complex, 4> at(double k) const;
  EdgePattern& operator+=(const EdgePattern& other);  // of the same edges
  EdgePattern& operator*=(double factor);
};
EdgePattern transposed(EdgePattern pattern);

// The echo of a stretch of edge: S = pattern times the integral of e^{jk psi} along it, psi linear.
struct EdgeFootprint {
  std::array<double, 2> psi{};           // at its ends, m
  std::array<PathGradient, 2> gradient;  // of the ends, m
  double length = 0;                     // m
  EdgePattern pattern;                   // but for the last of several edge waves in a row times sqrt(1/m)
  // An edge wave of length l decays as 1/sqrt(k l), less where it starts or ends near a shadow boundary.
  struct EdgeWaveRange {
    // at the ends of the stretch, m; linear in between. Of several waves in a row, of the last
    std::array<double, 2> l{};
    double departure = 0, arrival = 0;  // shadow_distance() where the first starts and the last ends
    double first_m = 0;                 // mean length of the first of several
    int waves = 1;                      // in a row
  };
  std::optional<EdgeWaveRange> edge_wave;
  // What a beam lacks between two rims that cut it one after the other (beam_boundary.h), k times metres of its width.
  struct KnifeEdges {
    // of the way over both rims: from the one to the other along the beam, and how much longer it is than the beam's
    // over the second alone, m
    std::array<double, 2> distance{}, excess{};
    double slope = 0;  // of psi across the rims, out of the light
    // how much longer it is than the way out over the first rim alone, m; below zero where the second one hides that
    // way
    std::array<double, 2> beyond{};
    bool shadow_within = false;   // the second rim lies in the first one's shadow
    double moved = 0, still = 1;  // shares of the slope's form, and of that of none, which fades out

    // At an end the phase may run along the stretch, by `run` over all of it, rad.
    Complex width(double k, double share, double run = std::numeric_limits<double>::infinity()) const;
    // Bound of it from a wavenumber on.
    double bound(double lowest) const;

   private:
    Complex sloping(double k, double share) const;
    // 1 along the wave, 0 from where the shadow lines of both ways lie apart by the light's spread, k d slope^2 / 2 = 1
    // rad: there the ends of the currents move.
    double fade_by_slope(double k, double distance_m) const;
  };
  std::optional<KnifeEdges> knife_edges;
  std::optional<WallRange> wall;
  // Where a beam ends or a wall stands in penumbra: 2 d / depth^2 of the way there and the shallower panel, rad/m. It
  // fades out towards wavenumbers as low, where the panel is no deeper than the light's spread and its other side
  // counts as much.
  double spread = 0;
  double fade_by_spread(double k) const;
  std::int32_t facet = -1;                  // the edge's first
  std::uint16_t part = 0, part_beyond = 0;  // of that facet and of the other one
  std::uint8_t bounces = 1;                 // mirrors on both ways and every edge met
};

// The integral of e^{jk psi} along the stretch, m, an edge wave's range included, is what these leave of it at its
// ends: end_term(1) e^{jk psi_1} - end_term(0) e^{jk psi_0}. `share` of the way from one end to the other: between them
// the terms of two parts cancel.
Complex end_term(const EdgeFootprint& footprint, double k, double share);

// False between knife edges where the phase runs through less than ten cycles: the terms of the ends err by what the
// width changes in one.
bool ends_answer_alone(const EdgeFootprint& footprint, double k);

// The same integral from one share of the way to another, about the phase halfway: also where psi does not change.
Complex part_integral(const EdgeFootprint& footprint, double k, double from, double to);

// hh, hv, vh, vv in metres.
std::array<Complex, 4> scattered(const EdgeFootprint& footprint, double k);

}  // namespace seaglint
