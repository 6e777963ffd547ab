// SPDX-License-Identifier: BSD-3-Clause
#include "classify/cnn/network.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <thread>

#include "classify/cnn/network_input.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"

namespace seaglint {
namespace {

std::vector<float> noise_map(std::size_t rows, std::size_t columns, std::uint64_t index) {
  Random random({3, Stream::kTest, index});
  std::vector<float> map(rows * columns);
  for (float& value : map) value = static_cast<float>(std::abs(random.normal()));
  return map;
}

TEST(NetworkInput, InvariantToMapScale) {
  const std::vector<float> map = noise_map(64, 256, 1);
  std::vector<float> amplified = map;
  for (float& value : amplified) value *= 1024;  // a power of two, so that mantissas do not change
  const std::vector<float> input = network_input(map, 64, 256, -60);
  EXPECT_EQ(input, network_input(amplified, 64, 256, -60));
  for (float& value : amplified) value *= 1.7f;
  const std::vector<float> scaled = network_input(amplified, 64, 256, -60);
  // Float rounding of the scaled cells: 6e-8 relative, 8.7 dB per neper, 60 dB full scale, and a float result.
  for (std::size_t i = 0; i < input.size(); ++i) EXPECT_NEAR(scaled[i], input[i], 2e-7);
}

TEST(NetworkInput, IsOneInTheWindowOfAllEnergyAndZeroElsewhere) {
  std::vector<float> map(64 * 128, 0.0f);
  map[10 * 128 + 20] = 3;
  const std::vector<float> input = network_input(map, 64, 128, -40);
  for (std::size_t i = 0; i < input.size(); ++i) EXPECT_EQ(input[i], i == 10 * 128 + 20 ? 1.0f : 0.0f);
}

TEST(NetworkInput, IsTheLevelInDecibelsAboveTheFloor) {
  std::vector<float> map(64 * 128, 0.0f);
  map[0] = 1;
  map[1] = 0.1f;
  const std::vector<float> input = network_input(map, 64, 128, -40);
  // 0.01 of the power is -20 dB: half of a floor of -40 dB; the total is 1.01.
  EXPECT_NEAR(input[1], 0.5 - 10 * std::log10(1.01) / 40, 1e-6);
}

TEST(NetworkInput, AcceptsMapsOfAnySize) {
  for (const auto& [rows, columns] : {std::pair<std::size_t, std::size_t>{1, 1}, {3, 500}, {200, 7}, {65, 129}}) {
    const std::vector<float> input = network_input(noise_map(rows, columns, 2), rows, columns, -40);
    ASSERT_EQ(input.size(), kInputCells);
    for (const float value : input) {
      EXPECT_GE(value, 0.0f);
      EXPECT_LE(value, 1.0f);
    }
  }
  EXPECT_EQ(network_input(std::vector<float>(12, 0.0f), 3, 4, -40), std::vector<float>(kInputCells, 0.0f));
}

// Maps with a sloping line (label 1) or four loose blobs (label 0) in noise.
struct Toy {
  std::vector<float> inputs;
  std::vector<int> labels;
  std::vector<std::size_t> rows;
};

Toy toy_maps(std::size_t count) {
  Toy toy;
  for (std::size_t i = 0; i < count; ++i) {
    Random random({4, Stream::kTest, i});
    std::vector<float> map = noise_map(64, 128, 1000 + i);
    const int label = static_cast<int>(i % 2);
    if (label == 1) {
      for (std::size_t k = 0; k < 60; ++k) map[(20 + k / 4 + random.below(2)) * 128 + 30 + k] += 10;
    } else {
      for (int blob = 0; blob < 4; ++blob) {
        for (int k = 0; k < 15; ++k)
          map[(10 + random.below(40)) * 128 + 20 + 25 * static_cast<std::size_t>(blob)] += 10;
      }
    }
    const std::vector<float> input = network_input(map, 64, 128, -50);
    toy.inputs.insert(toy.inputs.end(), input.begin(), input.end());
    toy.labels.push_back(label);
    toy.rows.push_back(i);
  }
  return toy;
}

LearningSpec short_training() {
  LearningSpec spec;
  spec.epochs = 4;
  spec.batch_size = 8;
  return spec;
}

TEST(Network, RepeatsBitForBitOnAnyThread) {
  const Toy toy = toy_maps(16);
  const auto logits = [&] {
    return Network::train(toy.inputs, toy.rows, toy.labels, short_training(), 42, 0).embed(toy.inputs).logits;
  };
  const std::vector<float> first = logits();
  EXPECT_EQ(logits(), first);
  std::vector<float> a, b;
  std::thread one([&] { a = logits(); }), two([&] { b = logits(); });
  one.join();
  two.join();
  EXPECT_EQ(a, first);
  EXPECT_EQ(b, first);
}

TEST(Network, DependsOnItsSeed) {
  const Toy toy = toy_maps(8);
  const auto logits = [&](std::uint64_t seed) {
    return Network::train(toy.inputs, toy.rows, toy.labels, short_training(), seed, 0).embed(toy.inputs).logits;
  };
  EXPECT_NE(logits(42), logits(43));
}

TEST(Network, LearnsShapesWithFewParameters) {
  const Toy toy = toy_maps(64);
  LearningSpec spec = short_training();
  spec.epochs = 40;
  spec.learning_rate = 0.003;
  const Network network = Network::train(toy.inputs, std::span(toy.rows).first(48), toy.labels, spec, 42, 0);
  EXPECT_LT(network.losses().back(), 0.5 * network.losses().front());
  const Embeddings embeddings = network.embed(toy.inputs);
  ASSERT_EQ(embeddings.values.size(), 64u * embeddings.size);
  int right = 0;
  for (std::size_t i = 48; i < 64; ++i) right += (embeddings.logits[i] > 0) == (toy.labels[i] == 1) ? 1 : 0;
  EXPECT_GE(right, 14) << "of 16 maps outside the training set";
  EXPECT_LE(network.parameter_count(), 25000u);
}

TEST(Network, ReloadsFromItsFileAndRejectsBrokenOnes) {
  const Toy toy = toy_maps(8);
  const Network network = Network::train(toy.inputs, toy.rows, toy.labels, short_training(), 42, 0);
  const auto file =
      std::filesystem::temp_directory_path() / ("seaglint_network_" + std::to_string(::getpid()) + ".bin");
  network.save(file);
  EXPECT_EQ(Network::load(file).embed(toy.inputs).logits, network.embed(toy.inputs).logits);
  const std::string bytes = read_file(file);
  for (const std::string& broken :
       {std::string(), std::string("text that is long enough"), bytes.substr(0, bytes.size() - 1), bytes + "x"}) {
    write_file(file, broken);
    EXPECT_THROW(Network::load(file), InputError) << broken.size() << " bytes";
  }
  std::filesystem::remove(file);
}

TEST(Network, StopsWhenTheFlagIsSet) {
  const Toy toy = toy_maps(8);
  const StopFlag stop{true};
  EXPECT_THROW(Network::train(toy.inputs, toy.rows, toy.labels, short_training(), 42, 0, &stop), Interrupted);
}

}  // namespace
}  // namespace seaglint
