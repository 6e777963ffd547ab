// SPDX-License-Identifier: BSD-3-Clause
#include "classify/cnn/network.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>

#include "classify/cnn/layers.h"
#include "classify/cnn/network_input.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"

namespace seaglint {

namespace {

constexpr std::uint32_t kFormat = 0x53474e31;  // "SGN1"

// He's initialisation (He et al. 2015): normal of variance 2 / fan-in; biases zero, normalisation one.
void initialise(Layers& layers, const RandomKey& key) {
  Random random(key);
  for (const Parameter& parameter : layers.parameters()) {
    const bool is_scale = parameter.name.starts_with("norm") && parameter.name.ends_with("weight");
    const double deviation =
        std::sqrt(2.0 * static_cast<double>(parameter.outputs) / static_cast<double>(parameter.count));
    for (std::size_t i = 0; i < parameter.count; ++i) {
      parameter.values[i] =
          parameter.dimensions < 2 ? (is_scale ? 1.0f : 0.0f) : static_cast<float>(deviation * random.normal());
    }
  }
}

// The maps of these rows, one after the other.
std::vector<float> gather(std::span<const float> inputs, std::span<const std::size_t> rows) {
  std::vector<float> maps(rows.size() * kInputCells);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::copy_n(inputs.begin() + static_cast<std::ptrdiff_t>(rows[i] * kInputCells), kInputCells,
                maps.begin() + static_cast<std::ptrdiff_t>(i * kInputCells));
  }
  return maps;
}

}  // namespace

struct Network::State {
  State(int size, int thread_count)
      : embedding_size(size),
        threads(thread_count),
        layers(make_layers(size, thread_count, kInputRows, kInputColumns)) {}
  int embedding_size, threads;
  std::unique_ptr<Layers> layers;
  std::vector<double> losses;
};

Network Network::train(std::span<const float> inputs, std::span<const std::size_t> rows, std::span<const int> labels,
                       const LearningSpec& spec, std::uint64_t seed, std::uint64_t index, const StopFlag* stop) {
  SEAGLINT_CHECK(!rows.empty() && inputs.size() == labels.size() * kInputCells,
                 fmt::format("{} rows, {} labels, {} values", rows.size(), labels.size(), inputs.size()));
  auto state = std::make_shared<State>(spec.embedding_size, spec.threads);
  initialise(*state->layers, {seed, Stream::kNetwork, 2 * index});
  Random order_of_batches({seed, Stream::kNetwork, 2 * index + 1});
  state->layers->start_training(spec.learning_rate);

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
      std::vector<float> truth;
      for (const std::size_t row : batch) truth.push_back(static_cast<float>(labels[row]));
      const double loss = state->layers->train(gather(inputs, batch).data(), truth.data(), batch.size());
      sum += loss * static_cast<double>(batch.size());
    }
    state->losses.push_back(sum / static_cast<double>(order.size()));
  }
  return Network(std::move(state));
}

Embeddings Network::embed(std::span<const float> inputs) const {
  constexpr std::size_t kBatch = 64;
  Embeddings result;
  result.size = static_cast<std::size_t>(state_->embedding_size);
  const std::size_t maps = inputs.size() / kInputCells;
  for (std::size_t begin = 0; begin < maps; begin += kBatch) {
    state_->layers->embed(inputs.data() + begin * kInputCells, std::min(kBatch, maps - begin), result.values,
                          result.logits);
  }
  return result;
}

std::size_t Network::parameter_count() const {
  std::size_t count = 0;
  for (const Parameter& parameter : state_->layers->parameters()) count += parameter.count;
  return count;
}

const std::vector<double>& Network::losses() const { return state_->losses; }

// The file: kFormat, embedding size, thread count, number of weights (uint32 each), then the weights (float32) in the
// order of the layers. The library's own archive would contain time stamps.
void Network::save(const std::filesystem::path& file) const {
  std::string bytes;
  const auto append = [&bytes](const void* data, std::size_t count) {
    bytes.append(static_cast<const char*>(data), count);
  };
  const std::uint32_t head[4] = {kFormat, static_cast<std::uint32_t>(state_->embedding_size),
                                 static_cast<std::uint32_t>(state_->threads),
                                 static_cast<std::uint32_t>(parameter_count())};
  append(head, sizeof head);
  for (const Parameter& parameter : state_->layers->parameters())
    append(parameter.values, parameter.count * sizeof(float));
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
  auto state = std::make_shared<State>(static_cast<int>(head[1]), static_cast<int>(head[2]));
  Network network(state);
  if (head[3] != network.parameter_count() || bytes.size() != sizeof head + head[3] * sizeof(float))
    fail("it is truncated or has a tail");
  const char* place = bytes.data() + sizeof head;
  for (const Parameter& parameter : state->layers->parameters()) {
    std::memcpy(parameter.values, place, parameter.count * sizeof(float));
    place += parameter.count * sizeof(float);
  }
  return network;
}

}  // namespace seaglint
