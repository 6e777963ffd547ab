// SPDX-License-Identifier: BSD-3-Clause
// Settings of other programs, and what a user gives instead of them.
#include "tools/rcs/rcs_request.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/core/process/error.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(LikePrograms, SetFacetsEdgesAndBounces) {
  EXPECT_THAT(like_names(), ElementsAre("hfss", "feko", "cst"));
  const RcsRequest hfss = solved_like({}, like_program("hfss"));
  EXPECT_EQ(hfss.crease_deg, 0);
  EXPECT_FALSE(hfss.edges);
  EXPECT_EQ(hfss.max_bounces, 3);
  EXPECT_EQ(solver_text(hfss), "flat facets, no edge diffraction, at most 3 bounces, method beams (--like hfss)");
  const RcsRequest cst = solved_like({}, like_program("cst"));
  EXPECT_FALSE(cst.crease_deg);
  EXPECT_FALSE(cst.edges);
  EXPECT_EQ(solver_text({}),
            "surfaces smooth as the mesh says, with edge diffraction, at most 40 bounces, method beams");
}

TEST(LikePrograms, LeaveWhatIsGiven) {
  RcsRequest request;
  request.crease_deg = 12;
  request.max_bounces = 5;
  const RcsRequest kept =
      solved_like(request, like_program("hfss"), {.crease = true, .edges = true, .max_bounces = true});
  EXPECT_EQ(kept.crease_deg, 12);
  EXPECT_TRUE(kept.edges);
  EXPECT_EQ(kept.max_bounces, 5);
  EXPECT_EQ(solved_like(request, like_program("hfss"), {.max_bounces = true}).crease_deg, 0);
}

TEST(LikePrograms, AreRecognisedByTheReaderOfAFile) {
  EXPECT_STREQ(like_program_of_reader("an export of PyAEDT")->name, "hfss");
  EXPECT_STREQ(like_program_of_reader("an HFSS table")->name, "hfss");
  EXPECT_STREQ(like_program_of_reader("a FEKO far field")->name, "feko");
  EXPECT_STREQ(like_program_of_reader("a CST farfield table")->name, "cst");
  EXPECT_EQ(like_program_of_reader("a table of seaglint rcs"), nullptr);
  try {
    like_program("xpatch");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("like: value 'xpatch': must be one of hfss, feko, cst"));
  }
}

}  // namespace
}  // namespace seaglint
