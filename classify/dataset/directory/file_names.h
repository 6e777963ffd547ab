// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Names of the single files of a data set's directory (all but the shards).

namespace seaglint {

inline constexpr const char* kScenarioFile = "scenario.yaml";
inline constexpr const char* kInputsFile = "inputs.sha256";
inline constexpr const char* kManifestFile = "manifest.json";
inline constexpr const char* kDataCardFile = "README.md";
inline constexpr const char* kCroissantFile = "croissant.json";  // by `seaglint card`, as is the next
inline constexpr const char* kColumnsFile = "columns.csv";
inline constexpr const char* kSingleFiles[] = {kScenarioFile, kInputsFile,    kManifestFile,
                                               kDataCardFile, kCroissantFile, kColumnsFile};

}  // namespace seaglint
