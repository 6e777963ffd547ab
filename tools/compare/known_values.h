// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Exact and closed-form values of a recognised target next to the values of an export and of this solver.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/canonical/canonical_body.h"
#include "tools/compare/differences.h"

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

}  // namespace seaglint
