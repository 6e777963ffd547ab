// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Statistics over many realisations of a sea state as text and figure.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sim/sea/statistics.h"
#include "sim/sea/wave_field.h"
#include "tools/figure/figure.h"

namespace seaglint {

// CSV of omega_rad_s, density_m2_s (prescribed), realised_density_m2_s, realised_linear_density_m2_s; `spectrum: table`
// reads it.
std::string spectrum_csv(const SeaEnsemble& ensemble);

// Statistics of the ensemble and their theoretical values, one line each.
std::string ensemble_text(const SeaEnsemble& ensemble, const SeaSummary& summary);

inline constexpr std::size_t kMostStates = 6;  // of a figure

// The small print of a figure that draws `drawn` of `all` states, or what else `what` says.
std::vector<std::string> with_left_out(std::vector<std::string> notes, std::size_t all, std::size_t drawn,
                                       const char* what = "sea state");

// What tells several sea states apart, "Hs 2 m, Tp 8 s": those of total wave height, peak period, direction of
// propagation, gamma and swell that differ; the number where none does. Of one state an empty text.
std::vector<std::string> state_names(std::span<const SeaState> states);
// What all of at least one state have in common: such quantities, and the depth.
struct CommonOfStates {
  std::vector<std::string> quantities;
  std::string depth;
};
CommonOfStates common_of(std::span<const SeaState> states);

// A sea state, its first realisation, and many realisations together.
struct SeaCase {
  SeaState state;
  WaveField field;
  SeaSummary summary;
  SeaEnsemble ensemble;
};

// Figure of elevation over time, realised and prescribed spectrum, exceedance of crests with Rayleigh's and
// Forristall's distributions, and rms slope over the cut-off; of several states the first kMostStates, a colour each.
void write_sea_figure(std::span<const SeaCase> cases, const FigureText& text, const std::filesystem::path& file);

}  // namespace seaglint
