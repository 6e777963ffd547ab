// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The response of the sea around the target: many weak scatterers, K-distributed, each with its own Doppler evolution.

#include <cstdint>
#include <vector>

#include "radar/waveform/pulse_train.h"
#include "sim/core/random.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

// Texture g(r) of mean 1 on `cells` points of a ring, gamma distributed with the given shape; its Gaussian generator is
// correlated as exp(-d^2 / (2 l^2)), d and l in cells.

std::vector<double> sea_texture(int cells, double shape, double correlation_cells, Random& random);

// H of the clutter at the frequencies of every pulse, [pulse][frequency], mean power 1 over all realisations. The
// scatterers fill the whole unambiguous range window and are the same ones at every carrier. Stream kClutter of (seed,
// index).
std::vector<Complex> clutter_response(const PulseTrain& train, const ClutterSpec& spec, std::uint64_t seed,
                                      std::uint64_t index);

}  // namespace seaglint
