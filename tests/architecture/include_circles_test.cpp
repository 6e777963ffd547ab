// SPDX-License-Identifier: BSD-3-Clause
// No modules include one another in a circle. A module is a header with the source of the same name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/architecture/includes.h"

namespace seaglint {
namespace {

// Circles that exist. None may be added, and what no longer is must be taken out.
const std::set<Circle> kKnownCircles = {{"sim/scattering/contributions", "sim/scattering/curvature",
                                         "sim/scattering/edge_footprint", "sim/scattering/footprint"},
                                        {"sim/scattering/edge_light", "sim/scattering/mirrored_rim"},
                                        {"sim/scattering/beam_echo", "sim/scattering/beam_scene",
                                         "sim/scattering/beam_tracer", "sim/scattering/illuminate"},
                                        {"sim/scattering/passing_radar", "sim/scattering/respond",
                                         "sim/scattering/sea_mirror", "sim/scattering/trace_plan"}};

// The circles of one set that are not in the other.
std::set<Circle> without(std::set<Circle> circles, const std::set<Circle>& others) {
  std::erase_if(circles, [&](const Circle& circle) { return others.contains(circle); });
  return circles;
}

TEST(IncludeCircles, AreTheKnownOnesAlone) {
  const std::set<Circle> found = circles_of(includes_of(code_files()));
  EXPECT_THAT(without(found, kKnownCircles), testing::IsEmpty()) << "new";
  EXPECT_THAT(without(kKnownCircles, found), testing::IsEmpty()) << "no longer there";
}

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
