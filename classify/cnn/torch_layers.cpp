// SPDX-License-Identifier: BSD-3-Clause
#include "classify/cnn/torch_layers.h"

#include <torch/nn/modules/conv.h>
#include <torch/nn/modules/linear.h>
#include <torch/nn/modules/normalization.h>
#include <torch/optim/adam.h>

#include <cstring>
#include <new>

#include "sim/core/process/error.h"

namespace seaglint {
namespace {

constexpr int kChannels[3] = {8, 16, 32};
constexpr int kGroups =
    4;  // of the group normalisation (Wu and He 2018): no running statistics, the same in training and use

torch::nn::Conv2d convolution(int in, int out) {
  return torch::nn::Conv2d(torch::nn::Conv2dOptions(in, out, 3).padding(1));
}

// An error of the library without its call stack; one of memory as std::bad_alloc.
[[noreturn]] void fail(const c10::Error& error) {
  const std::string reason = error.what_without_backtrace();
  if (reason.find("allocate memory") != std::string::npos) throw std::bad_alloc();
  throw WorkError("network: " + reason);
}

void make_deterministic(int threads) {
  at::set_num_threads(threads);
  at::globalContext().setDeterministicAlgorithms(true, false);
}

torch::Tensor tensor_of(const float* values, std::vector<std::int64_t> shape) {
  torch::Tensor tensor = torch::empty(shape);
  std::memcpy(tensor.data_ptr<float>(), values, static_cast<std::size_t>(tensor.numel()) * sizeof(float));
  return tensor;
}

struct Plane : torch::nn::Module {
  explicit Plane(int embedding_size)
      : conv1(register_module("conv1", convolution(1, kChannels[0]))),
        conv2(register_module("conv2", convolution(kChannels[0], kChannels[1]))),
        conv3(register_module("conv3", convolution(kChannels[1], kChannels[2]))),
        norm1(register_module("norm1", torch::nn::GroupNorm(kGroups, kChannels[0]))),
        norm2(register_module("norm2", torch::nn::GroupNorm(kGroups, kChannels[1]))),
        norm3(register_module("norm3", torch::nn::GroupNorm(kGroups, kChannels[2]))),
        dense(register_module("dense", torch::nn::Linear(2 * kChannels[2], embedding_size))),
        last(register_module("last", torch::nn::Linear(embedding_size, 1))) {}

  // maps: [n][1][rows][columns]
  torch::Tensor embedding(torch::Tensor maps) {
    maps = torch::max_pool2d(torch::relu(norm1(conv1(maps))), 2);
    maps = torch::max_pool2d(torch::relu(norm2(conv2(maps))), 2);
    maps = torch::relu(norm3(conv3(maps)));
    return torch::relu(dense(torch::cat({maps.mean({2, 3}), maps.amax({2, 3})}, 1)));
  }

  torch::nn::Conv2d conv1, conv2, conv3;
  torch::nn::GroupNorm norm1, norm2, norm3;
  torch::nn::Linear dense, last;
};

class TorchLayers : public Layers {
 public:
  TorchLayers(int embedding_size, int threads, std::size_t rows, std::size_t columns)
      : rows_(rows), columns_(columns), threads_(threads), plane_(embedding_size) {}

  std::vector<Parameter> parameters() override;
  void start_training(double learning_rate) override;
  double train(const float* maps, const float* labels, std::size_t count) override;
  void embed(const float* maps, std::size_t count, std::vector<float>& embeddings, std::vector<float>& logits) override;

 private:
  std::size_t rows_, columns_;
  int threads_;
  Plane plane_;
  std::unique_ptr<torch::optim::Adam> optimiser_;
};

std::vector<Parameter> TorchLayers::parameters() {
  std::vector<Parameter> all;
  for (auto& entry : plane_.named_parameters()) {
    torch::Tensor& values = entry.value();
    all.push_back({entry.key(), values.data_ptr<float>(), static_cast<std::size_t>(values.numel()),
                   static_cast<int>(values.dim()), static_cast<std::size_t>(values.size(0))});
  }
  return all;
}

void TorchLayers::start_training(double learning_rate) try {
  make_deterministic(threads_);
  optimiser_ = std::make_unique<torch::optim::Adam>(plane_.parameters(), torch::optim::AdamOptions(learning_rate));
} catch (const c10::Error& error) {
  fail(error);
}

double TorchLayers::train(const float* maps, const float* labels, std::size_t count) try {
  const auto n = static_cast<std::int64_t>(count);
  const torch::Tensor truth = tensor_of(labels, {n});
  const torch::Tensor inputs =
      tensor_of(maps, {n, 1, static_cast<std::int64_t>(rows_), static_cast<std::int64_t>(columns_)});
  optimiser_->zero_grad();
  const torch::Tensor logits = plane_.last(plane_.embedding(inputs)).squeeze(1);
  const torch::Tensor loss = torch::binary_cross_entropy_with_logits(logits, truth);
  loss.backward();
  optimiser_->step();
  return loss.item<double>();
} catch (const c10::Error& error) {
  fail(error);
}

void TorchLayers::embed(const float* maps, std::size_t count, std::vector<float>& embeddings,
                        std::vector<float>& logits) try {
  make_deterministic(threads_);
  torch::NoGradGuard no_gradient;
  const torch::Tensor inputs = tensor_of(maps, {static_cast<std::int64_t>(count), 1, static_cast<std::int64_t>(rows_),
                                                static_cast<std::int64_t>(columns_)});
  const torch::Tensor embedding = plane_.embedding(inputs).contiguous();
  const torch::Tensor logit = plane_.last(embedding).contiguous();
  embeddings.insert(embeddings.end(), embedding.data_ptr<float>(), embedding.data_ptr<float>() + embedding.numel());
  logits.insert(logits.end(), logit.data_ptr<float>(), logit.data_ptr<float>() + logit.numel());
} catch (const c10::Error& error) {
  fail(error);
}

}  // namespace
}  // namespace seaglint

seaglint::Layers* seaglint_torch_layers(int embedding_size, int threads, std::size_t rows, std::size_t columns) try {
  return new seaglint::TorchLayers(embedding_size, threads, rows, columns);
} catch (const c10::Error& error) {
  seaglint::fail(error);
}
