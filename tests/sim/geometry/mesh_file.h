// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A folder of mesh files for one test.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "sim/core/process/error.h"
#include "sim/geometry/files/mesh_io.h"

namespace seaglint {

class MeshFile : public testing::Test {
 protected:
  void SetUp() override {
    folder = std::filesystem::path(testing::TempDir()) /
             ("seaglint_mesh_" + std::to_string(::getpid()) +
              std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  std::filesystem::path put(const std::string& name, const std::string& content) const {
    std::ofstream(folder / name, std::ios::binary) << content;
    return folder / name;
  }
  static std::string bytes_of(const std::filesystem::path& path) {
    std::ostringstream content;
    content << std::ifstream(path, std::ios::binary).rdbuf();
    return content.str();
  }
  static void expect_error(const std::filesystem::path& path, const std::string& what) {
    try {
      read_mesh(path);
      ADD_FAILURE() << path << " was read";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith(path.string()));
      EXPECT_THAT(error.what(), testing::HasSubstr(what));
    }
  }

  std::filesystem::path folder;
};

// float32 keeps 24 bits: half a unit in the last place is 2^-24 of a coordinate.
inline constexpr double kFloatRounding = 6e-8;

}  // namespace seaglint
