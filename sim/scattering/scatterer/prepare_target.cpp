// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/scatterer/prepare_target.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/placement/waterline.h"

namespace seaglint {

namespace {

constexpr double kNarrow = 1.0 / 3, kThinBar = 0.7;  // wavelengths
// wavelengths: error 0.2 dB (soft) and 0.8 dB (hard) of a strip's echo (sim/scattering/coefficients/README.md, "Thick
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

// Lengths by part.
class LengthByPart {
 public:
  void add(std::uint16_t part, double length) {
    if (of_part_.size() <= part) of_part_.resize(part + 1u, 0);
    of_part_[part] += length;
    total_ += length;
  }
  double total() const { return total_; }
  // "; most of it: part 'x'"; empty without names.
  std::string longest(std::span<const std::string> names) const {
    const auto part = static_cast<std::size_t>(std::ranges::max_element(of_part_) - of_part_.begin());
    return part < names.size() ? fmt::format("; most of it: part '{}'", names[part]) : "";
  }

 private:
  std::vector<double> of_part_;
  double total_ = 0;
};

// Whether a sharp edge of materials has no diffraction coefficient (Scatterer): concave, or between sheets. Images are
// a good approximation at right angles and at others that divide pi.
bool is_left_out(const Scatterer& scatterer, std::size_t number) {
  const SharpEdge& edge = scatterer.edges().edges[number];
  const auto has_no_edges = [&](int facet) {
    return ends_beams(scatterer.materials()[scatterer.facets()[facet].material].kind);
  };
  if (edge.conducts || has_no_edges(edge.facet[0]) || has_no_edges(edge.facet[1])) return false;
  const double N = edge.front_wedge.N;
  if (N < 1 && std::abs(std::sin(kPi / N)) < 1e-3) return false;
  const auto& sides = scatterer.edges().edges_of_facet[edge.facet[0]];
  return std::ranges::find(sides, static_cast<int>(number)) == sides.end();
}

// Extents of a surface along its principal axes, m, and the numbers of its facets and of the curved ones.
struct SurfaceShape {
  Vec3 centre = Vec3::Zero(), lower = Vec3::Zero(), upper = Vec3::Zero();
  Mat3 moment = Mat3::Zero();  // of the corners; later their principal axes
  std::size_t facets = 0, curved = 0;
  std::uint16_t part = 0;
};

std::vector<SurfaceShape> surface_shapes(const Scatterer& scatterer) {
  const std::span<const Facet> facets = scatterer.facets();
  std::vector<SurfaceShape> shapes(scatterer.bodies().radius.size());
  const auto at = [&](std::size_t facet) -> SurfaceShape& {
    return shapes[static_cast<std::size_t>(scatterer.bodies().surface_of[facet])];
  };
  for (std::size_t f = 0; f < facets.size(); ++f) {
    SurfaceShape& shape = at(f);
    for (const Vec3& x : facets[f].corner) shape.centre += x / 3;
    if (shape.facets++ == 0) shape.part = facets[f].part;
    if (scatterer.surface().curved(static_cast<int>(f))) ++shape.curved;
  }
  for (SurfaceShape& shape : shapes) shape.centre /= static_cast<double>(shape.facets);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (const Vec3& x : facets[f].corner) at(f).moment += outer_product(x - at(f).centre, x - at(f).centre);
  }
  for (SurfaceShape& shape : shapes) shape.moment = principal_axes(shape.moment).axes;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (const Vec3& corner : facets[f].corner) {
      const Vec3 x = at(f).moment.transpose() * (corner - at(f).centre);
      at(f).lower = at(f).lower.cwiseMin(x);
      at(f).upper = at(f).upper.cwiseMax(x);
    }
  }
  return shapes;
}

}  // namespace

std::vector<std::string> check_edges(const Scatterer& scatterer, bool followed, double lowest_hz, double highest_hz,
                                     std::span<const std::string> part_names) {
  const double longest = kSpeedOfLight / lowest_hz, shortest = kSpeedOfLight / highest_hz,
               thickness = scatterer.sheet_thickness();
  const auto no_effect = [&](const char* why) {
    return fmt::format("sheet thickness of {:g} mm has no effect: {}", 1e3 * thickness, why);
  };
  if (!followed) return thickness > 0 ? std::vector{no_effect("edges are off")} : std::vector<std::string>{};
  const SharpEdges& edges = scatterer.edges();
  double all = 0;
  LengthByPart narrow, left_out;
  for (std::size_t number = 0; number < edges.edges.size(); ++number) {
    const SharpEdge& edge = edges.edges[number];
    const double length = edge.length();
    const std::uint16_t part = scatterer.facets()[edge.facet[0]].part;
    all += length;
    const auto is_narrow = [&](int facet) { return panel_area(scatterer, facet) < kNarrow * longest * length; };
    if (length > longest && is_narrow(edge.facet[0]) && is_narrow(edge.facet[1])) narrow.add(part, length);
    if (length > longest && is_left_out(scatterer, number)) left_out.add(part, length);
  }
  // Edges of materials have no thickness.
  const bool any_free_edge = std::ranges::any_of(edges.panel_edges, [&](const PanelEdge& side) {
    const SharpEdge& edge = edges.edges[side.edge];
    return edge.conducts && edge.front_wedge.thickness_m > 0;
  });
  std::vector<std::string> found;
  if (narrow.total() > 0) {
    found.push_back(
        fmt::format("{:.3g} m of {:.3g} m of diffracting edges belong to bars or strips narrower than a third of a "
                    "wavelength at {:g} GHz: half-plane diffraction overestimates their echo{}",
                    narrow.total(), all, lowest_hz * 1e-9, narrow.longest(part_names)));
  }
  if (left_out.total() > 0) {
    found.push_back(
        fmt::format("{:.3g} m of {:.3g} m of edges do not diffract: concave ones of materials that are no perfect "
                    "conductors, and those between sheets with air behind{}",
                    left_out.total(), all, left_out.longest(part_names)));
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

std::vector<std::string> check_bars(const Scatterer& scatterer, double lowest_hz,
                                    std::span<const std::string> part_names) {
  const double wavelength = kSpeedOfLight / lowest_hz;
  LengthByPart thin;
  for (const SurfaceShape& shape : surface_shapes(scatterer)) {
    Vec3 extent = shape.upper - shape.lower;
    std::ranges::sort(extent);
    const bool round = 2 * shape.curved > shape.facets;
    if (round && extent[2] > wavelength && extent[1] < kThinBar * wavelength) thin.add(shape.part, extent[2]);
  }
  if (thin.total() == 0) return {};
  return {
      fmt::format("{:.3g} m of round bars are thinner than {:g} wavelengths at {:g} GHz: physical optics of them errs "
                  "by up to 3 dB, below 0.1 wavelengths by 7 dB and more{}",
                  thin.total(), kThinBar, lowest_hz * 1e-9, thin.longest(part_names))};
}

namespace {

void append(std::vector<std::string>& sentences, const std::vector<std::string>& more) {
  sentences.insert(sentences.end(), more.begin(), more.end());
}

}  // namespace

PreparedTarget prepare_target(TargetMesh mesh, const ScattererSettings& settings) {
  PreparedTarget target{std::move(mesh.mesh),     std::move(mesh.materials),      {},
                        std::move(mesh.warnings), std::move(mesh.materials_note), nullptr};
  if (settings.waterline_m) {
    AboveWater above = above_water(target.mesh, *settings.waterline_m);
    target.below = above.below;
    if (settings.sea_reflects) {
      cut_at_sea_level(target.mesh, target.materials, *settings.waterline_m);
    } else {
      target.mesh = std::move(above.mesh);
    }
  }
  target.scatterer =
      std::make_shared<const Scatterer>(target.mesh, target.materials, settings.crease_rad, settings.sheet_thickness_m,
                                        merging_tolerance(settings.highest_hz));
  append(target.warnings, check_edges(*target.scatterer, settings.edges, settings.lowest_hz, settings.highest_hz,
                                      target.mesh.part_names));
  append(target.warnings, check_bars(*target.scatterer, settings.lowest_hz, target.mesh.part_names));
  return target;
}

}  // namespace seaglint
