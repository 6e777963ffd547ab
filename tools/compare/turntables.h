// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Turntable images and range profiles of an export and of the values it is compared with.

#include <optional>
#include <string>
#include <vector>

#include "tools/compare/paired_cut.h"
#include "tools/rcs/turntable_figure.h"

namespace seaglint {

// The amplitudes of one element over azimuth and frequency, of an export and of the compared values.
struct ComparedTurntable {
  std::string reference_name, compared_name;
  TurntableEcho reference, compared;
};

// Of the strongest element with phases, at the elevation of its highest level, of one antenna; absent below
// kFewestOfTurntable azimuths or frequencies, with uneven steps and where places are missing.
std::optional<ComparedTurntable> compared_turntable(const std::vector<PairedCut>& cuts);

// What a comparison's target adds to its pictures.
struct TurntableTarget {
  const TriangleMesh* mesh = nullptr;  // outlines and area; null: the whole windows of the sampling
  PeakNames names = {};
  std::vector<std::string> notes = {};  // after those of the sampling
  int threads = 0;
};

// The image and the profiles of the export, then those of the compared values, with equal axes and level axes. A target
// larger than the windows of the export's steps appears folded, which the notes state.
std::vector<Heatmap> turntable_pictures(const ComparedTurntable& turntable, const TurntableTarget& target);

}  // namespace seaglint
