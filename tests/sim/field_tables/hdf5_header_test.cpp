// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/pandas_table.h"

#include <gtest/gtest.h>

namespace seaglint {
namespace {

const std::filesystem::path kRoot = SEAGLINT_SOURCE_DIR;

// HDF5 1.10 follows the list of the second file without end.
TEST(LocalHeaps, WhoseFreeListIsACircleAreFound) {
  EXPECT_TRUE(has_sound_heaps(kRoot / "tests/cases/exports/pyaedt_VH.h5"));
  EXPECT_TRUE(has_sound_heaps(kRoot / "tests/cases/exports/pyaedt_VV.h5"));
  EXPECT_FALSE(has_sound_heaps(kRoot / "tests/fuzz/inputs/pyaedt/heap_circle.h5"));
}

}  // namespace
}  // namespace seaglint
