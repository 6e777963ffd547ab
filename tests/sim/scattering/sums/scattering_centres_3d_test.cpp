// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/sums/scattering_centres_3d.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "sim/core/numbers/random.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scattering/sums/view_estimate.h"
#include "tests/measured.h"
#include "tests/sim/scattering/solve_calls.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

// Decomposition of the echo at one aspect: selected, clustered into centres, summed by facet.

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
  for (const ScatteringCentre3d& c : cluster_centres(all, k16, 0.05))
    for (int i = 0; i < 4; ++i) by_centre[i] += c.amplitude[i];
  for (const auto& f : facet_contributions(all, k16, scatterer_.facets().size()))
    for (int i = 0; i < 4; ++i) by_facet[i] += f[i];
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
    for (const ScatteringCentre3d& c : cluster_centres(all, k16, cell))
      for (int i = 0; i < 4; ++i)
        sum[i] += c.amplitude[i] * std::polar(1.0, dk * c.psi + k * c.gradient.dot(aspect_change));
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

// Estimates from the trace of a view, against traces of other meshes: flat facets, displaced vertices, cavities.

constexpr double kFrequency = 10e9;

struct Estimated {
  std::vector<std::array<Complex, 4>> matrices;
  ViewEstimate estimate;
};

Estimated estimate(const Scatterer& scatterer, const Vec3& r, std::span<const double> wavenumbers,
                   const TracingSettings& settings, int threads = 1, double range_m = 0) {
  const BistaticGeometry geometry = monostatic(radar_basis(r));
  SolveRequest request = views_request(scatterer, std::span(&geometry, 1), wavenumbers, settings, threads, {range_m});
  request.estimates = true;
  const ViewResult view = solve(request).views.front();
  return {view.matrices, *view.estimate};
}

// A triangle of about 0.1 m at the origin that reflects a wave from azimuth 0 upwards to an oblique wall.
TriangleMesh mirror_and_wall(double wall_m) {
  TriangleMesh mesh = make_plate(0.4, 0.4);
  const Vec3 along(-0.5, 0, -1), across(0, 1, 0);  // the wall's normal is (1, 0, -0.5)
  for (Vec3& x : mesh.vertices) x = Vec3(0, 0, wall_m) + x.y() * across + x.z() * along;
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vec3& x : {Vec3(0.03, -0.05, -0.03), Vec3(0.03, 0.05, -0.03), Vec3(-0.04, 0, 0.04)})
    mesh.vertices.push_back(x);
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangle_part.push_back(0);
  mesh.triangle_material.push_back(0);
  return mesh;
}

TriangleMesh displaced(TriangleMesh mesh, double rms_m, std::uint64_t seed) {
  Random random({seed, Stream::kTest, 0});
  for (Vec3& x : mesh.vertices)
    for (int i = 0; i < 3; ++i) x[i] += rms_m * random.normal();
  return mesh;
}

// Square duct without its open end, of 4 x 4 x 8 wavelengths at 10 GHz, open towards +x.
TriangleMesh duct() {
  const double half = 0.06, depth = 0.24;
  TriangleMesh mesh = make_plate(1, 1);
  mesh.vertices = {{0, -half, -half},      {0, half, -half},      {0, half, half},      {0, -half, half},
                   {-depth, -half, -half}, {-depth, half, -half}, {-depth, half, half}, {-depth, -half, half}};
  mesh.triangles = {{0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7},
                    {2, 7, 6}, {3, 0, 4}, {3, 4, 7}, {4, 5, 6}, {4, 6, 7}};
  mesh.triangle_part.assign(mesh.triangles.size(), 0);
  mesh.triangle_material.assign(mesh.triangles.size(), 0);
  return mesh;
}

// The same polygons, but for the smallest patches, which are those of panels: a hundredth of the echo at most.
TEST(ViewEstimate, OfFlatFacetsIsTheEchoOfFlatFacets) {
  constexpr double kSmallestPatches = 0.01;
  const TriangleMesh mesh = make_cylinder(0.5, 1, 48);
  const Scatterer smooth(mesh), flat(mesh, {}, 0.0);
  std::vector<double> band;
  for (int q = 0; q < 9; ++q) band.push_back(wavenumber(kFrequency + 20e6 * (q - 4)));
  double largest_change = 0;
  for (const double azimuth : {1.7, 3.2}) {
    const Vec3 r = direction(azimuth, 0);
    for (const bool sweep : {false, true}) {
      for (const double range_m : {0.0, 20.0}) {
        const std::span<const double> k = sweep ? std::span<const double>(band) : std::span(&band[4], 1);
        const auto [matrices, view] = estimate(smooth, r, k, {0, 8, true}, 1, range_m);
        const auto expected = estimate(flat, r, k, {0, 8, true}, 1, range_m).matrices[k.size() / 2];
        EXPECT_EQ(view.wavenumber(), band[4]);
        const Complex change = view.all().flat_less_smooth[1], computed = matrices[k.size() / 2][kVvChannel];
        largest_change = std::max(largest_change, std::abs(change / computed));
        EXPECT_LT(std::abs(computed + change - expected[kVvChannel]), kSmallestPatches * std::abs(computed))
            << azimuth << " deg, sweep " << sweep << ", range " << range_m;
      }
    }
  }
  EXPECT_GT(largest_change, 10 * kSmallestPatches);
}

TEST(ViewEstimate, OfABlockAndATrihedralIsNone) {
  TriangleMesh block = duct();
  block.triangles.insert(block.triangles.end(), {{0, 2, 1}, {0, 3, 2}});
  block.triangle_part.assign(block.triangles.size(), 0);
  block.triangle_material.assign(block.triangles.size(), 0);
  for (auto& triangle : block.triangles) std::swap(triangle[0], triangle[1]);  // seen from outside
  for (const TriangleMesh& mesh : {block, make_square_trihedral(0.4)}) {
    const double k = wavenumber(kFrequency);
    const auto [matrices, view] = estimate(Scatterer(mesh), direction(40, 30), std::span(&k, 1), {0, 8, true});
    const ViewEstimate::Sums sums = view.all();
    const double size = largest(matrices.front());
    for (const std::size_t i : {0u, 1u}) {
      EXPECT_EQ(sums.flat_less_smooth[i], Complex(0));
      EXPECT_EQ(sums.in_cavity[i], Complex(0));
      EXPECT_LT(std::sqrt(sums.displaced_power[i]), 1e-3 * size);  // each wave returns against its direction
    }
  }
}

// Displaced meshes are traced; the estimate has the width of the triangle as half its height and no correlation between
// the displacement on the wall and the direction of the tilt: a factor of two.
TEST(ViewEstimate, OfDisplacedVerticesIsTheChangeOfDisplacedMeshes) {
  constexpr double kWidths = 2;
  constexpr int kMeshes = 40;
  TracingSettings settings{1e-3, 8, false};
  settings.filter.included = {{ContributionSelector::Kind::kBounces, 2}};
  const double k = wavenumber(kFrequency);
  for (const double wall_m : {5.0, 20.0}) {
    const TriangleMesh mesh = mirror_and_wall(wall_m);
    const auto [matrices, view] = estimate(Scatterer(mesh, {}, 0.0), direction(0, 0), std::span(&k, 1), settings);
    const double noise_m = kVertexNoise * 2 * kPi / k;
    double power = 0;
    for (int n = 0; n < kMeshes; ++n) {
      const auto changed = estimate(Scatterer(displaced(mesh, noise_m, 1 + static_cast<std::uint64_t>(n)), {}, 0.0),
                                    direction(0, 0), std::span(&k, 1), settings);
      power += std::norm(changed.matrices[0][kVvChannel] - matrices[0][kVvChannel]) / kMeshes;
    }
    const double size = std::abs(matrices[0][kVvChannel]), measured = std::sqrt(power) / size,
                 estimated = std::sqrt(view.all().displaced_power[1]) / size;
    fmt::print("wall at {} m: measured {:.3f}, estimated {:.3f}\n", wall_m, measured, estimated);
    EXPECT_LT(estimated, kWidths * measured);
    EXPECT_GT(estimated, measured / kWidths);
  }
}

TEST(ViewEstimate, HasThePathsInsideADuct) {
  const double k = wavenumber(kFrequency);
  const Scatterer scatterer(duct());
  const auto [matrices, view] = estimate(scatterer, direction(50, 20), std::span(&k, 1), {0, 40, false});
  EXPECT_GT(std::abs(view.all().in_cavity[1]), 0.3 * std::abs(matrices[0][kVvChannel]));
  // A duct of the same shape in which walls are farther apart than in cavities.
  const double shorter = 20 * k;
  const auto wide = estimate(scatterer, direction(50, 20), std::span(&shorter, 1), {0, 40, false});
  EXPECT_EQ(wide.estimate.all().in_cavity[1], Complex(0));
}

TEST(ViewEstimate, IsTheSameForAnyNumberOfThreads) {
  const double k = wavenumber(kFrequency);
  TriangleMesh mesh = make_sphere(0.3, 3);
  mesh.append(duct());
  const Scatterer both(mesh);
  const ViewEstimate one = estimate(both, direction(20, 10), std::span(&k, 1), {0, 8, true}, 1).estimate,
                     three = estimate(both, direction(20, 10), std::span(&k, 1), {0, 8, true}, 3).estimate;
  ASSERT_EQ(one.parts().size(), three.parts().size());
  for (std::size_t part = 0; part < one.parts().size(); ++part) {
    EXPECT_EQ(one.parts()[part].flat_less_smooth, three.parts()[part].flat_less_smooth);
    EXPECT_EQ(one.parts()[part].flat_change, three.parts()[part].flat_change);
    EXPECT_EQ(one.parts()[part].displaced_power, three.parts()[part].displaced_power);
    EXPECT_EQ(one.parts()[part].in_cavity, three.parts()[part].in_cavity);
    EXPECT_EQ(one.parts()[part].non_reciprocal, three.parts()[part].non_reciprocal);
    EXPECT_EQ(one.parts()[part].non_reciprocal_size, three.parts()[part].non_reciprocal_size);
  }
}

}  // namespace
}  // namespace seaglint
