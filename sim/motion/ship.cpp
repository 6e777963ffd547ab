// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/ship.h"

#include <algorithm>
#include <cmath>

#include "sim/sea/unit_phasors.h"

namespace seaglint {

namespace {

constexpr std::size_t kMaxDegrees = 6;
using Degrees = std::array<double, kMaxDegrees>;

// Accelerations of all degrees of freedom at uniform times, as sums over the components.
class Forcing {
 public:
  Forcing(const ShipParticulars& ship, const WaveField& sea, std::size_t degrees, double x, double y, double start,
          double step)
      : degrees_(degrees), phasors_(make(ship, sea, x, y, start, step)) {}

  Degrees value() const {
    Degrees sum{};
    const double* c = phasors_.cosine().data();
    const double* s = phasors_.sine().data();
    for (std::size_t i = 0; i < phasors_.cosine().size(); ++i) {
      for (std::size_t d = 0; d < degrees_; ++d) {
        sum[d] += real_[d][i] * c[i] - imaginary_[d][i] * s[i];
      }
    }
    return sum;
  }

  void advance() { phasors_.advance(); }

  // Where the degree's oscillator is in its linear steady state.
  OscillatorState steady_state(const Oscillator& oscillator, std::size_t degree) const {
    OscillatorState state;
    for (std::size_t i = 0; i < omega_.size(); ++i) {
      const Complex x = linear_response(oscillator, omega_[i]) * Complex(real_[degree][i], imaginary_[degree][i]) *
                        Complex(phasors_.cosine()[i], phasors_.sine()[i]);
      state.x += x.real();
      state.rate -= omega_[i] * x.imag();  // Re{j w x}
    }
    return state;
  }

 private:
  // Waves that the hull averages away are left out: with less than 1e-9 of the largest contribution to an acceleration.
  UniformPhasors make(const ShipParticulars& ship, const WaveField& sea, double x, double y, double start,
                      double step) {
    std::vector<std::array<Complex, kMaxDegrees>> accelerations;
    std::array<double, kMaxDegrees> largest{};
    for (const WaveComponent& component : sea.components()) {
      const double mu = std::atan2(component.direction.y(), component.direction.x());
      const ShipExcitation e = ship_excitation(ship, component.omega, mu);
      std::array<Complex, kMaxDegrees> all{e.roll, e.pitch, e.yaw, e.surge, e.sway, e.heave};
      for (std::size_t d = 0; d < degrees_; ++d) {
        all[d] *= component.amplitude;
        largest[d] = std::max(largest[d], std::abs(all[d]));
      }
      accelerations.push_back(all);
    }
    constexpr double kNegligible = 1e-9;
    std::vector<double> phase;
    for (std::size_t i = 0; i < accelerations.size(); ++i) {
      bool counts = false;
      for (std::size_t d = 0; d < degrees_; ++d) counts |= std::abs(accelerations[i][d]) > kNegligible * largest[d];
      if (!counts) continue;
      const WaveComponent& component = sea.components()[i];
      omega_.push_back(component.omega);
      phase.push_back(component.phase -
                      component.wavenumber * (component.direction.x() * x + component.direction.y() * y));
      for (std::size_t d = 0; d < degrees_; ++d) {
        real_[d].push_back(accelerations[i][d].real());
        imaginary_[d].push_back(accelerations[i][d].imag());
      }
    }
    return UniformPhasors(omega_, phase, start, step);
  }

  std::size_t degrees_;
  std::vector<double> omega_;
  std::array<std::vector<double>, kMaxDegrees> real_, imaginary_;
  UniformPhasors phasors_;
};

}  // namespace

std::vector<MotionSample> simulate_ship(const ShipParticulars& ship, const MotionSpec& spec, const WaveField& sea,
                                        double x, double y, double duration_s) {
  const std::array<Oscillator, kMaxDegrees> oscillators{ship.roll,  ship.pitch, ship.yaw,
                                                        ship.surge, ship.sway,  ship.heave};
  const std::size_t degrees = spec.translations ? 6 : 3;
  const double step = spec.step_s;
  const auto before = static_cast<long>(std::ceil(spec.preroll_s / step));
  const auto after = std::max(1L, static_cast<long>(std::ceil(duration_s / step)));

  // Every step is divided when a period given by the user asks for it.
  double fastest = 0;
  for (std::size_t d = 0; d < degrees; ++d) fastest = std::max(fastest, oscillators[d].omega0);
  const auto parts = std::max(1L, static_cast<long>(std::ceil(fastest * step / kLongestTurn)));
  const double part = step / static_cast<double>(parts);

  Forcing forcing(ship, sea, degrees, x, y, -step * static_cast<double>(before), 0.5 * part);
  std::array<OscillatorState, kMaxDegrees> state{};
  for (std::size_t d = 0; d < degrees; ++d) state[d] = forcing.steady_state(oscillators[d], d);

  std::vector<MotionSample> samples;
  samples.reserve(static_cast<std::size_t>(after) + 1);
  Degrees begin = forcing.value();
  for (long n = -before;; ++n) {
    if (n >= 0) {
      samples.push_back({{state[0].x, state[1].x, state[2].x},
                         {state[0].rate, state[1].rate, state[2].rate},
                         {state[3].x, state[4].x, state[5].x},
                         {state[3].rate, state[4].rate, state[5].rate}});
    }
    if (n == after) break;
    for (long p = 0; p < parts; ++p) {
      forcing.advance();
      const Degrees middle = forcing.value();
      forcing.advance();
      const Degrees end = forcing.value();
      for (std::size_t d = 0; d < degrees; ++d) {
        state[d] = advance(oscillators[d], state[d], begin[d], middle[d], end[d], part);
      }
      begin = end;
    }
  }
  return samples;
}

}  // namespace seaglint
