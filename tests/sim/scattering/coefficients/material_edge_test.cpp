// SPDX-License-Identifier: BSD-3-Clause
// Edge currents of wedges and sheets of materials: perfect conductors and vacuum as limits, finite on shadow
// boundaries.
#include "sim/scattering/coefficients/material_edge.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/scattering/coefficients/material.h"
#include "sim/scattering/coefficients/wedge_diffraction.h"
#include "sim/scenario/material_file.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

const double k10 = wavenumber(10e9);

WedgeFrame wedge(double N) {
  const Vec3 x2(std::cos(N * kPi), std::sin(N * kPi), 0), t = Vec3::UnitZ();
  return {{{Vec3::UnitX(), Vec3::UnitY(), t}, {x2, (-t).cross(x2), -t}}, N};
}

// Unit vector at the angle phi about the edge and b from it.
Vec3 towards(double phi, double b) { return {std::sin(b) * std::cos(phi), std::sin(b) * std::sin(phi), std::cos(b)}; }

MaterialSpec sheet(double real, double loss, double thickness_mm) {
  MaterialSpec spec;
  spec.kind = SurfaceKind::kLayers;
  spec.backing = Backing::kAir;
  spec.layers.resize(1);
  spec.layers[0].thickness_mm = thickness_mm;
  spec.layers[0].permittivity.real = real;
  spec.layers[0].permittivity.loss = loss;
  return spec;
}

double difference(const std::array<CVec3, 2>& a, const std::array<Vec3, 2>& b, const Vec3& s) {
  double worst = 0;
  for (int i = 0; i < 2; ++i) {
    const CVec3 d = a[i] - b[i].cast<Complex>(), radial = (s.cast<Complex>() * component_along(s, d));
    worst = std::max(worst, norm_of(d - radial));  // the component along s is not received
  }
  return worst;
}

TEST(MaterialEdge, OfPerfectConductorsIsTheirEquivalentEdgeCurrent) {
  const MaterialSurface conductor(MaterialSpec{}, k10);
  const MaterialFaces faces{{&conductor, &conductor}, k10, false};
  Random random({3, Stream::kTest, 51});
  for (int i = 0; i < 300; ++i) {
    const double N = 1.05 + 0.95 * random.uniform(), b = 0.3 + 2.5 * random.uniform();
    const double phi0 = N * kPi * random.uniform(), phi = N * kPi * random.uniform();
    if (std::abs(std::abs(phi - phi0) - kPi) < 0.02 || std::abs(phi + phi0 - kPi) < 0.02 ||
        std::abs(2 * N * kPi - phi - phi0 - kPi) < 0.02 || std::min(phi, phi0) < 0.02 ||
        std::max(phi, phi0) > N * kPi - 0.02) {
      continue;
    }
    const Vec3 k_hat = -towards(phi0, kPi - b), s = towards(phi, b);  // on Keller's cone
    const Vec3 h = k_hat.cross(Vec3::UnitZ()).normalized(), v = k_hat.cross(h);
    const std::array fields{h, v};
    const auto expected = equivalent_edge_currents(wedge(N), k_hat, fields, s, kShadowBoundaryGuard);
    const auto currents = material_edge_currents(wedge(N), faces, k_hat, fields, s, kShadowBoundaryGuard);
    const double size = std::max({1.0, expected[0].norm(), expected[1].norm()});
    EXPECT_LT(difference(currents, expected, s), 1e-9 * size) << N << " " << phi0 << " " << phi << " " << b;
  }
}

// A face that reflects nothing radiates the current of the incident field, and the impedance wedge with sin(theta) =
// sin(phi0) reflects nothing: what is subtracted is the difference of the currents with the face visible and hidden. It
// is the integral of radiated_field() along the half-line: (1 / 2 pi) |n.k^| / ((s - k^).x), with every conversion of
// polarisation.
TEST(MaterialEdge, SubtractsWhatTheFacetsRadiate) {
  MaterialSpec black;
  black.kind = SurfaceKind::kSubmerged;  // te = tm = 0
  const MaterialSurface surface(black, k10), conductor(MaterialSpec{}, k10);
  const InterfaceCoefficients metal = conductor.at(1), none = surface.at(1);
  Random random({3, Stream::kTest, 53});
  for (const bool is_metal : {true, false}) {
    const MaterialSurface& face = is_metal ? conductor : surface;
    const MaterialFaces faces{{&face, &face}, k10, false};
    for (int i = 0; i < 200; ++i) {
      const double b = 0.3 + 2.5 * random.uniform(), phi0 = 0.1 + 2.9 * random.uniform(), N = 2;
      // Behind the face, near the shadow boundary: the guard alone decides whether its optics are subtracted.
      const double phi = kPi + phi0 + 0.5 * (random.uniform() - 0.5);
      if (phi < kPi + 0.05 || phi > 2 * kPi - 0.05 || std::abs(phi - phi0 - kPi) < 0.02) continue;
      const Vec3 k_hat = -towards(phi0, kPi - b), s = towards(phi, b), n = Vec3::UnitY();
      const Vec3 h = k_hat.cross(Vec3::UnitZ()).normalized();
      const std::array fields{h, Vec3(k_hat.cross(h))};
      const auto with = material_edge_currents(wedge(N), faces, k_hat, fields, s, 1),
                 without = material_edge_currents(wedge(N), faces, k_hat, fields, s, 0);
      for (int q = 0; q < 2; ++q) {
        const CVec3 optics = radiated_field(is_metal ? metal : none, k_hat, n, s, fields[q].cast<Complex>()) *
                             (std::abs(n.dot(k_hat)) / (2 * kPi * (s - k_hat).x()));
        const CVec3 d = without[q] - with[q] - optics;
        const CVec3 received = d - s.cast<Complex>() * component_along(s, d);
        EXPECT_LT(norm_of(received), 1e-9 * (1 + norm_of(optics))) << is_metal << " " << phi0 << " " << phi << " " << b;
      }
    }
  }
}

// Backscatter off the cone of a conducting half-plane seen broadside in the plane of the edge and its normal:
// Michaeli's current, to 10 %.
TEST(MaterialEdge, FollowsMichaelisCurrentOffKellersCone) {
  const MaterialSurface conductor(MaterialSpec{}, k10);
  const MaterialFaces faces{{&conductor, &conductor}, k10, false};
  for (const double off : {10.0, 30.0, 45.0, 60.0}) {
    const Vec3 s = towards(kPi / 2, kPi / 2 - radians(off)), in_plane = Vec3::UnitX().cross(s);
    const auto michaeli = equivalent_edge_currents(wedge(2), -s, {in_plane, Vec3::UnitX()}, s, kShadowBoundaryGuard);
    const auto ours = material_edge_currents(wedge(2), faces, -s, {in_plane, Vec3::UnitX()}, s, kShadowBoundaryGuard);
    const double expected = in_plane.dot(michaeli[0]);
    EXPECT_LT(std::abs(component_along(in_plane, ours[0]) - expected), 0.1 * std::abs(expected)) << off;
  }
}

TEST(MaterialEdge, OfASheetOfVacuumIsZero) {
  const MaterialSurface vacuum(sheet(1, 0, 3), k10);
  const MaterialFaces faces{{&vacuum, &vacuum}, k10, true};
  Random random({3, Stream::kTest, 52});
  for (int i = 0; i < 100; ++i) {
    const Vec3 k_hat = -towards(2 * kPi * random.uniform(), 0.3 + 2.5 * random.uniform()),
               s = towards(2 * kPi * random.uniform(), 0.3 + 2.5 * random.uniform());
    const Vec3 h = k_hat.cross(Vec3::UnitZ()).normalized();
    const auto currents = material_edge_currents(wedge(2), faces, k_hat, {h, k_hat.cross(h)}, s, kShadowBoundaryGuard);
    EXPECT_LT(norm_of(currents[0]) + norm_of(currents[1]), 1e-6);  // rounding over the distance from a boundary
  }
}

// A weak sheet is illuminated by the incident field alone (Born): its polarisation, (eps - 1) E along the sheet and (1
// - 1 / eps) E along its normal, radiates P = k t / 4 times (eps - 1) for the soft wave and -(eps - 1) sin phi sin phi0
// - (1 - 1 / eps) cos phi cos phi0 for the hard one, over cos phi + cos phi0. Behind the sheet no optics are
// subtracted.
TEST(MaterialEdge, OfAWeakSheetIsTheFieldOfItsPolarisation) {
  for (const double permittivity : {1.5, 4.0}) {
    const double thickness = 2e-6, weak = k10 * thickness / 4;
    const MaterialSurface surface(sheet(permittivity, 0, 1e3 * thickness), k10);
    const MaterialFaces faces{{&surface, &surface}, k10, true};
    for (const double phi0 : {0.5, 1.2, 2.4}) {
      for (const double phi : {3.4, 4.1, 4.9, 5.6}) {
        if (std::abs(phi - phi0 - kPi) < 0.2) continue;
        const Vec3 k_hat = -towards(phi0, kPi / 2), s = towards(phi, kPi / 2), across = Vec3::UnitZ().cross(k_hat);
        const auto currents = material_edge_currents(wedge(2), faces, k_hat, {Vec3::UnitZ(), across}, s, 0);
        const double sum = std::cos(phi) + std::cos(phi0), along = weak * (permittivity - 1) / sum,
                     normal = weak * (1 - 1 / permittivity) / sum,
                     hard = -along * std::sin(phi) * std::sin(phi0) - normal * std::cos(phi) * std::cos(phi0);
        const Complex scale(0, 1 / kPi);
        // second order in k t
        const double tolerance = 4 * k10 * thickness * permittivity * std::abs(along);
        EXPECT_LT(std::abs(currents[0].z() / scale - along), tolerance) << permittivity << " " << phi0 << " " << phi;
        EXPECT_LT(std::abs(component_along(Vec3::UnitZ().cross(s), currents[1]) / scale - hard), tolerance)
            << permittivity << " " << phi0 << " " << phi;
      }
    }
  }
}

// A sheet of high conductivity is opaque: its edge is that of a conducting half-plane.
TEST(MaterialEdge, OfAConductingSheetTendsToThePerfectConductor) {
  MaterialSpec metal = sheet(1, 0, 0.01);
  metal.layers[0].permittivity.conductivity_s_m = 1e7;
  const MaterialSurface surface(metal, k10);
  const MaterialFaces faces{{&surface, &surface}, k10, true};
  for (const double phi : {0.4, 1.1, 1.5, 2.2, 2.9}) {
    const Vec3 s = towards(phi, kPi / 2), across = s.cross(Vec3::UnitZ());
    const auto expected = equivalent_edge_currents(wedge(2), -s, {Vec3::UnitZ(), across}, s, kShadowBoundaryGuard);
    const auto currents = material_edge_currents(wedge(2), faces, -s, {Vec3::UnitZ(), across}, s, kShadowBoundaryGuard);
    // k times the thickness, 0.002, and the surface impedance of 1e7 S/m, below 0.001, near grazing over its sine
    EXPECT_LT(difference(currents, expected, s), 0.01) << phi;
  }
}

// Backscatter across the reflection boundary at normal incidence changes by its slope times the step.
TEST(MaterialEdge, IsContinuousAcrossReflectionBoundaries) {
  const MaterialSurface absorber(read_material(SEAGLINT_SOURCE_DIR "/tests/reference/rcs/austin/magram_coating.yaml"),
                                 k10),
      laminate(sheet(4, 0.1, 1.5), k10), conductor(MaterialSpec{}, k10);
  for (const MaterialFaces& faces :
       {MaterialFaces{{&absorber, &conductor}, k10, false}, MaterialFaces{{&absorber, &absorber}, k10, false},
        MaterialFaces{{&laminate, &laminate}, k10, true}}) {
    const auto at = [&](double phi) {
      const Vec3 s = towards(phi, 1.2), h = s.cross(Vec3::UnitZ()).normalized();
      return material_edge_currents(wedge(2), faces, -s, {h, s.cross(h)}, s, kShadowBoundaryGuard);
    };
    for (double step = -4e-3; step < 4e-3; step += 1e-4) {
      const auto a = at(kPi / 2 + step), b = at(kPi / 2 + step + 1e-4);
      EXPECT_LT(norm_of(a[0] - b[0]) + norm_of(a[1] - b[1]), 1e-4) << step;
    }
  }
}

}  // namespace
}  // namespace seaglint
