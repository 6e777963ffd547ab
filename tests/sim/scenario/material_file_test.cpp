// SPDX-License-Identifier: BSD-3-Clause
// Material files: their contents are read into the struct, and every error is reported with its place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/core/text/names.h"
#include "sim/scenario/material_spec.h"

namespace seaglint {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kCoating = R"(material: coating
source: a test
kind: layers
backing: pec
roughness_mm: 0.2
layers:
  - thickness_mm: 1.2
    permittivity: {real: 5, debye: [{strength: 3, relaxation_ghz: 12}], conductivity_s_m: 0.1}
    permeability: {table: [{frequency_ghz: 8, real: 1.4, loss: 0.5}, {frequency_ghz: 18, real: 1.1, loss: 0.7}]}
)";

std::string refusal(const std::string& yaml) {
  try {
    parse_material(yaml, "m.yaml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(MaterialFile, IsReadIntoTheStruct) {
  const MaterialSpec spec = parse_material(kCoating, "m.yaml");
  EXPECT_EQ(spec.name, "coating");
  EXPECT_EQ(spec.kind, SurfaceKind::kLayers);
  EXPECT_EQ(spec.backing, Backing::kPec);
  EXPECT_EQ(spec.roughness_mm, 0.2);
  ASSERT_EQ(spec.layers.size(), 1u);
  EXPECT_EQ(spec.layers[0].thickness_mm, 1.2);
  EXPECT_EQ(spec.layers[0].permittivity.debye[0].relaxation_ghz, 12);
  EXPECT_EQ(spec.layers[0].permittivity.conductivity_s_m, 0.1);
  EXPECT_EQ(spec.layers[0].permeability.table[1].loss, 0.7);
}

TEST(MaterialFile, RefusesMediaThatWouldAmplify) {
  EXPECT_THAT(
      refusal(with(kCoating, "real: 5", "real: 5, loss: -0.1")),
      StartsWith("m.yaml:8:35: layers.0.permittivity.loss: value '-0.1': must be a number within 0 and 100000"));
  EXPECT_THAT(refusal(with(kCoating, "strength: 3", "strength: -3")),
              HasSubstr("layers.0.permittivity.debye.0.strength"));
  EXPECT_THAT(refusal(with(kCoating, "loss: 0.5", "loss: -0.5")), HasSubstr("layers.0.permeability.table.0.loss"));
  EXPECT_THAT(refusal(with(kCoating, "conductivity_s_m: 0.1", "conductivity_s_m: -1")), HasSubstr("conductivity_s_m"));
  EXPECT_THAT(refusal("material: x\nsource: y\nkind: impedance\nresistance: -0.2\n"),
              StartsWith("m.yaml:4:13: resistance: value '-0.2'"));
}

TEST(MaterialFile, NamesEveryOtherMistake) {
  EXPECT_THAT(refusal(with(kCoating, "kind: layers", "kind: layer")), HasSubstr("m.yaml:3:7: kind: value 'layer'"));
  EXPECT_THAT(refusal(with(kCoating, "backing: pec", "resistance: 1")), HasSubstr("valid only with kind: impedance"));
  EXPECT_THAT(refusal(with(kCoating, "thickness_mm", "thicknes_mm")), HasSubstr("did you mean 'thickness_mm'?"));
  EXPECT_THAT(refusal(with(kCoating, "thickness_mm: 1.2", "thickness_mm: 0")), HasSubstr("greater than 0"));
  EXPECT_THAT(refusal(with(kCoating, "frequency_ghz: 18", "frequency_ghz: 8")),
              HasSubstr("must be greater than the row before"));
  EXPECT_THAT(refusal(with(kCoating, "permeability: {table", "permeability: {conductivity_s_m: 1, table")),
              HasSubstr("valid only with a permittivity"));
  EXPECT_THAT(refusal("material: x\nsource: y\nkind: layers\n"), HasSubstr("layers: this key is missing"));
  EXPECT_THAT(refusal("material: x\nkind: pec\n"), HasSubstr("source: this key is missing"));
  EXPECT_THAT(refusal("material: x\nsource: y\nkind: sea_water\ntemperature_c: 40\n"), HasSubstr("temperature_c"));
  EXPECT_THAT(refusal("material: x\nsource: y\nkind: pec\nlowest_ghz: 5\nhighest_ghz: 4\n"),
              HasSubstr("at least lowest_ghz"));
  EXPECT_THAT(refusal(""), HasSubstr("the file is empty"));
}

TEST(MaterialFile, IsFoundByNameOrPath) {
  const std::string root = SEAGLINT_SOURCE_DIR;
  EXPECT_EQ(find_material("pec", "", "x").kind, SurfaceKind::kPec);
  EXPECT_EQ(find_material("sea_water", root, "x").kind, SurfaceKind::kSeaWater);
  EXPECT_EQ(find_material(root + "/assets/materials/aluminium.yaml", "", "x").conductivity_s_m, 3.816e7);
  try {
    find_material("aluminum", root, "targets.ship.material");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), "targets.ship.material: value 'aluminum': no such material in assets/materials, " +
                                places_text(root) + ": did you mean 'aluminium'?");
  }
  const auto refusal = [](const std::string& name, const std::string& folder) {
    try {
      find_material(name, folder, "x");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_THAT(refusal("unobtainium", ""),
              HasSubstr("no such material in assets/materials, neither in the working directory nor in "));
  EXPECT_EQ(refusal("none.yaml", "/there"), "x: value 'none.yaml': no such material file, " + places_text("/there"));
  EXPECT_EQ(refusal("none.yaml", ""), "x: value 'none.yaml': no such material file, " + places_text(""));
}

TEST(MaterialFile, BrokenFilesAreReadOrRefusedWithAnInputError) {
  for (std::uint64_t i = 0; i < 5000; ++i) {
    Random random({4, Stream::kTest, i});
    std::string text = kCoating;
    for (std::uint32_t change = 0; change < 1 + random.below(4); ++change) {
      const std::size_t at = random.below(static_cast<std::uint32_t>(text.size()));
      switch (random.below(3)) {
        case 0: text.erase(at, random.below(12)); break;
        case 1: text[at] = static_cast<char>(random.below(256)); break;
        default: text.insert(at, text.substr(random.below(static_cast<std::uint32_t>(text.size())), random.below(20)));
      }
    }
    try {
      parse_material(text, "m.yaml");
    } catch (const InputError&) {
    }
  }
}

}  // namespace
}  // namespace seaglint
