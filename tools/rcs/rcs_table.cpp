// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/rcs_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <span>

#include "classify/dataset/format/npz.h"
#include "seaglint_version.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/printable.h"
#include "sim/field_export/field_export.h"
#include "sim/field_tables/field_table.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/placement/target_mesh.h"
#include "sim/scattering/sums/scattering_centres_3d.h"
#include "sim/scattering/tracing/tracing_settings.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_uncertainty.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {

namespace {

std::string materials_text(const std::vector<MaterialChoice>& materials) {
  if (materials.empty()) return "pec";
  std::vector<std::string> choices;
  for (const MaterialChoice& choice : materials)
    choices.push_back(choice.part ? *choice.part + "=" + choice.material : choice.material);
  return on_one_line(fmt::format("{}", fmt::join(choices, " ")));
}

// Head line on the sea under the target; empty without it.
std::string sea_line(const SeaUnderTarget& sea) {
  if (!sea.reflection) return "";
  const char* surface = sea.surface == SeaSurface::kConductor ? "conductor" : "sea_water";
  const char* paths = sea.paths == SeaPaths::kMultipath ? "multipath_only"
                      : sea.paths == SeaPaths::kDirect  ? "direct_only"
                                                        : "all";
  return fmt::format(
      "# over {}, origin {:.6g} m above the mean surface, significant wave height {:.6g} m, propagation paths: {}\n",
      surface, sea.height_m, sea.wave_height_m, paths);
}

// Head line on the cavities; empty without one.
std::string cavity_line(const CavityRequest& cavities) {
  if (cavities.parts.empty()) return "";
  return fmt::format(
      "# cavities {}: from the currents on their walls (magnetic-field integral equation, {:.6g} patches per "
      "wavelength), excited through their apertures\n",
      on_one_line(fmt::format("{}", fmt::join(cavities.parts, " "))), cavities.patches_per_wavelength);
}

std::string warning_lines(std::span<const std::string> warnings) {
  std::string lines;
  for (const std::string& warning : warnings) lines += fmt::format("# warning: {}\n", on_one_line(warning));
  return lines;
}

// ", method rays, ray_spacing_m 0.01" for the head of a table; empty for the method of beams.
std::string method_text(const RcsRequest& request, const Scatterer& scatterer) {
  const TracingSettings settings = settings_of(request, request.edges);
  if (settings.method == SolverMethod::kBeams) return "";
  return fmt::format(", method rays, ray_spacing_m {:.6g}", ray_spacing(scatterer, settings));
}

}  // namespace

std::string rcs_heading(const RcsRequest& request, const Scatterer& scatterer, const std::string& made_by,
                        std::span<const std::string> warnings) {
  return fmt::format(
      "# seaglint {} {}\n# target {} {}: {} facets, radius {:.6g} m\n"
      "# material {}, contributions: {}\n{}"
      "# physical optics at every visible bounce, max_bounces {}, edges {}, crease_deg {}, sheet_thickness_mm "
      "{:.6g}, wavefront_range_m {:.9g} (0 = plane wave), min_patch_m {:.6g}{}{}\n{}{}\n"
      "# amplitudes in metres, e^{{+jwt}}, phase origin at the body's origin, S_pq: q transmitted, p received; basis "
      "of "
      "CONVENTIONS.md\n{}",
      kVersion, made_by, on_one_line(request.target.string()), on_one_line(placement_text(request)),
      scatterer.facets().size(), scatterer.radius(), materials_text(request.materials), text_of(request.selection),
      sea_line(request.sea), request.max_bounces, request.edges ? "on" : "off",
      request.crease_deg ? fmt::format("{:.6g}", *request.crease_deg) : "auto", request.sheet_thickness_mm,
      request.range_m, request.min_patch_m > 0 ? request.min_patch_m : min_patch(scatterer),
      method_text(request, scatterer), request.like.empty() ? "" : ", like " + request.like,
      cavity_line(request.cavities), transmitter_line(request.transmitter), warning_lines(warnings));
}

std::string rcs_table(const RcsRequest& request, const Scatterer& scatterer, const RcsSweep& sweep,
                      std::span<const std::string> warnings) {
  std::string csv =
      rcs_heading(request, scatterer, "rcs", warnings) +
      fmt::format(
          "frequency_hz,azimuth_deg,elevation_deg,hh_re,hh_im,hv_re,hv_im,vh_re,vh_im,vv_re,vv_im,hh_dbsm,vv_dbsm{}\n",
          (sweep.flat ? uncertainty_header() : "") + (sweep.coarser ? convergence_header(request.method) : ""));
  for (std::size_t q = 0; q < sweep.frequency_hz.size(); ++q) {
    for (std::size_t view = 0; view < sweep.views(); ++view) {
      const auto& s = sweep.models.back().matrices[view][q];
      csv +=
          fmt::format("{:.9g},{:.9g},{:.9g}", sweep.frequency_hz[q], sweep.azimuth_of(view), sweep.elevation_of(view));
      for (const Complex& x : s) csv += fmt::format(",{:.9g},{:.9g}", x.real(), x.imag());
      csv += fmt::format(",{:.4f},{:.4f}", dbsm(s[0], kMinPrinted_m2), dbsm(s[3], kMinPrinted_m2));
      if (sweep.flat) csv += uncertainty_cells(sweep, view, q);
      if (sweep.coarser) csv += convergence_cells(sweep, view, q);
      csv += "\n";
    }
  }
  return csv;
}

namespace {

NpzArray doubles(const char* name, const std::vector<double>& values) {
  return npz_array(name, "<f8", {values.size()}, bytes_of_values(std::span<const double>(values)));
}

// The cuts of all four elements, by transmitter.
std::vector<std::span<const RcsCut>> by_transmitter(const std::vector<RcsCut>& cuts) {
  std::vector<std::span<const RcsCut>> groups;
  for (std::size_t first = 0; first < cuts.size(); first += 4) groups.emplace_back(cuts.data() + first, 4);
  return groups;
}

void write_matrices(const std::vector<RcsCut>& cuts, const std::filesystem::path& file) {
  std::vector<double> frequency, azimuth, elevation, transmit_azimuth, transmit_elevation;
  std::vector<Complex> matrices;
  for (const std::span<const RcsCut> group : by_transmitter(cuts)) {
    const DeclaredTransmitter& transmitter = *group[0].transmitter;
    for (std::size_t i = 0; i < group[0].values.size(); ++i) {
      const FieldValue& place = group[0].values[i];
      frequency.push_back(place.frequency_hz);
      azimuth.push_back(place.phi_deg);
      elevation.push_back(90 - place.theta_deg);
      transmit_azimuth.push_back(transmitter.is_monostatic ? azimuth.back() : transmitter.phi_deg);
      transmit_elevation.push_back(transmitter.is_monostatic ? elevation.back() : 90 - transmitter.theta_deg);
      for (const RcsCut& element : group) matrices.push_back(*element.values[i].amplitude_m);
    }
  }
  const std::string description = fmt::format(
      R"({{
  "program": "seaglint {}",
  "S": "m, [value][received h, v][transmitted h, v]; e^{{+jwt}}, phase origin at the body's origin",
  "frequency_hz": "Hz",
  "azimuth_deg, elevation_deg": "deg, of the receiver in the body's frame",
  "transmit_azimuth_deg, transmit_elevation_deg": "deg, of the transmitter"
}}
)",
      kVersion);
  write_npz(file,
            {doubles("frequency_hz", frequency), doubles("azimuth_deg", azimuth), doubles("elevation_deg", elevation),
             doubles("transmit_azimuth_deg", transmit_azimuth), doubles("transmit_elevation_deg", transmit_elevation),
             npz_array("S", "<c16", {frequency.size(), 2, 2}, bytes_of_values(std::span<const Complex>(matrices)))},
            {{"description.json", description}});
}

DeclaredTransmitter transmitter_of(const RcsSweep& sweep) {
  if (!sweep.transmitter) return {};
  const Vec3& t = *sweep.transmitter;
  DeclaredTransmitter transmitter{false, degrees(std::acos(std::clamp(t.z(), -1.0, 1.0))),
                                  degrees(std::atan2(t.y(), t.x()))};
  fold_direction(transmitter.theta_deg, transmitter.phi_deg);
  return transmitter;
}

}  // namespace

void append_cuts(const RcsSweep& sweep, std::vector<RcsCut>& cuts) {
  const DeclaredTransmitter transmitter = transmitter_of(sweep);
  auto group =
      std::find_if(cuts.begin(), cuts.end(), [&](const RcsCut& cut) { return cut.transmitter == transmitter; });
  if (group == cuts.end()) {
    group = cuts.insert(cuts.end(), 4, RcsCut{});
    for (std::ptrdiff_t element = 0; element < 4; ++element) {
      group[element].element = static_cast<Polarisation>(element);
      group[element].transmitter = transmitter;
    }
  }
  for (std::size_t q = 0; q < sweep.frequency_hz.size(); ++q) {
    for (std::size_t view = 0; view < sweep.views(); ++view) {
      FieldValue value{sweep.frequency_hz[q], 90 - sweep.elevation_of(view), sweep.azimuth_of(view), 0, {}, 0};
      fold_direction(value.theta_deg, value.phi_deg);
      for (std::size_t element = 0; element < 4; ++element) {
        const Complex s = sweep.models.back().matrices[view][q][element];
        value.level_dbsm = std::max(dbsm(s), kMinLevel_dbsm);
        value.amplitude_m = s;
        group[static_cast<std::ptrdiff_t>(element)].values.push_back(value);
      }
    }
  }
}

std::vector<std::filesystem::path> write_cuts_as(const std::string& format, const std::vector<RcsCut>& cuts,
                                                 const std::filesystem::path& folder, const std::string& stem) {
  std::vector<std::filesystem::path> files;
  const auto write = [&](const std::string& name, const std::string& bytes) {
    files.push_back(folder / name);
    write_file(files.back(), bytes);
  };
  for (const bool transmitted_v : {true, false}) {
    if (format == "feko") write(stem + (transmitted_v ? "_v.ffe" : "_h.ffe"), feko_text(cuts, transmitted_v));
    if (format != "cst") continue;
    for (const NamedFile& file : cst_texts(cuts, transmitted_v, stem)) write(file.name, file.text);
  }
  if (format == "npz") {
    files.push_back(folder / (stem + ".npz"));
    write_matrices(cuts, files.back());
  }
  return files;
}

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
