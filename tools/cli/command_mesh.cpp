// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/names.h"
#include "sim/geometry/decoy/make_decoy.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/mesh/mesh_diagnostics.h"
#include "sim/geometry/mesh/topology.h"
#include "sim/geometry/placement/hydrostatics.h"
#include "sim/geometry/placement/target_mesh.h"
#include "sim/geometry/placement/waterline.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/geometry/ship/make_ship.h"
#include "sim/motion/body.h"
#include "tools/cli/command_line.h"
#include "tools/figure/mesh_picture.h"
#include "tools/options/rcs_arguments.h"
#include "tools/pipeline/warnings.h"
#include "tools/rcs/rcs_target.h"
#include "tools/rcs/rcs_uncertainty.h"

namespace seaglint {
namespace {

using Maker = std::function<TriangleMesh()>;

// Position of a word in a list that has it.
std::ptrdiff_t index_of(std::span<const char* const> names, std::string_view word) {
  return std::ranges::find(names, word, [](const char* name) { return std::string_view(name); }) - names.begin();
}

std::string size_line(const TriangleMesh& mesh) {
  const Bounds box = bounds(mesh);
  const Vec3 size = box.upper - box.lower;
  return fmt::format(
      "size       {:.6g} x {:.6g} x {:.6g} m, from ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g})\n", size.x(),
      size.y(), size.z(), box.lower.x(), box.lower.y(), box.lower.z(), box.upper.x(), box.upper.y(), box.upper.z());
}

std::string counts_line(const TriangleMesh& mesh) {
  return fmt::format("triangles  {}, vertices {}, area {:.6g} m^2\n", mesh.triangles.size(), mesh.vertices.size(),
                     surface_area(mesh));
}

// One line for each part: triangles, volume if it is closed, material.
std::string part_lines(const TriangleMesh& mesh, const Topology& topology) {
  std::vector<std::size_t> count(mesh.part_names.size(), 0);
  std::vector<double> volume(mesh.part_names.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    ++count[mesh.triangle_part[t]];
    volume[mesh.triangle_part[t]] += mesh.vertices[mesh.triangles[t][0]].dot(area_vector(mesh, t)) / 3;
  }
  std::string text = fmt::format("parts      {}\n", mesh.part_names.size());
  for (std::size_t p = 0; p < mesh.part_names.size(); ++p) {
    const std::string state = topology.part_closed[p] ? fmt::format("closed, {:.6g} m^3", volume[p]) : "open";
    text += fmt::format("  {:<24} {:>7} triangles, {}\n", on_one_line(mesh.part_names[p]), count[p], state);
  }
  return text;
}

std::string material_lines(const TriangleMesh& mesh) {
  std::vector<std::size_t> count(mesh.materials.size(), 0);
  for (std::uint16_t m : mesh.triangle_material) ++count[m];
  std::string text = fmt::format("materials  {}\n", mesh.materials.size());
  for (std::size_t m = 0; m < count.size(); ++m) {
    const std::string& name = mesh.materials[m].name;
    const char* use = name == Material{}.name    ? ""
                      : lens_material(name)      ? ", a Luneburg lens"
                      : known_material(name, {}) ? ", of assets/materials"
                                                 : ", no name of assets/materials: perfect conductor";
    text += fmt::format("  {:<24} {:>7} triangles{}\n", on_one_line(name), count[m], use);
  }
  return text;
}

std::string topology_lines(const TriangleMesh& mesh, const Topology& topology, double wedge_deg) {
  std::size_t convex = 0, concave = 0, free_edges = 0;
  for (const Wedge& wedge : wedges(mesh, topology, radians(wedge_deg))) {
    if (wedge.triangles[1] == kNoIndex) {
      ++free_edges;
    } else if (wedge.exterior_angle > kPi) {
      ++convex;
    } else {
      ++concave;
    }
  }
  return fmt::format(
      "edges      {} in all; {} boundary (holes and free edges), {} non-manifold, {} with a flipped neighbour\n"
      "degenerate {} triangles without area\n"
      "wedges     {} convex, {} concave of more than {:g} deg, {} free edges\n",
      topology.edges.size(), topology.count(EdgeKind::kBoundary), topology.count(EdgeKind::kNonManifold),
      topology.count(EdgeKind::kInconsistent), topology.degenerate.size(), convex, concave, wedge_deg, free_edges);
}

// Adds a kind of mesh to `mesh make`; its options are captured by the function that makes the mesh.
CommandOptions add_kind(CommandOptions& make, CommandContext& context, const char* name, const char* what,
                        const char* example, const Maker& maker) {
  CommandOptions kind = make.add_command(name, what);
  auto output = std::make_shared<std::string>();
  kind.add_option("-o,--output", *output, "Mesh file to write: .glb .gltf .obj .stl or .ply").required();
  add_threads_option(kind, context);
  kind.footer(fmt::format("Example:\n  seaglint mesh make {} {}", name, example));
  kind.callback([output, maker, &context] {
    context.work = [output, maker] {
      const TriangleMesh mesh = maker();
      write_mesh(*output, mesh);
      print_out("{}\n{}{}", *output, size_line(mesh), counts_line(mesh));
    };
  });
  return kind;
}

// Volume, waterplane, centres, metacentres and natural periods of the body below z = 0; empty for a mesh that ends
// there. With a centre of gravity at this height above the water also GM and the natural periods of `motion.model:
// ship`.
std::string hydrostatics_lines(const TriangleMesh& mesh, std::optional<double> centre_of_gravity_m) {
  const Hydrostatics h = hydrostatics_of(mesh);
  if (!(h.volume_m3 > 0)) return "";
  std::string text = fmt::format(
      "afloat     {:.6g} m^3 below z = 0 ({:.4g} t of sea water), waterline {:.4g} m x {:.4g} m, draught {:.4g} m\n"
      "           waterplane {:.5g} m^2 about x = {:.3g} m, centre of buoyancy ({:.3g}, {:.3g}) m, wetted {:.5g} m^2\n"
      "           block coefficient {:.3f}, waterplane coefficient {:.3f}\n"
      "           KB {:.4g} m, BM {:.4g} m, longitudinal BM {:.4g} m\n",
      h.volume_m3, 1e-3 * kSeaWaterDensity * h.volume_m3, h.length_m, h.beam_m, h.draught_m, h.waterplane_m2,
      h.flotation_x_m, h.buoyancy_m.x(), h.buoyancy_m.z(), h.wetted_m2, h.block_coefficient, h.waterplane_coefficient,
      h.draught_m + h.buoyancy_m.z(), h.transverse_bm_m, h.longitudinal_bm_m);
  if (!centre_of_gravity_m) return text;
  const double gm = h.metacentric_height_m(*centre_of_gravity_m);
  text += fmt::format("           centre of gravity {:.4g} m above the water: KG {:.4g} m, GM {:.4g} m\n",
                      *centre_of_gravity_m, h.draught_m + *centre_of_gravity_m, gm);
  if (!(gm > 0)) return text + "           the body is unstable: GM must be above 0\n";
  const Body body = make_body({.model = MotionModel::kShip}, shape_of(mesh, centre_of_gravity_m));
  const auto& ship = std::get<ShipParticulars>(body.model);
  const auto period = [](const Oscillator& mode) { return 2 * kPi / mode.omega0; };
  return text + fmt::format("           natural periods: roll {:.3g} s, pitch {:.3g} s, heave {:.3g} s\n",
                            period(ship.roll), period(ship.pitch), period(ship.heave));
}

void add_ship_kinds(CommandOptions& make, CommandContext& context) {
  auto spec = std::make_shared<ShipSpec>();
  auto kind = std::make_shared<std::string>(kShipKindNames[0]), detail = std::make_shared<std::string>("rails");
  auto above = std::make_shared<bool>(false);
  auto output = std::make_shared<std::string>();
  CommandOptions ship = make.add_command("ship", "Ship of a kind, an individual for every seed, with its hydrostatics");
  ship.add_option("-o,--output", *output, "Mesh file to write: .glb .gltf .obj .stl or .ply").required();
  ship.add_option("--kind", *kind, "Kind of ship")
      .one_of({std::begin(kShipKindNames), std::end(kShipKindNames)})
      .show_default();
  ship.add_option("--length-m", spec->length_m,
                  "Length overall; 0: that of the kind's reference ship for seed 0, else by the seed")
      .show_default();
  ship.add_option("--loading", spec->loading, "0 lightest to 1 laden; without: laden for seed 0, else by the seed")
      .number_within(0.0, 1.0);
  ship.add_option("--seed", spec->seed, "Individual of its kind; 0: the reference ship").show_default();
  ship.add_option("--detail", *detail, "How much is built: hull (with houses), fittings, rails (all)")
      .one_of({std::begin(kShipDetailNames), std::end(kShipDetailNames)})
      .show_default();
  ship.add_flag("--above-water", *above, "Cut at the waterline z = 0 and closed there");
  add_threads_option(ship, context);
  ship.footer("Example:\n  seaglint mesh make ship --kind tanker --length-m 183 --seed 3 -o tanker.glb");
  ship.callback([=, &context] {
    context.work = [=] {
      spec->kind = static_cast<ShipKind>(index_of(kShipKindNames, *kind));
      spec->detail = static_cast<ShipDetail>(index_of(kShipDetailNames, *detail));
      const Ship made = make_ship(*spec);
      const TriangleMesh mesh = *above ? above_water(made.mesh, 0).mesh : made.mesh;
      write_mesh(*output, mesh);
      print_out("{}\n{}{}{}", *output, size_line(mesh), counts_line(mesh),
                hydrostatics_lines(made.mesh, made.centre_of_gravity_m));
      print_out("scenario   targets.NAME: {{mesh: {}, motion: {{model: ship, metacentric_height_m: {:.3g}}}}}\n",
                *output, hydrostatics_of(made.mesh).metacentric_height_m(made.centre_of_gravity_m));
    };
  });
  auto combatant_detail = std::make_shared<std::string>("rails");
  CommandOptions combatant = add_kind(
      make, context, "combatant", "The combatant of 144 m of assets, cut at the waterline z = 0", "-o ship.glb",
      [=] { return make_combatant(static_cast<ShipDetail>(index_of(kShipDetailNames, *combatant_detail))); });
  combatant.add_option("--detail", *combatant_detail, "How much is built: hull (with houses), fittings, rails (all)")
      .one_of({std::begin(kShipDetailNames), std::end(kShipDetailNames)})
      .show_default();
}

void add_reflector_kinds(CommandOptions& make, CommandContext& context) {
  auto edge = std::make_shared<double>(kReflectorEdge);
  add_kind(make, context, "reflector", "Icosahedral corner reflector of 20 trihedra", "-o reflector.glb",
           [edge] { return make_icosahedral_reflector(*edge); })
      .add_option("--edge-m", *edge, "Edge of the icosahedron")
      .show_default();

  auto leg = std::make_shared<double>(0.372);
  auto is_square = std::make_shared<bool>(false);
  CommandOptions trihedral = add_kind(
      make, context, "trihedral", "Right-angled corner with its legs along +x, +y, +z", "--leg-m 0.372 -o corner.glb",
      [leg, is_square] { return *is_square ? make_square_trihedral(*leg) : make_triangular_trihedral(*leg); });
  trihedral.add_option("--leg-m", *leg, "Length of a leg").show_default();
  trihedral.add_flag("--square", *is_square, "Square plates instead of triangles");

  auto length = std::make_shared<double>(1.0), width = std::make_shared<double>(1.0),
       opening = std::make_shared<double>(90.0);
  CommandOptions dihedral = add_kind(make, context, "dihedral", "Two plates with a seam along z, open towards +x",
                                     "--length-m 0.4 --width-m 0.3 -o dihedral.glb",
                                     [=] { return make_dihedral(*length, *width, radians(*opening)); });
  dihedral.add_option("--length-m", *length, "Length of the seam").show_default();
  dihedral.add_option("--width-m", *width, "Width of a plate").show_default();
  dihedral.add_option("--opening-deg", *opening, "Angle between the plates").show_default();
}

// The options of `mesh make decoy`: a spec, its enumerations by their words.
struct DecoyArguments {
  DecoySpec spec;
  std::string kind = kDecoyKindNames[0], panel = kDecoyPanelNames[0], pose = kDecoyPoseNames[0],
              support = kDecoySupportNames[0], float_shape = kDecoyFloatNames[0];

  DecoySpec make_spec() const {
    const auto index = [](const auto& names, const std::string& word) {
      return std::find(std::begin(names), std::end(names), word) - std::begin(names);
    };
    DecoySpec made = spec;
    made.kind = static_cast<DecoyKind>(index(kDecoyKindNames, kind));
    made.panel = static_cast<DecoyPanel>(index(kDecoyPanelNames, panel));
    made.pose = static_cast<DecoyPose>(index(kDecoyPoseNames, pose));
    made.support = static_cast<DecoySupport>(index(kDecoySupportNames, support));
    made.float_shape = static_cast<DecoyFloat>(index(kDecoyFloatNames, float_shape));
    return made;
  }
};

void add_decoy_kind(CommandOptions& make, CommandContext& context) {
  auto arguments = std::make_shared<DecoyArguments>();
  CommandOptions kind = add_kind(make, context, "decoy", "Corner reflector or lens as it is built, with its support",
                                 "--kind octahedral --leg-m 0.4 --angle-error-deg 0.5 --support float -o decoy.glb",
                                 [arguments] { return make_decoy(arguments->make_spec()); });
  const auto add_word = [&kind](const char* option, std::string& word, const auto& names, const char* what) {
    kind.add_option(option, word, what).one_of({std::begin(names), std::end(names)}).show_default();
  };
  DecoySpec& spec = arguments->spec;
  add_word("--kind", arguments->kind, kDecoyKindNames, "Arrangement of its trihedra, or a lens");
  kind.add_option("--leg-m", spec.leg_m, "Leg of its trihedra, side of a dihedral's faces, radius of a lens")
      .show_default();
  add_word("--panel", arguments->panel, kDecoyPanelNames, "Panels of an octahedral or a trihedral one");
  add_word("--pose", arguments->pose, kDecoyPoseNames, "Octahedral: a cell or a corner upwards");
  kind.add_option("--cells", spec.cells, "Trihedra of a trihedral_cluster").show_default();
  kind.add_option("--boresight-elevation-deg", spec.boresight_elevation_deg,
                  "Of a trihedral_cluster, a trihedral, a dihedral or a lens")
      .show_default();
  kind.add_option("--cap-half-angle-deg", spec.cap_half_angle_deg, "Half angle of the metal cap of a lens")
      .show_default();
  kind.add_option("--lens-loss-db", spec.lens_loss_db, "Loss of the dielectric of a lens, both ways").show_default();
  kind.add_option("--seed", spec.seed, "Of all imperfections").show_default();
  kind.add_option("--angle-error-deg", spec.angle_error_deg, "Standard deviation of every right angle").show_default();
  kind.add_option("--seam-errors-deg", spec.seam_errors_deg,
                  "Trihedral: errors of the right angles at its lower starboard, lower port and upper seam");
  kind.add_option("--surface-error-mm", spec.surface_error_mm, "Rms displacement of the panels along their normals")
      .show_default();
  kind.add_option("--rounding-mm", spec.rounding_mm, "Radius of the seams").show_default();
  kind.add_flag("--inflatable", spec.inflatable, "Tubes of that radius along the outer edges");
  kind.add_option("--missing-panels", spec.missing_panels, "Panels that are missing, at random").show_default();
  kind.add_option("--dented-panels", spec.dented_panels, "Panels with a dent, at random").show_default();
  kind.add_option("--dent-depth", spec.dent_depth, "Depth of a dent over the leg").show_default();
  kind.add_option("--frame-mm", spec.frame_mm, "Width of bars along the outer edges, 0 = none").show_default();
  add_word("--support", arguments->support, kDecoySupportNames, "What carries it in the water");
  add_word("--float-shape", arguments->float_shape, kDecoyFloatNames, "Of support float and tow");
  kind.add_option("--float-m", spec.float_m, "Diameter of float or raft, 0 = 2 legs (disc), 1.2 (sphere), 3 (raft)")
      .show_default();
  kind.add_option("--mast-m", spec.mast_m, "Height of the reflector's middle above the water").show_default();
  kind.add_option("--tether-m", spec.tether_m, "Length of the line from the float to the water, 0 = none")
      .show_default();
}

void add_simple_kinds(CommandOptions& make, CommandContext& context) {
  auto length = std::make_shared<double>(1.0), width = std::make_shared<double>(1.0);
  CommandOptions plate =
      add_kind(make, context, "plate", "Flat sheet in the plane x = 0, seen square from ahead",
               "--length-m 0.5 --width-m 0.3 -o plate.stl", [=] { return make_plate(*length, *width); });
  plate.add_option("--length-m", *length, "Size along y").show_default();
  plate.add_option("--width-m", *width, "Size along z").show_default();

  auto radius = std::make_shared<double>(0.5), height = std::make_shared<double>(1.0);
  auto subdivisions = std::make_shared<int>(4), segments = std::make_shared<int>(64);
  CommandOptions sphere =
      add_kind(make, context, "sphere", "Subdivided icosahedron", "--radius-m 0.3 --subdivisions 5 -o sphere.ply",
               [=] { return make_sphere(*radius, *subdivisions); });
  sphere.add_option("--radius-m", *radius, "Radius of its vertices").show_default();
  sphere.add_option("--subdivisions", *subdivisions, "0..8; 20 * 4^n triangles").show_default();
  CommandOptions cylinder = add_kind(make, context, "cylinder", "Capped prism about the z axis",
                                     "--radius-m 0.2 --height-m 1 -o cylinder.obj",
                                     [=] { return make_cylinder(*radius, *height, *segments); });
  cylinder.add_option("--radius-m", *radius, "Radius of its vertices").show_default();
  cylinder.add_option("--height-m", *height, "Height").show_default();
  cylinder.add_option("--segments", *segments, "3..100000 sides").show_default();
}

struct InfoArguments {
  std::string file;
  MeshPlacement placement;
  double wedge_deg = 20;
  std::optional<double> centre_of_gravity_m;
  std::string picture;
  PictureView view;
};

// Whether a part that reaches below z = 0 is not closed, so that it has no volume.
bool floats_unclosed(const TriangleMesh& mesh, const Topology& topology) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (topology.part_closed[mesh.triangle_part[t]]) continue;
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (mesh.vertices[v].z() < 0) return true;
    }
  }
  return false;
}

void print_info(const InfoArguments& arguments) {
  require_outputs({arguments.picture}, {arguments.file});
  if (!arguments.picture.empty() && std::filesystem::path(arguments.picture).extension() != ".png")
    throw InputError(fmt::format("{}: the name of a mesh's picture ends in .png", arguments.picture));
  const TriangleMesh mesh = read_placed_mesh(find_input(arguments.file), arguments.placement);
  const Topology topology = topology_of(mesh);
  if (!arguments.picture.empty()) write_file(arguments.picture, png_bytes(picture_of(mesh, arguments.view)));
  print_out("{}\n{}{}{}{}{}{}", arguments.file, size_line(mesh), counts_line(mesh),
            floats_unclosed(mesh, topology)
                ? "afloat     not stated: a part that reaches below z = 0 is open, or faces inwards in places\n"
                : hydrostatics_lines(mesh, arguments.centre_of_gravity_m),
            part_lines(mesh, topology), material_lines(mesh), topology_lines(mesh, topology, arguments.wedge_deg));
  for (const std::string& finding : diagnostic_messages(diagnose(mesh))) print_out("finding    {}\n", finding);
}

void add_info(CommandOptions& mesh, CommandContext& context) {
  CommandOptions info =
      mesh.add_command("info", "Size, parts, materials, holes, degenerate and non-manifold elements, wedges");
  auto arguments = std::make_shared<InfoArguments>();
  info.add_option("FILE", arguments->file,
                  "Mesh file: .glb .gltf .obj .stl .ply, or shells in .nas .bdf .dat .fem .unv .msh")
      .required();
  add_placement_options(info, arguments->placement);
  info.add_option("--min-wedge-angle-deg", arguments->wedge_deg, "Smallest angle between the normals at a wedge")
      .number_within(0.0, 180.0)
      .show_default();
  info.add_option("--centre-of-gravity-m", arguments->centre_of_gravity_m,
                  "Height of the centre of gravity above z = 0, the water: for GM and natural periods")
      .number_within(-100.0, 100.0);
  const CommandOption picture = info.add_option("--picture", arguments->picture, "Write a picture, .png");
  info.add_option("--azimuth-deg", arguments->view.azimuth_deg, "The picture's viewpoint, as the radar's")
      .number_within(-720, 720)
      .show_default()
      .needs(picture);
  info.add_option("--elevation-deg", arguments->view.elevation_deg, "The picture's viewpoint, as the radar's")
      .number_within(-90.0, 90.0)
      .show_default()
      .needs(picture);
  info.add_option("--width", arguments->view.width, "The picture's width in pixels")
      .integer_within(16, 8192)
      .show_default()
      .needs(picture);
  add_threads_option(info, context);
  info.footer("Example:\n  seaglint mesh info assets/combatant_144m.glb --picture ship.png --azimuth-deg 50");
  info.callback([arguments, &context] { context.work = [arguments] { print_info(*arguments); }; });
}

// Adds `mesh convert`, which writes a mesh file as it is placed.
void add_convert(CommandOptions& mesh, CommandContext& context) {
  struct ConvertArguments {
    std::string input, output;
    MeshPlacement placement;
    std::optional<double> waterline_m;
  };
  CommandOptions convert = mesh.add_command(
      "convert", "Write a mesh in metres and the body frame: turned, then enlarged, then moved; in another format");
  auto arguments = std::make_shared<ConvertArguments>();
  convert
      .add_option("FILE", arguments->input,
                  "Mesh file: .glb .gltf .obj .stl .ply, or shells in .nas .bdf .dat .fem .unv .msh")
      .required();
  convert.add_option("-o,--output", arguments->output, "Mesh file to write: .glb .gltf .obj .stl or .ply").required();
  add_placement_options(convert, arguments->placement);
  add_waterline_option(convert, arguments->waterline_m);
  add_threads_option(convert, context);
  convert.footer(
      "Example:\n  seaglint mesh convert hull.stl --unit mm --forward +y --offset-m 0,0,-4.2 --waterline-m 0 -o "
      "hull.glb");
  convert.callback([arguments, &context] {
    context.work = [arguments] {
      require_outputs({arguments->output}, {arguments->input});
      TriangleMesh written = read_placed_mesh(find_input(arguments->input), arguments->placement);
      const std::vector<std::string> findings = written.findings;
      std::string cut;
      if (arguments->waterline_m) {
        require_above_waterline(written, *arguments->waterline_m);
        AboveWater above = above_water(repair(written), *arguments->waterline_m);
        written = std::move(above.mesh);
        cut = cut_sentence(above.below);
      }
      write_mesh(arguments->output, written);
      print_out("{}\n{}{}", arguments->output, size_line(written), counts_line(written));
      if (!cut.empty()) print_out("cut        {}\n", cut);
      for (const std::string& finding : findings) print_out("finding    {}\n", on_one_line(finding));
    };
  });
}

void add_sensitivity(CommandOptions& mesh, CommandContext& context) {
  CommandOptions command = mesh.add_command(
      "sensitivity", "Change of the echo when the mesh is cut, numbered, turned, moved or rounded differently");
  auto arguments = std::make_shared<RcsArguments>();
  auto noise_um = std::make_shared<double>(0);
  arguments->add_mesh_to(command);
  command
      .add_option(
          "--noise-um", *noise_um,
          "Noise on the vertices, standard deviation in every coordinate; 0 = a 1900th of the shortest wavelength")
      .number_within(0.0, 1e6);
  add_threads_option(command, context);
  command.footer(
      "Example:\n  seaglint mesh sensitivity --target ship.stl --frequency-ghz 9.4 --azimuth-deg 0:180:45 "
      "--elevation-deg 5");
  command.callback([arguments, noise_um, &context] {
    context.work = [arguments, noise_um, &context] {
      const MeshSensitivity sensitivity =
          mesh_sensitivity(arguments->make_request(), 1e-6 * *noise_um, context.threads, &context.stop);
      print_note(sensitivity.materials_note);
      warn(sensitivity.warnings);
      print_out("{}", sensitivity_table(sensitivity));
    };
  });
}

}  // namespace

void add_mesh(CommandOptions& program, CommandContext& context) {
  CommandOptions mesh = program.add_command("mesh", "Create or convert a mesh, or report its contents");
  mesh.require_command();
  mesh.footer(
      "Example:\n  seaglint mesh make ship -o ship.glb\n  seaglint mesh info ship.glb\n"
      "  seaglint mesh sensitivity --target ship.glb --frequency-ghz 9.4 --azimuth-deg 0:180:45");
  CommandOptions make = mesh.add_command("make", "Make a mesh: a ship, a reflector, a decoy or a canonical target");
  make.require_command();
  make.footer("Example:\n  seaglint mesh make reflector -o reflector.glb");
  add_ship_kinds(make, context);
  add_reflector_kinds(make, context);
  add_decoy_kind(make, context);
  add_simple_kinds(make, context);
  add_info(mesh, context);
  add_convert(mesh, context);
  add_sensitivity(mesh, context);
}

}  // namespace seaglint
