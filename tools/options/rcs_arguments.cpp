// SPDX-License-Identifier: BSD-3-Clause
#include "tools/options/rcs_arguments.h"

#include <fmt/format.h>

#include <filesystem>
#include <iterator>
#include <utility>

#include "sim/core/process/error.h"
#include "sim/core/text/named_file.h"
#include "sim/core/text/number.h"
#include "tools/rcs/like_program.h"
#include "tools/rcs/rcs_target.h"
#include "tools/rcs/sweep_files.h"

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

MaterialChoice material_choice(const std::string& text) {
  const std::size_t equals = text.find('=');
  MaterialChoice choice{std::nullopt, text, "--material " + text};
  if (equals != std::string::npos) {
    choice.part = text.substr(0, equals);
    choice.material = text.substr(equals + 1);
  }
  return choice;
}

std::string crease_error(const std::string& value) {
  const std::optional<double> angle = parse_number(value);
  const bool valid = value == "auto" || (angle && *angle >= 0 && *angle <= 60);
  return valid ? "" : fmt::format("value {}: must be auto or within 0 and 60", value);
}

void add_cavity_options(CommandOptions& command, CavityRequest& cavities) {
  const CommandOption cavity =
      command
          .add_option("--cavity", cavities.parts,
                      "Part that forms the walls of an open-ended cavity a few wavelengths wide: solved by the "
                      "magnetic-field integral equation instead of beam tracing; minutes per frequency (repeatable)")
          .repeatable("PART");
  command
      .add_option("--cavity-patches-per-wavelength", cavities.patches_per_wavelength,
                  "Wall patches per wavelength; run time grows with the fourth power")
      .number_within(4.0, 20.0)
      .show_default()
      .needs(cavity);
}

void add_sea_options(CommandOptions& command, RcsArguments& arguments) {
  SeaUnderTarget& under = arguments.request.sea;
  const CommandOption sea = command.add_flag(
      "--sea-reflection", under.reflection,
      "Four-path multipath: direct and specularly reflected by the mean sea surface; elevations must be above 0");
  command.add_option("--origin-height-m", under.height_m, "Height of the mesh's origin above the mean sea surface")
      .number_within(-1e4, 1e4)
      .show_default()
      .needs(sea);
  command
      .add_option("--significant-wave-height-m", under.wave_height_m,
                  "Significant wave height: roughness of the sea surface")
      .number_within(0.0, 30.0)
      .show_default()
      .needs(sea);
  command.add_option("--sea-surface", arguments.sea_surface, "sea_water (20 deg C, 35 psu) or conductor")
      .one_of({"sea_water", "conductor"})
      .show_default()
      .needs(sea);
  command.add_option("--sea-paths", arguments.sea_paths, "all, direct_only or multipath_only")
      .one_of({"all", "direct_only", "multipath_only"})
      .show_default()
      .needs(sea);
}

void add_selection_options(CommandOptions& command, EchoSelection& selection) {
  const auto selectors = [&](const char* name, std::vector<std::string>& values, const char* what) {
    command.add_option(name, values, what).repeatable("KIND=VALUE").group("Selection and export");
  };
  selectors("--only", selection.only,
            "Sum only the contributions of part=NAME, bounces=N, mechanism=po, edge, or one of edge diffraction "
            "(single, multiple, reflected_edge, shadow_boundary, penumbra, concave) (repeatable; of one kind any, of "
            "several kinds all must apply)");
  selectors("--without", selection.without, "Exclude the contributions of any of these (repeatable)");
}

void add_export_options(CommandOptions& command, ViewExport& exports) {
  command
      .add_option("--export-scattering-centres", exports.centres,
                  "Scattering centres of one aspect at one frequency, as CSV")
      .group("Selection and export");
  command.add_option("--centre-cell-m", exports.cell_m, "Size of the cells whose contributions become one centre")
      .number_within(1e-4, 100.0)
      .show_default()
      .group("Selection and export");
  command
      .add_option("--export-hot-spots", exports.hot_spots,
                  "Mesh (.glb or .gltf) with facets coloured by their RCS contribution at one aspect")
      .group("Selection and export");
  command.add_option("--export-dynamic-range-db", exports.range_db, "Dynamic range of the exports below the strongest")
      .number_within(2.0, 300.0)
      .show_default()
      .group("Selection and export");
}

}  // namespace

void add_placement_options(CommandOptions& command, MeshPlacement& placement) {
  command.add_option("--unit", placement.unit, "Unit of the mesh file: m, cm, mm, km, in, ft").show_default();
  const auto axis = [&](const char* name, std::string& value, const char* what) {
    command.add_option(name, value, what).one_of({std::begin(kMeshAxes), std::end(kMeshAxes)}).show_default();
  };
  axis("--forward", placement.forward, "Axis of the mesh file that points forward; becomes +x");
  axis("--up", placement.up, "Axis of the mesh file that points up; becomes +z");
  command.add_option("--scale", placement.scale, "Factor by which the mesh is enlarged about the origin of its file")
      .number_within(1e-3, 1e3)
      .show_default();
  command.add_option("--offset-m", placement.offset_m,
                     "Translation of the turned and enlarged mesh: the waterline belongs at z = 0");
}

void RcsArguments::add_mesh_to(CommandOptions& command) {
  add_target_to(command).required();
  add_views_to(command);
  add_detail_to(command);
}

CommandOption RcsArguments::add_target_to(CommandOptions& command) {
  const CommandOption option =
      command
          .add_option(
              "--target", targets,
              "Mesh file: .glb .gltf .obj .stl .ply, or shells in .nas .bdf .dat .fem .unv .msh (repeatable: the "
              "files are the parts of one target)")
          .repeatable("FILE");
  add_placement_options(command, request);
  return option;
}

void RcsArguments::add_views_to(CommandOptions& command) {
  command
      .add_option("--frequency-ghz", frequency_ghz,
                  "A or A:B:STEP (B included where a step meets it), within 0.001 and 1000")
      .required();
  command
      .add_option("--azimuth-deg", azimuth_deg,
                  "A or A:B:STEP within -720 and 720; 0 = radar ahead of the bow, counter-clockwise from above")
      .required();
  command
      .add_option("--elevation-deg", elevation_deg,
                  "A or A:B:STEP within -90 and 90; of the radar seen from the target")
      .show_default();
}

void RcsArguments::add_detail_to(CommandOptions& command) {
  command
      .add_option("--like", like,
                  "Facets, edges and bounces as another program has them by default: hfss (SBR+), feko (RL-GO), cst "
                  "(asymptotic solver); --crease-deg, --edges and --max-bounces take precedence")
      .one_of(like_names());
  edges_option_ =
      command
          .add_option(
              "--edges", edges,
              "Edge diffraction (equivalent edge currents, single and multiple): on, or off for physical optics alone")
          .one_of({"on", "off"})
          .show_default();
  crease_option_ =
      command
          .add_option(
              "--crease-deg", crease_deg,
              "Facets that form a smooth surface: auto = as the mesh's normals or its shape say, finer ones than its "
              "curvature requires merged; a crease angle within 0 and 60 = adjacent ones whose normals differ by "
              "less, as meshed; 0 = all facets flat")
          .check(crease_error)
          .show_default();
  command
      .add_option("--sheet-thickness-mm", request.sheet_thickness_mm,
                  "Thickness of open surfaces (meshed at the illuminated face): first-order correction of their edge "
                  "diffraction, valid up to a tenth of a wavelength")
      .number_within(0.0, 1000.0)
      .show_default();
  bounces_option_ = command.add_option("--max-bounces", request.max_bounces, "Maximum number of bounces")
                        .integer_within(1, kMaxBounces)
                        .show_default();
  command
      .add_option("--min-patch-m", request.min_patch_m,
                  "Side of the smallest illuminated patch kept; 0 = 0.7e-4 of the radius of each body, the coarsest")
      .number_within(0.0, 1e6);
  command
      .add_option("--method", method, "How paths are found: beams, exact on flat panels; rays, shooting and bouncing")
      .one_of({std::begin(kSolverMethodNames), std::end(kSolverMethodNames)})
      .show_default();
  command
      .add_option("--ray-spacing-m", request.ray_spacing_m,
                  "Distance between rays, with --method rays; 0 = 1.5e-4 of the target's radius")
      .number_within(0.0, 1e6);
  command
      .add_option(
          "--material", materials,
          "Material: pec, a name in assets/materials, or a file; PART=NAME for one part, PART* for every part with "
          "that prefix (repeatable)")
      .repeatable("[PART=]NAME");
}

void RcsArguments::add_to(CommandOptions& command) {
  add_mesh_to(command);
  command
      .add_option("--transmit-azimuth-deg", transmit_azimuth_deg,
                  "Bistatic: azimuth of a fixed transmitter; --azimuth-deg and --elevation-deg then sweep the receiver")
      .number_within(-720.0, 720.0);
  command.add_option("--transmit-elevation-deg", transmit_elevation_deg, "Its elevation; 0 unless given")
      .number_within(-90.0, 90.0);
  command
      .add_option("--wavefront-range-m", request.range_m,
                  "Radar range for the wavefront curvature, from the target origin (with --sea-reflection from the sea "
                  "surface below it); 0 = plane wave")
      .number_within(0.0, 1e9);
  command.add_flag("--uncertainty", request.uncertainty,
                   "Also trace with all facets flat: columns xx_flat_over_smooth_db after the others (level of flat "
                   "facets over that of smooth surfaces) and xx_vertex_change (estimated change, relative to the echo, "
                   "by vertices displaced by a 2000th of a wavelength), and a figure of both");
  command
      .add_option(
          "--converge", converge_db,
          "Halve the smallest patch, or with --method rays the distance between rays, until no level changes by more "
          "than this, dB; prints the series, and columns xx_patch_change_db or xx_spacing_change_db after the others "
          "(level less that with twice the size)")
      .number_within(1e-4, 20.0);
  add_cavity_options(command, request.cavities);
  add_sea_options(command, *this);
  command.add_flag("--cross-check", cross_check,
                   "Compute the sweep by beams and by rays and print, by view, the levels, their difference, that of "
                   "the fields relative to the beams', and the part and bounces that differ most; the CSV file is then "
                   "this table, with a figure beside it (.png), and may be left out");
  command.add_option("-o,--output", output, "CSV file to write");
  add_export_as_to(command).group("Selection and export");
  add_selection_options(command, request.selection);
  add_export_options(command, request.exports);
  reference.add_to(command);
}

CommandOption RcsArguments::add_export_as_to(CommandOptions& command) {
  return command
      .add_option("--export-as", export_as,
                  "Also write the solved values beside the table as another program does (repeatable): feko (.ffe), "
                  "cst (farfield tables in dB(m^2)), pyaedt (.json with a pandas .h5), npz (NumPy)")
      .repeatable("FORMAT")
      .one_of({std::begin(kExportFormats), std::end(kExportFormats)});
}

RcsRequest RcsArguments::make_mesh_request() const {
  RcsRequest made = request;
  std::vector<GeometryFile> files;
  for (const std::string& target : targets) files.push_back({find_input(target), request.unit});
  if (!files.empty()) set_target_files(made, files);
  made.edges = edges == "on";
  made.method = solver_method_of(method);
  if (crease_deg != "auto") made.crease_deg = parse_number(crease_deg);
  for (const std::string& text : materials) made.materials.push_back(material_choice(text));
  if (like.empty()) return made;
  const auto given = [](const std::optional<CommandOption>& option) { return option && option->given(); };
  return solved_like(
      std::move(made), like_program(like),
      {.crease = given(crease_option_), .edges = given(edges_option_), .max_bounces = given(bounces_option_)});
}

std::string RcsArguments::target_name() const {
  const std::string first = std::filesystem::path(targets.front()).filename().string();
  return targets.size() == 1 ? first : fmt::format("{} and {} more", first, targets.size() - 1);
}

RcsRequest RcsArguments::make_request() const {
  RcsRequest made = make_mesh_request();
  made.physical_optics_too = !reference.files.empty();
  made.frequency_hz = range("--frequency-ghz", frequency_ghz, 1e-3, 1000);
  for (double& f : made.frequency_hz) f *= 1e9;
  made.azimuth_deg = range("--azimuth-deg", azimuth_deg, -720, 720);
  made.elevation_deg = range("--elevation-deg", elevation_deg, -90, 90);
  if (transmit_azimuth_deg)
    made.transmitter = FixedTransmitter{*transmit_azimuth_deg, transmit_elevation_deg.value_or(0)};
  made.sea.surface = sea_surface == "conductor" ? SeaSurface::kConductor : SeaSurface::kSeaWater;
  made.sea.paths = sea_paths == "multipath_only" ? SeaPaths::kMultipath
                   : sea_paths == "direct_only"  ? SeaPaths::kDirect
                                                 : SeaPaths::kAll;
  return made;
}

}  // namespace seaglint
