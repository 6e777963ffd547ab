// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/coefficients/sea_water.h"

#include <cmath>

#include "sim/core/numbers/constants.h"

namespace seaglint {

double sea_water_conductivity(double T, double S) {
  const double sigma35 =
      2.903602 + 8.607e-2 * T + 4.738817e-4 * T * T - 2.991e-6 * T * T * T + 4.3047e-9 * T * T * T * T;  // eq. 12
  const double R15 = S * (37.5109 + 5.45216 * S + 1.4409e-2 * S * S) / (1004.75 + 182.283 * S + S * S);  // eq. 13
  const double alpha0 = (6.9431 + 3.2841 * S - 9.9486e-2 * S * S) / (84.850 + 69.024 * S + S * S);       // eq. 15
  const double alpha1 = 49.843 - 0.2276 * S + 0.198e-2 * S * S;                                          // eq. 16
  return sigma35 * R15 * (1 + alpha0 * (T - 15) / (alpha1 + T));                                         // eqs. 11, 14
}

Complex sea_water_permittivity(double frequency_hz, double T, double S) {
  const double nu = 1e-9 * frequency_hz;  // GHz
  // Pure water: eqs. 7 and 8 with table III.
  double eps_s = (3.70886e4 - 8.2168e1 * T) / (4.21854e2 + T);
  double eps_1 = 5.7230 + 2.2379e-2 * T - 7.1237e-4 * T * T;
  double nu_1 = (45 + T) / (5.0478 - 7.0315e-2 * T + 6.0059e-4 * T * T);
  double eps_inf = 3.6143 + 2.8841e-2 * T;
  double nu_2 = (45 + T) / (1.3652e-1 + 1.4825e-3 * T + 2.4166e-4 * T * T);
  // Salt: eq. 17 with table VI.
  eps_s *= std::exp(-3.56417e-3 * S + 4.74868e-6 * S * S + 1.15574e-5 * T * S);
  nu_1 *= 1 + S * (2.39357e-3 - 3.13530e-5 * T + 2.52477e-7 * T * T);
  eps_1 *= std::exp(-6.28908e-3 * S + 1.76032e-4 * S * S - 9.22144e-5 * T * S);
  nu_2 *= 1 + S * (-1.99723e-2 + 1.81176e-4 * T);
  eps_inf *= 1 + S * (-2.04265e-3 + 1.57883e-4 * T);
  // Eq. 6 with 1 / (2 pi eps0) = 17.97510 GHz m/S.
  return (eps_s - eps_1) / Complex(1, nu / nu_1) + (eps_1 - eps_inf) / Complex(1, nu / nu_2) + eps_inf -
         Complex(0, sea_water_conductivity(T, S) * 17.97510 / nu);
}

double ament_factor(double k, double rms_height, double sin_grazing) {
  const double g = k * rms_height * sin_grazing;
  return std::exp(-2 * g * g);
}

namespace {

// I0(z) = sum_m (z/2)^2m / (m!)^2 (Abramowitz and Stegun, 9.6.12), 0 <= z < 500. std::cyl_bessel_i writes a global by
// lgamma, from several threads.
double bessel_i0(double z) {
  const double q = 0.25 * z * z;
  double term = 1, sum = 1;
  for (int m = 1; term > 1e-17 * sum; ++m) {
    term *= q / (static_cast<double>(m) * m);
    sum += term;
  }
  return sum;
}

}  // namespace

double miller_brown_vegh_factor(double k, double rms_height, double sin_grazing) {
  const double g = k * rms_height * sin_grazing, z = 2 * g * g;
  if (z < 500) return std::exp(-z) * bessel_i0(z);
  // e^{-z} I0(z) = (1 + 1/(8z) + ...) / sqrt(2 pi z) (Abramowitz and Stegun, 9.7.1).
  return (1 + 1 / (8 * z) + 9 / (128 * z * z)) / std::sqrt(2 * kPi * z);
}

}  // namespace seaglint
