// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Sea water at radar frequencies, and what its waves leave of a mirror.

#include "sim/core/numbers/linear.h"

namespace seaglint {

// Relative permittivity eps' - j eps'' (conductivity included) by the double Debye model of T. Meissner and F. J.
// Wentz, IEEE Trans. Geosci. Remote Sens. 42 (2004) 1836-1849. Their range: -2 <= temperature_c <= 29, 0 <=
// salinity_psu <= 40, up to 90 GHz.
Complex sea_water_permittivity(double frequency_hz, double temperature_c, double salinity_psu);

// Conductivity, S/m (Stogryn et al. 1995 as given in Meissner and Wentz 2004, eqs. 11-16).
double sea_water_conductivity(double temperature_c, double salinity_psu);

// Coherent field reflected by a surface of Gaussian heights, relative to the smooth one: e^{-2 (k sigma sin psi)^2},
// psi the grazing angle, sigma the RMS height (W. S. Ament, Proc. IRE 41, 1953, 142-146).
double ament_factor(double k, double rms_height, double sin_grazing);

// The same for a surface whose height is a sine of random phase and Gaussian amplitude, as the sea's nearly is: e^{-z}
// I0(z), z = 2 (k sigma sin psi)^2 (A. R. Miller, R. M. Brown and E. Vegh, IEE Proc. H 131, 1984, 114-116).
double miller_brown_vegh_factor(double k, double rms_height, double sin_grazing);

}  // namespace seaglint
