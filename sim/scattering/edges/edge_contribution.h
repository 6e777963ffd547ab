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

// hh, hv, vh, vv per metre of edge, dimensionless; where sheets end k t (thick + thickness_log ln(k t)) more, t their
// thickness.
struct EdgePattern {
  std::array<Complex, 4> thin{}, thickness_linear{}, thickness_log{};
  double thickness_m = 0;  // t; 0: neither is filled

  std::array<Complex, 4> at(double k) const;
  EdgePattern& operator+=(const EdgePattern& other);  // of the same edges
  EdgePattern& operator*=(double factor);
};
EdgePattern transposed(EdgePattern pattern);

// The echo of a stretch of edge: S = pattern times the integral of e^{jk psi} along it, psi linear.
struct EdgeContribution {
  std::array<double, 2> psi{};           // at its ends, m
  std::array<PathGradient, 2> gradient;  // of the ends, m
  double length = 0;                     // m
  EdgePattern pattern;                   // but for the last of several edge waves in a row times sqrt(1/m)
  // An edge wave of length l decays as 1/sqrt(k l), less where it starts or ends near a shadow boundary.
  struct MultipleDiffraction {
    // at the ends of the stretch, m; linear in between. Of several waves in a row, of the last
    std::array<double, 2> l{};
    double launch_parameter = 0, exit_parameter = 0;  // transition_parameter() where the first starts and the last ends
    double first_length_m = 0;                        // mean length of the first of several
    int grazing_waves = 1;                            // in a row
  };
  std::optional<MultipleDiffraction> multiple_diffraction;
  // What a beam lacks between two rims that cut it one after the other (beam_boundary.h), k times metres of its width.
  struct DoubleKnifeEdge {
    // of the way over both rims: from the one to the other along the beam, and how much longer it is than the beam's
    // over the second alone, m
    std::array<double, 2> separation{}, excess_path{};
    double psi_slope = 0;  // of psi across the rims, out of the light
    // how much longer it is than the way out over the first rim alone, m; below zero where the second one hides that
    // way
    std::array<double, 2> exit_excess{};
    bool second_in_shadow = false;                 // the second rim lies in the first one's shadow
    double off_axis_weight = 0, axial_weight = 1;  // shares of the slope's form, and of that of none, which fades out

    // At an end the phase may run along the stretch, by `run` over all of it, rad.
    Complex effective_width(double k, double share, double run = std::numeric_limits<double>::infinity()) const;
    // Bound of it from a wavenumber on.
    double upper_bound(double lowest) const;

   private:
    Complex off_axis_width(double k, double share) const;
    // 1 along the wave, 0 from where the shadow lines of both ways lie apart by the light's spread, k d slope^2 / 2 = 1
    // rad: there the ends of the currents move.
    double axial_taper(double k, double distance_m) const;
  };
  std::optional<DoubleKnifeEdge> double_knife_edge;
  std::optional<WallPenumbraTerm> penumbra;
  // Where a beam ends or a wall stands in penumbra: 2 d / depth^2 of the way there and the shallower panel, rad/m. It
  // fades out towards wavenumbers as low, where the panel is no deeper than the light's spread and its other side
  // counts as much.
  double fresnel_wavenumber = 0;
  double fresnel_taper(double k) const;
  std::int32_t facet = -1;                 // the edge's first
  std::uint16_t part = 0, other_part = 0;  // of that facet and of the other one
  std::uint8_t bounces = 1;                // mirrors on both ways and every edge met
};

// The integral of e^{jk psi} along the stretch, m, an edge wave's range included, is what these leave of it at its
// ends: endpoint_term(1) e^{jk psi_1} - endpoint_term(0) e^{jk psi_0}. `share` of the way from one end to the other:
// between them the terms of two parts cancel.
Complex endpoint_term(const EdgeContribution& contribution, double k, double share);

// False between knife edges where the phase runs through less than ten cycles: the terms of the ends err by what the
// width changes in one.
bool endpoints_suffice(const EdgeContribution& contribution, double k);

// The same integral from one share of the way to another, about the phase halfway: also where psi does not change.
Complex interval_integral(const EdgeContribution& contribution, double k, double from, double to);

// hh, hv, vh, vv in metres.
std::array<Complex, 4> scattered(const EdgeContribution& contribution, double k);

}  // namespace seaglint
