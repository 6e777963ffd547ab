// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/target_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/core/constants.h"
#include "sim/core/error.h"

namespace seaglint {
namespace {

constexpr double kFewestWavelengths = 3;    // physical optics of a plate this wide is off by a dB at its normal
constexpr double kLongestTarget_m = 5e3;    // no ship is longer than a tenth of it
constexpr double kFarOrigin = 10;           // half-sizes from the origin; polygons below 2e-9 radius^2 are left out
constexpr double kTooFarOrigin = 300;       // then 2e-4 half-sizes squared
constexpr double kMostRays = 1e8;           // 7 GB when they start from one facet
constexpr std::size_t kManyTriangles = 1'000'000;
constexpr double kGigabytesPerMillion = 1, kSecondsPerMillion = 10;

}  // namespace

std::vector<std::string> check_target(const TriangleMesh& mesh, double lowest_hz, double ray_spacing_m) {
  std::vector<std::string> found;
  const Bounds box = bounds(mesh);
  const Vec3 size = box.upper - box.lower, centre = (box.upper + box.lower) / 2;
  const double longest = size.norm(), wavelength = kSpeedOfLight / lowest_hz;
  if (longest > kLongestTarget_m) found.push_back(fmt::format("the target is {:.4g} m across; is its unit right?", longest));
  if (longest < kFewestWavelengths * wavelength) {
    found.push_back(fmt::format("the target is {:.3g} m across, {:.3g} wavelengths at {:g} GHz; physical optics needs {:g} and more{}", longest,
                                longest / wavelength, lowest_hz * 1e-9, kFewestWavelengths, longest < 0.01 ? "; is its unit right?" : ""));
  }

  const double distance = centre.norm() / std::max(longest / 2, 1e-300);
  if (distance > kTooFarOrigin) {
    throw InputError(fmt::format("the target of {:.4g} m lies {:.4g} m from its origin, about which it turns and has its phase: move it there", longest, centre.norm()));
  }
  if (distance > kFarOrigin) found.push_back(fmt::format("the target of {:.4g} m lies {:.4g} m from its origin; details below {:.2g} m are left out", longest, centre.norm(), 4.5e-5 * (centre.norm() + longest / 2)));

  // The widest of the box's three shadows holds the lattice of rays of a view.
  const double radius = centre.norm() + longest / 2, spacing = ray_spacing_m > 0 ? ray_spacing_m : std::min(0.1, 0.04 * radius);
  const double shadow = std::max({size.x() * size.y(), size.y() * size.z(), size.z() * size.x()});
  const double rays = shadow / (spacing * spacing);
  if (rays > kMostRays) {
    throw InputError(fmt::format("a target of {:.4g} x {:.4g} x {:.4g} m at a ray spacing of {:.3g} m needs {:.2g} rays for each view: at most {:g}; give "
                                 "--ray-spacing-m {:.2g} or more{}",
                                 size.x(), size.y(), size.z(), spacing, rays, kMostRays, std::sqrt(shadow / kMostRays) * 1.05,
                                 longest > kLongestTarget_m ? ", or is the unit wrong?" : ""));
  }
  if (mesh.triangles.size() > kManyTriangles) {
    const double millions = 1e-6 * static_cast<double>(mesh.triangles.size());
    found.push_back(fmt::format("{:.1f} million triangles: expect about {:.0f} GB of memory and {:.0f} s before the first view, as long again for each view",
                                millions, std::ceil(kGigabytesPerMillion * millions), std::ceil(kSecondsPerMillion * millions)));
  }
  return found;
}

}  // namespace seaglint
