// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A folder of mesh files for one test.

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "sim/core/process/file.h"
#include "sim/geometry/files/mesh_io.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace seaglint {

class MeshFile : public testing::Test {
 protected:
  std::filesystem::path put(const std::string& name, const std::string& content) const {
    std::ofstream(folder / name, std::ios::binary) << content;
    return folder / name;
  }
  static std::string bytes_of(const std::filesystem::path& path) { return read_file(path); }
  static std::string refusal(const std::filesystem::path& path) {
    return refusal_of([&] { read_mesh(path); });
  }
  static void expect_error(const std::filesystem::path& path, const std::string& what) {
    EXPECT_THAT(refusal(path), testing::AllOf(testing::StartsWith(path.string()), testing::HasSubstr(what)));
  }

  const TemporaryFolder temporary;
  const std::filesystem::path folder = temporary.path();
};

// float32 keeps 24 bits: half a unit in the last place is 2^-24 of a coordinate.
inline constexpr double kFloatRounding = 6e-8;

}  // namespace seaglint
