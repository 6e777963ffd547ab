// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Values of --set, put into a scenario before it is read.

#include <string>

namespace seaglint {

struct ScenarioDocument;

// `key.path=value` of --set; the value is YAML and is checked like the file.
struct Override {
  std::string key_path;
  std::string value;
};

// Puts an override's value into the tree; maps on the way that do not exist yet are made, so that reading can complain
// about them.
void apply_override(ScenarioDocument& document, const Override& override_value);

}  // namespace seaglint
