// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Helpers that the scattering tests have in common.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/sim/scattering/solve_calls.h"

namespace seaglint::testing_echoes {

inline double norm_of(const CVec3& v) { return std::sqrt(std::norm(v.x()) + std::norm(v.y()) + std::norm(v.z())); }

inline double wavenumber(double frequency_hz) { return 2 * kPi * frequency_hz / kSpeedOfLight; }

inline Vec3 direction(double azimuth_deg, double elevation_deg) {
  const double az = radians(azimuth_deg), el = radians(elevation_deg);
  return {std::cos(el) * std::cos(az), std::cos(el) * std::sin(az), std::sin(el)};
}

inline std::array<Complex, 4> echo(const Scatterer& scatterer, const RadarBasis& basis, double k,
                                   double min_patch_m = 0, int bounces = 8, bool edges = false) {
  return scattering_matrices(scatterer, monostatic(basis), std::array{k}, {min_patch_m, bounces, edges})[0];
}

inline std::array<Complex, 4> echo(const TriangleMesh& mesh, const Vec3& r_hat, double k, double min_patch_m = 0,
                                   int bounces = 8) {
  return echo(Scatterer(mesh), radar_basis(r_hat), k, min_patch_m, bounces);
}

enum Channel { kHhChannel, kHvChannel, kVhChannel, kVvChannel };

inline double largest(const std::array<Complex, 4>& s) {
  double size = 0;
  for (const Complex& x : s) size = std::max(size, std::abs(x));
  return size;
}

// The L2 norm of differences from references over that of the references.
struct RelativeError {
  double error = 0, power = 0;
  void add(const Complex& found, const Complex& reference) {
    error += std::norm(found - reference);
    power += std::norm(reference);
  }
  void add_co_polar(const Matrices& found, const Matrices& reference) {
    for (std::size_t q = 0; q < reference.size(); ++q)
      for (const std::size_t element : {0u, 3u}) add(found[q][element], reference[q][element]);
  }
  double value() const { return std::sqrt(error / power); }
  double db() const { return 10 * std::log10(error / power); }
};

// make_plate() cut into `cells` squares along either side, two triangles each.
inline TriangleMesh cut_plate(double length, double width, std::uint32_t cells) {
  TriangleMesh cut = make_plate(length, width);
  cut.vertices.clear();
  cut.triangles.clear();
  for (std::uint32_t j = 0; j <= cells; ++j)
    for (std::uint32_t i = 0; i <= cells; ++i)
      cut.vertices.push_back({0, length * i / cells - length / 2, width * j / cells - width / 2});
  for (std::uint32_t j = 0; j < cells; ++j) {
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t a = j * (cells + 1) + i, b = a + 1, c = a + cells + 1, d = c + 1;
      cut.triangles.push_back({a, b, d});
      cut.triangles.push_back({a, d, c});
    }
  }
  cut.triangle_part.assign(cut.triangles.size(), 0);
  cut.triangle_material.assign(cut.triangles.size(), 0);
  return cut;
}

// A square trihedral with a tilted plate in front of it: first, second and third bounces, shadowing of the incident and
// the exit path.
inline TriangleMesh stepped_corner() {
  TriangleMesh mesh = make_square_trihedral(0.4);
  mesh.append(
      transformed(make_plate(0.11, 0.13), axis_rotation(0.4, Vec3(1, 2, 0.5).normalized()), {0.35, 0.22, 0.17}));
  return mesh;
}

// The paper's interval: 8 carriers by 25 MHz from 16 GHz, 40 frequencies each, 256 pulses by 250 us.
inline IntervalSampling paper_interval(double start_s) {
  IntervalSampling sampling;
  sampling.step_hz = 0.625e6;
  sampling.first_hz = 16e9 - 12.5e6 + 0.5 * sampling.step_hz;
  sampling.count = 320;
  sampling.frequencies_per_pulse = 40;
  Random random({7, Stream::kTest, 0});
  for (int n = 0; n < 256; ++n) {
    sampling.pulse_first.push_back(40 * static_cast<int>(random.below(8)));
    sampling.pulse_time_s.push_back(start_s + 250e-6 * n);
  }
  return sampling;
}

// Rows of a table in tests/reference/rcs without its heading and comments.
inline std::vector<std::vector<std::string>> read_csv(const std::string& name) {
  std::ifstream file(SEAGLINT_SOURCE_DIR "/tests/reference/rcs/" + name);
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#' || !(std::isdigit(line[0]) || line[0] == '-')) continue;
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  EXPECT_FALSE(rows.empty()) << name;
  return rows;
}

// A box, an ellipsoid and a cylinder upright on a plate, at random places.
inline TriangleMesh random_body(std::uint64_t seed) {
  Random random({seed, Stream::kTest, 0});
  const auto between = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  const auto upright = [&](const TriangleMesh& mesh, const Vec3& place) {
    return transformed(mesh, axis_rotation(between(0, 2 * kPi), Vec3::UnitZ()), place);
  };
  TriangleMesh body = transformed(make_plate(2, 2), axis_rotation(-kPi / 2, Vec3::UnitY()), {0, 0, between(-0.1, 0.1)});
  TriangleMesh ellipsoid = make_sphere(0.25, 3);
  for (Vec3& x : ellipsoid.vertices) x = x.cwiseProduct(Vec3(between(0.5, 2), 1, between(0.5, 1)));
  body.append(upright(ellipsoid, {between(-0.6, -0.4), between(-0.6, 0.6), 0.5}));
  body.append(upright(make_cylinder(between(0.1, 0.2), 0.5, 40), {between(0.1, 0.3), between(0.3, 0.6), 0.4}));
  MeshBuilder box;
  box.begin_part("box");
  Pose pose;
  pose.R = axis_rotation(between(0, 1), Vec3(0.1, 0, 1).normalized());
  pose.p = {between(0.1, 0.5), between(-0.6, -0.3), 0.35};
  add_box(box, pose, {0.4, 0.3, 0.4});
  body.append(box.take());
  return body;
}

// Area normal to the direction that returns after three bounces, for edges of length 1 and direction cosines l <= m <=
// n (R. C. Spencer, Optical Theory of the Corner Reflector, MIT Radiation Laboratory report 433, 1944; J. W. Crispin
// and K. M. Siegel, Methods of Radar Cross-Section Analysis, 1968, ch. 2).
inline double triangular_aperture(double l, double m, double n) {
  const double sum = l + m + n;
  return l + m >= n ? sum - 2 / sum : 4 * l * m / sum;
}
inline double square_aperture(double l, double m, double n) { return m >= n / 2 ? l * (4 - n / m) : 4 * l * m / n; }

// Bodies solved by the integral equations of tests/reference/rcs.

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
  for (const double z : {-height / 2, height / 2})
    for (const Vec2& corner : corners) mesh.vertices.push_back({corner.x(), corner.y(), z});
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
