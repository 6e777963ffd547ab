// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Overrides of --set, inserted into a scenario before it is read.

#include <string>

namespace seaglint {

struct ScenarioDocument;

// `key.path=value` of --set; the value is YAML and is checked like the file.
struct Override {
  std::string key_path;
  std::string value;
};

// Inserts an override into the tree. Missing maps on the path are created, so that the reader reports unknown keys.
void apply_override(ScenarioDocument& document, const Override& override_value);

}  // namespace seaglint
