// SPDX-License-Identifier: BSD-3-Clause
#include "tools/options/rcs_arguments.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <utility>

#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/names.h"
#include "sim/core/text/words.h"
#include "sim/field_tables/field_table.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_table.h"
#include "tools/rcs/rcs_target.h"

namespace seaglint {

namespace {

std::vector<double> numbers(const std::string& option, const std::string& text, std::size_t count) {
  std::vector<double> values;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string cell = text.substr(begin, end - begin);
    begin = end + 1;
    const std::optional<double> value = parse_number(cell);
    if (!value) throw InputError(fmt::format("{} {}: '{}' is not a number", option, text, cell));
    values.push_back(*value);
  }
  if (values.size() != count)
    throw InputError(fmt::format("{} {}: must be {} numbers, separated by commas", option, text, count));
  return values;
}

// The value for file i: none, the only one, or the i-th.
const std::string* value_for(const std::string& option, const std::vector<std::string>& values, std::size_t i,
                             std::size_t files) {
  if (values.empty()) return nullptr;
  if (values.size() == 1) return &values[0];
  if (values.size() != files)
    throw InputError(fmt::format("{} is given {} times for {} references: once for all, or once for each", option,
                                 values.size(), files));
  return &values[i];
}

// hh, hv, vh or vv, or of the transmitted polarisation, h or v, both elements.
std::vector<Polarisation> elements_named(const std::string& name) {
  if (name == "h" || name == "v") return {element_of(true, name == "v"), element_of(false, name == "v")};
  for (int i = 0; i < 4; ++i) {
    if (name == kPolarisationNames[i]) return {static_cast<Polarisation>(i)};
  }
  throw InputError(fmt::format(
      "--reference-polarisation {}: must be hh, hv, vh or vv (received, transmitted), or h or v (transmitted)", name));
}

DeclaredTransmitter incidence_named(const std::string& text) {
  if (text == "monostatic") return {};
  const std::vector<double> angles = numbers("--incidence", text, 2);
  DeclaredTransmitter transmitter{false, angles[0], angles[1]};
  fold_direction(transmitter.theta_deg, transmitter.phi_deg);
  return transmitter;
}

struct Folder {
  std::vector<std::filesystem::path> tables, others;  // by name
};

// Files whose name begins with a point, and folders within, are neither.
Folder contents_of(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code of_entry;
    if (entry->is_regular_file(of_entry) && !entry->path().filename().string().starts_with('.'))
      files.push_back(entry->path());
  }
  if (error) throw InputError(fmt::format("{}: cannot be read: {}", path.string(), error.message()));
  std::sort(files.begin(), files.end());
  Folder folder;
  for (std::filesystem::path& file : files) (is_field_table(file) ? folder.tables : folder.others).push_back(file);
  if (folder.tables.empty())
    throw InputError(fmt::format("{}: no file in this folder is a table of the radar cross section", path.string()));
  return folder;
}

// "DIR: 3 tables; not read as tables: a.png, b.txt".
std::string contents_text(const std::filesystem::path& path, const Folder& folder) {
  constexpr std::size_t kLongest = 400;
  std::string others;
  for (const std::filesystem::path& file : folder.others)
    others += (others.empty() ? "" : ", ") + file.filename().string();
  return fmt::format("{}: {} {}{}{}", path.string(), folder.tables.size(),
                     folder.tables.size() == 1 ? "table" : "tables",
                     others.empty() ? "" : "; not read as tables: ", shown(others, kLongest));
}

}  // namespace

FieldTable joined_tables(std::vector<FieldTable> tables, const std::string& file) {
  FieldTable all = std::move(tables.front());
  if (tables.size() == 1) return all;
  all.name = std::filesystem::path(file).lexically_normal().string();
  for (std::size_t i = 1; i < tables.size(); ++i)
    all.cuts.insert(all.cuts.end(), tables[i].cuts.begin(), tables[i].cuts.end());
  return all;
}

void ReferenceArguments::add_to(CommandOptions& command) {
  const CommandOption reference =
      command
          .add_option(
              "--reference", files,
              "Compare with a cut that was measured or computed elsewhere (repeatable): an export of CST, FEKO or "
              "HFSS, a table of this command, of a chamber by azimuth, or four columns frequency_hz theta_deg phi_deg "
              "dBsm; or a folder of them")
          .repeatable("FILE")
          .group("Reference");
  for (const CommandOption& option : add_properties_to(command)) CommandOption(option).needs(reference);
  command
      .add_option(
          "--figure", figure,
          "Figure of the levels, of the comparison or of --uncertainty, .png, .svg or .pdf; default: the output's "
          "name with .png; off: none")
      .group("Reference");
  command
      .add_option("--curves", curves,
                  "Curves of the comparison's figure as JSON: panels with their axes and series, for other programs")
      .needs(reference)
      .group("Reference");
}

std::vector<CommandOption> ReferenceArguments::add_properties_to(CommandOptions& command) {
  const auto repeatable = [&](const char* name, std::vector<std::string>& values, const char* what, const char* type) {
    return command.add_option(name, values, what).repeatable(type).group("Reference");
  };
  return {
      repeatable(
          "--reference-polarisation", polarisation,
          "hh, hv, vh or vv (received, transmitted), or h or v (transmitted: both elements); default what the file "
          "or its name says; once, or once for each file",
          "PP"),
      repeatable("--reference-phi", phi,
                 "A,B: the file's phi is A * azimuth + B degrees; default 1,0. Its theta is 90 - elevation", "A,B"),
      repeatable("--reference-frequency-ghz", frequency_ghz, "Frequency of a file that does not say it", "GHZ"),
      repeatable("--reference-elevation-deg", elevation_deg,
                 "Elevation of a table by azimuth that does not say it; default 0", "DEG"),
      repeatable(
          "--incidence", incidence,
          "monostatic, or THETA,PHI of the file: where the incident wave comes from, of a file that does not say it",
          "DIRECTION"),
      repeatable("--reference-origin-m", origin_m,
                 "The file's phase origin in the body's frame; default what the file says, else 0,0,0", "X,Y,Z"),
      command.add_option("--floor-db", floor_db, "Levels further below the file's maximum are clipped to this floor")
          .number_within(1.0, 300.0)
          .show_default()
          .group("Reference")};
}

ReferenceTables ReferenceArguments::read() const {
  ReferenceTables references;
  for (std::size_t i = 0; i < files.size(); ++i) {
    FieldTableSettings settings;
    if (const std::string* text = value_for("--reference-polarisation", polarisation, i, files.size()))
      settings.elements = elements_named(*text);
    if (const std::string* text = value_for("--reference-phi", phi, i, files.size())) {
      const std::vector<double> map = numbers("--reference-phi", *text, 2);
      if (map[0] == 0) throw InputError(fmt::format("--reference-phi {}: the factor must not be 0", *text));
      settings.phi_scale = map[0];
      settings.phi_offset_deg = map[1];
    }
    if (const std::string* text = value_for("--reference-frequency-ghz", frequency_ghz, i, files.size())) {
      settings.frequency_hz = numbers("--reference-frequency-ghz", *text, 1)[0] * 1e9;
      if (*settings.frequency_hz <= 0)
        throw InputError(fmt::format("--reference-frequency-ghz {}: must be > 0", *text));
    }
    if (const std::string* text = value_for("--reference-elevation-deg", elevation_deg, i, files.size())) {
      settings.elevation_deg = numbers("--reference-elevation-deg", *text, 1)[0];
      if (std::abs(*settings.elevation_deg) > 90)
        throw InputError(fmt::format("--reference-elevation-deg {}: must be within -90 and 90", *text));
    }
    if (const std::string* text = value_for("--incidence", incidence, i, files.size()))
      settings.transmitter = incidence_named(*text);
    if (const std::string* text = value_for("--reference-origin-m", origin_m, i, files.size())) {
      const std::vector<double> x = numbers("--reference-origin-m", *text, 3);
      settings.origin_m = Vec3(x[0], x[1], x[2]);
    }
    std::error_code error;
    if (!std::filesystem::is_directory(files[i], error)) {
      references.tables.push_back(read_field_table(files[i], settings));
      continue;
    }
    const Folder folder = contents_of(files[i]);
    references.folders.push_back(contents_text(files[i], folder));
    for (const std::filesystem::path& file : folder.tables)
      references.tables.push_back(read_field_table(file, settings));
  }
  return references;
}

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

void add_figure_options(CommandOptions& command, RcsArguments& arguments) {
  constexpr const char* kGroup = "Figures";
  command
      .add_flag("--polar", arguments.polar,
                "The figure of the levels over azimuth as a polar diagram, the bow up, counter-clockwise")
      .group(kGroup);
  command
      .add_option("--isar", arguments.isar,
                  "Turntable image of the sweep over frequency and azimuth (.png, .svg or .pdf): range and cross "
                  "range seen from above, level in dBsm, outline of the mesh")
      .group(kGroup);
  command
      .add_option("--profiles", arguments.profiles,
                  "Range profiles over azimuth of such a sweep, with the parts at the peaks of the middle one")
      .group(kGroup);
  command.add_option("--polarisation", arguments.polarisation, "Of --isar and --profiles: received, transmitted")
      .one_of({std::begin(kPolarisationNames), std::end(kPolarisationNames)})
      .show_default()
      .group(kGroup);
  add_style_option(command, arguments.style).group(kGroup);
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
      .add_option(
          "--export-hot-spots", exports.hot_spots,
          "Facets coloured by their RCS contribution at one aspect: with scattering centres as a page (.html) or a "
          "picture (.png, .svg, .pdf), or the mesh alone (.glb, .gltf)")
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

void add_waterline_option(CommandOptions& command, std::optional<double>& waterline_m) {
  command
      .add_option("--waterline-m", waterline_m,
                  "Remove what is below z = this of the placed mesh, and close the hull there by lids")
      .number_within(-1e4, 1e4);
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
  add_waterline_option(command, request.waterline_m);
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
          "that prefix, * for every face (repeatable); faces that none matches have the material that the mesh names, "
          "if "
          "assets/materials has it")
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
  command
      .add_option("--average", request.average,
                  "Azimuths, evenly spread over every step, of whose cross-sections each row is the mean: a coarse "
                  "table that misses no lobe; columns of levels alone")
      .integer_within(1, 10000)
      .show_default();
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
  const CommandOption statistics_option = command.add_option(
      "--statistics", statistics,
      "Statistics of the levels, as CSV and printed: number of views, percentiles 5, 25, 50 (median), 75 and 95, mean "
      "and largest cross-section in dBsm, of all elements, by elevation and sector of azimuth, for the whole target "
      "and "
      "each of its parts; over the values in m^2 of all views and frequencies of a sector");
  command
      .add_option("--sector-deg", sector_deg,
                  "Width of the sectors of --statistics; it divides 360, and the first one has the bow in its middle")
      .number_within(kNarrowestSector_deg, 360.0)
      .show_default()
      .needs(statistics_option);
  add_export_as_to(command).group("Selection and export");
  add_selection_options(command, request.selection);
  add_export_options(command, request.exports);
  add_figure_options(command, *this);
  reference.add_to(command);
}

CommandOption RcsArguments::add_export_as_to(CommandOptions& command) {
  return command
      .add_option("--export-as", export_as,
                  "Also write the solved values beside the table as another program does (repeatable): feko (.ffe), "
                  "cst (farfield tables in dB(m^2)), npz (NumPy)")
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
