// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Checks of an export and of this solver that a mesh makes possible: exact and closed-form values of a recognised
// target next to both, and solutions of a few views with the mesh in other units and with the settings of other
// programs.

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/canonical/canonical_body.h"
#include "sim/field_tables/field_table.h"
#include "tools/compare/differences.h"
#include "tools/compare/paired_cut.h"
#include "tools/rcs/rcs_request.h"

namespace seaglint {

// Differences of both from the known levels of one element, dB.
struct KnownStatistics {
  std::size_t quantity = 0;        // quantity_of()
  Difference reference, compared;  // export - known, compared - known
  double error_db = 0;             // of the known values themselves; 0: exact
};

// Levels at the specular point of one of several spheres, dBsm: sums over frequency as in range_profile().
struct KnownLevel {
  std::string body, place;
  std::size_t quantity = 0;
  double range_m = 0;  // positive = farther
  double known_dbsm = 0, reference_dbsm = 0, compared_dbsm = 0;
};

struct KnownValues {
  std::string body;  // "sphere of radius 0.3 m"
  std::string name;  // "exact (Mie series)", "closed form"
  std::vector<KnownStatistics> statistics;
  std::vector<KnownLevel> levels;
};

// One body: differences at all places where its form applies, levels below floor_db under the highest known level are
// clipped; quantities whose known levels are all 60 dB below the highest are left out. `known` of each cut is set.
// Several spheres: their levels over frequency where they lie more than four resolution cells apart in range and none
// shadows another; of each cut with at least eight uniform frequencies and phases. Absent if nothing applies.
std::optional<KnownValues> known_values(std::vector<PairedCut>& cuts, std::span<const CanonicalBody> bodies,
                                        double floor_db);

// "hh: exact (Mie series) of a sphere of radius 0.3 m: export bias -1.05, rms 1.06 dB, seaglint bias -0.02, rms 0.03
// dB: seaglint is closer", a line for each statistic and level. compared: the name of the compared values.
std::vector<std::string> known_lines(const KnownValues& known, const std::string& compared);

// "seaglint is closer", "the export is closer" or why neither is said to be.
std::string closer_text(double reference_db, double compared_db, double error_db, const std::string& compared);

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
