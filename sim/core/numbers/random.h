// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Counter-based random numbers, keyed by (seed, stream, index): identical on every machine, compiler and thread count,
// and independent of the order of calls between keys. Philox4x32-10 of Salmon, Moraes, Dror and Shaw, "Parallel random
// numbers: as easy as 1, 2, 3" (SC11); normal deviates by AS 241 (Wichura 1988) with a logarithm of IEEE-exact
// operations only.

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace seaglint {

// Purpose of a random stream. The values are part of the data format and must not change.
enum class Stream : std::uint32_t {
  kWaveFrequency = 1,
  kWavePhase = 2,
  kFloatYaw = 3,
  kHopCode = 4,
  kClutter = 5,
  kNoise = 6,
  kSplit = 7,
  kNetwork = 8,
  kBootstrap = 9,
  kEmbeddingPlot = 10,
  kTargetOrder = 11,
  kWaveDirection = 12,
  kWaveAmplitude = 13,
  kTexture = 14,
  kClutterPlace = 15,
  kPriJitter = 16,
  kMeshChange = 17,
  kRayLattice = 18,
  kDraw = 19,
  kLayout = 20,
  kDecoy = 21,
  kShip = 22,
  kDrift = 23,
  kTest = 1000,
};

struct RandomKey {
  std::uint64_t seed = 0;
  Stream stream = Stream::kTest;
  std::uint64_t index = 0;  // realisation, interval or sample
};

// Philox4x32-10 block function (Salmon et al. 2011, section 3.3).
std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

// The sequence of one key. Copying it copies the position.
class Random {
 public:
  explicit Random(const RandomKey& key);

  std::uint64_t bits();                      // 64 uniform bits
  double uniform();                          // in (0, 1), 52 bits, never 0 or 1
  double normal();                           // mean 0, variance 1
  std::uint32_t below(std::uint32_t count);  // integer in [0, count), unbiased; count >= 1

 private:
  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 4> block_{};
  int used_ = 4;  // words of block_ already used
};

// Puts the values into a random order (Fisher and Yates); fewer than 2^32.
template <class T>
void shuffle(std::vector<T>& values, Random& random) {
  for (std::size_t i = values.size(); i > 1; --i)
    std::swap(values[i - 1], values[random.below(static_cast<std::uint32_t>(i))]);
}

// Quantile of the normal distribution, |error| < 1e-15 relative (Wichura 1988, AS 241, PPND16); p in (0, 1).
double normal_quantile(double p);

// The gamma variate of scale 1 that is exceeded as often as a standard normal variate exceeds `normal`: maps a Gaussian
// field to a gamma field of equal ranks. shape > 0.
double gamma_of_normal(double shape, double normal);

// Quantile of Student's distribution; p in (0, 1), degrees of freedom > 0, also fractions and infinity.
double student_quantile(double p, double degrees_of_freedom);

}  // namespace seaglint
