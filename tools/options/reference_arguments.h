// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The options of `rcs` for reference files and for the relation of their angles, frequency and origin to the sweep.

#include <string>
#include <vector>

#include "sim/field_tables/field_table.h"
#include "tools/options/command_options.h"

namespace seaglint {

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
  std::string figure, curves;

  void add_to(CommandOptions& command);
  // Only those that say what the files do not.
  std::vector<CommandOption> add_properties_to(CommandOptions& command);
  // Of a folder all tables that it holds, by name. Throws InputError.
  ReferenceTables read() const;
};

}  // namespace seaglint
