// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Files of a sweep: the table of `rcs`, exports in the forms of other programs.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sim/field_tables/field_table.h"
#include "sim/scattering/scatterer/scatterer.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {

// The `#` lines of a table that a command made: version, target, settings and the warnings, a sentence each.
std::string rcs_heading(const RcsRequest& request, const Scatterer& scatterer, const std::string& made_by,
                        std::span<const std::string> warnings = {});

// ", method rays, ray_spacing_m 0.01" for the head of a table; empty for the method of beams.
std::string method_text(const RcsRequest& request, const Scatterer& scatterer);

// CSV of the sweep's last model, frequency slowest, then elevation, then azimuth, after rcs_heading(). A sweep with a
// flat model has the columns of its uncertainty; with `average` there are levels alone.
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

}  // namespace seaglint
