// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/beams/visible_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/process/parallel.h"

namespace seaglint {
namespace {

constexpr std::size_t kImagesPerChunk = 64;

// Cosine below which a panel is measured by its own area, not by its image's: however nearly edge-on, its rims answer.
constexpr double kNearlyEdgeOn = 0.01;

// The smallest image that counts of a panel with this normal, m^2.
double least_area(const Vec3& normal, const RadarBasis& basis, double min_area) {
  return min_area * std::min(1.0, std::abs(normal.dot(basis.r)) / kNearlyEdgeOn);
}

}  // namespace

bool set_image(FacetImage& result, const TreePanel& panel, const Mirror& mirrors, const RadarBasis& basis,
               double min_area) {
  const Vec3 n_image = mirrors.L * panel.normal;
  if (std::abs(n_image.dot(basis.r)) < kEdgeOnPanel) return false;
  result.facet = panel.facet;
  result.plane = image_plane(n_image, panel.offset + n_image.dot(mirrors.t), basis);
  result.polygon.clear();
  for (const Vec3& corner : panel.outline()) {
    // A point fixed to the body at height z moves by -z d_i in the aperture when the direction turns by d_i.
    const Vec3 image = mirrors.image(corner);
    const double z = image.dot(basis.r);
    result.polygon.push_back({Vec2(image.dot(basis.h), image.dot(basis.v)), Vec2(-z, 0), Vec2(0, -z)});
  }
  const double area = signed_area(result.polygon);
  if (area < 0) std::reverse(result.polygon.begin(), result.polygon.end());
  return std::abs(area) >= min_area;
}

Extent extent_of(std::span<const MovingPolygon> polygons, const ImagePlane& plane) {
  const Corner& start = polygons.front()[0];
  Extent extent{{start.p, start.p}, plane.at(start.p), plane.at(start.p)};
  for (const MovingPolygon& polygon : polygons) {
    for (const Corner& corner : polygon) {
      const double z = plane.at(corner.p);
      extent.box.lower = extent.box.lower.cwiseMin(corner.p);
      extent.box.upper = extent.box.upper.cwiseMax(corner.p);
      extent.nearest = std::max(extent.nearest, z);
      extent.farthest = std::min(extent.farthest, z);
    }
  }
  return extent;
}

MovingLine depth_between(const ImagePlane& a, const ImagePlane& b) {
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

MovingPolygon nearer_part(const FacetImage& b, const FacetImage& a) {
  const MovingLine above = depth_between(a.plane, b.plane);
  double lowest = 0, highest = 0;
  for (const Corner& corner : b.polygon) {
    lowest = std::min(lowest, above.at(corner.p));
    highest = std::max(highest, above.at(corner.p));
  }
  if (highest < kCoincident) return lowest > -kCoincident && b.facet < a.facet ? b.polygon : MovingPolygon{};
  return lowest >= 0 ? b.polygon : clip(b.polygon, above, +1);
}

bool hide(const FacetImage& behind, const Extent& behind_extent, const FacetImage& front, const Extent& front_extent,
          double min_area, Pieces& pieces) {
  if (front_extent.farthest > behind_extent.nearest + kCoincident)
    return pieces.cut(front.polygon, box_of(front.polygon), min_area);
  const auto touched = [&](std::size_t i) {
    return overlap(pieces.boxes()[i], front_extent.box) && !apart(pieces.polygons()[i], front.polygon);
  };
  std::size_t i = 0;
  while (i < pieces.size() && !touched(i)) ++i;
  if (i == pieces.size()) return false;
  const MovingPolygon hole = nearer_part(front, behind);
  return !hole.empty() && pieces.cut(hole, box_of(hole), min_area);
}

VisibleSurface::VisibleSurface(std::span<const Facet> facets, const Panels& panels, const FacetTree& tree,
                               const RadarBasis& basis, double min_area, int threads)
    : facets_(facets), basis_(basis), min_area_(min_area), image_of_(facets.size(), -1) {
  // The far side of a closed part is hidden by its near side: only what faces the radar, and open sheets, can be seen
  // or hide anything.
  const auto may_be_seen = [&](int f) {
    return panels.is_first(f) && (facets[f].open || facets[f].normal.dot(basis.r) > 0);
  };
  std::size_t most = 0;
  for (int f = 0; f < static_cast<int>(facets.size()); ++f) most += may_be_seen(f);
  images_.reserve(most);
  extents_.reserve(most);
  FacetImage fresh;
  for (int f = 0; f < static_cast<int>(facets.size()); ++f) {
    if (!may_be_seen(f) || !set_image(fresh, tree_panel(facets, panels, f), Mirror{}, basis,
                                      least_area(facets[f].normal, basis, min_area)))
      continue;
    image_of_[f] = static_cast<std::int32_t>(images_.size());
    images_.push_back(fresh);
    extents_.push_back(extent_of({&fresh.polygon, 1}, fresh.plane));
  }
  seen_.resize(images_.size());
  pieces_.resize((images_.size() + kImagesPerChunk - 1) / kImagesPerChunk);
  boxes_.resize(pieces_.size());
  parallel_for(pieces_.size(), threads, [&](std::size_t chunk) {
    Pieces left;
    for (std::size_t i = chunk * kImagesPerChunk; i < std::min(images_.size(), (chunk + 1) * kImagesPerChunk); ++i) {
      const FacetImage& image = images_[i];
      const Extent& extent = extents_[i];
      const Facet& facet = facets[image.facet];
      const double least = least_area(facet.normal, basis, min_area);
      const Vec3 towards = facet.normal.dot(basis.r) > 0 ? facet.normal : Vec3(-facet.normal);
      const Prism prism{{basis.h, basis.v},
                        {extent.box.lower.x(), extent.box.lower.y()},
                        {extent.box.upper.x(), extent.box.upper.y()},
                        towards,
                        towards.dot(facet.corner[0]),
                        basis.r,
                        -basis.r};
      left.assign({&image.polygon, 1});
      Seen& seen = seen_[i];
      tree.walk(prism, [&](const TreePanel& panel) {
        const std::int32_t other = image_of_[panel.facet];
        if (other >= 0 && panel.facet != image.facet && may_hide(extent, extents_[other]) &&
            hide(image, extent, images_[other], extents_[other], least, left))
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

VisibleSurface::Window VisibleSurface::window(int facet) const {
  if (image_of_[facet] < 0) return {};
  const std::size_t i = static_cast<std::size_t>(image_of_[facet]), chunk = i / kImagesPerChunk;
  if (seen_[i].whole) return {{&images_[i].polygon, 1}, &extents_[i].box};
  return {{pieces_[chunk].data() + seen_[i].first, seen_[i].count}, boxes_[chunk].data() + seen_[i].first};
}

void VisibleSurface::seen_through(int facet, const Mirror& mirrors, std::span<const MovingPolygon> lit,
                                  const RadarBasis& transmit, std::vector<MovingPolygon>& seen) const {
  if (image_of_[facet] < 0) return;
  if (seen_[static_cast<std::size_t>(image_of_[facet])].whole) {
    seen.insert(seen.end(), lit.begin(), lit.end());
    return;
  }
  const Facet& own = facets_[facet];
  show(window(facet), own.normal, image_plane(own.normal, own.offset, basis_), mirrors, lit, transmit, seen);
}

void VisibleSurface::seen_by(int mirror, int facet, const Mirror& mirrors, std::span<const MovingPolygon> lit,
                             const RadarBasis& transmit, std::vector<MovingPolygon>& seen) const {
  const Mirror by = plane_mirror(facets_[mirror].normal, facets_[mirror].offset);
  const Vec3 normal = by.L * facets_[facet].normal;
  show(window(mirror), normal, image_plane(normal, normal.dot(by.image(facets_[facet].corner[0])), basis_), mirrors,
       lit, transmit, seen);
}

void VisibleSurface::show(const Window& window, const Vec3& normal, const ImagePlane& own, const Mirror& mirrors,
                          std::span<const MovingPolygon> lit, const RadarBasis& transmit,
                          std::vector<MovingPolygon>& seen) const {
  if (window.pieces.empty() || lit.empty()) return;
  // On the panel's plane, the way from the radar's own aperture to the beam's is affine: q -> origin + q1 first + q2
  // second, heights included.
  const auto in_beam = [&](const Vec3& x) { return Vec3(x.dot(transmit.h), x.dot(transmit.v), x.dot(transmit.r)); };
  const Vec3 origin = in_beam(mirrors.image(own.z0 * basis_.r));
  const Vec3 first = in_beam(mirrors.L * (basis_.h + own.slope.x() * basis_.r)),
             second = in_beam(mirrors.L * (basis_.v + own.slope.y() * basis_.r));
  // Back from there, to tell which pieces may have to do with what is lit.
  const double determinant = first.x() * second.y() - first.y() * second.x();
  Box direct;
  for (const MovingPolygon& part : lit) {
    for (const Corner& corner : part) {
      const Vec2 p = corner.p - origin.head<2>();
      const Vec2 q = Vec2(p.x() * second.y() - p.y() * second.x(), p.y() * first.x() - p.x() * first.y()) / determinant;
      const bool start = &corner == lit.front().begin();
      direct = {start ? q : Vec2(direct.lower.cwiseMin(q)), start ? q : Vec2(direct.upper.cwiseMax(q))};
    }
  }
  const double least = least_area(normal, basis_, min_area_);
  MovingPolygon image;
  for (std::size_t i = 0; i < window.pieces.size(); ++i) {
    const MovingPolygon& piece = window.pieces[i];
    if (!overlap(window.boxes[i], direct)) continue;
    image.clear();
    for (const Corner& corner : piece) {
      // The corner's point on the panel, and how far it slips in the panel beyond what a body-fixed point moves.
      const double z = own.at(corner.p);
      const Vec3 x = origin + corner.p.x() * first + corner.p.y() * second;
      const auto moved = [&](const Vec2& slip) -> Vec2 { return (slip.x() * first + slip.y() * second).head<2>(); };
      image.push_back({x.head<2>(), moved(corner.d1 + Vec2(z, 0)) - Vec2(x.z(), 0),
                       moved(corner.d2 + Vec2(0, z)) - Vec2(0, x.z())});
    }
    if (signed_area(image) < 0) std::reverse(image.begin(), image.end());
    const Box around = box_of(image);
    for (const MovingPolygon& part : lit) {
      if (!overlap(box_of(part), around)) continue;
      MovingPolygon both = intersect(part, image);
      if (signed_area(both) > least) seen.push_back(std::move(both));
    }
  }
}

}  // namespace seaglint
