// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The layers of a Network and their training in libtorch, which takes 0.4 s and 560 MB of address space to load: it is
// loaded when the first layers are made. C++17, as the library's source (torch_layers.h).

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
  virtual ~Layers() = default;

  virtual std::vector<Parameter> parameters() = 0;  // in the order of the layers

  virtual void start_training(double learning_rate) = 0;  // Adam (Kingma and Ba 2015)
  // One step with `count` maps [count][rows][columns] and their labels 0 or 1; mean binary cross-entropy before it.
  virtual double train(const float* maps, const float* labels, std::size_t count) = 0;
  // Appends embeddings [count][embedding_size] and logits [count].
  virtual void embed(const float* maps, std::size_t count, std::vector<float>& embeddings,
                     std::vector<float>& logits) = 0;
};

// Loads libtorch, which stays loaded. Throws WorkError where it cannot be loaded.
void load_layers_library();

// Layers of maps of rows x columns cells. The weights are the library's until parameters() are set. Throws WorkError
// where libtorch cannot be loaded.
std::unique_ptr<Layers> make_layers(int embedding_size, int threads, std::size_t rows, std::size_t columns);

}  // namespace seaglint
