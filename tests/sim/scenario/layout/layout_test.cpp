// SPDX-License-Identifier: BSD-3-Clause
// Places of the bodies of a layout against their definitions, and the refusal of impossible ones.
#include "sim/scenario/layout/layout.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/scenario/scenario.h"
#include "tests/refusal.h"
#include "tests/sim/scenario/parsing.h"

namespace seaglint {
namespace {

using namespace testing_scenarios;
using testing::HasSubstr;
using testing::Not;

TargetSpec target_of(AreaLayout area, std::uint64_t seed = 0) {
  TargetSpec target;
  target.layout = LayoutSpec{.line = {}, .area = area, .seed = seed};
  return target;
}

double least_distance(const std::vector<Vec2>& places) {
  double least = 1e9;
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) least = std::min(least, (places[i] - places[j]).norm());
  return least;
}

Vec2 mean(const std::vector<Vec2>& places) {
  Vec2 sum = Vec2::Zero();
  for (const Vec2& place : places) sum += place;
  return sum / static_cast<double>(places.size());
}

TEST(AreaLayout, LineIsThatOfEqualSpacings) {
  TargetSpec spaced;
  spaced.layout = LayoutSpec{.line = LineLayout{4, 40, 3, -2}};
  const std::vector<Vec2> places = layout_positions(target_of({LayoutShape::kLine, 4, 120, 40, 0, 3, -2}).layout),
                          wanted = layout_positions(spaced.layout);
  ASSERT_EQ(places.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT((places[i] - wanted[i]).norm(), 1e-12);
  EXPECT_EQ(layout_positions(target_of({LayoutShape::kLine, 1, 120, 40, 0, 3, -2}).layout),
            std::vector<Vec2>{Vec2(3, -2)});
}

// x^2 / (L/2)^2 + y^2 / (W/2)^2 = 1, to the sagitta of the polygon; a circle has equal chords 2 r sin(pi / n), and the
// quarters of an ellipse equal arcs.
TEST(AreaLayout, RingIsAnEllipseWithEqualArcs) {
  for (const Vec2& place : layout_positions(target_of({LayoutShape::kRing, 7, 120, 40}).layout))
    EXPECT_NEAR(std::hypot(place.x() / 60, place.y() / 20), 1, 1e-7);
  const std::vector<Vec2> circle = layout_positions(target_of({LayoutShape::kRing, 5, 30, 30}).layout);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR((circle[i] - circle[(i + 1) % 5]).norm(), 30 * std::sin(kPi / 5), 1e-5);
  const std::vector<Vec2> four = layout_positions(target_of({LayoutShape::kRing, 4, 120, 40}).layout);
  EXPECT_LT((four[0] - Vec2(60, 0)).norm() + (four[1] - Vec2(0, 20)).norm(), 1e-9);
  EXPECT_LT((four[2] - Vec2(-60, 0)).norm() + (four[3] - Vec2(0, -20)).norm(), 1e-9);
  // A narrow ring is a line there and back: steps of 2 L / n.
  const std::vector<Vec2> narrow = layout_positions(target_of({LayoutShape::kRing, 12, 120, 1e-9}).layout);
  EXPECT_NEAR((narrow[1] - narrow[0]).norm(), 20, 1e-5);
  EXPECT_NEAR((narrow[2] - narrow[1]).norm(), 20, 1e-5);
}

TEST(AreaLayout, GridReachesTheBordersAndIsCentred) {
  const std::vector<Vec2> places = layout_positions(target_of({LayoutShape::kGrid, 12, 120, 40}).layout);
  EXPECT_NEAR(places.front().x(), -60, 1e-12);
  EXPECT_NEAR(places.back().y(), 20, 1e-12);
  EXPECT_LT(mean(places).norm(), 1e-12);
  EXPECT_NEAR(least_distance(places), 24, 1e-12);  // 6 columns, 2 rows
  for (int count = 1; count <= 40; ++count) {
    const std::vector<Vec2> grid = layout_positions(target_of({LayoutShape::kGrid, count, 90, 40}).layout);
    ASSERT_EQ(grid.size(), static_cast<std::size_t>(count));
    if (count > 1) {
      EXPECT_GT(least_distance(grid), 1);
    }
    EXPECT_NEAR(mean(grid).x(), 0, 1e-10);
  }
}

// 4,000 places: the means of a uniform distribution within five standard errors; no two nearer than the bound.
TEST(AreaLayout, RandomPlacesAreUniformAndApart) {
  Vec2 sum = Vec2::Zero(), squares = Vec2::Zero();
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const std::vector<Vec2> places = layout_positions(target_of({LayoutShape::kRandom, 10, 100, 30}, seed).layout);
    for (const Vec2& place : places) {
      sum += place;
      squares += Vec2(place.x() * place.x(), place.y() * place.y());
    }
    EXPECT_GE(least_distance(layout_positions(target_of({LayoutShape::kRandom, 20, 100, 30, 6}, seed).layout)), 6);
  }
  EXPECT_LT(std::abs(sum.x() / 4000), 5 * 100 / std::sqrt(12 * 4000.0));
  EXPECT_LT(std::abs(sum.y() / 4000), 5 * 30 / std::sqrt(12 * 4000.0));
  // The variance of a uniform square is L^2/12, that of its square L^4/180.
  EXPECT_NEAR(squares.x() / 4000, 1e4 / 12, 5 * 1e4 / std::sqrt(180 * 4000.0));
}

TEST(AreaLayout, DependsOnTheSeedAlone) {
  const AreaLayout area{LayoutShape::kRandom, 8, 100, 30};
  EXPECT_EQ(layout_positions(target_of(area, 5).layout), layout_positions(target_of(area, 5).layout));
  EXPECT_NE(layout_positions(target_of(area, 5).layout), layout_positions(target_of(area, 6).layout));
}

TEST(Layout, HeightsAndHeadingsAreWithinTheirRanges) {
  TargetSpec target = target_of({LayoutShape::kRing, 500, 1000, 1000});
  EXPECT_EQ(body_heights_m(target.layout), std::vector<double>(500, 0.0));
  target.layout->heights_m = BodyRange{1, 20};
  target.layout->headings_deg = BodyRange{-90, 90};
  const std::vector<double> heights = body_heights_m(target.layout), headings = body_headings_rad(target.layout);
  EXPECT_GT(std::ranges::min(heights), 1);
  EXPECT_LT(std::ranges::max(heights), 20);
  double product = 0;  // of the deviations: heights and headings are independent, to five standard errors
  for (std::size_t i = 0; i < 500; ++i) product += (heights[i] - 10.5) / 19 * headings[i] / kPi;
  EXPECT_LT(std::abs(product / 500), 5 / 12.0 / std::sqrt(500.0));
  EXPECT_NEAR(std::ranges::max(headings), kPi / 2, 0.1);
}

TEST(Layout, ScalesMultiplyThatOfTheTarget) {
  TargetSpec target = target_of({LayoutShape::kRing, 500, 1000, 1000});
  EXPECT_EQ(body_scales(target.layout, 3), std::vector<double>(500, 3.0));
  EXPECT_EQ(body_scales({}, 0.5), std::vector<double>{0.5});
  target.layout->heights_m = BodyRange{1, 20};
  target.layout->scales = BodyRange{0.5, 2};
  const std::vector<double> scales = body_scales(target.layout, 1), heights = body_heights_m(target.layout);
  double sum = 0, product = 0;  // mean of a uniform distribution; heights and sizes are independent
  for (std::size_t i = 0; i < 500; ++i) {
    EXPECT_GT(scales[i], 0.5);
    EXPECT_LT(scales[i], 2);
    sum += scales[i];
    product += (heights[i] - 10.5) / 19 * (scales[i] - 1.25) / 1.5;
  }
  EXPECT_NEAR(sum / 500, 1.25, 5 * 1.5 / std::sqrt(12 * 500.0));
  EXPECT_LT(std::abs(product / 500), 5 / 12.0 / std::sqrt(500.0));
  target.layout->seed = 1;
  EXPECT_NE(body_scales(target.layout, 1), scales);
  EXPECT_EQ(layout_text(target.layout), ", 500 in a ring of 1000 by 1000 m, of 0.5 to 2 times the mesh's size");
}

// Of 1,000 bodies: mean, variance and independence to five standard errors; the layout is otherwise the same.
TEST(Layout, JitterDisplacesEveryBodyByNormalDeviates) {
  for (TargetSpec target : {target_of({LayoutShape::kGrid, 1000, 9000, 9000}, 5), TargetSpec{}}) {
    if (!target.layout) target.layout = LayoutSpec{.line = LineLayout{1000, 40}, .seed = 5};
    const std::vector<Vec2> places = layout_positions(target.layout);
    target.layout->jitter_m = 2;
    const std::vector<Vec2> displaced = layout_positions(target.layout);
    Vec2 sum = Vec2::Zero(), squares = Vec2::Zero();
    double product = 0;
    for (std::size_t i = 0; i < 1000; ++i) {
      const Vec2 own = (displaced[i] - places[i]) / 2;
      sum += own;
      squares += Vec2(own.x() * own.x(), own.y() * own.y());
      product += own.x() * own.y();
    }
    EXPECT_LT(sum.cwiseAbs().maxCoeff(), 5 * std::sqrt(1000.0));
    EXPECT_LT((squares / 1000 - Vec2(1, 1)).cwiseAbs().maxCoeff(), 5 * std::sqrt(2 / 1000.0));
    EXPECT_LT(std::abs(product), 5 * std::sqrt(1000.0));
    EXPECT_EQ(layout_positions(target.layout), displaced);
    target.layout->jitter_m = 4;
    EXPECT_LT((layout_positions(target.layout)[7] - places[7] - 2 * (displaced[7] - places[7])).norm(), 1e-9);
    target.layout->seed = 6;
    EXPECT_NE(layout_positions(target.layout)[7], displaced[7]);
  }
}

TEST(Layout, JitterMayNotBringBodiesTooNear) {
  const std::string keys =
      "  t: {label: 1, mesh: a.glb, layout: {area: {shape: line, count: 9, length_m: 80, min_distance_m: 9}, "
      "jitter_m: 5}}\n";
  EXPECT_HAS(complaint_about(kShort + keys), "m apart: must be at least 9");
  EXPECT_EQ(complaint_about(kShort + keys, {{"targets.t.layout.jitter_m", "0"}}), "accepted");
  EXPECT_HAS(complaint_about(kShort + keys, {{"targets.t.layout.jitter_m", "1001"}}),
             "targets.t.layout.jitter_m: value '1001': must be a number within 0 and 1000");
}

TEST(Layout, RopesJoinTheFloatsOfALineThatMoveFreely) {
  const std::string keys =
      "  t: {label: 1, mesh: a.glb, layout: {line: {count: 4, spacing_m: 40}, tether_slack: 0.05}, motion: {model: "
      "float, translations: true}}\n";
  const Scenario scenario = parse(kShort + keys);
  EXPECT_DOUBLE_EQ(*rope_length_m(scenario.targets[1].layout), 42);
  EXPECT_EQ(layout_text(scenario.targets[1].layout), ", 4 in line, 40 m apart, joined by ropes of 42 m");
  EXPECT_EQ(effective_yaml(parse(effective_yaml(scenario))), effective_yaml(scenario));
  const std::string slack = "targets.t.layout.tether_slack: value '0.05': not allowed here: valid only with ";
  const auto complaint = [&](const char* key, const char* value) {
    return complaint_about(kShort + keys, {{key, value}});
  };
  EXPECT_HAS(complaint("targets.t.motion.translations", "false"), slack + "targets.t.motion.translations: true");
  EXPECT_HAS(complaint("targets.t.motion.model", "fixed"), slack + "targets.t.motion.model: float, not fixed");
  EXPECT_HAS(complaint("targets.t.layout.bodies", "rigid"), slack + "bodies: independent");
  EXPECT_HAS(complaint("targets.t.layout", "{area: {}, tether_slack: 0.05}"), slack + "line");
  EXPECT_HAS(complaint("targets.t.motion.drift", "{spread_mps: 0.1}"), "must be 0 with layout.tether_slack");
  EXPECT_EQ(complaint("targets.t.motion.drift", "{wind_mps: 10}"), "accepted");
  EXPECT_HAS(complaint("targets.t.layout.tether_slack", "-0.1"), "must be a number within 0 and 10");
}

TEST(Layout, MovesAsAWhole) {
  TargetSpec target = target_of({LayoutShape::kRandom, 8, 100, 30, 2}, 3);
  const std::vector<Vec2> before = layout_positions(target.layout);
  move_layout(target.layout, {70, -5});
  const std::vector<Vec2> after = layout_positions(target.layout);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_LT((after[i] - before[i] - Vec2(70, -5)).norm(), 1e-12);
  TargetSpec single;
  move_layout(single.layout, {70, -5});
  EXPECT_EQ(layout_positions(single.layout), std::vector<Vec2>{Vec2(70, -5)});
}

TEST(Layout, IsReadAndWritten) {
  const std::string keys =
      "  t: {label: 1, mesh: a.glb, layout: {area: {shape: grid, count: 9}, heights: {highest_m: 3}, seed: 7}}\n";
  const Scenario scenario = parse(kShort + keys);
  const LayoutSpec& layout = *scenario.targets[1].layout;
  EXPECT_EQ(layout.area->shape, LayoutShape::kGrid);
  EXPECT_EQ(layout.heights_m->highest, 3);
  EXPECT_EQ(layout.seed, 7u);
  EXPECT_EQ(layout_name(scenario.targets[1].layout), "grid");
  EXPECT_EQ(layout_text(scenario.targets[1].layout), ", 9 in a grid of 120 by 40 m");
  EXPECT_EQ(layout_name(scenario.targets[0].layout), "single");
  EXPECT_THAT(effective_yaml(parse(kShort)), Not(HasSubstr("seed: 0, ")));
}

TEST(Layout, RefusesWhatCannotBe) {
  const auto complaint = [](const std::string& keys) {
    return complaint_about(kShort + "  t: {label: 1, mesh: a.glb, layout: {" + keys + "}}\n");
  };
  EXPECT_HAS(complaint("line: {}, area: {}"), "file.yaml:4:38: targets.t.layout: must have line or area, not both");
  EXPECT_HAS(complaint("area: {shape: line, count: 30, length_m: 60, min_distance_m: 3}"),
             "targets.t.layout.area: bodies 0 and 1 are 2.06897 m apart: must be at least 3");
  EXPECT_HAS(complaint("area: {shape: random, count: 30, length_m: 10, width_m: 10, min_distance_m: 5}"),
             "targets.t.layout.area: 30 bodies find no places 5 m apart in 10 by 10 m");
  EXPECT_HAS(complaint("area: {shape: heap}"), "value 'heap': must be one of line, ring, grid, random");
  EXPECT_HAS(complaint("area: {}, heights: {lowest_m: 2, highest_m: 1}"),
             "targets.t.layout.heights.lowest_m: value '2': must be at most 1, the highest");
  EXPECT_HAS(complaint("line: {}, scales: {lowest: 3}"),
             "file.yaml:4:66: targets.t.layout.scales.lowest: value '3': must be at most 1, the highest");
  EXPECT_HAS(complaint("line: {}, scales: {lowest: 0}"),
             "targets.t.layout.scales.lowest: value '0': must be a number within 0.001 and 1000");
  EXPECT_HAS(complaint("line: {}, scales: [1, 2]"),
             "file.yaml:4:57: targets.t.layout.scales: a list: must be a map of key: value");
  EXPECT_HAS(complaint("line: {}, heights: {highest_m: 200}"), "must be a number within -10 and 100");
}

}  // namespace
}  // namespace seaglint
