// SPDX-License-Identifier: BSD-3-Clause
// Targets that are classes or parts of others, and layouts of independent bodies or of one raft.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/scenario/writer.h"
#include "tests/sim/scenario/parsing.h"

namespace seaglint {
namespace {

using namespace testing_scenarios;
using testing::HasSubstr;
using testing::Not;

TEST(TargetRoles, PartNeedsNoLabelAndAClassDoes) {
  const std::string decoy = "  d: {role: part, mesh: a.glb}\n";
  const Scenario scenario =
      parse("seaglint: 1\ntargets:\n" + decoy + "  s: {label: 1, mesh: b.glb, companions: [{target: d}]}\n");
  EXPECT_EQ(scenario.targets[0].role, TargetRole::kPart);
  EXPECT_EQ(scenario.targets[1].role, TargetRole::kClass);
  const std::string yaml = effective_yaml(scenario);
  EXPECT_THAT(yaml, HasSubstr("  d:\n    role: part\n    mesh: a.glb\n"));
  EXPECT_EQ(effective_yaml(parse(yaml)), yaml);
  EXPECT_THAT(complaint_about(kShort + "  d: {role: class, mesh: a.glb}\n"),
              HasSubstr("targets.d.label: this key is missing"));
}

TEST(TargetRoles, LabelOfAPartIsIgnored) {
  const Scenario scenario =
      parse(kShort + "  s: {label: 1, mesh: b.glb, companions: [{target: a}]}\n", {{"targets.a.role", "part"}});
  EXPECT_THAT(effective_yaml(scenario), HasSubstr("  a:\n    role: part\n    mesh: a.glb\n"));
}

TEST(TargetRoles, PartWithoutUseAndScenariosWithoutAClassAreRefused) {
  const std::pair<const char*, const char*> mistakes[] = {
      {"  t: {role: whole, mesh: a.glb}", "13: targets.t.role: value 'whole': must be class or part"},
      {"  t: {role: part, mesh: a.glb}",
       "13: targets.t.role: value 'part': must be the companion of another target, or class"},
      {"  t: {role: part, mesh: a.glb, companions: [{target: a}]}",
       "44: targets.t.companions: not allowed here: valid only with role: class"},
  };
  for (const auto& [line, complaint] : mistakes)
    EXPECT_EQ(complaint_about(kShort + line + "\n"), std::string("folder/file.yaml:4:") + complaint);
  EXPECT_EQ(complaint_about("seaglint: 1\ntargets: {a: {role: part, mesh: a.glb}}\n"),
            "folder/file.yaml:2:10: targets: must have a target of role: class; parts have no samples of their own");
}

TEST(TargetRoles, PartMayBeACompanionByADrawnValueAndIsNotDrawnItself) {
  const std::string parts = "  d: {role: part, mesh: a.glb}\n  e: {role: part, mesh: a.glb}\n";
  EXPECT_EQ(complaint_about(kShort + parts + "  s: {label: 1, mesh: b.glb, companions: [{target: choice(d e)}]}\n"),
            "none");
  EXPECT_THAT(complaint_about(kShort + parts + "  s: {label: 1, mesh: b.glb, companions: [{target: d}]}\n"),
              HasSubstr("targets.e.role: value 'part': must be the companion of another target, or class"));
  EXPECT_THAT(complaint_about(kShort + "  s: {role: choice(class part), label: 1, mesh: b.glb}\n"),
              HasSubstr("targets.s.role: value 'choice(class part)': must be one value for all maps"));
}

TEST(LayoutBodies, AreIndependentUnlessTheyAreRigid) {
  const auto with_layout = [](const std::string& keys) {
    return kShort + "  t: {label: 1, mesh: a.glb, layout: {" + keys + "}}\n";
  };
  EXPECT_EQ(parse(with_layout("line: {}")).targets[1].layout->bodies, LayoutBodies::kIndependent);
  EXPECT_EQ(parse(with_layout("line: {}, bodies: rigid")).targets[1].layout->bodies, LayoutBodies::kRigid);
  EXPECT_EQ(complaint_about(with_layout("line: {}, bodies: welded")),
            "folder/file.yaml:4:57: targets.t.layout.bodies: value 'welded': must be independent or rigid");
  EXPECT_EQ(complaint_about(with_layout("bodies: rigid")),
            "folder/file.yaml:4:38: targets.t.layout.line: this key is missing");
  EXPECT_THAT(effective_yaml(parse(kShort)), Not(HasSubstr("bodies")));
}

}  // namespace
}  // namespace seaglint
