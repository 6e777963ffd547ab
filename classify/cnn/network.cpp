// SPDX-License-Identifier: BSD-3-Clause
#include "classify/cnn/network.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>

#include "classify/cnn/layers.h"
#include "classify/features/feature_vector.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"

namespace seaglint {

namespace {

constexpr double kOverviewRange_m = 96;  // half of the default map.range_span_m
constexpr double kVelocity_mps = 1;      // floats at Hs 2 m stay below 0.5 m/s
constexpr double kZoomSpreads = 2.5;
constexpr double kLeastSpread_m = 1;
constexpr double kLinearUpTo_mps = 0.01;  // of the asinh axis; some errors of a centre 30 dB above the clutter
constexpr double kBlur = 0.8;             // cells; a narrower Gaussian loses the place between two cells
constexpr int kBlurReach = 3;             // cells, 9e-4 of its height

// Position of x in -1..1 on an axis of `cells` cells.
double place(double x, std::size_t cells, double offset) {
  const auto count = static_cast<double>(cells);
  return std::clamp(0.5 * (x + 1) * count - 0.5 + offset, 0.0, count - 1);
}

// Raises the plane to a Gaussian of this height about (row, column).
void draw(float* plane, double row, double column, double height) {
  const int row_0 = static_cast<int>(std::lround(row)), column_0 = static_cast<int>(std::lround(column));
  for (int i = std::max(row_0 - kBlurReach, 0); i <= std::min(row_0 + kBlurReach, static_cast<int>(kInputRows) - 1);
       ++i) {
    for (int k = std::max(column_0 - kBlurReach, 0);
         k <= std::min(column_0 + kBlurReach, static_cast<int>(kInputColumns) - 1); ++k) {
      const double square = (i - row) * (i - row) + (k - column) * (k - column);
      float& cell = plane[static_cast<std::size_t>(i) * kInputColumns + static_cast<std::size_t>(k)];
      cell = std::max(cell, static_cast<float>(height * std::exp(-0.5 * square / (kBlur * kBlur))));
    }
  }
}

}  // namespace

std::vector<float> network_input(std::span<const ScatteringCentre> centres, double floor_db,
                                 const ImageOffset& offset) {
  SEAGLINT_CHECK(floor_db < 0, fmt::format("floor {} dB", floor_db));
  std::vector<float> input(kInputCells, 0.0f);
  double power = 0, sum = 0, mean_r = 0, mean_v = 0, variance_r = 0;
  for (const ScatteringCentre& centre : centres) {
    power += centre.amplitude_m * centre.amplitude_m;
    sum += centre.amplitude_m;
    mean_r += centre.amplitude_m * centre.range_m;
    mean_v += centre.amplitude_m * centre.velocity_mps;
  }
  if (!(power > 0)) return input;
  mean_r /= sum;
  mean_v /= sum;
  for (const ScatteringCentre& centre : centres)
    variance_r += centre.amplitude_m / sum * (centre.range_m - mean_r) * (centre.range_m - mean_r);
  const double zoom_m = kZoomSpreads * std::max(std::sqrt(variance_r), kLeastSpread_m);
  const VelocityLine line = robust_velocity_line(centres);

  float* const overview = input.data();
  float* const zoom = input.data() + kInputRows * kInputColumns;
  for (const ScatteringCentre& centre : centres) {
    const double level_db = 20 * std::log10(std::max(centre.amplitude_m / std::sqrt(power), 1e-15));
    const double height = std::max(1 - level_db / floor_db, 0.0);
    const double range_m = centre.range_m - mean_r;
    draw(overview, place((centre.velocity_mps - mean_v) / kVelocity_mps, kInputRows, offset.rows),
         place(range_m / kOverviewRange_m, kInputColumns, offset.columns), height);
    const double residual =
        std::asinh(line.residual(centre) / kLinearUpTo_mps) / std::asinh(kVelocity_mps / kLinearUpTo_mps);
    draw(zoom, place(residual, kInputRows, offset.rows), place(range_m / zoom_m, kInputColumns, offset.columns),
         height);
  }
  return input;
}

CentreList observed_otherwise(std::span<const ScatteringCentre> centres, Random& random) {
  const double side = random.below(2) == 0 ? 1 : -1;
  const double range_factor = side * (0.8 + 0.45 * random.uniform());
  const double velocity_factor = random.below(2) == 0 ? 1 : -1;
  const double rotation_rad_s = 0.00125 * random.normal();
  CentreList changed(centres.begin(), centres.end());
  double mean_m = 0;
  for (ScatteringCentre& centre : changed) {
    centre.range_m *= range_factor;
    mean_m += centre.range_m / static_cast<double>(changed.size());
  }
  for (ScatteringCentre& centre : changed)
    centre.velocity_mps = velocity_factor * centre.velocity_mps + rotation_rad_s * (centre.range_m - mean_m);
  return changed;
}

CentreList with_errors(CentreList centres, Random& random) {
  for (ScatteringCentre& centre : centres) {
    centre.range_m += 0.02 * random.normal();
    centre.velocity_mps += 0.001 * random.normal();
    centre.amplitude_m *= std::pow(10, 0.05 * random.normal());
  }
  return centres;
}

ImageOffset random_offset(Random& random) {
  ImageOffset offset;
  offset.columns = 4 * random.uniform() - 2;
  offset.rows = random.uniform() - 0.5;
  return offset;
}

namespace {

using Maker = Layers* (*)(const LayerSizes&);  // seaglint_torch_layers

// From the folder of the program or PREFIX/lib/seaglint (the run path of what links this).
Maker load() {
  void* library = dlopen("libseaglint_layers.so", RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw WorkError(std::string("network: cannot load libtorch: ") + dlerror());
  void* maker = dlsym(library, "seaglint_torch_layers");
  if (maker == nullptr) throw WorkError(std::string("network: ") + dlerror());
  return reinterpret_cast<Maker>(maker);
}

Maker maker() {
  static const Maker loaded = load();
  return loaded;
}

constexpr std::uint32_t kFormat = 0x53474e34;  // "SGN4"
constexpr std::uint32_t kMostClasses = 10;
using Head = std::array<std::uint32_t, 5>;  // of the file

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

// Maps whose gradient one thread computes; the sum over them is always formed in this division.
constexpr std::size_t kPart = 8;

// The weights are the library's until parameters() are set.
std::unique_ptr<Layers> new_layers(int embedding_size, std::size_t classes) {
  const int outputs = classes == 2 ? 1 : static_cast<int>(classes);
  return std::unique_ptr<Layers>(maker()({kInputChannels, kInputRows, kInputColumns, embedding_size, outputs}));
}

std::vector<float> weights_of(Layers& layers) {
  std::vector<float> all;
  for (const Parameter& parameter : layers.parameters())
    all.insert(all.end(), parameter.values, parameter.values + parameter.count);
  return all;
}

void set_weights(Layers& layers, const std::vector<float>& all) {
  const float* place = all.data();
  for (const Parameter& parameter : layers.parameters()) {
    std::copy_n(place, parameter.count, parameter.values);
    place += parameter.count;
  }
}

// Mean cross-entropy of logits [row][output].
double cross_entropy(const std::vector<float>& logits, std::size_t outputs, std::span<const std::size_t> rows,
                     std::span<const int> labels) {
  double sum = 0;
  for (std::size_t i = 0; outputs > 1 && i < rows.size(); ++i) {
    const float* of_row = &logits[i * outputs];
    const double highest = *std::max_element(of_row, of_row + outputs);
    double exponentials = 0;
    for (std::size_t k = 0; k < outputs; ++k) exponentials += std::exp(of_row[k] - highest);
    sum += highest + std::log(exponentials) - of_row[labels[rows[i]]];
  }
  if (outputs > 1) return sum / static_cast<double>(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double towards = labels[rows[i]] == 1 ? logits[i] : -logits[i];
    sum += std::max(-towards, 0.0) + std::log1p(std::exp(-std::abs(towards)));
  }
  return sum / static_cast<double>(rows.size());
}

// The gradient of a batch by parts of kPart maps, on several threads with one set of layers per part.
class BatchTraining {
 public:
  BatchTraining(Layers& layers, const LearningSpec& spec, std::size_t classes)
      : layers_(layers), threads_(spec.threads) {
    layers.start_training(spec.learning_rate);
    const std::size_t parts = (static_cast<std::size_t>(spec.batch_size) + kPart - 1) / kPart;
    for (std::size_t i = 0; threads_ > 1 && i < parts; ++i) copies_.push_back(new_layers(spec.embedding_size, classes));
  }

  // One step with the images and labels of a batch; sum of the cross-entropies before it.
  double step(const std::vector<float>& images, const std::vector<float>& labels) {
    const std::size_t parts = (labels.size() + kPart - 1) / kPart;
    std::vector<std::vector<float>> gradients(parts);
    std::vector<double> losses(parts);
    const std::vector<float> weights = weights_of(layers_);
    const auto part = [&](Layers& layers, std::size_t i) {
      const std::size_t begin = i * kPart, count = std::min(kPart, labels.size() - begin);
      losses[i] = layers.gradient(&images[begin * kInputCells], &labels[begin], count, gradients[i]);
    };
    if (copies_.empty()) {
      for (std::size_t i = 0; i < parts; ++i) part(layers_, i);
    } else {
      parallel_for(parts, threads_, [&](std::size_t i) {
        set_weights(*copies_[i], weights);
        part(*copies_[i], i);
      });
    }
    std::vector<float> gradient(weights.size(), 0.0f);
    double loss = 0;
    for (std::size_t i = 0; i < parts; ++i) {
      loss += losses[i];
      for (std::size_t k = 0; k < gradient.size(); ++k)
        gradient[k] += gradients[i][k] / static_cast<float>(labels.size());
    }
    layers_.step(gradient);
    return loss;
  }

 private:
  Layers& layers_;
  int threads_;
  std::vector<std::unique_ptr<Layers>> copies_;
};

}  // namespace

void load_layers_library() { maker(); }

struct Network::State {
  State(int size, double floor, std::size_t count)
      : embedding_size(size), floor_db(static_cast<float>(floor)), classes(count), layers(new_layers(size, count)) {}

  std::size_t outputs() const { return classes == 2 ? 1 : classes; }

  template <class MapOf>
  Embeddings embed(std::size_t maps, const MapOf& map) {
    constexpr std::size_t kBatch = 64;
    Embeddings result;
    result.size = static_cast<std::size_t>(embedding_size);
    result.outputs = outputs();
    for (std::size_t begin = 0; begin < maps; begin += kBatch) {
      const std::size_t end = std::min(begin + kBatch, maps);
      std::vector<float> images;
      for (std::size_t i = begin; i < end; ++i) {
        const std::vector<float> input = network_input(map(i), floor_db);
        images.insert(images.end(), input.begin(), input.end());
      }
      layers->embed(images.data(), end - begin, result.values, result.logits);
    }
    return result;
  }

  int embedding_size;
  float floor_db;
  std::size_t classes;
  std::unique_ptr<Layers> layers;
  TrainingHistory history;
};

Network Network::train(std::span<const CentreList> maps, const NetworkRows& rows, std::span<const int> labels,
                       const LearningSpec& spec, std::uint64_t seed, std::uint64_t index, const StopFlag* stop,
                       std::size_t classes) {
  SEAGLINT_CHECK(!rows.fit.empty() && maps.size() == labels.size(),
                 fmt::format("{} rows, {} labels, {} maps", rows.fit.size(), labels.size(), maps.size()));
  auto state = std::make_shared<State>(spec.embedding_size, spec.map_floor_db, classes);
  Layers& layers = *state->layers;
  TrainingHistory& history = state->history;
  initialise(layers, {seed, Stream::kNetwork, 2 * index});
  Random random({seed, Stream::kNetwork, 2 * index + 1});
  BatchTraining training(layers, spec, classes);

  std::vector<std::size_t> order(rows.fit.begin(), rows.fit.end());
  std::vector<float> best_weights;
  double best_loss = 0;
  const std::size_t batch_size = static_cast<std::size_t>(spec.batch_size);
  for (int epoch = 1; epoch <= spec.epochs && epoch - history.epochs <= spec.patience; ++epoch) {
    shuffle(order, random);
    double sum = 0;
    for (std::size_t begin = 0; begin < order.size(); begin += batch_size) {
      if (stop && *stop) throw Interrupted();
      std::vector<float> images, truth;
      for (std::size_t i = begin; i < std::min(begin + batch_size, order.size()); ++i) {
        const CentreList varied = with_errors(observed_otherwise(maps[order[i]], random), random);
        const std::vector<float> input = network_input(varied, state->floor_db, random_offset(random));
        images.insert(images.end(), input.begin(), input.end());
        truth.push_back(static_cast<float>(labels[order[i]]));
      }
      sum += training.step(images, truth);
    }
    history.fit.push_back(sum / static_cast<double>(order.size()));

    if (rows.validation.empty()) {
      history.epochs = epoch;
      continue;
    }
    const Embeddings unseen = state->embed(
        rows.validation.size(), [&](std::size_t i) -> const CentreList& { return maps[rows.validation[i]]; });
    const double loss = cross_entropy(unseen.logits, unseen.outputs, rows.validation, labels);
    history.validation.push_back(loss);
    if (history.epochs == 0 || loss < best_loss) {
      best_loss = loss;
      best_weights = weights_of(layers);
      history.epochs = epoch;
    }
  }
  if (!best_weights.empty()) set_weights(layers, best_weights);
  return Network(std::move(state));
}

Embeddings Network::embed(std::span<const CentreList> maps) const {
  return state_->embed(maps.size(), [&](std::size_t i) -> const CentreList& { return maps[i]; });
}

std::size_t Network::parameter_count() const {
  std::size_t count = 0;
  for (const Parameter& parameter : state_->layers->parameters()) count += parameter.count;
  return count;
}

std::size_t Network::classes() const { return state_->classes; }

const TrainingHistory& Network::history() const { return state_->history; }

// The file: kFormat, embedding size (uint32), floor in dB (float32), number of weights (uint32), number of classes
// (uint32), the weights (float32) in the order of the layers. The library's own archive would contain time stamps.
void Network::save(const std::filesystem::path& file) const {
  const std::vector<float> weights = weights_of(*state_->layers);
  const Head head{kFormat, static_cast<std::uint32_t>(state_->embedding_size),
                  std::bit_cast<std::uint32_t>(state_->floor_db), static_cast<std::uint32_t>(weights.size()),
                  static_cast<std::uint32_t>(state_->classes)};
  std::string bytes(sizeof head + weights.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), head.data(), sizeof head);
  std::memcpy(bytes.data() + sizeof head, weights.data(), weights.size() * sizeof(float));
  write_file(file, bytes);
}

Network Network::load(const std::filesystem::path& file) {
  const std::string bytes = read_file(file, std::size_t{64} << 20);
  Head head{};
  const auto fail = [&](const char* why) {
    throw InputError(fmt::format("{}: not a seaglint network: {}", file.string(), why));
  };
  if (bytes.size() < sizeof head) fail("too short");
  std::memcpy(head.data(), bytes.data(), sizeof head);
  const auto [format, embedding_size, floor, weight_count, classes] = head;
  if (format != kFormat) fail("it begins otherwise, or is of another version");
  const auto floor_db = std::bit_cast<float>(floor);
  if (embedding_size < 1 || embedding_size > 512 || !(floor_db >= -120 && floor_db < 0) || classes < 2 ||
      classes > kMostClasses)
    fail("its head is damaged");
  auto state = std::make_shared<State>(static_cast<int>(embedding_size), floor_db, classes);
  Network network(state);
  if (weight_count != network.parameter_count() || bytes.size() != sizeof head + weight_count * sizeof(float))
    fail("it is truncated or has a tail");
  std::vector<float> weights(weight_count);
  std::memcpy(weights.data(), bytes.data() + sizeof head, weights.size() * sizeof(float));
  if (!std::ranges::all_of(weights, [](float weight) { return std::isfinite(weight); })) fail("a weight is not finite");
  set_weights(*state->layers, weights);
  return network;
}

}  // namespace seaglint
