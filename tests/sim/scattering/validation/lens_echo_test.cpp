// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include "sim/geometry/decoy/make_decoy.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/placement/target_mesh.h"
#include "sim/geometry/placement/waterline.h"
#include "sim/scattering/radiation/lens_reflection.h"
#include "tests/refusal.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

// Echo of a Luneburg lens reflector against geometrical optics, diffraction of a circular aperture, and rays that are
// integrated through its refractive index.

// A projection of the sphere has 0.2 to 0.3 % less area than the disc: sides of 5.6 deg in both directions.
constexpr double kFacets = 0.0035;

DecoySpec lens_of(double radius, double cap_half_angle_deg = 70) {
  DecoySpec spec;
  spec.kind = DecoyKind::kLuneburgLens;
  spec.leg_m = radius;
  spec.cap_half_angle_deg = cap_half_angle_deg;
  return spec;
}

// As the mesh names them.
std::vector<MaterialSpec> materials_of(TriangleMesh& mesh) {
  const TriangleMesh before = mesh;
  std::vector<MaterialSpec> materials = assign_materials(mesh, {}, {});
  assign_own_materials(mesh, materials, before, {});
  return materials;
}

Scatterer scatterer_of(TriangleMesh mesh) {
  const std::vector<MaterialSpec> materials = materials_of(mesh);
  return Scatterer(mesh, materials);
}
Scatterer scatterer_of(const DecoySpec& spec) { return scatterer_of(make_decoy(spec)); }

// Of the part with this number alone.
TracingSettings only_part(int part) {
  TracingSettings settings;
  settings.filter.included = {{ContributionSelector::Kind::kPart, part}};
  return settings;
}

ScatteringMatrix lens_echo(const Scatterer& scatterer, const BistaticGeometry& antennas, double k,
                           TracingSettings settings = only_part(0)) {
  return scattering_matrices(scatterer, antennas, std::array{k}, settings)[0];
}

ScatteringMatrix lens_echo(const Scatterer& scatterer, const Vec3& r, double k) {
  return lens_echo(scatterer, monostatic(radar_basis(r)), k);
}

// k a^2 / 2, the amplitude of the whole disc, m.
double disc_amplitude(double k, double radius) { return 0.5 * k * radius * radius; }

TEST(LensEcho, HasThePeakOfAPlateOfTheSizeOfItsDisc) {
  for (const double radius : {0.15, 0.3})
    for (const double frequency : {9.4e9, 16e9})
      for (const SolverMethod method : {SolverMethod::kBeams, SolverMethod::kRays}) {
        if (method == SolverMethod::kRays && (radius == 0.3 || frequency == 16e9)) continue;
        const Scatterer lens = scatterer_of(lens_of(radius));
        const double k = wavenumber(frequency), wavelength = kSpeedOfLight / frequency,
                     peak = 4 * std::pow(kPi, 3) * std::pow(radius, 4) / (wavelength * wavelength);
        for (const Vec3& r : {direction(0, 0), direction(12, 0), direction(-5, 15)}) {
          const double off_axis = std::acos(r.x()), on_cap = focal_spot_on_cap(k * radius * (radians(70) - off_axis));
          TracingSettings settings;
          settings.edges = true;
          settings.method = method;
          const ScatteringMatrix s = lens_echo(lens, monostatic(radar_basis(r)), k, settings);
          const double rcs = 4 * kPi * std::norm(s[kVvChannel]) / (on_cap * on_cap);
          EXPECT_LT(rcs, peak * (1 + 1e-9));
          EXPECT_GT(rcs, peak * (1 - 2 * kFacets));
          EXPECT_LT(std::abs(s[kHhChannel] - s[kVvChannel]), 1e-12 * std::abs(s[kVvChannel]));
          EXPECT_LT(std::abs(s[kHvChannel]) + std::abs(s[kVhChannel]), 1e-12 * std::abs(s[kVvChannel]));
        }
        if (method == SolverMethod::kBeams)
          fmt::print("radius {} m, {} GHz: {:.2f} dBsm, 4 pi^3 a^4 / lambda^2 {:.2f} dBsm\n", radius, 1e-9 * frequency,
                     dbsm(lens_echo(lens, direction(0, 0), k)[kVvChannel]), dbsm_of_area(peak));
      }
}

// Ray through a lens of radius 1 about the origin, x' = p, p' = grad (n^2 / 2) = -x with the parameter d tau = ds / n
// (M. Born and E. Wolf, Principles of Optics, 7th ed., eq. 3.2.2), by Runge and Kutta.
struct Ray {
  Vec3 x, p;
  double path = 0;  // integral of n ds = integral of n^2 d tau

  void step(double dt) {
    const auto square = [](const Vec3& at) { return 2 - at.squaredNorm(); };
    const Vec3 x1 = p, p1 = -x, x2 = p + 0.5 * dt * p1, p2 = -(x + 0.5 * dt * x1), x3 = p + 0.5 * dt * p2,
               p3 = -(x + 0.5 * dt * x2), x4 = p + dt * p3, p4 = -(x + dt * x3);
    path += dt / 6 * (square(x) + 2 * square(x + 0.5 * dt * x1) + 2 * square(x + 0.5 * dt * x2) + square(x + dt * x3));
    x += dt / 6 * (x1 + 2 * x2 + 2 * x3 + x4);
    p += dt / 6 * (p1 + 2 * p2 + 2 * p3 + p4);
  }
  // Up to the next point on the sphere.
  void cross_the_lens() {
    double dt = 1e-3;
    step(dt);
    while (dt > 1e-10) {
      Ray further = *this;
      further.step(dt);
      if (further.x.norm() < 1)
        *this = further;
      else
        dt *= 0.5;
    }
  }
};

// Error of the integration: steps of 1e-3 with an error of the fourth order, and the last step of 1e-10. Rays near the
// rim pass the lens along its surface.
constexpr double kOfRays = 1e-8;

TEST(LensEcho, HasThePathOfRaysThroughTheLensThatLeaveMirroredInItsCentre) {
  const Vec3 r = direction(20, 10);
  const RadarBasis basis = radar_basis(r);
  double path = 0;
  for (const double offset : {0.0, 0.1, 0.4, 0.7, 0.9, 0.99}) {
    const Vec3 across = offset * (0.6 * basis.h - 0.8 * basis.v);
    Ray ray{across + std::sqrt(1 - offset * offset) * r, -r};
    ray.path = -ray.x.dot(r);
    ray.cross_the_lens();
    EXPECT_LT((ray.x + r).norm(), kOfRays);
    ray.p = reflect_direction(ray.p, r);
    ray.cross_the_lens();
    EXPECT_LT((ray.x - r * r.dot(ray.x) + across).norm(), kOfRays) << offset;
    EXPECT_LT((ray.p - r).norm(), kOfRays);
    ray.path -= ray.x.dot(r);
    EXPECT_NEAR(ray.path, kPi, kOfRays);
    path = ray.path;
  }
  const double radius = 0.25;
  for (const double frequency : {9.4e9, 16e9})
    for (const Vec3& moved : {Vec3(0, 0, 0), Vec3(3.1, -2.2, 0.7)}) {
      const double k = wavenumber(frequency);
      const Scatterer lens = scatterer_of(transformed(make_decoy(lens_of(radius)), Mat3::Identity(), moved));
      const Complex expected = kJ * std::polar(1.0, k * (2 * r.dot(moved) - radius * path));
      EXPECT_NEAR(std::arg(lens_echo(lens, r, k)[kVvChannel] / expected), 0, 1e-6) << frequency;
    }
}

// Scalar wave about the axis of a lens with a cap on which it vanishes, in wavelengths: (laplacian + k^2 n^2) u = 0 for
// the incident wave e^{jkz} from the front, by finite differences of second order on a grid of rho and z inside a
// perfectly matched layer (J.-P. Berenger, J. Comput. Phys. 114, 1994, 185-200, as complex coordinates). It
// vanishes on the cap as the tangential electric field does; a disc has S = -jkA / 2 pi.
class ScalarLens {
 public:
  ScalarLens(double radius, double cap_half_angle, int per_wavelength)
      : step_(1.0 / per_wavelength), edge_(radius + 0.75), nr_(static_cast<int>(edge_ / step_) + per_wavelength) {
    for (int j = 0; j < 2 * nr_; ++j)
      for (int i = 0; i < nr_; ++i) {
        const double rho = (i + 0.5) * step_, z = (j + 0.5 - nr_) * step_, r = std::hypot(rho, z);
        n_squared_.push_back(r < radius ? 2 - r * r / (radius * radius) : 1);
        on_cap_.push_back(r >= radius && r < radius + 1.5 * step_ && std::atan2(rho, -z) < cap_half_angle);
        incident_.push_back(std::polar(1.0, kWave * z));
      }
  }

  // Backscattering amplitude, in wavelengths: the sources (laplacian + k^2) u of the scattered wave radiate in free
  // space.
  Complex amplitude() const {
    const std::vector<Complex> u = scattered();
    Complex sum = 0;
    for (int j = 1; j + 1 < 2 * nr_; ++j)
      for (int i = 0; i + 1 < nr_; ++i) {
        const double rho = (i + 0.5) * step_, z = (j + 0.5 - nr_) * step_;
        if (rho > edge_ - 0.1 || std::abs(z) > edge_ - 0.1) continue;
        const auto [inner, outer, behind, ahead] = couplings(i, j);
        const std::size_t p = at(i, j), n = static_cast<std::size_t>(nr_);
        const Complex source = (k_squared() - inner - outer - behind - ahead) * u[p] + (i > 0 ? inner * u[p - 1] : 0) +
                               outer * u[p + 1] + behind * u[p - n] + ahead * u[p + n];
        sum -= source * std::polar(0.5 * rho * step_ * step_, kWave * z);
      }
    return sum;
  }

 private:
  static constexpr double kWave = 2 * kPi, kAbsorption = 6;

  std::size_t at(int i, int j) const { return static_cast<std::size_t>(j) * static_cast<std::size_t>(nr_) + i; }
  // Of a wave along an axis of the grid.
  double k_squared() const { return std::pow(2 / step_ * std::sin(0.5 * kWave * step_), 2); }
  Complex stretch(double x) const {
    const double depth = std::max(0.0, std::abs(x) - edge_);
    return {1, -kAbsorption * depth * depth};
  }
  Complex stretched(double x) const { return {x, -kAbsorption / 3 * std::pow(std::max(0.0, x - edge_), 3)}; }
  // Of a node with its neighbours at rho -+ step, z -+ step.
  std::array<Complex, 4> couplings(int i, int j) const {
    const double rho = (i + 0.5) * step_, z = (j + 0.5 - nr_) * step_, h = 0.5 * step_, area = step_ * step_;
    const auto radial = [&](double face) {
      return stretched(face) / (stretch(face) * stretched(rho) * stretch(rho) * area);
    };
    const auto axial = [&](double face) { return 1.0 / (stretch(face) * stretch(z) * area); };
    return {radial(rho - h), radial(rho + h), axial(z - h), axial(z + h)};
  }
  // By elimination within the band of one row of nodes.
  std::vector<Complex> scattered() const {
    const std::size_t band = static_cast<std::size_t>(nr_), count = n_squared_.size(), width = band + 1;
    std::vector<Complex> u(count), upper(count * width);
    for (std::size_t p = 0; p < count; ++p) {
      std::vector<Complex> row(2 * band + 1, 0.0);
      const int i = static_cast<int>(p % band), j = static_cast<int>(p / band);
      row[band] = 1;
      u[p] = -incident_[p];
      if (!on_cap_[p]) {
        const auto [inner, outer, behind, ahead] = couplings(i, j);
        row[band] = k_squared() * n_squared_[p] - inner - outer - behind - ahead;
        if (i > 0) row[band - 1] = inner;
        if (i + 1 < nr_) row[band + 1] = outer;
        row[0] = behind;
        row[2 * band] = ahead;
        u[p] = -k_squared() * (n_squared_[p] - 1) * incident_[p];
      }
      for (std::size_t q = p > band ? p - band : 0; q < p; ++q) {
        Complex* const from = &row[band - (p - q)];
        if (*from == 0.0) continue;
        const Complex* const pivot = &upper[q * width];
        const Complex factor = *from / *pivot;
        for (std::size_t t = 0; t < width; ++t)
          from[t] -= Complex(factor.real() * pivot[t].real() - factor.imag() * pivot[t].imag(),
                             factor.real() * pivot[t].imag() + factor.imag() * pivot[t].real());
        u[p] -= factor * u[q];
      }
      std::copy_n(row.begin() + static_cast<std::ptrdiff_t>(band), width,
                  upper.begin() + static_cast<std::ptrdiff_t>(p * width));
    }
    for (std::size_t p = count; p-- > 0;) {
      for (std::size_t t = 1; t < width && p + t < count; ++t) u[p] -= upper[p * width + t] * u[p + t];
      u[p] /= upper[p * width];
    }
    return u;
  }

  double step_, edge_;
  int nr_;
  std::vector<double> n_squared_;
  std::vector<char> on_cap_;
  std::vector<Complex> incident_;
};

// Amplitude, path and sign. Geometrical optics neglects terms of the relative order 1 / (ka): diffraction at the rim of
// the cap, which adds in phase on the axis, and the curvature of the cap under the focal spot. The cap of the grid is a
// staircase, with an error of the first order of the step, the differences have one of the second: both are
// extrapolated.
TEST(LensEcho, OnItsAxisIsThatOfAScalarFullWaveSolution) {
  const double radius = 3, ka = 2 * kPi * radius;
  const std::array<double, 3> step{1.0 / 16, 1.0 / 24, 1.0 / 32};
  Complex extrapolated = 0;
  for (std::size_t n = 0; n < 3; ++n) {
    const double a = step[(n + 1) % 3], b = step[(n + 2) % 3];
    extrapolated += a * b / ((step[n] - a) * (step[n] - b)) *
                    ScalarLens(radius, radians(70), static_cast<int>(std::lround(1 / step[n]))).amplitude();
  }
  const Complex ratio = extrapolated / lens_echo(scatterer_of(lens_of(radius)), Vec3::UnitX(), 2 * kPi)[kVvChannel];
  EXPECT_LT(std::abs(ratio - 1.0), 4 / ka);
  fmt::print("scalar wave over the echo of a lens of 3 wavelengths: {:.2f} dB, {:.2f} rad\n",
             20 * std::log10(std::abs(ratio)), std::arg(ratio));
}

// A trihedron returns the field of three reflections, E' = -E of each as a whole; a plate that of one.
TEST(LensEcho, HasTheSignOfATrihedronAndTheOppositeOfAPlate) {
  const double k = wavenumber(16e9);
  const Vec3 boresight = Vec3(1, 1, 1).normalized();
  const Scatterer trihedron(make_triangular_trihedral(0.5)), plate(make_plate(0.3, 0.3));
  TracingSettings three;
  three.filter.included = {{ContributionSelector::Kind::kBounces, 3}};
  const Complex of_trihedron = lens_echo(trihedron, monostatic(radar_basis(boresight)), k, three)[kHhChannel],
                of_plate = lens_echo(plate, monostatic(radar_basis(Vec3::UnitX())), k, {})[kHhChannel],
                of_lens = std::polar(1.0, k * kPi * 0.25) *
                          lens_echo(scatterer_of(lens_of(0.25)), Vec3::UnitX(), k)[kHhChannel];
  EXPECT_NEAR(std::arg(of_lens / of_trihedron), 0, 0.01);
  EXPECT_NEAR(std::arg(-of_lens / of_plate), 0, 0.01);
}

// Rays enter and leave beside a hemispherical cap: the disc less two lunes, an ellipse of the half axes a, a cos theta.
TEST(LensEcho, OfAHemisphericalCapFallsWithTheCosineOfTheLookAngle) {
  const double radius = 0.3, k = wavenumber(16e9);
  const Scatterer lens = scatterer_of(lens_of(radius, 90));
  for (const double angle_deg : {0.0, 10.0, 30.0, 50.0, 65.0}) {
    const double on_cap = focal_spot_on_cap(k * radius * radians(90 - angle_deg)),
                 found = std::abs(lens_echo(lens, direction(angle_deg, 0), k)[kVvChannel]) /
                         (on_cap * disc_amplitude(k, radius)),
                 expected = std::cos(radians(angle_deg));
    // Both borders of the ellipse are polygons.
    EXPECT_NEAR(found, expected, 2 * kFacets) << angle_deg;
    fmt::print("hemispherical cap, {:.0f} deg off the axis: {:.4f} of the disc, cosine {:.4f}\n", angle_deg, found,
               expected);
  }
}

TEST(LensEcho, FallsBySixDecibelsWhereTheFocusIsOnTheRimOfTheCap) {
  const double radius = 0.3, k = wavenumber(10e9);
  const Scatterer lens = scatterer_of(lens_of(radius, 30));
  const auto level = [&](double angle_deg) {
    return std::abs(lens_echo(lens, direction(angle_deg, 0), k)[kVvChannel]) / disc_amplitude(k, radius);
  };
  EXPECT_NEAR(level(30), 0.5, 0.5 * kFacets);
  EXPECT_NEAR(level(0), 1 - 2 / (kPi * kPi * k * radius * radians(30)), 2 * kFacets);
  double before = 1;
  for (const double angle_deg : {24.0, 27.0, 29.0, 30.0, 31.0, 33.0, 36.0}) {
    EXPECT_LT(level(angle_deg), before);
    before = level(angle_deg);
    fmt::print("cap of 30 deg, 20 wavelengths, {:.0f} deg off the axis: {:.2f} dB\n", angle_deg,
               20 * std::log10(before));
  }
}

// The Airy pattern summed over one side of a line: its strips parallel to the line, up to a distance beyond which 2 /
// (pi^2 u) of the power is left.
TEST(FocalSpot, OnTheCapIsTheAiryPatternOnOneSideOfTheRim) {
  constexpr double kStep = 0.05, kReach = 40;
  const auto airy = [](double u) { return u < 1e-9 ? 1.0 : std::pow(2 * std::cyl_bessel_j(1.0, u) / u, 2); };
  double strip_sum = 0;
  std::vector<double> beyond;  // power between the distance and kReach
  for (double x = kReach - 0.5 * kStep; x > 0; x -= kStep) {
    double strip = 0;
    for (double y = 0.5 * kStep; y < kReach; y += kStep) strip += 2 * airy(std::hypot(x, y)) * kStep * kStep;
    beyond.push_back(strip_sum += strip);
  }
  // The integral of the Airy pattern over the plane is 4 pi; the corners outside the square have less than what the
  // four half-planes beyond its sides have.
  const double left = 2 / (kPi * kPi * kReach);
  for (const double u : {0.0, 0.5, 1.0, 2.0, 5.0, 10.0}) {
    const auto strips = static_cast<std::size_t>(std::lround((kReach - u) / kStep));
    const double outside = beyond[strips - 1] / (4 * kPi) + left;
    EXPECT_NEAR(1 - focal_spot_on_cap(u), outside, left);
    EXPECT_NEAR(focal_spot_on_cap(u) + focal_spot_on_cap(-u), 1, 1e-12);
  }
  EXPECT_NEAR(focal_spot_on_cap(0), 0.5, 1e-12);
  EXPECT_NEAR(focal_spot_on_cap(99.999), focal_spot_on_cap(100), 3e-5);
}

TEST(LensEcho, HasTheBistaticPatternOfACircularAperture) {
  const double radius = 0.3, k = wavenumber(10e9), ka = k * radius;
  const Scatterer lens = scatterer_of(lens_of(radius, 90));
  double worst = 0;
  for (const double u : {0.5, 1.5, 3.0, 3.8317, 5.1, 7.0156, 8.4}) {
    const double angle = std::asin(u / ka);
    const RadarBasis transmit = radar_basis(direction(0, 3)),
                     receive = radar_basis(axis_rotation(angle, Vec3(0.3, 0.5, 0.8).cross(transmit.r).normalized()) *
                                           transmit.r);
    const double on_cap = focal_spot_on_cap(ka * 0.5 * kPi);
    const Complex found = lens_echo(lens, bistatic(transmit, receive), k)[kVvChannel] /
                          (kJ * std::polar(1.0, -k * kPi * radius) * on_cap * disc_amplitude(k, radius));
    const double expected = 2 * std::cyl_bessel_j(1.0, u) / u;
    worst = std::max(worst, std::abs(found - expected));
  }
  // Facets; basis vectors of the two directions, and the half lune that the receiver does not see: 8.4 / ka squared.
  EXPECT_LT(worst, kFacets + std::pow(8.4 / ka, 2) * 0.25);
  fmt::print("bistatic pattern: {:.4f} from 2 J1(u) / u\n", worst);
}

TEST(LensEcho, IsReciprocalForEverySenseOfThePath) {
  const double k = wavenumber(10e9);
  const Scatterer lens = scatterer_of(lens_of(0.3, 50));
  const RadarBasis a = radar_basis(direction(20, 0)), b = radar_basis(direction(22, 4));
  const auto one_way = one_way_matrices(lens, std::array{bistatic(a, b), bistatic(b, a)}, std::array{k}, only_part(0));
  const ScatteringMatrix &there = one_way[0][0], &back = one_way[1][0];
  for (const auto& [i, j] : {std::pair{0, 0}, {1, 2}, {2, 1}, {3, 3}})
    EXPECT_LT(std::abs(there[i] - back[j]), kFacets * disc_amplitude(k, 0.3));
}

// A plate before a part of the disc also covers the exits of the rays that enter opposite to it.
TEST(LensEcho, LosesTheShadowOfAPlateAndItsMirrorImage) {
  const double radius = 0.3, k = wavenumber(10e9), whole = disc_amplitude(k, radius);
  const auto behind_plate = [&](const Vec3& middle, double length) {
    TriangleMesh mesh = make_decoy(lens_of(radius));
    mesh.append(transformed(make_plate(length, length), Mat3::Identity(), middle));
    return std::abs(lens_echo(scatterer_of(mesh), Vec3::UnitX(), k)[kVvChannel]) /
           (whole * focal_spot_on_cap(k * radius * radians(70)));
  };
  EXPECT_NEAR(behind_plate({1, 0.5, 0.5}, 1), 0.5, kFacets);  // a quarter of the disc
  EXPECT_NEAR(behind_plate({1, 0.5, 0}, 1), 0, kFacets);      // half of it
  EXPECT_NEAR(behind_plate({1, 0.9, 0}, 1), 1, kFacets);      // nothing
  EXPECT_NEAR(behind_plate({-1, 0.5, 0.5}, 1), 1, kFacets);   // behind the lens
}

TEST(LensEcho, OfALensInTheWaterIsThatOfTheStripWhoseMirrorImageIsAboveIt) {
  const double radius = 0.3, k = wavenumber(10e9), whole = disc_amplitude(k, radius);
  for (const double height : {-0.15, 0.0}) {
    TriangleMesh cut = make_decoy(lens_of(radius));
    const TriangleMesh above = above_water(cut, height).mesh;
    std::vector<MaterialSpec> materials = materials_of(cut);
    cut_at_sea_level(cut, materials, height);
    const double h = std::abs(height),
                 strip = 2 * (h * std::sqrt(radius * radius - h * h) + radius * radius * std::asin(h / radius)),
                 expected = strip / (kPi * radius * radius) * focal_spot_on_cap(k * radius * radians(70));
    for (const Scatterer& lens : {Scatterer(cut, materials), scatterer_of(above)})
      EXPECT_NEAR(std::abs(lens_echo(lens, Vec3::UnitX(), k)[kVvChannel]) / whole, expected, 2 * kFacets) << height;
  }
}

TEST(LensEcho, TurnsAndGrowsWithItsMesh) {
  const double k = wavenumber(10e9);
  const Vec3 r = direction(25, 5);
  const TriangleMesh mesh = make_decoy(lens_of(0.2));
  const Complex one = lens_echo(scatterer_of(mesh), r, k)[kVvChannel];
  const Mat3 turn = axis_rotation(1.1, Vec3(0.2, 0.4, 0.9).normalized());
  const Complex turned = lens_echo(scatterer_of(transformed(mesh, turn, Vec3::Zero())), turn * r, k)[kVvChannel];
  EXPECT_LT(std::abs(turned - one), 1e-6 * std::abs(one));
  const Complex larger = lens_echo(scatterer_of(enlarged(mesh, 2)), r, 0.5 * k)[kVvChannel];
  EXPECT_LT(std::abs(larger - 2.0 * one), 1e-9 * std::abs(one));
}

// The elevation of its axis, and its loss.
TEST(LensEcho, FollowsItsParameters) {
  const double k = wavenumber(10e9);
  DecoySpec spec = lens_of(0.2, 40);
  spec.boresight_elevation_deg = 30;
  const double raised = std::abs(lens_echo(scatterer_of(spec), direction(0, 50), k)[kVvChannel]),
               level = std::abs(lens_echo(scatterer_of(lens_of(0.2, 40)), direction(0, 20), k)[kVvChannel]);
  EXPECT_NEAR(raised, level, kFacets * level);
  spec.lens_loss_db = 1.5;
  const double lossy = std::abs(lens_echo(scatterer_of(spec), direction(0, 50), k)[kVvChannel]);
  EXPECT_NEAR(20 * std::log10(lossy / raised), -1.5, 1e-9);
}

TEST(LensEcho, OfAFileIsThatOfItsMesh) {
  const double k = wavenumber(10e9);
  const Vec3 r = direction(10, 5);
  DecoySpec spec = lens_of(0.2);
  spec.lens_loss_db = 0.75;
  const Complex expected = lens_echo(scatterer_of(spec), r, k)[kVvChannel];
  for (const char* ending : {".glb", ".gltf"}) {
    const std::filesystem::path path =
        std::filesystem::path(testing::TempDir()) / (std::string("seaglint_lens") + ending);
    write_mesh(path, make_decoy(spec));
    TargetSource source;
    source.mesh = path;
    const TargetMesh target = load_target_mesh(source);
    std::filesystem::remove(path);
    const Complex found = lens_echo(Scatterer(target.mesh, target.materials), r, k)[kVvChannel];
    EXPECT_LT(std::abs(found - expected), 1e-4 * std::abs(expected)) << ending;
  }
}

// Over a band and over a change of the look direction, near the rim, where the pattern depends on both.
TEST(LensEcho, OfASweepAndOfFrozenPointsIsThatOfSingleViews) {
  TriangleMesh mesh = make_decoy(lens_of(0.2, 30));
  mesh.append(transformed(make_decoy(lens_of(0.15, 30)), Mat3::Identity(), {0.5, 6, 1}));
  const Scatterer lenses = scatterer_of(mesh);
  const RadarBasis basis = radar_basis(direction(25, 0));
  std::vector<double> wavenumbers;
  for (int i = 0; i < 40; ++i) wavenumbers.push_back(wavenumber(9.5e9 + 25e6 * i));
  const Matrices sweep = scattering_matrices(lenses, monostatic(basis), wavenumbers, {});
  const double size = disc_amplitude(wavenumbers[0], 0.2);
  for (const std::size_t q : {0u, 13u, 39u})
    EXPECT_LT(std::abs(sweep[q][0] - lens_echo(lenses, monostatic(basis), wavenumbers[q], {})[0]), 1e-3 * size);

  const double turn = 1e-3, k = wavenumbers[0];
  const std::vector<Point> points = points_of(lenses, monostatic(basis), k, turn, {}).points;
  const Vec3 r = (basis.r + turn * basis.h).normalized();
  // The pattern falls by 0.3 per deg at the rim.
  EXPECT_LT(std::abs(direct_sum(points, k, r - basis.r)[3] - lens_echo(lenses, monostatic(radar_basis(r)), k, {})[3]),
            0.02 * size);
}

TEST(LuneburgLenses, AreFoundWithTheirSphereAxisAndCap) {
  DecoySpec spec = lens_of(0.3, 65);
  spec.boresight_elevation_deg = 20;
  TriangleMesh mesh = make_decoy(spec);
  mesh.append(transformed(make_decoy(lens_of(0.1, 90)), Mat3::Identity(), {0, 2, 0}));
  const Scatterer scatterer = scatterer_of(mesh);
  const std::vector<LuneburgLens> lenses = luneburg_lenses(scatterer);
  ASSERT_EQ(lenses.size(), 2u);
  constexpr double kRounding = 1e-9;
  EXPECT_LT((lenses[0].centre + scatterer.centre()).norm(), kRounding);
  EXPECT_NEAR(lenses[0].radius, 0.3, kRounding);
  EXPECT_LT((lenses[0].axis - direction(0, 20)).norm(), 1e-7);
  EXPECT_NEAR(lenses[0].cap_half_angle, radians(65), kRounding);
  EXPECT_LT((lenses[1].centre + scatterer.centre() - Vec3(0, 2, 0)).norm(), kRounding);
  EXPECT_LT((lenses[1].axis - Vec3::UnitX()).norm(), 1e-7);
  EXPECT_NEAR(lenses[1].cap_half_angle, 0.5 * kPi, kRounding);
  // A flat surface is no lens.
  TriangleMesh sheet = cut_plate(1, 1, 4);
  sheet.materials = {{"pec"}, {lens_material_name(0)}};
  sheet.triangle_material[0] = 1;
  EXPECT_HAS(refusal_of([&] { luneburg_lenses(scatterer_of(sheet)); }), "off a sphere");
  // Without a cap nothing returns.
  TriangleMesh bare = make_decoy(spec);
  for (std::uint16_t& material : bare.triangle_material) material = 0;
  EXPECT_TRUE(luneburg_lenses(scatterer_of(bare)).empty());
}

}  // namespace
}  // namespace seaglint
