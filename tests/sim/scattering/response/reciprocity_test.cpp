// SPDX-License-Identifier: BSD-3-Clause
// Reciprocity of scattering matrices and of their contributions: one antenna, two antennas, over the sea.
#include "sim/scattering/response/reciprocity.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/sim/scattering/solver_fixtures.h"
#include "tests/sim/scattering/validation/reference_bodies.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

constexpr double kRounding = 1e-12;
const std::array kBand{2 * kPi * 0.95, 2 * kPi, 2 * kPi * 1.05};

// A house on a hull, turned so that no face is along an axis: many bounces, large cross-polarisation.
const Scatterer& turned_ship() {
  static const Scatterer ship(
      transformed(block_ship(), Eigen::AngleAxisd(0.4, Vec3(1, 2, -0.5).normalized()).toRotationMatrix(), {3, -1, 2}));
  return ship;
}

double distance(const std::array<Complex, 4>& a, const std::array<Complex, 4>& b) {
  double sum = 0;
  for (int i = 0; i < 4; ++i) sum += std::norm(a[i] - b[i]);
  return std::sqrt(sum);
}

std::array<Complex, 4> transposed(const std::array<Complex, 4>& s) { return {s[0], s[2], s[1], s[3]}; }

TEST(Reciprocity, OneAntennaHasEqualCrossPolarisations) {
  double one_way = 0, cross = 0;
  for (const double azimuth : {12.0, 33.0, 71.0, 130.0}) {
    const std::array view{monostatic(radar_basis(direction(azimuth, 17)))};
    const auto echoes = scattering_matrices(turned_ship(), view, kBand, {})[0];
    const auto from_transmitter = one_way_matrices(turned_ship(), view, kBand, {})[0];
    for (std::size_t q = 0; q < kBand.size(); ++q) {
      EXPECT_EQ(echoes[q][kHvChannel], echoes[q][kVhChannel]) << azimuth;
      EXPECT_EQ(echoes[q][kHhChannel], from_transmitter[q][kHhChannel]) << azimuth;
      one_way += std::norm(from_transmitter[q][kHvChannel] - from_transmitter[q][kVhChannel]);
      cross += std::norm(echoes[q][kHvChannel]);
    }
  }
  std::printf("one antenna: |hv - vh| of the beams alone %.3f of hv\n", std::sqrt(one_way / cross));
  EXPECT_GT(one_way, 0.01 * cross);  // else the first check would hold without the mean
}

TEST(Reciprocity, ExchangedAntennasGiveTheTransposedMatrix) {
  for (const double apart : {5.0, 40.0, 100.0}) {
    const RadarBasis a = radar_basis(direction(33, 17)), b = radar_basis(direction(33 + apart, 8));
    const auto there = scattering_matrices(turned_ship(), bistatic(a, b), kBand, {}),
               back = scattering_matrices(turned_ship(), bistatic(b, a), kBand, {});
    for (std::size_t q = 0; q < kBand.size(); ++q)
      EXPECT_LT(distance(there[q], transposed(back[q])), kRounding * largest(there[q])) << apart;
  }
}

TEST(Reciprocity, SeveralReceiversGiveWhatEachGivesAlone) {
  const RadarBasis a = radar_basis(direction(33, 17)), b = radar_basis(direction(60, 8)),
                   c = radar_basis(direction(20, 10));
  const std::array pairs{bistatic(a, b), monostatic(a), bistatic(b, a), bistatic(a, c)};
  const auto together = scattering_matrices(turned_ship(), pairs, kBand, {});
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto alone = scattering_matrices(turned_ship(), pairs[i], kBand, {});
    for (std::size_t q = 0; q < kBand.size(); ++q) EXPECT_EQ(together[i][q], alone[q]) << i;
  }
}

TEST(Reciprocity, PointsOfAViewSumToItsMatrix) {
  const RadarBasis a = radar_basis(direction(33, 17)), b = radar_basis(direction(60, 8));
  for (const BistaticGeometry& geometry : {monostatic(a), bistatic(a, b)}) {
    const AspectContributions view = aspect_contributions(turned_ship(), geometry, {kBand[1], 1e-3}, {});
    const auto matrix = scattering_matrices(turned_ship(), geometry, {&kBand[1], 1}, {})[0];
    EXPECT_LT(distance(view.matrix, matrix), kRounding * largest(matrix));
    const auto sum = direct_sum(view.points, kBand[1], Vec3::Zero());
    EXPECT_LT(distance(sum, view.matrix), 1e-5 * largest(view.matrix));  // patterns of points are of single precision
  }
}

TEST(Reciprocity, HoldsOverTheSea) {
  SeaReflectionSpec spec;
  spec.enabled = true;
  const SeaReflection sea(spec, 0.3);
  for (const double azimuth : {12.0, 71.0}) {
    const auto s = scattering_matrices_over_sea(Scatterer(block_ship()), direction(azimuth, 17), 1.5, sea, kBand, {});
    for (std::size_t q = 0; q < kBand.size(); ++q)
      EXPECT_LT(std::abs(s[q][kHvChannel] - s[q][kVhChannel]), kRounding * largest(s[q])) << azimuth;
  }
}

}  // namespace
}  // namespace seaglint
