// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Files of a sweep: the table of `rcs`, exports in the forms of other programs; levels of the contributions of every
// facet, and the scattering centres and facets of a view.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/field_tables/field_table.h"
#include "sim/scattering/points/decomposition.h"
#include "sim/scattering/scatterer/scatterer.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_target.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {

// The `#` lines of a table that a command made: version, target, settings and the warnings, a sentence each.
std::string rcs_heading(const RcsRequest& request, const Scatterer& scatterer, const std::string& made_by,
                        std::span<const std::string> warnings = {});

// CSV of the sweep's last model, frequency slowest, then elevation, then azimuth, after rcs_heading(). A sweep with a
// flat model has the columns of its uncertainty.
std::string rcs_table(const RcsRequest& request, const Scatterer& scatterer, const RcsSweep& sweep,
                      std::span<const std::string> warnings = {});

// Solved values in the files of other programs.

inline constexpr const char* kExportFormats[] = {"feko", "cst", "npz"};

// Adds hh, hv, vh, vv of the sweep's last model to those of the same transmitter.
void append_cuts(const RcsSweep& sweep, std::vector<RcsCut>& cuts);

// Writes cuts with equal directions and frequencies of all four elements per transmitter, in `folder`, and returns the
// files: `feko` STEM_v.ffe and STEM_h.ffe, by the polarisation transmitted; `cst` a table `STEM (f = 9.5), theta = ...,
// VP.txt` per frequency and polarisation transmitted; `npz` STEM.npz (NumPy) with frequency_hz, azimuth_deg,
// elevation_deg of the receiver, transmit_azimuth_deg, transmit_elevation_deg (equal if monostatic), each [value], S
// [value][received h, v][transmitted h, v] in metres, and description.json. Throws WorkError where a file cannot be
// written.
std::vector<std::filesystem::path> write_cuts_as(const std::string& format, const std::vector<RcsCut>& cuts,
                                                 const std::filesystem::path& folder, const std::string& stem);

// Level of each facet's contribution to the echo of one aspect: the hot spots of a target.

struct FacetLevels {
  std::vector<double> dbsm;  // per facet of the scatterer
  double highest_dbsm = 0;   // dbsm_of_area(0) without any echo
};

// Levels at wavenumber k (rad/m) of an aspect's contributions. Facets of one panel (coplanar, of one part) have the
// level of their coherent sum, which does not depend on how the panel is cut. `element`: of hh, hv, vh, vv; absent: the
// largest of the four.
FacetLevels facet_levels(const Scatterer& scatterer, std::span<const Point> points, double k,
                         std::optional<std::size_t> element = std::nullopt);

// The scatterer's facets as a mesh in the body frame: one triangle per facet in their order, with their parts; no
// materials.
TriangleMesh mesh_of_facets(const Scatterer& scatterer);

// Exports of the contributions at one aspect and frequency: scattering centres, hot spots on the mesh.

// Writes the exports of a request with one aspect from the contributions at that aspect (rcs_views.h); returns one line
// per file.
std::string export_view(const RcsRequest& request, const RcsTarget& target, std::span<const Point> points);

}  // namespace seaglint
