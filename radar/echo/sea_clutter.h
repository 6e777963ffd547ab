// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Sea clutter response: K-distributed sum of many scatterers with individual Doppler evolution.

#include <cstdint>
#include <vector>

#include "radar/echo/clutter_motion.h"
#include "radar/waveform/pulse_train.h"
#include "sim/core/numbers/random.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

// Gamma-distributed texture of mean 1 and shape spec.texture_shape on `cells` points of a ring at one time. Correlation
// of its Gaussian generator: e^{-d^2 / (2 l^2)} along the ring, d and l in cells, and e^{-(t /
// texture_correlation_time_s)^2 / 2} between times of one key (stream kTexture).
std::vector<double> sea_texture(int cells, double correlation_cells, const ClutterSpec& spec, double time_s,
                                std::uint64_t seed, std::uint64_t key);

// H of the clutter at the frequencies of every pulse, [pulse][frequency], ensemble mean power 1. Scatterers fill the
// whole unambiguous range window and are the same at every carrier and on every refinement of the frequency grid; their
// velocities follow spec.doppler. Speckle: stream kClutter of (seed, index); texture: scene.texture_key.
std::vector<Complex> clutter_response(const PulseTrain& train, const ClutterSpec& spec, const ClutterScene& scene,
                                      std::uint64_t seed, std::uint64_t index);

}  // namespace seaglint
