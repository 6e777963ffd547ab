// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/beams/illumination_settings.h"

#include <algorithm>

#include "sim/core/numbers/constants.h"

namespace seaglint {
namespace {

// Side of the smallest illuminated patch in target radii: 5 mm on the 144 m ship.
constexpr double kMinPatchSide = 0.7e-4;
// A lattice of rays detects most patches whose side is a fourteenth of its spacing, given one more ray within every
// corner.
constexpr double kSpacingPerSide = 14;

}  // namespace

double smallest_area(const Scatterer& scatterer, const TracingSettings& settings) {
  const double side = ray_spacing(scatterer, settings) / kSpacingPerSide;
  return side * side;
}

double default_ray_spacing(const Scatterer& scatterer) { return kSpacingPerSide * kMinPatchSide * scatterer.radius(); }

double ray_spacing(const Scatterer& scatterer, const TracingSettings& settings) {
  const double coarsest = default_ray_spacing(scatterer);
  return settings.ray_spacing_m > 0 ? std::min(coarsest, settings.ray_spacing_m) : coarsest;
}

double min_amplitude(const Scatterer& scatterer, const TracingSettings& settings, double k) {
  return 0.1 * k * smallest_area(scatterer, settings) / (2 * kPi);
}

}  // namespace seaglint
