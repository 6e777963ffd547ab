// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/scatterer/panels.h"

#include <algorithm>
#include <array>

#include "sim/scattering/geometry/tolerances.h"

namespace seaglint {
namespace {

// Smallest cosine between normals in one panel: excludes folded facets thinner than kCoincident.
constexpr double kSameWay = 0.999;
// Limit while a panel grows, vertices on straight sides included.
constexpr std::size_t kMaxCorners = 32;

struct Outline {
  Vec3 normal;
  std::vector<Vec3> corner;
  std::vector<std::array<int, 2>> side;  // facet and its side along corner[i] -> corner[i + 1]
};

// Twice the signed area of the triangle a, b, c about the normal, m^2: positive for a left turn at b. Relative to the
// squared length, values within kStraight count as collinear.
double turn(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
  return normal.dot((b - a).cross(c - b));
}
constexpr double kStraight = 1e-12;

// Adds the vertex `apex` of the facet across side i, its own side `edge`, to the outline; false where the result would
// not be convex.
bool grow(Outline& outline, std::size_t i, int facet, int edge, const Vec3& apex) {
  const std::size_t n = outline.corner.size();
  const auto at = [&](std::size_t j) -> const Vec3& { return outline.corner[j % n]; };
  const double straight = kStraight * (apex - at(i)).squaredNorm();
  // A facet that is folded back has its apex on the wrong side.
  if (!(turn(at(i), apex, at(i + 1), outline.normal) > straight)) return false;
  if (turn(at(i + n - 1), at(i), apex, outline.normal) < -straight ||
      turn(apex, at(i + 1), at(i + 2), outline.normal) < -straight)
    return false;
  const auto place = static_cast<std::ptrdiff_t>(i) + 1;
  outline.corner.insert(outline.corner.begin() + place, apex);
  outline.side[i] = {facet, (edge + 1) % 3};
  outline.side.insert(outline.side.begin() + place, {facet, (edge + 2) % 3});
  return true;
}

}  // namespace

Panels::Panels(std::span<const Facet> facets, const SmoothSurface& surface)
    : facets_(facets), of_(facets.size(), -1), size_(facets.size(), 0), width_(facets.size(), 0) {
  first_corner_.reserve(facets.size() + 1);
  first_member_.reserve(facets.size() + 1);
  members_.reserve(facets.size());
  Outline outline;
  for (int f = 0; f < static_cast<int>(facets.size()); ++f) {
    first_corner_.push_back(static_cast<std::uint32_t>(corners_.size()));
    first_member_.push_back(static_cast<std::uint32_t>(members_.size()));
    if (of_[f] >= 0) continue;
    const Facet& first = facets[f];
    of_[f] = f;
    members_.push_back(f);
    outline = {first.normal, {first.corner.begin(), first.corner.end()}, {{f, 0}, {f, 1}, {f, 2}}};
    for (std::size_t i = 0; i < outline.side.size() && outline.side.size() < kMaxCorners;) {
      const auto [from, edge] = outline.side[i];
      const int g = facets[from].neighbour[edge];
      const auto joins = [&, from = from] {
        if (g < 0 || of_[g] >= 0 || surface.curved(f) || surface.curved(g)) return false;
        const Facet& other = facets[g];
        // Exactly two facets share the side.
        const auto back = std::find(other.neighbour.begin(), other.neighbour.end(), from);
        if (back == other.neighbour.end() || other.part != first.part || other.material != first.material ||
            other.two_sided != first.two_sided)
          return false;
        if (other.normal.dot(first.normal) < kSameWay) return false;
        const bool one_face = first.face >= 0 && other.face == first.face;
        for (const Vec3& x : other.corner) {
          if (!one_face && std::abs(first.normal.dot(x) - first.offset) > kCoincident) return false;
        }
        const int shared = static_cast<int>(back - other.neighbour.begin());
        return grow(outline, i, g, shared, other.corner[(shared + 2) % 3]);
      };
      if (joins()) {
        of_[g] = f;
        members_.push_back(g);
        i = 0;  // a facet rejected before may fit the larger outline
      } else {
        ++i;
      }
    }
    const std::size_t n = outline.corner.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 &before = outline.corner[(i + n - 1) % n], &here = outline.corner[i],
                 &after = outline.corner[(i + 1) % n];
      if (n > 3 && turn(before, here, after, outline.normal) > kStraight * (after - before).squaredNorm())
        corners_.push_back(here);
      for (const Vec3& other : outline.corner) size_[f] = std::max(size_[f], (other - here).norm());
      width_[f] += 0.5 * first.normal.dot((before - outline.corner[0]).cross(here - outline.corner[0]));
    }
    width_[f] /= size_[f];
  }
  first_corner_.push_back(static_cast<std::uint32_t>(corners_.size()));
  first_member_.push_back(static_cast<std::uint32_t>(members_.size()));
}

}  // namespace seaglint
