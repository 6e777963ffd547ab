// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/mesh/triangulate_polygon.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"

namespace seaglint {

namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

constexpr double kRounding =
    2.5e-7;                        // of a coordinate: four roundings to float32, which most files' numbers have passed
constexpr double kOverlap = 1e-6;  // of the polygon's area: largest area of a fan triangle with opposite orientation

// Newell's method (Sutherland, Sproull and Schumacker, ACM Computing Surveys 6, 1974, 1-55): twice the area vector.
Vec3 newell(std::span<const Vec3> corner) {
  Vec3 normal = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < corner.size(); ++i)
    normal += (corner[i] - corner[0]).cross(corner[i + 1] - corner[0]);
  return normal;
}

// Bound of the rounding error of the vertex positions, m.
double rounding_of(std::span<const Vec3> corner) {
  double farthest = 0;
  for (const Vec3& p : corner) farthest = std::max(farthest, p.cwiseAbs().maxCoeff());
  return kRounding * farthest;
}

// True for a polygon that is a line to rounding.
bool is_flat(std::span<const Vec3> corner, double rounding) {
  double extent = 0, height = 0;
  for (std::size_t i = 1; i < corner.size(); ++i) extent = std::max(extent, (corner[i] - corner[0]).norm());
  for (std::size_t i = 1; i + 1 < corner.size(); ++i)
    height = std::max(height, (corner[i] - corner[0]).cross(corner[i + 1] - corner[0]).norm());
  return height <= rounding * extent;
}

Triangles fan(std::size_t corners) {
  Triangles triangles;
  for (std::uint32_t i = 1; i + 1 < corners; ++i) triangles.push_back({0, i, i + 1});
  return triangles;
}

// A fan whose triangles all have the orientation of the polygon covers each point as often as the polygon winds about
// it, so it is a triangulation unless the polygon winds more than once.
bool fan_covers(std::span<const Vec3> corner, const Vec3& area_vector, double rounding) {
  const Vec3 normal = area_vector.normalized();
  double sweep = 0;
  for (std::size_t i = 1; i + 1 < corner.size(); ++i) {
    const Vec3 a = corner[i] - corner[0], b = corner[i + 1] - corner[0];
    const double area = normal.dot(a.cross(b));
    if (area < -rounding * std::max(a.norm(), b.norm()) - kOverlap * area_vector.norm()) return false;
    sweep += std::atan2(std::max(area, 0.0), a.dot(b));
  }
  // Two triangles cannot wind more than once.
  return corner.size() == 4 || sweep < 2 * kPi;
}

// Twice the signed area of a triangle in the plane, positive counter-clockwise.
double twice_signed_area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// Winding number of the polygon about the point, by crossings of the ray towards +x.
int winding(const std::vector<Vec2>& corner, const Vec2& p) {
  int rounds = 0;
  for (std::size_t i = 0; i < corner.size(); ++i) {
    const Vec2 &a = corner[i], &b = corner[(i + 1) % corner.size()];
    if (a.y() <= p.y() && b.y() > p.y() && twice_signed_area(a, b, p) > 0) ++rounds;
    if (a.y() > p.y() && b.y() <= p.y() && twice_signed_area(a, b, p) < 0) --rounds;
  }
  return rounds;
}

// Kinds of ears in order of preference; the last two are clipped only where no better ear remains.
enum class Ear { kClear, kTouched, kFlat };

// Ear clipping: every simple polygon has two ears (Meisters, American Mathematical Monthly 82, 1975, 648-651; Eberly,
// Triangulation by Ear Clipping, 1998).
class EarClipper {
 public:
  EarClipper(std::vector<Vec2> corner, double rounding)
      : corner_(std::move(corner)), rounding_(rounding), left_(corner_.size()) {
    for (std::uint32_t i = 0; i < left_.size(); ++i) left_[i] = i;
  }

  // Empty where no ear remains or a clipped triangle is outside of the polygon, as for self-intersecting polygons.
  Triangles clip() {
    Triangles triangles;
    // Each round tests every vertex once; a few rounds per kind suffice for most polygons.
    std::size_t tries = 64 * left_.size(), fruitless = 0, at = 0;
    Ear kind = Ear::kClear;
    while (left_.size() > 3) {
      if (tries-- == 0) return {};
      if (fruitless++ == left_.size()) {
        if (kind == Ear::kFlat) return {};
        kind = kind == Ear::kClear ? Ear::kTouched : Ear::kFlat;
        fruitless = 1;
      }
      at %= left_.size();
      if (!is_ear(at, kind)) {
        ++at;
        continue;
      }
      triangles.push_back(triangle(at));
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(at));
      // The adjacent vertices may have become ears.
      at = (at + left_.size() - 1) % left_.size();
      fruitless = 0;
      kind = Ear::kClear;
    }
    triangles.push_back(triangle(1));
    for (const auto& [a, b, c] : triangles) {
      const double area = twice_signed_area(corner_[a], corner_[b], corner_[c]),
                   tolerance = min_area(corner_[a], corner_[b], corner_[c]);
      if (area < -tolerance) return {};
      if (area > tolerance && winding(corner_, (corner_[a] + corner_[b] + corner_[c]) / 3) != 1) return {};
    }
    return triangles;
  }

 private:
  std::array<std::uint32_t, 3> triangle(std::size_t at) const {
    const std::size_t n = left_.size();
    return {left_[(at + n - 1) % n], left_[at], left_[(at + 1) % n]};
  }

  // Twice the area that rounding alone can produce, m^2.
  double min_area(const Vec2& a, const Vec2& b, const Vec2& c) const {
    return rounding_ * std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  }

  bool is_ear(std::size_t at, Ear kind) const {
    const auto [i, j, k] = triangle(at);
    const Vec2 &a = corner_[i], &b = corner_[j], &c = corner_[k];
    const double area = twice_signed_area(a, b, c), tolerance = min_area(a, b, c);
    if (kind == Ear::kFlat) return std::abs(area) <= tolerance;
    if (area <= tolerance) return false;
    // A vertex on the boundary of the ear would be left on a side that ends elsewhere.
    const double margin = kind == Ear::kClear ? -rounding_ : rounding_;
    const auto inside = [&](const Vec2& from, const Vec2& to, const Vec2& p) {
      return twice_signed_area(from, to, p) > margin * (to - from).norm();
    };
    return std::none_of(left_.begin(), left_.end(), [&](std::uint32_t other) {
      const Vec2& p = corner_[other];
      if (p == a || p == b || p == c) return false;
      return inside(a, b, p) && inside(b, c, p) && inside(c, a, p);
    });
  }

  std::vector<Vec2> corner_;
  double rounding_;  // m
  std::vector<std::uint32_t> left_;
};

// Indices of the vertices without those at which the polygon turns back the same way, and without repeated ones.
std::vector<std::uint32_t> without_spikes(std::span<const Vec3> corner) {
  std::vector<std::uint32_t> kept;
  const auto same = [&](std::uint32_t a, std::uint32_t b) { return corner[a] == corner[b]; };
  for (std::uint32_t i = 0; i < corner.size(); ++i) {
    kept.push_back(i);
    while (true) {
      const std::size_t n = kept.size();
      if (n >= 2 && same(kept[n - 1], kept[n - 2])) {
        kept.pop_back();
      } else if (n >= 3 && same(kept[n - 1], kept[n - 3])) {
        kept.resize(n - 2);
      } else {
        break;
      }
    }
  }
  std::size_t begin = 0, end = kept.size();
  while (end - begin >= 2) {
    if (same(kept[begin], kept[end - 1])) {
      --end;
    } else if (end - begin >= 3 && same(kept[begin + 1], kept[end - 1])) {
      ++begin;
    } else if (end - begin >= 3 && same(kept[begin], kept[end - 2])) {
      --end;
    } else {
      break;
    }
  }
  return {kept.begin() + static_cast<std::ptrdiff_t>(begin), kept.begin() + static_cast<std::ptrdiff_t>(end)};
}

}  // namespace

std::optional<Triangles> triangulate_polygon(std::span<const Vec3> corner) {
  const Vec3 area = newell(corner);
  const double rounding = rounding_of(corner);
  if (corner.size() == 3 || is_flat(corner, rounding)) return fan(corner.size());
  if (!(area.norm() > 0)) return std::nullopt;
  if (fan_covers(corner, area, rounding)) return fan(corner.size());
  if (corner.size() > kMaxConcaveVertices) return std::nullopt;

  // Projection onto the plane, the normal towards the viewer.
  const Vec3 normal = area.normalized(), right = normal.unitOrthogonal(), up = normal.cross(right);
  std::vector<Vec2> flat;
  for (const Vec3& p : corner) flat.emplace_back((p - corner[0]).dot(right), (p - corner[0]).dot(up));
  Triangles triangles = EarClipper(std::move(flat), rounding).clip();
  if (triangles.empty()) return std::nullopt;
  return triangles;
}

std::vector<std::string> OddPolygons::sentences() const {
  std::vector<std::string> list;
  const auto add = [&](std::size_t count, const char* one, const char* many, const char* treatment) {
    if (count == 0) return;
    list.push_back(
        fmt::format("{} {}: {} (the first odd polygon: {})", count, count == 1 ? one : many, treatment, first_place));
  };
  constexpr const char* kFan = "taken as the fan of the first corner";
  add(too_few, "polygon has fewer than three corners", "polygons have fewer than three corners", "dropped");
  add(without_area, "polygon goes out and back without area", "polygons go out and back without area", "dropped");
  add(crossing, "polygon crosses itself", "polygons cross themselves", kFan);
  add(large, "concave polygon has too many corners", "concave polygons have too many corners", kFan);
  return list;
}

Triangles triangles_of_polygon(std::span<const Vec3> corner, OddPolygons& odd,
                               const std::function<std::string()>& place) {
  if (corner.size() < 3) {
    if (odd.first_place.empty()) odd.first_place = place();
    ++odd.too_few;
    return {};
  }
  const std::vector<std::uint32_t> kept = without_spikes(corner);
  std::optional<Triangles> triangles;
  if (corner.size() == 3 || kept.size() == corner.size()) {
    triangles = triangulate_polygon(corner);
  } else if (kept.size() >= 3) {
    std::vector<Vec3> rest;
    for (const std::uint32_t i : kept) rest.push_back(corner[i]);
    triangles = triangulate_polygon(rest);
    if (triangles) {
      for (auto& triangle : *triangles) {
        for (std::uint32_t& i : triangle) i = kept[i];
      }
    }
  }
  if (triangles) return *triangles;
  if (odd.first_place.empty()) odd.first_place = place();
  if (kept.size() < 3) {
    ++odd.without_area;
    return {};
  }
  ++(corner.size() > kMaxConcaveVertices ? odd.large : odd.crossing);
  return fan(corner.size());
}

std::optional<double> coordinate_of(double value) {
  if (!(std::abs(value) <= 1e30)) return std::nullopt;
  return std::abs(value) < 1e-30 ? 0.0 : value;
}

}  // namespace seaglint
