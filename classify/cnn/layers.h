// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The layers of a Network and their training in libtorch. clang compiles libtorch 1.13 as C++17 only (as C++20 it
// instantiates a vector of a type that is not complete), so that this header and its source are C++17.

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace seaglint {

// Weights or biases of a layer.
struct Parameter {
  std::string name;  // "conv1.weight"
  float* values = nullptr;
  std::size_t count = 0;
  int dimensions = 0;
  std::size_t outputs = 0;  // extent of the first dimension
};

// Throws WorkError for an error of the library, std::bad_alloc where memory is short.
class Layers {
 public:
  // Maps of rows x columns cells. The weights are the library's until parameters() are set.
  Layers(int embedding_size, int threads, std::size_t rows, std::size_t columns);

  std::vector<Parameter> parameters();  // in the order of the layers

  void start_training(double learning_rate);  // Adam (Kingma and Ba 2015)
  // One step with `count` maps [count][rows][columns] and their labels 0 or 1; mean binary cross-entropy before it.
  double train(const float* maps, const float* labels, std::size_t count);
  // Appends embeddings [count][embedding_size] and logits [count].
  void embed(const float* maps, std::size_t count, std::vector<float>& embeddings, std::vector<float>& logits);

 private:
  struct Plane;
  struct Optimiser;
  std::size_t rows_, columns_;
  int threads_;
  std::shared_ptr<Plane> plane_;
  std::shared_ptr<Optimiser> optimiser_;
};

}  // namespace seaglint
