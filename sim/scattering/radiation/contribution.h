// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Contribution to the scattered field: a pattern times the phase integral over a surface or along an edge,
//     S_pq = pattern_pq * integral of amplitude e^{jk psi},   psi: minus the two-way path, m.
// Its geometry is independent of frequency.
//
// Surface: the footprint of a beam, which carries the physical-optics current J = 2 n x H. With dS = d^2p / |n . k^| in
// the projection plane
//     S = -(jk / 2 pi) pattern integral e^{jk psi} d^2p,   pattern = p . [n x (k^ x E_q)] / |n . k^|
// (Balanis, Advanced Engineering Electromagnetics, eqs. 6-95, 7-54). Edge: an interval of equivalent currents, whose
// pattern is per metre. Single diffraction, multiple diffraction, double knife-edge terms and wall penumbrae differ in
// the amplitude law along the interval.

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "sim/scattering/coefficients/amplitude_laws.h"
#include "sim/scattering/geometry/image_transform.h"
#include "sim/scattering/geometry/moving_polygon.h"
#include "sim/scattering/observation/observation.h"
#include "sim/scattering/tracing/tracing_settings.h"

namespace seaglint {

struct CurvedFootprint;

// Where a contribution comes from.
struct ContributionSource {
  std::int32_t facet = -1;                 // first facet of the panel, or of the edge
  std::uint16_t part = 0, other_part = 0;  // of that facet; of the second one of an edge
  std::uint8_t bounces = 1;                // reflections on both paths plus the number of diffractions
  Mechanism mechanism = Mechanism::kPhysicalOptics;
};

// hh, hv, vh, vv of a surface current, or per metre of edge (after n grazing waves in m^(-(n - 1) / 2)).
struct Pattern {
  ScatteringMatrix value{};                    // at every wavenumber
  std::vector<ScatteringMatrix> at_node = {};  // where not empty in its place: at each wavenumber of the illumination

  const ScatteringMatrix& at(std::size_t node) const { return at_node.empty() ? value : at_node[node]; }
  Pattern& operator+=(const Pattern& other);  // constant, or at as many wavenumbers
  Pattern& operator*=(double factor);
};

// Pattern of the reciprocal path.
Pattern transposed(Pattern pattern);
// Mean of the pattern of a path and that of its reciprocal, `back`.
Pattern reciprocal_mean(Pattern pattern, const Pattern& back);

// Reflections on the path of a beam, as far as they determine how uncertain its contribution is.
struct BeamHistory {
  // Displacement of the beam on its last panel over that of the vertices of its reflectors, the root of a sum of
  // squares: a reflector of width b is tilted by 1 / b, and a beam of length l behind it is displaced by 2 l / b. 0 at
  // the first reflection.
  float displacement = 0;
  // Mean distance between consecutive reflections, m, where the panel and all reflectors belong to one part; else 0.
  float wall_distance = 0;
};

// Part of one panel that one beam illuminates and the receiver sees.
struct Footprint {
  MovingPolygon polygon;           // in the projection plane
  DepthPlane plane;                // of the panel's image
  ImageTransform image_transform;  // of the reflectors before the panel
  double psi0 = 0;                 // psi(p) = psi0 + w . p, m
  Vec2 w = Vec2::Zero();
  double psi_slope = 0;       // |gradient of psi| along the panel, 0..2
  double psi_slope_rate = 0;  // bound of its change per radian of look direction, 0..2
  double panel_size = 0;      // longest distance between two vertices of the panel, m
  BeamHistory history;
  std::shared_ptr<const CurvedFootprint> curvature;  // null when the facet and all reflectors are flat

  // Of the flat facet, m.
  double psi(const Vec2& p) const { return psi0 + w.dot(p); }
  // Dot product, m^2, of two steps on the panel, and length of one, m, given in the projection plane.
  double surface_dot(const Vec2& a, const Vec2& b) const { return a.dot(b) + plane.slope.dot(a) * plane.slope.dot(b); }
  double surface_length(const Vec2& step) const { return std::sqrt(surface_dot(step, step)); }
};

// Amplitude 1 along an interval, that of single diffraction.
struct UniformAmplitude {
  Complex at(double, double, double) const { return 1.0; }
};

// Amplitude law along an interval: at(k, fraction, run) is the dimensionless factor of the end-point term at a fraction
// 0..1 of the interval, run (rad, not zero) being the change of k psi over it.
using AmplitudeLaw = std::variant<UniformAmplitude, GrazingWaveAmplitude, DoubleKnifeEdge, WallPenumbraTerm>;

// Interval of an edge along which psi is linear.
struct EdgeInterval {
  std::array<double, 2> psi{};           // at the ends, m
  std::array<PathGradient, 2> gradient;  // at the ends, m
  double length = 0;                     // m
  AmplitudeLaw amplitude;
  // 2 d / depth^2 with d the distance between the edges and depth that of the shallower panel, rad/m. fresnel_taper()
  // reduces boundary and penumbra terms towards wavenumbers as low, at which the panel is no deeper than the transition
  // region and its opposite side contributes equally.
  double fresnel_wavenumber = 0;
  double fresnel_taper(double k) const;
};

struct Contribution {
  Pattern pattern;
  ContributionSource source;
  std::variant<Footprint, EdgeInterval> element;

  Contribution() = default;
  Contribution(Pattern of, const ContributionSource& from, Footprint surface)
      : pattern(std::move(of)), source(from), element(std::move(surface)) {}
  Contribution(Pattern of, const ContributionSource& from, const EdgeInterval& edge)
      : pattern(std::move(of)), source(from), element(edge) {}

  const Footprint* footprint() const { return std::get_if<Footprint>(&element); }
  const EdgeInterval* interval() const { return std::get_if<EdgeInterval>(&element); }
};

// Sets psi0, w and the surface slopes from plane and image transform. n_image: unit normal of the panel's image.
void set_phase(Footprint& footprint, const Vec3& n_image, const BistaticGeometry& geometry);

// Path gradient of the body-fixed point at p.
PathGradient phase_gradient(const Footprint& footprint, const Vec2& p, const RadarBasis& transmit);

// Of a vertex that slides on the panel as the look direction changes: adds w . slide to the transmitter's part.
PathGradient phase_gradient(const Footprint& footprint, const MovingVertex& vertex, const RadarBasis& transmit);

// Limits the slide rate of the polygon's vertices to `max`, m in the projection plane per radian. A shadow boundary
// slides at a rate equal to the distance between the obstructing edge and the panel. Only the intersection of two
// nearly parallel polygon sides moves faster, and it soon reaches the end of one of them, where the rate no longer
// predicts its position. The limit depends on the vertex alone, so that polygons with a common vertex keep a common
// rate.
void limit_slide_rate(Footprint& footprint, double max);

// End-point terms of the phase integral along the interval (m), amplitude law included: the integral is
// endpoint_term(1) e^{jk psi_1} - endpoint_term(0) e^{jk psi_0}. fraction 0..1 along the interval: at a common end the
// terms of two parts cancel.
Complex endpoint_term(const EdgeInterval& interval, double k, double fraction);

// False for double knife-edge terms whose phase changes by less than ten cycles over the interval: end-point terms then
// have an error of the change of the width within one cycle.
bool endpoints_suffice(const EdgeInterval& interval, double k);

// The phase integral over a part of the interval (fractions `from` to `to`) relative to the phase at its middle; valid
// also for constant psi.
Complex interval_integral(const EdgeInterval& interval, double k, double from, double to);

}  // namespace seaglint
