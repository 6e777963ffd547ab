// SPDX-License-Identifier: BSD-3-Clause
// No modules include one another in a circle. A module is a header with the source of the same name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/architecture/includes.h"

namespace seaglint {
namespace {

TEST(IncludeCircles, AreNone) { EXPECT_THAT(circles_of(includes_of(code_files())), testing::IsEmpty()); }

TEST(IncludeCircles, AreFoundBetweenSourcesAndHeaders) {
  const std::set<Circle> circles = circles_of({{"sim/a.cpp", "sim/a.h"},
                                               {"sim/a.cpp", "sim/b.h"},
                                               {"sim/b.h", "sim/c.h"},
                                               {"sim/c.cpp", "sim/a.h"},
                                               {"sim/d.h", "sim/a.h"}});
  EXPECT_THAT(circles, testing::ElementsAre(Circle{"sim/a", "sim/b", "sim/c"}));
}

}  // namespace
}  // namespace seaglint
