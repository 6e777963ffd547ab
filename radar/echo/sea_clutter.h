// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The response of the sea around the target: many weak scatterers, K-distributed, each with its own Doppler evolution.

#include <cstdint>
#include <vector>

#include "radar/echo/clutter_motion.h"
#include "radar/waveform/pulse_train.h"
#include "sim/core/numbers/random.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

// Texture of mean 1 on `cells` points of a ring at one time, gamma distributed with spec.texture_shape. Its Gaussian
// generator is correlated as e^{-d^2 / (2 l^2)} along the ring, d and l in cells, and as e^{-(t /
// texture_correlation_time_s)^2 / 2} between times of one key (stream kTexture).
std::vector<double> sea_texture(int cells, double correlation_cells, const ClutterSpec& spec, double time_s,
                                std::uint64_t seed, std::uint64_t key);

// H of the clutter at the frequencies of every pulse, [pulse][frequency], mean power 1 over all realisations. The
// scatterers fill the whole unambiguous range window of the map and are the same ones at every carrier and on every
// refinement of the frequency grid; their velocities are those that spec.doppler asks for. Speckle: stream kClutter of
// (seed, index); texture: scene.texture_key.
std::vector<Complex> clutter_response(const PulseTrain& train, const ClutterSpec& spec, const ClutterScene& scene,
                                      std::uint64_t seed, std::uint64_t index);

}  // namespace seaglint
