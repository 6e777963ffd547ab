// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The options of `rcs` for reference files and for the relation of their angles, frequency and origin to the sweep.

#include <string>
#include <vector>

#include "sim/field_tables/field_table.h"
#include "tools/options/command_options.h"

namespace seaglint {

struct ReferenceArguments {
  std::vector<std::string> files;
  // Each is empty, given once for all files, or given once per file in the order of the files.
  std::vector<std::string> polarisation, phi, frequency_ghz, incidence, origin_m;
  double floor_db = 80;
  std::string figure, curves;

  void add_to(CommandOptions& command);
  // Only those that say what the files do not.
  std::vector<CommandOption> add_properties_to(CommandOptions& command);
  std::vector<FieldTable> read() const;  // throws InputError
};

}  // namespace seaglint
