// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Statistics over many realisations of a sea state as text and figure.

#include <filesystem>
#include <string>

#include "sim/sea/statistics.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

// CSV of omega_rad_s, density_m2_s (prescribed), realised_density_m2_s, realised_linear_density_m2_s; `spectrum: table`
// reads it.
std::string spectrum_csv(const SeaEnsemble& ensemble);

// Statistics of the ensemble and their theoretical values, one line each.
std::string ensemble_text(const SeaEnsemble& ensemble, const SeaSummary& summary);

// Figure of elevation over time, realised and prescribed spectrum, exceedance of crests with Rayleigh's and
// Forristall's distributions, and rms slope over the cut-off.
void write_sea_figure(const SeaState& state, const WaveField& field, const SeaSummary& summary,
                      const SeaEnsemble& ensemble, const std::string& title, const std::filesystem::path& file);

}  // namespace seaglint
