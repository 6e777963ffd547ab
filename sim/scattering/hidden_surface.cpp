// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/hidden_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/parallel.h"

namespace seaglint {
std::optional<FacetImage> facet_image(std::span<const Facet> facets, const Panels& panels, int facet, const Mirror& mirrors, const RadarBasis& basis,
                                      double min_area) {
  const Facet& f = facets[facet];
  const Vec3 n_image = mirrors.L * f.normal;
  if (std::abs(n_image.dot(basis.r)) < 1e-6) return {};
  FacetImage result;
  result.facet = facet;
  result.plane = image_plane(n_image, n_image.dot(mirrors.image(f.corner[0])), basis);
  for (const Vec3& corner : panels.outline(facet)) {
    // A point fixed to the body at height z moves by -z d_i in the aperture when the direction turns by d_i.
    const Vec3 image = mirrors.image(corner);
    const double z = image.dot(basis.r);
    result.polygon.push_back({Vec2(image.dot(basis.h), image.dot(basis.v)), Vec2(-z, 0), Vec2(0, -z)});
  }
  result.polygon = counter_clockwise(std::move(result.polygon));
  if (signed_area(result.polygon) < min_area) return {};
  set_extent(result);
  return result;
}

void set_extent(FacetImage& image) {
  image.box = box_of(image.polygon);
  image.nearest = image.farthest = image.plane.at(image.polygon[0].p);
  for (const Corner& corner : image.polygon) {
    const double z = image.plane.at(corner.p);
    image.nearest = std::max(image.nearest, z);
    image.farthest = std::min(image.farthest, z);
  }
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

bool cut(std::vector<MovingPolygon>& pieces, const MovingPolygon& hole, const Box& box, double min_area) {
  std::vector<MovingPolygon> left;  // of the pieces that were cut
  std::size_t whole = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (overlap(box_of(pieces[i]), box) && subtract_common(pieces[i], hole, min_area, left)) continue;
    if (whole < i) pieces[whole] = std::move(pieces[i]);
    ++whole;
  }
  if (whole == pieces.size()) return false;
  pieces.resize(whole);
  pieces.insert(pieces.end(), left.begin(), left.end());
  return true;
}

bool hide(const FacetImage& behind, const FacetImage& front, double min_area, std::vector<MovingPolygon>& pieces) {
  if (front.nearest < behind.farthest - kCoincident || !overlap(front.box, behind.box)) return false;
  if (front.farthest > behind.nearest + kCoincident) return cut(pieces, front.polygon, front.box, min_area);
  if (std::none_of(pieces.begin(), pieces.end(), [&](const MovingPolygon& piece) { return !apart(piece, front.polygon); })) return false;
  const MovingPolygon hole = nearer_part(front, behind);
  return !hole.empty() && cut(pieces, hole, box_of(hole), min_area);
}

VisibleSurface::VisibleSurface(std::span<const Facet> facets, const Panels& panels, const FacetTree& tree, const RadarBasis& basis, double min_area, int threads)
    : facets_(facets), basis_(basis), min_area_(min_area), pieces_(facets.size()), boxes_(facets.size()) {
  // The far side of a closed part is hidden by its near side: only what faces the radar, and open sheets, can be seen or hide anything.
  std::vector<FacetImage> images;
  std::vector<int> image_of(facets.size(), -1);
  for (int f = 0; f < static_cast<int>(facets.size()); ++f) {
    if (!panels.is_first(f) || (!facets[f].open && facets[f].normal.dot(basis.r) <= 0)) continue;
    if (auto image = facet_image(facets, panels, f, Mirror{}, basis, min_area)) {
      image_of[f] = static_cast<int>(images.size());
      images.push_back(std::move(*image));
    }
  }
  constexpr std::size_t kImagesPerChunk = 64;
  parallel_for((images.size() + kImagesPerChunk - 1) / kImagesPerChunk, threads, [&](std::size_t chunk) {
    std::vector<MovingPolygon> seen;
    for (std::size_t i = chunk * kImagesPerChunk; i < std::min(images.size(), (chunk + 1) * kImagesPerChunk); ++i) {
      const FacetImage& image = images[i];
      const Facet& facet = facets[image.facet];
      const Vec3 towards = facet.normal.dot(basis.r) > 0 ? facet.normal : Vec3(-facet.normal);
      const Prism prism{{basis.h, basis.v},
                        {image.box.lower.x(), image.box.lower.y()},
                        {image.box.upper.x(), image.box.upper.y()},
                        towards,
                        towards.dot(facet.corner[0]),
                        basis.r};
      seen.assign(1, image.polygon);
      tree.walk(prism, [&](int other) {
        if (other != image.facet && image_of[other] >= 0) hide(image, images[image_of[other]], min_area, seen);
        return seen.empty() ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
      });
      for (const MovingPolygon& piece : seen) boxes_[image.facet].push_back(box_of(piece));
      pieces_[image.facet].assign(seen.begin(), seen.end());
    }
  });
}

void VisibleSurface::seen_through(int facet, const Mirror& mirrors, const ImagePlane& plane, const MovingPolygon& lit,
                                  const RadarBasis& transmit, std::vector<MovingPolygon>& seen) const {
  if (pieces_[facet].empty()) return;
  // Where the lit part lies in the radar's own aperture.
  Box direct;
  for (std::size_t i = 0; i < lit.size(); ++i) {
    const Vec2& p = lit[i].p;
    const Vec3 x = mirrors.real(p.x() * transmit.h + p.y() * transmit.v + plane.at(p) * transmit.r);
    const Vec2 q(x.dot(basis_.h), x.dot(basis_.v));
    direct.lower = i == 0 ? q : Vec2(direct.lower.cwiseMin(q));
    direct.upper = i == 0 ? q : Vec2(direct.upper.cwiseMax(q));
  }
  const ImagePlane own = image_plane(facets_[facet].normal, facets_[facet].offset, basis_);
  MovingPolygon image;
  for (std::size_t i = 0; i < pieces_[facet].size(); ++i) {
    if (!overlap(boxes_[facet][i], direct)) continue;
    image.clear();
    for (const Corner& corner : pieces_[facet][i]) {
      // The corner's point on the facet, and how far it slips in the facet beyond what a body-fixed point moves.
      const double z = own.at(corner.p);
      const Vec3 x = mirrors.image(corner.p.x() * basis_.h + corner.p.y() * basis_.v + z * basis_.r);
      const double height = x.dot(transmit.r);
      const auto moved = [&](const Vec2& slip) -> Vec3 {
        return mirrors.L * (slip.x() * basis_.h + slip.y() * basis_.v + own.slope.dot(slip) * basis_.r);
      };
      const Vec3 x1 = moved(corner.d1 + Vec2(z, 0)), x2 = moved(corner.d2 + Vec2(0, z));
      image.push_back({Vec2(x.dot(transmit.h), x.dot(transmit.v)), Vec2(x1.dot(transmit.h) - height, x1.dot(transmit.v)),
                       Vec2(x2.dot(transmit.h), x2.dot(transmit.v) - height)});
    }
    if (signed_area(image) < 0) std::reverse(image.begin(), image.end());
    MovingPolygon both = intersect(lit, image);
    if (signed_area(both) > min_area_) seen.push_back(std::move(both));
  }
}

}  // namespace seaglint
