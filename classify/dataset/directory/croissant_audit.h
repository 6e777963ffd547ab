// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Comparison of a data set's croissant.json with the files that it lists.

#include <filesystem>
#include <string>
#include <vector>

#include "classify/dataset/format/manifest.h"

namespace seaglint {

// Faults of croissant.json: no valid JSON, a shard that is missing in it, and files of the directory whose SHA-256 or
// presence differs. Shards are compared with the manifest alone. Empty without that file.
std::vector<std::string> croissant_faults(const std::filesystem::path& directory, const Manifest& manifest);

}  // namespace seaglint
