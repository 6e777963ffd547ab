// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Bodies solved by the integral equations of tests/reference/rcs.

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint::testing_echoes {

// The cross-sections of sections.py, counter-clockwise, m.
inline const std::map<std::string, std::vector<Vec2>>& sections() {
  static const auto all = [] {
    std::map<std::string, std::vector<Vec2>> result{
        {"box", {{-0.05, -0.075}, {0.05, -0.075}, {0.05, 0.075}, {-0.05, 0.075}}},
        {"knife", {{-0.1, 0}, {0.1, -0.02}, {0.1, 0.02}}}};
    const auto chevron = [](double half, double arm) -> std::vector<Vec2> {
      const Vec2 end = arm * Vec2(std::cos(half), std::sin(half)),
                 back = end + 0.04 * Vec2(-std::sin(half), std::cos(half));
      return {{0, 0}, end, back, {-0.04 / std::sin(half), 0}, {back.x(), -back.y()}, {end.x(), -end.y()}};
    };
    result["chevron"] = chevron(radians(75), 0.1);
    result["dihedral"] = chevron(radians(45), 0.15);
    result["dihedral85"] = chevron(radians(42.5), 0.15);
    result["dihedral95"] = chevron(radians(47.5), 0.15);
    result["dihedral90long"] = chevron(radians(45), 0.6);
    result["dihedral95long"] = chevron(radians(47.5), 0.6);
    for (const double at : {10.0, 130.0, 250.0})
      result["triangle"].push_back(0.1 * Vec2(std::cos(radians(at)), std::sin(radians(at))));
    return result;
  }();
  return all;
}

// An upright prism, its middle at z = 0; all of the cross-section is visible from its first vertex.
inline TriangleMesh prism(const std::vector<Vec2>& corners, double height) {
  TriangleMesh mesh;
  const auto n = static_cast<std::uint32_t>(corners.size());
  for (const double z : {-height / 2, height / 2}) {
    for (const Vec2& corner : corners) mesh.vertices.push_back({corner.x(), corner.y(), z});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    mesh.triangles.push_back({i, next, n + next});
    mesh.triangles.push_back({i, n + next, n + i});
  }
  for (std::uint32_t i = 1; i + 1 < n; ++i) {
    mesh.triangles.push_back({0, i + 1, i});
    mesh.triangles.push_back({n, n + i, n + i + 1});
  }
  return mesh;
}

// block_ship.py's hull of 6 x 1.6 x 1.2 with a house of 1.8 x 1 x 1.2 on the middle of its deck.
inline TriangleMesh block_ship() {
  TriangleMesh mesh;
  const auto rectangle = [&mesh](double half_length, double half_width, double z) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
      mesh.vertices.push_back({x * half_length, y * half_width, z});
    return first;
  };
  const auto quad = [&mesh](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  const std::uint32_t keel = rectangle(3, 0.8, 0), deck = rectangle(3, 0.8, 1.2), foot = rectangle(0.9, 0.5, 1.2),
                      roof = rectangle(0.9, 0.5, 2.4);
  quad(keel, keel + 3, keel + 2, keel + 1);
  quad(roof, roof + 1, roof + 2, roof + 3);
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t next = (i + 1) % 4;
    quad(keel + i, keel + next, deck + next, deck + i);
    quad(deck + i, deck + next, foot + next, foot + i);
    quad(foot + i, foot + next, roof + next, roof + i);
  }
  mesh.triangle_part.assign(mesh.triangles.size(), 0);
  mesh.triangle_material.assign(mesh.triangles.size(), 0);
  return mesh;
}

}  // namespace seaglint::testing_echoes
