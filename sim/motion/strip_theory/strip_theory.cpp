// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/strip_theory/strip_theory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/motion/strip_theory/section_radiation.h"

namespace seaglint {

namespace {

// Sections with a breadth or draught below this fraction of the draught of the hull, or an area below its square times
// the beam and draught of the hull, are skipped.
constexpr double kThinnest = 0.01;

// Smallest ratio of half-breadth to draught, or its reciprocal, for which the multipole series is accurate. Beyond it
// the flow is that of the nearest form with the same draught (sway and roll of a thin section, whose added mass is that
// of a plate) or the same breadth (a shallow one).
constexpr double kSlenderest = 0.2;
constexpr double kFlattest = 5;

// e^{kz - jky sin(mu)} on the wall: its parts even and odd in y, with the normals of both sides.
struct WaveOnWall {
  WaveOnWall(const Contour& c, std::size_t p, double wavenumber, double sin_mu)
      : n_y(2 * c.dz[p]),
        n_z(-2 * c.dy[p]),
        cosine(std::exp(wavenumber * c.z[p]) * std::cos(wavenumber * sin_mu * c.y[p])),
        sine(std::exp(wavenumber * c.z[p]) * std::sin(wavenumber * sin_mu * c.y[p])) {}
  double n_y, n_z, cosine, sine;
};

}  // namespace

StripTheory::Strip StripTheory::solve(const HullSection& section, const LewisForm& form, double step) {
  const double coefficient = section.area / (section.breadth * section.draught);
  const double draught = std::max(section.draught, 0.5 * section.breadth / kFlattest);
  const double breadth = std::max(section.breadth, 2 * kSlenderest * section.draught);
  const LewisForm upright = lewis_form(section.breadth, draught, coefficient * section.breadth * draught);
  const LewisForm lateral = lewis_form(breadth, draught, coefficient * breadth * draught);
  Strip strip;
  strip.x = section.x;
  strip.contour = contour_of(form);
  strip.heave_contour = contour_of(upright);
  strip.lateral_contour = contour_of(lateral);
  for (int n = 1; n <= kFrequencies; ++n) {
    const double wavenumber = step * n * step * n / kGravity;
    SectionRadiation flow = solve_radiation(lateral, strip.lateral_contour, wavenumber);
    if (breadth > section.breadth) {
      flow.potential[kHeave] = solve_radiation(upright, strip.heave_contour, wavenumber).potential[kHeave];
    }
    const Contour& c = strip.lateral_contour;
    strip.integrals.push_back({flow.integral(c, kSway, kSway),
                               // Equal by Green's theorem; the mean halves the truncation error.
                               0.5 * (flow.integral(c, kSway, kRoll) + flow.integral(c, kRoll, kSway)),
                               flow.integral(c, kRoll, kRoll), flow.integral(strip.heave_contour, kHeave, kHeave)});
    strip.radiation.push_back(flow);
  }
  return strip;
}

StripTheory::StripTheory(const HullSections& hull) {
  const double beam = hull.beam();
  const double draught = hull.draught();
  if (!(beam > 0) || !(draught > 0) || !(hull.length > 0)) {
    throw InputError(fmt::format("hull sections: length {:.4g} m, breadth {:.4g} m, draught {:.4g} m: all must be > 0",
                                 hull.length, beam, draught));
  }
  step_ = std::sqrt(kGravity * kMaxHalfBeamNumber / (0.5 * beam)) / kFrequencies;
  const double width = hull.length / static_cast<double>(hull.sections.size());
  StripHydrostatics& h = hydrostatics_;
  double volume_x = 0, volume_z = 0;
  for (const HullSection& section : hull.sections) {
    if (section.breadth < kThinnest * draught || section.draught < kThinnest * draught ||
        section.area < kThinnest * kThinnest * beam * draught) {
      continue;
    }
    const LewisForm form = lewis_form(section.breadth, section.draught, section.area);
    strips_.push_back(solve(section, form, step_));
    strips_.back().width = width;
    h.volume += form.area() * width;
    volume_x += form.area() * width * section.x;
    volume_z += form.area() * width * form.area_centre();
    h.waterplane += section.breadth * width;
    h.waterplane_x += section.breadth * width * section.x;
    h.waterplane_xx += section.breadth * width * section.x * section.x;
    h.waterplane_yy += std::pow(section.breadth, 3) / 12 * width;
  }
  if (strips_.empty()) throw InputError("hull sections: none displaces enough water to carry a ship");
  h.buoyancy_x = volume_x / h.volume;
  h.buoyancy_z = volume_z / h.volume;
  SEAGLINT_CHECK(std::isfinite(h.buoyancy_x) && std::isfinite(h.buoyancy_z),
                 fmt::format("volume {} m^3 about ({}, {}) m", h.volume, h.buoyancy_x, h.buoyancy_z));
}

// Lagrange's cubic through four tabulated frequencies; the first and last four beyond the ends.
StripTheory::Place StripTheory::place(double omega) const {
  const double u = std::clamp(std::abs(omega) / step_ - 1, 0.0, double(kFrequencies - 1));
  const auto first = static_cast<std::size_t>(std::clamp(std::floor(u) - 1, 0.0, double(kFrequencies - 4)));
  const double t = u - static_cast<double>(first);
  return {first,
          {-(t - 1) * (t - 2) * (t - 3) / 6, t * (t - 2) * (t - 3) / 2, -t * (t - 1) * (t - 3) / 2,
           t * (t - 1) * (t - 2) / 6}};
}

// With p = -rho (j w - U d/dx) phi, pitch of a strip is a heave of -x w + ..., yaw a sway: the potentials of pitch and
// yaw are (-x + U/jw) phi_heave and (x - U/jw) phi_sway, and the moments weigh the strips' forces with -(x + U/jw) and
// (x + U/jw) (Salvesen, Tuck and Faltinsen 1970). A strip's force per displacement is -rho w^2 int phi n dl; each
// weight takes one factor w, which avoids division by w.
StripTheory::Radiation StripTheory::radiation(double encounter, double speed) const {
  const Place at = place(encounter);
  Radiation sum;
  for (const Strip& strip : strips_) {
    std::array<Complex, 4> value{};
    for (std::size_t n = 0; n < 4; ++n) {
      for (std::size_t m = 0; m < 4; ++m) value[m] += at.weight[n] * strip.integrals[at.first + n][m];
    }
    for (Complex& v : value) v = -kSeaWaterDensity * strip.width * (encounter < 0 ? std::conj(v) : v);
    const auto& [sway, sway_roll, roll, heave] = value;
    const double w = encounter;
    const Complex left = w * strip.x - kJ * speed;   // w (x + U/jw)
    const Complex right = w * strip.x + kJ * speed;  // w (x - U/jw)
    const Radiation own{{{{w * sway * w, w * sway_roll * w, w * sway * right},
                          {w * sway_roll * w, w * roll * w, w * sway_roll * right},
                          {left * sway * w, left * sway_roll * w, left * sway * right}}},
                        {{{w * heave * w, -w * heave * right}, {-left * heave * w, left * heave * right}}}};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) sum.lateral[i][j] += own.lateral[i][j];
    }
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) sum.vertical[i][j] += own.vertical[i][j];
    }
  }
  return sum;
}

// Froude-Krylov: -rho g int e^{kz - jk.x} n dS. Diffraction by Green's theorem (Haskind relation): rho w0 w int phi_j
// (n_z - j sin(mu) n_y) e^{kz - jk.x} dS with phi_j the potential of the motion in still water at the encounter
// frequency w (Salvesen, Tuck and Faltinsen 1970). Surge: Froude-Krylov alone, as a volume integral.
ShipForces StripTheory::excitation(const ShipWave& wave, double speed) const {
  const double k = wave.wavenumber;
  const double along = k * std::cos(wave.mu);
  const double beta = std::sin(wave.mu);
  const double encounter = wave.omega - speed * along;
  ShipForces forces{};
  if (wave.omega > highest_omega()) return forces;
  const Place at = place(encounter);
  for (const Strip& strip : strips_) {
    Complex sway = 0, heave = 0, roll = 0;        // Froude-Krylov over -rho g
    Complex sway_d = 0, heave_d = 0, roll_d = 0;  // diffraction over rho w0 w
    double water = 0;                             // int e^{kz - jky sin mu} dA
    for (std::size_t p = 0; p < kContourPoints; ++p) {
      const Contour& c = strip.contour;
      const WaveOnWall here(c, p, k, beta);
      water -= here.n_z * (1 - std::exp(k * c.z[p])) / k * std::cos(k * beta * c.y[p]);
      heave += here.cosine * here.n_z;
      sway += -kJ * here.sine * here.n_y;
      roll += -kJ * here.sine * (c.y[p] * here.n_z - c.z[p] * here.n_y);
    }
    for (std::size_t p = 0; p < kContourPoints; ++p) {
      std::array<Complex, kSectionModes> potential{};
      for (std::size_t n = 0; n < 4; ++n) {
        const SectionRadiation& r = strip.radiation[at.first + n];
        for (std::size_t m = 0; m < kSectionModes; ++m) potential[m] += at.weight[n] * r.potential[m][p];
      }
      if (encounter < 0) {
        for (Complex& value : potential) value = std::conj(value);
      }
      const WaveOnWall up(strip.heave_contour, p, k, beta);
      heave_d += potential[kHeave] * (up.n_z * up.cosine - beta * up.n_y * up.sine);
      const WaveOnWall side(strip.lateral_contour, p, k, beta);
      const Complex odd = -kJ * (side.n_z * side.sine + beta * side.n_y * side.cosine);
      sway_d += potential[kSway] * odd;
      roll_d += potential[kRoll] * odd;
    }
    const Complex phase = std::polar(strip.width, -along * strip.x);
    const Complex pressure = -kSeaWaterDensity * kGravity * phase;
    const Complex scattered = kSeaWaterDensity * wave.omega * phase;
    const Complex lever = encounter * strip.x - kJ * speed;  // w (x + U/jw)
    forces.surge += -pressure * kJ * along * water;
    forces.sway += pressure * sway + scattered * encounter * sway_d;
    forces.heave += pressure * heave + scattered * encounter * heave_d;
    forces.roll += pressure * roll + scattered * encounter * roll_d;
    forces.pitch -= pressure * strip.x * heave + scattered * lever * heave_d;
    forces.yaw += pressure * strip.x * sway + scattered * lever * sway_d;
  }
  return forces;
}

}  // namespace seaglint
