// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What a user should know of a scenario's results: how its files were read, doubts about their validity, and in which
// degrees of freedom its targets move.

#include <array>
#include <span>
#include <string>
#include <vector>

#include "tools/pipeline/pipeline.h"

namespace seaglint {

class DatasetReader;

// Prints a sentence that is no warning; nothing for an empty one.
void print_note(const std::string& note);

// Prints each sentence as a warning.
void warn(std::span<const std::string> sentences);

// Which notes and warnings apply, besides those about files, meshes, motions and seas.
struct ReportScope {
  bool rest = false;      // degrees of freedom at rest: rest_text() of every mesh target, unless the scenario itself
                          // states that the target is fixed
  bool bands = false;     // band_warnings()
  bool coverage = false;  // map_coverage_warnings(); throws InputError if the map has too many cells
};

// Prints how the files of motions and of sea.table were understood, and the warnings.
void report_scenario(const Pipeline& pipeline, const ReportScope& scope);

// The part of it about the sea alone, of the scenario's sea states.
void report_sea(const Scenario& scenario, std::span<const SeaState> states);

// Columns, units and conventions by which the motion file of each target was read, a sentence for each.
std::vector<std::string> motion_file_notes(std::span<const Target> targets);

// A sentence for each target with materials that its mesh names.
std::vector<std::string> material_notes(std::span<const Target> targets);

// Prints motion_file_notes(), a line each, and motion_warnings().
void report_motion(std::span<const Target> targets);

// One line per defect or doubtful property of the meshes of the scenario's targets, and per target that is partly
// under water.
std::vector<std::string> mesh_warnings(const Pipeline& pipeline);

// One line per ship whose hull is not along x (orientation_finding()), per motion file whose times are not uniform, and
// per target with a body that its mesh shows in the air, above the mean water surface at rest: a ship, or a float that
// is drawn to its waterline or has a gap below it larger than its height. Rafts and bodies with heights of their own
// may be anywhere.
std::vector<std::string> motion_warnings(std::span<const Target> targets);

// One line per wave system of the scenario's sea states with so few components that its mean period varies between
// realisations, and per scatter diagram with seas that may break.
std::vector<std::string> sea_warnings(const Scenario& scenario, std::span<const SeaState> states);

// One line for a given shape of the texture, and one for a length, that is more than three times that of measured
// clutter in the scene, or less than a third (k_shape, texture_length_m); none beyond the range that the measurements
// have.
std::vector<std::string> clutter_warnings(const Pipeline& pipeline);

// One line if the carriers' bands leave gaps: maps then contain grating lobes of the targets.
std::vector<std::string> band_warnings(const Pipeline& pipeline);

// One line for every target and view whose bodies at rest, with the translations of a recorded motion, points or their
// velocities reach beyond the map's range or velocity span, with the numbers; at most ten lines, then the count of the
// rest. Echoes outside the map are cut off or, beyond the unambiguous span, aliased into it.
std::vector<std::string> map_coverage_warnings(const Pipeline& pipeline);

// Part of a sea's spectrum outside of the frequencies of a table of response amplitude operators, a sentence per target
// with such a table.
std::vector<std::string> uncovered_waves(std::span<const Target> targets, const WaveField& sea);

// One line if a merged file beside the shards is of another data set.
std::vector<std::string> data_set_warnings(const DatasetReader& reader);

// Motion of the first body of a target.
struct TargetMotion {
  const TargetSpec* target = nullptr;
  std::array<double, 6> rms{};  // motion_rms(); 0: at rest in that degree of freedom
};

// The seas by which a scenario's motions are judged: the first realisation of the sea state with the highest waves;
// where keys of the sea are drawn, up to four of the data set's seas, evenly chosen.
struct TrialSea {
  SeaState state;
  std::uint64_t key = 0;  // of its realisation
};
std::vector<TrialSea> trial_seas(const Pipeline& pipeline);

// That of every mesh target, parts included, over 100 s of each of these seas (mean square over them); of a recorded
// motion that is shorter, over the scenario's intervals. Without targets whose responses do not cover these seas.
std::vector<TargetMotion> target_motions(const Pipeline& pipeline, std::span<const TrialSea> seas);

// "roll 1.91, pitch 0.42, yaw 0.11 deg rms"; empty for a target at rest.
std::string motion_text(const TargetMotion& motion);

// What holds and carries the floats of a target besides the waves: "; without its ropes of 42 m, which hold surge and
// sway; drifts at 0.42 m/s towards 30 deg, each by itself at 0.05 m/s rms"; empty for others.
std::string line_text(const TargetSpec& target);

// The degrees of freedom that are 0, with the keys that would move them: "surge, sway, heave are 0 without
// targets.ship.motion.translations: true"; empty where none is.
std::string rest_text(const TargetMotion& motion);

// Warns of rest_text() as ReportScope::rest states.
void report_rest(const Scenario& scenario, const std::vector<TargetMotion>& motions);

}  // namespace seaglint
