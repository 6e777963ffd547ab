// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Hot spots of a target at one aspect: levels of its facets and scattering centres, as table, coloured mesh, picture
// and page.

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scattering/points/decomposition.h"
#include "sim/scattering/scatterer/scatterer.h"
#include "sim/scattering/sums/scattering_centres_3d.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_target.h"

namespace seaglint {

// Element of hh, hv, vh, vv of which levels are shown; absent: the largest of the four.
using ShownElement = std::optional<std::size_t>;

// Level of each facet's contribution to the echo of one aspect.
struct FacetLevels {
  std::vector<double> dbsm;  // per facet of the scatterer
  double highest_dbsm = 0;   // dbsm_of_area(0) without any echo
};

// Levels at wavenumber k (rad/m) of an aspect's contributions. Facets of one panel (coplanar, of one part) have the
// level of their coherent sum, which does not depend on how the panel is cut.
FacetLevels facet_levels(const Scatterer& scatterer, std::span<const Point> points, double k,
                         ShownElement element = std::nullopt);

// The scatterer's facets as a mesh in the body frame: one triangle per facet in their order, with their parts; no
// materials.
TriangleMesh mesh_of_facets(const Scatterer& scatterer);

// Hot spots of several targets and views as JSON, which hot_spots.js draws.

inline constexpr double kBallRange_db = 30;  // of the scattering centres that are drawn, below the strongest

struct HotSpotSettings {
  double range_db = 60;                              // of the colours, below the highest level of a target
  std::vector<ShownElement> elements{std::nullopt};  // among which the reader chooses
  std::size_t most_centres = 1000;                   // of a view, per element
};

// One view of one antenna.
struct HotSpotView {
  double azimuth_deg = 0, elevation_deg = 0;
  std::vector<FacetLevels> levels;          // per element of the settings
  std::vector<double> total_dbsm;           // of the whole echo, per element
  std::vector<ScatteringCentre3d> centres;  // within kBallRange_db of the strongest of an element, and among its
                                            // most_centres strongest; strongest first
};

// The view of an aspect's contributions at wavenumber k and of all their centres (cluster_centres()), without
// directions.
HotSpotView hot_spot_view(const Scatterer& scatterer, std::span<const Point> points, double k,
                          std::span<const ScatteringCentre3d> centres, const HotSpotSettings& settings);

struct HotSpotTarget {
  std::string name;
  const Scatterer& scatterer;
  std::vector<std::string> part_names;
  std::vector<HotSpotView> views;
};

// Levels in steps of 1 dB, more where the range has over 250; packed vertices (2 mm of a 144 m ship) and triangles; the
// section of each target at z = 0; the centres of every view.
std::string hot_spots_json(std::span<const HotSpotTarget> targets, const HotSpotSettings& settings);

// Exports of the contributions at one aspect and frequency: scattering centres, hot spots.

inline constexpr std::size_t kPageFacets = 200'000;  // of a page of hot spots: about 3 MB

// True where the file of hot spots shows scattering centres: a page or a picture.
bool shows_centres(const std::string& file);

// Throws InputError for another name of hot spots than .glb, .gltf, .html, .png, .svg or .pdf; as draw_by_gnuplot()
// would where pages and pictures cannot be drawn.
void require_hot_spots(const std::string& file);

// Throws InputError where the target has more facets than a page can contain and its hot spots are one.
void require_hot_spots(const std::string& file, const RcsTarget& target);

// Writes the exports of a request with one aspect from the contributions at that aspect (rcs_views.h); returns one line
// per file.
std::string export_view(const RcsRequest& request, const RcsTarget& target, std::span<const Point> points);

}  // namespace seaglint
