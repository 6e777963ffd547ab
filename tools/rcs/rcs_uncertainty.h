// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// How sure the echo of a view is: from its own trace, by halving the smallest patch, by changes of the mesh.

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "sim/core/process/parallel.h"
#include "tools/figure/figure.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_target.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {

// The echo of a place by two solutions, as of two methods or meshes: sums of squares over frequencies.
struct EchoChange {
  double reference_m2 = 0, other_m2 = 0, difference_m2 = 0;

  void add(const Complex& reference_m, const Complex& other_m);
  double relative() const;     // |other - reference| / |reference|, roots of the sums; 0 without a reference
  double relative_db() const;  // the same within -+kMostRelativeDb, of a vanishing reference the highest
};

inline constexpr double kMostRelativeDb = 300;

// How uncertain the echoes of a sweep are: warnings and columns from the estimates of its views, and a figure.

// Estimated level of flat facets over that of smooth surfaces, dB, within -60 and 60. element: 0 hh, 1 vv.
double flat_over_smooth_db(const RcsSweep& sweep, std::size_t view, std::size_t element);

// Estimated rms change by a displacement of all vertices by kVertexNoise wavelengths, relative to the echo, at most
// 1000; 0 without an echo.
double vertex_change(const RcsSweep& sweep, std::size_t view, std::size_t element);

// One sentence each, with the number of views, the worst one and its part: where flat facets would change hh or vv by
// more than 1 dB, where small displacements of the vertices change it by more than a quarter, where paths within the
// cavities of a part carry more than a quarter of it, and where half of the difference of hv and vh, of which the mean
// is given, is more than a quarter of it. Views 30 dB below the highest level of the sweep are ignored:
// in the nulls of a pattern any change is large.
std::vector<std::string> uncertainty_warnings(const RcsSweep& sweep, std::span<const std::string> part_names);

// The columns of a request with `uncertainty` after those of every table, and their values at one view and frequency.
std::string uncertainty_header();
std::string uncertainty_cells(const RcsSweep& sweep, std::size_t view, std::size_t frequency);

// hh and vv along the only axis of the sweep that has several values, at the frequency of the estimates if that is not
// the axis, as a band between flat facets and smooth surfaces. No panels where several axes vary, or none.
PlotPanels uncertainty_plots(const RcsSweep& sweep);

// A sweep whose smallest patch, or distance between rays, is halved until its levels no longer change.

// Changes of a level by halving this size, dB, of hh and vv in all rows; levels are raised to 60 dB below the
// highest of their element, as in deep nulls any change is large.
struct LevelChange {
  double mean_db = 0;                                // of the magnitude
  double largest_db = 0;                             // with its sign
  std::size_t view = 0, frequency = 0, element = 0;  // where; element 0 hh, 1 vv
};

struct ConvergenceStep {
  double size_m = 0;         // smallest patch, of the body with the smallest ones, or distance between rays
  std::size_t segments = 0;  // beam segments traced
  LevelChange change;        // from the step before; zero in the first
};

struct ConvergedSweep {
  RcsResult result;                     // with the last size; its sweep has the result of the step before as `coarser`
  std::vector<ConvergenceStep> series;  // the last one's size is that of the result
  bool converged = false;               // the last change is at most the tolerance
  std::string limit = {};               // why the size was not halved once more; empty otherwise
};

inline constexpr int kMostHalvings = 6;

// Halves a size until no level of the sweep changes by more than tolerance_db > 0, at most kMostHalvings times: by the
// method of beams the smallest patch, from that of the smallest body, which all bodies get; by that of rays the
// distance between them, with the smallest patch of the request, up to the largest number of rays. say() gets a line
// after each step. Throws InputError for a request with cavities, whose walls have no patches of this kind, for one
// that leaves the method open, and what compute_rcs() throws.
ConvergedSweep converge_rcs(const RcsRequest& request, const RcsTarget& target, double tolerance_db, int threads,
                            const StopFlag* stop, const std::function<void(const std::string&)>& say);

// The request with the size of a step.
RcsRequest at_step(RcsRequest request, const ConvergenceStep& step);

// "levels still change by 0.3 dB after 6 halvings of the patches": warning for a sweep that has not converged.
std::string convergence_warning(const RcsRequest& request, const ConvergedSweep& sweep);

// Change of the levels of `fine` from those of `coarse`, models of one sweep.
LevelChange level_change(const RcsSweep& sweep, const RcsSweep::Model& fine, const RcsSweep::Model& coarse);

// The columns of a converged sweep after those of every table, and their values: the level less that with patches of
// twice the side (of larger bodies after one halving: their own), or rays twice as far apart, dB, within -60 and 60.
std::string convergence_header(SolverMethod method);
std::string convergence_cells(const RcsSweep& sweep, std::size_t view, std::size_t frequency);

// Change of the echo with the mesh: the same surface cut, numbered, turned, moved or rounded differently, with noise on
// its vertices, and with flat facets. What does not change the surface should not change the echo; what remains is the
// uncertainty of a view.

enum class MeshChange { kCut, kCutFloat, kRenumbered, kTurned, kMoved, kNoise, kFlatFacets };
inline constexpr std::size_t kMeshChanges = 7;
// Columns of the table.
inline constexpr std::array<const char*, kMeshChanges> kMeshChangeNames{"cut",   "cut_float32", "renumbered", "turned",
                                                                        "moved", "noise",       "flat"};

struct ViewSensitivity {
  double azimuth_deg = 0, elevation_deg = 0;
  double hh_dbsm = 0, vv_dbsm = 0;            // mean power of the frequencies
  std::array<double, kMeshChanges> change{};  // of hh and vv over all frequencies, relative L2, phase included
};

struct MeshSensitivity {
  double noise_m = 0, shift_m = 0;  // of the change: standard deviation in every coordinate; distance
  std::vector<ViewSensitivity> views;
  std::vector<std::string> warnings;  // about the mesh, its edges and bars
  std::string materials_note;         // of TargetMesh
};

// The request's mesh, materials, views and frequencies (one antenna, no sea, no cavities). noise_m = 0: a 1900th of the
// shortest wavelength. Throws what prepare_mesh() throws.
MeshSensitivity mesh_sensitivity(const RcsRequest& request, double noise_m, int threads = 0,
                                 const StopFlag* stop = nullptr);

// The table as text, columns separated by blanks, `#` before comments.
std::string sensitivity_table(const MeshSensitivity& sensitivity);

}  // namespace seaglint
