// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/tracing/illumination_settings.h"

#include <algorithm>

#include "sim/core/numbers/constants.h"

namespace seaglint {
namespace {

// Side of the smallest illuminated patch in radii of the body: 5 mm on the 144 m ship.
constexpr double kMinPatchSide = 0.7e-4;

// Distance between rays in radii of the target: 11 mm on the 144 m ship.
constexpr double kRaySpacing = 1.5e-4;

// Side of the smallest patch on a body of this radius, m.
double patch_side(double radius, const TracingSettings& settings) {
  const double coarsest = kMinPatchSide * radius;
  return settings.min_patch_m > 0 ? std::min(coarsest, settings.min_patch_m) : coarsest;
}

double smallest_radius(const Scatterer& scatterer) { return std::ranges::min(scatterer.bodies().radius); }

}  // namespace

TracingSettings tracing_settings(const SolverSpec& solver) {
  return {solver.min_patch_m, solver.max_bounces, solver.edges, {}, solver.method, solver.ray_spacing_m};
}

double default_ray_spacing(const Scatterer& scatterer) { return kRaySpacing * scatterer.radius(); }

double ray_spacing(const Scatterer& scatterer, const TracingSettings& settings) {
  return settings.ray_spacing_m > 0 ? settings.ray_spacing_m : default_ray_spacing(scatterer);
}

double default_min_patch(const Scatterer& scatterer) { return kMinPatchSide * smallest_radius(scatterer); }

double min_patch(const Scatterer& scatterer, const TracingSettings& settings) {
  return patch_side(smallest_radius(scatterer), settings);
}

double min_amplitude(const Scatterer& scatterer, const TracingSettings& settings, double k) {
  const double side = min_patch(scatterer, settings);
  return 0.1 * k * side * side / (2 * kPi);
}

SmallestAreas::SmallestAreas(const Scatterer& scatterer, const TracingSettings& settings)
    : surface_of_(scatterer.bodies().surface_of) {
  for (const double radius : scatterer.bodies().radius) {
    const double side = patch_side(radius, settings);
    of_surface_.push_back(side * side);
  }
}

}  // namespace seaglint
