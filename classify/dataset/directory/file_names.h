// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Names of the files that stand once in a data set's directory, beside its shards.

namespace seaglint {

inline constexpr const char* kScenarioFile = "scenario.yaml";
inline constexpr const char* kInputsFile = "inputs.sha256";
inline constexpr const char* kManifestFile = "manifest.json";
inline constexpr const char* kDataCardFile = "README.md";

}  // namespace seaglint
