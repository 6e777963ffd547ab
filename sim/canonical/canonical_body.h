// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Perfectly conducting bodies whose echo is known - sphere (its exact series), rectangular plate, dihedral and
// trihedral corner reflectors (closed forms about their axes) - recognised from their mesh, and their scattering
// matrices.

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scattering/observation/observation.h"

namespace seaglint {

enum class CanonicalShape { kSphere, kPlate, kDihedral, kTriangularTrihedral, kSquareTrihedral };

struct CanonicalBody {
  CanonicalShape shape = CanonicalShape::kSphere;
  // Sphere: its centre. Plate: its centre. Dihedral: the middle of its seam. Trihedral: its apex. m, body frame.
  Vec3 centre_m = Vec3::Zero();
  // Sphere: its radius. Plate: its sides. Dihedral: depth of a face, length of the seam. Trihedral: its leg. m.
  double a_m = 0, b_m = 0;
  // Columns, unit vectors. Plate: along a, along b, normal. Dihedral: from the seam into each face, along the seam.
  // Trihedral: along its legs, from the apex.
  Mat3 axes = Mat3::Identity();
};

// "sphere of radius 0.3 m", "triangular trihedral of legs 0.5 m".
std::string text_of(const CanonicalBody& body);

// The body that a mesh in metres samples; absent for any other mesh. Faces meet at 90 +- 0.1 deg, sides and legs that
// are equal agree within 2e-3, facets cover their face once within 4e-3 of its area. The vertices of a sphere lie
// within 2e-3 of its radius, its facets are closed and have 0.97 of its area at least.
std::optional<CanonicalBody> canonical_body(const TriangleMesh& mesh);

// The body of canonical_body(), or the spheres that all connected components of the mesh sample; empty for others.
std::vector<CanonicalBody> canonical_bodies(const TriangleMesh& mesh);

// Mie series of a perfectly conducting sphere (Bohren and Huffman, Absorption and Scattering of Light by Small
// Particles, 1983, chapter 4).
class MieSeries {
 public:
  explicit MieSeries(double ka);  // circumference over wavelength, > 0

  // Amplitude functions S_1, E normal to the scattering plane, and S_2, E in it (eq. 4.74), of e^{-iwt}.
  // cosine: of the scattering angle, 1 forward, -1 backscatter.
  std::pair<Complex, Complex> amplitudes(double cosine) const;

 private:
  std::vector<Complex> a_, b_;  // of order 1, 2, ...
};

struct CanonicalEcho {
  std::array<Complex, 4> matrix_m;  // hh, hv, vh, vv in metres, phase origin at the body's origin
  double relative_error = 0;        // of the amplitude; 0: exact
};

// Scattering matrix of one body at one frequency.
class CanonicalSolution {
 public:
  CanonicalSolution(const CanonicalBody& body, double frequency_hz);

  // Absent where the body's form does not apply. Sphere: any directions. All others are monostatic, of sides a for
  // which k a >= 20, with the relative error 3 / (k a) of their shortest side (edge diffraction): plate: physical
  // optics within 3 dB of its normal (Balanis, Advanced Engineering Electromagnetics, example 11-3), peak 4 pi a^2 b^2
  // / lambda^2; dihedral: within 0.5 deg of the bisector about its seam and 0.3 dB of it along its seam, peak 8 pi a^2
  // b^2 / lambda^2; triangular trihedral: within 5 deg of its axis (Bonkowski, Lubitz and Schensted, University of
  // Michigan, 1953), peak 4 pi a^4 / (3 lambda^2); square trihedral: within 1 deg of its axis, 12 pi a^4 / lambda^2.
  // Peaks: Knott, Shaeffer and Tuley, Radar Cross Section, table 6.1.
  std::optional<CanonicalEcho> at(const BistaticGeometry& geometry) const;

 private:
  CanonicalEcho of_sphere(const BistaticGeometry& geometry) const;
  // Effective aperture (m^2) over the wavelength times the polarisation dyad; absent outside of its range.
  std::optional<CanonicalEcho> of_reflector(const RadarBasis& basis) const;

  CanonicalBody body_;
  double wavenumber_;             // rad/m
  std::optional<MieSeries> mie_;  // of a sphere
};

}  // namespace seaglint
