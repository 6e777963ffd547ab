// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/numbers/random.h"

#include <fmt/format.h>

#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

#include "sim/core/numbers/reproducible_functions.h"
#include "sim/core/process/error.h"

namespace seaglint {

namespace {

std::uint32_t low(std::uint64_t x) { return static_cast<std::uint32_t>(x); }
std::uint32_t high(std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); }

// c[0] + c[1] x + ... + c[n-1] x^(n-1)
template <std::size_t n>
double polynomial(const std::array<double, n>& c, double x) {
  double sum = c[n - 1];
  for (std::size_t i = n - 1; i-- > 0;) sum = sum * x + c[i];
  return sum;
}

}  // namespace

std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key) {
  constexpr std::uint64_t kMultiplier0 = 0xD2511F53;  // table 2 and section 3.3 of the paper
  constexpr std::uint64_t kMultiplier1 = 0xCD9E8D57;
  constexpr std::uint32_t kWeyl0 = 0x9E3779B9;  // golden ratio
  constexpr std::uint32_t kWeyl1 = 0xBB67AE85;  // sqrt(3) - 1
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t product0 = kMultiplier0 * counter[0];
    const std::uint64_t product1 = kMultiplier1 * counter[2];
    counter = {high(product1) ^ counter[1] ^ key[0], low(product1), high(product0) ^ counter[3] ^ key[1],
               low(product0)};
    key[0] += kWeyl0;
    key[1] += kWeyl1;
  }
  return counter;
}

// Counter words: block within the sequence, stream, index (low, high). Part of the data format.
Random::Random(const RandomKey& key)
    : key_{low(key.seed), high(key.seed)},
      counter_{0, static_cast<std::uint32_t>(key.stream), low(key.index), high(key.index)} {}

std::uint64_t Random::bits() {
  if (used_ == 4) {
    block_ = philox4x32(counter_, key_);
    ++counter_[0];
    SEAGLINT_CHECK(counter_[0] != 0, "2^33 numbers of one key are used up");
    used_ = 0;
  }
  const std::uint64_t word = block_[used_] | std::uint64_t{block_[used_ + 1]} << 32;
  used_ += 2;
  return word;
}

double Random::uniform() { return (static_cast<double>(bits() >> 12) + 0.5) * 0x1p-52; }

double Random::normal() { return normal_quantile(uniform()); }

// Lemire, "Fast random integer generation in an interval", ACM TOMACS 29 (2019), algorithm 5.
std::uint32_t Random::below(std::uint32_t count) {
  SEAGLINT_CHECK(count >= 1, "an integer below 0 was asked for");
  const std::uint32_t unfair = (0u - count) % count;  // 2^32 mod count
  while (true) {
    const std::uint64_t product = std::uint64_t{high(bits())} * count;
    if (low(product) >= unfair) return high(product);
  }
}

// Wichura, "Algorithm AS 241: the percentage points of the normal distribution", Applied Statistics 37 (1988) 477,
// PPND16.
double normal_quantile(double p) {
  SEAGLINT_CHECK(p > 0 && p < 1, fmt::format("p = {}", p));
  constexpr std::array<double, 8> a{3.3871328727963666080e0,  1.3314166789178437745e+2, 1.9715909503065514427e+3,
                                    1.3731693765509461125e+4, 4.5921953931549871457e+4, 6.7265770927008700853e+4,
                                    3.3430575583588128105e+4, 2.5090809287301226727e+3};
  constexpr std::array<double, 8> b{1,
                                    4.2313330701600911252e+1,
                                    6.8718700749205790830e+2,
                                    5.3941960214247511077e+3,
                                    2.1213794301586595867e+4,
                                    3.9307895800092710610e+4,
                                    2.8729085735721942674e+4,
                                    5.2264952788528545610e+3};
  constexpr std::array<double, 8> c{1.42343711074968357734e0,  4.63033784615654529590e0, 5.76949722146069140550e0,
                                    3.64784832476320460504e0,  1.27045825245236838258e0, 2.41780725177450611770e-1,
                                    2.27238449892691845833e-2, 7.74545014278341407640e-4};
  constexpr std::array<double, 8> d{1,
                                    2.05319162663775882187e0,
                                    1.67638483018380384940e0,
                                    6.89767334985100004550e-1,
                                    1.48103976427480074590e-1,
                                    1.51986665636164571966e-2,
                                    5.47593808499534494600e-4,
                                    1.05075007164441684324e-9};
  constexpr std::array<double, 8> e{6.65790464350110377720e0,  5.46378491116411436990e0,  1.78482653991729133580e0,
                                    2.96560571828504891230e-1, 2.65321895265761230930e-2, 1.24266094738807843860e-3,
                                    2.71155556874348757815e-5, 2.01033439929228813265e-7};
  constexpr std::array<double, 8> f{1,
                                    5.99832206555887937690e-1,
                                    1.36929880922735805310e-1,
                                    1.48753612908506148525e-2,
                                    7.86869131145613259100e-4,
                                    1.84631831751005468180e-5,
                                    1.42151175831644588870e-7,
                                    2.04426310338993978564e-15};
  const double q = p - 0.5;
  if (std::abs(q) <= 0.425) {
    const double r = 0.180625 - q * q;
    return q * polynomial(a, r) / polynomial(b, r);
  }
  const double r = std::sqrt(-reproducible_log(q < 0 ? p : 1 - p));
  const double x =
      r <= 5 ? polynomial(c, r - 1.6) / polynomial(d, r - 1.6) : polynomial(e, r - 5) / polynomial(f, r - 5);
  return q < 0 ? -x : x;
}

namespace {
// The functions of Boost.Math by operations in double precision, the same on every platform.
using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
}  // namespace

double gamma_of_normal(double shape, double normal) {
  SEAGLINT_CHECK(shape > 0, fmt::format("shape = {}", shape));
  const double tail = 0.5 * std::erfc(std::abs(normal) / std::sqrt(2.0));  // the smaller one, which loses no digits
  return normal < 0 ? boost::math::gamma_p_inv(shape, tail, InDouble())
                    : boost::math::gamma_q_inv(shape, tail, InDouble());
}

double student_quantile(double p, double degrees_of_freedom) {
  SEAGLINT_CHECK(p > 0 && p < 1 && degrees_of_freedom > 0, fmt::format("p = {}, {} degrees", p, degrees_of_freedom));
  return quantile(boost::math::students_t_distribution<double, InDouble>(degrees_of_freedom), p);
}

}  // namespace seaglint
