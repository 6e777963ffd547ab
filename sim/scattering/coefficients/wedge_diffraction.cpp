// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/coefficients/wedge_diffraction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "sim/core/numbers/constants.h"
#include "sim/scattering/geometry/look_basis.h"

namespace seaglint {

namespace {

// sum: half of G(a - phi) + G(a + phi), over sin a; difference: half of G(a - phi) - G(a + phi); G(y) = cot(y / 2N) / N
// less cot(y / 2) for every wave of physical optics.
struct Cotangents {
  double sum, difference;
};

// Incidence angles on a face of the waves of physical optics: phi and, for N < 1, those of the reflections between the
// faces. Images of the source are at phi + 2 N pi m; those within pi of the face illuminate it, a negative angle
// standing for an odd number of reflections.
class FaceIncidenceAngles {
 public:
  FaceIncidenceAngles(double phi, double N) {
    const double round = 2 * N * kPi;
    for (double angle = phi - round * std::floor((phi + kPi) / round); angle < kPi && count_ < kMax; angle += round) {
      if (angle > -kPi) angle_[count_++] = angle;
    }
  }
  FaceIncidenceAngles() = default;  // empty

  const double* begin() const { return angle_.data(); }
  const double* end() const { return angle_.data() + count_; }
  int size() const { return count_; }

 private:
  static constexpr int kMax = 16;  // 1 / N + 1 for N = kMinWedgeIndex
  std::array<double, kMax> angle_{};
  int count_ = 0;
};

// cot(x / 2N) / N at x = a - sign phi, less cot((a - sign angle) / 2) for each wave of physical optics; regular where
// one of these arguments is 0.
double half_cotangent(double a, double phi, double N, const FaceIncidenceAngles& optics, double sign) {
  const double x = a - sign * phi;
  double sum = 0;
  bool wedge = true;
  for (const double angle : optics) {
    const double y = a - sign * angle;
    const bool at_pole = std::abs(y) < 1e-3;
    sum += at_pole ? y / 6 * (1 - 1 / (N * N)) : -1 / std::tan(y / 2);
    wedge = wedge && !at_pole;
  }
  return wedge ? sum + 1 / (N * std::tan(x / (2 * N))) : sum;
}

Cotangents cotangents(double a, double phi, double N, const FaceIncidenceAngles& optics) {
  const double minus = half_cotangent(a, phi, N, optics, 1), plus = half_cotangent(a, phi, N, optics, -1);
  return {0.5 * (minus + plus) / std::sin(a), 0.5 * (minus - plus)};
}

// The same for imaginary a = j alpha, alpha > 0: the sum is sin(a / N) / sin a, the difference sin(phi / N), each over
// N (cos(phi / N) - cos(a / N)).
Cotangents cotangents_of_imaginary(double alpha, double phi, double N, const FaceIncidenceAngles& optics) {
  const auto of_wedge = [&](double n, double angle) {
    const double pole = n * (std::cos(angle / n) - std::cosh(alpha / n));
    return Cotangents{std::sinh(alpha / n) / (std::sinh(alpha) * pole), std::sin(angle / n) / pole};
  };
  Cotangents sum{0, 0};
  bool wedge = true;
  const auto add = [&](double factor, const Cotangents& c) {
    sum = {sum.sum + factor * c.sum, sum.difference + factor * c.difference};
  };
  for (const double angle : optics) {
    // Near the common pole at 0 the first term of the difference is used, with an error of 1e-6.
    const bool at_pole = angle * angle + alpha * alpha < 4e-5;
    const double rest = (1 - 1 / (N * N)) / 6;
    if (at_pole)
      add(1, {rest, -angle * rest});
    else
      add(-1, of_wedge(1, angle));
    wedge = wedge && !at_pole;
  }
  if (wedge) add(1, of_wedge(N, phi));
  return sum;
}

// Angle of the direction from the face, in the plane normal to the edge, 0..2 pi.
double angle_from_face(const WedgeFace& face, const Vec3& towards_source) {
  const double angle = std::atan2(towards_source.dot(face.n), towards_source.dot(face.x));
  return angle < 0 ? angle + 2 * kPi : angle;
}

// Incident waves along k_hat with these electric fields, observed along s. `shadow`: angle about a shadow boundary,
// rad.
struct Diffraction {
  const Vec3& k_hat;
  std::span<const Vec3> fields;
  const Vec3& s;
  bool only_visible;  // physical optics is subtracted on faces that s sees only
  double shadow;
};

// Adds the integrals of eta k J / 2j over one face along the grazing diffracted ray (Michaeli 1984 and 1986; his alpha
// is pi - a here). At a distance x from the edge Sommerfeld's wedge currents are contour integrals of e^{jkx cos xi}
// with the cotangents of (xi +- phi') / 2N. Weighted with e^{jkx mu} and integrated over the half-line in x they become
// 1 / (cos xi + mu), whose pole at cos a = -mu leaves the cotangents at a +- phi' over sin a. The current of physical
// optics, N = 1, is subtracted, with `only_visible` on faces that s sees only.
void add_face_current(const WedgeFace& face, double N, double phi, const Diffraction& of, std::span<Vec3> sums) {
  const auto& [k_hat, fields, s, only_visible, shadow] = of;
  const double cos_b = k_hat.dot(face.t);
  const double sin_b = std::sqrt(std::max(1 - cos_b * cos_b, 1e-12));
  const double mu = (sin_b * s.dot(face.x) + cos_b * (s.dot(face.t) - cos_b)) / (sin_b * sin_b);
  // cos a = -mu; mu <= 1 for real directions, and a is imaginary for mu < -1. The singularities at a = 0 and pi are
  // removable, at pi only in the component of the current normal to s: a is kept off both.
  const bool real = mu >= -1;
  const double a = real ? std::clamp(std::acos(std::clamp(-mu, -1.0, 1.0)), kInPlaneAngle, kPi - kInPlaneAngle)
                        : std::max(std::acosh(-mu), kInPlaneAngle);
  const bool in_shadow_boundary = (real ? std::abs(a - phi) : std::hypot(a, phi)) < shadow;
  const FaceIncidenceAngles optics = !only_visible || in_shadow_boundary || s.dot(face.n) > kEdgeOn
                                         ? FaceIncidenceAngles(phi, N)
                                         : FaceIncidenceAngles();
  const Cotangents cot = real ? cotangents(a, phi, N, optics) : cotangents_of_imaginary(a, phi, N, optics);
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const double H_t = k_hat.cross(fields[i]).dot(face.t), E_t = fields[i].dot(face.t);
    const double across = H_t / sin_b * cot.sum;
    double along = E_t / (sin_b * sin_b) * cot.difference + cos_b / sin_b * mu * across;
    // Part of physical optics in the current along the edge, written without its pole.
    along += optics.size() * cos_b / sin_b * H_t / sin_b;
    sums[i] += across * face.x + along * face.t;
  }
}

void add_currents(const WedgeFrame& wedge, const Diffraction& of, std::span<Vec3> sums) {
  const double phi = angle_from_face(wedge.face[0], -of.k_hat);
  if (phi > wedge.N * kPi) return;
  for (int i = 0; i < 2; ++i) add_face_current(wedge.face[i], wedge.N, i == 0 ? phi : wedge.N * kPi - phi, of, sums);
  // E_s = -(jk eta / 4 pi) (e^{-jkr}/r) integral J e^{jk s.x}; the integrals above are those of eta k J / 2j.
  for (Vec3& sum : sums) sum /= 2 * kPi;
}

// Of the image angles +-phi + 2 N pi m the one nearest to pi.
double image_angle_nearest_grazing(double phi, double N) {
  const double round = 2 * N * kPi;
  const double plus = phi + round * std::round((kPi - phi) / round),
               minus = -phi + round * std::round((kPi + phi) / round);
  return std::abs(kPi - plus) < std::abs(kPi - minus) ? plus : minus;
}

}  // namespace

Vec3 fringe_current(const WedgeFrame& wedge, const Vec3& k_hat, const Vec3& E, const Vec3& s) {
  Vec3 sum = Vec3::Zero();
  add_currents(wedge, {k_hat, {&E, 1}, s, false, kShadowBoundaryGuard}, {&sum, 1});
  return sum;
}

std::array<Vec3, 2> equivalent_edge_currents(const WedgeFrame& wedge, const Vec3& k_hat,
                                             const std::array<Vec3, 2>& fields, const Vec3& s, double shadow) {
  std::array<Vec3, 2> sums{Vec3::Zero(), Vec3::Zero()};
  add_currents(wedge, {k_hat, fields, s, true, shadow}, sums);
  return sums;
}

GrazingDiffractedWave grazing_diffracted_wave(const WedgeFrame& wedge, int face, const Vec3& k_hat,
                                              const std::array<Vec3, 2>& fields) {
  const WedgeFace& f = wedge.face[face];
  const double N = wedge.N;
  const double cos_b = k_hat.dot(f.t);
  const double sin_b = std::sqrt(std::max(1 - cos_b * cos_b, 1e-12));
  double phi = angle_from_face(f, -k_hat);
  GrazingDiffractedWave wave{sin_b * f.x + cos_b * f.t, {}};
  if (phi > N * kPi) return wave;
  // Of the waves incident on the face, for N < 1 via both faces, the one nearest to grazing has the pole.
  const double image = N < 1 ? image_angle_nearest_grazing(phi, N) : phi;
  // In the plane of a face the grazing wave is infinite and its transition function zero; their product has a limit:
  // both are evaluated kInPlaneAngle off the plane.
  const double off = std::copysign(std::max(std::abs(kPi - image), kInPlaneAngle), kPi - image);
  phi = kPi - off;
  wave.launch_parameter = std::pow(sin_b * std::sin(off / 2), 2);
  const Complex D = std::polar(1.0, -kPi / 4) * std::sin(kPi / N) / (N * std::sqrt(2 * kPi) * sin_b) * 2.0 /
                    (std::cos(kPi / N) - std::cos(phi / N));
  // H along t on the cone is sin_b of its magnitude, and E = H x direction is along n.
  for (int i = 0; i < 2; ++i) wave.amplitude[i] = k_hat.cross(fields[i]).dot(f.t) * D / sin_b;
  return wave;
}

double transition_parameter(const Vec3& along_face, const Vec3& other) {
  return 0.25 * std::max((along_face - other).squaredNorm(), kInPlaneAngle * kInPlaneAngle);
}

namespace {

// Direction relative to the edge: angle from the sheet's extension, positive on the side of the first face, and sine of
// the angle to the edge.
struct EdgeAngle {
  double phi = 0;    // -pi..pi
  double sin_b = 1;  // > 0
};

EdgeAngle about(const WedgeFrame& wedge, const Vec3& towards) {
  const WedgeFace& face = wedge.face[0];
  const double out = -towards.dot(face.x), up = towards.dot(face.n);
  constexpr double kMinSine = 1e-6;
  return {std::atan2(up, out), std::max(std::hypot(out, up), kMinSine)};
}

// (1 - gamma - ln(kappa t / 2 pi) - j pi / 2) / pi, kappa = k sin b: the logarithm of the square end.
FirstOrderThickness<Complex> end_logarithm(double sin_b) {
  return {(1 - std::numbers::egamma - std::log(sin_b / (2 * kPi)) - 0.5 * kJ * kPi) / kPi, -1 / kPi};
}

// 2 delta P / kappa t without the logarithm, whose factors are given separately.
struct ThicknessTerms {
  double soft = 0, hard = 0;
  double soft_log = 0, hard_log = 0;  // cos(phi/2) cos(phi0/2) and sin(phi/2) sin(phi0/2)
};

// Terms for two directions; the phase refers to the face that both are in front of, else to the middle of the sheet.
ThicknessTerms thickness_terms(double phi, double phi0) {
  const double side = phi * phi0 < 0 ? -1 : 1;
  // On the reflection and the shadow boundary the fractions below are 0/0, in the sheet's plane doubly: both are
  // avoided.
  constexpr double kAside = 1e-5;
  const auto off_the_sheet = [](double angle) { return std::clamp(std::abs(angle), 10 * kAside, kPi - 10 * kAside); };
  double a = off_the_sheet(phi), a0 = off_the_sheet(phi0);
  if (const double beyond = a + a0 - kPi; std::abs(beyond) < kAside) {
    const double aside = 0.5 * (std::copysign(kAside, beyond) - beyond);
    a += aside;
    a0 += aside;
  }
  const double c = std::cos(a), s = std::sin(a), c0 = std::cos(a0), s0 = std::sin(a0);
  const double CC = std::cos(a / 2) * std::cos(a0 / 2), SS = side * std::sin(a / 2) * std::sin(a0 / 2);
  const double currents = (a * s + a0 * s0) / kPi, face = side > 0 ? s + s0 : 0;
  return {-CC * (currents + 2 * SS - face) / (c + c0), (SS * currents + 0.5 * (1 + c * c0) - face * SS) / (c + c0), -CC,
          SS};
}

}  // namespace

std::array<FirstOrderThickness<CVec3>, 2> thick_edge_currents(const WedgeFrame& wedge, const Vec3& k_hat,
                                                              const std::array<Vec3, 2>& fields, const Vec3& s) {
  const EdgeAngle in = about(wedge, -k_hat), out = about(wedge, s);
  const ThicknessTerms terms = thickness_terms(out.phi, in.phi);
  // Off Keller's cone: geometric mean of both waves' sines, which is reciprocal.
  const double sin_b = std::sqrt(in.sin_b * out.sin_b);
  const FirstOrderThickness<Complex> end = end_logarithm(sin_b);
  const Complex soft = terms.soft + terms.soft_log * end.constant, hard = terms.hard + terms.hard_log * end.constant;
  const Vec3& t = wedge.face[0].t;
  const Vec3 e_hard = t.cross(s);
  std::array<FirstOrderThickness<CVec3>, 2> currents;
  for (int i = 0; i < 2; ++i) {
    // S per metre is j / (pi sin^2 b) times the amplitude P of the fields along t, E_t along t and H_t along t x s;
    // delta P has the factor kappa t / 2.
    const Complex E_t = kJ / (2 * kPi * sin_b) * fields[i].dot(t),
                  H_t = kJ / (2 * kPi * sin_b) * k_hat.cross(fields[i]).dot(t);
    currents[i].constant = soft * E_t * t.cast<Complex>() + hard * H_t * e_hard.cast<Complex>();
    currents[i].logarithm =
        end.logarithm * (terms.soft_log * E_t * t.cast<Complex>() + terms.hard_log * H_t * e_hard.cast<Complex>());
  }
  return currents;
}

FirstOrderThickness<Complex> thick_edge_wave_change(const WedgeFrame& wedge, const Vec3& towards) {
  const auto [phi, sin_b] = about(wedge, towards);
  const double C = std::cos(phi / 2), S = std::sin(std::abs(phi) / 2);
  const FirstOrderThickness<Complex> end = end_logarithm(sin_b);
  const Complex all = -kJ * sin_b * S;
  return {all * (S * end.constant + C * (1 - std::abs(phi) / kPi)), all * S * end.logarithm};
}

}  // namespace seaglint
