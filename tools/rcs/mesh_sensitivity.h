// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Change of the echo with the mesh: the same surface cut, numbered, turned, moved or rounded differently, with noise on
// its vertices, and with flat facets. What does not change the surface should not change the echo; what remains is the
// uncertainty of a view.

#include <array>
#include <string>
#include <vector>

#include "sim/core/process/parallel.h"
#include "tools/rcs/rcs_request.h"

namespace seaglint {

enum class MeshChange { kCut, kCutFloat, kRenumbered, kTurned, kMoved, kNoise, kFlatFacets };
inline constexpr std::size_t kMeshChanges = 7;
// Columns of the table.
inline constexpr std::array<const char*, kMeshChanges> kMeshChangeNames{"cut",   "cut_float32", "renumbered", "turned",
                                                                        "moved", "noise",       "flat"};

struct ViewSensitivity {
  double azimuth_deg = 0, elevation_deg = 0;
  double hh_dbsm = 0, vv_dbsm = 0;            // mean power of the frequencies
  std::array<double, kMeshChanges> change{};  // of hh and vv over all frequencies, relative L2, phase included
};

struct MeshSensitivity {
  double noise_m = 0, shift_m = 0;  // of the change: standard deviation in every coordinate; distance
  std::vector<ViewSensitivity> views;
  std::vector<std::string> warnings;  // about the mesh, its edges and bars
};

// The request's mesh, materials, views and frequencies (one antenna, no sea, no cavities). noise_m = 0: a 1900th of the
// shortest wavelength. Throws what prepare_mesh() throws.
MeshSensitivity mesh_sensitivity(const RcsRequest& request, double noise_m, int threads = 0,
                                 const StopFlag* stop = nullptr);

// The table as text, columns separated by blanks, `#` before comments.
std::string sensitivity_table(const MeshSensitivity& sensitivity);

}  // namespace seaglint
