// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/coefficients/wedge_diffraction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "sim/scattering/coefficients/material.h"
#include "sim/scattering/coefficients/material_edge.h"
#include "sim/scattering/points/phase_integral.h"
#include "sim/scenario/material_spec.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

// Fringe currents of convex wedges and concave edges against Keller's coefficients.

WedgeFrame wedge(double N) {
  const Vec3 x2(std::cos(N * kPi), std::sin(N * kPi), 0), t = Vec3::UnitZ();
  return {{{Vec3::UnitX(), Vec3::UnitY(), t}, {x2, (-t).cross(x2), -t}}, N};
}

// J. B. Keller, J. Opt. Soc. Am. 52 (1962) 116-130: diffraction coefficients of a wedge, soft and hard, without their
// e^{-jks} / sqrt(s).
std::pair<double, double> keller(double N, double phi, double phi_in) {
  const double a = std::sin(kPi / N) / N;
  const double minus = 1 / (std::cos(kPi / N) - std::cos((phi - phi_in) / N)),
               plus = 1 / (std::cos(kPi / N) - std::cos((phi + phi_in) / N));
  return {a * (minus - plus), a * (minus + plus)};
}

// The same of physical optics on one illuminated face: half-line integrals of 2 n x H, as given by Ufimtsev, sin phi' /
// (cos phi + cos phi') for the soft one, -sin phi for the hard one, in the same scale.
std::pair<double, double> optics(double phi, double phi_in) {
  if (phi_in >= kPi) return {0, 0};
  const double pole = std::cos(phi) + std::cos(phi_in);
  return {std::sin(phi_in) / pole, -std::sin(phi) / pole};
}

// In the plane normal to the edge the exact wedge field is Keller's: fringe current = Keller's coefficient less that of
// physical optics. A line of p . K per metre radiates K sqrt(2 pi / k) e^{-j pi/4} e^{-jk rho} / sqrt(rho) in that
// plane; Keller's coefficients contain e^{-j pi/4} / sqrt(2 pi k): K = D / 2 pi.
TEST(FringeCurrent, IsKellersCoefficientLessThatOfPhysicalOptics) {
  Random random({3, Stream::kTest, 17});
  for (int i = 0; i < 300; ++i) {
    const double N = 1.05 + 0.95 * random.uniform();
    const double phi_in = N * kPi * random.uniform(), phi = N * kPi * random.uniform();
    // Keller's coefficients are infinite at the incident and the reflection shadow boundary; near them rounding errors
    // grow.
    if (std::abs(std::abs(phi - phi_in) - kPi) < 0.05 || std::abs(phi + phi_in - kPi) < 0.05 ||
        std::abs(2 * N * kPi - phi - phi_in - kPi) < 0.05)
      continue;
    const Vec3 k_hat(-std::cos(phi_in), -std::sin(phi_in), 0), s(std::cos(phi), std::sin(phi), 0);
    const auto [soft, hard] = keller(N, phi, phi_in);
    const auto [soft_1, hard_1] = optics(phi, phi_in);
    const auto [soft_2, hard_2] = optics(N * kPi - phi, N * kPi - phi_in);
    const Vec3 z = Vec3::UnitZ();
    const Vec3 K_soft = fringe_current(wedge(N), k_hat, z, s);
    EXPECT_NEAR(std::abs(K_soft.z() - (soft - soft_1 - soft_2) / (2 * kPi)), 0, 1e-9 * (1 + std::abs(soft)))
        << N << ' ' << phi_in << ' ' << phi;
    // Hard: H along z, E = H x k; the scattered H along z is (s x E_s).
    const Vec3 K_hard = fringe_current(wedge(N), k_hat, z.cross(k_hat), s);
    const Vec3 p = z.cross(s);
    EXPECT_NEAR(std::abs(p.dot(K_hard) - (hard - hard_1 - hard_2) / (2 * kPi)), 0, 1e-9 * (1 + std::abs(hard)))
        << N << ' ' << phi_in << ' ' << phi;
  }
}

// On Keller's cone Keller's coefficients grow by 1 / sin(beta), and so does the field of a line of currents with the
// phase of cos(beta) along it: K is constant.
TEST(FringeCurrent, IsTheSameOnEveryKellerCone) {
  const double N = 1.5, phi_in = 0.8, phi = 2.9;
  const auto [soft, hard] = keller(N, phi, phi_in);
  const auto [soft_1, hard_1] = optics(phi, phi_in);
  const auto [soft_2, hard_2] = optics(N * kPi - phi, N * kPi - phi_in);
  for (const double beta : {1.5, 1.0, 0.5}) {
    const double sb = std::sin(beta), cb = std::cos(beta);
    const Vec3 k_hat(-sb * std::cos(phi_in), -sb * std::sin(phi_in), cb), s(sb * std::cos(phi), sb * std::sin(phi), cb);
    // Ray-fixed unit vectors: phi^ and beta^ = k x phi^ of either ray (Kouyoumjian and Pathak).
    const Vec3 phi_hat_in = Vec3::UnitZ().cross(k_hat).normalized(), beta_in = k_hat.cross(phi_hat_in);
    const Vec3 phi_hat = Vec3::UnitZ().cross(s).normalized(), beta_out = s.cross(phi_hat);
    // The field along the edge keeps its sign with respect to beta^ of either ray; H along the edge with respect to
    // phi^.
    const double K_soft = beta_out.dot(fringe_current(wedge(N), k_hat, beta_in, s));
    const double K_hard = phi_hat.dot(fringe_current(wedge(N), k_hat, phi_hat_in, s));
    EXPECT_NEAR(std::abs(K_soft), std::abs(soft - soft_1 - soft_2) / (2 * kPi), 1e-9) << beta;
    EXPECT_NEAR(std::abs(K_hard), std::abs(hard - hard_1 - hard_2) / (2 * kPi), 1e-9) << beta;
  }
}

// Off the cones the angle a of the grazing ray may be imaginary. Here it is complex and the cotangents are
// Sommerfeld's.
TEST(FringeCurrent, IsTheCotangentsOfAComplexAngle) {
  Random random({3, Stream::kTest, 19});
  int imaginary = 0;
  for (int i = 0; i < 2000; ++i) {
    const double N = 1.05 + 0.95 * random.uniform(), phi = N * kPi * random.uniform(),
                 beta = 0.2 + 1.2 * random.uniform();
    const Vec3 k_hat(-std::sin(beta) * std::cos(phi), -std::sin(beta) * std::sin(phi), std::cos(beta));
    const Vec3 E = k_hat.cross(Vec3(0.3, -0.5, 0.8)).normalized();
    const double z = 2 * random.uniform() - 1, angle = 2 * kPi * random.uniform();
    const Vec3 s(std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z);
    const WedgeFrame frame = wedge(N);
    CVec3 expected = CVec3::Zero();
    bool near_a_pole = false;
    for (int face = 0; face < 2; ++face) {
      const auto& [x, n, t] = frame.face[face];
      const double own = face == 0 ? phi : N * kPi - phi, sin_b = std::sin(beta), cos_b = k_hat.dot(t);
      const double mu = (sin_b * s.dot(x) + cos_b * (s.dot(t) - cos_b)) / (sin_b * sin_b);
      imaginary += mu < -1;
      const Complex a = std::acos(Complex(-mu, 0));
      near_a_pole |= std::abs(a - own) < 0.05 || std::abs(a - kPi) < 0.05 || std::abs(a) < 0.05;
      const auto currents = [&](double wedge_N) {
        const Complex minus = 1.0 / (wedge_N * std::tan((a - own) / (2 * wedge_N))),
                      plus = 1.0 / (wedge_N * std::tan((a + own) / (2 * wedge_N)));
        return std::array<Complex, 2>{0.5 * (minus + plus) / std::sin(a), 0.5 * (minus - plus)};
      };
      auto [sum, difference] = currents(N);
      const double H_t = k_hat.cross(E).dot(t), E_t = E.dot(t);
      Complex optics_along = 0;
      if (own < kPi) {
        const auto [sum_1, difference_1] = currents(1);
        sum -= sum_1;
        difference -= difference_1;
        optics_along = 2.0 * kJ * cos_b / (sin_b * sin_b) * H_t;
      }
      const Complex across = 2.0 * kJ * H_t / sin_b * sum;
      expected += -kJ / (4 * kPi) *
                  (x * across +
                   t * (2.0 * kJ * E_t / (sin_b * sin_b) * difference + cos_b / sin_b * mu * across + optics_along));
    }
    if (near_a_pole) continue;
    const Vec3 K = fringe_current(frame, k_hat, E, s);
    EXPECT_LT(norm_of(K.cast<Complex>() - expected), 1e-9 * (1 + K.norm())) << N << ' ' << phi << ' ' << beta;
  }
  EXPECT_GT(imaginary, 200);
}

// The same at a concave edge, where physical optics is the sum over all images: each face is illuminated by the
// incident wave and by the reflections of the other face, and vanishes where image theory is exact.
TEST(FringeCurrent, OfAConcaveEdgeIsKellersCoefficientLessThatOfItsImages) {
  Random random({3, Stream::kTest, 21});
  int reflected = 0;
  for (int i = 0; i < 600; ++i) {
    const double N = i % 3 == 0 ? 1.0 / (2 + i % 4) : 0.3 + 0.65 * random.uniform();
    const double phi_in = N * kPi * random.uniform(), phi = N * kPi * random.uniform();
    const Vec3 k_hat(-std::cos(phi_in), -std::sin(phi_in), 0), s(std::cos(phi), std::sin(phi), 0), z = Vec3::UnitZ();
    auto [soft, hard] = keller(N, phi, phi_in);
    bool near_a_boundary = false;
    for (const bool second : {false, true}) {
      const double out = second ? N * kPi - phi : phi, in = second ? N * kPi - phi_in : phi_in;
      for (int m = -5; m <= 5; ++m) {
        const double image = in + 2 * m * N * kPi;
        near_a_boundary |= std::abs(std::abs(image) - kPi) < 0.02 || std::abs(std::cos(out) + std::cos(image)) < 0.05;
        if (std::abs(image) > kPi) continue;
        // With each further reflection the electric field along the edge changes its sign, the magnetic one does not.
        const double pole = std::cos(out) + std::cos(image);
        soft -= std::sin(image) / pole;
        hard += std::sin(out) / pole;
        reflected += m != 0;
      }
    }
    if (near_a_boundary) continue;
    const double K_soft = fringe_current(wedge(N), k_hat, z, s).z(),
                 K_hard = z.cross(s).dot(fringe_current(wedge(N), k_hat, z.cross(k_hat), s));
    EXPECT_NEAR(K_soft, soft / (2 * kPi), 1e-9 * (1 + std::abs(soft))) << N << ' ' << phi_in << ' ' << phi;
    EXPECT_NEAR(K_hard, hard / (2 * kPi), 1e-9 * (1 + std::abs(hard))) << N << ' ' << phi_in << ' ' << phi;
    if (i % 3 != 0) continue;
    EXPECT_NEAR(K_soft, 0, 1e-9) << N;
    EXPECT_NEAR(K_hard, 0, 1e-9) << N;
  }
  EXPECT_GT(reflected, 500);
}

// A face radiates only towards receivers that see it: towards others the edge has all of Keller's field, except near
// the incident shadow boundary.
TEST(EquivalentEdgeCurrents, ExcludePhysicalOpticsOnlyOfVisibleFaces) {
  Random random({3, Stream::kTest, 20});
  int invisible = 0;
  for (int i = 0; i < 1000; ++i) {
    const double N = 1.05 + 0.95 * random.uniform();
    const double phi_in = N * kPi * random.uniform(), phi = N * kPi * random.uniform();
    const double from_shadow = std::abs(std::abs(phi - phi_in) - kPi);
    if (std::abs(from_shadow - kShadowBoundaryGuard) < 1e-3 || std::abs(phi + phi_in - kPi) < 0.05 ||
        std::abs(2 * N * kPi - phi - phi_in - kPi) < 0.05)
      continue;
    if (from_shadow < 0.05) continue;
    const Vec3 k_hat(-std::cos(phi_in), -std::sin(phi_in), 0), s(std::cos(phi), std::sin(phi), 0), z = Vec3::UnitZ();
    auto [soft, hard] = keller(N, phi, phi_in);
    for (const bool second : {false, true}) {
      const double out = second ? N * kPi - phi : phi, in = second ? N * kPi - phi_in : phi_in;
      if (in < kPi && out > kPi) ++invisible;
      if (out > kPi && from_shadow > kShadowBoundaryGuard) continue;
      const auto [soft_face, hard_face] = optics(out, in);
      soft -= soft_face;
      hard -= hard_face;
    }
    const auto [K_soft, K_hard] = equivalent_edge_currents(wedge(N), k_hat, {z, z.cross(k_hat)}, s);
    EXPECT_NEAR(K_soft.z(), soft / (2 * kPi), 1e-9 * (1 + std::abs(soft))) << N << ' ' << phi_in << ' ' << phi;
    EXPECT_NEAR(z.cross(s).dot(K_hard), hard / (2 * kPi), 1e-9 * (1 + std::abs(hard)))
        << N << ' ' << phi_in << ' ' << phi;
  }
  EXPECT_GT(invisible, 300);
}

TEST(FringeCurrent, IsFiniteEverywhereButAlongTheGrazingRay) {
  Random random({3, Stream::kTest, 18});
  for (int i = 0; i < 20000; ++i) {
    const auto any = [&] {
      const double z = 2 * random.uniform() - 1, angle = 2 * kPi * random.uniform();
      return Vec3(std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z);
    };
    const Vec3 k_hat = any();
    const Vec3 E = k_hat.cross(any()).normalized();
    // Backscatter, as in every monostatic sweep: the received component is normal to the direction.
    for (const double N : {1.2, 1.5, 2.0}) {
      const Vec3 K = fringe_current(wedge(N), k_hat, E, -k_hat);
      EXPECT_LT((K - k_hat * k_hat.dot(K)).cwiseAbs().maxCoeff(), 1)
          << N << ' ' << k_hat.x() << ' ' << k_hat.y() << ' ' << k_hat.z();
      const auto [all, again] = equivalent_edge_currents(wedge(N), k_hat, {E, E}, -k_hat);
      EXPECT_LT((all - K).norm(), 1e-12) << N << ' ' << k_hat.x() << ' ' << k_hat.y() << ' ' << k_hat.z();
    }
  }
}

// Diffraction by wedges with surface impedances: limits, reciprocity, shadow boundaries, and the solution of Wiener and
// Hopf for a plane whose impedance changes along a line.

Complex random_sine(Random& random) { return std::polar(3 * random.uniform(), 1.3 * (2 * random.uniform() - 1)); }

double off_boundaries(double phi, double phi0, double N) {
  return std::min(
      {std::abs(std::abs(phi - phi0) - kPi), std::abs(phi + phi0 - kPi), std::abs(2 * N * kPi - phi - phi0 - kPi)});
}

// J. B. Keller, J. Opt. Soc. Am. 52 (1962) 116-130, as P = -(j/2) of this form.
TEST(ImpedanceWedge, HasKellersCoefficientsAsLimits) {
  Random random({3, Stream::kTest, 41});
  for (int i = 0; i < 300; ++i) {
    const double N = 1 + random.uniform(), phi = N * kPi * random.uniform(), phi0 = N * kPi * random.uniform();
    if (off_boundaries(phi, phi0, N) < 0.05) continue;
    const double scale = std::sin(kPi / N) / N, minus = scale / (std::cos(kPi / N) - std::cos((phi - phi0) / N)),
                 plus = scale / (std::cos(kPi / N) - std::cos((phi + phi0) / N));
    const Complex soft = impedance_wedge(phi, phi0, {kSoftConductor, kSoftConductor}, N),
                  hard = impedance_wedge(phi, phi0, {0.0, 0.0}, N);
    EXPECT_LT(std::abs(soft + 0.5 * kJ * (minus - plus)), 1e-9) << N << " " << phi << " " << phi0;
    EXPECT_LT(std::abs(hard + 0.5 * kJ * (minus + plus)), 1e-9) << N << " " << phi << " " << phi0;
  }
}

TEST(ImpedanceWedge, TendsContinuouslyToPerfectConductors) {
  for (const double N : {1.3, 1.5, 2.0}) {
    const Complex hard = impedance_wedge(1, 2.4, {0.0, 0.0}, N), nearly = impedance_wedge(1, 2.4, {1e-5, 1e-5}, N);
    EXPECT_LT(std::abs(nearly - hard), 1e-3 * std::abs(hard)) << N;  // first order in sin(theta) ln sin(theta)
    const Complex soft = impedance_wedge(1, 2.4, {kSoftConductor, kSoftConductor}, N);
    EXPECT_LT(std::abs(impedance_wedge(1, 2.4, {1e5, 1e5}, N) - soft), 1e-3 * std::abs(soft)) << N;
  }
}

TEST(ImpedanceWedge, IsReciprocalAndSymmetricInItsFaces) {
  Random random({3, Stream::kTest, 42});
  for (int i = 0; i < 300; ++i) {
    const double N = 1 + random.uniform(), phi = N * kPi * random.uniform(), phi0 = N * kPi * random.uniform();
    if (off_boundaries(phi, phi0, N) < 0.05) continue;
    const Complex a = random_sine(random), b = random_sine(random);
    const Complex P = impedance_wedge(phi, phi0, {a, b}, N);
    EXPECT_LT(std::abs(P - impedance_wedge(phi0, phi, {a, b}, N)), 1e-9 * (1 + std::abs(P)));
    EXPECT_LT(std::abs(P - impedance_wedge(N * kPi - phi, N * kPi - phi0, {b, a}, N)), 1e-9 * (1 + std::abs(P)));
  }
}

// Keller's field is infinite on the shadow boundary and, times the reflection coefficient, on that of the reflection,
// as physical optics is: their ratio tends to 1 with the distance from the boundary, 1e-5.
TEST(ImpedanceWedge, HasThePolesOfPhysicalOptics) {
  Random random({3, Stream::kTest, 43});
  for (int i = 0; i < 100; ++i) {
    const double N = 1.5 + 0.5 * random.uniform(), phi0 = 0.2 + 1.1 * random.uniform(), step = 1e-5;
    const std::array sines{random_sine(random), random_sine(random)};
    const Complex R = (std::sin(phi0) - sines[0]) / (std::sin(phi0) + sines[0]);
    if (std::abs(R) < 0.05) continue;  // no pole
    for (const double phi : {kPi - phi0 + step, kPi + phi0 + step}) {
      if (phi > N * kPi - 0.1) continue;
      EXPECT_LT(std::abs(impedance_wedge(phi, phi0, sines, N) / half_plane_optics(phi, phi0, R) - 1.0), 3e-3)
          << N << " " << phi0 << " " << sines[0];
    }
  }
}

// A plane with an impedance for x > 0 and a hard surface for x < 0, by the method of Wiener and Hopf instead of
// Maliuzhinets': P = -j L(cos phi) L(cos phi0) / (cos phi + cos phi0), L(c) L(-c) = S sin phi / (S + sin phi), S =
// sin(theta), L regular for Re c < 0; ln of 1 + S / gamma factorised by its integral along the imaginary axis of c.
TEST(ImpedanceWedge, OfAFlatJunctionIsTheSolutionOfWienerAndHopf) {
  const auto factor = [](const Complex& S, double c) {
    constexpr int kSteps = 200000;
    Complex integral = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double u = std::abs(c) * std::tan((i + 0.5) / kSteps * kPi / 2);
      integral += std::log(1.0 + S / std::sqrt(1 + u * u)) / (2.0 * kSteps);
    }
    const Complex whole = std::log(1.0 + S / std::sqrt(1 - c * c));
    return std::sqrt(S) * std::exp(-(c > 0 ? whole - integral : integral));
  };
  Random random({3, Stream::kTest, 44});
  double worst = 0;
  for (int i = 0; i < 20; ++i) {
    const Complex S = random_sine(random);
    const double phi = kPi * random.uniform(), phi0 = kPi * random.uniform();
    if (std::abs(phi + phi0 - kPi) < 0.05 || std::min({phi, phi0, kPi - phi, kPi - phi0}) < 0.02) continue;
    const Complex expected =
        -kJ * factor(S, std::cos(phi)) * factor(S, std::cos(phi0)) / (std::cos(phi) + std::cos(phi0));
    const Complex P = impedance_wedge(phi, phi0, {S, 0.0}, 1);
    worst = std::max(worst, std::abs(P - expected) / std::abs(expected));
  }
  EXPECT_LT(worst, 1e-6);  // both quadratures
}

TEST(ImpedanceWedge, ReflectionCoefficientsAndSinesAreInverse) {
  Random random({3, Stream::kTest, 45});
  for (int i = 0; i < 50; ++i) {
    const Complex S = random_sine(random);
    const double sine = 0.01 + 0.99 * random.uniform();
    EXPECT_LT(std::abs(brewster_sine((sine - S) / (sine + S), sine) - S), 1e-9 * (1 + std::norm(S) / sine));
  }
  EXPECT_EQ(brewster_sine(-1, 0.5), kSoftConductor);
  EXPECT_EQ(brewster_sine(1, 0.5), 0.0);
}

// Edge currents of wedges and sheets of materials: perfect conductors and vacuum as limits, finite on shadow
// boundaries.

const double k10 = wavenumber(10e9);

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
        std::max(phi, phi0) > N * kPi - 0.02)
      continue;
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
