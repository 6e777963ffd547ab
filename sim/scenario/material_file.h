// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Material files: fields and consistency checks.

#include <filesystem>
#include <optional>
#include <string>

#include "sim/scenario/material_spec.h"

namespace seaglint {

// Reads and checks a material file. Throws InputError "file:line:col: key.path: value ...: bound".
MaterialSpec read_material(const std::filesystem::path& file);
MaterialSpec parse_material(const std::string& yaml, const std::string& file_name);

// File of a material: a path, or NAME for assets/materials/NAME.yaml; searched in `folder`, then in the working
// directory. nullopt for `pec`. Throws InputError, beginning with `where`, when there is none.
std::optional<std::filesystem::path> find_material_file(const std::string& name, const std::filesystem::path& folder,
                                                        const std::string& where);

// Contents of that file; a perfect conductor for `pec`. Throws likewise.
MaterialSpec find_material(const std::string& name, const std::filesystem::path& folder, const std::string& where);

}  // namespace seaglint
