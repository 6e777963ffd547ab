// SPDX-License-Identifier: BSD-3-Clause
// Decomposition of the echo at one aspect: selected, clustered into centres, summed by facet.
#include "sim/scattering/sums/scattering_centres_3d.h"
#include "tests/sim/scattering/solve_calls.h"

#include <gtest/gtest.h>

#include "sim/geometry/shapes/generators.h"
#include "tests/measured.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

const double k16 = wavenumber(16e9);

double distance(const std::array<Complex, 4>& a, const std::array<Complex, 4>& b) {
  double sum = 0;
  for (int i = 0; i < 4; ++i) sum += std::norm(a[i] - b[i]);
  return std::sqrt(sum);
}

double size(const std::array<Complex, 4>& a) { return distance(a, {}); }

class AspectDecomposition : public testing::Test {
 protected:
  const Scatterer scatterer_{make_icosahedral_reflector()};
  const RadarBasis radar_ = radar_basis(direction(25, 8));
  std::vector<Point> contributions(const TracingSettings& settings = {}) const {
    const double aspect_change = default_aspect_change(scatterer_, 2 * kPi / k16);
    return points_of(scatterer_, monostatic(radar_), k16, aspect_change, settings).points;
  }
  std::array<Complex, 4> matrix(double k, const TracingSettings& settings = {}) const {
    return scattering_matrices(scatterer_, monostatic(radar_), std::array{k}, settings)[0];
  }
};

// Rounding of phases of some 1e4 rad over some 1e4 terms, whose sizes add to a few thousand times their sum.
constexpr double kRounding = 1e-7;

TEST_F(AspectDecomposition, CentresAndFacetsBothSumToTheScatteringMatrix) {
  const auto all = contributions();
  const auto s = matrix(k16);
  std::array<Complex, 4> by_centre{}, by_facet{};
  for (const ScatteringCentre3d& c : cluster_centres(all, k16, 0.05)) {
    for (int i = 0; i < 4; ++i) by_centre[i] += c.amplitude[i];
  }
  for (const auto& f : facet_contributions(all, k16, scatterer_.facets().size())) {
    for (int i = 0; i < 4; ++i) by_facet[i] += f[i];
  }
  EXPECT_LT(distance(by_centre, s), kRounding * size(s));
  EXPECT_LT(distance(by_facet, s), kRounding * size(s));
}

// The bound that the header states, and the ratio of the actual error to it.
TEST_F(AspectDecomposition, ErrorOffTheAspectIsBoundedByTheCellSize) {
  const auto all = contributions();
  const Vec3 aspect_change = 2e-4 * radar_.h - 1e-4 * radar_.v;
  const double dk = wavenumber(100e6), k = k16 + dk;
  const auto exact = direct_sum(all, k, aspect_change);
  double amplitudes = 0;
  for (const Point& c : all) {
    double max = 0;
    for (const Complex& s : c.matrix(0)) max = std::max(max, std::abs(s));
    amplitudes += max;
  }
  double coarser = 0;
  for (const double cell : {0.04, 0.01, 0.0025}) {
    std::array<Complex, 4> sum{};
    for (const ScatteringCentre3d& c : cluster_centres(all, k16, cell)) {
      for (int i = 0; i < 4; ++i)
        sum[i] += c.amplitude[i] * std::polar(1.0, dk * c.psi + k * c.gradient.dot(aspect_change));
    }
    // 2: norm of four elements
    const double error = distance(sum, exact),
                 bound = 2 * amplitudes * 2 * cell * (dk + std::sqrt(3.0) * k * aspect_change.norm());
    EXPECT_LT(error, bound) << cell;
    record_figure(20 * std::log10(error / size(exact)), 0, "centres_{:.0f}_um_db", 1e6 * cell);
    if (coarser > 0) {
      EXPECT_LT(error, 0.6 * coarser) << "a quarter of the cell leaves a quarter of the error, apart from speckle";
    }
    coarser = error;
  }
  EXPECT_LT(20 * std::log10(coarser / size(exact)), -40);
}

TEST_F(AspectDecomposition, SelectionAndComplementSumToAll) {
  TracingSettings only, rest, several;
  only.filter.included = {{ContributionSelector::Kind::kBounces, 3}};
  rest.filter.excluded = {{ContributionSelector::Kind::kBounces, 3}};
  const auto s = matrix(k16), with = matrix(k16, only), without = matrix(k16, rest);
  std::array<Complex, 4> sum{};
  for (int i = 0; i < 4; ++i) sum[i] = with[i] + without[i];
  EXPECT_LT(distance(sum, s), 1e-9 * size(s));
  EXPECT_GT(size(with), 0.3 * size(s));
  // The same by contributions.
  EXPECT_LT(distance(direct_sum(contributions(only), k16, Vec3::Zero()), with), kRounding * size(s));
  for (const Point& c : contributions(only)) EXPECT_EQ(c.source.bounces, 3);
  // Selectors of one kind are alternatives, of two kinds conditions.
  several.filter.included = {{ContributionSelector::Kind::kBounces, 1},
                             {ContributionSelector::Kind::kBounces, 2},
                             {ContributionSelector::Kind::kPart, 4}};
  std::size_t count = 0;
  for (const Point& c : contributions(several)) {
    EXPECT_LE(c.source.bounces, 2);
    EXPECT_EQ(c.source.part, 4);
    ++count;
  }
  EXPECT_GT(count, 0u);
}

// A trihedral's three-bounce echo has its phase centre at the apex, wherever the radar is (Fermat).
TEST(ScatteringCentres3d, OfATrihedralsThreeBouncesAreAtItsApex) {
  const Scatterer corner(transformed(make_triangular_trihedral(0.3), Mat3::Identity(), Vec3(1, 2, 0.5)));
  TracingSettings settings;
  settings.filter.included = {{ContributionSelector::Kind::kBounces, 3}};
  const RadarBasis radar = radar_basis(direction(40, 30));
  const auto centres = cluster_centres(points_of(corner, monostatic(radar), k16, 1e-4, settings).points, k16, 0.02);
  ASSERT_FALSE(centres.empty());
  EXPECT_LT((centres.front().position() - Vec3(1, 2, 0.5)).norm(), 1e-6);
  EXPECT_NEAR(centres.front().psi, 2 * radar.r.dot(Vec3(1, 2, 0.5)), 1e-6);
  EXPECT_EQ(centres.front().bounces, 3);
}

TEST(ContributionFilter, IncludesTheRimForAnyOrderOfParts) {
  ContributionFilter filter;
  filter.cavities = {1};
  EXPECT_FALSE(filter.accepts(1, 1, Mechanism::kPhysicalOptics));
  EXPECT_TRUE(filter.accepts(0, 1, Mechanism::kPhysicalOptics));
  EXPECT_FALSE(filter.accepts_edge(1, 1, 1, Mechanism::kSingleDiffraction));
  EXPECT_TRUE(filter.accepts_edge(0, 1, 1, Mechanism::kSingleDiffraction));
  EXPECT_TRUE(filter.accepts_edge(1, 0, 1, Mechanism::kSingleDiffraction));
  // The edge belongs to the other part, in a selection too.
  filter.excluded = {{ContributionSelector::Kind::kPart, 1}};
  EXPECT_TRUE(filter.accepts_edge(1, 0, 1, Mechanism::kSingleDiffraction));
  EXPECT_FALSE(filter.accepts_cavity(1));
  filter.excluded = {{ContributionSelector::Kind::kPart, 0}};
  EXPECT_FALSE(filter.accepts_edge(1, 0, 1, Mechanism::kSingleDiffraction));
  EXPECT_TRUE(filter.accepts_cavity(1));
}

}  // namespace
}  // namespace seaglint
