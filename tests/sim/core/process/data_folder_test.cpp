// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/text/names.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace seaglint {
namespace {

TEST(DataFolder, IsTheSourceTreeOfAProgramInItsBuildFolder) {
  EXPECT_TRUE(std::filesystem::equivalent(data_folder(), SEAGLINT_SOURCE_DIR)) << data_folder();
}

}  // namespace
}  // namespace seaglint
