// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Permittivity of sea water at radar frequencies, and the coherent specular reflection of a rough sea.

#include "sim/core/numbers/linear.h"

namespace seaglint {

// Relative permittivity eps' - j eps'' including conductivity, double Debye model of T. Meissner and F. J. Wentz, IEEE
// Trans. Geosci. Remote Sens. 42 (2004) 1836-1849. Valid for -2 <= temperature_c <= 29, 0 <= salinity_psu <= 40,
// frequencies up to 90 GHz.
Complex sea_water_permittivity(double frequency_hz, double temperature_c, double salinity_psu);

// Conductivity, S/m (Stogryn et al. 1995 as given in Meissner and Wentz 2004, eqs. 11-16).
double sea_water_conductivity(double temperature_c, double salinity_psu);

// Coherent reflection of a surface with Gaussian heights relative to the smooth one: e^{-2 (k sigma sin psi)^2}, psi
// the grazing angle, sigma the RMS height in m, k in rad/m (W. S. Ament, Proc. IRE 41 (1953) 142-146).
double ament_factor(double k, double rms_height, double sin_grazing);

// The same for a height that is a sine of random phase and Gaussian amplitude, close to the sea's: e^{-z} I0(z), z = 2
// (k sigma sin psi)^2 (A. R. Miller, R. M. Brown and E. Vegh, IEE Proc. H 131 (1984) 114-116).
double miller_brown_vegh_factor(double k, double rms_height, double sin_grazing);

}  // namespace seaglint
