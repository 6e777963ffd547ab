// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/view_export.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/text/number.h"
#include "sim/core/text/suggestion.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/scattering/response/scattering_centres_3d.h"
#include "sim/scattering/response/scattering_matrix.h"
#include "tools/cli/command.h"

namespace seaglint {
namespace {

constexpr const char* kMechanismNames[] = {"po", "edge"};

double level_of(double sigma_m2) { return 10 * std::log10(std::max(sigma_m2, 1e-100)); }

EchoSelector selector(const std::string& option, const std::string& text, const TriangleMesh& mesh) {
  const std::size_t equals = text.find('=');
  const std::string kind = text.substr(0, equals), value = equals == std::string::npos ? "" : text.substr(equals + 1);
  if (kind == "part") {
    const auto place = std::find(mesh.part_names.begin(), mesh.part_names.end(), value);
    if (place == mesh.part_names.end())
      throw InputError(fmt::format("{} {}: no part '{}': {}", option, text, value, suggestion(value, mesh.part_names)));
    return {EchoSelector::Kind::kPart, static_cast<int>(place - mesh.part_names.begin())};
  }
  if (kind == "bounces") {
    const std::optional<double> count = parse_number(value);
    if (!count || *count < 1 || *count > kMostBounces || *count != std::floor(*count))
      throw InputError(fmt::format("{} {}: bounces must be 1, 2, ... {}", option, text, kMostBounces));
    return {EchoSelector::Kind::kBounces, static_cast<int>(*count)};
  }
  if (kind == "mechanism") {
    for (int i = 0; i < static_cast<int>(std::size(kMechanismNames)); ++i) {
      if (value == kMechanismNames[i]) return {EchoSelector::Kind::kMechanism, i};
    }
    throw InputError(
        fmt::format("{} {}: the mechanism must be one of {}", option, text, fmt::join(kMechanismNames, ", ")));
  }
  throw InputError(fmt::format("{} {}: must be part=NAME, bounces=N or mechanism=NAME", option, text));
}

// Nine samples of matplotlib's viridis (Smith and van der Walt, CC0), sRGB.
constexpr double kViridis[9][3] = {{0x44, 0x01, 0x54}, {0x47, 0x2c, 0x7a}, {0x3b, 0x51, 0x8b},
                                   {0x2c, 0x71, 0x8e}, {0x21, 0x90, 0x8d}, {0x27, 0xad, 0x81},
                                   {0x5c, 0xc8, 0x63}, {0xaa, 0xdc, 0x32}, {0xfd, 0xe7, 0x25}};

// Linear light of viridis at 0..1 (glTF wants linear factors; IEC 61966-2-1).
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

void write_centres(const ViewExportArguments& arguments, const TriangleMesh& mesh,
                   const std::vector<EchoCentre>& centres, const std::string& heading) {
  std::array<Complex, 4> all{}, kept{};
  const double floor = centres.empty() ? 0 : centres.front().strength() * std::pow(10.0, -arguments.range_db / 10);
  std::string rows;
  std::size_t count = 0;
  for (const EchoCentre& c : centres) {
    for (std::size_t i = 0; i < 4; ++i) all[i] += c.amplitude[i];
    if (c.strength() < floor || c.strength() == 0) continue;
    ++count;
    for (std::size_t i = 0; i < 4; ++i) kept[i] += c.amplitude[i];
    const Vec3 x = c.position();
    rows += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g}", x.x(), x.y(), x.z(), c.psi);
    for (const Complex& s : c.amplitude) rows += fmt::format(",{:.9g},{:.9g}", s.real(), s.imag());
    rows += fmt::format(",{:.4f},{},{},{}\n", level_of(c.strength()), mesh.part_names[c.part], c.bounces,
                        kMechanismNames[static_cast<int>(c.mechanism)]);
  }
  double missing = 0, size = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    missing += std::norm(all[i] - kept[i]);
    size += std::norm(all[i]);
  }
  write_file(arguments.centres, heading +
                                    fmt::format("# {} of {} centres, down to {:g} dB below the strongest; cells of "
                                                "{:g} m; their sum misses {:.1f} dB of the view's S\n"
                                                "# S(k + dk, r^ + d) = sum of s e^{{j dk psi + j (k + dk) 2 x.d}}; "
                                                "amplitudes s at k and r^ in metres, psi = minus the two-way path\n"
                                                "x_m,y_m,z_m,psi_m,hh_re,hh_im,hv_re,hv_im,vh_re,vh_im,vv_re,vv_im,"
                                                "strongest_dbsm,part,bounces,mechanism\n",
                                                count, centres.size(), arguments.range_db, arguments.cell_m,
                                                size > 0 ? level_of(missing / size) : -1000.0) +
                                    rows);
  fmt::print("{}: {} of {} scattering centres\n", arguments.centres, count, centres.size());
}

// The mesh with one material for each 2 dB of strength; what is weaker than the range, or answers nothing, has the
// lowest colour.
void write_hot_spots(const ViewExportArguments& arguments, const TriangleMesh& mesh, const Scatterer& scatterer,
                     const std::vector<std::array<Complex, 4>>& echoes) {
  constexpr double kStep_db = 2;
  const std::size_t facets = scatterer.facets().size();
  // A panel's facets answer together.
  std::vector<std::array<Complex, 4>> panel(facets);
  for (std::size_t f = 0; f < facets; ++f) {
    for (std::size_t i = 0; i < 4; ++i)
      panel[static_cast<std::size_t>(scatterer.panels().of(static_cast<int>(f)))][i] += echoes[f][i];
  }
  std::vector<double> level(facets, level_of(0));
  double highest = level_of(0);
  for (std::size_t f = 0; f < facets; ++f) {
    double most = 0;
    for (const Complex& s : panel[static_cast<std::size_t>(scatterer.panels().of(static_cast<int>(f)))])
      most = std::max(most, std::norm(s));
    level[f] = level_of(4 * kPi * most);
    highest = std::max(highest, level[f]);
  }
  const bool silent = highest <= level_of(0);
  const double top = silent ? 0 : std::ceil(highest / kStep_db) * kStep_db;
  const int steps = static_cast<int>(std::ceil(arguments.range_db / kStep_db));
  TriangleMesh coloured;
  coloured.part_names = mesh.part_names;
  std::vector<std::array<double, 3>> colours;
  for (int i = 0; i <= steps; ++i) {  // 0: below the range
    const double from = top - (steps - i + 1) * kStep_db;
    coloured.materials.push_back({i == 0 ? fmt::format("below {:g} dBsm", from + kStep_db)
                                         : fmt::format("{:g} to {:g} dBsm", from, from + kStep_db)});
    colours.push_back(i == 0 ? std::array<double, 3>{0.02, 0.02, 0.025} : viridis((i - 0.5) / steps));
  }
  for (std::size_t f = 0; f < facets; ++f) {
    const auto first = static_cast<std::uint32_t>(coloured.vertices.size());
    for (const Vec3& corner : scatterer.facets()[f].corner) coloured.vertices.push_back(corner);
    coloured.triangles.push_back({first, first + 1, first + 2});
    coloured.triangle_part.push_back(scatterer.facets()[f].part);
    const int step = steps + 1 - static_cast<int>(std::floor((top - level[f]) / kStep_db)) - 1;
    coloured.triangle_material.push_back(static_cast<std::uint16_t>(std::clamp(step, 0, steps)));
  }
  write_coloured_mesh(arguments.hot_spots, welded(coloured), colours);
  fmt::print("{}: facets by the strength of what leaves them, {}\n", arguments.hot_spots,
             silent ? "no echo in this view" : fmt::format("up to {:.1f} dBsm", highest));
}

}  // namespace

void ViewExportArguments::add_to(CLI::App& command) {
  const auto selectors = [&](const char* name, std::vector<std::string>& values, const char* what) {
    command.add_option(name, values, what)
        ->type_name("KIND=VALUE")
        ->allow_extra_args(false)
        ->group("Selection and export");
  };
  selectors("--only", only,
            "Sum only the echoes of part=NAME, of bounces=N, of mechanism=po or edge (repeatable; of one kind any, of "
            "several kinds all must hold)");
  selectors("--without", without, "Leave out the echoes of any of these (repeatable)");
  command.add_option("--export-centres", centres, "Scattering centres of one view at one frequency, as CSV")
      ->group("Selection and export");
  command.add_option("--centre-cell-m", cell_m, "Size of the cells whose contributions become one centre")
      ->check(number_within(1e-4, 100.0))
      ->capture_default_str()
      ->group("Selection and export");
  command
      .add_option("--export-hot-spots", hot_spots,
                  "The mesh, .glb or .gltf, its facets coloured by the strength of what leaves them in one view")
      ->group("Selection and export");
  command.add_option("--export-range-db", range_db, "Weakest of the exports below the strongest")
      ->check(number_within(2.0, 300.0))
      ->capture_default_str()
      ->group("Selection and export");
}

EchoFilter ViewExportArguments::filter(const TriangleMesh& mesh, int max_bounces, bool edges) const {
  EchoFilter result;
  for (const std::string& text : without) result.without.push_back(selector("--without", text, mesh));
  for (const std::string& text : only) {
    const EchoSelector one = selector("--only", text, mesh);
    if (one.kind == EchoSelector::Kind::kBounces && one.value > max_bounces)
      throw InputError(
          fmt::format("--only {} requires --max-bounces {} or more; {} are followed", text, one.value, max_bounces));
    if (one.kind == EchoSelector::Kind::kMechanism && one.value == static_cast<int>(Mechanism::kEdge) && !edges)
      throw InputError(fmt::format("--only {} requires --edges on", text));
    const auto same = [&](const EchoSelector& other) { return other.kind == one.kind && other.value == one.value; };
    if (std::any_of(result.without.begin(), result.without.end(), same))
      throw InputError(fmt::format("--only {0} and --without {0} leave nothing of it", text));
    result.only.push_back(one);
  }
  return result;
}

std::string ViewExportArguments::text() const {
  if (only.empty() && without.empty()) return "everything";
  return fmt::format("only {}{}{}", only.empty() ? "everything" : fmt::format("{}", fmt::join(only, " ")),
                     without.empty() ? "" : " without ", fmt::join(without, " "));
}

void export_view(const ViewExportArguments& arguments, const TriangleMesh& mesh, const Scatterer& scatterer,
                 const RadarBasis& radar, double k, const IlluminationSettings& settings, const std::string& heading,
                 int threads, const StopFlag* stop) {
  const SplitSettings split{k, default_turn(scatterer, 2 * kPi / k)};
  const std::vector<Contribution> contributions =
      view_contributions(scatterer, monostatic(radar), split, settings, threads, stop);
  if (!arguments.centres.empty())
    write_centres(arguments, mesh, centres_of(contributions, k, arguments.cell_m), heading);
  if (!arguments.hot_spots.empty())
    write_hot_spots(arguments, mesh, scatterer, facet_echoes(contributions, k, scatterer.facets().size()));
}

}  // namespace seaglint
