// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The product of two finite complex numbers. std::complex's own also settles infinities, which costs inner loops half
// of their time.

#include "sim/core/linear.h"

namespace seaglint {

inline Complex times(Complex a, Complex b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

}  // namespace seaglint
