// SPDX-License-Identifier: BSD-3-Clause
// An upright cylinder before a level rectangle whose border cuts the rays that the cylinder spreads, against
// geometrical and physical optics of the exact cylinder (tests/reference/rcs/cylinder_patch.py).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <utility>

#include "sim/core/numbers/rotation.h"
#include "tests/sim/scattering/solver_fixtures.h"
#include "tests/sim/scattering/validation/reference_bodies.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

// Cylinder of so many strips, and a rectangle in z = 0 from (x0, y0) to (x1, y1).
TriangleMesh cylinder_before(const std::array<Vec2, 2>& rectangle, int strips) {
  TriangleMesh body = transformed(make_cylinder(0.5, 1, strips), Mat3::Identity(), {0, 0, 0.5});
  const Vec2 size = rectangle[1] - rectangle[0], centre = 0.5 * (rectangle[0] + rectangle[1]);
  const Mat3 level = axis_rotation(-kPi / 2, Vec3::UnitY());
  body.append(transformed(make_plate(size.y(), size.x()), level, {centre.x(), centre.y(), 0}));
  return body;
}

// Relative error of hh and vv over all views and frequencies. Causes: the parts of beams that are limited next to the
// border, which six halvings leave (rays_are_limited() of the beam tracer), and rays that a flat projection of a wide
// strip does not lead to the rectangle. They fall with the width of the strips.
TEST(CylinderBeforeAPatch, IsThatOfGeometricalAndPhysicalOptics) {
  const std::map<int, std::array<Vec2, 2>> rectangles{{1, {Vec2(0.8, -0.3), Vec2(1.15, 0.25)}},
                                                      {2, {Vec2(0.8, -0.05), Vec2(1.15, 0.05)}}};
  const std::map<std::pair<int, int>, double> reached{{{1, 24}, 0.21},  {{1, 48}, 0.11}, {{1, 96}, 0.035},
                                                      {{1, 768}, 0.02}, {{2, 24}, 0.51}, {{2, 48}, 0.34},
                                                      {{2, 96}, 0.13},  {{2, 768}, 0.03}};
  for (const auto& [place, bound] : reached) {
    const auto& [number, strips] = place;
    const Scatterer body(cylinder_before(rectangles.at(number), strips));
    double error = 0, power = 0;
    for (const auto& row : read_csv("cylinder_patch.csv")) {
      if (std::stoi(row[0]) != number) continue;
      const double k = wavenumber(std::stod(row[3]) * 1e9);
      const auto view = monostatic(radar_basis(direction(std::stod(row[1]), std::stod(row[2]))));
      const auto S = scattering_matrices(body, view, {&k, 1}, {})[0];
      const Complex hh(std::stod(row[4]), std::stod(row[5])), vv(std::stod(row[6]), std::stod(row[7]));
      error += std::norm(S[kHhChannel] - hh) + std::norm(S[kVvChannel] - vv);
      power += std::norm(hh) + std::norm(vv);
    }
    const double relative = std::sqrt(error / power);
    std::printf("rectangle %d, cylinder of %d strips: error %.3f of the echo\n", number, strips, relative);
    EXPECT_LT(relative, bound) << number << ' ' << strips;
    EXPECT_GT(power, 0);
  }
}

}  // namespace
}  // namespace seaglint
