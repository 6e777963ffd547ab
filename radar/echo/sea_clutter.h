// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Sea clutter: response of its scatterers, a K-distributed sum with individual Doppler evolution.

#include <cstdint>
#include <vector>

#include "radar/echo/clutter_scene.h"
#include "radar/waveform/pulse_train.h"
#include "sim/core/numbers/linear.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

// H of the clutter at the frequencies of every pulse, [pulse][frequency], ensemble mean power 1. Scatterers fill the
// whole unambiguous range window and are the same at every carrier and on every refinement of the frequency grid; their
// velocities follow spec.doppler, their power and widths spec.texture (sea_scatterers.h). Speckle: stream kClutter of
// (seed, index).
std::vector<Complex> clutter_response(const PulseTrain& train, const ClutterSpec& spec, const ClutterScene& scene,
                                      std::uint64_t seed, std::uint64_t index);

}  // namespace seaglint
