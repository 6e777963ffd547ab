// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/rcs_request.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "sim/core/process/error.h"
#include "sim/core/text/names.h"
#include "sim/core/text/words.h"
#include "sim/geometry/placement/target_mesh.h"
#include "sim/scattering/observation/observation.h"

namespace seaglint {

namespace {

Vec3 direction_to(const FixedTransmitter& transmitter) {
  return direction_to_radar(radians(transmitter.azimuth_deg), radians(transmitter.elevation_deg));
}

// Throws InputError unless every direction has an image in the sea and every frequency is within the model of sea
// water.
void check_sea(const RcsRequest& request) {
  if (!request.sea.reflection) return;
  if (request.waterline_m)
    throw InputError(
        fmt::format("--waterline-m {}: with --sea-reflection the water is where --origin-height-m says: z = {:g} m",
                    *request.waterline_m, -request.sea.height_m + 0.0));
  for (const double elevation : request.elevation_deg) {
    if (elevation <= 0)
      throw InputError(
          fmt::format("--elevation-deg: value {}: must be greater than 0 with --sea-reflection", elevation));
  }
  for (const double frequency : request.frequency_hz) {
    if (request.sea.surface == SeaSurface::kSeaWater && frequency > 90e9) {
      throw InputError(fmt::format("--frequency-ghz: value {}: must be at most 90 with --sea-reflection over sea_water",
                                   1e-9 * frequency));
    }
  }
}

// Throws InputError for settings that the request's method does not have.
void check_method(const RcsRequest& request) {
  if (request.method == SolverMethod::kBeams && request.ray_spacing_m != 0)
    throw InputError(fmt::format("--ray-spacing-m: value {}: valid only with --method rays; beams have --min-patch-m",
                                 request.ray_spacing_m));
  if (request.method == SolverMethod::kRays && !request.cavities.parts.empty())
    throw InputError("--cavity does not support --method rays: only beams end at the walls of cavities");
}

}  // namespace

SolverMethod solver_method_of(std::string_view name) {
  const auto* const found = std::find(std::begin(kSolverMethodNames), std::end(kSolverMethodNames), name);
  if (found == std::end(kSolverMethodNames))
    throw InputError(fmt::format("method: value '{}': must be {}", name, fmt::join(kSolverMethodNames, " or ")));
  return static_cast<SolverMethod>(found - std::begin(kSolverMethodNames));
}

RcsSweep requested_sweep(const RcsRequest& request) {
  RcsSweep sweep{request.frequency_hz, request.azimuth_deg, request.elevation_deg, {}, {}, {}, 0, {}};
  if (request.transmitter) sweep.transmitter = direction_to(*request.transmitter);
  check_method(request);
  if (request.average > 1 && request.azimuth_deg.size() < 2)
    throw InputError(fmt::format("--average {}: --azimuth-deg must have a step, A:B:STEP", request.average));
  check_sea(request);
  if (request.uncertainty && request.crease_deg && *request.crease_deg == 0)
    throw InputError(fmt::format("--uncertainty compares smooth surfaces with flat facets; with {} all are flat",
                                 request.like.empty() ? "--crease-deg 0" : "--like " + request.like));
  if (!request.cavities.parts.empty() && (request.sea.reflection || request.range_m > 0 || request.exports.wanted()))
    throw InputError("--cavity does not support --sea-reflection, --wavefront-range-m and exports of one aspect");
  constexpr std::size_t kMaxRows = 4'000'000;  // 256 MB of matrices
  if (sweep.rows() > kMaxRows) throw InputError(fmt::format("{} rows of output: at most {}", sweep.rows(), kMaxRows));
  if (sweep.rows() == 0) throw InputError("no frequency, azimuth or elevation");
  if (request.exports.wanted() && sweep.rows() != 1)
    throw InputError(fmt::format("exports of one aspect need one frequency, azimuth and elevation; there are {} rows",
                                 sweep.rows()));
  if (request.exports.wanted() && request.sea.reflection)
    throw InputError("exports of one aspect do not support --sea-reflection");
  if (request.transmitter && (request.exports.wanted() || request.sea.reflection)) {
    throw InputError("--transmit-azimuth-deg: exports of one aspect and --sea-reflection are monostatic");
  }
  return sweep;
}

std::string mesh_text(const RcsRequest& request) {
  return placement_text(request) +
         (request.waterline_m ? fmt::format(" waterline_m {:.9g}", *request.waterline_m) : "");
}

// Behind a target only its sharp edges scatter: the echo of a sphere has a mean error of 0.65 dB between 90 and 120 deg
// from the transmitter.
std::vector<std::string> request_warnings(const RcsRequest& request) {
  if (!request.transmitter) return {};
  constexpr double kFarthestDeg = 120;
  const Vec3 transmitter = direction_to(*request.transmitter);
  double farthest = 0;
  for (const double elevation : request.elevation_deg) {
    for (const double azimuth : request.azimuth_deg) {
      const Vec3 receiver = direction_to_radar(radians(azimuth), radians(elevation));
      farthest = std::max(farthest, degrees(std::acos(std::clamp(transmitter.dot(receiver), -1.0, 1.0))));
    }
  }
  if (farthest <= kFarthestDeg) return {};
  return {
      fmt::format("receivers up to {:.0f} deg from the transmitter: behind the target, beyond {:g} deg, "
                  "only sharp edges scatter, and the forward-scattered field, within 15 "
                  "deg of the incident direction, is not modelled",
                  farthest, kFarthestDeg)};
}

namespace {

// One selector, or those of every mechanism of edge diffraction.
std::vector<ContributionSelector> selectors(const std::string& option, const std::string& text,
                                            const TriangleMesh& mesh) {
  const std::size_t equals = text.find('=');
  const std::string kind = text.substr(0, equals), value = equals == std::string::npos ? "" : text.substr(equals + 1);
  if (kind == "part") {
    const auto place = std::find(mesh.part_names.begin(), mesh.part_names.end(), value);
    if (place == mesh.part_names.end())
      throw InputError(fmt::format("{} {}: no part '{}': {}", option, text, value, suggestion(value, mesh.part_names)));
    return {{ContributionSelector::Kind::kPart, static_cast<int>(place - mesh.part_names.begin())}};
  }
  if (kind == "bounces") {
    const std::optional<std::int64_t> count = parse_integer(value);
    if (!count || *count < 1 || *count > kMaxBounces)
      throw InputError(fmt::format("{} {}: bounces must be 1, 2, ... {}", option, text, kMaxBounces));
    return {{ContributionSelector::Kind::kBounces, static_cast<int>(*count)}};
  }
  if (kind == "mechanism") {
    std::vector<ContributionSelector> of_value;
    for (int i = 0; i < kMechanisms; ++i) {
      const bool edge = static_cast<Mechanism>(i) != Mechanism::kPhysicalOptics;
      if (value == kMechanismNames[static_cast<std::size_t>(i)] || (value == "edge" && edge))
        of_value.push_back({ContributionSelector::Kind::kMechanism, i});
    }
    if (!of_value.empty()) return of_value;
    throw InputError(
        fmt::format("{} {}: the mechanism must be edge or one of {}", option, text, fmt::join(kMechanismNames, ", ")));
  }
  throw InputError(fmt::format("{} {}: must be part=NAME, bounces=N or mechanism=NAME", option, text));
}

bool is_edge_diffraction(const ContributionSelector& selector) {
  return selector.kind == ContributionSelector::Kind::kMechanism &&
         selector.value != static_cast<int>(Mechanism::kPhysicalOptics);
}

}  // namespace

ContributionFilter filter_of(const EchoSelection& selection, const TriangleMesh& mesh, int max_bounces, bool edges) {
  ContributionFilter result;
  for (const std::string& text : selection.without) {
    const auto of_text = selectors("--without", text, mesh);
    result.excluded.insert(result.excluded.end(), of_text.begin(), of_text.end());
  }
  for (const std::string& text : selection.only) {
    const std::vector<ContributionSelector> of_text = selectors("--only", text, mesh);
    const ContributionSelector& first = of_text.front();
    if (first.kind == ContributionSelector::Kind::kBounces && first.value > max_bounces)
      throw InputError(
          fmt::format("--only {} requires --max-bounces {} or more; {} are traced", text, first.value, max_bounces));
    if (is_edge_diffraction(first) && !edges) throw InputError(fmt::format("--only {} requires --edges on", text));
    const auto is_excluded = [&](const ContributionSelector& one) {
      return std::ranges::find(result.excluded, one) != result.excluded.end();
    };
    if (std::ranges::all_of(of_text, is_excluded))
      throw InputError(
          fmt::format("--only {} and --without {} leave nothing of it", text, fmt::join(selection.without, " ")));
    result.included.insert(result.included.end(), of_text.begin(), of_text.end());
  }
  return result;
}

std::string text_of(const EchoSelection& selection) {
  if (selection.only.empty() && selection.without.empty()) return "all";
  return fmt::format("{}{}{}", selection.only.empty() ? "all" : fmt::format("only {}", fmt::join(selection.only, " ")),
                     selection.without.empty() ? "" : " without ", fmt::join(selection.without, " "));
}

std::vector<std::string> like_names() {
  std::vector<std::string> names;
  for (const LikeProgram& program : kLikePrograms) names.emplace_back(program.name);
  return names;
}

const LikeProgram& like_program(std::string_view name) {
  for (const LikeProgram& program : kLikePrograms) {
    if (program.name == name) return program;
  }
  throw InputError(fmt::format("like: value '{}': must be one of {}", name, fmt::join(like_names(), ", ")));
}

const LikeProgram* like_program_of_reader(std::string_view reader) {
  const auto says = [&](std::string_view word) { return reader.find(word) != std::string_view::npos; };
  if (says("HFSS") || says("PyAEDT")) return &like_program("hfss");
  if (says("FEKO")) return &like_program("feko");
  if (says("CST")) return &like_program("cst");
  return nullptr;
}

RcsRequest solved_like(RcsRequest request, const LikeProgram& program, const GivenSettings& given) {
  request.like = program.name;
  if (!given.crease) request.crease_deg = program.flat ? std::optional(0.0) : std::nullopt;
  if (!given.edges) request.edges = program.edges;
  if (!given.max_bounces) request.max_bounces = program.max_bounces;
  return request;
}

std::string solver_text(const RcsRequest& request) {
  const std::string facets = !request.crease_deg       ? "surfaces smooth as the mesh says"
                             : *request.crease_deg > 0 ? fmt::format("crease angle {:g} deg", *request.crease_deg)
                                                       : "flat facets";
  return fmt::format("{}, {} edge diffraction, at most {} bounces, method {}{}", facets, request.edges ? "with" : "no",
                     request.max_bounces, kSolverMethodNames[static_cast<int>(request.method)],
                     request.like.empty() ? "" : " (--like " + request.like + ")");
}

}  // namespace seaglint
