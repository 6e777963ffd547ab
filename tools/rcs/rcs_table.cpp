// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/rcs_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "seaglint_version.h"
#include "sim/core/numbers/dbsm.h"
#include "sim/core/process/printable.h"
#include "sim/field_tables/transmitter_keys.h"
#include "sim/geometry/placement/mesh_placement.h"
#include "sim/scattering/tracing/tracing_settings.h"
#include "tools/rcs/echo_selection.h"
#include "tools/rcs/rcs_convergence.h"
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

}  // namespace seaglint
