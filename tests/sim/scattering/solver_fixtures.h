// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Helpers that the scattering tests have in common.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/sim/scattering/solve_calls.h"

namespace seaglint::testing_echoes {

inline double norm_of(const CVec3& v) { return std::sqrt(std::norm(v.x()) + std::norm(v.y()) + std::norm(v.z())); }

inline double wavenumber(double frequency_hz) { return 2 * kPi * frequency_hz / kSpeedOfLight; }

inline double dbsm(const Complex& s) { return 10 * std::log10(4 * kPi * std::norm(s)); }

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

// make_plate() cut into `cells` squares along either side, two triangles each.
inline TriangleMesh cut_plate(double length, double width, std::uint32_t cells) {
  TriangleMesh cut = make_plate(length, width);
  cut.vertices.clear();
  cut.triangles.clear();
  for (std::uint32_t j = 0; j <= cells; ++j) {
    for (std::uint32_t i = 0; i <= cells; ++i)
      cut.vertices.push_back({0, length * i / cells - length / 2, width * j / cells - width / 2});
  }
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

}  // namespace seaglint::testing_echoes
