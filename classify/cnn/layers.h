// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The layers of a Network and their gradients in libtorch: the shared library seaglint_layers, the only part of the
// program with libtorch. It takes 0.4 s and 560 MB of address space to load and is loaded when the first layers are
// made (network.h). C++17: as C++20 clang instantiates a vector of an incomplete type in libtorch 1.13.

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

// Extents of the images; rows and columns are multiples of 8.
struct LayerSizes {
  std::size_t channels = 0, rows = 0, columns = 0;
  int embedding_size = 0;
  int outputs = 1;  // 1: the logit of label 1 of two classes; more: one of every class
};

// One thread at a time; every function computes on the thread that calls it. Throws WorkError for an error of the
// library, std::bad_alloc where memory is short.
class Layers {
 public:
  virtual ~Layers() = default;

  virtual std::vector<Parameter> parameters() = 0;  // in the order of the layers

  // Sum of the cross-entropies of `count` images [count][channels][rows][columns] with their labels, binary with one
  // output, else of the softmax of the outputs; its gradient, of all parameters in their order, replaces `gradient`.
  virtual double gradient(const float* images, const float* labels, std::size_t count,
                          std::vector<float>& gradient) = 0;
  virtual void start_training(double learning_rate) = 0;      // Adam (Kingma and Ba 2015)
  virtual void step(const std::vector<float>& gradient) = 0;  // one step of it

  // Appends embeddings [count][embedding_size] and logits [count][outputs].
  virtual void embed(const float* images, std::size_t count, std::vector<float>& embeddings,
                     std::vector<float>& logits) = 0;
};

}  // namespace seaglint

// The library's layers of these sizes, owned by the caller. Throws WorkError, std::bad_alloc.
extern "C" seaglint::Layers* seaglint_torch_layers(const seaglint::LayerSizes& sizes);
