// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/shapes/generators.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

namespace {

// Written so that a NaN fails.
void require_size(double value, const char* name) {
  if (!(value >= kMinSize && value <= kLargestSize))
    throw InputError(fmt::format("{}: {} m is outside {:g}..{:g} m", name, value, kMinSize, kLargestSize));
}

void require_count(int value, int min, int max, const char* name) {
  if (value < min || value > max) throw InputError(fmt::format("{}: {} is outside {}..{}", name, value, min, max));
}

using Triangle = std::array<std::uint32_t, 3>;

struct Icosahedron {
  std::array<Vec3, 12> vertices;
  std::array<Triangle, 20> faces;  // counter-clockwise seen from outside
};

// Edge 2: the cyclic permutations of (0, +-1, +-golden ratio). Faces are the 20 triples at mutual distance 2, found in
// index order.
Icosahedron icosahedron() {
  const double phi = 0.5 * (1.0 + std::sqrt(5.0));
  Icosahedron solid;
  int n = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (double one : {1.0, -1.0}) {
      for (double golden : {phi, -phi}) {
        Vec3 p = Vec3::Zero();
        p[(axis + 1) % 3] = one;
        p[(axis + 2) % 3] = golden;
        solid.vertices[n++] = p;
      }
    }
  }
  const auto are_adjacent = [&](int a, int b) {
    return std::abs((solid.vertices[a] - solid.vertices[b]).norm() - 2.0) < 1e-9;
  };
  int f = 0;
  for (std::uint32_t a = 0; a < 12; ++a) {
    for (std::uint32_t b = a + 1; b < 12; ++b) {
      for (std::uint32_t c = b + 1; c < 12; ++c) {
        if (!are_adjacent(a, b) || !are_adjacent(b, c) || !are_adjacent(c, a)) continue;
        const auto& v = solid.vertices;
        const bool outward = (v[b] - v[a]).cross(v[c] - v[a]).dot(v[a]) > 0;
        solid.faces[f++] = outward ? Triangle{a, b, c} : Triangle{a, c, b};
      }
    }
  }
  SEAGLINT_CHECK(f == 20, fmt::format("{} faces", f));
  return solid;
}

}  // namespace

TriangleMesh make_plate(double length, double width) {
  require_size(length, "plate length");
  require_size(width, "plate width");
  MeshBuilder builder;
  builder.begin_part("plate");
  const double y = 0.5 * length, z = 0.5 * width;
  const auto a = builder.vertex({0, -y, -z}), b = builder.vertex({0, y, -z});
  const auto c = builder.vertex({0, y, z}), d = builder.vertex({0, -y, z});
  builder.quad(a, b, c, d);
  return builder.take();
}

TriangleMesh make_dihedral(double length, double width, double opening) {
  require_size(length, "dihedral length");
  require_size(width, "dihedral width");
  if (!(opening > 0 && opening < kPi)) {
    throw InputError(
        fmt::format("dihedral opening: {} deg must be greater than 0 and less than 180 deg", degrees(opening)));
  }
  MeshBuilder builder;
  builder.begin_part("dihedral");
  const double z = 0.5 * length, x = width * std::cos(0.5 * opening), y = width * std::sin(0.5 * opening);
  const auto low = builder.vertex({0, 0, -z}), high = builder.vertex({0, 0, z});
  const auto port_low = builder.vertex({x, y, -z}), port_high = builder.vertex({x, y, z});
  const auto starboard_low = builder.vertex({x, -y, -z}), starboard_high = builder.vertex({x, -y, z});
  builder.quad(low, port_low, port_high, high);
  builder.quad(low, high, starboard_high, starboard_low);
  return builder.take();
}

TriangleMesh make_triangular_trihedral(double leg) {
  require_size(leg, "trihedral leg");
  MeshBuilder builder;
  builder.begin_part("trihedral");
  const auto apex = builder.vertex(Vec3::Zero());
  const auto x = builder.vertex({leg, 0, 0}), y = builder.vertex({0, leg, 0}), z = builder.vertex({0, 0, leg});
  builder.triangle(apex, y, z);
  builder.triangle(apex, z, x);
  builder.triangle(apex, x, y);
  return builder.take();
}

TriangleMesh make_square_trihedral(double leg) {
  require_size(leg, "trihedral leg");
  MeshBuilder builder;
  builder.begin_part("trihedral");
  const auto apex = builder.vertex(Vec3::Zero());
  const auto x = builder.vertex({leg, 0, 0}), y = builder.vertex({0, leg, 0}), z = builder.vertex({0, 0, leg});
  const auto yz = builder.vertex({0, leg, leg}), zx = builder.vertex({leg, 0, leg}), xy = builder.vertex({leg, leg, 0});
  builder.quad(apex, y, yz, z);
  builder.quad(apex, z, zx, x);
  builder.quad(apex, x, xy, y);
  return builder.take();
}

TriangleMesh make_sphere(double radius, int subdivisions) {
  require_size(radius, "sphere radius");
  require_count(subdivisions, 0, 8, "sphere subdivisions");
  const Icosahedron solid = icosahedron();
  std::vector<Vec3> directions;
  for (const Vec3& p : solid.vertices) directions.push_back(p.normalized());
  std::vector<Triangle> faces(solid.faces.begin(), solid.faces.end());

  for (int level = 0; level < subdivisions; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> midpoint_of;
    const auto midpoint = [&](std::uint32_t a, std::uint32_t b) {
      const auto [place, is_new] =
          midpoint_of.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(directions.size()));
      if (is_new) directions.push_back((directions[a] + directions[b]).normalized());
      return place->second;
    };
    std::vector<Triangle> finer;
    finer.reserve(4 * faces.size());
    for (const auto& [a, b, c] : faces) {
      const std::uint32_t ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    faces = std::move(finer);
  }

  MeshBuilder builder;
  builder.begin_part("sphere");
  for (const Vec3& direction : directions) builder.vertex(radius * direction);
  for (const auto& [a, b, c] : faces) builder.triangle(a, b, c);
  return builder.take();
}

TriangleMesh make_cylinder(double radius, double height, int segments) {
  require_size(radius, "cylinder radius");
  require_size(height, "cylinder height");
  require_count(segments, 3, 100000, "cylinder segments");
  MeshBuilder builder;
  builder.begin_part("cylinder");
  const double z = 0.5 * height;
  const auto bottom = builder.vertex({0, 0, -z}), top = builder.vertex({0, 0, z});
  const auto count = static_cast<std::uint32_t>(segments);
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2.0 * kPi * i / segments;
    builder.vertex({radius * std::cos(angle), radius * std::sin(angle), -z});
    builder.vertex({radius * std::cos(angle), radius * std::sin(angle), z});
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t low = 2 + 2 * i, next = 2 + 2 * ((i + 1) % count);
    builder.quad(low, next, next + 1, low + 1);
    builder.triangle(bottom, next, low);
    builder.triangle(top, low + 1, next + 1);
  }
  return builder.take();
}

TriangleMesh make_icosahedral_reflector(double edge) {
  require_size(edge, "reflector edge");
  const Icosahedron solid = icosahedron();

  // Rotate the solid so that its first face has the normal +x and the first vertex of that face is the upper one, in
  // the plane y = 0.
  const auto& [a0, b0, c0] = solid.faces[0];
  const Vec3 facing = (solid.vertices[a0] + solid.vertices[b0] + solid.vertices[c0]).normalized();
  const Vec3 up = (solid.vertices[a0] - facing * facing.dot(solid.vertices[a0])).normalized();
  const Mat3 R = Mat3(facing, up.cross(facing), up).transpose();

  MeshBuilder builder;
  for (const Vec3& p : solid.vertices) builder.vertex((0.5 * edge * R) * p);
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const auto& [a, b, c] = solid.faces[f];
    const Vec3 centre = (builder.vertices()[a] + builder.vertices()[b] + builder.vertices()[c]) / 3.0;
    // Three mutually perpendicular legs s/sqrt2 end in an equilateral triangle of side s; their apex lies s/sqrt6 below
    // its centre.
    const auto apex = builder.vertex(centre - centre.normalized() * edge / std::sqrt(6.0));
    builder.begin_part(fmt::format("cell_{:02d}", f + 1));
    builder.triangle(a, b, apex);
    builder.triangle(b, c, apex);
    builder.triangle(c, a, apex);
  }
  return builder.take();
}

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
