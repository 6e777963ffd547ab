// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Settings with which other programs solve a target unless their user changes them, for `--like`.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/rcs/rcs_request.h"

namespace seaglint {

// One program's surface, edges and bounces in terms of a request.
struct LikeProgram {
  const char* name;       // of the option's value
  const char* program;    // in texts
  bool flat;              // facets as meshed; else smooth where the mesh samples a curved surface
  bool edges;             // edge diffraction
  int max_bounces;        // reflections of a path
  const char* described;  // what is set, and what the program's documents do not state
};

inline constexpr LikeProgram kLikePrograms[] = {
    // SBR+ on the triangles of its mesh. PyAEDT's setup template `HFSSSBR` (setup_templates.py) has
    // PTDUTDSimulationSettings "None" and MaxNumberOfBounces 5; Ansys' Radar Explorer toolkit, which writes the
    // metadata
    // files of PyAEDT, has num_bounces 3 (backend/models.py).
    {"hfss", "HFSS SBR+", true, false, 3,
     "flat facets, no PTD or UTD edges, 3 bounces as Ansys' Radar Explorer sets them (a setup made by hand has 5)"},
    // RL-GO on the triangles of its mesh. "Edge and wedge diffractions" is an option of the solver settings; without a
    // maximum number of ray interactions "the maximum number of ray interactions is determined automatically" (Altair
    // Feko user guide, RL-GO settings).
    {"feko", "FEKO RL-GO", true, false, kDefaultBounces,
     "flat facets, no edge and wedge diffraction, as many bounces as the paths have (FEKO ends them automatically)"},
    // SBR with ray tubes on curved triangles (CST help, Asymptotic Solver Specials). Edge diffraction is an option of
    // the accuracy level "custom" (AsymptoticSolver object). No public document with its number of reflections was
    // found: this program's default stays.
    {"cst", "CST's asymptotic solver", false, false, kDefaultBounces,
     "surfaces smooth where the mesh samples a curve, no edge diffraction; CST's number of reflections is not "
     "documented in public: this program's default"},
};

std::vector<std::string> like_names();  // hfss, feko, cst

// Throws InputError for another name.
const LikeProgram& like_program(std::string_view name);

// The program that wrote a file, by the text of its reader ("a PyAEDT monostatic export"); null for any other.
const LikeProgram* like_program_of_reader(std::string_view reader);

// Settings that a user gave, which `--like` leaves.
struct GivenSettings {
  bool crease = false, edges = false, max_bounces = false;
};

// The request with the program's settings except those given.
RcsRequest solved_like(RcsRequest request, const LikeProgram& program, const GivenSettings& given = {});

// "flat facets, no edge diffraction, at most 3 bounces, by beams (--like hfss)".
std::string solver_text(const RcsRequest& request);

}  // namespace seaglint
