// SPDX-License-Identifier: BSD-3-Clause
// A data set records its scenario and the files that the scenario names.
#include "classify/dataset/directory/dataset_reader.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "classify/dataset/format/manifest.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class InputList : public ::testing::Test {
 protected:
  InputList() {
    fs::create_directory(folder_ / "data");
    write("ship.obj", "ship");
    scenario_.folder = folder_;
    scenario_.targets.resize(1);
    scenario_.targets[0].name = "ship";
    scenario_.targets[0].mesh = "ship.obj";
  }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  std::string complaint() const {
    try {
      require_same_inputs(folder_ / "data", scenario_);
      write_input_list(folder_ / "data", scenario_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
  Scenario scenario_;
};

TEST_F(InputList, IsWrittenOnceAndFilesMustMatchIt) {
  EXPECT_EQ(complaint(), "");
  EXPECT_EQ(read_file(folder_ / "data" / kInputsFile), sha256("ship") + "  targets.ship.mesh\n");
  EXPECT_EQ(complaint(), "");
  write("ship.obj", "another");
  EXPECT_THAT(complaint(), HasSubstr(fmt::format(
                               "inputs.sha256: targets.ship.mesh: {} is not the file that the data set was begun with",
                               (folder_ / "ship.obj").string())));
  EXPECT_EQ(read_file(folder_ / "data" / kInputsFile), sha256("ship") + "  targets.ship.mesh\n");
  write("ship.obj", "ship");
  EXPECT_EQ(complaint(), "");
}

TEST_F(InputList, IncludesTheBuffersOfAMesh) {
  constexpr std::size_t kTriangleBytes = 36;
  write("ship.gltf",
        R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
        R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)"
        R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":"parts/hull.bin"}]})");
  fs::create_directory(folder_ / "parts");
  write("parts/hull.bin", std::string(kTriangleBytes, '\0'));
  scenario_.targets[0].mesh = "ship.gltf";
  EXPECT_EQ(complaint(), "");
  EXPECT_THAT(read_file(folder_ / "data" / kInputsFile),
              HasSubstr(sha256(std::string(kTriangleBytes, '\0')) + "  targets.ship.mesh/parts/hull.bin\n"));
  write("parts/hull.bin", std::string(kTriangleBytes, '\1'));
  EXPECT_THAT(complaint(), HasSubstr("inputs.sha256: targets.ship.mesh/parts/hull.bin: "));
}

TEST_F(InputList, IsNotWrittenWhereNoFileIsNamed) {
  scenario_.targets[0].mesh.clear();
  EXPECT_EQ(complaint(), "");
  EXPECT_FALSE(fs::exists(folder_ / "data" / kInputsFile));
}

TEST_F(InputList, ThatIsNoListIsRefused) {
  write("data/inputs.sha256", "nonsense\n");
  EXPECT_THAT(complaint(), HasSubstr("inputs.sha256:1:1: 'nonsense': must be a checksum and a key"));
}

}  // namespace
}  // namespace seaglint
