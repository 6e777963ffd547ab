// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/view_export.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "seaglint_version.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dbsm.h"
#include "sim/core/process/file.h"
#include "sim/core/process/printable.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/placement/target_mesh.h"
#include "sim/scattering/sums/scattering_centres_3d.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_table.h"

namespace seaglint {

FacetLevels facet_levels(const Scatterer& scatterer, std::span<const Point> points, double k,
                         std::optional<std::size_t> element) {
  const std::size_t facets = scatterer.facets().size();
  const auto panel_of = [&](std::size_t facet) {
    return static_cast<std::size_t>(scatterer.panels().representative(static_cast<int>(facet)));
  };
  const std::vector<std::array<Complex, 4>> echoes = facet_contributions(points, k, facets);
  std::vector<std::array<Complex, 4>> panel(facets);
  for (std::size_t f = 0; f < facets; ++f) {
    for (std::size_t i = 0; i < 4; ++i) panel[panel_of(f)][i] += echoes[f][i];
  }
  FacetLevels levels{std::vector<double>(facets), dbsm_of_area(0)};
  for (std::size_t f = 0; f < facets; ++f) {
    double most = 0;
    for (std::size_t i = 0; i < 4; ++i)
      if (!element || *element == i) most = std::max(most, std::norm(panel[panel_of(f)][i]));
    levels.dbsm[f] = dbsm_of_area(4 * kPi * most);
    levels.highest_dbsm = std::max(levels.highest_dbsm, levels.dbsm[f]);
  }
  return levels;
}

TriangleMesh mesh_of_facets(const Scatterer& scatterer) {
  TriangleMesh mesh;
  for (const Facet& facet : scatterer.facets()) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3& corner : facet.corner) mesh.vertices.push_back(scatterer.centre() + corner);
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangle_part.push_back(facet.part);
  }
  return mesh;
}

namespace {

// Nine samples of matplotlib's viridis (Smith and van der Walt, CC0), sRGB.
constexpr double kViridis[9][3] = {{0x44, 0x01, 0x54}, {0x47, 0x2c, 0x7a}, {0x3b, 0x51, 0x8b},
                                   {0x2c, 0x71, 0x8e}, {0x21, 0x90, 0x8d}, {0x27, 0xad, 0x81},
                                   {0x5c, 0xc8, 0x63}, {0xaa, 0xdc, 0x32}, {0xfd, 0xe7, 0x25}};

// Linear RGB of viridis at 0..1 (glTF uses linear factors; sRGB conversion of IEC 61966-2-1).
std::array<double, 3> viridis(double at) {
  const double x = std::clamp(at, 0.0, 1.0) * 8;
  const int below = std::min(7, static_cast<int>(x));
  std::array<double, 3> linear{};
  for (int c = 0; c < 3; ++c) {
    const double s = (kViridis[below][c] + (x - below) * (kViridis[below + 1][c] - kViridis[below][c])) / 255;
    linear[static_cast<std::size_t>(c)] = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  }
  return linear;
}

std::string write_centres(const ViewExport& arguments, const TriangleMesh& mesh,
                          const std::vector<ScatteringCentre3d>& centres, const std::string& heading) {
  std::array<Complex, 4> all{}, kept{};
  const double floor = centres.empty() ? 0 : centres.front().peak_rcs() * std::pow(10.0, -arguments.range_db / 10);
  std::string rows;
  std::size_t count = 0;
  for (const ScatteringCentre3d& c : centres) {
    for (std::size_t i = 0; i < 4; ++i) all[i] += c.amplitude[i];
    if (c.peak_rcs() < floor || c.peak_rcs() == 0) continue;
    ++count;
    for (std::size_t i = 0; i < 4; ++i) kept[i] += c.amplitude[i];
    const Vec3 x = c.position();
    rows += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g}", x.x(), x.y(), x.z(), c.psi);
    for (const Complex& s : c.amplitude) rows += fmt::format(",{:.9g},{:.9g}", s.real(), s.imag());
    rows += fmt::format(",{:.4f},{},{},{}\n", dbsm_of_area(c.peak_rcs()), csv_cell(mesh.part_names[c.part]), c.bounces,
                        kMechanismNames[static_cast<int>(c.mechanism)]);
  }
  double missing = 0, size = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    missing += std::norm(all[i] - kept[i]);
    size += std::norm(all[i]);
  }
  write_file(arguments.centres, heading +
                                    fmt::format("# {} of {} centres, down to {:g} dB below the strongest; cells of "
                                                "{:g} m; the remainder is {:.1f} dB of the aspect's S\n"
                                                "# S(k + dk, r^ + d) = sum of s e^{{j dk psi + j (k + dk) 2 x.d}}; "
                                                "amplitudes s at k and r^ in metres, psi = minus the two-way path\n"
                                                "x_m,y_m,z_m,psi_m,hh_re,hh_im,hv_re,hv_im,vh_re,vh_im,vv_re,vv_im,"
                                                "max_dbsm,part,bounces,mechanism\n",
                                                count, centres.size(), arguments.range_db, arguments.cell_m,
                                                size > 0 ? dbsm_of_area(missing / size) : -1000.0) +
                                    rows);
  return fmt::format("{}: {} of {} scattering centres\n", arguments.centres, count, centres.size());
}

// Writes the mesh with one material per 2 dB of strength; facets without contribution or below the dynamic range have
// the lowest colour.
std::string write_hot_spots(const ViewExport& arguments, const TriangleMesh& mesh, const Scatterer& scatterer,
                            const FacetLevels& levels) {
  constexpr double kStep_db = 2;
  const bool silent = levels.highest_dbsm <= dbsm_of_area(0);
  const double top = silent ? 0 : std::ceil(levels.highest_dbsm / kStep_db) * kStep_db;
  const int steps = static_cast<int>(std::ceil(arguments.range_db / kStep_db));
  TriangleMesh coloured = mesh_of_facets(scatterer);
  coloured.part_names = mesh.part_names;
  std::vector<std::array<double, 3>> colours;
  for (int i = 0; i <= steps; ++i) {  // 0: below the dynamic range
    const double from = top - (steps - i + 1) * kStep_db;
    coloured.materials.push_back({i == 0 ? fmt::format("below {:g} dBsm", from + kStep_db)
                                         : fmt::format("{:g} to {:g} dBsm", from, from + kStep_db)});
    colours.push_back(i == 0 ? std::array<double, 3>{0.02, 0.02, 0.025} : viridis((i - 0.5) / steps));
  }
  for (const double level : levels.dbsm) {
    const int step = steps + 1 - static_cast<int>(std::floor((top - level) / kStep_db)) - 1;
    coloured.triangle_material.push_back(static_cast<std::uint16_t>(std::clamp(step, 0, steps)));
  }
  write_coloured_mesh(arguments.hot_spots, welded(coloured), colours);
  return fmt::format("{}: facets coloured by their RCS contribution, {}\n", arguments.hot_spots,
                     silent ? "no echo at this aspect" : fmt::format("up to {:.1f} dBsm", levels.highest_dbsm));
}

// The head of a table of scattering centres.
std::string heading(const RcsRequest& request, const Scatterer& scatterer) {
  return fmt::format(
      "# seaglint {} rcs: scattering centres\n# target {} {}, {:.9g} Hz, azimuth {:.9g} deg, elevation {:.9g} "
      "deg, max_bounces {}, edges {}{}, contributions: {}\n"
      "# body frame, e^{{+jwt}}, phase origin at the body's origin, S_pq: q transmitted, p received; basis of "
      "CONVENTIONS.md\n",
      kVersion, request.target.string(), placement_text(request), request.frequency_hz[0], request.azimuth_deg[0],
      request.elevation_deg[0], request.max_bounces, request.edges ? "on" : "off", method_text(request, scatterer),
      text_of(request.selection));
}

}  // namespace

std::string export_view(const RcsRequest& request, const RcsTarget& target, std::span<const Point> points) {
  const Scatterer& scatterer = *target.prepared.scatterer;
  const double k = 2 * kPi * request.frequency_hz[0] / kSpeedOfLight;
  std::string lines;
  if (!request.exports.centres.empty())
    lines += write_centres(request.exports, target.prepared.mesh, cluster_centres(points, k, request.exports.cell_m),
                           heading(request, scatterer));
  if (!request.exports.hot_spots.empty())
    lines += write_hot_spots(request.exports, target.prepared.mesh, scatterer, facet_levels(scatterer, points, k));
  return lines;
}

}  // namespace seaglint
