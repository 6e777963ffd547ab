// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Figures of a target on a turntable: its image with the outline of the mesh, its range profiles over azimuth with the
// parts at the peaks of one of them.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/figure/map_figure.h"
#include "tools/pipeline/imaging.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_target.h"
#include "tools/rcs/rcs_views.h"
#include "tools/rcs/turntable.h"

namespace seaglint {

// Throws InputError with the place, the value and the bound where the request's sweep cannot have an image: below
// kFewestOfTurntable ascending frequencies or azimuths, several elevations or one above kSteepestTurntable_deg, a fixed
// transmitter. `option`: what asks for it.
void require_turntable(const RcsRequest& request, const std::string& option);

// Throws InputError with the steps that are needed where the target is larger than the window within which the image
// (range and cross range) or the profiles (range alone) repeat themselves.
void require_window(const RcsRequest& request, const TriangleMesh& mesh, const std::string& option, bool image);

// Of hh, hv, vh, vv of the sweep's last model.
TurntableEcho turntable_echo(const RcsSweep& sweep, std::size_t element);

// What both figures have besides their values. `highest_dbsm` of the level axis: absent: the highest level.
struct TurntableCaption {
  std::string title;               // what is drawn: target, polarisation
  std::vector<std::string> notes;  // phrases of the small print after those of the sampling
  std::optional<double> highest_dbsm = {};
  std::string colour = kComputedColour;  // of the profile above the others
};

// Levels over range and cross range, seen from above with the radar at the left; with the mesh's outline, if any.
Heatmap turntable_figure(const TurntableEcho& echo, const TurntableImage& image, const TriangleMesh* mesh,
                         const TurntableCaption& caption);

// A range profile of an element at one azimuth and elevation, by its middle frequency.
struct ProfilePlace {
  RcsView view;
  std::size_t element = 3;  // of hh, hv, vh, vv
  double range_cell_m = 0;
};

// Names the peaks of a profile; null: they have none.
using PeakNames = std::function<void(std::vector<NamedPeak>& peaks, const ProfilePlace& place)>;

// By the contributions of the target's parts, for one antenna without the sea and cavities. Both arguments outlive it.
PeakNames part_names(const RcsRequest& request, const RcsTarget& target);

// Levels over range and azimuth below the profile at the middle azimuth, whose `most` strongest peaks have names.
// More than 800 ranges or azimuths share cells with the largest level of each.
Heatmap profiles_figure(const TurntableEcho& echo, const TurntableProfiles& profiles, const TurntableCaption& caption,
                        const PeakNames& names, std::size_t most);

}  // namespace seaglint
