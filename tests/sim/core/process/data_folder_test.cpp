// SPDX-License-Identifier: BSD-3-Clause
// Files are found in the folder that is given, the working directory and the data of the program, in this order.
#include "sim/core/process/data_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;

class DataFolder : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"given", "here", "data/scenarios"}) fs::create_directories(root() / name);
    fs::current_path(root() / "here");
    set_data_folder(root() / "data");
  }
  void TearDown() override {
    fs::current_path(before_);
    set_data_folder(data_before_);
  }
  fs::path root() const { return folder_.path(); }
  void make(const std::string& name) const { write_file(root() / name, "x"); }

  std::string refusal(const std::function<void()>& call) const {
    try {
      call();
    } catch (const InputError& error) {
      return error.what();
    }
    return "found";
  }

  const fs::path before_ = fs::current_path(), data_before_ = data_folder();
  const TemporaryFolder folder_;
};

TEST_F(DataFolder, IsTheSourceTreeOfAProgramInItsBuildFolder) {
  EXPECT_TRUE(fs::equivalent(data_before_, SEAGLINT_SOURCE_DIR)) << data_before_;
}

TEST_F(DataFolder, IsSearchedLast) {
  const auto found = [&] { return find_file("a", root() / "given", "key"); };
  EXPECT_EQ(refusal(found), fmt::format("key: value 'a': no such file, neither in {0}/given nor in the working "
                                        "directory nor in {0}/data",
                                        root().string()));
  make("data/a");
  EXPECT_EQ(found(), root() / "data/a");
  make("here/a");
  EXPECT_EQ(found(), "a");
  make("given/a");
  EXPECT_EQ(found(), root() / "given/a");
  EXPECT_EQ(find_file("a", "", "key"), "a");
  EXPECT_EQ(refusal([&] { find_file("/none/a", root() / "given", "key"); }), "key: value '/none/a': no such file");
}

TEST_F(DataFolder, HasScenariosThatTheirNameFinds) {
  make("data/scenarios/quick.yaml");
  EXPECT_EQ(find_input("quick.yaml", "scenarios"), root() / "data/scenarios/quick.yaml");
  EXPECT_EQ(find_input("scenarios/quick.yaml", "scenarios"), root() / "data/scenarios/quick.yaml");
  EXPECT_EQ(refusal([&] { find_input("quick.yaml"); }),
            fmt::format("quick.yaml: no such file, neither in the working directory nor in {}/data", root().string()));
  make("here/quick.yaml");
  EXPECT_EQ(find_input("quick.yaml", "scenarios"), "quick.yaml");
  set_data_folder("");
  EXPECT_EQ(refusal([&] { find_input("none", "scenarios"); }), "none: no such file, not in the working directory");
}

}  // namespace
}  // namespace seaglint
