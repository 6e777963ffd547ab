// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <thread>

#include "classify/cnn/network.h"
#include "classify/features/feature_vector.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "tests/temporary_folder.h"

namespace seaglint {

namespace {

// Geometry-matched pairs: four equal reflectors 40 m apart, seen at an angle, with the velocity error of a centre 36 dB
// above clutter. Label 1: welded to a body that rotates; label 0: each with a velocity of its own. Both have the same
// velocity spreads on average, so that neither number, range nor velocity spread separates them.
struct MatchedSet {
  std::vector<CentreList> maps;
  std::vector<int> labels;
};

MatchedSet matched_set(std::size_t count) {
  MatchedSet set;
  for (std::size_t i = 0; i < count; ++i) {
    Random random({4, Stream::kTest, i});
    const int label = static_cast<int>(i % 2);
    const double cosine = 0.17 + 0.8 * random.uniform(), spread_mps = 0.03 + 0.1 * random.uniform();
    const double mean_mps = 0.1 * random.normal(), sign = random.below(2) == 0 ? 1 : -1;
    CentreList centres;
    for (const double x : {-60.0, -20.0, 20.0, 60.0}) {
      // x / 44.7 m has the standard deviation 1 over the four places.
      const double velocity = label == 1 ? sign * x / 44.7 : 1.15 * random.normal();  // 1.15^2 = 4/3 of four samples
      centres.push_back({x * cosine + 0.02 * random.normal(),
                         mean_mps + spread_mps * velocity + 0.0006 * random.normal(), 1 + 0.2 * random.normal()});
    }
    set.maps.push_back(centres);
    set.labels.push_back(label);
  }
  return set;
}

std::vector<std::size_t> range_of(std::size_t begin, std::size_t end) {
  std::vector<std::size_t> rows(end - begin);
  std::iota(rows.begin(), rows.end(), begin);
  return rows;
}

LearningSpec short_training() {
  LearningSpec spec;
  spec.epochs = 3;
  spec.batch_size = 20;  // parts of 8, 8 and 4 maps
  return spec;
}

Network trained(const MatchedSet& set, const LearningSpec& spec, std::uint64_t seed = 42) {
  return Network::train(set.maps, {range_of(0, set.maps.size()), {}}, set.labels, spec, seed, 0);
}

TEST(Network, RepeatsBitForBitOnAnyThread) {
  const MatchedSet set = matched_set(24);
  const auto logits = [&] { return trained(set, short_training()).embed(set.maps).logits; };
  const std::vector<float> first = logits();
  EXPECT_EQ(logits(), first);
  std::vector<float> a, b;
  std::thread one([&] { a = logits(); }), two([&] { b = logits(); });
  one.join();
  two.join();
  EXPECT_EQ(a, first);
  EXPECT_EQ(b, first);
}

TEST(Network, DoesNotDependOnTheNumberOfThreads) {
  const MatchedSet set = matched_set(24);
  LearningSpec spec = short_training();
  const std::vector<float> first = trained(set, spec).embed(set.maps).logits;
  for (const int threads : {2, 3, 5}) {
    spec.threads = threads;
    EXPECT_EQ(trained(set, spec).embed(set.maps).logits, first) << threads << " threads";
  }
}

TEST(Network, DependsOnItsSeed) {
  const MatchedSet set = matched_set(8);
  EXPECT_NE(trained(set, short_training(), 42).embed(set.maps).logits,
            trained(set, short_training(), 43).embed(set.maps).logits);
}

class MatchedTraining : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    set_ = matched_set(400);
    network_ = Network::train(set_.maps, {range_of(0, 160), range_of(160, 200)}, set_.labels, LearningSpec{}, 42, 0);
    embeddings_ = network_->embed(set_.maps);
  }

  static inline MatchedSet set_;
  static inline std::optional<Network> network_;
  static inline Embeddings embeddings_;
};

TEST_F(MatchedTraining, SeparatesARigidLineFromFreePointsOfTheSameSpreads) {
  int right = 0;
  for (std::size_t i = 200; i < 400; ++i) right += (embeddings_.logits[i] > 0) == (set_.labels[i] == 1) ? 1 : 0;
  EXPECT_GT(right, 180) << "of 200 maps that neither weights nor epoch were chosen by";
  EXPECT_LE(network_->parameter_count(), 10000u);
}

TEST_F(MatchedTraining, LeavesEveryUnitAlive) {
  ASSERT_EQ(embeddings_.values.size(), 400 * embeddings_.size);
  for (std::size_t k = 0; k < embeddings_.size; ++k) {
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < 400; ++i) {
      const double value = embeddings_.values[i * embeddings_.size + k];
      sum += value / 400;
      squares += value * value / 400;
    }
    // A unit that is alive varies from map to map by more than a hundredth of its size.
    EXPECT_GT(std::sqrt(squares - sum * sum), 0.01 * std::sqrt(squares)) << "unit " << k;
    EXPECT_GT(squares, 1e-6) << "unit " << k;
  }
}

TEST_F(MatchedTraining, KeepsTheWeightsOfTheEpochWithTheSmallestValidationLoss) {
  const TrainingHistory& history = network_->history();
  ASSERT_EQ(history.validation.size(), history.fit.size());
  const auto best = std::min_element(history.validation.begin(), history.validation.end());
  EXPECT_EQ(history.epochs, best - history.validation.begin() + 1);
  EXPECT_LE(static_cast<int>(history.fit.size()), history.epochs + LearningSpec{}.patience);

  double loss = 0;
  for (std::size_t i = 160; i < 200; ++i) {
    const double logit = embeddings_.logits[i];
    loss += std::log1p(std::exp(set_.labels[i] == 1 ? -logit : logit)) / 40;
  }
  EXPECT_NEAR(loss, *best, 1e-6 * (1 + *best));  // float logits
}

TEST(Network, ReloadsFromItsFileAndRejectsBrokenOnes) {
  const MatchedSet set = matched_set(8);
  LearningSpec spec = short_training();
  spec.map_floor_db = -33.3;
  const Network network = trained(set, spec);
  const TemporaryFolder folder;
  const auto file = folder.path() / "network.bin";
  network.save(file);
  EXPECT_EQ(Network::load(file).embed(set.maps).logits, network.embed(set.maps).logits);
  const std::string bytes = read_file(file), nan("\0\0\xc0\x7f", 4);
  for (const std::string& broken :
       {std::string(), std::string("text that is long enough"), bytes.substr(0, bytes.size() - 1), bytes + "x",
        bytes.substr(0, 8) + nan + bytes.substr(12), "3NGS" + bytes.substr(4),
        bytes.substr(0, bytes.size() - 4) + nan}) {
    write_file(file, broken);
    EXPECT_THROW(Network::load(file), InputError) << broken.size() << " bytes";
  }
}

TEST(Network, StopsWhenTheFlagIsSet) {
  const MatchedSet set = matched_set(8);
  const StopFlag stop{true};
  EXPECT_THROW(Network::train(set.maps, {range_of(0, 8), {}}, set.labels, short_training(), 42, 0, &stop), Interrupted);
}

// Rotating lines, free points and lines of three centres: three outputs, one logit of each class.
TEST(Network, OfThreeClassesSeparatesThemAndReloads) {
  MatchedSet set = matched_set(240);
  for (std::size_t i = 0; i < set.maps.size(); i += 3) {
    set.labels[i] = 2;
    set.maps[i].pop_back();
  }
  const auto train = [&](const LearningSpec& spec) {
    return Network::train(set.maps, {range_of(0, 120), range_of(120, 160)}, set.labels, spec, 42, 0, nullptr, 3);
  };
  const Network network = train(LearningSpec{});
  const Embeddings outputs = network.embed(set.maps);
  ASSERT_EQ(outputs.outputs, 3u);
  ASSERT_EQ(outputs.logits.size(), 3 * set.maps.size());
  int right = 0;
  for (std::size_t i = 160; i < 240; ++i) {
    const auto logits = outputs.logits.begin() + static_cast<std::ptrdiff_t>(3 * i);
    right += std::max_element(logits, logits + 3) - logits == set.labels[i] ? 1 : 0;
  }
  EXPECT_GT(right, 64);  // of 80

  LearningSpec spec = short_training();
  const std::vector<float> first = train(spec).embed(set.maps).logits;
  spec.threads = 3;
  EXPECT_EQ(train(spec).embed(set.maps).logits, first);

  const TemporaryFolder folder;
  const auto file = folder.path() / "three.bin";
  network.save(file);
  EXPECT_EQ(Network::load(file).embed(set.maps).logits, outputs.logits);
  EXPECT_EQ(Network::load(file).classes(), 3u);
  const std::string bytes = read_file(file);
  for (const char count : {'\x02', '\x04', '\x0b'}) {
    write_file(file, bytes.substr(0, 16) + count + bytes.substr(17));
    EXPECT_THROW(Network::load(file), InputError) << static_cast<int>(count) << " classes";
  }
}

constexpr std::size_t kPlane = kInputRows * kInputColumns;

CentreList random_centres(std::size_t count, std::uint64_t index) {
  Random random({3, Stream::kTest, index});
  CentreList centres;
  for (std::size_t i = 0; i < count; ++i)
    centres.push_back({30 * random.normal(), 0.2 * random.normal(), 0.1 + random.uniform()});
  return centres;
}

void expect_near(const std::vector<float>& a, const std::vector<float>& b, std::size_t begin, double bound) {
  for (std::size_t i = begin; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], bound) << "cell " << i;
}

TEST(NetworkInput, DoesNotDependOnLevelPlaceAndMeanVelocity) {
  const CentreList centres = random_centres(12, 1);
  CentreList other = centres;
  for (ScatteringCentre& centre : other) {
    centre.amplitude_m *= 1734;
    centre.range_m += 41.5;
    centre.velocity_mps -= 2.25;
  }
  // Rounding of a range of 100 m, 1e-14, times the steepest slope of the images, below 100 per metre or m/s.
  expect_near(network_input(other, -40), network_input(centres, -40), 0, 1e-6);
}

TEST(NetworkInput, HasAZoomThatDoesNotDependOnAConstantRotation) {
  const CentreList centres = random_centres(12, 2);
  CentreList other = centres;
  for (ScatteringCentre& centre : other) centre.velocity_mps += 0.004 * centre.range_m;
  const std::vector<float> a = network_input(centres, -40), b = network_input(other, -40);
  expect_near(a, b, kPlane, 1e-6);
  EXPECT_FALSE(std::equal(a.begin(), a.begin() + kPlane, b.begin()));
}

// Three equal centres: the mean range and velocity are those of the middle one, and 10 log10(3) = 4.77 dB is their
// level below the sum.
TEST(NetworkInput, HasTheCentresAtTheirPlaces) {
  const std::vector<float> input = network_input(CentreList{{-30, 0.5, 2}, {0, 0, 2}, {30, -0.5, 2}}, -40);
  const double height = 1 - 10 * std::log10(3) / 40;
  // Overview: column 0.5 (x + 1) 64 - 0.5, x = 30/96; row 0.5 (y + 1) 32 - 0.5, y = 0.5. Distances from the cell.
  const auto gauss = [&](double rows, double columns) {
    return height * std::exp(-0.5 * (rows * rows + columns * columns) / (0.8 * 0.8));
  };
  EXPECT_NEAR(input[8 * kInputColumns + 42], gauss(0.5, 0.5), 1e-6);   // place 7.5, 41.5
  EXPECT_NEAR(input[23 * kInputColumns + 22], gauss(0.5, 0.5), 1e-6);  // place 23.5, 21.5
  EXPECT_NEAR(input[16 * kInputColumns + 32], gauss(0.5, 0.5), 1e-6);  // place 15.5, 31.5
  EXPECT_EQ(input[0], 0);
  // Zoom: on a line, so all in the middle row.
  for (std::size_t row = 0; row < kInputRows; ++row) {
    const float* const begin = &input[kPlane + row * kInputColumns];
    const float highest = *std::max_element(begin, begin + kInputColumns);
    if (row == 15 || row == 16) {
      EXPECT_GT(highest, 0.5);
    }
    if (row < 12 || row > 19) {
      EXPECT_EQ(highest, 0);
    }
  }
}

TEST(NetworkInput, AcceptsAnyCentres) {
  EXPECT_EQ(network_input({}, -40), std::vector<float>(kInputCells, 0.0f));
  EXPECT_EQ(network_input(CentreList{{4, 1, 0}}, -40), std::vector<float>(kInputCells, 0.0f));
  for (const CentreList& centres : {CentreList{{4, 1, 1}}, CentreList{{4, 1, 1}, {4, 1, 1}},
                                    CentreList{{-1e6, 1e4, 1e-20}, {1e6, -1e4, 1e20}}, random_centres(1000, 3)}) {
    const std::vector<float> input = network_input(centres, -40);
    ASSERT_EQ(input.size(), kInputCells);
    for (const float value : input) {
      ASSERT_GE(value, 0.0f);
      ASSERT_LE(value, 1.0f);
    }
    EXPECT_GT(*std::max_element(input.begin(), input.end()), 0.0f);
  }
}

// What separates the classes is the residual from a line; a variation must not change its distribution.
TEST(Augmentation, KeepsTheResidualsFromTheLine) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    Random random({5, Stream::kTest, i});
    const CentreList centres = random_centres(4, 100 + i), other = observed_otherwise(centres, random);
    ASSERT_EQ(other.size(), centres.size());
    const VelocityLine line = robust_velocity_line(centres), changed = robust_velocity_line(other);
    for (std::size_t k = 0; k < centres.size(); ++k) {
      EXPECT_NEAR(std::abs(changed.residual(other[k])), std::abs(line.residual(centres[k])), 1e-12);
      EXPECT_EQ(other[k].amplitude_m, centres[k].amplitude_m);
    }
  }
}

TEST(Augmentation, OfARigidLineLeavesItALine) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    Random random({6, Stream::kTest, i});
    const CentreList line = {{-60, -0.11, 1}, {-20, -0.03, 2}, {20, 0.05, 1}, {60, 0.13, 0.5}};
    const CentreList other = observed_otherwise(line, random);
    const VelocityLine fit = robust_velocity_line(other);
    for (const ScatteringCentre& centre : other) EXPECT_NEAR(fit.residual(centre), 0, 1e-15);
  }
}

TEST(Augmentation, AddsErrorsOfTheStatedSize) {
  Random random({7, Stream::kTest, 0});
  const CentreList exact(20000, {5, 0.1, 1}), noisy = with_errors(exact, random);
  double range = 0, velocity = 0, level = 0;
  for (const ScatteringCentre& centre : noisy) {
    range += (centre.range_m - 5) * (centre.range_m - 5) / 20000;
    velocity += (centre.velocity_mps - 0.1) * (centre.velocity_mps - 0.1) / 20000;
    level += std::pow(20 * std::log10(centre.amplitude_m), 2) / 20000;
  }
  // Five standard errors of a standard deviation from 20,000 values: 5 / sqrt(40000) = 2.5 %.
  EXPECT_NEAR(std::sqrt(range), 0.02, 0.025 * 0.02);
  EXPECT_NEAR(std::sqrt(velocity), 0.001, 0.025 * 0.001);
  EXPECT_NEAR(std::sqrt(level), 1, 0.025);
}

}  // namespace

}  // namespace seaglint
