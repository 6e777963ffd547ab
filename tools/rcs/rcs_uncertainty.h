// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// How uncertain the echoes of a sweep are: warnings and columns from the estimates of its views, and a figure.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sim/scattering/sums/view_estimate.h"
#include "tools/rcs/rcs_sweep.h"

namespace seaglint {

ViewUncertainty summary_of(const ViewEstimate& estimate);

// Estimated level of flat facets over that of smooth surfaces, dB, within -60 and 60. element: 0 hh, 1 vv.
double flat_over_smooth_db(const RcsSweep& sweep, std::size_t view, std::size_t element);

// Estimated rms change by a displacement of all vertices by kVertexNoise wavelengths, relative to the echo, at most
// 1000; 0 without an echo.
double vertex_change(const RcsSweep& sweep, std::size_t view, std::size_t element);

// One sentence each, with the number of views, the worst one and its part: where flat facets would change hh or vv by
// more than 1 dB, where small displacements of the vertices change it by more than a quarter, where paths within the
// cavities of a part carry more than a quarter of it, and where half of the difference of hv and vh, of which the mean
// is given, is more than a quarter of it. Views 30 dB below the highest level of the sweep are ignored:
// in the nulls of a pattern any change is large.
std::vector<std::string> uncertainty_warnings(const RcsSweep& sweep, std::span<const std::string> part_names);

// The columns of a request with `uncertainty` after those of every table, and their values at one view and frequency.
std::string uncertainty_header();
std::string uncertainty_cells(const RcsSweep& sweep, std::size_t view, std::size_t frequency);

// Draws hh and vv along the only axis of the sweep that has several values, at the frequency of the estimates if that
// is not the axis, as a band between flat facets and smooth surfaces. False where several axes vary, or none.
bool draw_uncertainty(const RcsSweep& sweep, const std::string& title, const std::filesystem::path& file);

}  // namespace seaglint
