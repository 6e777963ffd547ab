// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Windows over which two asymptotic forms of edge diffraction replace each other: full weight at or below the first
// value, none at or above the second, smooth_taper() between. They are chosen, not derived: meaning, unit and origin
// are given here, the change of the references when a window is moved in README.md, "Fade windows".

#include <array>
#include <span>

#include "sim/core/numbers/linear.h"

namespace seaglint {

using FadeWindow = std::array<double, 2>;

// Fringe currents on paths via reflectors: cosine of the angle from the forward direction of the incident wave, 90 and
// 30 deg. Nearer, the field towards a reflector at a finite distance is no separate ray: the end-point contribution of
// the beam on that reflector contains it.
inline constexpr FadeWindow kFringeForwardWindow{0, 0.8660254037844387};

// Diffracted field of an edge, which is separable from the beam: the same cosine, 18 and 2.6 deg, beyond the angular
// width of the transition region at distances of tens to thousands of wavelengths.
inline constexpr FadeWindow kDiffractionForwardWindow{0.95, 0.999};

// Grazing treatment of reflectors (double_bounce_weight()), and the complement for the diffracted field of a
// reflector's edge: sine of the grazing angle, 2 and 6 deg. The beam, the direct wave and the diffracted wave overlap
// there.
inline constexpr FadeWindow kGrazingWindow{0.035, 0.11};

// Length of a reflector along the path relative to the height of the other one over it, from which on it contains the
// image.
inline constexpr FadeWindow kCoverageWindow{1, 2};

// Diffracted field towards reflectors: component along the edge by which an exit direction departs from Keller's cone,
// off which only the ends of the edge radiate.
inline constexpr FadeWindow kOffConeWindow{0.1, 0.2};

// Behind three reflectors: angle from the specular direction, rad. Below the first value the poles of both end-point
// contributions must cancel, above the second each may be used alone.
inline constexpr FadeWindow kOffSpecularWindow{0.1, 0.2};

// End-point contributions at shadow-boundary lines: slope of psi across the line. Below the first value the
// contribution stays on the line, above the second it is moved to the edge. Both contributions grow as 1 / slope, and
// an interval of pulses changes the slope by some thousandths. The phase difference k d slope^2 / 2 between the two is
// neglected below.
inline constexpr FadeWindow kSlopeWindow{0.03, 0.08};

// Double knife-edge diffraction on the axis: k d slope^2 / 2, rad, the phase by which a moved end-point contribution
// differs, for edges whose contributions do not move.
inline constexpr FadeWindow kAxialPhaseWindow{0, 1};

// Path from edge to edge against the beam: rad, limit of the paraxial Fresnel form.
inline constexpr FadeWindow kParaxialWindow{0.2, 0.5};

// Sine of the angle between two edges, which near their crossing affect no more than lambda d.
inline constexpr FadeWindow kSkewWindow{0.3, 0.7};

// Boundary and penumbra terms: 2 d / (k depth^2), 1 where the panel is as deep as the transition region (2 d / k)^(1/2)
// is wide.
inline constexpr FadeWindow kFresnelDepthWindow{1, 2.5};

// Wall penumbra: sine of the grazing angle over the face, 37 and 64 deg.
inline constexpr FadeWindow kPenumbraAngleWindow{0.6, 0.9};

// Edge of a thin sheet: |cos phi| at which the current along its normal vanishes, from zero for a dielectric. Below the
// first value this zero is split by Wiener and Hopf, above the second it is far from every direction and the sheet has
// the impedance of the angle (material_edge.h).
inline constexpr FadeWindow kNormalPolarisationWindow{0.8, 1.2};

// The same of the odd part, whose zeros count while the sheet is weak: its admittance at normal incidence, infinite for
// a perfect conductor.
inline constexpr FadeWindow kSheetAdmittanceWindow{1.5, 3};

// Angle from a shadow or reflection boundary within which equivalent edge currents are fringe currents, rad; a sharp
// limit, for paths without reflectors and for the diffracted field towards reflectors, whose growth near the shadow
// boundary diffraction_forward_taper() removes.
inline constexpr double kShadowBoundaryGuard = 0.26, kReflectedBoundaryGuard = 0.04;

// Smooth-surface shadow boundary: the current is tapered as t^3 (10 - 15 t + 6 t^2), t = sin(elevation over the
// surface) / (kTransitionZoneWidth (kappa / k)^(1/3)), 0..1. (kappa / k)^(1/3) is the width of Fock's transition region
// (V. A. Fock, J. Phys. USSR 10, 1946, 130-136). Half of that width separates the taper from the specular zone down to
// kR = 15; values of 0.3 to 2 give equal results above kR = 40.
inline constexpr double kTransitionZoneWidth = 0.5;

// Tapers about the forward direction. k_hat: direction of the incident wave, s: of the diffracted ray, both unit.
double fringe_forward_taper(const Vec3& k_hat, const Vec3& s);
double diffraction_forward_taper(const Vec3& k_hat, const Vec3& s);

// Weight of the grazing treatment: 1 at grazing incidence, 0 away from it, for a direction s over a surface with normal
// n, both unit.
double grazing_taper(const Vec3& s, const Vec3& n);

// Weights of forms that describe the same part of a field. The weights of two complementary forms sum to one.
//
// 1. Last reflectors at near-grazing angles, such as decks at low elevation, for one antenna. Physical optics lets only
//    the last reflector of a path radiate. The wave that a wall of height h reflects down to a deck ends there at h /
//    tan a (a: grazing angle), and in directions other than the specular one the deck radiates only the end-point
//    contributions of this boundary, each proportional to 1 / slope. The reciprocal path, via the deck to the wall, has
//    the transposed matrix; there the wall radiates, whose boundary is that of the body. With the weight
//    grazing_taper(), where the last reflector is long enough to contain the image of the first one, a path whose first
//    reflector is not at grazing incidence is replaced by its reciprocal, and a path from a reflector to a wall on it,
//    upright or leaning, possibly via others, and back via the same reflector or one parallel to it by the direct
//    radiation of the wall's image in the reflector. Over an unbounded deck both are exact (reciprocity and images:
//    Balanis, Advanced Engineering Electromagnetics, 7.5, 7.4).
// 2. The diffracted field of a reflector's edge towards later reflectors (radiation/edge_diffraction.h), and the fringe
//    current of the beam that it bounds.
// 3. That field, and the penumbra term at the foot of a wall behind the edge (radiation/multiple_diffraction.h).
// 4. The face-grazing wave that the wall reflects (radiation/multiple_diffraction.h), and the penumbra term of the path
//    from the edge to the wall and back, for the magnetic field parallel to the face.

struct ReflectorPanel {
  Vec3 normal;                    // unit, of either sign
  std::span<const Vec3> outline;  // of the panel
};

// Weight 0..2 of a path via a first and a last reflector, for one antenna along r; above 1 it includes the reciprocal
// path. The weights of a path and of its reciprocal sum to two.
double double_bounce_weight(const Vec3& r, const ReflectorPanel& first, const ReflectorPanel& last);

// The same for paths via three and more reflectors, `before` the one before the last.
double multiple_bounce_weight(const Vec3& r, const ReflectorPanel& first, const ReflectorPanel& before,
                              const ReflectorPanel& last);

// Weight 0..1 with which the wall's image in the reflector replaces the path from the reflector to the wall and back,
// the complement of multiple_bounce_weight(); 0 where the angle between the two is below 41 deg.
double image_weight(const Vec3& r, const ReflectorPanel& reflector, const ReflectorPanel& wall);

// Taper 0..1: 1 where the beam along `beam` meets a reflector (normal `last`, of either sign) on the side of the exit
// direction s, 0 where the beam is closer to grazing incidence than the exit path, so that its boundary lies far away
// or does not exist.
double beam_incidence_taper(const Vec3& beam, const Vec3& s, const Vec3& last);

// Weight 0..1 of the diffracted field of a reflector's edge, for a wave along k_hat on a face with normal n and an exit
// direction s towards a reflector with normal `last`: 0 near the forward direction, where wave or exit path graze a
// reflector, and off Keller's cone about the edge (direction t), where only the ends of the edge radiate.
double reflected_edge_weight(const Vec3& n, const Vec3& t, const Vec3& k_hat, const Vec3& s, const Vec3& last);

// Weights of the penumbra terms of a wall that stands upright on the face behind an edge, for one antenna at the sine
// of the grazing angle over the face, in the plane normal to edge and wall.
struct PenumbraWeights {
  double foot;       // complement of reflected_edge_weight() via the wall
  double edge_path;  // complement of grazing_wave_weight() via the wall, for H parallel to the face
};
PenumbraWeights penumbra_weights(double sine);

// Weight 0..1 of a face-grazing wave that walls reflect, or that starts at a concave edge: k_hat the direction of the
// wave at the edge that launches it, s the exit direction unfolded to that edge.
double grazing_wave_weight(const Vec3& k_hat, const Vec3& s);

}  // namespace seaglint
