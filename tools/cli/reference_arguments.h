// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The options of `rcs` that name references, and how they lie to the computed sweep.

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "tools/rcs/rcs_reference.h"

namespace seaglint {

struct ReferenceArguments {
  std::vector<std::string> files;
  // Each empty, once for all files, or once for every file in their order.
  std::vector<std::string> polarisation, phi, frequency_ghz, origin_m;
  double floor_db = 80;
  std::string figure;

  void add_to(CLI::App& command);
  std::vector<RcsReference> read() const;  // throws InputError
};

}  // namespace seaglint
