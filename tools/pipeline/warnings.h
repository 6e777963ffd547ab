// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Warnings about the validity of a scenario's results.

#include <span>
#include <string>
#include <vector>

#include "tools/pipeline/pipeline.h"

namespace seaglint {

struct Body;
struct Bounds;
struct Scenario;
struct SeaState;
struct TargetSpec;
class DatasetReader;
class Pipeline;

// One line per defect or doubtful property of the meshes of the scenario's targets.
std::vector<std::string> mesh_warnings(const Pipeline& pipeline);

// One line per motion file whose times are not uniform, and per ship whose hull is not along x.
std::vector<std::string> motion_warnings(const Pipeline& pipeline);

// Columns, units and conventions by which the target's motion file was read, as a sentence; empty without such a file.
std::string motion_file_note(const TargetSpec& target, const Body& body);

// orientation_finding() of the target's mesh, of models ship and rao; else empty.
std::string hull_warning(const TargetSpec& target, const Body& body);

// Of a body that its mesh shows in the air, above the mean water surface at rest: a ship, or a float that is drawn to
// its waterline or has a gap below it larger than its height. Empty for any other, for rafts and for bodies with
// heights of their own, which may be anywhere. `box` of the mesh.
std::string hovering_warning(const TargetSpec& target, const Bounds& box);

// Prints motion_file_note() as a line, and hull_warning() and hovering_warning() as warnings, unless empty.
void report_motion(const TargetSpec& target, const Body& body);

// Prints motion_file_note() of every target.
void report_motion_files(const Pipeline& pipeline);

// Prints how the file of sea.table was understood, with its height and peak period; nothing without such a file.
void report_spectrum_table(const Scenario& scenario);

// One line per wave system of the scenario's sea states with so few components that its mean period varies between
// realisations.
std::vector<std::string> sea_warnings(const Scenario& scenario, std::span<const SeaState> states);

// One line if the carriers' bands leave gaps: maps then contain grating lobes of the targets.
std::vector<std::string> band_warnings(const Pipeline& pipeline);

// One line if a merged file beside the shards is of another data set.
std::vector<std::string> data_set_warnings(const DatasetReader& reader);

// Prints each sentence as a warning.
void warn(std::span<const std::string> sentences);

// Parts of a scenario's targets that lie outside its maps.

// One line for every target and view whose bodies at rest, with the translations of a recorded motion, points or their
// velocities reach beyond the map's range or velocity span, with the numbers; at most ten lines, then the count of the
// rest. Echoes outside the map are cut off or, beyond the unambiguous span, aliased into it.
std::vector<std::string> map_coverage_warnings(const Pipeline& pipeline);

}  // namespace seaglint
