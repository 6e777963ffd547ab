// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/target/target_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"

namespace seaglint {
namespace {

// Smallest size in wavelengths: physical optics of a plate this wide has an error of 1 dB at normal incidence.
constexpr double kMinWavelengths = 3;
constexpr double kLongestTarget_m = 5e3;  // ten times the longest ships
// Half-sizes from the origin, warning and error: the echo is exact there too, but such a centre of rotation is hardly
// meant.
constexpr double kFarOrigin = 10, kTooFarOrigin = 300;
constexpr std::size_t kManyTriangles = 1'000'000;
// Memory and time per million triangles on two cores, measured on a wavy sheet of 10 million and on a mesh of 2 million
// with all edges sharp.
constexpr double kGigabytesOfSmooth = 0.9, kGigabytesOfSharp = 2;
constexpr double kSecondsToBuild = 8, kSecondsOfSmooth = 5, kSecondsOfSharp = 22;

constexpr double kNarrow = 1.0 / 3;  // wavelengths
// wavelengths: error 0.2 dB (soft) and 0.8 dB (hard) of a strip's echo (sim/scattering/diffraction/README.md, "Thick
// sheets").
constexpr double kThickSheet = 0.1;

// Area of the panel of a facet, m^2.
double panel_area(const Scatterer& scatterer, int facet) {
  double area = 0;
  for (const int member : scatterer.panels().members(scatterer.panels().representative(facet))) {
    const auto& corner = scatterer.facets()[member].corner;
    area += 0.5 * (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm();
  }
  return area;
}

}  // namespace

std::vector<std::string> check_target(const TriangleMesh& mesh, double lowest_hz) {
  std::vector<std::string> found;
  const Bounds box = bounds(mesh);
  const Vec3 size = box.upper - box.lower, centre = (box.upper + box.lower) / 2;
  const double longest = size.norm(), wavelength = kSpeedOfLight / lowest_hz;
  if (longest > kLongestTarget_m)
    found.push_back(fmt::format("the target is {:.4g} m across; is its unit right?", longest));
  if (longest < kMinWavelengths * wavelength) {
    found.push_back(fmt::format(
        "the target is {:.3g} m across, {:.3g} wavelengths at {:g} GHz; physical optics needs {:g} and more{}", longest,
        longest / wavelength, lowest_hz * 1e-9, kMinWavelengths, longest < 0.01 ? "; is its unit right?" : ""));
  }

  const double distance = centre.norm() / std::max(longest / 2, 1e-300);
  if (distance > kTooFarOrigin) {
    throw InputError(
        fmt::format("the target of {:.4g} m is centred {:.4g} m from the origin, its centre of rotation and phase "
                    "centre: translate the mesh",
                    longest, centre.norm()));
  }
  if (distance > kFarOrigin)
    found.push_back(
        fmt::format("the target of {:.4g} m is centred {:.4g} m from the origin, its centre of rotation and phase "
                    "centre",
                    longest, centre.norm()));

  if (mesh.triangles.size() > kManyTriangles) {
    const double millions = 1e-6 * static_cast<double>(mesh.triangles.size());
    const auto of_all = [&](double per_million) { return std::ceil(per_million * millions); };
    found.push_back(fmt::format(
        "{:.1f} million triangles: expect {:.0f} to {:.0f} GB of memory, the more the more of its edges are "
        "sharp, about {:.0f} s before the first view and {:.0f} to {:.0f} s for every view",
        millions, of_all(kGigabytesOfSmooth), of_all(kGigabytesOfSharp), of_all(kSecondsToBuild),
        of_all(kSecondsOfSmooth), of_all(kSecondsOfSharp)));
  }
  return found;
}

std::vector<std::string> check_edges(const Scatterer& scatterer, bool followed, double lowest_hz, double highest_hz) {
  const double longest = kSpeedOfLight / lowest_hz, shortest = kSpeedOfLight / highest_hz,
               thickness = scatterer.sheet_thickness();
  const auto no_effect = [&](const char* why) {
    return fmt::format("sheet thickness of {:g} mm has no effect: {}", 1e3 * thickness, why);
  };
  if (!followed) return thickness > 0 ? std::vector{no_effect("edges are off")} : std::vector<std::string>{};
  double all = 0, narrow = 0;
  for (const SharpEdge& edge : scatterer.edges().edges) {
    const double length = edge.length();
    all += length;
    const auto is_narrow = [&](int facet) { return panel_area(scatterer, facet) < kNarrow * longest * length; };
    if (length > longest && is_narrow(edge.facet[0]) && is_narrow(edge.facet[1])) narrow += length;
  }
  // Edges of materials have no thickness.
  const SharpEdges& edges = scatterer.edges();
  const bool any_free_edge = std::ranges::any_of(edges.panel_edges, [&](const PanelEdge& side) {
    const SharpEdge& edge = edges.edges[side.edge];
    return edge.conducts && edge.front_wedge.thickness_m > 0;
  });
  std::vector<std::string> found;
  if (narrow > 0) {
    found.push_back(
        fmt::format("{:.3g} m of {:.3g} m of diffracting edges belong to bars or strips narrower than a third of a "
                    "wavelength at {:g} GHz: half-plane diffraction overestimates their echo",
                    narrow, all, lowest_hz * 1e-9));
  }
  if (thickness > 0 && !any_free_edge) {
    found.push_back(no_effect("no surface is open and a perfect conductor"));
  } else if (thickness > kThickSheet * shortest) {
    found.push_back(
        fmt::format("sheets of {:g} mm are {:.2g} wavelengths thick at {:g} GHz: the correction of their edge "
                    "diffraction is of first order, valid up to a tenth",
                    1e3 * thickness, thickness / shortest, highest_hz * 1e-9));
  }
  return found;
}

void check_wavefront_range(double radius_m, double range_m) {
  constexpr double kNearestRadii = 10;
  if (range_m > 0 && range_m < kNearestRadii * radius_m) {
    throw InputError(fmt::format("wavefront range {} m: must be at least ten times the target radius of {:.3g} m",
                                 range_m, radius_m));
  }
}

}  // namespace seaglint
