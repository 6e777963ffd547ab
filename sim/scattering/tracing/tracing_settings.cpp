// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/tracing/tracing_settings.h"

#include <algorithm>
#include <array>

#include "sim/core/numbers/constants.h"

namespace seaglint {

namespace {

bool selected(const ContributionFilter& filter, int part, int bounces, Mechanism mechanism) {
  const auto &only = filter.included, &without = filter.excluded;
  if (only.empty() && without.empty()) return true;
  const std::array<int, 3> of{part, bounces, static_cast<int>(mechanism)};
  const auto meets = [&](const ContributionSelector& s) { return of[static_cast<std::size_t>(s.kind)] == s.value; };
  if (std::any_of(without.begin(), without.end(), meets)) return false;
  return std::all_of(only.begin(), only.end(), [&](const ContributionSelector& named) {
    return std::any_of(only.begin(), only.end(),
                       [&](const ContributionSelector& s) { return s.kind == named.kind && meets(s); });
  });
}

}  // namespace

bool ContributionFilter::is_cavity(int part) const {
  return std::find(cavities.begin(), cavities.end(), part) != cavities.end();
}

bool ContributionFilter::accepts(int part, int bounces, Mechanism mechanism) const {
  return !is_cavity(part) && selected(*this, part, bounces, mechanism);
}

bool ContributionFilter::accepts_edge(int part, int other_part, int bounces, Mechanism mechanism) const {
  if (is_cavity(part) && is_cavity(other_part)) return false;
  return selected(*this, is_cavity(part) ? other_part : part, bounces, mechanism);
}

bool ContributionFilter::accepts_cavity(int part) const { return selected(*this, part, 1, Mechanism::kPhysicalOptics); }

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

}  // namespace

TracingSettings tracing_settings(const SolverSpec& solver) {
  return {solver.min_patch_m, solver.max_bounces, solver.edges, {}, solver.method, solver.ray_spacing_m};
}

double ray_spacing(const Scatterer& scatterer, const TracingSettings& settings) {
  return settings.ray_spacing_m > 0 ? settings.ray_spacing_m : kRaySpacing * scatterer.radius();
}

double min_patch(const Scatterer& scatterer, const TracingSettings& settings) {
  return patch_side(std::ranges::min(scatterer.bodies().radius), settings);
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
