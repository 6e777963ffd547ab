// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Small convolutional network that classifies a map by the images of its scattering centres; its embedding is the
// paper's lambda_CNN.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "classify/cnn/network_input.h"
#include "sim/core/process/parallel.h"
#include "sim/scenario/learning_spec.h"

namespace seaglint {

// Outputs of the network per map: `size` embedding values and the logit of label 1, of more than two classes one logit
// of each.
struct Embeddings {
  std::size_t size = 0;
  std::size_t outputs = 1;
  std::vector<float> values;  // [map][size]
  std::vector<float> logits;  // [map][outputs]
};

// Rows of the maps: weights follow `fit` only, `validation` selects the epoch whose weights are kept. Without
// validation rows they are those of the last epoch.
struct NetworkRows {
  std::span<const std::size_t> fit;
  std::span<const std::size_t> validation;
};

// Mean cross-entropies by epoch, and the number of epochs after which the weights were kept.
struct TrainingHistory {
  std::vector<double> fit;         // of the varied maps, while the weights change
  std::vector<double> validation;  // of the maps themselves, after the epoch; empty without validation rows
  int epochs = 0;
};

// Three blocks of 3 x 3 convolution (8, 16, 16 channels), group normalisation, ReLU and 2 x 2 maximum pooling; a dense
// layer of `embedding_size` with leaky ReLU over all cells that are left, one logit, or one of every class of more than
// two. About 8,000 parameters.
class Network {
 public:
  // Trains with cross-entropy (binary; of more than two classes that of the softmax) and Adam (Kingma and Ba 2015) on
  // varied versions of the maps (network_input.h), at most spec.epochs passes; ends when spec.patience epochs have not
  // lowered the loss of the validation rows. Weights, the order of the batches and the variations come from stream
  // kNetwork of (seed, index). Repeats bit for bit for any spec.threads on one kind of processor. Throws Interrupted
  // when *stop becomes true.
  static Network train(std::span<const CentreList> maps, const NetworkRows& rows, std::span<const int> labels,
                       const LearningSpec& spec, std::uint64_t seed, std::uint64_t index,
                       const StopFlag* stop = nullptr, std::size_t classes = 2);
  static Network load(const std::filesystem::path& file);  // throws InputError when the file is not such a network

  Embeddings embed(std::span<const CentreList> maps) const;
  void save(const std::filesystem::path& file) const;  // throws WorkError
  std::size_t parameter_count() const;
  std::size_t classes() const;
  const TrainingHistory& history() const;  // empty when loaded

 private:
  struct State;
  explicit Network(std::shared_ptr<State> state) : state_(std::move(state)) {}
  std::shared_ptr<State> state_;
};

// Loads libtorch, which stays loaded; making a network does the same. Throws WorkError where it cannot be loaded.
void load_layers_library();

}  // namespace seaglint
