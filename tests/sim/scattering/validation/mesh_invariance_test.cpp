// SPDX-License-Identifier: BSD-3-Clause
// One surface, other meshes: the echo does not depend on how a body was cut, numbered, split, turned or moved.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/numbers/rotation.h"
#include "tests/measured.h"
#include "tests/sim/geometry/mesh_changes.h"
#include "tests/sim/scattering/solver_fixtures.h"
#include "tests/sim/scattering/validation/random_body.h"

namespace seaglint {
namespace {

using namespace testing_echoes;
using namespace testing_meshes;

// hh and vv in eight views at three frequencies; the body is turned by `turn` and moved by `shift`, and so is the
// radar.
std::vector<Complex> echoes(const TriangleMesh& mesh, const Mat3& turn = Mat3::Identity(),
                            const Vec3& shift = Vec3::Zero()) {
  const Scatterer scatterer(mesh);
  const std::array<double, 3> k{wavenumber(9.9e9), wavenumber(10e9), wavenumber(10.1e9)};
  std::vector<Complex> all;
  for (int i = 0; i < 8; ++i) {
    RadarBasis basis = radar_basis(direction(17 + 45.0 * i, 12 + i));
    for (Vec3* x : {&basis.r, &basis.h, &basis.v}) *x = turn * *x;
    const auto matrices = scattering_matrices(scatterer, monostatic(basis), k, {0, 6, true});
    for (std::size_t q = 0; q < k.size(); ++q) {
      for (const Channel channel : {kHhChannel, kVvChannel})
        all.push_back(matrices[q][channel] * std::polar(1.0, -2 * k[q] * basis.r.dot(shift)));
    }
  }
  return all;
}

double relative_change(const std::vector<Complex>& from, const std::vector<Complex>& to) {
  double change = 0, power = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    change += std::norm(to[i] - from[i]);
    power += std::norm(from[i]);
  }
  return std::sqrt(change / power);
}

// Terms: the choice between contour and point terms at a facet, kContourRatio^-1.5 of its contribution; a few facets
// next to the smallest patch.
TEST(MeshInvariance, OfRandomBodies) {
  double cut = 0, rounded = 0, order = 0, turned = 0, moved = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const TriangleMesh body = random_body(seed);
    const std::vector<Complex> expected = echoes(body);
    Random random({seed, Stream::kTest, 1});
    const Mat3 turn = axis_rotation(1.1, Vec3(1, -2, 0.5).normalized());
    const Vec3 shift(12, -9, 3);
    cut = std::max(cut, relative_change(expected, echoes(cut_in_four(cut_in_four(body)))));
    rounded = std::max(rounded, relative_change(expected, echoes(cut_in_four(body, true))));
    order = std::max(order, relative_change(expected, echoes(split_vertices(renumbered(body, random)))));
    turned = std::max(turned, relative_change(expected, echoes(transformed(body, turn, Vec3::Zero()), turn)));
    moved = std::max(
        moved, relative_change(expected, echoes(transformed(body, Mat3::Identity(), shift), Mat3::Identity(), shift)));
  }
  std::printf("relative change: cut %.4f, cut and rounded %.4f, renumbered and split %.4f, turned %.4f, moved %.4f\n",
              cut, rounded, order, turned, moved);
  record_figure(cut, 4, "mesh_cut_change");
  record_figure(rounded, 4, "mesh_cut_rounded_change");
  record_figure(order, 4, "mesh_renumbered_change");
  record_figure(turned, 4, "mesh_turned_change");
  record_figure(moved, 4, "mesh_moved_change");
  for (const double change : {cut, order, moved}) EXPECT_LT(change, 0.02);
  EXPECT_LT(rounded, 0.1);
  // A turned cylinder has other diagonals in its sides, and the parts of its beams whose rays are limited next to the
  // border of the plate have other shapes (rays_are_limited() of the beam tracer).
  EXPECT_LT(turned, 0.05);
}

}  // namespace
}  // namespace seaglint
