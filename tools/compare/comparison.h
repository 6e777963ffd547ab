// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Comparison of exports of other solvers and of measurements with this solver or with each other, at their own angles
// and frequencies.

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/field_tables/field_table.h"
#include "tools/compare/alignment.h"
#include "tools/compare/differences.h"
#include "tools/compare/paired_cut.h"
#include "tools/compare/target_checks.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_target.h"

namespace seaglint {

// The part, number of bounces and mechanism whose contributions have the largest sum at a place, with its level.
struct MainContribution {
  std::string part;
  int bounces = 1;
  std::string mechanism;
  double level_dbsm = 0;

  std::string group() const;  // "part hull, 2 bounces, po"
};

// Differences of all values of one element or total, compared - reference, both clipped at floor_db below the
// reference's maximum.
struct ElementStatistics {
  Polarisation element = Polarisation::kHh;
  bool total = false;  // of the sum over both received polarisations (RcsCut)
  Difference difference;
  double highest_dbsm = 0;                      // of the reference
  double p90_db = 0, p95_db = 0;                // 90 and 95 % of the absolute differences are at most this
  double p90_about_bias_db = 0;                 // the same of the differences less their mean
  double p90_strong_db = 0;                     // the same within kStrong_db of the highest level
  std::size_t strong = 0;                       // number of these
  std::size_t frequencies = 0, directions = 0;  // different ones of its places
  // Differences beyond 1 dB, or the 90 % difference if that is larger, and how many of them lie lower than kStrong_db
  // below the highest level.
  double limit_db = 0;
  std::size_t beyond = 0, beyond_weak = 0;
  // The part of an axis, a quarter of its range or less, with most of the squared differences; none: fraction 0.
  struct Sector {
    const char* axis = "";  // "azimuth", "elevation", "frequency"
    const char* unit = "";
    double low = 0, high = 0, fraction = 0;
  };
  Sector sector;
  struct Worst {
    double difference_db = 0;
    PairedCut::Place place;
    double reference_dbsm = 0;
    std::optional<MainContribution> main;  // of a monostatic target without cavities
  };
  std::vector<Worst> worst;          // the largest differences at places apart, at most five
  ExtremumPairs lobes, nulls;        // of all cuts with one variable; means over their pairs
  CutAxis axis = CutAxis::kSeveral;  // that variable

  std::size_t quantity() const { return quantity_of(element, total); }
};

inline constexpr double kStrong_db = 20;  // levels within it of the highest are strong

struct ExportComparison {
  std::string name, reader, compared;   // compared: "seaglint" or the name of the other file
  std::vector<std::string> notes = {};  // how the export was read
  std::vector<PairedCut> cuts = {};  // each with one model; references in the phase of the compared values if aligned
  std::optional<Alignment> alignment = {};  // absent as asked, or without phases
  std::vector<ElementStatistics> elements = {};
  std::vector<std::string> warnings = {};
  std::vector<std::string> suggested = {};                 // of the warnings: what in the levels may be different
  std::optional<InterpolationQuality> interpolation = {};  // of the compared values
  std::vector<RcsCut> solved = {};                         // of a target: all elements, at the places of the export
  std::vector<std::string> omitted = {};  // a sentence for each element that is not compared: zero or rounding in one
  std::vector<std::string> one_sided =
      {};  // the same of those that are an echo in the other: differences without a number
  std::optional<RcsRequest> solver = {};  // settings of a solved target
  std::optional<KnownValues> known = {};  // of a solved target that is recognised
  std::vector<Trial> trials = {};         // of a solved target whose agreement is poor
};

struct ComparisonSettings {
  double floor_db = 80;
  bool as_is = false;  // no fit of phase, origin, conjugation and signs
  // Tables with other directions: values of the other table are interpolated (interpolated_cut()).
  std::optional<double> interpolation_radius_m;
};

// The request with all frequencies of the exports, for prepare_rcs_target() before compare_with_target(). Its azimuth
// is any, as a mesh is prepared for frequencies alone.
RcsRequest at_frequencies_of(const std::vector<FieldTable>& tables, RcsRequest request);

// What was solved of a target: exports of one model mostly have the same views, which are solved once.
struct TargetSolutions {
  int threads = 0;
  const StopFlag& stop;
  std::function<void(const std::string&)> say;  // gets a line before each solution, and compute_rcs()'s
  struct Solved {
    std::optional<FixedTransmitter> transmitter;
    ViewGrid grid;
    RcsSweep sweep;
  };
  std::vector<Solved> solved = {};
};

// Solves the target at exactly the angles and frequencies of the export, monostatic or bistatic as it states. `request`
// says what the target is made of and how it is solved; solutions are of equal requests but for their views. Throws
// InputError for an export without a stated incident wave, and what compute_rcs() throws.
ExportComparison compare_with_target(const FieldTable& table, const RcsRequest& request, const RcsTarget& target,
                                     const ComparisonSettings& settings, TargetSolutions& solutions);

// Compares two tables where they have equal directions (0.001 deg; all within reach if interpolated), frequencies
// (1e-6) and elements, a total also with the sum of both elements; throws InputError if that is nowhere, or if their
// incident waves differ.
ExportComparison compare_with_table(const FieldTable& table, const FieldTable& other,
                                    const ComparisonSettings& settings, int threads);

// Adds a warning to exports whose monostatic hv and vh differ at equal places, in one file or in the only two of a
// reader with one of them: reciprocity requires them equal, so that such elements are no reference. Levels more than 60
// dB below the highest are left out; at least five pairs with a median difference above 1 dB.
void check_reciprocity(std::vector<ExportComparison>& comparisons);

}  // namespace seaglint
