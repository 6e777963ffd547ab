// SPDX-License-Identifier: BSD-3-Clause
#include "radar/echo/sea_clutter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

namespace seaglint {
namespace {

TEST(GammaTexture, IncompleteGammaHasItsElementaryForms) {
  for (const double x : {0.01, 0.5, 1.0, 3.0, 20.0}) {
    EXPECT_NEAR(gamma_q(1, x) / std::exp(-x), 1, 1e-12);                          // Q(1, x) = e^{-x}
    EXPECT_NEAR(gamma_q(3, x) / (std::exp(-x) * (1 + x + x * x / 2)), 1, 1e-12);  // Q(n, x) = e^{-x} sum x^k / k!
    EXPECT_NEAR(gamma_p(0.5, x) / std::erf(std::sqrt(x)), 1, 1e-12);              // P(1/2, x) = erf sqrt x
    EXPECT_NEAR(gamma_p(7.3, x) + gamma_q(7.3, x), 1, 1e-12);
  }
}

TEST(GammaTexture, OfShapeOneIsExponential) {
  for (const double y : {-5.0, -1.0, -0.1, 0.0, 0.1, 1.0, 5.0}) {
    const double upper = 0.5 * std::erfc(y / std::sqrt(2.0));
    EXPECT_NEAR(gamma_texture(1, y) / -std::log(upper), 1, 1e-9) << y;
  }
}

TEST(GammaTexture, InvertsTheDistributionForEveryShapeAndRises) {
  for (const double shape : {0.1, 0.3, 1.0, 2.0, 17.0, 1000.0}) {
    double last = -1;
    for (double y = -6; y <= 6; y += 0.25) {
      const double value = gamma_texture(shape, y);
      EXPECT_GT(value, last) << shape << " " << y;
      last = value;
      const double tail = 0.5 * std::erfc(std::abs(y) / std::sqrt(2.0));
      const double found = y < 0 ? gamma_p(shape, shape * value) : gamma_q(shape, shape * value);
      EXPECT_NEAR(found / tail, 1, 1e-8) << shape << " " << y;
    }
  }
}

// Moments by integration over the normal density: mean 1, variance 1/shape.
TEST(GammaTexture, HasMeanOneAndVarianceOneOverShape) {
  for (const double shape : {0.5, 2.0, 30.0}) {
    double mean = 0, square = 0;
    const double step = 0.01;
    for (double y = -8; y <= 8; y += step) {
      const double weight = step * std::exp(-y * y / 2) / std::sqrt(2 * 3.14159265358979323846);
      const double value = gamma_texture(shape, y);
      mean += weight * value;
      square += weight * value * value;
    }
    EXPECT_NEAR(mean, 1, 1e-6);
    EXPECT_NEAR(square - mean * mean, 1 / shape, 1e-5 / shape);
  }
}

}  // namespace
}  // namespace seaglint
