// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/scatterer/prepare_target.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/principal_axes.h"
#include "sim/core/process/error.h"
#include "sim/core/text/suggestion.h"
#include "sim/geometry/mesh/mesh_diagnostics.h"
#include "sim/geometry/placement/mesh_placement.h"
#include "sim/geometry/placement/waterline.h"
#include "sim/scenario/material_file.h"

namespace seaglint {

std::vector<MaterialSpec> assign_materials(TriangleMesh& mesh, const MaterialSpec& all,
                                           std::span<const PartMaterial> parts) {
  std::vector<MaterialSpec> materials{all};
  // Number of the last entry that applies.
  std::vector<std::uint16_t> of_part(mesh.part_names.size(), 0), of_file_material(mesh.materials.size(), 0);
  for (const PartMaterial& entry : parts) {
    const bool prefix = entry.part.ends_with('*');
    const std::string name = prefix ? entry.part.substr(0, entry.part.size() - 1) : entry.part;
    const auto number = static_cast<std::uint16_t>(materials.size());
    const auto applies = [&](const std::string& other, std::uint16_t& last) {
      const bool matches = prefix ? other.starts_with(name) : other == name;
      if (matches) last = number;
      return matches;
    };
    bool found = false, found_material = false;
    for (std::size_t part = 0; part < of_part.size(); ++part)
      found = applies(mesh.part_names[part], of_part[part]) || found;
    // Faces without a material of their own have the default's name.
    for (std::size_t m = 0; !found && m < of_file_material.size(); ++m) {
      if (mesh.materials[m].name != Material{}.name)
        found_material = applies(mesh.materials[m].name, of_file_material[m]) || found_material;
    }
    if (!found && !found_material) {
      throw InputError(
          fmt::format("part '{}': the mesh has no such part: {}", entry.part, suggestion(entry.part, mesh.part_names)));
    }
    materials.push_back(entry.material);
  }
  mesh.materials.clear();
  for (const MaterialSpec& material : materials) mesh.materials.push_back({material.name});
  mesh.triangle_material.resize(mesh.triangles.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::uint16_t& material = mesh.triangle_material[t];
    material = material < of_file_material.size() ? of_file_material[material] : std::uint16_t{0};
    if (t < mesh.triangle_part.size()) material = std::max(material, of_part[mesh.triangle_part[t]]);
  }
  return materials;
}

void cut_at_sea_level(TriangleMesh& mesh, std::vector<MaterialSpec>& materials, double height) {
  WaterlineCut cut = cut_at_waterline(mesh, height);
  mesh = std::move(cut.mesh);
  MaterialSpec water;
  water.name = "under_water";
  water.kind = SurfaceKind::kSubmerged;
  mesh.triangle_material.resize(mesh.triangles.size(), 0);
  for (std::size_t t = 0; t < cut.submerged.size(); ++t) {
    if (cut.submerged[t]) mesh.triangle_material[t] = static_cast<std::uint16_t>(materials.size());
  }
  mesh.materials.push_back({water.name});
  materials.push_back(water);
}

void check_frequencies(std::span<const MaterialSpec> materials, double lowest_hz, double highest_hz) {
  for (const MaterialSpec& material : materials) {
    if (lowest_hz < 1e9 * material.lowest_ghz || highest_hz > 1e9 * material.highest_ghz) {
      throw InputError(fmt::format("material {}: its source covers {} to {} GHz, asked for {:.6g} to {:.6g} GHz",
                                   material.name, material.lowest_ghz, material.highest_ghz, 1e-9 * lowest_hz,
                                   1e-9 * highest_hz));
    }
  }
}

namespace {

// Smallest size in wavelengths: physical optics of a plate this wide has an error of 1 dB at normal incidence.
constexpr double kMinWavelengths = 3;
constexpr double kLongestTarget_m = 5e3;  // ten times the longest ships
// Half-sizes from the origin, warning and error: the echo is exact there too, but such a centre of rotation is hardly
// meant.
constexpr double kFarOrigin = 10, kTooFarOrigin = 300;
constexpr std::size_t kManyTriangles = 1'000'000;
// Memory and time per million triangles on two cores: of a sphere, whose facets are merged, and of one with noise of
// half a side, whose edges are all sharp.
constexpr double kGigabytesOfSmooth = 0.4, kGigabytesOfSharp = 2;
constexpr double kSecondsToBuild = 8, kSecondsOfSmooth = 0.1, kSecondsOfSharp = 22;

constexpr double kNarrow = 1.0 / 3, kThinBar = 0.7;  // wavelengths
// wavelengths: error 0.2 dB (soft) and 0.8 dB (hard) of a strip's echo (sim/scattering/coefficients/README.md, "Thick
// sheets").
constexpr double kThickSheet = 0.1;

// Area of the panel of a facet, m^2.
double panel_area(const Scatterer& scatterer, int facet) {
  double area = 0;
  for (const int member : scatterer.panels().members(scatterer.panels().representative(facet))) {
    const auto& corner = scatterer.facets()[member].corner;
    area += 0.5 * (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm();
  }
  return area;
}

// Lengths by part.
class LengthByPart {
 public:
  void add(std::uint16_t part, double length) {
    if (of_part_.size() <= part) of_part_.resize(part + 1u, 0);
    of_part_[part] += length;
    total_ += length;
  }
  double total() const { return total_; }
  // "; most of it: part 'x'"; empty without names.
  std::string longest(std::span<const std::string> names) const {
    const auto part = static_cast<std::size_t>(std::ranges::max_element(of_part_) - of_part_.begin());
    return part < names.size() ? fmt::format("; most of it: part '{}'", names[part]) : "";
  }

 private:
  std::vector<double> of_part_;
  double total_ = 0;
};

// Whether a sharp edge of materials has no diffraction coefficient (Scatterer): concave, or between sheets. Images are
// a good approximation at right angles and at others that divide pi.
bool is_left_out(const Scatterer& scatterer, std::size_t number) {
  const SharpEdge& edge = scatterer.edges().edges[number];
  const auto is_submerged = [&](int facet) {
    return scatterer.materials()[scatterer.facets()[facet].material].kind == SurfaceKind::kSubmerged;
  };
  if (edge.conducts || is_submerged(edge.facet[0]) || is_submerged(edge.facet[1])) return false;
  const double N = edge.front_wedge.N;
  if (N < 1 && std::abs(std::sin(kPi / N)) < 1e-3) return false;
  const auto& sides = scatterer.edges().edges_of_facet[edge.facet[0]];
  return std::ranges::find(sides, static_cast<int>(number)) == sides.end();
}

// Extents of a surface along its principal axes, m, and the numbers of its facets and of the curved ones.
struct SurfaceShape {
  Vec3 centre = Vec3::Zero(), lower = Vec3::Zero(), upper = Vec3::Zero();
  Mat3 moment = Mat3::Zero();  // of the corners; later their principal axes
  std::size_t facets = 0, curved = 0;
  std::uint16_t part = 0;
};

std::vector<SurfaceShape> surface_shapes(const Scatterer& scatterer) {
  const std::span<const Facet> facets = scatterer.facets();
  std::vector<SurfaceShape> shapes(scatterer.bodies().radius.size());
  const auto at = [&](std::size_t facet) -> SurfaceShape& {
    return shapes[static_cast<std::size_t>(scatterer.bodies().surface_of[facet])];
  };
  for (std::size_t f = 0; f < facets.size(); ++f) {
    SurfaceShape& shape = at(f);
    for (const Vec3& x : facets[f].corner) shape.centre += x / 3;
    if (shape.facets++ == 0) shape.part = facets[f].part;
    if (scatterer.surface().curved(static_cast<int>(f))) ++shape.curved;
  }
  for (SurfaceShape& shape : shapes) shape.centre /= static_cast<double>(shape.facets);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (const Vec3& x : facets[f].corner) at(f).moment += outer_product(x - at(f).centre, x - at(f).centre);
  }
  for (SurfaceShape& shape : shapes) shape.moment = principal_axes(shape.moment).axes;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (const Vec3& corner : facets[f].corner) {
      const Vec3 x = at(f).moment.transpose() * (corner - at(f).centre);
      at(f).lower = at(f).lower.cwiseMin(x);
      at(f).upper = at(f).upper.cwiseMax(x);
    }
  }
  return shapes;
}

}  // namespace

std::vector<std::string> check_target(const TriangleMesh& mesh, double lowest_hz) {
  std::vector<std::string> found;
  const Bounds box = bounds(mesh);
  const Vec3 size = box.upper - box.lower, centre = (box.upper + box.lower) / 2;
  const double longest = size.norm(), wavelength = kSpeedOfLight / lowest_hz;
  if (longest > kLongestTarget_m)
    found.push_back(fmt::format("the target is {:.4g} m across; is its unit right?", longest));
  if (longest < kMinWavelengths * wavelength) {
    found.push_back(fmt::format(
        "the target is {:.3g} m across, {:.3g} wavelengths at {:g} GHz; physical optics needs {:g} and more{}", longest,
        longest / wavelength, lowest_hz * 1e-9, kMinWavelengths, longest < 0.01 ? "; is its unit right?" : ""));
  }

  const double distance = centre.norm() / std::max(longest / 2, 1e-300);
  if (distance > kTooFarOrigin) {
    throw InputError(
        fmt::format("the target of {:.4g} m is centred {:.4g} m from the origin, its centre of rotation and phase "
                    "centre: translate the mesh (offset_m, --offset-m)",
                    longest, centre.norm()));
  }
  if (distance > kFarOrigin)
    found.push_back(
        fmt::format("the target of {:.4g} m is centred {:.4g} m from the origin, its centre of rotation and phase "
                    "centre",
                    longest, centre.norm()));

  if (mesh.triangles.size() > kManyTriangles) {
    const double millions = 1e-6 * static_cast<double>(mesh.triangles.size());
    const auto of_all = [&](double per_million) { return std::ceil(per_million * millions); };
    found.push_back(fmt::format(
        "{:.1f} million triangles: expect {:.0f} to {:.0f} GB of memory, the more the more of its edges are "
        "sharp, about {:.0f} s before the first view and {:.0f} to {:.0f} s for every view",
        millions, of_all(kGigabytesOfSmooth), of_all(kGigabytesOfSharp), of_all(kSecondsToBuild),
        of_all(kSecondsOfSmooth), of_all(kSecondsOfSharp)));
  }
  return found;
}

std::vector<std::string> check_edges(const Scatterer& scatterer, bool followed, double lowest_hz, double highest_hz,
                                     std::span<const std::string> part_names) {
  const double longest = kSpeedOfLight / lowest_hz, shortest = kSpeedOfLight / highest_hz,
               thickness = scatterer.sheet_thickness();
  const auto no_effect = [&](const char* why) {
    return fmt::format("sheet thickness of {:g} mm has no effect: {}", 1e3 * thickness, why);
  };
  if (!followed) return thickness > 0 ? std::vector{no_effect("edges are off")} : std::vector<std::string>{};
  const SharpEdges& edges = scatterer.edges();
  double all = 0;
  LengthByPart narrow, left_out;
  for (std::size_t number = 0; number < edges.edges.size(); ++number) {
    const SharpEdge& edge = edges.edges[number];
    const double length = edge.length();
    const std::uint16_t part = scatterer.facets()[edge.facet[0]].part;
    all += length;
    const auto is_narrow = [&](int facet) { return panel_area(scatterer, facet) < kNarrow * longest * length; };
    if (length > longest && is_narrow(edge.facet[0]) && is_narrow(edge.facet[1])) narrow.add(part, length);
    if (length > longest && is_left_out(scatterer, number)) left_out.add(part, length);
  }
  // Edges of materials have no thickness.
  const bool any_free_edge = std::ranges::any_of(edges.panel_edges, [&](const PanelEdge& side) {
    const SharpEdge& edge = edges.edges[side.edge];
    return edge.conducts && edge.front_wedge.thickness_m > 0;
  });
  std::vector<std::string> found;
  if (narrow.total() > 0) {
    found.push_back(
        fmt::format("{:.3g} m of {:.3g} m of diffracting edges belong to bars or strips narrower than a third of a "
                    "wavelength at {:g} GHz: half-plane diffraction overestimates their echo{}",
                    narrow.total(), all, lowest_hz * 1e-9, narrow.longest(part_names)));
  }
  if (left_out.total() > 0) {
    found.push_back(
        fmt::format("{:.3g} m of {:.3g} m of edges do not diffract: concave ones of materials that are no perfect "
                    "conductors, and those between sheets with air behind{}",
                    left_out.total(), all, left_out.longest(part_names)));
  }
  if (thickness > 0 && !any_free_edge) {
    found.push_back(no_effect("no surface is open and a perfect conductor"));
  } else if (thickness > kThickSheet * shortest) {
    found.push_back(
        fmt::format("sheets of {:g} mm are {:.2g} wavelengths thick at {:g} GHz: the correction of their edge "
                    "diffraction is of first order, valid up to a tenth",
                    1e3 * thickness, thickness / shortest, highest_hz * 1e-9));
  }
  return found;
}

std::vector<std::string> check_bars(const Scatterer& scatterer, double lowest_hz,
                                    std::span<const std::string> part_names) {
  const double wavelength = kSpeedOfLight / lowest_hz;
  LengthByPart thin;
  for (const SurfaceShape& shape : surface_shapes(scatterer)) {
    Vec3 extent = shape.upper - shape.lower;
    std::ranges::sort(extent);
    const bool round = 2 * shape.curved > shape.facets;
    if (round && extent[2] > wavelength && extent[1] < kThinBar * wavelength) thin.add(shape.part, extent[2]);
  }
  if (thin.total() == 0) return {};
  return {
      fmt::format("{:.3g} m of round bars are thinner than {:g} wavelengths at {:g} GHz: physical optics of them errs "
                  "by up to 3 dB, below 0.1 wavelengths by 7 dB and more{}",
                  thin.total(), kThinBar, lowest_hz * 1e-9, thin.longest(part_names))};
}

namespace {

void append(std::vector<std::string>& sentences, const std::vector<std::string>& more) {
  sentences.insert(sentences.end(), more.begin(), more.end());
}

// Result of `work`; prefixes its error messages with the place.
template <class Work>
auto at_place(const std::string& place, const Work& work) {
  try {
    return work();
  } catch (const InputError& error) {
    if (place.empty()) throw;
    std::vector<std::string> messages = messages_of(error);
    for (std::string& message : messages) message = fmt::format("{}: {}", place, message);
    throw_input_errors(std::move(messages));
  }
}

std::vector<MaterialSpec> choose_materials(const TargetSource& source, TriangleMesh& mesh) {
  MaterialSpec all;
  std::vector<PartMaterial> parts;
  for (const MaterialChoice& choice : source.materials) {
    const MaterialSpec material = find_material(choice.material, source.material_folder, choice.place);
    if (choice.part) {
      parts.push_back({*choice.part, material});
    } else {
      all = material;
    }
  }
  std::vector<MaterialSpec> materials =
      at_place(source.materials_place, [&] { return assign_materials(mesh, all, parts); });
  at_place(source.frequencies_place, [&] { check_frequencies(materials, source.lowest_hz, source.highest_hz); });
  return materials;
}

}  // namespace

SolverMesh load_solver_mesh(const TargetSource& source) {
  SolverMesh target{
      source.loaded ? placed(*source.loaded, source.placement) : read_placed_mesh(source.mesh, source.placement),
      {},
      {}};
  target.materials = choose_materials(source, target.mesh);
  at_place(source.mesh_place, [&] {
    RepairedMesh repaired = diagnose_and_repair(target.mesh);
    target.warnings = diagnostic_messages(repaired.health);
    target.mesh = std::move(repaired.mesh);
    if (target.mesh.triangles.empty()) throw InputError("no triangle has an area: nothing scatters");
    append(target.warnings, check_target(target.mesh, source.lowest_hz));
  });
  return target;
}

PreparedTarget prepare_target(SolverMesh mesh, const ScattererSettings& settings) {
  PreparedTarget target{std::move(mesh.mesh), std::move(mesh.materials), {}, std::move(mesh.warnings), nullptr};
  if (settings.waterline_m) {
    AboveWater above = above_water(target.mesh, *settings.waterline_m);
    target.below = above.below;
    if (settings.sea_reflects) {
      cut_at_sea_level(target.mesh, target.materials, *settings.waterline_m);
    } else {
      target.mesh = std::move(above.mesh);
    }
  }
  target.scatterer =
      std::make_shared<const Scatterer>(target.mesh, target.materials, settings.crease_rad, settings.sheet_thickness_m,
                                        merging_tolerance(settings.highest_hz));
  append(target.warnings, check_edges(*target.scatterer, settings.edges, settings.lowest_hz, settings.highest_hz,
                                      target.mesh.part_names));
  append(target.warnings, check_bars(*target.scatterer, settings.lowest_hz, target.mesh.part_names));
  return target;
}

}  // namespace seaglint
