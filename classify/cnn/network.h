// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Small convolutional network that classifies a map by the images of its scattering centres; its embedding is the
// paper's lambda_CNN.
//
// Its input: two images of a map's scattering centres, without their level, place and mean velocity. The motions that
// separate a rigid body from free ones are fractions of a velocity cell, so that they show in the fitted velocities of
// the centres, not in the cells of the map. Training maps are varied by changes that leave the class: each epoch trains
// on other versions of them.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "classify/features/scattering_centres.h"
#include "sim/core/process/parallel.h"
#include "sim/scenario/learning_spec.h"

namespace seaglint {

class Random;

inline constexpr std::size_t kInputChannels = 2;
inline constexpr std::size_t kInputRows = 32;     // velocity
inline constexpr std::size_t kInputColumns = 64;  // range
inline constexpr std::size_t kInputCells = kInputChannels * kInputRows * kInputColumns;

using CentreList = std::vector<ScatteringCentre>;

// Displacement of the images on their grid, in cells.
struct ImageOffset {
  double rows = 0, columns = 0;
};

// [channel][velocity][range]. Each centre is a Gaussian of standard deviation 0.8 cells at its exact place; its height
// falls from 1 at the total power of all centres to 0 at floor_db below it (negative), linearly in dB; of overlapping
// ones the higher counts; centres beyond an axis are at its end. Axes, relative to the mean of the centres weighted by
// amplitude:
//   channel 0, overview   range +-96 m, velocity +-1 m/s, both linear
//   channel 1, zoom       range +-2.5 standard deviations (at least 1 m each); velocity relative to
//                         robust_velocity_line(), +-1 m/s, on the axis asinh(v / 0.01 m/s)
// Invariant to multiplication of the amplitudes, to shifts in range and velocity and, in the zoom, to a constant
// rotation of the target, up to rounding. Zeros without centres.
std::vector<float> network_input(std::span<const ScatteringCentre> centres, double floor_db,
                                 const ImageOffset& offset = {});

// The centres of another observation of the same kind of target, in the same order. The ranges change sign in half of
// the cases, as seen from the other end, and so do the velocities, as for the same motion run backwards. The ranges are
// multiplied by a factor uniform in 0.8..1.25, another aspect or spacing. v += w (r - mean r) with w normal of 0.00125
// rad/s adds a constant rotation of the whole, or the radar's own motion. Residuals from the line of velocity over
// range keep their magnitude.
CentreList observed_otherwise(std::span<const ScatteringCentre> centres, Random& random);

// Adds errors of estimation, normal: 0.001 m/s in velocity, that of a centre 32 dB above clutter and noise in its cell
// (Cramer-Rao bound, sqrt(3)/(2 pi) cells / sqrt(SNR)); 0.02 m in range and 1 dB in amplitude, above that bound, as
// scatterers in one cell interfere.
CentreList with_errors(CentreList centres, Random& random);

// Range and velocity shift of the images, uniform within +-2 columns and +-0.5 rows.
ImageOffset random_offset(Random& random);

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
  // varied versions of the maps, at most spec.epochs passes; ends when spec.patience epochs have not
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
