// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/radiation/lens_reflection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "sim/core/numbers/real_functions.h"
#include "sim/core/numbers/rotation.h"
#include "sim/core/process/error.h"

namespace seaglint {

namespace {

Vec3 mean_of(std::span<const Vec3> points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& x : points) sum += x;
  return sum / static_cast<double>(points.size());
}

Mat3 moment_of(std::span<const Vec3> points, const Vec3& mean) {
  Mat3 moment = Mat3::Zero();
  for (const Vec3& x : points) moment += outer_product(x - mean, x - mean);
  return moment;
}

// Centre and radius of the sphere |x|^2 = 2 c . x + constant by least squares.
Sphere sphere_through(std::span<const Vec3> points) {
  const Vec3 mean = mean_of(points);
  double mean_square = 0;
  for (const Vec3& x : points) mean_square += (x - mean).squaredNorm() / static_cast<double>(points.size());
  Vec3 right = Vec3::Zero();
  for (const Vec3& x : points) right += 0.5 * ((x - mean).squaredNorm() - mean_square) * (x - mean);
  const Vec3 from_mean = Mat3(moment_of(points, mean).inverse()) * right;
  return {mean + from_mean, std::sqrt(mean_square + from_mean.squaredNorm())};
}

// Largest distance of a corner from the sphere over its radius: a polygon of 8 sides that the water cuts.
constexpr double kOffSphere = 0.08;

// Corners of the facets of one lens, and those on the border of its cap.
struct LensCorners {
  std::vector<int> facets;
  std::vector<Vec3> all, rim;
};

}  // namespace

std::vector<LuneburgLens> luneburg_lenses(const Scatterer& scatterer) {
  const std::span<const Facet> facets = scatterer.facets();
  const std::span<const MaterialSpec> materials = scatterer.materials();
  const auto kind_of = [&](int facet) { return materials[facets[static_cast<std::size_t>(facet)].material].kind; };
  if (std::ranges::none_of(materials, [](const MaterialSpec& spec) { return spec.kind == SurfaceKind::kLens; }))
    return {};

  std::map<std::int32_t, LensCorners> corners;  // by connected surface
  for (int f = 0; f < static_cast<int>(facets.size()); ++f) {
    if (kind_of(f) != SurfaceKind::kLens) continue;
    const Facet& facet = facets[static_cast<std::size_t>(f)];
    LensCorners& own = corners[scatterer.bodies().surface_of[static_cast<std::size_t>(f)]];
    own.facets.push_back(f);
    for (std::size_t i = 0; i < 3; ++i) {
      own.all.push_back(facet.corner[i]);
      const int across = facet.neighbour[i];
      if (across >= 0 && !ends_beams(kind_of(across)))
        own.rim.insert(own.rim.end(), {facet.corner[i], facet.corner[(i + 1) % 3]});
    }
  }

  std::vector<LuneburgLens> lenses;
  for (auto& [surface, own] : corners) {
    if (own.rim.empty()) continue;
    const Sphere sphere = sphere_through(own.all);
    double off = 0;
    for (const Vec3& x : own.all) off = std::max(off, std::abs((x - sphere.centre).norm() - sphere.radius));
    if (!(off <= kOffSphere * sphere.radius))
      throw InputError(fmt::format(
          "the surface of a Luneburg lens is up to {:.3g} m off a sphere of radius {:.3g} m: must be within "
          "{:g} of the radius",
          off, sphere.radius, kOffSphere));
    const Vec3 of_rim = mean_of(own.rim);
    Vec3 axis = principal_axes(moment_of(own.rim, of_rim)).axes.col(0);
    if (axis.dot(mean_of(own.all) - of_rim) < 0) axis = -axis;
    const double cosine = axis.dot(sphere.centre - of_rim) / sphere.radius;
    const MaterialSpec& material = materials[facets[static_cast<std::size_t>(own.facets.front())].material];
    lenses.push_back({sphere.centre, sphere.radius, axis, std::acos(std::clamp(cosine, -1.0, 1.0)),
                      std::pow(10.0, -material.loss_db / 20), std::move(own.facets)});
  }
  return lenses;
}

// 1/2 + (1 / pi) integral of MTF(s) sin(s u) / s from 0 to 2, with the transfer function of a circular aperture
// MTF(s) = (2 / pi) (acos(s / 2) - (s / 2) sqrt(1 - s^2 / 4)) (J. W. Goodman, Introduction to Fourier Optics, 3rd ed.,
// sec. 6.3). Far from the rim MTF = 1 - 2 s / pi determines it: 1 - 2 / (pi^2 u).
double focal_spot_on_cap(double u) {
  constexpr double kFar = 100;
  const double distance = std::abs(u);
  double outside = 2 / (kPi * kPi * std::max(distance, kFar));
  if (distance < kFar) {
    const auto transfer = [](double s) {
      return 2 / kPi * (std::acos(0.5 * s) - 0.5 * s * std::sqrt(1 - 0.25 * s * s));
    };
    outside = 0.5 - integrate(0, 2, 2 / (1 + distance), [&](double s) {
                      return transfer(s) * std::sin(s * distance) / s;
                    }) / kPi;
  }
  return u < 0 ? outside : 1 - outside;
}

namespace {

struct ApertureWindow {
  MovingPolygon polygon;  // in the transmitter's projection plane
  Box box;
};

// Places where rays enter that leave through what the receiver sees: its visible polygons, reflected in the centre. In
// the order of box.lower.x().
std::vector<ApertureWindow> exit_windows(const LuneburgLens& lens, const LensReflectionRequest& request) {
  const auto& [transmit, receive, is_monostatic] = request.antennas;
  const ImageTransform through_centre{-1.0 * Mat3::Identity(), 2 * lens.centre};
  std::vector<ApertureWindow> windows;
  for (const int f : lens.facets) {
    const Facet& facet = request.scatterer.facets()[static_cast<std::size_t>(f)];
    if (facet.normal.dot(transmit.r) <= kEdgeOn) continue;
    const std::span<const MovingPolygon> seen = request.seen.pieces(f);
    if (seen.empty()) continue;
    const PanelMap map(depth_plane(facet.normal, facet.offset, receive), receive, through_centre, transmit);
    for (const MovingPolygon& piece : seen) {
      MovingPolygon entry = map.mapped(piece);
      const Box box = box_of(entry);
      windows.push_back({std::move(entry), box});
    }
  }
  std::ranges::sort(windows, {}, [](const ApertureWindow& window) { return window.box.lower.x(); });
  return windows;
}

// Co- and cross-polarised components p . q of unchanged fields, hh, hv, vh, vv, with the sign of E' = +E
// (Contribution: 1 for a plate at normal incidence, E' = -E).
ScatteringMatrix unchanged_field(const BistaticGeometry& antennas) {
  const auto& [transmit, receive, is_monostatic] = antennas;
  return {-receive.h.dot(transmit.h), -receive.h.dot(transmit.v), -receive.v.dot(transmit.h),
          -receive.v.dot(transmit.v)};
}

void append_aperture(const LuneburgLens& lens, const LensReflectionRequest& request, const SmallestAreas& min_area,
                     std::vector<Contribution>& out) {
  const auto& [transmit, receive, is_monostatic] = request.antennas;
  // The aperture is in the plane through the centre. The path at its middle is a pi for two directions too: the focal
  // fields of both antennas have their path on the whole surface of the lens.
  const Vec3 both = transmit.r + receive.r;
  const Vec3 image_centre = lens.centre - kPi * lens.radius / both.squaredNorm() * both;
  Footprint footprint;
  footprint.plane.z0 = lens.centre.dot(transmit.r);
  footprint.image_transform = {-1.0 * Mat3::Identity(), 2 * image_centre};
  footprint.panel_size = 2 * lens.radius;
  set_phase(footprint, transmit.r, request.antennas);

  Pattern pattern{unchanged_field(request.antennas)};
  const double off_axis = std::acos(std::clamp(lens.axis.dot(both.normalized()), -1.0, 1.0)),
               within_rim = lens.cap_half_angle - off_axis;
  for (const double k : request.wavenumbers) {
    ScatteringMatrix& at_k = pattern.at_node.emplace_back(pattern.value);
    for (Complex& element : at_k) element *= lens.amplitude * focal_spot_on_cap(k * lens.radius * within_rim);
  }
  pattern.value = pattern.at_node[pattern.at_node.size() / 2];

  const std::vector<ApertureWindow> exits = exit_windows(lens, request);
  double widest = 0;
  for (const auto& [polygon, box] : exits) widest = std::max(widest, box.upper.x() - box.lower.x());
  for (const int f : lens.facets) {
    const Facet& facet = request.scatterer.facets()[static_cast<std::size_t>(f)];
    const ContributionSource source{f, facet.part, facet.part, 1};
    if (!request.settings.filter.accepts(facet.part, source.bounces, source.mechanism)) continue;
    for (const MovingPolygon& entry : request.illuminated.pieces(f)) {
      const Box box = box_of(entry);
      const auto first = std::ranges::lower_bound(exits, box.lower.x() - widest, {},
                                                  [](const ApertureWindow& window) { return window.box.lower.x(); });
      std::vector<MovingPolygon> common;
      double area = 0;
      for (auto exit = first; exit != exits.end() && exit->box.lower.x() < box.upper.x(); ++exit) {
        if (!overlap(exit->box, box)) continue;
        MovingPolygon part = intersect(entry, box, exit->polygon);
        if (part.empty() || signed_area(part) <= min_area.on(f)) continue;
        area += signed_area(part);
        common.push_back(std::move(part));
      }
      // A polygon all of whose rays leave is not divided.
      constexpr double kWhole = 1 - 1e-6;
      if (area > kWhole * signed_area(entry)) common.assign(1, entry);
      for (MovingPolygon& part : common) {
        footprint.polygon = std::move(part);
        limit_slide_rate(footprint, 2 * request.scatterer.radius());
        out.emplace_back(pattern, source, footprint);
      }
    }
  }
}

}  // namespace

std::vector<Contribution> lens_reflection(const LensReflectionRequest& request) {
  std::vector<Contribution> contributions;
  if (request.antennas.transmit.r.dot(request.antennas.receive.r) <= 0) return contributions;
  const SmallestAreas min_area(request.scatterer, request.settings);
  for (const LuneburgLens& lens : request.lenses) append_aperture(lens, request, min_area, contributions);
  return contributions;
}

}  // namespace seaglint
