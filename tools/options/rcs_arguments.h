// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The options of `rcs`, also of its reference files, and their conversion to an RcsRequest.

#include <optional>
#include <string>
#include <vector>

#include "sim/field_tables/field_table.h"
#include "tools/options/command_options.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_statistics.h"

namespace seaglint {

// The options of `rcs` for reference files and for the relation of their angles, frequency and origin to the sweep.

struct ReferenceTables {
  std::vector<FieldTable> tables;
  std::vector<std::string> folders;  // a sentence for each folder: its tables, the other files
};

// All cuts of a folder's tables under its name; of a file its one table as it is.
FieldTable joined_tables(std::vector<FieldTable> tables, const std::string& file);

struct ReferenceArguments {
  std::vector<std::string> files;
  // Each is empty, given once for all files, or given once per file or folder in their order.
  std::vector<std::string> polarisation, phi, frequency_ghz, elevation_deg, incidence, origin_m;
  double floor_db = 80;
  std::string figure, curves;  // figure: "off" for none

  bool draws() const { return figure != "off"; }
  bool figure_given() const { return draws() && !figure.empty(); }
  void add_to(CommandOptions& command);
  // Only those that say what the files do not.
  std::vector<CommandOption> add_properties_to(CommandOptions& command);
  // Of a folder all tables that it holds, by name. Throws InputError.
  ReferenceTables read() const;
};

// --unit, --forward, --up, --scale and --offset-m, wherever a mesh file is read.
void add_placement_options(CommandOptions& command, MeshPlacement& placement);
// --waterline-m, where the mesh is solved or written.
void add_waterline_option(CommandOptions& command, std::optional<double>& waterline_m);

struct RcsArguments {
  RcsRequest request;                // members that options set directly; make_request() fills the others
  std::vector<std::string> targets;  // mesh files of one scatterer
  std::string frequency_ghz, azimuth_deg, elevation_deg = "0", edges = "on", crease_deg = "auto", method = "beams",
                                          like, output;
  std::optional<double> transmit_azimuth_deg, transmit_elevation_deg, converge_db;
  bool cross_check = false;
  std::string statistics;  // table of sectors; empty: none
  double sector_deg = kSector_deg;
  bool polar = false;                                                 // the figure of the levels
  std::string isar, profiles, polarisation = "vv", style = "screen";  // figures; isar, profiles: empty for none
  std::vector<std::string> materials;                                 // NAME or PART=NAME
  std::vector<std::string> export_as;                                 // of kExportFormats
  std::string sea_surface = "sea_water", sea_paths = "all";
  ReferenceArguments reference;

  void add_to(CommandOptions& command);
  // Only those of a mesh, its materials and detail, and of the views of one antenna.
  void add_mesh_to(CommandOptions& command);
  // Parts of these: the mesh, and its materials and detail.
  CommandOption add_target_to(CommandOptions& command);
  void add_detail_to(CommandOptions& command);
  CommandOption add_export_as_to(CommandOptions& command);

  RcsRequest make_request() const;       // throws InputError
  RcsRequest make_mesh_request() const;  // without views, sea and transmitter
  std::string target_name() const;       // of the files, without folders; at least one

 private:
  // Options of which `like` leaves those that are given; of the last command to which they were added.
  std::optional<CommandOption> edges_option_, crease_option_, bounces_option_;
  void add_views_to(CommandOptions& command);
};

}  // namespace seaglint
