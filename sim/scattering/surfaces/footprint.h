// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A footprint: a piece of one facet, lit through one sequence of flat mirrors and seen by the radar. Its geometry holds
// for all frequencies; only its phase integral depends on k.

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "sim/scattering/beams/moving_polygon.h"

namespace seaglint {

// The radar's direction and polarisation basis in the body frame: r^ x h = v (CONVENTIONS.md, "Scattering").
struct RadarBasis {
  Vec3 r = Vec3::UnitX();
  Vec3 h = Vec3::UnitY();
  Vec3 v = Vec3::UnitZ();
};

// Where the wave comes from and where its echo is received, each with the polarisation basis of its own direction.
struct AntennaPair {
  RadarBasis transmit;
  RadarBasis receive;
  bool monostatic = true;  // receive is transmit
};
AntennaPair monostatic(const RadarBasis& basis);
AntennaPair bistatic(const RadarBasis& transmit, const RadarBasis& receive);

// By which current an echo arises.
enum class Mechanism : std::uint8_t {
  kPhysicalOptics,  // surface currents of geometrical optics
  kEdge,            // fringe currents at sharp edges
};

// h = z^ x r^ / |z^ x r^| (y^ when r^ is vertical), v = r^ x h.
RadarBasis radar_basis(const Vec3& r_hat);

// Reflections in planes, composed: image = L real + t, with L orthogonal.
struct Mirror {
  Mat3 L = Mat3::Identity();
  Vec3 t = Vec3::Zero();

  Vec3 image(const Vec3& real) const { return L * real + t; }
  Vec3 real(const Vec3& image) const { return L.transpose() * (image - t); }
};

// One after the other: first b.
inline Mirror operator*(const Mirror& a, const Mirror& b) { return {a.L * b.L, a.L * b.t + a.t}; }

// By the plane n . x = offset, n unit.
inline Mirror plane_mirror(const Vec3& n, double offset) {
  return {Mat3::Identity() - 2 * n * n.transpose(), 2 * offset * n};
}

// A direction as the plane with unit normal n mirrors it.
inline Vec3 mirrored(const Vec3& x, const Vec3& n) { return x - 2 * n.dot(x) * n; }

// A facet's plane seen along the unfolded ray: height above the aperture plane z(p) = z0 + slope . p, positive towards
// the radar.
struct ImagePlane {
  double z0 = 0;
  Vec2 slope = Vec2::Zero();

  double at(const Vec2& p) const { return z0 + slope.dot(p); }
  // z as a moving line. Turning r^ moves it by dz/dd_i = p_i + z slope_i at fixed p.
  MovingLine moving() const;
};

// The plane n . x = offset (image space, n need not point to the radar); n . r^ must not vanish.
ImagePlane image_plane(const Vec3& n, double offset, const RadarBasis& basis);

struct Curvature;

struct Footprint {
  MovingPolygon polygon;  // in the aperture plane
  ImagePlane plane;       // of the last facet's image
  Mirror mirrors;         // of the facets before the last
  double psi0 = 0;        // minus the two-way path, psi(p) = psi0 + w . p, m
  Vec2 w = Vec2::Zero();
  double surface_slope = 0;          // |gradient of psi| along the facet itself, 0..2
  double surface_slope_turn = 0;     // bound of its change per radian of turn, 0..2
  double facet_size = 0;             // longest distance of two corners of its panel, m
  std::array<Complex, 4> pattern{};  // hh, hv, vh, vv (received, transmitted) of n x (k^ x E) / |n . k^|
  // The same for each of the illumination's wavenumbers where a material on the way makes it depend on them, pattern
  // being the middle one; empty where pattern serves all.
  std::vector<std::array<Complex, 4>> patterns;
  int facet = -1;          // the last one
  std::uint16_t part = 0;  // its part
  std::uint8_t bounces = 1;
  std::shared_ptr<const Curvature> curvature;  // null when the facet and all mirrors are flat

  // Of the flat facet.
  double psi(const Vec2& p) const { return psi0 + w.dot(p); }
  // Length on the facet of a step in the aperture, m.
  double surface_length(const Vec2& step) const {
    const double rise = plane.slope.dot(step);
    return std::sqrt(step.squaredNorm() + rise * rise);
  }
};

// Fills psi0, w and the surface slopes from plane and mirrors. n_image: unit normal of the last facet's image.
void set_phase(Footprint& footprint, const Vec3& n_image, const AntennaPair& antennas);

// How psi changes as the directions turn, m: d psi = transmit . d r^_t + receive . d r^_s. One direction for both:
// their sum. Points of the body give their places, x_image to the transmitter and x_real to the receiver (Fermat);
// corners that slip in the body give more.
struct PathGradient {
  Vec3 transmit = Vec3::Zero();
  Vec3 receive = Vec3::Zero();
  Vec3 transmit_slip = Vec3::Zero(), receive_slip = Vec3::Zero();  // what of them is slip

  Vec3 sum() const { return transmit + receive; }
};

// On the way from a to b, 0 <= s <= 1.
PathGradient between(const PathGradient& a, const PathGradient& b, double s);

// For the body-fixed point at p.
PathGradient phase_gradient(const Footprint& footprint, const Vec2& p, const RadarBasis& transmit);

// The same for a corner that moves in the facet as the direction turns: adds w . slip to the transmitter's part.
PathGradient phase_gradient(const Footprint& footprint, const Corner& corner, const RadarBasis& transmit);

// Slows corners down that slip in the facet by more than `most`, m of the aperture per radian. A shadow edge slips by
// the distance between what casts it and the facet; only where two edges cross that are nearly parallel a corner runs
// faster, and soon off the end of one of them, so that its way cannot be told from its speed. The speed is the corner's
// own: pieces that share it still do.
void limit_slip(Footprint& footprint, double most);

// I(k) = integral over the footprint of e^{jk psi(p)} d^2p, m^2. Gordon's contour form (W. B. Gordon, IEEE Trans.
// AP-23, 1975, 590-592), by the divergence theorem with F = w e^{jk w.p} / (jk |w|^2); a series where |w| is small.
// With curvature the sum of curved_terms, fading included.
Complex phase_integral(const Footprint& footprint, double k);

// (e^{jx} - 1)/(jx) e^{-jx/2} = sin(x/2)/(x/2)
double sinc(double x);

// S = -jk/(2 pi) pattern I(k): physical optics, E_s = -(jk eta / 4 pi) (e^{-jkr}/r) integral (J - r^ r^.J) e^{jk r^.x}
// dS with J = 2 n x H (Balanis, Advanced Engineering Electromagnetics, eqs. 6-95, 7-54), dS = d^2p / |n . k^|. Elements
// hh, hv, vh, vv in metres. k is the illumination's wavenumber number `index` where materials make the pattern depend
// on it.
std::array<Complex, 4> scattered(const Footprint& footprint, double k, std::size_t index = 0);

}  // namespace seaglint
