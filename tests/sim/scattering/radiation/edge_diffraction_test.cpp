// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/radiation/edge_diffraction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scattering/coefficients/amplitude_laws.h"
#include "sim/scattering/coefficients/fade_windows.h"
#include "sim/scattering/points/decomposition.h"
#include "sim/scattering/points/phase_integral.h"
#include "sim/scattering/scatterer/panels.h"
#include "sim/scattering/solver/aspect_trace.h"
#include "tests/measured.h"
#include "tests/sim/scattering/solve_calls.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

// Edge diffraction of plates, trihedrals, boxes and ships: against measured and full-wave echoes, continuity and
// reciprocity.

std::map<double, double> austin(const std::string& file) {
  std::ifstream in(std::string(SEAGLINT_SOURCE_DIR "/tests/reference/rcs/austin/") + file);
  EXPECT_TRUE(in) << file;
  std::map<double, double> cut;
  for (double hz, theta, phi, value; in >> hz >> theta >> phi >> value;) cut[phi] = value;
  return cut;
}

// Austin RCS benchmark suite, problem IIB: 6 x 10.5 inch, 64 mil, in the plane of the long side, 0-60 deg from normal.
// Physical optics without edges has an error of 4.3-5.4 dB; measurement and method of moments differ by 0.3-0.5 dB.
// Without the thickness term (k t = 0.17 and 0.35) a strip of this width has errors of 0.3 and 0.7, 0.6 and 1.2 dB.
// With it vertices, the next order in k t and fifth-order diffraction remain, half a decibel at 4.6 wavelengths.
TEST(PlateEdges, MatchTheMethodOfMoments) {
  const TriangleMesh mesh = make_plate(10.5 * 0.0254, 6 * 0.0254);
  const Scatterer sheet(mesh), plate(mesh, {}, radians(kDefaultCreaseDeg), 0.064 * 0.0254);
  for (const auto& [name, hz] : {std::pair{"f10", 5.12e9}, std::pair{"f11", 10.24e9}}) {
    for (const char polarisation : {'H', 'V'}) {
      const auto reference = austin(std::string("ref_rcs.II.B.sx1.") + name + '.' + polarisation + ".txt");
      double thick = 0, thin = 0, without = 0;
      int count = 0;
      for (const auto& [phi, moments] : reference) {
        if (phi > 60) break;
        const RadarBasis basis = radar_basis(direction(phi, 0));
        const int channel = polarisation == 'H' ? kHhChannel : kVvChannel;
        thick += std::abs(dbsm(echo(plate, basis, wavenumber(hz), 0, 8, true)[channel]) - moments);
        thin += std::abs(dbsm(echo(sheet, basis, wavenumber(hz), 0, 8, true)[channel]) - moments);
        without += std::abs(dbsm(echo(sheet, basis, wavenumber(hz), 0, 8, false)[channel]) - moments);
        ++count;
      }
      const char* channel_name = polarisation == 'H' ? "hh" : "vv";
      record_figure(thick / count, 2, "plate_{:.0f}ghz_{}_mean_db", 1e-9 * hz, channel_name);
      record_figure(thin / count, 2, "plate_{:.0f}ghz_{}_thin_mean_db", 1e-9 * hz, channel_name);
      record_figure(without / count, 2, "plate_{:.0f}ghz_{}_without_edges_mean_db", 1e-9 * hz, channel_name);
      EXPECT_LT(thick / count, hz < 6e9 ? 0.55 : 0.25) << name << polarisation;
      EXPECT_LT(thin / count, 1.5) << name << polarisation;
      EXPECT_GT(without / count, 4) << name << polarisation;
    }
  }
}

TEST(TrihedralEdges, ReduceTheErrorFromTheFullWaveSolution) {
  const Scatterer trihedral(make_triangular_trihedral(4));
  double squares[2] = {}, powers[2] = {}, power = 0;
  Complex product[2] = {};
  int count = 0;
  for (const auto& row : read_csv("trihedral_fdtd.csv")) {
    const Complex full_wave(std::stod(row[9]), std::stod(row[10]));
    const RadarBasis basis = radar_basis(direction(45 + std::stod(row[0]), 35.264389682754654));
    for (const int edges : {0, 1}) {
      const Complex ours = echo(trihedral, basis, 2 * kPi * std::stod(row[2]), 0, 8,
                                edges == 1)[row[1] == "V" ? kVvChannel : kHhChannel];
      squares[edges] += std::pow(dbsm(ours) - dbsm(full_wave), 2);
      powers[edges] += std::norm(ours);
      product[edges] += ours * std::conj(full_wave);
    }
    power += std::norm(full_wave);
    ++count;
  }
  ASSERT_EQ(count, 20);
  const double rms = std::sqrt(squares[1] / count), correlation = std::abs(product[1]) / std::sqrt(powers[1] * power);
  record_figure(rms, 2, "trihedral_rms_db");
  record_figure(correlation, 3, "trihedral_correlation");
  record_figure(std::sqrt(squares[0] / count), 2, "trihedral_without_edges_rms_db");
  record_figure(std::abs(product[0]) / std::sqrt(powers[0] * power), 3, "trihedral_without_edges_correlation");
  // The reference's own 0.3 dB, and at 4-5 wavelengths higher diffraction orders and vertices.
  EXPECT_LT(rms, 0.35);
  EXPECT_LT(rms, std::sqrt(squares[0] / count));
  EXPECT_GT(correlation, 0.995);
}

// At the plane of symmetry between two faces of a trihedral the order of their two reflections changes. The echo of 6.5
// m is continuous there: over 0.002 deg it changes by less than its lobes do, k times the leg per radian, and 0.01 m of
// face-grazing diffracted waves along the edges from a vertex, on one side of the plane or the other. A jump of 0.7 m
// would result from reflected waves that illuminate the seams from behind.
TEST(TrihedralEdges, AreContinuousWhereTheOrderOfReflectionsChanges) {
  constexpr double leg = 4, offset_deg = 0.001;
  const Scatterer trihedral(make_triangular_trihedral(leg));
  const double k = wavenumber(0.3e9);
  for (const double elevation_deg : {10.0, 25.0, 35.0}) {
    const double middle_deg = degrees(std::asin(std::tan(radians(elevation_deg))));  // y = z
    const auto at = [&](double azimuth_deg) {
      return echo(trihedral, radar_basis(direction(azimuth_deg, elevation_deg)), k, 0, 8, true);
    };
    const auto before = at(middle_deg - offset_deg), after = at(middle_deg + offset_deg);
    for (const int channel : {kHhChannel, kVvChannel}) {
      EXPECT_LT(std::abs(after[channel] - before[channel]),
                0.01 + std::abs(before[channel]) * k * leg * 2 * radians(offset_deg))
          << elevation_deg << ' ' << channel;
    }
  }
}

// A sweep in small steps has no spikes: the echo changes no faster than the plate's own lobes, k times its length per
// radian and with their envelope: the sinc's 1 or 1 / X, X = k length u, and an edge's, which does not grow towards the
// normal.
TEST(PlateEdges, HaveNoSpikesInAFullSweep) {
  const Scatterer plate(make_plate(0.25, 0.15));
  const double k = wavenumber(10e9), step = 0.05, length = 0.25, width = 0.15;
  for (const double elevation : {0.0, 2.0, 35.0}) {
    std::array<Complex, 4> last{};
    for (double azimuth = 0; azimuth <= 180; azimuth += step) {
      const auto s = echo(plate, radar_basis(direction(azimuth, elevation)), k, 0, 8, true);
      if (azimuth > 0) {
        for (const int channel : {kHhChannel, kVvChannel}) {
          const double u = std::abs(std::sin(radians(azimuth)) * std::cos(radians(elevation)));
          const double envelope = width * length * k / (2 * kPi) * std::min(1.0, 2 / (k * length * u)) + width / kPi;
          EXPECT_LT(std::abs(s[channel] - last[channel]), envelope * k * length * radians(step))
              << azimuth << ' ' << elevation;
        }
      }
      last = s;
    }
  }
}

// A sheet without thickness does not scatter a wave whose electric field is normal to it: edge-on, HH vanishes, while
// VV is the echo of a half-plane's edge of this length, width / 2 pi, and the contribution of the rear edge. Each order
// of diffraction has that magnitude. For a direction exactly in the sheet the look direction is perturbed a little,
// whatever the sheet's orientation about the line of sight.
TEST(PlateEdges, EdgeOnEchoIsContinuousForAnyOrientation) {
  const double k = wavenumber(10e9);
  for (const double rotation_deg : {0.0, 20.0, 45.0, 90.0, 135.0, 160.0}) {
    const Mat3 rotation = axis_rotation(radians(rotation_deg), Vec3::UnitX());
    const Scatterer sheet(
        transformed(make_plate(0.3, 0.2), rotation * axis_rotation(kPi / 2, Vec3::UnitY()), Vec3::Zero()));
    const double exactly = largest(echo(sheet, radar_basis(direction(0, 0)), k, 0, 8, true));
    const double off_plane = largest(echo(sheet, radar_basis(direction(1e-3, 1.3e-3)), k, 0, 8, true));
    EXPECT_GT(exactly, 0.5 * off_plane) << rotation_deg;
    EXPECT_LT(exactly, 2 * off_plane) << rotation_deg;
  }
}

// A sheet in the line of sight scatters however small it is compared with the radius of the body: far from the origin
// as at the origin, but for the phase.
TEST(PlateEdges, EdgeOnEchoIndependentOfPosition) {
  const double k = wavenumber(10e9);
  const Mat3 flat = axis_rotation(kPi / 2, Vec3::UnitY());
  for (const double elevation_deg : {0.0, 5e-4}) {
    const Vec3 r = direction(0, elevation_deg);
    const Complex here = echo(Scatterer(transformed(make_plate(0.2, 0.2), flat, Vec3::Zero())), radar_basis(r), k, 0, 8,
                              true)[kHhChannel];
    EXPECT_GT(std::abs(here), 0.01);  // m
    for (const Vec3& place : {Vec3(3, 0, 0), Vec3(5, 20, 1)}) {
      const Complex elsewhere =
          echo(Scatterer(transformed(make_plate(0.2, 0.2), flat, place)), radar_basis(r), k, 0, 8, true)[kHhChannel];
      // Exactly in its plane the look direction is perturbed by 1e-6 rad, and vertices lie within 1e-7 m of it.
      const double tolerance = 2 * k * (1e-6 * place.norm() + 1e-7);
      EXPECT_LT(std::abs(elsewhere / here * std::polar(1.0, -2 * k * r.dot(place)) - 1.0), tolerance)
          << elevation_deg << ' ' << place.x() << ' ' << place.y() << ' ' << place.z();
    }
  }
}

TEST(PlateEdges, EdgeOnEchoOnlyForEAlongTheEdge) {
  const double width = 0.15, edge_amplitude = width / (2 * kPi);
  const Scatterer plate(make_plate(0.25, width));
  for (const double off_deg : {1.0, 0.1, 0.01, 0.001, 0.0, -0.1}) {
    const auto s = echo(plate, radar_basis(direction(90 - off_deg, 0)), wavenumber(10e9), 0, 8, true);
    // The fourth order is truncated, 1 / (2 pi k length) of the others; a direction exactly in the sheet is perturbed
    // by 1e-6 rad.
    EXPECT_LT(std::abs(s[kHhChannel]), 0.1 * edge_amplitude) << off_deg;
    EXPECT_NEAR(std::abs(s[kVvChannel]), edge_amplitude, 0.1 * edge_amplitude) << off_deg;
  }
}

// In the plane of a face multiple diffraction has a pole whose product with the transition function has a limit: the
// edges' contribution there differs by at most half of the longest edge's contribution from that at 0.01 deg off, where
// it still varies.
TEST(EdgeDiffraction, HasALimitInThePlaneOfAFace) {
  MeshBuilder box;
  box.begin_part("box");
  add_box(box, {}, {0.4, 0.3, 0.2});
  const Scatterer target(box.take());
  const double k = wavenumber(10e9), one_edge = 0.4 / (2 * kPi);
  const auto edge_part = [&](double azimuth, double elevation) {
    const RadarBasis basis = radar_basis(direction(azimuth, elevation));
    auto s = echo(target, basis, k, 0, 8, true);
    const auto optics = echo(target, basis, k, 0, 8, false);
    for (int i = 0; i < 4; ++i) s[i] -= optics[i];
    return s;
  };
  for (const double elevation : {0.0, 2.0}) {
    for (const double azimuth : {0.0, 90.0, 180.0}) {
      const auto in_plane = edge_part(azimuth, elevation), off_plane = edge_part(azimuth - 0.01, elevation);
      for (const int channel : {kHhChannel, kVvChannel})
        EXPECT_LT(std::abs(in_plane[channel] - off_plane[channel]), 0.5 * one_edge) << azimuth << ' ' << elevation;
    }
  }
}

TEST(EdgeDiffraction, OfTheShipIsFiniteInThePlanesOfItsFaces) {
  const Scatterer ship(read_mesh(SEAGLINT_SOURCE_DIR "/assets/combatant_144m.glb"));
  for (const double elevation : {0.0, 2.0}) {
    for (const double azimuth : {0.0, 45.0, 90.0, 180.0}) {
      const BistaticGeometry geometry = monostatic(radar_basis(direction(azimuth, elevation)));
      const auto s = scattering_matrices(ship, geometry, std::array{wavenumber(16e9)}, {0, 8, true}, 2)[0];
      for (const Complex& x : s) EXPECT_LT(std::abs(x), 1e4) << azimuth << ' ' << elevation;  // also excludes NaN
    }
  }
}

// Physical optics of a face is not reciprocal, Keller's coefficients are: fringe currents correct it. The residual is
// that of vertices and, in any direction off all Keller cones, the choice of the ray along which currents are
// integrated.
TEST(EdgeDiffraction, PlateIsReciprocal) {
  const Scatterer plate(make_plate(0.25, 0.15));
  const std::array k{wavenumber(10e9)};
  Random random({5, Stream::kTest, 43});
  const auto any_view = [&] {
    return radar_basis(direction(160 * random.uniform() - 80, 100 * random.uniform() - 50));
  };
  double optics = 0, with_edges = 0;
  for (int i = 0; i < 200; ++i) {
    const RadarBasis t = any_view(), r = any_view();
    for (const bool edges : {false, true}) {
      const auto forward = scattering_matrices(plate, bistatic(t, r), k, {0, 1, edges})[0],
                 reciprocal = scattering_matrices(plate, bistatic(r, t), k, {0, 1, edges})[0];
      double& sum = edges ? with_edges : optics;
      sum += std::norm(forward[kHhChannel] - reciprocal[kHhChannel]) +
             std::norm(forward[kVvChannel] - reciprocal[kVvChannel]) +
             std::norm(forward[kHvChannel] - reciprocal[kVhChannel]) +
             std::norm(forward[kVhChannel] - reciprocal[kHvChannel]);
    }
  }
  std::printf("rms |S(a, b) - S(b, a)^T|: %.4f, without edges %.4f m\n", std::sqrt(with_edges / 200),
              std::sqrt(optics / 200));
  EXPECT_LT(with_edges, 0.05 * optics);
}

// Shadow boundaries of reflected beams: the effective width of a double knife-edge against Fresnel's integral, its
// point contributions against independent traces. InfinitePrism compares the echo with integral equations.

std::vector<Contribution> boundary_terms(const Scatterer& scatterer, const Vec3& r) {
  std::vector<Contribution> all;
  illumination(scatterer, monostatic(radar_basis(r)), {0, 8, true})
      .trace(1, [&](std::size_t, std::size_t, std::span<const Contribution> contributions) {
        std::ranges::copy_if(contributions, std::back_inserter(all), &Contribution::interval);
      });
  return all;
}

// Behind a half-plane the field at u beyond the shadow-boundary line is erfc(e^{j pi/4} u) / 2; the correction of the
// beam is its integral beyond the second edge. With both integrals rotated by e^{-j pi/4} and their order exchanged it
// is that of t e^{-(a + t)^2} / sqrt(pi) over t > 0, a = e^{j pi/4} u.
TEST(DoubleKnifeEdge, HasTheWidthOfFresnelsFieldBeyondTheSecondEdge) {
  const double k = wavenumber(10e9), d = 0.7;
  for (const double width : {0.0, 0.01, 0.05, 0.2}) {
    DoubleKnifeEdge knife_edges{{d, d}, {width * width / (2 * d), width * width / (2 * d)}, 0};
    const Complex a = std::polar(width * std::sqrt(k / (2 * d)), kPi / 4);
    Complex integral = 0;
    constexpr double step = 1e-3;
    for (double t = step / 2; t < 12; t += step) integral += step * t * std::exp(-(a + t) * (a + t)) / std::sqrt(kPi);
    const Complex correction =
        k * std::sqrt(2 * d / k) * std::polar(1.0, -kPi / 4) * integral * std::exp(kJ * std::norm(a));
    // The error of the transition function is 1e-7, that of the sum step^2 / 24 of the integrand's slope.
    EXPECT_NEAR(std::abs(knife_edges.at(k, 0.5) - correction), 0, 1e-6 * k * std::sqrt(2 * d / k)) << width;
  }
}

// The same for a psi of slope `slope`: the residual of the integral of E(x) e^{jk slope x} up to the second edge at w,
// less the end-point contribution of physical optics there and that of the first edge where its path lands within the
// second one. The field beyond the second edge is rotated and its order exchanged as above.
TEST(DoubleKnifeEdge, CouplesEndPointsForASlopingPsi) {
  const double k = wavenumber(10e9), d = 0.7, unit = std::sqrt(2 * d / k);
  for (const double slope : {-0.3, -0.05, 0.04, 0.15}) {
    for (const double w : {-0.3, -0.08, -0.01, 0.003, 0.05, 0.4}) {
      const double landing = w - slope * d, sigma = k * slope * unit;
      DoubleKnifeEdge knife_edges{{d, d}, {w * w / (2 * d), w * w / (2 * d)}, slope};
      knife_edges.exit_excess.fill(std::copysign(landing * landing / (2 * d), landing));
      knife_edges.second_in_shadow = w > 0;
      knife_edges.off_axis_weight = 1;
      knife_edges.axial_weight = 0;
      // The first edge's field beyond the second one, times e^{-jk slope w}.
      const Complex a = std::polar(1.0, kPi / 4) * (w / unit), c = kJ * sigma * std::polar(1.0, -kPi / 4);
      Complex beyond = 0;
      constexpr double step = 2e-4;
      for (double r = step / 2; r < 40; r += step)
        beyond += step * (std::exp(c * r - (a + r) * (a + r)) - std::exp(-(a + r) * (a + r))) / (c * std::sqrt(kPi));
      beyond *= unit * std::polar(1.0, -kPi / 4);
      const auto end = [&](double phase) { return std::polar(1.0, phase) / (kJ * k * slope); };
      // The whole integral is that of e^{j k slope^2 d / 2}, from which the second edge removes `beyond`.
      const Complex all = end(0.5 * k * slope * slope * d - k * slope * w) - beyond;
      const Complex endpoints =
          (landing > 0 ? end(0.5 * k * slope * slope * d - k * slope * w) : 0.0) + (w < 0 ? end(0) : 0.0);
      const Complex width = -k * (all - endpoints) * std::polar(1.0, k * w * w / (2 * d));
      // The error of the transition function is 1e-7 of the end-point contributions, that of nearly equal arguments the
      // square of 0.05 over 24.
      EXPECT_NEAR(std::abs(knife_edges.at(k, 0.5) - width), 0, 2e-4 / std::abs(slope) + 1e-6 * k * unit)
          << slope << " " << w;
    }
  }
}

// Edges that meet in one point: the path between them grows from 0. The end-point contributions replace the integral
// where the phase difference reaches ten cycles.
TEST(DoubleKnifeEdge, EqualsItsEndPointsOverManyCycles) {
  const double k = wavenumber(10e9);
  EdgeInterval contribution;
  contribution.length = 0.4;
  contribution.amplitude = DoubleKnifeEdge{{0, 0.5}, {0, 1e-4}, 0};
  contribution.psi = {0, 59.9 / k};
  const Complex summed = interval_integral(contribution, k, 0, 1), half = std::polar(1.0, 0.5 * 59.9);
  const Complex endpoints =
      endpoint_term(contribution, k, 1) * half - endpoint_term(contribution, k, 0) * std::conj(half);
  EXPECT_LT(std::abs(summed - endpoints), 0.02 * std::abs(summed));
  // Parts sum to the whole.
  Complex parts = 0;
  for (int i = 0; i < 5; ++i)
    parts += interval_integral(contribution, k, 0.2 * i, 0.2 * (i + 1)) * std::polar(1.0, 59.9 * (0.2 * i - 0.4));
  EXPECT_NEAR(std::abs(parts - summed), 0, 1e-3 * std::abs(summed));
}

// Edges that meet in a vertex are not coupled there, for either sign of the paths' rounding: otherwise a long interval
// that is represented by its end-point contributions would have one there.
TEST(DoubleKnifeEdge, VanishesWhereEdgesMeet) {
  const Scatterer reflector(read_mesh(SEAGLINT_SOURCE_DIR "/assets/icosahedral_reflector.glb"));
  int vertices = 0;
  for (double azimuth = 40; azimuth < 60; azimuth += 0.25) {
    for (const Contribution& contribution : boundary_terms(reflector, direction(azimuth, 20))) {
      const auto* term = std::get_if<DoubleKnifeEdge>(&contribution.interval()->amplitude);
      if (!term) continue;
      const DoubleKnifeEdge& knife_edges = *term;
      for (std::size_t end = 0; end < 2; ++end) {
        // Where only one of both is in shadow the end-point contribution of the other remains, and they are coupled.
        if (knife_edges.separation[end] > 1e-9 ||
            (knife_edges.exit_excess[1 - end] > 0) != knife_edges.second_in_shadow)
          continue;
        ++vertices;
        // F(u^2) / u of u below 1e-6 over slopes from 0.03
        EXPECT_LT(std::abs(knife_edges.at(wavenumber(16e9), static_cast<double>(end))), 1e-3) << azimuth;
      }
    }
  }
  EXPECT_GT(vertices, 100);
}

// One trace is valid over an aspect change of 0.1 deg: the icosahedral reflector, where these contributions are
// largest.
TEST(DoubleKnifeEdge, MatchesIndependentTracesOverAnAspectChange) {
  const Scatterer reflector(read_mesh(SEAGLINT_SOURCE_DIR "/assets/icosahedral_reflector.glb"));
  const double k = wavenumber(16e9);
  for (const auto& [azimuth, elevation] : {std::pair{48.0, 20.0}, {70.0, 2.0}, {33.0, 20.0}}) {
    const Vec3 r = direction(azimuth, elevation);
    std::vector<Point> points;
    for (const Contribution& contribution : boundary_terms(reflector, r))
      decompose(contribution, {monostatic(radar_basis(r))}, {FrequencyBand(k), 0, radians(0.15)}, points);
    RelativeError error;
    for (const double change : {-0.07, 0.07}) {
      const Vec3 changed = direction(azimuth + change, elevation + 0.7 * change);
      const auto frozen = direct_sum(points, k, changed - r);
      std::array<Complex, 4> independent{};
      for (const Contribution& footprint : boundary_terms(reflector, changed))
        add_to(independent, scattered(footprint, {monostatic(radar_basis(changed))}, k));
      for (int i = 0; i < 4; ++i) error.add(frozen[i], independent[i]);
    }
    std::printf("%g deg: %.3f m, error %.1f dB\n", azimuth, std::sqrt(error.power / 2), error.db());
    EXPECT_GT(std::sqrt(error.power / 2), 0.05);
    // end points that slide and widths are frozen: -27 dB of what is -30 dB of the reflector's own echo
    EXPECT_LT(error.error, 2e-3 * error.power) << azimuth;
  }
}

// Bounding edges of reflectors in the direction of the reflected beam: closed forms.

// The edge of a right-angled dihedral's arm y = 0, x <= 0, whose other arm is at some x < 0; the wave is incident from
// in front of the edge and leaves the arm at an angle `above` towards the other one.
struct DihedralEdge {
  WedgeFrame wedge;
  EdgeIllumination in, out;
};

DihedralEdge dihedral_edge(double above, double off_specular = 0) {
  const Vec3 x = -Vec3::UnitX(), y = Vec3::UnitY(), t = x.cross(y);
  const double c = std::cos(above), s = std::sin(above), c2 = std::cos(above + off_specular),
               s2 = std::sin(above + off_specular);
  DihedralEdge edge{{{{x, y, t}, {x, -y, -t}}, 2}, {}, {}};
  edge.in.direction = {-c, -s, 0};
  edge.in.E_h = {-s, c, 0};  // hard: normal to the edge
  edge.in.E_v = Vec3::UnitZ();
  // The receiver's wave, reversed, after the other arm: E' = 2 (n.E) n - E.
  edge.out.direction = {c2, -s2, 0};
  edge.out.E_h = {-s2, -c2, 0};
  edge.out.E_v = -Vec3::UnitZ();
  edge.out.reflections = 1;
  edge.out.first_reflector_normal = Vec3::UnitX();
  return edge;
}

// hh and vv of the edge in the direction of the beam, per metre.
std::array<double, 2> coefficients(const DihedralEdge& edge) {
  const auto currents =
      equivalent_edge_currents(edge.wedge, edge.in.direction, {edge.in.E_h, edge.in.E_v}, -edge.out.direction);
  const auto endpoints = endpoint_correction(edge.wedge.face[0], edge.in, edge.out);
  return {edge.out.E_h.dot(currents[0]) + endpoints[0], edge.out.E_v.dot(currents[1]) + endpoints[3]};
}

// Keller's 1 / (2 sin a) less tan(a) / 2 of the other arm's end-point contribution, over 2 pi; soft and hard
// coefficients have opposite signs, as a dihedral's echoes do.
TEST(ReflectedEdge, OfADihedralIsKellersCoefficientLessTheOtherArmsEndPoint) {
  // the sign of the edge of the last reflector, below
  const double sign = std::copysign(1.0, coefficients(dihedral_edge(radians(45)))[0]);
  for (const double above_deg : {10.0, 20.0, 33.0, 45.0, 60.0}) {
    const double above = radians(above_deg), expected = (1 / std::sin(above) - std::tan(above)) / (4 * kPi);
    const auto [hard, soft] = coefficients(dihedral_edge(above));
    // The end-point contributions are evaluated 1e-4 rad to either side of the beam, on a curve whose curvature is 1 /
    // a^3.
    EXPECT_NEAR(hard, sign * expected, 1e-6) << above_deg;
    EXPECT_NEAR(soft, sign * expected, 1e-6) << above_deg;
  }
}

// On a dihedral's axis both arms are equivalent, and so are the bounding edges of the first and the last reflector.
TEST(ReflectedEdge, OnADihedralsAxisEqualsThatOfTheLastReflector) {
  const DihedralEdge first = dihedral_edge(radians(45));
  const auto currents =
      equivalent_edge_currents(first.wedge, first.out.direction, {first.out.E_h, first.out.E_v}, -first.in.direction);
  const auto [hard, soft] = coefficients(first);
  EXPECT_NEAR(first.in.E_h.dot(currents[0]), hard, 1e-6);
  EXPECT_NEAR(first.in.E_v.dot(currents[1]), soft, 1e-6);
}

TEST(ReflectedEdge, NeedsNoCorrectionOnTheLastReflector) {
  const DihedralEdge edge = dihedral_edge(radians(30));
  for (const double end : endpoint_correction(edge.wedge.face[0], edge.out, edge.in)) EXPECT_EQ(end, 0);
}

// At an angle b about the edge off the specular direction: Keller's coefficients of a half-plane less the end-point
// contribution of physical optics on the other arm, whose currents are proportional to the cosine of incidence (soft)
// or of the exit direction (hard).
TEST(ReflectedEdge, ExcludesTheOtherArmsEndPointOffTheSpecularDirection) {
  for (const double above_deg : {20.0, 45.0, 60.0}) {
    const double above = radians(above_deg), sign = std::copysign(1.0, coefficients(dihedral_edge(radians(45)))[0]);
    for (const double off_specular : {-0.15, -0.002, 0.002, 0.05, 0.3}) {
      const double direct = 1 / std::cos(0.5 * (kPi - 2 * above - off_specular)),
                   pole = 1 / std::sin(0.5 * off_specular);
      const double slope_difference = std::sin(above + off_specular) - std::sin(above);
      const auto [hard, soft] = coefficients(dihedral_edge(above, off_specular));
      // Rounding near the poles.
      EXPECT_NEAR(soft, sign * ((direct + pole) / (4 * kPi) - std::cos(above) / (2 * kPi * slope_difference)), 1e-9)
          << above_deg << " " << off_specular;
      EXPECT_NEAR(hard,
                  sign * ((direct - pole) / (4 * kPi) + std::cos(above + off_specular) / (2 * kPi * slope_difference)),
                  1e-9)
          << above_deg << " " << off_specular;
    }
  }
}

// A beam that does not reach the other reflector has no end-point contribution there: the one of physical optics on the
// edge's own face is added back, and the edge has Keller's field.
TEST(ReflectedEdge, EqualsKellerFieldWithoutReflectedBeam) {
  DihedralEdge edge = dihedral_edge(radians(50));
  edge.in.direction = {std::cos(radians(50)), -std::sin(radians(50)), 0};  // both paths via the other arm
  edge.in.E_h = {-std::sin(radians(50)), -std::cos(radians(50)), 0};
  edge.in.reflections = 1;
  edge.in.first_reflector_normal = Vec3::UnitX();
  edge.out = edge.in;
  const auto [hard, soft] = coefficients(edge);
  EXPECT_NEAR(std::abs(soft), std::abs(1 - 1 / std::cos(radians(50))) / (4 * kPi), 1e-9);
  EXPECT_NEAR(std::abs(hard), std::abs(1 + 1 / std::cos(radians(50))) / (4 * kPi), 1e-9);
}

// An edge askew to the reflector behind it: in a second direction on Keller's cone psi does not vary across the image
// of the edge's face on the reflector. The end-point contributions are finite there, since that of the reflector is
// left out, as in the direction of the beam, since the poles cancel.
TEST(ReflectedEdge, HasNoPoleAskewToTheReflector) {
  const Vec3 k_hat(0.6338, -0.7686, -0.0872),
      n = Vec3(-0.9415, -0.2414, -0.2354).normalized(),
      t = (Vec3(0, -0.6981, 0.7160) - n.dot(Vec3(0, -0.6981, 0.7160)) * n).normalized(), x = n.cross(t);
  const WedgeFace face{x, n, t};  // t = x cross n
  EdgeIllumination in, out;
  in.direction = k_hat.normalized();
  in.E_h = in.direction.unitOrthogonal();
  in.E_v = in.direction.cross(in.E_h);
  out.reflections = 1;
  out.first_reflector_normal = Vec3::UnitZ();
  const Vec3 beam = in.direction - 2 * n.dot(in.direction) * n;
  double largest = 0;
  for (double off = -0.9; off <= 0.3; off += 1e-4) {
    out.direction = -(axis_rotation(off, t) * beam);
    out.E_h = out.direction.unitOrthogonal();
    out.E_v = out.direction.cross(out.E_h);
    for (const double end : endpoint_correction(face, in, out)) largest = std::max(largest, std::abs(end));
  }
  EXPECT_GT(largest, 0.1);
  // 1 / (2 pi) over the least slope of psi and the sine of the grazing angle at the reflector.
  EXPECT_LT(largest, 1 / (2 * kPi * kSlopeWindow[1] * std::abs(beam.z())));
}

TEST(ReflectedEdge, WeightsVanishWhereNotSeparableFromTheBeam) {
  const auto weights = [](double above, double off_specular, int reflections = 1) {
    DihedralEdge edge = dihedral_edge(above, off_specular);
    edge.out.reflections = static_cast<std::uint8_t>(reflections);
    return reflected_face_weights(edge.wedge, edge.in, edge.out);
  };
  EXPECT_EQ(weights(radians(30), 0)[1], 0);
  for (const double off_specular : {0.0, 0.05, 0.25, -0.2})
    EXPECT_DOUBLE_EQ(weights(radians(30), off_specular)[0], 1) << off_specular;
  // Shadow-boundary lines after three reflectors keep their end-point contributions: corrected only where it makes no
  // difference.
  EXPECT_DOUBLE_EQ(weights(radians(30), 0.05, 3)[0], 1);
  EXPECT_EQ(weights(radians(30), 0.25, 3)[0], 0);
  // Grazing: the face of the edge, the other reflector.
  EXPECT_EQ(weights(radians(1.5), 0)[0], 0);
  EXPECT_EQ(weights(radians(60), radians(29))[0], 0);
  // Off Keller's cone.
  DihedralEdge edge = dihedral_edge(radians(30));
  edge.out.direction = (edge.out.direction + 0.3 * Vec3::UnitZ()).normalized();
  EXPECT_EQ(std::ranges::max(reflected_face_weights(edge.wedge, edge.in, edge.out)), 0);
}

}  // namespace
}  // namespace seaglint
