// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/hidden_surface.h"

#include <algorithm>
#include <cmath>

#include "sim/core/parallel.h"

namespace seaglint {
namespace {

// Facet images sorted into the cells of a grid, to find what may overlap what.
class CellIndex {
 public:
  explicit CellIndex(std::span<const FacetImage> images) {
    Box all = images.empty() ? Box{} : images[0].box;
    for (const FacetImage& image : images) {
      all.lower = all.lower.cwiseMin(image.box.lower);
      all.upper = all.upper.cwiseMax(image.box.upper);
    }
    lower_ = all.lower;
    // About two images per cell if they were evenly spread; long facets fill many cells, which a smaller cell would only worsen.
    const Vec2 extent = (all.upper - all.lower).cwiseMax(1e-12);
    const double cells = std::max<double>(1, 0.5 * static_cast<double>(images.size()));
    size_ = std::max(std::sqrt(extent.prod() / cells), extent.maxCoeff() / 4096);
    columns_ = static_cast<int>(extent.x() / size_) + 1;
    rows_ = static_cast<int>(extent.y() / size_) + 1;
    cells_.resize(static_cast<std::size_t>(columns_) * rows_);
    for (std::size_t i = 0; i < images.size(); ++i) {
      visit(images[i].box, [&](std::vector<int>& cell) { cell.push_back(static_cast<int>(i)); });
    }
  }

  // Images whose cells the box touches, ascending, each once.
  std::vector<int> near(const Box& box) {
    std::vector<int> found;
    visit(box, [&](const std::vector<int>& cell) { found.insert(found.end(), cell.begin(), cell.end()); });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

 private:
  template <typename Action>
  void visit(const Box& box, const Action& action) {
    const auto index = [this](double x, double from, int count) {
      return std::clamp(static_cast<int>((x - from) / size_), 0, count - 1);
    };
    for (int row = index(box.lower.y(), lower_.y(), rows_); row <= index(box.upper.y(), lower_.y(), rows_); ++row) {
      for (int column = index(box.lower.x(), lower_.x(), columns_); column <= index(box.upper.x(), lower_.x(), columns_); ++column) {
        action(cells_[static_cast<std::size_t>(row) * columns_ + column]);
      }
    }
  }

  Vec2 lower_ = Vec2::Zero();
  double size_ = 1;
  int columns_ = 1, rows_ = 1;
  std::vector<std::vector<int>> cells_;
};

}  // namespace

std::optional<FacetImage> facet_image(std::span<const Facet> facets, int facet, const Mirror& mirrors, const RadarBasis& basis,
                                      double min_area) {
  const Facet& f = facets[facet];
  const Vec3 n_image = mirrors.L * f.normal;
  if (std::abs(n_image.dot(basis.r)) < 1e-6) return {};
  FacetImage result;
  result.facet = facet;
  result.plane = image_plane(n_image, n_image.dot(mirrors.image(f.corner[0])), basis);
  for (const Vec3& corner : f.corner) {
    // A point fixed to the body at height z moves by -z d_i in the aperture when the direction turns by d_i.
    const Vec3 image = mirrors.image(corner);
    const double z = image.dot(basis.r);
    result.polygon.push_back({Vec2(image.dot(basis.h), image.dot(basis.v)), Vec2(-z, 0), Vec2(0, -z)});
  }
  result.polygon = counter_clockwise(std::move(result.polygon));
  if (signed_area(result.polygon) < min_area) return {};
  result.box = box_of(result.polygon);
  return result;
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

bool cut(std::vector<MovingPolygon>& pieces, const MovingPolygon& hole, double min_area) {
  const Box box = box_of(hole);
  const auto touched = [&](const MovingPolygon& piece) {
    return overlap(box_of(piece), box) && !apart(piece, hole) && signed_area(intersect(piece, hole)) > min_area;
  };
  const auto first = std::find_if(pieces.begin(), pieces.end(), touched);
  if (first == pieces.end()) return false;
  std::vector<MovingPolygon> rest(std::make_move_iterator(pieces.begin()), std::make_move_iterator(first));
  for (auto piece = first; piece != pieces.end(); ++piece) {
    if (piece == first || touched(*piece)) {
      subtract(*piece, hole, min_area, rest);
    } else {
      rest.push_back(std::move(*piece));
    }
  }
  pieces = std::move(rest);
  return true;
}

std::vector<MovingPolygon> inside(const FacetImage& image, std::span<const MovingPolygon> window, double min_area) {
  std::vector<MovingPolygon> pieces;
  for (const MovingPolygon& piece : window) {
    if (!overlap(box_of(piece), image.box) || apart(piece, image.polygon)) continue;
    MovingPolygon common = intersect(piece, image.polygon);
    if (signed_area(common) > min_area) pieces.push_back(std::move(common));
  }
  return pieces;
}

VisibleSurface::VisibleSurface(std::span<const Facet> facets, const RadarBasis& basis, double min_area, int threads)
    : facets_(facets), basis_(basis), min_area_(min_area), pieces_(facets.size()), boxes_(facets.size()) {
  // The far side of a closed part is hidden by its near side: only what faces the radar, and open sheets, can be seen or hide anything.
  std::vector<FacetImage> images;
  for (int f = 0; f < static_cast<int>(facets.size()); ++f) {
    if (!facets[f].open && facets[f].normal.dot(basis.r) <= 0) continue;
    if (auto image = facet_image(facets, f, Mirror{}, basis, min_area)) images.push_back(std::move(*image));
  }
  CellIndex index(images);
  constexpr std::size_t kImagesPerChunk = 64;
  parallel_for((images.size() + kImagesPerChunk - 1) / kImagesPerChunk, threads, [&](std::size_t chunk) {
    for (std::size_t i = chunk * kImagesPerChunk; i < std::min(images.size(), (chunk + 1) * kImagesPerChunk); ++i) {
      const FacetImage& image = images[i];
      std::vector<MovingPolygon> seen{image.polygon};
      for (const int other : index.near(image.box)) {
        if (static_cast<std::size_t>(other) == i || !overlap(images[other].box, image.box)) continue;
        const MovingPolygon hole = nearer_part(images[other], image);
        if (!hole.empty()) cut(seen, hole, min_area);
        if (seen.empty()) break;
      }
      for (const MovingPolygon& piece : seen) boxes_[image.facet].push_back(box_of(piece));
      pieces_[image.facet] = std::move(seen);
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
    if (apart(lit, image)) continue;
    MovingPolygon both = intersect(lit, image);
    if (signed_area(both) > min_area_) seen.push_back(std::move(both));
  }
}

}  // namespace seaglint
