// SPDX-License-Identifier: BSD-3-Clause
#include "classify/cnn/network.h"

#include <fmt/format.h>
#include <torch/nn/modules/conv.h>
#include <torch/nn/modules/linear.h>
#include <torch/nn/modules/normalization.h>
#include <torch/optim/adam.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <numeric>
#include <string>

#include "classify/cnn/network_input.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"

namespace seaglint {

namespace {

constexpr int kChannels[3] = {8, 16, 32};
constexpr int kGroups =
    4;  // of the group normalisation (Wu and He 2018): no running statistics, the same in training and use
constexpr std::uint32_t kFormat = 0x53474e31;  // "SGN1"

torch::nn::Conv2d convolution(int in, int out) {
  return torch::nn::Conv2d(torch::nn::Conv2dOptions(in, out, 3).padding(1));
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

  // maps: [n][1][kInputRows][kInputColumns]
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

// He's initialisation (He et al. 2015): normal of variance 2 / fan-in; biases zero, normalisation one.
void initialise(Plane& plane, const RandomKey& key) {
  Random random(key);
  torch::NoGradGuard no_gradient;
  for (auto& entry : plane.named_parameters()) {
    torch::Tensor& values = entry.value();
    if (values.dim() < 2) {
      values.fill_(entry.key().starts_with("norm") && entry.key().ends_with("weight") ? 1.0 : 0.0);
      continue;
    }
    const double deviation = std::sqrt(2.0 * static_cast<double>(values.size(0)) / static_cast<double>(values.numel()));
    float* place = values.data_ptr<float>();
    for (std::int64_t i = 0; i < values.numel(); ++i) place[i] = static_cast<float>(deviation * random.normal());
  }
}

torch::Tensor gather(std::span<const float> inputs, std::span<const std::size_t> rows) {
  torch::Tensor batch = torch::empty({static_cast<std::int64_t>(rows.size()), 1, static_cast<std::int64_t>(kInputRows),
                                      static_cast<std::int64_t>(kInputColumns)});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::copy_n(inputs.begin() + static_cast<std::ptrdiff_t>(rows[i] * kInputCells), kInputCells,
                batch.data_ptr<float>() + i * kInputCells);
  }
  return batch;
}

}  // namespace

struct Network::Layers {
  explicit Layers(int size) : embedding_size(size), plane(std::make_shared<Plane>(size)) {}
  int embedding_size;
  int threads = 1;
  std::shared_ptr<Plane> plane;
  std::vector<double> losses;
};

Network Network::train(std::span<const float> inputs, std::span<const std::size_t> rows, std::span<const int> labels,
                       const LearningSpec& spec, std::uint64_t seed, std::uint64_t index, const StopFlag* stop) try {
  SEAGLINT_CHECK(!rows.empty() && inputs.size() == labels.size() * kInputCells,
                 fmt::format("{} rows, {} labels, {} values", rows.size(), labels.size(), inputs.size()));
  make_deterministic(spec.threads);
  auto layers = std::make_shared<Layers>(spec.embedding_size);
  layers->threads = spec.threads;
  initialise(*layers->plane, {seed, Stream::kNetwork, 2 * index});
  Random order_of_batches({seed, Stream::kNetwork, 2 * index + 1});
  torch::optim::Adam optimizer(layers->plane->parameters(), torch::optim::AdamOptions(spec.learning_rate));

  std::vector<std::size_t> order(rows.begin(), rows.end());
  const std::size_t batch_size = static_cast<std::size_t>(spec.batch_size);
  for (int epoch = 0; epoch < spec.epochs; ++epoch) {
    for (std::size_t i = order.size(); i > 1; --i) {
      std::swap(order[i - 1], order[order_of_batches.below(static_cast<std::uint32_t>(i))]);
    }
    double sum = 0;
    for (std::size_t begin = 0; begin < order.size(); begin += batch_size) {
      if (stop && *stop) throw Interrupted();
      const std::span<const std::size_t> batch(order.data() + begin, std::min(batch_size, order.size() - begin));
      torch::Tensor truth = torch::empty({static_cast<std::int64_t>(batch.size())});
      for (std::size_t i = 0; i < batch.size(); ++i) truth.data_ptr<float>()[i] = static_cast<float>(labels[batch[i]]);
      optimizer.zero_grad();
      const torch::Tensor logits = layers->plane->last(layers->plane->embedding(gather(inputs, batch))).squeeze(1);
      const torch::Tensor loss = torch::binary_cross_entropy_with_logits(logits, truth);
      loss.backward();
      optimizer.step();
      sum += loss.item<double>() * static_cast<double>(batch.size());
    }
    layers->losses.push_back(sum / static_cast<double>(order.size()));
  }
  return Network(std::move(layers));
} catch (const c10::Error& error) {
  fail(error);
}

Embeddings Network::embed(std::span<const float> inputs) const try {
  constexpr std::size_t kBatch = 64;
  make_deterministic(layers_->threads);
  torch::NoGradGuard no_gradient;
  Embeddings result;
  result.size = static_cast<std::size_t>(layers_->embedding_size);
  const std::size_t maps = inputs.size() / kInputCells;
  for (std::size_t begin = 0; begin < maps; begin += kBatch) {
    std::vector<std::size_t> rows(std::min(kBatch, maps - begin));
    std::iota(rows.begin(), rows.end(), begin);
    const torch::Tensor embedding = layers_->plane->embedding(gather(inputs, rows)).contiguous();
    const torch::Tensor logits = layers_->plane->last(embedding).contiguous();
    result.values.insert(result.values.end(), embedding.data_ptr<float>(),
                         embedding.data_ptr<float>() + embedding.numel());
    result.logits.insert(result.logits.end(), logits.data_ptr<float>(), logits.data_ptr<float>() + logits.numel());
  }
  return result;
} catch (const c10::Error& error) {
  fail(error);
}

std::size_t Network::parameter_count() const {
  std::size_t count = 0;
  for (const torch::Tensor& values : layers_->plane->parameters()) count += static_cast<std::size_t>(values.numel());
  return count;
}

const std::vector<double>& Network::losses() const { return layers_->losses; }

// The file: kFormat, embedding size, thread count, number of weights (uint32 each), then the weights (float32) in the
// order of the layers. The library's own archive would contain time stamps.
void Network::save(const std::filesystem::path& file) const {
  std::string bytes;
  const auto append = [&bytes](const void* data, std::size_t count) {
    bytes.append(static_cast<const char*>(data), count);
  };
  const std::uint32_t head[4] = {kFormat, static_cast<std::uint32_t>(layers_->embedding_size),
                                 static_cast<std::uint32_t>(layers_->threads),
                                 static_cast<std::uint32_t>(parameter_count())};
  append(head, sizeof head);
  for (const torch::Tensor& values : layers_->plane->parameters()) {
    append(values.contiguous().data_ptr<float>(), static_cast<std::size_t>(values.numel()) * sizeof(float));
  }
  write_file(file, bytes);
}

Network Network::load(const std::filesystem::path& file) {
  const std::string bytes = read_file(file, std::size_t{64} << 20);
  std::uint32_t head[4] = {};
  const auto fail = [&](const char* why) {
    throw InputError(fmt::format("{}: not a seaglint network: {}", file.string(), why));
  };
  if (bytes.size() < sizeof head) fail("too short");
  std::memcpy(head, bytes.data(), sizeof head);
  if (head[0] != kFormat) fail("it begins otherwise");
  if (head[1] < 1 || head[1] > 512 || head[2] < 1 || head[2] > 256) fail("its head is damaged");
  auto layers = std::make_shared<Layers>(static_cast<int>(head[1]));
  layers->threads = static_cast<int>(head[2]);
  Network network(layers);
  if (head[3] != network.parameter_count() || bytes.size() != sizeof head + head[3] * sizeof(float))
    fail("it is truncated or has a tail");
  torch::NoGradGuard no_gradient;
  const char* place = bytes.data() + sizeof head;
  for (const torch::Tensor& values : layers->plane->parameters()) {
    const std::size_t count = static_cast<std::size_t>(values.numel()) * sizeof(float);
    std::memcpy(values.data_ptr<float>(), place, count);
    place += count;
  }
  return network;
}

}  // namespace seaglint
