// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "seaglint_version.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/standard_error.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/text/number.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/scattering/response/body_response.h"
#include "sim/scattering/target/part_materials.h"
#include "sim/scattering/target/target_check.h"
#include "sim/scenario/material_file.h"
#include "tools/cli/command.h"
#include "tools/figure/figure.h"
#include "tools/pipeline/solver_mesh.h"
#include "tools/pipeline/warnings.h"
#include "tools/rcs/rcs_comparison.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {
namespace {

std::vector<double> range(const std::string& option, const std::string& text, double lower, double upper) {
  std::vector<double> values;
  try {
    values = parse_range(text);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", option, error.what()));
  }
  for (const double value : values) {
    if (value < lower || value > upper)
      throw InputError(fmt::format("{}: value {}: must be {} <= x <= {}", option, value, lower, upper));
  }
  return values;
}

// Gives the mesh its materials; the specifications in the order of mesh.materials.
std::vector<MaterialSpec> choose_materials(const std::vector<std::string>& chosen, TriangleMesh& mesh) {
  MaterialSpec all;
  std::vector<PartMaterial> parts;
  for (const std::string& text : chosen) {
    const std::size_t equals = text.find('=');
    const std::string name = equals == std::string::npos ? text : text.substr(equals + 1);
    const MaterialSpec material = find_material(name, "", "--material " + text);
    if (equals == std::string::npos) {
      all = material;
    } else {
      parts.push_back({text.substr(0, equals), material});
    }
  }
  try {
    return assign_materials(mesh, all, parts);
  } catch (const InputError& error) {
    throw InputError(fmt::format("--material: {}", error.what()));
  }
}

double dbsm(const Complex& s) { return 10 * std::log10(std::max(4 * kPi * std::norm(s), 1e-30)); }

std::string table_text(const RcsArguments& arguments, const Scatterer& scatterer, const RcsSweep& sweep) {
  std::string csv = fmt::format(
      "# seaglint {} rcs\n# target {} unit {}: {} facets, radius {:.6g} m\n# material {}, echoes of {}\n{}# physical "
      "optics at every visible bounce, "
      "max_bounces {}, edges {}, crease_deg {:.6g}, sheet_thickness_mm {:.6g}, range_m {:.9g} (0 = far field), {}, "
      "ray_spacing_m {:.6g}\n{}# amplitudes in metres, e^{{+jwt}}, phase origin at the body's origin, S_pq: q "
      "transmitted, p received; basis of CONVENTIONS.md\n"
      "frequency_hz,azimuth_deg,elevation_deg,hh_re,hh_im,hv_re,hv_im,vh_re,vh_im,vv_re,vv_im,hh_dbsm,vv_dbsm\n",
      kVersion, arguments.target, arguments.unit, scatterer.facets().size(), scatterer.radius(),
      arguments.materials.empty() ? "pec" : fmt::format("{}", fmt::join(arguments.materials, " ")),
      arguments.view.text(), arguments.sea.text(), arguments.max_bounces, arguments.edges, arguments.crease_deg,
      arguments.sheet_thickness_mm, arguments.range_m,
      arguments.transmit_azimuth_deg
          ? fmt::format("transmitter at azimuth {:.9g} deg, elevation {:.9g} deg", *arguments.transmit_azimuth_deg,
                        arguments.transmit_elevation_deg.value_or(0))
          : "monostatic",
      arguments.ray_spacing_m > 0 ? arguments.ray_spacing_m : default_ray_spacing(scatterer),
      arguments.cavities.text());
  for (std::size_t q = 0; q < sweep.frequency_hz.size(); ++q) {
    for (std::size_t view = 0; view < sweep.views(); ++view) {
      const auto& s = sweep.models.back().matrices[view][q];
      csv +=
          fmt::format("{:.9g},{:.9g},{:.9g}", sweep.frequency_hz[q], sweep.azimuth_deg[view % sweep.azimuth_deg.size()],
                      sweep.elevation_deg[view / sweep.azimuth_deg.size()]);
      for (const Complex& x : s) csv += fmt::format(",{:.9g},{:.9g}", x.real(), x.imag());
      csv += fmt::format(",{:.4f},{:.4f}\n", dbsm(s[0]), dbsm(s[3]));
    }
  }
  return csv;
}

std::filesystem::path comparison_figure(const RcsArguments& arguments) {
  if (!arguments.reference.figure.empty()) return arguments.reference.figure;
  return std::filesystem::path(arguments.output).replace_extension(".png");
}

void compare(const RcsArguments& arguments, const std::vector<RcsReference>& references, const RcsSweep& sweep) {
  std::vector<PairedCut> cuts;
  for (const RcsReference& reference : references) {
    for (PairedCut& cut : pair_with(sweep, reference)) cuts.push_back(std::move(cut));
  }
  fmt::print("{}", difference_table(cuts, arguments.reference.floor_db));
  const std::filesystem::path figure = comparison_figure(arguments);
  const std::string title =
      fmt::format("{}, seaglint {}", std::filesystem::path(arguments.target).filename().string(), kVersion);
  if (draw_comparison(cuts, arguments.reference.floor_db, title, figure)) {
    fmt::print("Figure: {}\n", figure.string());
  } else {
    fmt::print("No figure: it needs a cut along azimuth, elevation or frequency of two points or more\n");
  }
}

void export_one_view(const RcsArguments& arguments, const TriangleMesh& mesh, const Scatterer& scatterer,
                     const EchoFilter& filter, const Shell& shell, const RcsSweep& sweep) {
  const std::string heading = fmt::format(
      "# seaglint {} rcs: scattering centres\n# target {} unit {}, {:.9g} Hz, azimuth {:.9g} deg, elevation {:.9g} "
      "deg, max_bounces {}, edges {}, of {}\n"
      "# body frame, e^{{+jwt}}, phase origin at the body's origin, S_pq: q transmitted, p received; basis of "
      "CONVENTIONS.md\n",
      kVersion, arguments.target, arguments.unit, sweep.frequency_hz[0], sweep.azimuth_deg[0], sweep.elevation_deg[0],
      arguments.max_bounces, arguments.edges, arguments.view.text());
  export_view(arguments.view, mesh, scatterer, basis_of(sweep, 0), 2 * kPi * sweep.frequency_hz[0] / kSpeedOfLight,
              {arguments.ray_spacing_m, arguments.max_bounces, arguments.edges == "on", filter, arguments.range_m},
              heading, thread_count(shell.threads), &shell.stop);
}

void run_rcs(const RcsArguments& arguments, const Shell& shell) {
  std::vector<std::filesystem::path> inputs(arguments.reference.files.begin(), arguments.reference.files.end());
  inputs.emplace_back(arguments.target);
  std::vector<std::string> outputs{arguments.output, arguments.view.centres, arguments.view.hot_spots};
  if (!arguments.reference.files.empty()) {
    outputs.push_back(comparison_figure(arguments));
    require_figure(outputs.back());
  }
  require_outputs(outputs, inputs);
  if (!arguments.view.hot_spots.empty()) require_coloured_mesh(arguments.view.hot_spots);
  RcsSweep sweep;
  sweep.frequency_hz = range("--frequency-ghz", arguments.frequency_ghz, 1e-3, 1000);
  for (double& f : sweep.frequency_hz) f *= 1e9;
  sweep.azimuth_deg = range("--azimuth-deg", arguments.azimuth_deg, -720, 720);
  sweep.elevation_deg = range("--elevation-deg", arguments.elevation_deg, -90, 90);
  if (arguments.transmit_azimuth_deg)
    sweep.transmitter = direction_at(*arguments.transmit_azimuth_deg, arguments.transmit_elevation_deg.value_or(0));
  warn_of_receivers_behind(sweep);
  arguments.sea.check(sweep.elevation_deg, sweep.frequency_hz);
  if (arguments.cavities.wanted() && (arguments.sea.reflection || arguments.range_m > 0 || arguments.view.wanted()))
    throw InputError(
        "--cavity is of the far field and the target alone: leave out --sea-reflection, --range-m and exports of a "
        "view");
  const std::size_t rows = sweep.views() * sweep.frequency_hz.size();
  constexpr std::size_t kMostRows = 4'000'000;  // 256 MB of matrices
  if (rows > kMostRows) throw InputError(fmt::format("{} rows of output: at most {}", rows, kMostRows));
  if (arguments.view.wanted() && rows != 1)
    throw InputError(
        fmt::format("exports of a view need one frequency, azimuth and elevation; there are {} rows", rows));
  if (arguments.view.wanted() && arguments.sea.reflection)
    throw InputError("exports of a view are of the target alone: leave out --sea-reflection");
  if (arguments.transmit_azimuth_deg && (arguments.view.wanted() || arguments.sea.reflection)) {
    throw InputError("--transmit-azimuth-deg: exports of a view and --sea-reflection are monostatic");
  }
  // A reference that does not fit is refused before any work.
  const std::vector<RcsReference> references = arguments.reference.read();
  for (const RcsReference& reference : references) pair_with(sweep, reference);

  TriangleMesh mesh = read_mesh(arguments.target, arguments.unit);
  std::vector<MaterialSpec> materials = choose_materials(arguments.materials, mesh);
  const auto [lowest, highest] = std::minmax_element(sweep.frequency_hz.begin(), sweep.frequency_hz.end());
  check_frequencies(materials, *lowest, *highest);
  try {
    SoundMesh sound = sound_mesh(mesh, *lowest);
    warn(sound.doubts);
    mesh = std::move(sound.mesh);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", arguments.target, error.what()));
  }
  if (arguments.sea.reflection) {
    arguments.sea.check(mesh);
    put_in_water(mesh, materials, -arguments.sea.height_m);
  }
  const Scatterer scatterer(mesh, materials, radians(arguments.crease_deg), 1e-3 * arguments.sheet_thickness_mm);
  warn(check_edges(scatterer, arguments.edges == "on", *lowest, *highest));
  EchoFilter filter = arguments.view.filter(mesh, arguments.max_bounces, arguments.edges == "on");
  filter.cavities = arguments.cavities.find(mesh, materials, filter);
  const std::vector<NamedCavity> cavities =
      arguments.cavities.make(mesh, filter.cavities, scatterer, *lowest, *highest);
  const auto start = std::chrono::steady_clock::now();
  const std::size_t legs = trace_views(arguments, scatterer, filter, shell, sweep);
  if (!cavities.empty()) add_cavities(arguments, cavities, filter, shell, sweep);
  const double seconds =
      std::max(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 1e-9);

  write_file(arguments.output, table_text(arguments, scatterer, sweep));
  const double million_legs = 1e-6 * static_cast<double>(legs), views = static_cast<double>(sweep.views());
  print_error(fmt::format("{}: {} rows, {} views in {:.2f} s ({:.3g} views/s, {:.2f} M beam legs, {:.2f} M/s)\n",
                          arguments.output, rows, sweep.views(), seconds, views / seconds, million_legs,
                          million_legs / seconds));
  if (arguments.view.wanted()) export_one_view(arguments, mesh, scatterer, filter, shell, sweep);
  if (!references.empty()) compare(arguments, references, sweep);
}

}  // namespace

void add_rcs(CLI::App& app, Shell& shell) {
  CLI::App* command = app.add_subcommand("rcs", "Scattering matrix of a mesh at rest over frequency and aspect");
  auto arguments = std::make_shared<RcsArguments>();
  command->add_option("--target", arguments->target, "Mesh file: .glb, .gltf, .obj, .stl or .ply")->required();
  command->add_option("--unit", arguments->unit, "Unit of the mesh: m, cm, mm, km, in, ft")->capture_default_str();
  command
      ->add_option("--frequency-ghz", arguments->frequency_ghz,
                   "A or A:B:STEP (B included where a step meets it), within 0.001 and 1000")
      ->required();
  command
      ->add_option("--azimuth-deg", arguments->azimuth_deg,
                   "A or A:B:STEP within -720 and 720; 0 = radar ahead of the bow, counter-clockwise from above")
      ->required();
  command
      ->add_option("--elevation-deg", arguments->elevation_deg,
                   "A or A:B:STEP within -90 and 90; of the radar seen from the target")
      ->capture_default_str();
  command
      ->add_option("--edges", arguments->edges, "Fringe currents at sharp edges: on, or off for physical optics alone")
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str();
  command
      ->add_option("--crease-deg", arguments->crease_deg,
                   "Facets that turn by less belong to one smooth surface; 0 = all facets flat")
      ->check(number_within(0.0, 60.0))
      ->capture_default_str();
  command
      ->add_option("--sheet-thickness-mm", arguments->sheet_thickness_mm,
                   "Of open surfaces, drawn where their lit faces are: changes what their rims return, to a tenth of "
                   "the wavelength")
      ->check(number_within(0.0, 1000.0))
      ->capture_default_str();
  command
      ->add_option("--transmit-azimuth-deg", arguments->transmit_azimuth_deg,
                   "Bistatic: a transmitter that stands still, while azimuth and elevation are the receiver's")
      ->check(number_within(-720.0, 720.0));
  command->add_option("--transmit-elevation-deg", arguments->transmit_elevation_deg, "Its elevation; 0 unless given")
      ->check(number_within(-90.0, 90.0));
  command
      ->add_option("--range-m", arguments->range_m,
                   "Of the radar from the target's origin, with --sea-reflection from the sea below it, for the "
                   "curvature of the wavefront; 0 = far field")
      ->check(number_within(0.0, 1e9));
  command->add_option("--max-bounces", arguments->max_bounces, "Reflections followed")
      ->check(CLI::Range(1, kMostBounces))
      ->capture_default_str();
  command
      ->add_option("--ray-spacing-m", arguments->ray_spacing_m,
                   "Detail followed, as the spacing of rays that would find it: pieces below a fourteenth are left "
                   "out; 0 = 0.001 radius, the coarsest")
      ->check(number_within(0.0, 1e6));
  command
      ->add_option("--material", arguments->materials,
                   "What the target is made of: pec, a name of assets/materials or a file; PART=NAME for one part, "
                   "PART* for all that begin so (repeatable)")
      ->type_name("[PART=]NAME")
      ->allow_extra_args(false);
  arguments->cavities.add_to(*command);
  arguments->sea.add_to(*command);
  command->add_option("-o,--output", arguments->output, "CSV file to write")->required();
  arguments->view.add_to(*command);
  arguments->reference.add_to(*command);
  add_threads_option(*command, shell);
  command->footer(
      "Example:\n  seaglint rcs --target assets/icosahedral_reflector.glb --frequency-ghz 16 --azimuth-deg 0:360:0.5 "
      "--elevation-deg 2 -o rcs.csv\n  seaglint rcs --target plate.glb --frequency-ghz 10.24 --azimuth-deg 0:60:0.5 -o "
      "plate.csv --reference "
      "ref.H.txt --reference ref.V.txt");
  command->callback([arguments, command, &shell] {
    require_any_of(*command, "--transmit-elevation-deg", {"--transmit-azimuth-deg"});
    require_any_of(*command, "--centre-cell-m", {"--export-centres"});
    require_any_of(*command, "--export-range-db", {"--export-centres", "--export-hot-spots"});
    shell.work = [arguments, &shell] { run_rcs(*arguments, shell); };
  });
}

}  // namespace seaglint
