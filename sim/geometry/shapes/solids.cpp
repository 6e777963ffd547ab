// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/shapes/solids.h"

#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/geometry/shapes/generators.h"

namespace seaglint {
namespace {

std::vector<std::uint32_t> add_ring(MeshBuilder& builder, const std::vector<Vec3>& ring) {
  std::vector<std::uint32_t> indices;
  for (const Vec3& p : ring) indices.push_back(builder.vertex(p));
  return indices;
}

// Two unit vectors that complete an axis to a right-handed frame; the first as horizontal as possible.
std::pair<Vec3, Vec3> across(const Vec3& axis) {
  const Vec3 level = std::abs(axis.z()) > 0.999 ? Vec3::UnitX() : Vec3(Vec3::UnitZ().cross(axis).normalized());
  return {level, axis.cross(level)};
}

}  // namespace

void add_frustum(MeshBuilder& builder, const std::vector<Vec3>& lower, const std::vector<Vec3>& upper) {
  const auto low = add_ring(builder, lower), high = add_ring(builder, upper);
  const std::size_t n = low.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    builder.quad(low[i], low[j], high[j], high[i]);
  }
  for (std::size_t i = 1; i + 1 < n; ++i) {
    builder.triangle(low[0], low[i + 1], low[i]);
    builder.triangle(high[0], high[i], high[i + 1]);
  }
}

void add_box(MeshBuilder& builder, const Pose& pose, const Vec3& size) {
  const double x = 0.5 * size.x(), y = 0.5 * size.y(), z = size.z();
  add_frustum(builder, {pose * Vec3(-x, -y, 0), pose * Vec3(x, -y, 0), pose * Vec3(x, y, 0), pose * Vec3(-x, y, 0)},
              {pose * Vec3(-x, -y, z), pose * Vec3(x, -y, z), pose * Vec3(x, y, z), pose * Vec3(-x, y, z)});
}

void add_cone(MeshBuilder& builder, const Vec3& from, const Vec3& to, double radius_from, double radius_to, int sides) {
  const auto [u, v] = across((to - from).normalized());
  std::vector<Vec3> lower, upper;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * kPi * i / sides;
    const Vec3 out = std::cos(angle) * u + std::sin(angle) * v;
    lower.push_back(from + radius_from * out);
    upper.push_back(to + radius_to * out);
  }
  add_frustum(builder, lower, upper);
}

void add_bar(MeshBuilder& builder, const Vec3& from, const Vec3& to, double width) {
  const auto [u, v] = across((to - from).normalized());
  const double w = 0.5 * width;
  std::vector<Vec3> lower, upper;
  for (const Vec3& out : {Vec3(w * (-u - v)), Vec3(w * (u - v)), Vec3(w * (u + v)), Vec3(w * (v - u))}) {
    lower.push_back(from + out);
    upper.push_back(to + out);
  }
  add_frustum(builder, lower, upper);
}

void add_plate(MeshBuilder& builder, const std::vector<Vec3>& outline, double thickness) {
  const Vec3 normal = (outline[1] - outline[0]).cross(outline[2] - outline[0]).normalized();
  std::vector<Vec3> back;
  for (const Vec3& p : outline) back.push_back(p - thickness * normal);
  add_frustum(builder, back, outline);
}

void add_open_box(MeshBuilder& builder, const Pose& pose, const Vec3& size, double wall) {
  const double x = 0.5 * size.x(), y = 0.5 * size.y(), z = size.z();
  const auto ring = [&](double at, double inset) {
    return add_ring(builder, {pose * Vec3(at, -y + inset, inset), pose * Vec3(at, y - inset, inset),
                              pose * Vec3(at, y - inset, z - inset), pose * Vec3(at, -y + inset, z - inset)});
  };
  const auto back = ring(-x, 0), rim = ring(x, 0), lip = ring(x, wall), floor = ring(-x + wall, wall);
  const auto band = [&](const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
    for (std::size_t i = 0; i < 4; ++i) builder.quad(a[i], a[(i + 1) % 4], b[(i + 1) % 4], b[i]);
  };
  band(back, rim);
  band(rim, lip);
  band(lip, floor);
  builder.quad(back[3], back[2], back[1], back[0]);
  builder.quad(floor[0], floor[1], floor[2], floor[3]);
}

void add_corner_plates(MeshBuilder& builder, const Pose& pose, const Vec3& legs, double thickness) {
  // The plates extend behind the apex by their thickness, so that their edges do not coincide.
  const double t = thickness, x = legs.x(), y = legs.y(), z = legs.z();
  const auto slab = [&](const Vec3& low, const Vec3& high) {
    const Vec3 middle = 0.5 * (low + high), size = high - low;
    add_box(builder, pose * Pose{Vec3(middle.x(), middle.y(), low.z()), Mat3::Identity()}, size);
  };
  slab({-t, -t, -t}, {x, y, 0});
  slab({-0.8 * t, -0.9 * t, -0.5 * t}, {0, 0.99 * y, z});
  slab({-0.5 * t, -0.8 * t, -0.4 * t}, {0.99 * x, 0, 0.99 * z});
}

void add_sphere(MeshBuilder& builder, const Vec3& centre, double radius, int subdivisions) {
  const TriangleMesh sphere = make_sphere(radius, subdivisions);
  const auto base = static_cast<std::uint32_t>(builder.vertices().size());
  for (const Vec3& p : sphere.vertices) builder.vertex(centre + p);
  for (const auto& [a, b, c] : sphere.triangles) builder.triangle(base + a, base + b, base + c);
}

}  // namespace seaglint
