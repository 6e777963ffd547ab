// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Echo of Luneburg lenses with a reflecting cap. A sphere of radius a and relative permittivity 2 - (x / a)^2, x the
// distance from its centre, focuses a plane wave on the point of its surface opposite to the incidence (R. K. Luneburg,
// Mathematical Theory of Optics, 1944, sec. 29). A metal cap about this point returns the wave.
//
// Geometrical optics. A ray that enters at the transverse offset p leaves towards the radar at -p: the reflector is a
// point reflection, as a corner reflector. The path from the plane through the centre c to the focus is
//     a integral of sqrt(2 - x^2) from -1 to 1, less a  =  a pi / 2
// at every offset. The cap changes the sign of the field, and so does the focus (L. G. Gouy, 1890), so that E' = +E, as
// of three reflections and opposite to a plate. In image space the path is the point reflection x -> 2 c' - x,
// c' = c - r^ a pi / 2. The aperture is the part of the disc of radius a through which rays enter and leave. The whole
// disc has the radar cross-section 4 pi (pi a^2)^2 / lambda^2 = 4 pi^3 a^4 / lambda^2.

#include <span>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/scattering/radiation/contribution.h"
#include "sim/scattering/scatterer/scatterer.h"
#include "sim/scattering/tracing/visible_surface.h"

namespace seaglint {

struct LuneburgLens {
  Vec3 centre = Vec3::Zero();  // in the frame of the scatterer, m
  double radius = 0;           // m
  Vec3 axis = Vec3::UnitX();   // unit, from the middle of the cap to the centre
  double cap_half_angle = 0;   // seen from the centre, rad
  double amplitude = 1;        // factor of its loss, 0..1
  std::vector<int> facets;     // its surface outside the cap
};

// The lenses of a scatterer: connected surfaces with facets of the kind kLens, by the sphere through the corners of
// these facets and the circle in which they border on the cap. A lens without cap has no echo and is left out. Throws
// InputError where they are not on a sphere.
std::vector<LuneburgLens> luneburg_lenses(const Scatterer& scatterer);

// Share of the focal spot's power on the cap, 0..1. The spot is the Airy pattern (2 J1(u) / u)^2, the rim of the cap a
// straight line at the distance u = k a angle from its middle, positive where the middle is on the cap. The amplitude
// of the echo has this factor, since the cap returns the reaction of the focal field with itself.
double focal_spot_on_cap(double u);

struct LensReflectionRequest {
  const Scatterer& scatterer;
  std::span<const LuneburgLens> lenses;
  const BistaticGeometry& antennas;
  const VisibleSurface &illuminated, &seen;  // surfaces visible to the transmitter and to the receiver
  std::span<const double> wavenumbers;
  const TracingSettings& settings;
};

// Footprints on the aperture of every lens, at all wavenumbers, for receivers in the half-space of the transmitter: the
// illuminated parts of its surface whose rays leave through parts that the receiver sees.
std::vector<Contribution> lens_reflection(const LensReflectionRequest& request);

}  // namespace seaglint
