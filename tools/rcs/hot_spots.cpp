// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/hot_spots.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <tuple>
#include <utility>

#include "seaglint_version.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/printable.h"
#include "sim/field_tables/field_table.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/placement/waterline.h"
#include "tools/figure/mesh_picture.h"
#include "tools/page/html.h"
#include "tools/rcs/rcs_table.h"

namespace seaglint {

FacetLevels facet_levels(const Scatterer& scatterer, std::span<const Point> points, double k, ShownElement element) {
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

// Level of a scattering matrix in an element, or the largest of the four.
double level_of(const std::array<Complex, 4>& s, ShownElement element) {
  double most = 0;
  for (std::size_t i = 0; i < 4; ++i)
    if (!element || *element == i) most = std::max(most, std::norm(s[i]));
  return dbsm_of_area(4 * kPi * most);
}

std::string name_of(ShownElement element) {
  return element ? kPolarisationNames[*element] : "largest of hh, hv, vh, vv";
}

using Segment = std::array<Vec3, 2>;

// The section of the mesh at z = 0, in segments; none where it does not reach that plane.
std::vector<Segment> waterline_of(const TriangleMesh& mesh) {
  const WaterlineCut cut = cut_at_waterline(mesh, 0);
  const double margin = waterline_margin(bounds(mesh));
  std::vector<Segment> segments;
  for (std::size_t t = 0; t < cut.mesh.triangles.size(); ++t) {
    if (cut.submerged[t]) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &a = cut.mesh.vertices[cut.mesh.triangles[t][i]],
                 &b = cut.mesh.vertices[cut.mesh.triangles[t][(i + 1) % 3]];
      if (std::abs(a.z()) <= margin && std::abs(b.z()) <= margin) segments.push_back({a, b});
    }
  }
  return segments;
}

constexpr int kPositionDigits = 16;  // binary digits of a coordinate: 2 mm of a 144 m ship

std::string packed_points(std::span<const Vec3> points) {
  std::vector<double> coordinates;
  for (const Vec3& point : points) coordinates.insert(coordinates.end(), point.begin(), point.end());
  return packed_floats(coordinates, kPositionDigits);
}

// Vertex numbers, each as its difference from the one before, 32 bits little-endian: small numbers, which pack well.
std::string packed_triangles(const TriangleMesh& mesh) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(12 * mesh.triangles.size());
  std::uint32_t before = 0;
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) {
      const std::uint32_t difference = vertex - before;
      for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::uint8_t>(difference >> 8 * i));
      before = vertex;
    }
  }
  return packed(bytes);
}

// Index of the part of each triangle, 16 bits little-endian.
std::string packed_parts(const TriangleMesh& mesh) {
  std::vector<std::uint8_t> bytes;
  for (const std::uint16_t part : mesh.triangle_part)
    for (const int shift : {0, 8}) bytes.push_back(static_cast<std::uint8_t>(part >> shift));
  return packed(bytes);
}

double step_db(const HotSpotSettings& settings) { return std::ceil(settings.range_db / 250); }

// [x, y, z, part, bounces, mechanism, level of each element].
std::string centre_json(const ScatteringCentre3d& centre, const HotSpotSettings& settings) {
  const Vec3 x = centre.position();
  std::string text = fmt::format("[{:.3f},{:.3f},{:.3f},{},{},{}", x.x(), x.y(), x.z(), centre.part, centre.bounces,
                                 static_cast<int>(centre.mechanism));
  for (const ShownElement& element : settings.elements)
    text += fmt::format(",{:.1f}", level_of(centre.amplitude, element));
  return text + "]";
}

std::string view_json(const HotSpotView& view, const std::vector<double>& tops, const HotSpotSettings& settings) {
  const double step = step_db(settings);
  std::vector<std::string> levels, centres;
  for (std::size_t e = 0; e < tops.size(); ++e) {
    std::vector<std::uint8_t> steps;  // 0: settings.range_db below the top, or less
    for (const double level : view.levels[e].dbsm)
      steps.push_back(static_cast<std::uint8_t>(
          std::lround(std::clamp(level - tops[e] + settings.range_db, 0.0, settings.range_db) / step)));
    levels.push_back("\"" + packed(steps) + "\"");
  }
  for (const ScatteringCentre3d& centre : view.centres) centres.push_back(centre_json(centre, settings));
  return fmt::format(R"({{"azimuth_deg":{},"elevation_deg":{},"total_dbsm":[{:.2f}],"levels":[{}],"centres":[{}]}})",
                     view.azimuth_deg, view.elevation_deg, fmt::join(view.total_dbsm, ","), fmt::join(levels, ","),
                     fmt::join(centres, ","));
}

std::string target_json(const HotSpotTarget& target, const HotSpotSettings& settings) {
  std::vector<double> tops;
  for (std::size_t e = 0; e < settings.elements.size(); ++e) {
    double top = dbsm_of_area(0);
    for (const HotSpotView& view : target.views) top = std::max(top, view.levels[e].highest_dbsm);
    tops.push_back(top <= dbsm_of_area(0) ? 0 : std::ceil(top));
  }
  const TriangleMesh mesh = welded(mesh_of_facets(target.scatterer));
  std::vector<Vec3> waterline;
  for (const Segment& segment : waterline_of(mesh)) waterline.insert(waterline.end(), segment.begin(), segment.end());
  std::vector<std::string> views, parts;
  for (const HotSpotView& view : target.views) views.push_back(view_json(view, tops, settings));
  for (const std::string& part : target.part_names) parts.push_back(json_string(part));
  return fmt::format(
      R"({{"name":{},"parts":[{}],"vertices":"{}","triangles":"{}","triangle_parts":"{}","waterline":"{}","top_dbsm":[{}],"views":[{}]}})",
      json_string(target.name), fmt::join(parts, ","), packed_points(mesh.vertices), packed_triangles(mesh),
      packed_parts(mesh), packed_points(waterline), fmt::join(tops, ","), fmt::join(views, ","));
}

}  // namespace

HotSpotView hot_spot_view(const Scatterer& scatterer, std::span<const Point> points, double k,
                          std::span<const ScatteringCentre3d> centres, const HotSpotSettings& settings) {
  HotSpotView view;
  std::array<Complex, 4> total{};
  for (const ScatteringCentre3d& centre : centres)
    for (std::size_t i = 0; i < 4; ++i) total[i] += centre.amplitude[i];
  std::vector<bool> shown(centres.size());
  for (const ShownElement& element : settings.elements) {
    view.levels.push_back(facet_levels(scatterer, points, k, element));
    view.total_dbsm.push_back(level_of(total, element));
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < centres.size(); ++i) order.emplace_back(-level_of(centres[i].amplitude, element), i);
    std::ranges::sort(order);
    for (std::size_t i = 0; i < std::min(order.size(), settings.most_centres); ++i) {
      const double level = -order[i].first;
      if (level <= dbsm_of_area(0) || level < -order[0].first - kBallRange_db) break;
      shown[order[i].second] = true;
    }
  }
  for (std::size_t i = 0; i < centres.size(); ++i)
    if (shown[i]) view.centres.push_back(centres[i]);
  return view;
}

std::string hot_spots_json(std::span<const HotSpotTarget> targets, const HotSpotSettings& settings) {
  std::vector<std::string> list, elements, mechanisms;
  for (const HotSpotTarget& target : targets) list.push_back(target_json(target, settings));
  for (const ShownElement& element : settings.elements) elements.push_back(json_string(name_of(element)));
  for (const char* words : kMechanismWords) mechanisms.push_back(json_string(words));
  return fmt::format(
      R"({{"range_db":{},"step_db":{},"ball_range_db":{},"elements":[{}],"mechanisms":[{}],"targets":[{}]}})",
      settings.range_db, step_db(settings), kBallRange_db, fmt::join(elements, ","), fmt::join(mechanisms, ","),
      fmt::join(list, ","));
}

namespace {

// One aspect of a request with its contributions.
struct ExportedView {
  const RcsRequest& request;
  const RcsTarget& target;
  std::span<const Point> points;
  double k = 0;
  std::vector<ScatteringCentre3d> centres;  // all, strongest first

  const Scatterer& scatterer() const { return *target.prepared.scatterer; }
  const std::string& part(const ScatteringCentre3d& centre) const {
    return target.prepared.mesh.part_names[centre.part];
  }
};

constexpr std::size_t kNamedCentres = 5, kListedCentres = 20, kListedSources = 12;
constexpr double kMinPrinted_dbsm = -100;  // lower ones are rounding

// The head of a table of scattering centres.
std::string heading(const RcsRequest& request, const Scatterer& scatterer) {
  return fmt::format(
      "# seaglint {} rcs: scattering centres\n# target {} {}, {:.9g} Hz, azimuth {:.9g} deg, elevation {:.9g} "
      "deg, max_bounces {}, edges {}{}, contributions: {}\n"
      "# body frame, e^{{+jwt}}, phase origin at the body's origin, S_pq: q transmitted, p received; basis of "
      "CONVENTIONS.md\n",
      kVersion, request.target.string(), mesh_text(request), request.frequency_hz[0], request.azimuth_deg[0],
      request.elevation_deg[0], request.max_bounces, request.edges ? "on" : "off", method_text(request, scatterer),
      text_of(request.selection));
}

std::string write_centres(const ExportedView& view) {
  const ViewExport& arguments = view.request.exports;
  const std::vector<ScatteringCentre3d>& centres = view.centres;
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
    rows += fmt::format(",{:.4f},{},{},{}\n", dbsm_of_area(c.peak_rcs()), csv_cell(view.part(c)), c.bounces,
                        kMechanismNames[static_cast<int>(c.mechanism)]);
  }
  double missing = 0, size = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    missing += std::norm(all[i] - kept[i]);
    size += std::norm(all[i]);
  }
  write_file(arguments.centres, heading(view.request, view.scatterer()) +
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

// Linear RGB of viridis at 0..1 (glTF uses linear factors; sRGB conversion of IEC 61966-2-1).
std::array<double, 3> linear_viridis(double at) {
  Rgb colour = viridis(at);
  for (double& s : colour) s = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  return colour;
}

// Writes the mesh with one material per 2 dB of strength; facets without contribution or below the dynamic range have
// the lowest colour.
std::string write_coloured(const ExportedView& view) {
  const ViewExport& arguments = view.request.exports;
  const FacetLevels levels = facet_levels(view.scatterer(), view.points, view.k);
  constexpr double kStep_db = 2;
  const bool silent = levels.highest_dbsm <= dbsm_of_area(0);
  const double top = silent ? 0 : std::ceil(levels.highest_dbsm / kStep_db) * kStep_db;
  const int steps = static_cast<int>(std::ceil(arguments.range_db / kStep_db));
  TriangleMesh coloured = mesh_of_facets(view.scatterer());
  coloured.part_names = view.target.prepared.mesh.part_names;
  std::vector<std::array<double, 3>> colours;
  for (int i = 0; i <= steps; ++i) {  // 0: below the dynamic range
    const double from = top - (steps - i + 1) * kStep_db;
    coloured.materials.push_back({i == 0 ? fmt::format("below {:g} dBsm", from + kStep_db)
                                         : fmt::format("{:g} to {:g} dBsm", from, from + kStep_db)});
    colours.push_back(i == 0 ? std::array<double, 3>{0.02, 0.02, 0.025} : linear_viridis((i - 0.5) / steps));
  }
  for (const double level : levels.dbsm) {
    const int step = steps + 1 - static_cast<int>(std::floor((top - level) / kStep_db)) - 1;
    coloured.triangle_material.push_back(static_cast<std::uint16_t>(std::clamp(step, 0, steps)));
  }
  write_coloured_mesh(arguments.hot_spots, welded(coloured), colours);
  return fmt::format("{}: facets coloured by their RCS contribution, {}\n", arguments.hot_spots,
                     silent ? "no echo at this aspect" : fmt::format("up to {:.1f} dBsm", levels.highest_dbsm));
}

std::string level_text(double dbsm) {
  return dbsm < kMinPrinted_dbsm ? fmt::format("below {:g}", kMinPrinted_dbsm) : fmt::format("{:.1f}", dbsm);
}

// "3 bounces", of edges "multiple edge diffraction".
std::string mechanism_text(const ScatteringCentre3d& centre) {
  if (centre.mechanism != Mechanism::kPhysicalOptics)
    return kMechanismWords[static_cast<std::size_t>(centre.mechanism)];
  return fmt::format("{} bounce{}", centre.bounces, centre.bounces == 1 ? "" : "s");
}

std::string view_text(const RcsRequest& request) {
  return fmt::format("{:g} GHz, azimuth {:g} deg, elevation {:g} deg", 1e-9 * request.frequency_hz[0],
                     request.azimuth_deg[0], request.elevation_deg[0]);
}

std::string title_of(const RcsRequest& request) {
  const std::string file = request.target.filename().string();
  return file.empty() ? "hot spots" : file + ": hot spots";
}

// "hh 18.6, hv 6.1, vh 6.1, vv 20.8 dBsm" of the sum of all centres.
std::string total_text(const ExportedView& view) {
  std::array<Complex, 4> total{};
  for (const ScatteringCentre3d& centre : view.centres)
    for (std::size_t i = 0; i < 4; ++i) total[i] += centre.amplitude[i];
  std::vector<std::string> levels;
  for (std::size_t i = 0; i < 4; ++i)
    levels.push_back(fmt::format("{} {}", kPolarisationNames[i], level_text(dbsm(total[i]))));
  return fmt::format("{} dBsm", fmt::join(levels, ", "));
}

std::string settings_text(const ExportedView& view) {
  const RcsRequest& request = view.request;
  return fmt::format("{} facets, edges {}, at most {} bounces{}, contributions: {}", view.scatterer().facets().size(),
                     request.edges ? "on" : "off", request.max_bounces, method_text(request, view.scatterer()),
                     text_of(request.selection));
}

// The target seen from the radar, by the largest of the four elements.
MeshFigure figure_of(const ExportedView& view) {
  const RcsRequest& request = view.request;
  const HotSpotView shown = hot_spot_view(view.scatterer(), view.points, view.k, view.centres, {});
  TriangleMesh mesh = mesh_of_facets(view.scatterer());
  std::vector<Segment> waterline = waterline_of(welded(mesh));
  const double highest = shown.levels[0].highest_dbsm, top = highest <= dbsm_of_area(0) ? 0 : std::ceil(highest);
  MeshFigure figure{.title = title_of(request) + ", seen from the radar",
                    .mesh = std::move(mesh),
                    .azimuth_deg = request.azimuth_deg[0],
                    .elevation_deg = request.elevation_deg[0],
                    .levels = shown.levels[0].dbsm,
                    .colour = {"facets (dBsm)", AxisRange{top - request.exports.range_db, top}},
                    .lines = std::move(waterline),
                    .line_name = "z = 0"};
  const double strongest = shown.centres.empty() ? 0 : dbsm_of_area(shown.centres.front().peak_rcs());
  figure.ball_range = {strongest - kBallRange_db, strongest};
  figure.ball_names = {"reflections", "edge diffraction"};
  figure.ball_unit = "dBsm";
  for (const ScatteringCentre3d& centre : shown.centres)
    figure.balls.push_back(
        {centre.position(), dbsm_of_area(centre.peak_rcs()), centre.mechanism != Mechanism::kPhysicalOptics});
  for (std::size_t i = 0; i < std::min(kNamedCentres, shown.centres.size()); ++i) {
    const ScatteringCentre3d& centre = shown.centres[i];
    figure.names.push_back({centre.position(),
                            {fmt::format("{} {}", i + 1, view.part(centre)), mechanism_text(centre),
                             fmt::format("{:.1f} dBsm", dbsm_of_area(centre.peak_rcs()))}});
  }
  figure.notes = {
      fmt::format("{}; levels: {}; whole echo {}", view_text(request), name_of(std::nullopt), total_text(view)),
      fmt::format("Balls: the {} strongest scattering centres of cells of {:g} m, down to {:g} dB below the "
                  "strongest. Facets of one plane have the level of their sum.",
                  shown.centres.size(), request.exports.cell_m, kBallRange_db),
      fmt::format("seaglint {}: {}", kVersion, settings_text(view))};
  return figure;
}

std::string written_text(const ExportedView& view, const char* what) {
  if (view.centres.empty() || view.centres.front().peak_rcs() == 0)
    return fmt::format("{}: {}, no echo at this aspect\n", view.request.exports.hot_spots, what);
  const ScatteringCentre3d& first = view.centres.front();
  return fmt::format("{}: {}, the strongest {}, {}, {:.1f} dBsm\n", view.request.exports.hot_spots, what,
                     view.part(first), mechanism_text(first), dbsm_of_area(first.peak_rcs()));
}

std::string write_picture(const ExportedView& view) {
  write_figure(figure_of(view), view.request.exports.hot_spots);
  return written_text(view, "picture of the hot spots");
}

// The levels of a scattering matrix as cells: the largest, then hh, hv, vh, vv.
void add_levels(std::vector<std::string>& row, const std::array<Complex, 4>& s) {
  for (const ShownElement element :
       {ShownElement(), ShownElement(0), ShownElement(1), ShownElement(2), ShownElement(3)})
    row.push_back(level_text(level_of(s, element)));
}

std::vector<std::string> source_cells(const ExportedView& view, const ScatteringCentre3d& centre) {
  return {escape_html(view.part(centre)), kMechanismWords[static_cast<std::size_t>(centre.mechanism)],
          fmt::format("{}", centre.bounces)};
}

std::string centres_table(const ExportedView& view) {
  std::vector<std::vector<std::string>> rows{
      {"", "part", "mechanism", "bounces", "x (m)", "y (m)", "z (m)", "dBsm", "hh", "hv", "vh", "vv"}};
  for (std::size_t i = 0; i < std::min(kListedCentres, view.centres.size()); ++i) {
    const ScatteringCentre3d& centre = view.centres[i];
    if (centre.peak_rcs() == 0) break;
    std::vector<std::string> row = source_cells(view, centre);
    row.insert(row.begin(), fmt::format("{}", i + 1));
    for (const double x : centre.position()) row.push_back(fmt::format("{:.3f}", x + 0.0));
    add_levels(row, centre.amplitude);
    rows.push_back(std::move(row));
  }
  return html_table(rows);
}

// The coherent sums of all centres of one part, bounce count and mechanism, strongest first.
std::vector<ScatteringCentre3d> sums_by_source(const ExportedView& view) {
  std::map<std::tuple<std::uint16_t, std::uint8_t, Mechanism>, ScatteringCentre3d> groups;
  for (const ScatteringCentre3d& centre : view.centres) {
    const auto [group, is_new] = groups.try_emplace({centre.part, centre.bounces, centre.mechanism}, centre);
    for (std::size_t i = 0; !is_new && i < 4; ++i) group->second.amplitude[i] += centre.amplitude[i];
  }
  std::vector<ScatteringCentre3d> sums;
  for (const auto& [source, sum] : groups) sums.push_back(sum);
  std::ranges::stable_sort(sums, std::ranges::greater{}, &ScatteringCentre3d::peak_rcs);
  return sums;
}

std::string sources_table(const ExportedView& view) {
  std::vector<std::vector<std::string>> rows{{"part", "mechanism", "bounces", "dBsm", "hh", "hv", "vh", "vv"}};
  for (const ScatteringCentre3d& sum : sums_by_source(view)) {
    if (rows.size() > kListedSources || sum.peak_rcs() == 0) break;
    std::vector<std::string> row = source_cells(view, sum);
    add_levels(row, sum.amplitude);
    rows.push_back(std::move(row));
  }
  return html_table(rows);
}

std::string write_page(const ExportedView& view) {
  const RcsRequest& request = view.request;
  const HotSpotSettings settings{request.exports.range_db, {std::nullopt, 0, 1, 2, 3}};
  HotSpotView shown = hot_spot_view(view.scatterer(), view.points, view.k, view.centres, settings);
  shown.azimuth_deg = request.azimuth_deg[0];
  shown.elevation_deg = request.elevation_deg[0];
  const std::string title = title_of(request);
  const HotSpotTarget target{
      request.target.filename().string(), view.scatterer(), view.target.prepared.mesh.part_names, {std::move(shown)}};
  const std::string body = filled(
      hot_spots_template(), {{"title", title},
                             {"view", view_text(request)},
                             {"total", total_text(view)},
                             {"hot_spots", hot_spots_json(std::span(&target, 1), settings)},
                             {"picture", html_picture(png_of(figure_of(view)), "", title + ", seen from the radar")},
                             {"cell_m", fmt::format("{:g}", request.exports.cell_m)},
                             {"ball_range_db", fmt::format("{:g}", kBallRange_db)},
                             {"range_db", fmt::format("{:g}", request.exports.range_db)},
                             {"centres", centres_table(view)},
                             {"sources", sources_table(view)},
                             {"settings", settings_text(view)},
                             {"version", kVersion}});
  write_file(request.exports.hot_spots, html_page(title + ", " + view_text(request), body, hot_spots_script()));
  return written_text(view, "page of the hot spots");
}

constexpr const char* kPictures[] = {".png", ".svg", ".pdf"};

std::string ending_of(const std::string& file) { return std::filesystem::path(file).extension().string(); }

}  // namespace

bool shows_centres(const std::string& file) {
  const std::string ending = ending_of(file);
  return ending == ".html" || std::ranges::find(kPictures, ending) != std::end(kPictures);
}

void require_hot_spots(const std::string& file) {
  const std::string ending = ending_of(file);
  if (!shows_centres(file) && ending != ".glb" && ending != ".gltf")
    throw InputError(fmt::format(
        "{}: hot spots need the ending .html (page), .png, .svg or .pdf (picture), .glb or .gltf (mesh)", file));
  require_writable(file);
  if (shows_centres(file)) require_gnuplot();
}

void require_hot_spots(const std::string& file, const RcsTarget& target) {
  const std::size_t facets = target.prepared.scatterer->facets().size();
  if (ending_of(file) == ".html" && facets > kPageFacets)
    throw InputError(fmt::format(
        "{}: {} facets are more than a page can contain ({}); a picture (.png) or a mesh (.glb) has no limit", file,
        facets, kPageFacets));
}

std::string export_view(const RcsRequest& request, const RcsTarget& target, std::span<const Point> points) {
  const ViewExport& exports = request.exports;
  ExportedView view{request, target, points, 2 * kPi * request.frequency_hz[0] / kSpeedOfLight, {}};
  if (!exports.centres.empty() || shows_centres(exports.hot_spots))
    view.centres = cluster_centres(points, view.k, exports.cell_m);
  std::string lines;
  if (!exports.centres.empty()) lines += write_centres(view);
  if (exports.hot_spots.empty()) return lines;
  if (!shows_centres(exports.hot_spots)) return lines + write_coloured(view);
  return lines + (ending_of(exports.hot_spots) == ".html" ? write_page(view) : write_picture(view));
}

}  // namespace seaglint
