// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/gltf_folder.h"

#include <algorithm>
#include <system_error>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"

namespace seaglint {

namespace fs = std::filesystem;

bool GltfFolder::holds(const std::string& name) const {
  std::error_code error;
  const fs::path file = fs::weakly_canonical(name, error);
  if (error) return false;
  const auto [rest, unused] = std::mismatch(root.begin(), root.end(), file.begin(), file.end());
  return rest == root.end();
}

bool exists_in_folder(const std::string& name, void* folder) {
  return static_cast<const GltfFolder*>(folder)->holds(name) && is_there(name);
}

std::string same_path(const std::string& name, void*) { return name; }

bool read_in_folder(std::vector<unsigned char>* content, std::string* problem, const std::string& name, void* user) {
  GltfFolder& folder = *static_cast<GltfFolder*>(user);
  if (!folder.holds(name)) {
    *problem += name + " is outside the file's folder";
    return false;
  }
  try {
    const std::string bytes = read_file(name);
    content->assign(bytes.begin(), bytes.end());
    folder.opened.emplace_back(name);
    return true;
  } catch (const InputError& error) {
    *problem += error.what();
    return false;
  }
}

bool write_nothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; }

}  // namespace seaglint
