// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/tracing/visible_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/process/parallel.h"
#include "sim/scattering/geometry/look_basis.h"

namespace seaglint {
namespace {

constexpr std::size_t kImagesPerChunk = 64;

// |normal . r^| below which the panel's own area, not its projected area, is compared with min_area: its edges scatter
// at any angle.
constexpr double kNearlyEdgeOn = 0.01;

// Smallest projected area kept of a panel with this normal, m^2.
double least_area(const Vec3& normal, const RadarBasis& basis, double min_area) {
  return min_area * std::min(1.0, std::abs(normal.dot(basis.r)) / kNearlyEdgeOn);
}

}  // namespace

bool project_panel(ProjectedPanel& projection, const BvhPanel& panel, const ImageTransform& image_transform,
                   const RadarBasis& basis, double min_area) {
  const Vec3 n_image = image_transform.L * panel.normal;
  if (std::abs(n_image.dot(basis.r)) < kInPlaneAngle) return false;
  projection.facet = panel.facet;
  projection.plane = depth_plane(n_image, panel.offset + n_image.dot(image_transform.t), basis);
  projection.polygon.clear();
  for (const Vec3& corner : panel.outline()) {
    // A body-fixed point at height z moves by -z d_i in the projection plane when the look direction changes by d_i.
    const Vec3 image = image_transform.image(corner);
    const double z = image.dot(basis.r);
    projection.polygon.push_back({Vec2(image.dot(basis.h), image.dot(basis.v)), Vec2(-z, 0), Vec2(0, -z)});
  }
  const double area = signed_area(projection.polygon);
  if (area < 0) std::reverse(projection.polygon.begin(), projection.polygon.end());
  return std::abs(area) >= min_area;
}

Extent extent_of(std::span<const MovingPolygon> polygons, const DepthPlane& plane) {
  const MovingVertex& start = polygons.front()[0];
  Extent extent{{start.p, start.p}, plane.at(start.p), plane.at(start.p)};
  for (const MovingPolygon& polygon : polygons) {
    for (const MovingVertex& vertex : polygon) {
      const double z = plane.at(vertex.p);
      extent.box.lower = extent.box.lower.cwiseMin(vertex.p);
      extent.box.upper = extent.box.upper.cwiseMax(vertex.p);
      extent.nearest = std::max(extent.nearest, z);
      extent.farthest = std::min(extent.farthest, z);
    }
  }
  return extent;
}

MovingLine depth_difference(const DepthPlane& a, const DepthPlane& b) {
  const MovingLine la = a.moving(), lb = b.moving();
  MovingLine line;
  line.value = lb.value - la.value;
  line.gradient = lb.gradient - la.gradient;
  line.value_d1 = lb.value_d1 - la.value_d1;
  line.value_d2 = lb.value_d2 - la.value_d2;
  line.gradient_d1 = lb.gradient_d1 - la.gradient_d1;
  line.gradient_d2 = lb.gradient_d2 - la.gradient_d2;
  return line;
}

MovingPolygon nearer_part(const ProjectedPanel& b, const ProjectedPanel& a) {
  const MovingLine above = depth_difference(a.plane, b.plane);
  double lowest = 0, highest = 0;
  for (const MovingVertex& vertex : b.polygon) {
    lowest = std::min(lowest, above.at(vertex.p));
    highest = std::max(highest, above.at(vertex.p));
  }
  if (highest < kCoincident) return lowest > -kCoincident && b.facet < a.facet ? b.polygon : MovingPolygon{};
  return lowest >= 0 ? b.polygon : clip(b.polygon, above, +1);
}

bool occlude(const ProjectedPanel& behind, const Extent& behind_extent, const ProjectedPanel& front,
             const Extent& front_extent, double min_area, PolygonSet& pieces) {
  if (front_extent.farthest > behind_extent.nearest + kCoincident)
    return pieces.subtract_hole(front.polygon, box_of(front.polygon), min_area);
  const auto touched = [&](std::size_t i) {
    return overlap(pieces.boxes()[i], front_extent.box) && !disjoint(pieces.polygons()[i], front.polygon);
  };
  std::size_t i = 0;
  while (i < pieces.size() && !touched(i)) ++i;
  if (i == pieces.size()) return false;
  const MovingPolygon hole = nearer_part(front, behind);
  return !hole.empty() && pieces.subtract_hole(hole, box_of(hole), min_area);
}

VisibleSurface::VisibleSurface(std::span<const Facet> facets, const Panels& panels, const PanelBvh& tree,
                               const RadarBasis& basis, const SmallestAreas& min_area, int threads)
    : facets_(facets), basis_(basis), min_area_(min_area), image_of_(facets.size(), -1) {
  // Back faces of closed surfaces are hidden by front faces, so that only front faces and open sheets are visible or
  // occlude.
  const auto may_be_visible = [&](int f) {
    return panels.is_representative(f) && (facets[f].two_sided || facets[f].normal.dot(basis.r) > 0);
  };
  std::size_t max = 0;
  for (int f = 0; f < static_cast<int>(facets.size()); ++f) max += may_be_visible(f);
  images_.reserve(max);
  extents_.reserve(max);
  ProjectedPanel fresh;
  for (int f = 0; f < static_cast<int>(facets.size()); ++f) {
    if (!may_be_visible(f) || !project_panel(fresh, bvh_panel(facets, panels, f), ImageTransform{}, basis,
                                             least_area(facets[f].normal, basis, min_area.on(f))))
      continue;
    image_of_[f] = static_cast<std::int32_t>(images_.size());
    images_.push_back(fresh);
    extents_.push_back(extent_of({&fresh.polygon, 1}, fresh.plane));
  }
  seen_.resize(images_.size());
  pieces_.resize((images_.size() + kImagesPerChunk - 1) / kImagesPerChunk);
  boxes_.resize(pieces_.size());
  parallel_for(pieces_.size(), threads, [&](std::size_t chunk) {
    PolygonSet left;
    for (std::size_t i = chunk * kImagesPerChunk; i < std::min(images_.size(), (chunk + 1) * kImagesPerChunk); ++i) {
      const ProjectedPanel& projection = images_[i];
      const Extent& extent = extents_[i];
      const Facet& facet = facets[projection.facet];
      const double min = least_area(facet.normal, basis, min_area.on(projection.facet));
      const Vec3 towards = facet.normal.dot(basis.r) > 0 ? facet.normal : Vec3(-facet.normal);
      const Prism prism{{basis.h, basis.v},
                        {extent.box.lower.x(), extent.box.lower.y()},
                        {extent.box.upper.x(), extent.box.upper.y()},
                        towards,
                        towards.dot(facet.corner[0]),
                        basis.r,
                        -basis.r};
      left.assign({&projection.polygon, 1});
      Visibility& seen = seen_[i];
      tree.traverse(prism, [&](const BvhPanel& panel) {
        const std::int32_t other = image_of_[panel.facet];
        if (other >= 0 && panel.facet != projection.facet && may_occlude(extent, extents_[other]) &&
            occlude(projection, extent, images_[other], extents_[other], min, left))
          seen.whole = false;
        return left.empty() ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
      });
      if (seen.whole) continue;
      std::vector<MovingPolygon>& pieces = pieces_[chunk];
      seen.first = static_cast<std::uint32_t>(pieces.size());
      seen.count = static_cast<std::uint32_t>(left.size());
      pieces.insert(pieces.end(), left.polygons().begin(), left.polygons().end());
      boxes_[chunk].insert(boxes_[chunk].end(), left.boxes().begin(), left.boxes().end());
    }
    pieces_[chunk].shrink_to_fit();
  });
}

std::span<const MovingPolygon> VisibleSurface::pieces(int facet) const { return window(facet).pieces; }

VisibleSurface::VisiblePieces VisibleSurface::window(int facet) const {
  if (image_of_[facet] < 0) return {};
  const std::size_t i = static_cast<std::size_t>(image_of_[facet]), chunk = i / kImagesPerChunk;
  if (seen_[i].whole) return {{&images_[i].polygon, 1}, &extents_[i].box};
  return {{pieces_[chunk].data() + seen_[i].first, seen_[i].count}, boxes_[chunk].data() + seen_[i].first};
}

void VisibleSurface::visible_after_reflections(int facet, const ImageTransform& image_transform,
                                               std::span<const MovingPolygon> illuminated, const RadarBasis& transmit,
                                               std::vector<MovingPolygon>& visible) const {
  if (image_of_[facet] < 0) return;
  if (seen_[static_cast<std::size_t>(image_of_[facet])].whole) {
    visible.insert(visible.end(), illuminated.begin(), illuminated.end());
    return;
  }
  const Facet& own = facets_[facet];
  const PanelMap map(depth_plane(own.normal, own.offset, basis_), basis_, image_transform, transmit);
  clip_to_visible(window(facet), least_area(own.normal, basis_, min_area_.on(facet)), map, illuminated, visible);
}

void VisibleSurface::visible_via_reflector(int reflector, int facet, const ImageTransform& image_transform,
                                           std::span<const MovingPolygon> illuminated, const RadarBasis& transmit,
                                           std::vector<MovingPolygon>& visible) const {
  const ImageTransform by = plane_reflection(facets_[reflector].normal, facets_[reflector].offset);
  const Vec3 normal = by.L * facets_[facet].normal;
  const PanelMap map(depth_plane(normal, normal.dot(by.image(facets_[facet].corner[0])), basis_), basis_,
                     image_transform, transmit);
  clip_to_visible(window(reflector), least_area(normal, basis_, min_area_.on(facet)), map, illuminated, visible);
}

void VisibleSurface::clip_to_visible(const VisiblePieces& window, double min_area, const PanelMap& map,
                                     std::span<const MovingPolygon> illuminated, std::vector<MovingPolygon>& visible) {
  if (window.pieces.empty() || illuminated.empty()) return;
  // Bounding box of the illuminated polygons in the radar's projection plane.
  Box direct;
  for (const MovingPolygon& part : illuminated) {
    for (const MovingVertex& corner : part) {
      const Vec2 q = map.inverse(corner.p);
      const bool start = &corner == illuminated.front().begin();
      direct = {start ? q : Vec2(direct.lower.cwiseMin(q)), start ? q : Vec2(direct.upper.cwiseMax(q))};
    }
  }
  for (std::size_t i = 0; i < window.pieces.size(); ++i) {
    const MovingPolygon& piece = window.pieces[i];
    if (!overlap(window.boxes[i], direct)) continue;
    const MovingPolygon image = map.mapped(piece);
    const Box around = box_of(image);
    for (const MovingPolygon& part : illuminated) {
      if (!overlap(box_of(part), around)) continue;
      MovingPolygon both = intersect(part, image);
      if (signed_area(both) > min_area) visible.push_back(std::move(both));
    }
  }
}

}  // namespace seaglint
