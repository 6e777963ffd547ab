// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The options of `rcs` that select echoes by part, bounces and mechanism, and the exports of one view: scattering
// centres, hot spots on the mesh.

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scattering/response/body_response.h"

namespace seaglint {

struct ViewExportArguments {
  std::vector<std::string> only, without;  // part=NAME, bounces=N, mechanism=po|edge
  std::string centres, hot_spots;          // files
  double cell_m = 0.1, range_db = 60;

  void add_to(CLI::App& command);
  bool wanted() const { return !centres.empty() || !hot_spots.empty(); }
  // Throws InputError, also for a selection that nothing can meet: with so many bounces followed, with edges or
  // without.
  EchoFilter filter(const TriangleMesh& mesh, int max_bounces, bool edges) const;
  // The selection as it was given, for the head of a table; "everything" without one.
  std::string text() const;
};

// Writes the exports of one view at one frequency. heading: `#` lines for the table, each ended.
void export_view(const ViewExportArguments& arguments, const TriangleMesh& mesh, const Scatterer& scatterer,
                 const RadarBasis& radar, double k, const IlluminationSettings& settings, const std::string& heading,
                 int threads, const StopFlag* stop);

}  // namespace seaglint
