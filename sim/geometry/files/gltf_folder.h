// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Restricts the files that tinygltf opens to the folder of the glTF; its callbacks, each with a GltfFolder as user
// data.

#include <filesystem>
#include <string>
#include <vector>

namespace seaglint {

struct GltfFolder {
  std::filesystem::path root;
  std::vector<std::filesystem::path> opened;  // in order

  // True for a name inside root, links resolved.
  bool holds(const std::string& name) const;
};

bool exists_in_folder(const std::string& name, void* folder);
std::string same_path(const std::string& name, void* folder);
// False with a message in *problem for a file that is outside the folder or cannot be read.
bool read_in_folder(std::vector<unsigned char>* content, std::string* problem, const std::string& name, void* folder);
bool write_nothing(std::string* problem, const std::string& name, const std::vector<unsigned char>& content,
                   void* folder);

}  // namespace seaglint
