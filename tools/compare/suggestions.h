// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What two curves that differ may have different, and trials that solve a few views with other units and settings.

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/field_tables/field_table.h"
#include "tools/compare/alignment.h"
#include "tools/compare/paired_cut.h"
#include "tools/rcs/rcs_request.h"

namespace seaglint {

// A sentence for each of time factor, signs, origin, unit, scale of the levels, sense and zero of the azimuth and size
// of the mesh that fits clearly better changed. Cuts with one model each; levels are clipped at floor_db
// below each reference's maximum.
std::vector<std::string> suggestions(const std::vector<PairedCut>& cuts, const std::optional<Alignment>& alignment,
                                     double floor_db);

// Median of |compared - export| of the same views before and after a change.
struct Trial {
  std::string option;   // "--unit mm", "--like hfss"
  std::string meaning;  // of the option
  std::size_t views = 0;
  double before_db = 0, after_db = 0;
  bool helps = false;
};

struct TrialRequest {
  const FieldTable& table;
  const RcsRequest& request;           // with which `cuts` were solved
  const std::vector<PairedCut>& cuts;  // of the whole table, one model each
  // The table's values next to those of another request.
  std::function<std::vector<PairedCut>(const FieldTable&, const RcsRequest&)> solve;
  std::function<void(const std::string&)> say;  // gets a line before the first solution
};

// Levels more than 40 dB below the highest are left out. A median difference above 1.5 dB is poor: up to eight views
// are solved with the settings of the program that wrote the file, or of all (kLikePrograms). If the median of
// compared - export is beyond 8 dB they are first solved in those of m, cm, mm, in and ft whose change of levels fits
// it, between 8 and 50 log10 of the change of size. A unit that leaves a quarter of the difference helps, and is the
// only trial unless the settings of a program leave less. Empty where the agreement is not poor and of a target with
// cavities.
std::vector<Trial> trial_solutions(const TrialRequest& request);

// Whether the mesh is in another unit than was given.
bool is_unit(const Trial& trial);

// A sentence on the trial that helps most, or that none of them does; none without trials.
std::vector<std::string> trial_sentences(const std::vector<Trial>& trials);

}  // namespace seaglint
