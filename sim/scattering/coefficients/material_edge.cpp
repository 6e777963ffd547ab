// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/coefficients/material_edge.h"

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/scattering/coefficients/fade_windows.h"
#include "sim/scattering/geometry/look_basis.h"

namespace seaglint {

namespace {

// Phase of sin(theta) beyond which the path of s is rotated by the rest, rad: its integrand has poles at tan v = +-j
// e^{j phase}, on the path for a reactive face. The path stays in Re s > 0, where the logarithm is regular.
constexpr double kMaxPhase = 0.9;
constexpr int kNodes = 48;  // of the quadrature over v

// Nodes v and weights over 0..pi/2: Gauss-Legendre quadrature, by Newton's method on the Legendre polynomial, in y with
// pi/2 - v = (pi/2) y^2, since the integrand ends as (pi/2 - v)^(1/N).
struct Quadrature {
  std::array<double, kNodes> tangent, sine_squared, weight;

  Quadrature() {
    for (int i = 0; i < kNodes; ++i) {
      double x = std::cos(kPi * (i + 0.75) / (kNodes + 0.5)), slope = 1;
      for (int step = 0; step < 20; ++step) {
        double p = 1, before = 0;
        for (int n = 1; n <= kNodes; ++n) {
          const double next = ((2 * n - 1) * x * p - (n - 1) * before) / n;
          before = p;
          p = next;
        }
        slope = kNodes * (before - x * p) / (1 - x * x);
        x -= p / slope;
      }
      const double y = 0.5 * (1 + x), v = kPi / 2 * (1 - y * y);
      tangent[i] = std::tan(v);
      sine_squared[i] = std::sin(v) * std::sin(v);
      weight[i] = kPi / 2 * y * 2 / ((1 - x * x) * slope * slope);
    }
  }
};

bool is_soft(const Complex& brewster_sine) { return std::abs(brewster_sine) >= kSoftConductor; }

// One face of the wedge: g(x) / g(0), and the elementary products of g at arguments pi apart.
class FaceFactor {
 public:
  FaceFactor(const Complex& brewster_sine, double N) : size_(std::abs(brewster_sine)), N_(N) {
    is_soft_ = is_soft(brewster_sine);
    const double phase = size_ > 0 ? std::arg(brewster_sine) : 0, within = std::clamp(phase, -kMaxPhase, kMaxPhase);
    turn_ = std::polar(1.0, within);
    path_ = std::polar(size_, phase - within);
    // Inverse of cos((pi/2 - theta) / N).
    if (!is_soft_) inverse_ = 1.0 / std::cos(std::acos(brewster_sine) / N);
    const Complex at_right_angle = ratio(kPi / 2);
    normalisation_ = at_right_angle * at_right_angle;
  }

  // g(x) / g(0)
  Complex ratio(double x) const {
    if (is_soft_) return 1;
    const double cosine = std::cos(x / N_);
    if (size_ == 0) return std::sqrt(std::max(0.5 * (1 + cosine), 0.0));  // |cos(x / 2N)|, |x| <= N pi
    static const Quadrature nodes;
    Complex sum = 0;
    for (int i = 0; i < kNodes; ++i) {
      const Complex cosh = std::cosh(std::asinh(path_ * nodes.tangent[i]) / N_);
      const double s2 = nodes.sine_squared[i];
      sum += nodes.weight[i] * std::log((cosine + cosh) / (1.0 + cosh)) * turn_ / (s2 + turn_ * turn_ * (1 - s2));
    }
    return std::exp(sum / kPi);
  }

  // g(x + pi sign) g(x) / g(0)^2
  Complex product(double x, double sign) const {
    if (is_soft_) return normalisation_;
    return normalisation_ * (std::cos((x + sign * kPi / 2) / N_) * inverse_ + 1.0) / (inverse_ + 1.0);
  }

 private:
  double size_;
  double N_;
  bool is_soft_ = false;
  Complex turn_ = 1, path_ = 0;  // sinh s = path tan v, sin(theta) = path turn
  Complex inverse_ = 0, normalisation_ = 1;
};

}  // namespace

Complex brewster_sine(const Complex& reflection, double sin_phi) {
  const Complex below = 1.0 + reflection, above = sin_phi * (1.0 - reflection);
  if (std::abs(above) >= kSoftConductor * std::abs(below)) return kSoftConductor;
  const Complex sine = above / below;
  return {std::max(sine.real(), 0.0), sine.imag()};
}

Complex impedance_wedge(double phi, double phi0, const std::array<Complex, 2>& brewster_sines, double N) {
  // A face enters with the angle from the other face, x: phi for face 1 and phi - N pi for face 0.
  const FaceFactor first(brewster_sines[0], N), second(brewster_sines[1], N);
  const double round = N * kPi, middle = round / 2;
  const auto of_direction = [&](double angle) { return second.ratio(angle) * first.ratio(angle - round); };
  const Complex receiver = of_direction(phi), transmitter = phi == phi0 ? receiver : of_direction(phi0);
  const double sine_0 = std::sin((phi0 - middle) / N);
  const auto part = [&](double sign) {
    return second.product(phi, sign) * first.product(phi - round, sign) /
           (std::sin((phi - middle + sign * kPi) / N) - sine_0);
  };
  return -0.5 * kJ * std::cos((phi0 - middle) / N) / N * (part(-1) - part(1)) / (receiver * transmitter);
}

Complex half_plane_optics(double phi, double phi0, const Complex& reflection, const Complex& transmission) {
  return 0.25 * kJ *
         ((1.0 + reflection - transmission) * std::sin(phi) - (1.0 - reflection - transmission) * std::sin(phi0)) /
         (std::cos(phi) + std::cos(phi0));
}

namespace {

// Sine of the grazing angle below which a face is evaluated at it; distance from a boundary within which two values on
// either side of it are averaged: relative error of the second order, 4e-6.
constexpr double kMinGrazingSine = 1e-4, kBoundaryStep = 2e-3;

// Component along the edge: E for the soft wave, H for the hard one.
enum Wave { kSoft, kHard };

struct Coefficients {
  Complex reflection, transmission;
};

// Direction of a wave, incident or reversed exit: angle from the face, 0..2 pi, and cosine and sine of the angle
// between its propagation and the edge.
struct EdgeDirection {
  double phi, cos_b, sin_b;
};

double off_grazing(double x) { return std::max(std::abs(x), kMinGrazingSine); }

// Reflection and transmission of the component along the edge by a face, for a wave that has only this one of E_t and
// H_t. Frame: x into the face, y its normal, z along the edge.
Coefficients along_edge(const MaterialSurface& surface, Wave wave, const EdgeDirection& from) {
  const double sine = off_grazing(std::sin(from.phi)), cosine = std::cos(from.phi);
  const Vec3 d = Vec3(-from.sin_b * cosine, -from.sin_b * sine, from.cos_b).normalized(), t = Vec3::UnitZ();
  const Vec3 across = d.cross(Vec3::UnitY());
  const Vec3 s = across.norm() > 1e-9 ? Vec3(across.normalized()) : t;
  const Vec3 d_out(d.x(), -d.y(), d.z()), p = s.cross(d), p_out = s.cross(d_out);
  const Vec3 with_edge = (t - d.dot(t) * d) / from.sin_b;
  const Vec3 E = wave == kSoft ? with_edge : d.cross(with_edge);
  const InterfaceCoefficients c = surface.at(std::min(-d.y(), 1.0));
  if (c.te == -1.0 && c.tm == 1.0) return {wave == kSoft ? -1 : 1, 0};
  const auto component = [&](const Complex& te, const Complex& tm, const Vec3& direction, const Vec3& p_of) -> Complex {
    const auto of = [&](const Vec3& field) { return wave == kSoft ? field.z() : direction.cross(field).z(); };
    return te * s.dot(E) * of(s) + tm * p.dot(E) * of(p_of);
  };
  const double incident = wave == kSoft ? E.z() : d.cross(E).z();
  return {component(c.te, c.tm, d_out, p_out) / incident,
          component(c.te_transmission, c.tm_transmission, d, p) / incident};
}

// The same direction seen from the other face of a wedge.
EdgeDirection from_other_face(const EdgeDirection& of, double N) { return {N * kPi - of.phi, -of.cos_b, of.sin_b}; }

class MaterialEdge {
 public:
  MaterialEdge(double N, const MaterialFaces& faces, double shadow) : N_(N), faces_(faces), shadow_(shadow) {}

  // P of Keller's field less physical optics, regular on shadow and reflection boundaries.
  Complex amplitude(Wave wave, const EdgeDirection& in, const EdgeDirection& out) const {
    const double sum = in.phi + out.phi;
    double turn = 0;  // sign of the change of phi with that of phi0 that crosses the boundary
    if (std::min(std::abs(sum - kPi), std::abs(2 * N_ * kPi - sum - kPi)) < kBoundaryStep) turn = 1;
    if (std::abs(std::abs(in.phi - out.phi) - kPi) < kBoundaryStep) turn = -1;
    if (turn == 0) return value(wave, in, out);
    Complex mean = 0;
    for (const double step : {kBoundaryStep, -kBoundaryStep}) {
      EdgeDirection a = in, b = out;
      a.phi = std::clamp(a.phi + step, kInside, N_ * kPi - kInside);
      b.phi = std::clamp(b.phi + turn * step, kInside, N_ * kPi - kInside);
      mean += 0.5 * value(wave, a, b);
    }
    return mean;
  }

  // Half the total field along the edge, over that of the incident wave, on the faces whose optics are subtracted; the
  // sign of a face's t relative to the first one's included.
  Complex total_on_faces(Wave wave, const EdgeDirection& in, const EdgeDirection& out) const {
    Complex sum = 0;
    for (int f = 0; f < 2; ++f) {
      const EdgeDirection a = f == 0 ? in : from_other_face(in, N_), b = f == 0 ? out : from_other_face(out, N_);
      if (!has_optics(a.phi, b.phi)) continue;
      const auto [R, T] = along_edge(*faces_.face[f], wave, a);
      sum += (f == 0 ? 0.5 : -0.5) * (1.0 + R - T);
    }
    return sum;
  }

  static constexpr double kInside = 1e-6;  // rad from the faces

 private:
  Complex value(Wave wave, const EdgeDirection& in, const EdgeDirection& out) const {
    return faces_.is_sheet ? sheet(wave, in, out) : wedge(wave, in, out);
  }

  // True where the optics of a face are subtracted; angles from that face.
  bool has_optics(double phi0, double phi) const {
    const bool near_boundary = std::abs(std::abs(kPi - phi) - phi0) < shadow_;
    return phi0 < kPi && (near_boundary || std::sin(phi) > kEdgeOn);
  }

  Complex wedge(Wave wave, const EdgeDirection& in, const EdgeDirection& out) const {
    std::array<Complex, 2> sines;
    Complex optics = 0;
    for (int f = 0; f < 2; ++f) {
      const EdgeDirection a = f == 0 ? in : from_other_face(in, N_), b = f == 0 ? out : from_other_face(out, N_);
      const Complex R = along_edge(*faces_.face[f], wave, a).reflection,
                    R_out = along_edge(*faces_.face[f], wave, b).reflection;
      sines[f] =
          0.5 * (brewster_sine(R, off_grazing(std::sin(a.phi))) + brewster_sine(R_out, off_grazing(std::sin(b.phi))));
      if (has_optics(a.phi, b.phi)) optics += half_plane_optics(b.phi, a.phi, R);
    }
    return impedance_wedge(out.phi, in.phi, sines, N_) - optics;
  }

  // sin(theta) of the even and the odd part of a sheet's field for one direction.
  struct SheetSines {
    Complex even, odd;
  };
  SheetSines sheet_sines(Wave wave, const EdgeDirection& from) const {
    const double sine = off_grazing(std::sin(from.phi));
    const auto [R, T] = along_edge(*faces_.face[0], wave, from);
    const Complex middle = R * std::polar(1.0, faces_.k * faces_.face[0]->thickness() * from.sin_b * sine);
    return {brewster_sine(middle + T, sine), brewster_sine(middle - T, sine)};
  }

  // Zero a of A + B c^2 = B (c^2 - a^2) from its values at c = 0 and `c`: the root below the real axis, like k of a
  // lossy medium; 0 for a constant.
  static Complex zero_of(const Complex& at_normal, const Complex& at_c, double c) {
    const Complex B = (at_c - at_normal) / (c * c);
    if (std::abs(B) <= 1e-12 * std::abs(at_normal)) return 0;
    const Complex a = std::sqrt(-at_normal / B);
    return a.imag() > 1e-12 * std::abs(a) ? -a : a;
  }

  Complex sheet(Wave wave, EdgeDirection in, EdgeDirection out) const {
    // From the illuminated side.
    if (in.phi > kPi) {
      in = from_other_face(in, 2);
      out = from_other_face(out, 2);
    }
    const bool behind = out.phi > kPi;
    const double phi = behind ? 2 * kPi - out.phi : out.phi, c0 = std::cos(in.phi), c = std::cos(phi);

    const SheetSines a = sheet_sines(wave, in), b = sheet_sines(wave, {phi, out.cos_b, out.sin_b});
    // The geometric mean splits a zero of the even sine between both directions, as the factors below do.
    Complex even = impedance_wedge(phi, in.phi, {std::sqrt(a.even * b.even), 0.0}, 1),
            odd = impedance_wedge(phi, in.phi, {0.5 * (a.odd + b.odd), kSoftConductor}, 1);

    // Zeros of the even sine and of the inverse of the odd one, from normal incidence and 1 rad off it.
    const SheetSines normal = sheet_sines(wave, {kPi / 2, in.cos_b, in.sin_b}),
                     oblique = sheet_sines(wave, {kPi / 2 - 1, in.cos_b, in.sin_b});
    const double reference = std::sin(1.0);
    const Complex zero = zero_of(normal.even, oblique.even, reference);
    const double weight = smooth_taper(std::abs(zero), kNormalPolarisationWindow);
    if (zero != 0.0 && weight > 0) {
      const auto split = [&](const Complex& at, double share) -> Complex {
        const auto factor = [&](double cosine) { return std::sqrt((at - cosine) / (at + cosine)); };
        return at == 0.0 ? 1 : 1 - share + share * factor(c) * factor(c0);
      };
      even *= split(zero, weight);
      odd *= split(zero_of(1.0 / normal.odd, 1.0 / oblique.odd, reference),
                   weight * smooth_taper(1 / std::abs(normal.odd), kSheetAdmittanceWindow));
    }

    // The mesh is the illuminated face, half a thickness before the middle of the sheet.
    const double depth =
        0.5 * faces_.k * faces_.face[0]->thickness() * (in.sin_b * std::sin(in.phi) + out.sin_b * std::sin(out.phi));
    const Complex exact = 0.5 * (behind ? even - odd : even + odd) * std::polar(1.0, -depth);
    if (!has_optics(in.phi, out.phi)) return exact;
    const auto [R, T] = along_edge(*faces_.face[0], wave, in);
    return exact - half_plane_optics(out.phi, in.phi, R, T);
  }

  double N_;
  const MaterialFaces& faces_;
  double shadow_;
};

}  // namespace

std::array<CVec3, 2> material_edge_currents(const WedgeFrame& wedge, const MaterialFaces& faces, const Vec3& k_hat,
                                            const std::array<Vec3, 2>& fields, const Vec3& s, double shadow) {
  const WedgeFace& face = wedge.face[0];
  std::array<CVec3, 2> currents{CVec3::Zero(), CVec3::Zero()};
  const auto angles = [&](const Vec3& towards) -> EdgeDirection {
    double phi = std::atan2(towards.dot(face.n), towards.dot(face.x));
    if (phi < 0) phi += 2 * kPi;
    // Rounding may put a direction in the plane of face 0 behind it.
    const double inside = 2 * kPi - phi, beyond = phi - wedge.N * kPi;
    phi = beyond > 0 && inside < beyond ? 0 : phi;
    const double cos_b = -towards.dot(face.t);
    return {phi, cos_b, std::sqrt(std::max(1 - cos_b * cos_b, 1e-12))};
  };
  EdgeDirection in = angles(-k_hat), out = angles(s);
  if (in.phi > wedge.N * kPi) return currents;
  for (EdgeDirection* d : {&in, &out})
    d->phi = std::clamp(d->phi, MaterialEdge::kInside, wedge.N * kPi - MaterialEdge::kInside);

  const MaterialEdge edge(wedge.N, faces, shadow);
  const double off_cone = 0.5 * (in.cos_b + out.cos_b);  // (k^ - s) . t / 2, 0 on Keller's cone
  const Complex scale = kJ / (kPi * in.sin_b * out.sin_b) * std::sqrt(1 - off_cone * off_cone);
  const Complex soft = scale * edge.amplitude(kSoft, in, out), hard = scale * edge.amplitude(kHard, in, out);
  // At oblique incidence the currents of physical optics also convert E_t and H_t into each other: line integrals of
  // the total field along the edge (F. Kottler, Ann. Phys. 71, 1923, 457-508), without a pole.
  const double slant = in.cos_b / (2 * kPi * in.sin_b * in.sin_b);
  const Complex soft_of_hard = slant * edge.total_on_faces(kHard, in, out),
                hard_of_soft = -slant * edge.total_on_faces(kSoft, in, out);
  const Vec3 across = face.t.cross(s);
  for (int i = 0; i < 2; ++i) {
    const double E_t = fields[i].dot(face.t), H_t = k_hat.cross(fields[i]).dot(face.t);
    currents[i] = (soft * E_t + soft_of_hard * H_t) * face.t.cast<Complex>() +
                  (hard * H_t + hard_of_soft * E_t) * across.cast<Complex>();
  }
  return currents;
}

}  // namespace seaglint
