// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/strip_theory/hull_sections.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "sim/core/process/error.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

TEST(ReadSections, IgnoresAByteOrderMark) {
  const HullSections plain = read_sections(SEAGLINT_SOURCE_DIR "/tests/reference/ship_motion/s175_sections.csv", 40);
  const HullSections marked = read_sections(SEAGLINT_SOURCE_DIR "/tests/cases/tables/sections_bom.csv", 40);
  EXPECT_EQ(marked.length, plain.length);
  ASSERT_EQ(marked.sections.size(), plain.sections.size());
  for (std::size_t i = 0; i < plain.sections.size(); ++i)
    EXPECT_EQ(marked.sections[i].area, plain.sections[i].area) << i;
}

TEST(ReadSections, RefusesWhatIsNoHull) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& rows) -> std::string {
    const std::filesystem::path file = folder.path() / "s.csv";
    std::ofstream(file) << "x_m;breadth_m;draught_m;area_m2\n" + rows;
    try {
      read_sections(file, 4);
    } catch (const InputError& error) {
      return std::string(error.what()).substr(folder.path().string().size() + 1);
    }
    return "accepted";
  };
  EXPECT_EQ(refusal("0;1;1;0,5\n1;1;1;0,5\n"), "accepted");
  EXPECT_EQ(refusal("0;1;1;1\n1;1;1;1.5\n"),
            "s.csv:3:7: area_m2: value '1.5': must be at most breadth times draught, 1");
  EXPECT_EQ(refusal("0;1;1;1\n1;-1;1;1\n"), "s.csv:3:3: breadth_m: value '-1': must be within 0 and 100000");
  EXPECT_EQ(refusal("1;1;1;1\n0;1;1;1\n"), "s.csv:3:1: x_m: value '0': must be greater than 1 of line 2");
}

}  // namespace
}  // namespace seaglint
