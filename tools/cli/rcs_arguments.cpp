// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cli/rcs_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "sim/core/process/error.h"
#include "sim/core/text/number.h"
#include "tools/cli/option_numbers.h"

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

void add_cavity_options(CLI::App& command, CavityRequest& cavities) {
  command
      .add_option("--cavity", cavities.parts,
                  "Part of the mesh that is the walls of a cavity with an open mouth, some wavelengths wide: its echo "
                  "from the field inside (integral "
                  "equation) instead of rays; minutes per frequency (repeatable)")
      ->type_name("PART")
      ->allow_extra_args(false);
  command
      .add_option("--cavity-patches", cavities.patches_per_wavelength,
                  "Patches of its walls per wavelength: time goes with the fourth power")
      ->check(number_within(4.0, 20.0))
      ->capture_default_str()
      ->needs("--cavity");
}

void add_sea_options(CLI::App& command, RcsArguments& arguments) {
  SeaUnderTarget& under = arguments.request.sea;
  CLI::Option* sea = command.add_flag(
      "--sea-reflection", under.reflection,
      "Four ways between radar and target: direct and by the mean sea surface; elevations must be above 0");
  command.add_option("--height-m", under.height_m, "Height of the mesh's origin above the mean sea surface")
      ->check(number_within(-1e4, 1e4))
      ->capture_default_str()
      ->needs(sea);
  command.add_option("--wave-height-m", under.wave_height_m, "Significant wave height: roughness of the mirror")
      ->check(number_within(0.0, 30.0))
      ->capture_default_str()
      ->needs(sea);
  command.add_option("--sea-surface", arguments.sea_surface, "sea_water (20 deg C, 35 psu) or conductor")
      ->check(CLI::IsMember({"sea_water", "conductor"}))
      ->capture_default_str()
      ->needs(sea);
  command.add_option("--sea-paths", arguments.sea_paths, "all, direct or multipath")
      ->check(CLI::IsMember({"all", "direct", "multipath"}))
      ->capture_default_str()
      ->needs(sea);
}

void add_selection_options(CLI::App& command, EchoSelection& selection) {
  const auto selectors = [&](const char* name, std::vector<std::string>& values, const char* what) {
    command.add_option(name, values, what)
        ->type_name("KIND=VALUE")
        ->allow_extra_args(false)
        ->group("Selection and export");
  };
  selectors("--only", selection.only,
            "Sum only the echoes of part=NAME, of bounces=N, of mechanism=po or edge (repeatable; of one kind any, of "
            "several kinds all must hold)");
  selectors("--without", selection.without, "Leave out the echoes of any of these (repeatable)");
}

void add_export_options(CLI::App& command, ViewExport& exports) {
  command.add_option("--export-centres", exports.centres, "Scattering centres of one view at one frequency, as CSV")
      ->group("Selection and export");
  command.add_option("--centre-cell-m", exports.cell_m, "Size of the cells whose contributions become one centre")
      ->check(number_within(1e-4, 100.0))
      ->capture_default_str()
      ->group("Selection and export");
  command
      .add_option("--export-hot-spots", exports.hot_spots,
                  "The mesh, .glb or .gltf, its facets coloured by the strength of what leaves them in one view")
      ->group("Selection and export");
  command.add_option("--export-range-db", exports.range_db, "Weakest of the exports below the strongest")
      ->check(number_within(2.0, 300.0))
      ->capture_default_str()
      ->group("Selection and export");
}

}  // namespace

void RcsArguments::add_to(CLI::App& command) {
  command.add_option("--target", target, "Mesh file: .glb, .gltf, .obj, .stl or .ply")->required();
  command.add_option("--unit", request.unit, "Unit of the mesh: m, cm, mm, km, in, ft")->capture_default_str();
  command
      .add_option("--frequency-ghz", frequency_ghz,
                  "A or A:B:STEP (B included where a step meets it), within 0.001 and 1000")
      ->required();
  command
      .add_option("--azimuth-deg", azimuth_deg,
                  "A or A:B:STEP within -720 and 720; 0 = radar ahead of the bow, counter-clockwise from above")
      ->required();
  command
      .add_option("--elevation-deg", elevation_deg,
                  "A or A:B:STEP within -90 and 90; of the radar seen from the target")
      ->capture_default_str();
  command.add_option("--edges", edges, "Fringe currents at sharp edges: on, or off for physical optics alone")
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str();
  command
      .add_option("--crease-deg", request.crease_deg,
                  "Facets that turn by less belong to one smooth surface; 0 = all facets flat")
      ->check(number_within(0.0, 60.0))
      ->capture_default_str();
  command
      .add_option("--sheet-thickness-mm", request.sheet_thickness_mm,
                  "Of open surfaces, drawn where their lit faces are: changes what their rims return, to a tenth of "
                  "the wavelength")
      ->check(number_within(0.0, 1000.0))
      ->capture_default_str();
  command
      .add_option("--transmit-azimuth-deg", transmit_azimuth_deg,
                  "Bistatic: a transmitter that stands still, while azimuth and elevation are the receiver's")
      ->check(number_within(-720.0, 720.0));
  command.add_option("--transmit-elevation-deg", transmit_elevation_deg, "Its elevation; 0 unless given")
      ->check(number_within(-90.0, 90.0));
  command
      .add_option("--range-m", request.range_m,
                  "Of the radar from the target's origin, with --sea-reflection from the sea below it, for the "
                  "curvature of the wavefront; 0 = far field")
      ->check(number_within(0.0, 1e9));
  command.add_option("--max-bounces", request.max_bounces, "Reflections followed")
      ->check(CLI::Range(1, kMaxBounces))
      ->capture_default_str();
  command
      .add_option("--ray-spacing-m", request.ray_spacing_m,
                  "Detail followed, as the spacing of rays that would find it: pieces below a fourteenth are left "
                  "out; 0 = 0.001 radius, the coarsest")
      ->check(number_within(0.0, 1e6));
  command
      .add_option("--material", materials,
                  "What the target is made of: pec, a name of assets/materials or a file; PART=NAME for one part, "
                  "PART* for all that begin so (repeatable)")
      ->type_name("[PART=]NAME")
      ->allow_extra_args(false);
  add_cavity_options(command, request.cavities);
  add_sea_options(command, *this);
  command.add_option("-o,--output", output, "CSV file to write")->required();
  add_selection_options(command, request.selection);
  add_export_options(command, request.exports);
  reference.add_to(command);
}

RcsRequest RcsArguments::make_request() const {
  RcsRequest made = request;
  made.target = target;
  made.edges = edges == "on";
  made.physical_optics_too = !reference.files.empty();
  made.frequency_hz = range("--frequency-ghz", frequency_ghz, 1e-3, 1000);
  for (double& f : made.frequency_hz) f *= 1e9;
  made.azimuth_deg = range("--azimuth-deg", azimuth_deg, -720, 720);
  made.elevation_deg = range("--elevation-deg", elevation_deg, -90, 90);
  if (transmit_azimuth_deg)
    made.transmitter = FixedTransmitter{*transmit_azimuth_deg, transmit_elevation_deg.value_or(0)};
  for (const std::string& text : materials) made.materials.push_back(material_choice(text));
  made.sea.surface = sea_surface == "conductor" ? SeaSurface::kConductor : SeaSurface::kSeaWater;
  made.sea.paths = sea_paths == "multipath" ? SeaPaths::kMultipath
                   : sea_paths == "direct"  ? SeaPaths::kDirect
                                            : SeaPaths::kAll;
  return made;
}

}  // namespace seaglint
