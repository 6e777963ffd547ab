// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Small convolutional network that classifies a map as ship or array by its shape; its embedding is the paper's
// lambda_CNN.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scenario/learning_spec.h"

namespace seaglint {

// Outputs of the network: `size` embedding values and the logit of label 1, per map.
struct Embeddings {
  std::size_t size = 0;
  std::vector<float> values;  // [map][size]
  std::vector<float> logits;  // [map]
};

// Three blocks of 3 x 3 convolution (8, 16, 32 channels), group normalisation and ReLU, the first two followed by 2 x 2
// maximum pooling; mean and maximum of each channel over the plane, a dense layer of `embedding_size` with ReLU, one
// logit. About 6,500 parameters.
class Network {
 public:
  // Trains on the given rows of `inputs` ([map][kInputCells]) with binary cross-entropy and Adam (Kingma and Ba 2015).
  // Weights and the order of the batches come from stream kNetwork of (seed, index). Repeats bit for bit for one
  // spec.threads on one kind of processor. Throws Interrupted when *stop becomes true.
  static Network train(std::span<const float> inputs, std::span<const std::size_t> rows, std::span<const int> labels,
                       const LearningSpec& spec, std::uint64_t seed, std::uint64_t index,
                       const StopFlag* stop = nullptr);
  static Network load(const std::filesystem::path& file);  // throws InputError when the file is not such a network

  Embeddings embed(std::span<const float> inputs) const;  // [map][kInputCells]
  void save(const std::filesystem::path& file) const;     // throws WorkError
  std::size_t parameter_count() const;
  const std::vector<double>& losses() const;  // mean training loss per epoch; empty when loaded

 private:
  struct State;
  explicit Network(std::shared_ptr<State> state) : state_(std::move(state)) {}
  std::shared_ptr<State> state_;
};

}  // namespace seaglint
