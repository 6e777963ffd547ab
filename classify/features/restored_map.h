// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// CLEAN's restored map: the points taken out come back without what the hop code smeared (Hogbom 1974, section 2).

#include "classify/features/scattering_centres.h"
#include "radar/rvmap/rv_map.h"
#include "radar/waveform/pulse_train.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

// The map as a radar would see it that sends the whole band with every pulse: what was removed comes back with the
// lobes of the tapers alone, without the hop code's pedestal and without holes.
RvMap restored_map(const CleanedMap& cleaned, const PulseTrain& train, const MapSpec& map_spec);

}  // namespace seaglint
