// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Material files: their fields, and what is wrong although each field is right.

#include <filesystem>
#include <optional>
#include <string>

#include "sim/scenario/material_spec.h"

namespace seaglint {

// Reads and checks a material file. Throws InputError "file:line:col: key.path: value ...: bound".
MaterialSpec read_material(const std::filesystem::path& file);
MaterialSpec parse_material(const std::string& yaml, const std::string& file_name);

// The file of a material, a file itself or NAME for assets/materials/NAME.yaml: beside `folder` or below the working
// directory; none of `pec`. Throws InputError that begins with `where` when there is none.
std::optional<std::filesystem::path> find_material_file(const std::string& name, const std::filesystem::path& folder,
                                                        const std::string& where);

// What that file says, a perfect conductor for `pec`; likewise.
MaterialSpec find_material(const std::string& name, const std::filesystem::path& folder, const std::string& where);

}  // namespace seaglint
