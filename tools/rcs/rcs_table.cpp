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
#include "sim/scattering/tracing/tracing_settings.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_uncertainty.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {

namespace {

// The choices of materials, and the names of those of the mesh, which follow the chosen ones (assign_own_materials()).
std::string materials_text(const std::vector<MaterialChoice>& chosen, std::span<const MaterialSpec> materials) {
  std::vector<std::string> choices;
  std::size_t parts = 0;
  for (const MaterialChoice& choice : chosen) {
    choices.push_back(choice.part ? *choice.part + "=" + choice.material : choice.material);
    if (choice.part) ++parts;
  }
  if (choices.empty()) choices.emplace_back("pec");
  std::string text = fmt::format("{}", fmt::join(choices, " "));
  std::vector<std::string> own;
  for (std::size_t m = 1 + parts; m < materials.size(); ++m) {
    if (materials[m].kind != SurfaceKind::kSubmerged) own.push_back(materials[m].name);
  }
  if (!own.empty()) text += fmt::format(", of the mesh: {}", fmt::join(own, " "));
  return on_one_line(text);
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

}  // namespace

std::string method_text(const RcsRequest& request, const Scatterer& scatterer) {
  const TracingSettings settings = settings_of(request, request.edges);
  if (settings.method == SolverMethod::kBeams) return "";
  return fmt::format(", method rays, ray_spacing_m {:.6g}", ray_spacing(scatterer, settings));
}

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
      kVersion, made_by, on_one_line(request.target.string()), on_one_line(mesh_text(request)),
      scatterer.facets().size(), scatterer.radius(), materials_text(request.materials, scatterer.materials()),
      text_of(request.selection), sea_line(request.sea), request.max_bounces, request.edges ? "on" : "off",
      request.crease_deg ? fmt::format("{:.6g}", *request.crease_deg) : "auto", request.sheet_thickness_mm,
      request.range_m, request.min_patch_m > 0 ? request.min_patch_m : min_patch(scatterer),
      method_text(request, scatterer), request.like.empty() ? "" : ", like " + request.like,
      cavity_line(request.cavities), transmitter_line(request.transmitter), warning_lines(warnings));
}

namespace {

// The table of a request with `average`: levels alone.
std::string averages_table(const RcsRequest& request, const std::string& heading, const RcsSweep& sweep) {
  std::string csv =
      heading + fmt::format(
                    "# every level is the mean cross-section of {} azimuths, evenly spread over the step "
                    "about its own\nfrequency_hz,azimuth_deg,elevation_deg,hh_dbsm,hv_dbsm,vh_dbsm,vv_dbsm\n",
                    request.average);
  for (std::size_t q = 0; q < sweep.frequency_hz.size(); ++q) {
    for (std::size_t view = 0; view < sweep.views(); ++view) {
      csv +=
          fmt::format("{:.9g},{:.9g},{:.9g}", sweep.frequency_hz[q], sweep.azimuth_of(view), sweep.elevation_of(view));
      for (const Complex& x : sweep.models.back().matrices[view][q])
        csv += fmt::format(",{:.4f}", dbsm(x, kMinPrinted_m2));
      csv += "\n";
    }
  }
  return csv;
}

}  // namespace

std::string rcs_table(const RcsRequest& request, const Scatterer& scatterer, const RcsSweep& sweep,
                      std::span<const std::string> warnings) {
  if (request.average > 1) return averages_table(request, rcs_heading(request, scatterer, "rcs", warnings), sweep);
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

}  // namespace seaglint
