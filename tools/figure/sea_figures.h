// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What many realisations of a sea state have in common, as text and picture.

#include <filesystem>
#include <string>

#include "sim/sea/ensemble.h"
#include "sim/sea/statistics.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

// omega_rad_s, density_m2_s (the state's), realised_m2_s, realised_linear_m2_s; spectrum: table reads it.
std::string spectrum_csv(const SeaEnsemble& ensemble);

// The ensemble's numbers beside what theory says, one line each.
std::string ensemble_text(const SeaEnsemble& ensemble, const SeaSummary& summary);

// Elevation over time, spectrum against target, exceedance of crests against Rayleigh and Forristall, and the slope
// that each cut-off would leave.
void write_sea_figure(const SeaState& state, const WaveField& field, const SeaSummary& summary,
                      const SeaEnsemble& ensemble, const std::string& title, const std::filesystem::path& file);

}  // namespace seaglint
