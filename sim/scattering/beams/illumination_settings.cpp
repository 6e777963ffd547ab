// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/beams/illumination_settings.h"

#include <algorithm>

#include "sim/core/numbers/constants.h"

namespace seaglint {
namespace {

// Side of the smallest illuminated patch in target radii: 5 mm on the 144 m ship.
constexpr double kMinPatchSide = 0.7e-4;

}  // namespace

double default_min_patch(const Scatterer& scatterer) { return kMinPatchSide * scatterer.radius(); }

double min_patch(const Scatterer& scatterer, const TracingSettings& settings) {
  const double coarsest = default_min_patch(scatterer);
  return settings.min_patch_m > 0 ? std::min(coarsest, settings.min_patch_m) : coarsest;
}

double smallest_area(const Scatterer& scatterer, const TracingSettings& settings) {
  const double side = min_patch(scatterer, settings);
  return side * side;
}

double min_amplitude(const Scatterer& scatterer, const TracingSettings& settings, double k) {
  return 0.1 * k * smallest_area(scatterer, settings) / (2 * kPi);
}

}  // namespace seaglint
