// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Request for a sweep of scattering matrices: target, views, frequencies, selection of contributions, settings of other
// programs.

#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/cavity/cavity_scattering.h"
#include "sim/core/numbers/linear.h"
#include "sim/field_tables/field_table.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scattering/scatterer/prepare_target.h"
#include "sim/scattering/tracing/tracing_settings.h"
#include "sim/scenario/sea_spec.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

inline constexpr double kMinPrinted_m2 = 1e-30;  // floor of printed levels, -300 dBsm

inline constexpr std::array<std::size_t, 2> kCoPolar{0, 3};  // of a matrix: hh, vv
inline constexpr std::array<const char*, 2> kCoPolarNames{"hh", "vv"};

// Estimates of one view at one frequency (sim/scattering/sums/view_estimate.h) for hh and vv, and the indices of
// the parts that contribute most to each.
struct ViewUncertainty {
  std::array<std::complex<float>, 2> flat_less_smooth{};  // echo of flat facets less that of smooth surfaces, m
  std::array<std::complex<float>, 2> in_cavity{};         // of paths within the cavities of one part, m
  std::array<float, 2> displaced{};                       // rms change by small displacements of the vertices, m
  float non_reciprocal = 0;                               // |hv - vh| / 2 of one antenna's beams, m
  std::uint16_t flat_part = 0, cavity_part = 0, displaced_part = 0, non_reciprocal_part = 0;
};

// Computed sweep: scattering matrices hh, hv, vh, vv in metres over frequency and aspect, of one or several models.
struct RcsSweep {
  std::vector<double> frequency_hz, azimuth_deg, elevation_deg;
  struct Model {
    std::string name;  // in legends and tables
    bool edge_diffraction = true;
    // [view][frequency], view = elevation * azimuths + azimuth
    std::vector<std::vector<std::array<Complex, 4>>> matrices;
  };
  std::vector<Model> models;
  std::optional<Model> flat;  // the last model with all facets flat, of a request with `uncertainty`
  // By view, of the last model; empty where it is not computed. At frequency index `estimated`.
  std::vector<ViewUncertainty> uncertainty;
  std::size_t estimated = 0;
  std::optional<Vec3>
      transmitter;  // look direction of a fixed transmitter; the sweep is then over the receiver's directions
  std::optional<Model> coarser =
      {};  // of a converged sweep: the last model with patches, or distances between rays, twice as large
  // By view and part, of a request `by_part`: the part's matrices per frequency in the last model, m, as
  // ViewResult::parts; a cavity is a part.
  std::vector<std::map<std::uint16_t, std::vector<std::array<std::complex<float>, 4>>>> parts = {};

  std::size_t views() const { return azimuth_deg.size() * elevation_deg.size(); }
  std::size_t rows() const { return views() * frequency_hz.size(); }
  double azimuth_of(std::size_t view) const { return azimuth_deg[view % azimuth_deg.size()]; }
  double elevation_of(std::size_t view) const { return elevation_deg[view / azimuth_deg.size()]; }
};

// The sea under a target at rest.
struct SeaUnderTarget {
  bool reflection = false;
  double height_m = 0;       // of the mesh's origin above the mean surface
  double wave_height_m = 0;  // significant
  SeaSurface surface = SeaSurface::kSeaWater;
  SeaPaths paths = SeaPaths::kAll;
};

// Parts of the mesh that are walls of open cavities, solved by the magnetic-field integral equation.
struct CavityRequest {
  std::vector<std::string> parts;
  double patches_per_wavelength = kPatchesPerWavelength;
};

// Contributions that are summed, KIND=VALUE each: part=NAME, bounces=N, mechanism=po|edge.
struct EchoSelection {
  std::vector<std::string> only;     // alternatives within a kind; kinds are combined by AND
  std::vector<std::string> without;  // excluded
};

// Exports of the contributions at one aspect and frequency; an empty file name means none.
struct ViewExport {
  std::string centres, hot_spots;
  double cell_m = 0.1;   // side of the cells whose contributions are merged into one scattering centre
  double range_db = 60;  // dynamic range below the strongest

  bool wanted() const { return !centres.empty() || !hot_spots.empty(); }
};

struct RcsRequest : MeshPlacement {
  std::filesystem::path target;              // mesh file
  std::shared_ptr<const TriangleMesh> mesh;  // in metres, in place of the file and its unit; may be null
  std::vector<MaterialChoice> materials;     // empty: perfect conductor throughout
  std::vector<double> frequency_hz, azimuth_deg, elevation_deg{0};
  std::optional<FixedTransmitter> transmitter;  // bistatic: the sweep is over the receiver's directions
  int average = 1;           // azimuths, evenly spread over every step, of whose cross-sections a view is the mean
  double range_m = 0;        // 0: far field
  bool edges = true;         // fringe currents at sharp edges
  bool uncertainty = false;  // also computes the echo of flat facets
  bool physical_optics_too = false;  // also computes a second model without edge diffraction
  int max_bounces = kDefaultBounces;
  SolverMethod method = SolverMethod::kBeams;
  double min_patch_m = 0;            // 0: min_patch()
  double ray_spacing_m = 0;          // of method rays; 0: ray_spacing()
  std::optional<double> crease_deg;  // absent: as the mesh's normals or its shape say
  double sheet_thickness_mm = 0;
  std::optional<double> waterline_m;  // what is below z = waterline_m of the placed mesh is removed (above_water())
  bool by_part = false;               // also computes the echo of every part; without `average`
  std::string like;                   // program whose settings were taken (kLikePrograms); empty: none
  EchoSelection selection;
  SeaUnderTarget sea;
  CavityRequest cavities;
  ViewExport exports;
};

// Method of this name, one of kSolverMethodNames. Throws InputError for another name.
SolverMethod solver_method_of(std::string_view name);

// Sweep of the request's directions and frequencies, without models. Throws InputError for a contradictory request and
// for more than four million rows.
RcsSweep requested_sweep(const RcsRequest& request);

// Placement of the mesh and its waterline, for the heads of tables: "unit mm offset_m 0,0,1.5 waterline_m 0".
std::string mesh_text(const RcsRequest& request);

// Warnings about the request, a sentence each, to be shown before the work.
std::vector<std::string> request_warnings(const RcsRequest& request);

// Selection of contributions by part, bounce count and mechanism.

// Names of the mechanisms in tables and selections, in the order of Mechanism. In selections `edge` is all but `po`.
inline constexpr std::array<const char*, kMechanisms> kMechanismNames{
    "po", "single", "multiple", "reflected_edge", "shadow_boundary", "penumbra", "concave"};
// The same in words.
inline constexpr std::array<const char*, kMechanisms> kMechanismWords{"physical optics",
                                                                      "single edge diffraction",
                                                                      "multiple edge diffraction",
                                                                      "edge diffraction via reflections",
                                                                      "shadow boundary of an edge",
                                                                      "wall in the penumbra of an edge",
                                                                      "concave edge"};

// Filter of a selection. Throws InputError for an invalid entry and for a selection that no contribution can satisfy
// with the given bounce limit and edge diffraction.
ContributionFilter filter_of(const EchoSelection& selection, const TriangleMesh& mesh, int max_bounces, bool edges);

// Text of the selection as given, for the head of a table; "everything" if there is none.
std::string text_of(const EchoSelection& selection);

// Settings with which other programs solve a target unless their user changes them, for `--like`.

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
