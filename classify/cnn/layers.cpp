// SPDX-License-Identifier: BSD-3-Clause
#include "classify/cnn/layers.h"

#include <torch/nn/modules/conv.h>
#include <torch/nn/modules/linear.h>
#include <torch/nn/modules/normalization.h>
#include <torch/optim/adam.h>

#include <cstring>
#include <new>

#include "sim/core/process/error.h"

namespace seaglint {
namespace {

constexpr int kChannels[3] = {8, 16, 16};
constexpr int kGroups =
    4;  // of the group normalisation (Wu and He 2018): no running statistics, the same in training and use
constexpr std::int64_t kPooling = 8;    // of rows and columns, by the three blocks together
constexpr double kNegativeSlope = 0.1;  // of the embedding's rectifier (Maas et al. 2013): the gradient is never zero

torch::nn::Conv2d convolution(std::int64_t in, int out) {
  return torch::nn::Conv2d(torch::nn::Conv2dOptions(in, out, 3).padding(1));
}

// An error of the library without its call stack; one of memory as std::bad_alloc.
[[noreturn]] void fail(const c10::Error& error) {
  const std::string reason = error.what_without_backtrace();
  if (reason.find("allocate memory") != std::string::npos) throw std::bad_alloc();
  throw WorkError("network: " + reason);
}

// The number of threads is a property of the thread that computes.
void make_deterministic() {
  at::set_num_threads(1);
  at::globalContext().setDeterministicAlgorithms(true, false);
}

torch::Tensor tensor_of(const float* values, const std::vector<std::int64_t>& shape) {
  torch::Tensor tensor = torch::empty(shape);
  std::memcpy(tensor.data_ptr<float>(), values, static_cast<std::size_t>(tensor.numel()) * sizeof(float));
  return tensor;
}

struct Plane : torch::nn::Module {
  explicit Plane(const LayerSizes& sizes)
      : conv1(register_module("conv1", convolution(static_cast<std::int64_t>(sizes.channels), kChannels[0]))),
        conv2(register_module("conv2", convolution(kChannels[0], kChannels[1]))),
        conv3(register_module("conv3", convolution(kChannels[1], kChannels[2]))),
        norm1(register_module("norm1", torch::nn::GroupNorm(kGroups, kChannels[0]))),
        norm2(register_module("norm2", torch::nn::GroupNorm(kGroups, kChannels[1]))),
        norm3(register_module("norm3", torch::nn::GroupNorm(kGroups, kChannels[2]))),
        dense(register_module("dense", torch::nn::Linear(cells_after_pooling(sizes), sizes.embedding_size))),
        last(register_module("last", torch::nn::Linear(sizes.embedding_size, sizes.outputs))) {}

  static std::int64_t cells_after_pooling(const LayerSizes& sizes) {
    return kChannels[2] * (static_cast<std::int64_t>(sizes.rows) / kPooling) *
           (static_cast<std::int64_t>(sizes.columns) / kPooling);
  }

  // images: [n][channels][rows][columns]
  torch::Tensor embedding(torch::Tensor images) {
    images = torch::max_pool2d(torch::relu(norm1(conv1(images))), 2);
    images = torch::max_pool2d(torch::relu(norm2(conv2(images))), 2);
    images = torch::max_pool2d(torch::relu(norm3(conv3(images))), 2);
    return torch::leaky_relu(dense(images.flatten(1)), kNegativeSlope);
  }

  torch::nn::Conv2d conv1, conv2, conv3;
  torch::nn::GroupNorm norm1, norm2, norm3;
  torch::nn::Linear dense, last;
};

class TorchLayers : public Layers {
 public:
  explicit TorchLayers(const LayerSizes& sizes) : sizes_(sizes), plane_(sizes) {}

  std::vector<Parameter> parameters() override;
  double gradient(const float* images, const float* labels, std::size_t count, std::vector<float>& gradient) override;
  void start_training(double learning_rate) override;
  void step(const std::vector<float>& gradient) override;
  void embed(const float* images, std::size_t count, std::vector<float>& embeddings,
             std::vector<float>& logits) override;

 private:
  torch::Tensor images_of(const float* values, std::size_t count) const {
    return tensor_of(values, {static_cast<std::int64_t>(count), static_cast<std::int64_t>(sizes_.channels),
                              static_cast<std::int64_t>(sizes_.rows), static_cast<std::int64_t>(sizes_.columns)});
  }

  LayerSizes sizes_;
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

double TorchLayers::gradient(const float* images, const float* labels, std::size_t count,
                             std::vector<float>& gradient) try {
  make_deterministic();
  plane_.zero_grad();
  const torch::Tensor logits = plane_.last(plane_.embedding(images_of(images, count)));
  const torch::Tensor truth = tensor_of(labels, {static_cast<std::int64_t>(count)});
  const torch::Tensor loss =
      sizes_.outputs == 1
          ? torch::binary_cross_entropy_with_logits(logits.squeeze(1), truth, {}, {}, at::Reduction::Sum)
          : torch::cross_entropy_loss(logits, truth.to(torch::kInt64), {}, at::Reduction::Sum);
  loss.backward();
  gradient.clear();
  for (const torch::Tensor& parameter : plane_.parameters()) {
    const torch::Tensor part = parameter.grad().contiguous();
    gradient.insert(gradient.end(), part.data_ptr<float>(), part.data_ptr<float>() + part.numel());
  }
  return loss.item<double>();
} catch (const c10::Error& error) {
  fail(error);
}

void TorchLayers::start_training(double learning_rate) try {
  make_deterministic();
  optimiser_ = std::make_unique<torch::optim::Adam>(plane_.parameters(), torch::optim::AdamOptions(learning_rate));
} catch (const c10::Error& error) {
  fail(error);
}

void TorchLayers::step(const std::vector<float>& gradient) try {
  make_deterministic();
  const float* place = gradient.data();
  for (const torch::Tensor& parameter : plane_.parameters()) {
    parameter.mutable_grad() = tensor_of(place, parameter.sizes().vec());
    place += parameter.numel();
  }
  optimiser_->step();
} catch (const c10::Error& error) {
  fail(error);
}

void TorchLayers::embed(const float* images, std::size_t count, std::vector<float>& embeddings,
                        std::vector<float>& logits) try {
  make_deterministic();
  torch::NoGradGuard no_gradient;
  const torch::Tensor embedding = plane_.embedding(images_of(images, count)).contiguous();
  const torch::Tensor logit = plane_.last(embedding).contiguous();
  embeddings.insert(embeddings.end(), embedding.data_ptr<float>(), embedding.data_ptr<float>() + embedding.numel());
  logits.insert(logits.end(), logit.data_ptr<float>(), logit.data_ptr<float>() + logit.numel());
} catch (const c10::Error& error) {
  fail(error);
}

}  // namespace
}  // namespace seaglint

seaglint::Layers* seaglint_torch_layers(const seaglint::LayerSizes& sizes) try {
  return new seaglint::TorchLayers(sizes);
} catch (const c10::Error& error) {
  seaglint::fail(error);
}
