// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Other meshes of the same surface: cut, numbered, split or rounded differently.

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "sim/core/numbers/random.h"
#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint::testing_meshes {

// Uniform integer 0 <= x < n.
inline std::size_t below(Random& random, std::size_t n) { return random.below(static_cast<std::uint32_t>(n)); }

// Every triangle cut into four at the midpoints of its sides, rounded to float32 on request.
inline TriangleMesh cut_in_four(const TriangleMesh& mesh, bool as_float = false) {
  TriangleMesh cut = mesh;
  cut.triangles.clear();
  cut.triangle_part.clear();
  cut.triangle_material.clear();
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle;
  const auto between = [&](std::uint32_t a, std::uint32_t b) {
    const auto [at, is_new] = middle.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(cut.vertices.size()));
    if (is_new) {
      const Vec3 x = 0.5 * (mesh.vertices[a] + mesh.vertices[b]);
      cut.vertices.push_back(as_float ? Vec3(x.cast<float>().cast<double>()) : x);
    }
    return at->second;
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    const std::uint32_t ab = between(a, b), bc = between(b, c), ca = between(c, a);
    for (const auto& triangle :
         {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c}, std::array{ab, bc, ca}}) {
      cut.triangles.push_back(triangle);
      cut.triangle_part.push_back(mesh.triangle_part.empty() ? std::uint16_t{0} : mesh.triangle_part[t]);
      cut.triangle_material.push_back(mesh.triangle_material.empty() ? std::uint16_t{0} : mesh.triangle_material[t]);
    }
  }
  return cut;
}

// Vertices and triangles in random order, triangles starting at a random corner.
inline TriangleMesh renumbered(const TriangleMesh& mesh, Random& random) {
  const auto shuffled = [&](std::size_t n) {
    std::vector<std::uint32_t> order(n);
    std::iota(order.begin(), order.end(), 0u);
    for (std::size_t i = n; i > 1; --i) std::swap(order[i - 1], order[below(random, i)]);
    return order;
  };
  TriangleMesh other = mesh;
  const std::vector<std::uint32_t> place = shuffled(mesh.vertices.size()), source = shuffled(mesh.triangles.size());
  for (std::size_t v = 0; v < place.size(); ++v) other.vertices[place[v]] = mesh.vertices[v];
  for (std::size_t t = 0; t < source.size(); ++t) {
    const auto& from = mesh.triangles[source[t]];
    const std::size_t first = below(random, 3);
    for (std::size_t i = 0; i < 3; ++i) other.triangles[t][i] = place[from[(first + i) % 3]];
    if (!mesh.triangle_part.empty()) other.triangle_part[t] = mesh.triangle_part[source[t]];
    if (!mesh.triangle_material.empty()) other.triangle_material[t] = mesh.triangle_material[source[t]];
  }
  return other;
}

// Every triangle with vertices of its own, as in an STL file.
inline TriangleMesh split_vertices(const TriangleMesh& mesh) {
  TriangleMesh split = mesh;
  split.vertices.clear();
  for (auto& triangle : split.triangles) {
    for (std::uint32_t& v : triangle) {
      split.vertices.push_back(mesh.vertices[v]);
      v = static_cast<std::uint32_t>(split.vertices.size() - 1);
    }
  }
  return split;
}

// Vertices displaced by a normal distribution of this standard deviation in every coordinate, m.
inline TriangleMesh with_noise(const TriangleMesh& mesh, double sigma, Random& random) {
  TriangleMesh noisy = mesh;
  for (Vec3& x : noisy.vertices) {
    for (int i = 0; i < 3; ++i) x[i] += sigma * random.normal();
  }
  return noisy;
}

}  // namespace seaglint::testing_meshes
