// SPDX-License-Identifier: BSD-3-Clause
// `seaglint rcs --uncertainty`: its warning, columns and figures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/pipeline/rcs_command.h"

namespace seaglint {
namespace {

using testing::HasSubstr;
using testing::Not;

class UncertainRcs : public RcsCommand {
 protected:
  std::string cylinder() const { return folder_.path() / "cylinder.obj"; }
  // `rcs --uncertainty` of the cylinder with more words.
  ProgramResult uncertain(const std::vector<std::string>& more) const {
    std::vector<std::string> words{"rcs",           "--target", cylinder(), "--frequency-ghz", "10",
                                   "--azimuth-deg", "0:45:1",   "-o",       table(),           "--uncertainty"};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  }
};

TEST_F(UncertainRcs, WarnsWhereFlatFacetsWouldDiffer) {
  ASSERT_EQ(run_program({"mesh", "make", "cylinder", "--segments", "48", "-o", cylinder()}).code, 0);
  std::string tables[2];
  for (const char* threads : {"1", "2"}) {
    const ProgramResult result = uncertain({"--threads", threads});
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("warning: part 'cylinder': with flat facets in place of smooth surfaces"));
    EXPECT_THAT(result.out, HasSubstr("Figure: "));
    tables[threads[0] - '1'] = read_file(table());
  }
  EXPECT_EQ(tables[0], tables[1]);
  EXPECT_THAT(tables[0], HasSubstr("# warning: part 'cylinder': with flat facets"));
  EXPECT_EQ(read_table(table()).rows.front().size(), 17u);
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "rcs.png"));

  // A table with these columns is a reference, and the picture of the comparison has the band.
  const std::string reference = folder_.path() / "reference.V.csv", figure = folder_.path() / "comparison.svg";
  std::filesystem::rename(table(), reference);
  const ProgramResult compared = uncertain({"--reference", reference, "--figure", figure});
  ASSERT_EQ(compared.code, 0) << compared.err;
  EXPECT_THAT(read_file(figure), HasSubstr("to flat facets"));
}

TEST_F(UncertainRcs, DoesNotWarnOfAPlate) {
  const ProgramResult result = rcs({"--frequency-ghz", "10", "--azimuth-deg", "-30:30:1"});
  ASSERT_EQ(result.code, 0);
  EXPECT_THAT(result.err, Not(HasSubstr("part '")));
  EXPECT_THAT(read_file(table()), Not(HasSubstr("flat facets")));
  const ProgramResult refused = rcs({"--frequency-ghz", "10", "--azimuth-deg", "0", "--figure", "a.png"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--figure"));
}

}  // namespace
}  // namespace seaglint
