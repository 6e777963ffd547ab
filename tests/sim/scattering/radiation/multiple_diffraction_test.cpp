// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/radiation/multiple_diffraction.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/core/numbers/real_functions.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/scattering/coefficients/amplitude_laws.h"
#include "sim/scattering/coefficients/fade_windows.h"
#include "sim/scattering/coefficients/wedge_diffraction.h"
#include "sim/scattering/points/phase_integral.h"
#include "sim/scattering/radiation/edge_diffraction.h"
#include "sim/scattering/solver/aspect_trace.h"
#include "tests/sim/scattering/solve_calls.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

// Multiple diffraction along a face: transition functions against integrals, reflections at upright walls against image
// theory.

TEST(TransitionFunction, EqualsItsIntegral) {
  for (const double x : {0.01, 0.3, 1.0, 5.5, 11.9, 16.9, 17.1, 40.0}) {
    // 2j sqrt(x) e^{jx} integral; t = sqrt(x) + u e^{-j pi/4} transforms the oscillation into decay.
    Complex integral = 0;
    const double step = 1e-4, root = std::sqrt(x);
    for (double u = step / 2; u < 12; u += step) {
      const Complex tilted = u * std::polar(1.0, -kPi / 4);
      integral += std::exp(-kJ * tilted * (2 * root + tilted)) * std::polar(step, -kPi / 4);
    }
    const Complex exact = 2.0 * kJ * root * integral;
    EXPECT_NEAR(std::abs(transition_function(x) - exact), 0, 1e-7 + x * step * step / 6) << x;
  }
}

// A plane wave e^{-j k1 z} is incident above the first edge, propagates over a hard floor of unit length (paraxial, k =
// 1: G(z - z') + G(z + z'), G(z) = sqrt(j / 2 pi) e^{-j z^2 / 2}) and is received as e^{-j k2 z} above the second. With
// both heights rotated, z = e^{-j pi/4} t, the integrand decays. Far from both boundaries, where the transition
// function is 1, the integral is -2 G(0) / (k1 k2); x = k1^2 / 2, y = k2^2 / 2.
TEST(TransitionFunction, BetweenTwoEdgesIsTheIntegralOverBothApertures) {
  const auto two_apertures = [](double x, double y) {
    const double k1 = std::sqrt(2 * x), k2 = std::sqrt(2 * y);
    const Complex tilt = std::polar(1.0, kPi / 4);
    constexpr int n = 2000;  // Simpson's rule
    constexpr double step = 14.0 / n;
    std::vector<Complex> first, second;
    for (int i = 0; i <= n; ++i) {
      const double weight = step / 3 * (i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2);
      first.push_back(weight * std::exp(-k1 * i * step * tilt));
      second.push_back(weight * std::exp(-k2 * i * step * tilt));
    }
    Complex sum = 0;
    for (int a = 0; a <= n; ++a) {
      Complex inner = 0;
      for (int b = 0; b <= n; ++b) {
        const double less = (a - b) * step, more = (a + b) * step;
        inner += (std::exp(-less * less / 2) + std::exp(-more * more / 2)) * first[b];
      }
      sum += second[a] * inner;
    }
    return sum * std::polar(1.0, -kPi / 2) / (-2.0 / (k1 * k2));
  };
  for (const auto& [x, y] :
       {std::pair{8.0, 5.0}, {2.0, 2.0}, {2.0, 2.0039}, {2.0, 2.0041}, {0.5, 1.5}, {3.0, 0.05}, {1.0, 10.0}}) {
    // Simpson's 1e-8, and for arguments within 1e-3 of each other the square of that.
    EXPECT_NEAR(std::abs(double_transition_function(x, y) - two_apertures(x, y)), 0, 1e-6) << x << ' ' << y;
    EXPECT_EQ(double_transition_function(x, y), double_transition_function(y, x));
  }
  EXPECT_NEAR(std::abs(double_transition_function(0.7, 1e8) - transition_function(0.7)), 0, 1e-6);
}

// The integral over the length of a face-grazing diffracted wave, with its shadow boundaries and a phase along the
// edge, equals its end-point contributions.
TEST(TransitionFunction, WithAThirdBoundaryIsTheEndOfAnIntegralAlongTheEdge) {
  struct Case {
    double a, b, p;  // per metre
  };
  for (const auto& [a, b, p] : {Case{7, 3, 5},
                                {7, 3, -5},
                                {7, 7.001, 5},
                                {7, 3, -7},
                                {7, 7, -7},
                                {0.02, 30, 11},
                                {40, 1e-9, -3},
                                {2, 5, 300}}) {
    for (const double shortest : {1e-12, 0.2}) {  // from a vertex on, and from a distance
      constexpr double kLongest = 1.7;
      constexpr int n = 20000;  // Simpson's rule over sqrt(l), in which the integrand is smooth
      const double from = std::sqrt(shortest), step = (std::sqrt(kLongest) - from) / n;
      Complex integral = 0;
      for (int i = 0; i <= n; ++i) {
        const double root = from + i * step, l = root * root;
        integral += step / 3 *
                    (i == 0 || i == n ? 1
                     : i % 2 == 1     ? 4
                                      : 2) *
                    2.0 * double_transition_function(a * l, b * l) * std::polar(1.0, p * l);
      }
      const auto end = [&, a = a, b = b, p = p](double l) {
        return triple_transition_function(a * l, b * l, -p * l) * std::polar(1.0, p * l) / (kJ * p * std::sqrt(l));
      };
      // Equal arguments are separated by 1e-3, which has an error of its square and amplifies F's 1e-7 by as much.
      EXPECT_NEAR(std::abs(end(kLongest) - end(shortest) - integral), 0, 1e-4 * std::abs(integral))
          << a << ' ' << b << ' ' << p << ' ' << shortest;
    }
  }
}

// A closed body of this profile (x, z), counter-clockwise seen against y, and width along y; every vertex of the
// profile is visible from the second one.
TriangleMesh extruded(const std::vector<Vec2>& profile, double width) {
  TriangleMesh mesh;
  const auto n = static_cast<std::uint32_t>(profile.size());
  for (const double y : {0.0, width})
    for (const Vec2& p : profile) mesh.vertices.push_back({p.x(), y, p.y()});
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    mesh.triangles.push_back({i, i + n, next + n});
    mesh.triangles.push_back({i, next + n, next});
    if (i == 1 || next == 1) continue;
    mesh.triangles.push_back({1, i, next});
    mesh.triangles.push_back({1 + n, next + n, i + n});
  }
  return mesh;
}

// Kouyoumjian and Pathak (1974): on the cone that both rays lie on, at angle b to the edge, L = l sin^2 b and the sine
// squared of half the angle about the edge.
TEST(TransitionFunction, HasTheAngleAboutTheEdgeOnKellersCone) {
  for (const double b : {1.5, 0.6, 0.05}) {
    for (const double about : {3.0, 0.4, 1e-4}) {
      const auto ray = [&](double angle) {
        return Vec3(std::sin(b) * std::cos(angle), std::sin(b) * std::sin(angle), std::cos(b));
      };
      const double between = std::pow(std::sin(b) * std::sin(about / 2), 2);
      // Rounding of differences of 5e-6.
      EXPECT_NEAR(transition_parameter(ray(0), ray(about)), between, 1e-9 * between) << b << ' ' << about;
    }
  }
}

struct DoubleDiffractionSum {
  std::array<Complex, 4> S{};
  int count = 0;
};

// Double diffraction from edges of the floor z = 0 with all x up to `first_below` to edges with all x from `last_above`
// on, with `walls` reflections at walls between them.
DoubleDiffractionSum double_diffraction_sum(const TriangleMesh& mesh, const BistaticGeometry& geometry, double k,
                                            double first_below, double last_above, int walls) {
  const Scatterer scatterer(mesh, {}, 0.0);  // with the edges that the mesh has
  const Vec3& c = scatterer.centre();        // to which edges are relative; rounds them in the last place
  const auto edge = [&](const EdgeIllumination& illumination) { return scatterer.edges().edges[illumination.edge]; };
  // Illuminations of edges on the floor that `wanted` selects.
  const auto reached = [&](const RadarBasis& basis, const auto& selected) {
    std::vector<EdgeIllumination> kept;
    const Illumination::Summary all =
        illumination(scatterer, monostatic(basis), {0, 1, true}).trace(1, ignore_contributions);
    for (const EdgeIllumination* illumination : all.edge_illuminations.all()) {
      const double height =
          std::max(std::abs(edge(*illumination).a.z() + c.z()), std::abs(edge(*illumination).b.z() + c.z()));
      if (height < 1e-12 && selected(edge(*illumination))) kept.push_back(*illumination);
    }
    return IlluminationByEdge({std::move(kept)}, scatterer.edges().edges.size());
  };
  const auto first = [&](const SharpEdge& e) { return std::max(e.a.x(), e.b.x()) + c.x() <= first_below + 1e-12; };
  const auto last = [&](const SharpEdge& e) { return std::min(e.a.x(), e.b.x()) + c.x() >= last_above - 1e-12; };
  const IlluminationByEdge incoming = reached(geometry.transmit, first), outgoing = reached(geometry.receive, last);
  std::vector<Contribution> contributions;
  trace_multiple_diffraction({scatterer, geometry, {}, outgoing, {}}, incoming.all(), contributions);
  Observation one_way = observation_of(scatterer, geometry);
  one_way.sense = PathSense::kOneWay;
  DoubleDiffractionSum sum;
  for (const Contribution& contribution : contributions) {
    const auto* wave = std::get_if<GrazingWaveAmplitude>(&contribution.interval()->amplitude);
    if (!wave || wave->grazing_waves != 1 || contribution.source.bounces != 2 + walls) continue;
    add_to(sum.S, scattered(contribution, one_way, k));
    ++sum.count;
  }
  return sum;
}

// Image theory: a wave that an upright wall reflects is diffracted at the edges' images, received along the image
// direction with the image of the polarisation, whose sign a conductor changes: p' = -(p - 2 (n.p) n). The elevation is
// high enough that no taper applies (fringe_forward_taper).
TEST(MultipleDiffraction, AtAnUprightWallIsThatOfTheImage) {
  const double length = 0.31, width = 0.22, k = wavenumber(10e9);
  const TriangleMesh twice = extruded({{length, 0}, {0, 0}, {-length, 0}, {-length, -0.1}, {length, -0.1}}, width);
  const TriangleMesh corner =
      extruded({{0, 0.5}, {0, 0}, {-length, 0}, {-length, -0.1}, {0.1, -0.1}, {0.1, 0.5}}, width);
  const auto image = [](const Vec3& x) { return Vec3(-x.x(), x.y(), x.z()); };
  for (const double azimuth : {175.0, 160.0, 215.0}) {
    const RadarBasis basis = radar_basis(direction(azimuth, 55));
    // The image basis is right-handed with -h' and v'; the conductor changes the sign of both.
    const RadarBasis mirrored{image(basis.r), -image(basis.h), image(basis.v)};
    const DoubleDiffractionSum wall = double_diffraction_sum(corner, monostatic(basis), k, 0, -length, 1),
                               slab = double_diffraction_sum(twice, bistatic(basis, mirrored), k, 0, 0, 0);
    EXPECT_GT(slab.count, 0);
    for (const int channel : {kHhChannel, kHvChannel})
      EXPECT_NEAR(std::abs(wall.S[channel] - slab.S[channel]), 0, 1e-9 * largest(slab.S)) << azimuth;
    for (const int channel : {kVhChannel, kVvChannel})
      EXPECT_NEAR(std::abs(wall.S[channel] + slab.S[channel]), 0, 1e-9 * largest(slab.S)) << azimuth;
  }
}

// A horizontal sheet, near grazing and nearly along its sides, where waves are incident on edges at small angles. S_hv
// = S_vh at every elevation; in the sheet's plane both vanish by mirror symmetry: multiple diffraction cancels the
// cross-polar single diffraction.
TEST(MultipleDiffraction, OfAGrazingSheetIsReciprocalAndMirrorSymmetric) {
  const double length = 0.3, width = 0.2, k = wavenumber(10e9), edge_amplitude = length / (2 * kPi);
  const Mat3 lie_down = axis_rotation(kPi / 2, Vec3::UnitY());
  const Scatterer sheet(transformed(make_plate(width, length), lie_down, Vec3::Zero()));
  const double rounding = 1e-12 * edge_amplitude;
  // Relative to the edges' echo: the fourth order, 1 / (2 pi k width) of the others, is truncated; the look direction
  // is perturbed by 1e-6 rad, which leaves cross-polar terms of that fraction of the co-polar ones.
  const double left_out = edge_amplitude / (2 * kPi * k * width), perturbation = 1e-6 * edge_amplitude;
  double max = 0;
  for (const double elevation : {0.0, 0.1, 0.5, 1.0, 2.0, 5.0}) {
    for (const double azimuth : {0.1, 0.3, 1.0, 2.0, 3.0, 5.0, 7.5, 10.0, 15.0, 20.0, 45.0, 85.0, 89.9}) {
      const auto s = echo(sheet, radar_basis(direction(azimuth, elevation)), k, 0, 8, true);
      EXPECT_NEAR(std::abs(s[kHvChannel] - s[kVhChannel]), 0, rounding) << azimuth << ' ' << elevation;
      if (elevation > 0) continue;
      max = std::max(max, std::abs(s[kHvChannel]));
      EXPECT_LT(std::abs(s[kHvChannel]), left_out + perturbation) << azimuth;
    }
  }
  RecordProperty("crossed_dbsm", std::to_string(dbsm(max)));
  RecordProperty("bound_dbsm", std::to_string(dbsm(left_out + perturbation)));
}

// The echo of a sheet, and the part of it that is due to quadruple diffraction, the highest order.
struct WithLast {
  std::array<Complex, 4> all, fourth;
};
WithLast with_last(const Scatterer& sheet, const BistaticGeometry& geometry, double k) {
  TracingSettings all{0, 8, true}, fourth = all;
  fourth.filter.included.push_back({ContributionSelector::Kind::kBounces, 4});
  const auto echo = [&](const TracingSettings& settings) {
    return scattering_matrices(sheet, geometry, std::array{k}, settings)[0];
  };
  return {echo(all), echo(fourth)};
}

// A thin plate edge-on does not scatter a field normal to it: the first three orders of diffraction cancel, 1 - 2 + 1,
// and the fourth includes all higher ones, which would cancel half of it. A wave that an edge diffracts nearly along an
// adjacent edge continues along that edge and is radiated by no other ray: with such rays the residual in the plane was
// -47 dBsm.
TEST(MultipleDiffraction, EdgeOnPlateVanishesForNormalE) {
  const double k = wavenumber(10e9);
  const Scatterer plate(make_plate(0.25, 0.15)), cut(cut_plate(0.25, 0.15, 16));
  const auto basis = [](double azimuth) { return radar_basis(direction(azimuth, 0)); };
  for (const double azimuth : {90.0, 89.9999, 89.999, 89.99}) {
    const WithLast hh = with_last(plate, monostatic(basis(azimuth)), k);
    EXPECT_LT(std::abs(hh.all[kHhChannel]), 0.51 * std::abs(hh.fourth[kHhChannel])) << azimuth;
    EXPECT_LT(dbsm(hh.fourth[kHhChannel]), -65) << azimuth;
  }
  for (const double azimuth : {75.0, 85.0, 89.0}) {
    // The adjacent edges, along which the waves propagate at 1e-6 rad.
    const Complex whole = echo(plate, basis(azimuth), k, 0, 8, true)[kHhChannel],
                  many = echo(cut, basis(azimuth), k, 0, 8, true)[kHhChannel];
    EXPECT_LT(std::abs(whole - many), 1e-3 * std::abs(many)) << azimuth;
  }
}

// The currents of a sheet lie in its plane, so that a receiver in that plane sees no field component normal to it for
// any illumination; nor a cross-polar component where both look directions lie in a plane of symmetry. A vertical edge
// in isolation scatters 0.05 m there.
TEST(MultipleDiffraction, SendNothingAcrossASheetIntoItsPlane) {
  const double k = wavenumber(10e9);
  const Scatterer sheet(make_plate(0.2, 0.3));
  for (const auto& [azimuth, elevation] :
       {std::pair{10.0, 0.0}, {40.0, 0.0}, {80.0, 0.0}, {0.0, 20.0}, {10.0, 20.0}, {60.0, -30.0}}) {
    for (const auto& [side, height] : {std::pair{90.0, 0.0}, {-90.0, 0.0}, {90.0, 15.0}, {90.0, 60.0}}) {
      const BistaticGeometry geometry =
          bistatic(radar_basis(direction(azimuth, elevation)), radar_basis(direction(side, height)));
      const auto& [all, fourth] = with_last(sheet, geometry, k);
      // The highest order has no successor that would cancel it, and the look direction of the receiver is perturbed by
      // 1e-6 rad, which changes phases by 1e-6 k radius.
      const double perturbation = 1e-6 * k * sheet.radius() * largest(all);
      const auto residual = [&, &fourth = fourth](int channel) { return std::abs(fourth[channel]) + perturbation; };
      EXPECT_LT(std::abs(all[kHhChannel]), residual(kHhChannel))
          << azimuth << ' ' << elevation << ' ' << side << ' ' << height;
      EXPECT_LT(std::abs(all[kHvChannel]), residual(kHvChannel))
          << azimuth << ' ' << elevation << ' ' << side << ' ' << height;
      if (elevation == 0 && height == 0) {
        EXPECT_LT(std::abs(all[kVhChannel]), residual(kVhChannel)) << azimuth << ' ' << side;
        EXPECT_LT(std::abs(fourth[kVhChannel]), 0.01 * std::abs(all[kVvChannel])) << azimuth << ' ' << side;
      }
    }
  }
}

// Only paths below the required amplitude are dropped before their current is known, and these are more than half.
TEST(MultipleDiffraction, DropsOnlyWeakPaths) {
  const double k = wavenumber(10e9), min_amplitude = 1e-4;
  const Scatterer corner(stepped_corner());
  std::size_t all = 0, kept = 0;
  for (const auto& [azimuth, elevation] : {std::pair{45.0, 35.0}, {20.0, 3.0}, {70.0, 60.0}, {1.0, 1.0}}) {
    const BistaticGeometry geometry = monostatic(radar_basis(direction(azimuth, elevation)));
    const auto illuminations =
        illumination(corner, geometry, {0, 4, true}).trace(1, ignore_contributions).edge_illuminations;
    const auto significant = [&](double limit, std::size_t& count) {
      std::vector<Contribution> contributions;
      trace_multiple_diffraction({corner, geometry, {}, illuminations, {0, 0, limit, k}}, illuminations.all(),
                                 contributions);
      count += contributions.size();
      return std::count_if(contributions.begin(), contributions.end(), [&](const Contribution& f) {
        const auto* wave = std::get_if<GrazingWaveAmplitude>(&f.interval()->amplitude);
        return wave && wave->grazing_waves == 1 && largest(scattered(f, geometry, k)) >= min_amplitude;
      });
    };
    const auto of_all = significant(0, all), of_kept = significant(min_amplitude, kept);
    EXPECT_GT(of_all, 0) << azimuth;
    EXPECT_EQ(of_all, of_kept) << azimuth;
  }
  EXPECT_LT(kept, all / 2);
}

// Short runs of edges launch no grazing waves, and triple and quadruple diffraction needs a long run. The contribution
// of the dropped paths is below a tenth of the -30 dB that an interval's error may reach, though they are the majority.
TEST(MultipleDiffraction, OfShortRunsIsNegligibleOnTheShip) {
  const Scatterer ship(read_mesh(SEAGLINT_SOURCE_DIR "/assets/combatant_144m.glb"));
  const double k = wavenumber(16e9);
  const TracingSettings settings{0, 2, true};
  const MultipleDiffractionLimits own = multiple_diffraction_limits(ship, settings, k);
  for (const double azimuth : {10.0, 90.0, 130.0}) {
    const BistaticGeometry geometry = monostatic(radar_basis(direction(azimuth, 2)));
    const auto illuminations = illumination(ship, geometry, settings).trace(2, ignore_contributions).edge_illuminations;
    const auto waves = [&](const MultipleDiffractionLimits& limits) {
      std::vector<Contribution> contributions;
      trace_multiple_diffraction({ship, geometry, {}, illuminations, limits}, illuminations.all(), contributions);
      std::array<Complex, 4> sum{};
      for (const Contribution& contribution : contributions) add_to(sum, scattered(contribution, geometry, k));
      return std::pair{sum, contributions.size()};
    };
    const auto whole = scattering_matrices(ship, geometry, std::array{k}, {0, kDefaultBounces, true}, 2)[0];
    const auto [all, many] = waves({0, 0, own.min_amplitude_m, k});
    const auto [kept, fewer] = waves(own);
    EXPECT_LT(fewer, many / 2) << azimuth;
    for (const int channel : {kHhChannel, kVvChannel}) {
      const double left_out = std::abs(all[channel] - kept[channel]) / std::abs(whole[channel]);
      RecordProperty(fmt::format("left_out_db_{}_{}", azimuth, channel),
                     fmt::format("{:.1f}", 20 * std::log10(left_out)));
      EXPECT_LT(left_out, 0.1 * std::pow(10, -30.0 / 20)) << azimuth << ' ' << channel;
    }
  }
}

// Away from the principal planes, where each edge scatters from its end points only.
TEST(MultipleDiffraction, DoNotDependOnTriangulation) {
  const double k = wavenumber(10e9);
  const Scatterer whole(make_plate(0.25, 0.125)), cut(cut_plate(0.25, 0.125, 16));
  RelativeError error;
  for (double azimuth = 20; azimuth <= 85; azimuth += 2.5) {
    const RadarBasis basis = radar_basis(direction(azimuth, 13));
    const BistaticGeometry geometry = monostatic(basis);
    const auto of_edges = [&](const Scatterer& plate, bool once) {
      const auto illuminations =
          illumination(plate, monostatic(basis), {0, 1, true}).trace(1, ignore_contributions).edge_illuminations;
      std::vector<Contribution> contributions;
      trace_multiple_diffraction({plate, geometry, {}, illuminations, {}}, illuminations.all(), contributions);
      std::array<Complex, 4> sum{};
      for (const Contribution& contribution : contributions) {
        if (once && std::get<GrazingWaveAmplitude>(contribution.interval()->amplitude).grazing_waves > 1) continue;
        add_to(sum, scattered(contribution, monostatic(basis), k));
      }
      return sum;
    };
    // Double diffraction: to rounding, of end-point contributions that cancel.
    const auto one = of_edges(whole, true), many = of_edges(cut, true);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(std::abs(one[i] - many[i]), 0, 1e-9 * 0.25) << azimuth << ' ' << i;
    const auto all = of_edges(whole, false), all_of_many = of_edges(cut, false);
    for (int i = 0; i < 4; ++i) error.add(all[i], all_of_many[i]);
  }
  // Triple and quadruple diffraction, nine tenths of this field: 1/sqrt(l) differs from its mean over a fourfold growth
  // by a fifth in the root mean square, of which the phases along the intervals leave a sixth (0.033 was found).
  EXPECT_LT(error.value(), 0.05);
  RecordProperty("difference", std::to_string(error.value()));
}

// Walls behind edges of faces at grazing incidence, against integrals over the half-plane's field.

// A floor z = 0 with an edge along y at x = 0, and a wall at x = -20 m, as wide as long, viewed along x from 15 deg
// above the floor to as much below.
constexpr double kWallDistance = 20, kWidth = 20;

struct Field {
  Complex soft, hard;  // hh and vv per metre of wall
};

Field closed_form(double sine, double k, double height = 1000) {
  const RadarBasis radar = radar_basis(Vec3(std::sqrt(1 - sine * sine), 0, sine));
  const WallBehindEdge wall{Vec3::Zero(),
                            Vec3::UnitY(),
                            Vec3::UnitZ(),
                            Vec3::UnitX(),
                            height,
                            grazing_taper(radar.r, Vec3::UnitZ()),
                            {Vec3(-kWallDistance, -kWidth / 2, 0), Vec3(-kWallDistance, kWidth / 2, 0)}};
  std::vector<Contribution> contributions;
  append_wall_penumbra(wall, radar, {}, {.k = k}, contributions);
  Field sum{};
  for (const Contribution& contribution : contributions) {
    const auto s = scattered(contribution, monostatic(radar), k);
    // Phase from the foot.
    const Complex per_metre = std::polar(1 / kWidth, 2 * k * kWallDistance * std::sqrt(1 - sine * sine));
    sum.soft += per_metre * s[kHhChannel];
    sum.hard += per_metre * s[kVvChannel];
  }
  return sum;
}

// erfc(e^{j pi/4} u) / 2 by the transition function, which TransitionFunction.EqualsItsIntegral holds to its integral.
Complex shadow_field(double u) {
  if (u < 0) return 1.0 - shadow_field(-u);
  return u < 1e-9 ? 0.5 : std::polar(1.0, -u * u - kPi / 4) * transition_function(u * u) / (2 * std::sqrt(kPi) * u);
}

// Sommerfeld's solution for the half-plane (M. Born and E. Wolf, Principles of Optics, 8.7), which is the floor: the
// wave incident from the angle `from`, measured from the floor about the edge, or its image from minus that, at (x, z).
Complex half_plane(double from, double x, double z, double k) {
  const double r = std::hypot(x, z), off = std::atan2(z, -x) - from;
  return std::polar(1.0, k * r * std::cos(off)) * shadow_field(-std::sqrt(2 * k * r) * std::cos(0.5 * off));
}
// The difference of the exact product of the field on the wall and its slope, which by reciprocity is the receiver's,
// from physical optics, which illuminates the wall directly and once more via the floor up to the shadow-boundary line
// of the edge, where the wall's image radiates as well (image_weight()). They agree far above the penumbra except
// for waves of increasing phase rate up the wall, which a taper removes.
Field integral(double sine, double k) {
  const double angle = std::asin(sine), penumbra = std::sqrt(2 * kWallDistance / k),
               shadow = kWallDistance * std::tan(angle);
  // no step of the midpoint rule contains the line
  const double line = shadow != 0 ? std::abs(shadow) : 0.01 * penumbra,
               step = line / std::ceil(line / (0.002 * penumbra));
  const double from = std::abs(shadow) + 12 * penumbra, to = from + 40 * penumbra, h = 1e-5;
  Complex soft = 0, hard = 0;
  for (double z = step / 2; z < to; z += step) {
    const Complex up = std::polar(1.0, -2 * k * kWallDistance * std::cos(angle)) * std::polar(1.0, 2 * k * z * sine);
    const Complex direct = z + shadow > 0 ? up : 0,
                  via_floor = z < shadow ? std::polar(1.0, -2 * k * kWallDistance * std::cos(angle)) : 0,
                  via_image = via_floor * std::polar(1.0, -2 * k * z * sine);
    for (const double sign : {-1.0, 1.0}) {
      const auto field = [&](double x) {
        return half_plane(kPi - angle, x, z, k) + sign * half_plane(angle - kPi, x, z, k);
      };
      const Complex slope = (field(-kWallDistance + h) - field(-kWallDistance - h)) / Complex(0, 2 * h * k);
      (sign < 0 ? soft : hard) +=
          smooth_taper(z, {from, to}) *
          (field(-kWallDistance) * slope -
           std::cos(angle) * (direct + via_image + 2 * sign * (direct == 0.0 ? 0.0 : via_floor)));
    }
  }
  // S is -jk / 2 pi times that; phase from the foot.
  const Complex factor = Complex(0, -k / (2 * kPi)) * step * std::polar(1.0, 2 * k * kWallDistance * std::cos(angle));
  return {factor * soft, factor * hard};
}

// Soft up to 2 deg above the floor, where reflected-edge contributions begin, and to 15 deg below; hard to 2 deg on
// either side, where multiple diffraction begins.
TEST(WallPenumbra, EqualsHalfPlaneFieldLessPhysicalOptics) {
  // soft, at grazing: 2 (l / pi k)^(1/2) k / 2 pi
  const double k = wavenumber(10e9), soft_at_grazing = std::sqrt(k * kWallDistance / kPi) / kPi;
  for (const double sine :
       {-0.25, -0.1, -0.03, -0.01, -0.003, -0.001, -0.00005, 0.0, 0.00005, 0.001, 0.003, 0.01, 0.03}) {
    const Field found = closed_form(sine, k), expected = integral(sine, k);
    // Error of cosines of the angle; the midpoint rule; within 1e-4 of the floor's plane the extrapolation from there
    // with the derivative over 1e-3, which lacks the second order in x.
    const double tolerance = 1.5 * sine * sine * std::abs(expected.soft) + 1e-4 * soft_at_grazing +
                             (std::abs(sine) < 1e-4 ? 2 * k * kWallDistance * 1e-4 * 1e-3 * soft_at_grazing : 0);
    EXPECT_LT(std::abs(found.soft - expected.soft), tolerance) << sine;
    if (std::abs(sine) > 0.03) continue;
    EXPECT_LT(std::abs(found.hard - expected.hard), tolerance + 1.5 * sine * sine * std::abs(expected.hard)) << sine;
  }
}

// At grazing the effective height of the wall is lower by (l / pi k)^(1/2) for the soft wave on either path, and
// unchanged for the hard one.
TEST(WallPenumbra, LowersEffectiveWallHeightAtGrazing) {
  const double k = wavenumber(10e9), soft_at_grazing = std::sqrt(k * kWallDistance / kPi) / kPi;
  const Field field = closed_form(0, k);
  EXPECT_LT(std::abs(field.soft - std::polar(soft_at_grazing, kPi / 4)), 1e-3 * soft_at_grazing);
  EXPECT_LT(std::abs(field.hard), 1e-3 * soft_at_grazing);
}

// The term at the foot and the edge's diffracted field via the wall are weighted where they are computed, each by the
// geometry it has: together they are one field.
TEST(WallPenumbra, FootAndReflectedEdgeSumToOne) {
  const double k = wavenumber(10e9), distance = 20;
  WedgeFrame edge_of_deck;  // the deck z = 0 at x < 0, its edge along y
  edge_of_deck.N = 1.5;
  edge_of_deck.face[0] = {-Vec3::UnitX(), Vec3::UnitZ(), Vec3::UnitY()};
  edge_of_deck.face[1] = {-Vec3::UnitZ(), Vec3::UnitX(), -Vec3::UnitY()};
  int shared = 0;
  for (double sine = 0.05; sine < 0.55; sine += 0.01) {
    const Vec3 r(std::sqrt(1 - sine * sine), 0, sine), normal = Vec3::UnitX();
    const WallBehindEdge wall{
        Vec3::Zero(), Vec3::UnitY(), Vec3::UnitZ(), normal, 1000, 0, {Vec3(-distance, -1, 0), Vec3(-distance, 1, 0)}};
    std::vector<Contribution> contributions;
    append_wall_penumbra(wall, radar_basis(r), {}, {.k = k}, contributions);
    ASSERT_FALSE(contributions.empty());
    const double foot = std::get<WallPenumbraTerm>(contributions.front().interval()->amplitude).foot_weight;
    EdgeIllumination in, out;
    in.direction = -r;
    out.direction = -(r - 2 * normal.dot(r) * normal);  // of the receiver's wave, after the wall
    out.reflections = 1;
    out.first_reflector_normal = normal;
    const double edge = reflected_face_weights(edge_of_deck, in, out)[0];
    EXPECT_NEAR(foot + edge, 1, 1e-12) << sine;
    shared += edge > 0.01 && edge < 0.99;
  }
  EXPECT_GT(shared, 3);
}

// The penumbra is (2 l / k)^(1/2) = 0.44 m high.
TEST(WallPenumbra, NeedsAWallHigherThanThePenumbra) {
  const double k = wavenumber(10e9);
  const auto in_grazing = [&](double height) { return std::abs(closed_form(0, k, height).soft); };
  EXPECT_EQ(in_grazing(0.25), 0);
  EXPECT_GT(in_grazing(0.5), 10);
}

// The contribution belongs to the parts of wall and floor, so that a filter by part includes it correctly, and a cavity
// can replace it.
TEST(WallPenumbra, BelongsToTheWallAndItsFloor) {
  TriangleMesh corner = make_square_trihedral(0.4);
  for (std::size_t i = 0; i < corner.triangles.size(); ++i) corner.triangle_part[i] = static_cast<std::uint16_t>(i / 2);
  corner.part_names = {"one", "two", "three"};
  const Scatterer scatterer(corner);
  const BistaticGeometry geometry = monostatic(radar_basis(direction(30, 2)));
  const auto illuminations =
      illumination(scatterer, geometry, {0, 4, true}).trace(1, ignore_contributions).edge_illuminations;
  std::vector<Contribution> contributions;
  trace_multiple_diffraction({scatterer, geometry, {}, illuminations, {}}, illuminations.all(), contributions);
  int walls = 0;
  for (const Contribution& contribution : contributions) {
    if (!std::holds_alternative<WallPenumbraTerm>(contribution.interval()->amplitude)) continue;
    ++walls;
    EXPECT_NE(contribution.source.part, contribution.source.other_part);
  }
  EXPECT_GT(walls, 0);
}

}  // namespace
}  // namespace seaglint
