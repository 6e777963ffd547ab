// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// CLEAN's restored map: residual plus all components with a clean point response (Hogbom 1974, section 2).

#include "classify/features/scattering_centres.h"
#include "radar/rvmap/rv_map.h"
#include "radar/waveform/pulse_train.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

// The components return with the point response of a radar that transmits the whole band with every pulse: main and
// side lobes of the tapers, without the hop code's pedestal and without holes.
RvMap restored_map(const CleanedMap& cleaned, const PulseTrain& train, const MapSpec& map_spec);

}  // namespace seaglint
