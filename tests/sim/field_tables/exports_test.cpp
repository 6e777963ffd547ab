// SPDX-License-Identifier: BSD-3-Clause
// One point scatterer as other programs export it (tests/cases/exports/write_exports.py): every amplitude, direction
// and transmitter against its closed form.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dbsm.h"
#include "sim/core/process/error.h"
#include "sim/field_tables/read_field_table.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::filesystem::path kFolder = std::filesystem::path(SEAGLINT_SOURCE_DIR) / "tests/cases/exports";
const Vec3 kPlace(0.31, -0.2, 0.05);

Complex matrix_element(Polarisation element) {
  const Complex elements[] = {{1, 0}, {0, 0.2}, {0, 0.2}, {-0.5, 0.3}};
  return elements[static_cast<int>(element)];
}

Vec3 direction(double theta_deg, double phi_deg) {
  const double theta = radians(theta_deg), phi = radians(phi_deg);
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

// About the cut's phase origin.
Complex exact(const RcsCut& cut, const FieldValue& value) {
  const Vec3 receiver = direction(value.theta_deg, value.phi_deg);
  const Vec3 transmitter =
      cut.transmitter->is_monostatic ? receiver : direction(cut.transmitter->theta_deg, cut.transmitter->phi_deg);
  const double k = 2 * kPi * value.frequency_hz / kSpeedOfLight;
  return matrix_element(cut.element) * std::polar(1.0, k * (receiver + transmitter).dot(kPlace - cut.origin_m));
}

// relative: printed digits of magnitude and phase.
void expect_exact(const FieldTable& table, double relative) {
  for (const RcsCut& cut : table.cuts) {
    ASSERT_TRUE(cut.transmitter);
    for (const FieldValue& value : cut.values) {
      const Complex wanted = exact(cut, value);
      EXPECT_NEAR(value.level_dbsm, dbsm(wanted), 8.7 * relative) << table.name << ":" << value.line;
      const Complex amplitude = value.amplitude_m.value_or(wanted);
      EXPECT_LT(std::abs(amplitude - wanted), relative * std::abs(wanted)) << table.name << ":" << value.line;
    }
  }
}

FieldTable read(const char* name, const FieldTableSettings& settings = {}) {
  return read_field_table(kFolder / name, settings);
}

FieldTableSettings monostatic(std::vector<Polarisation> elements) {
  FieldTableSettings settings;
  settings.elements = std::move(elements);
  settings.transmitter.emplace();
  return settings;
}

std::vector<Polarisation> elements_of(const FieldTable& table) {
  std::vector<Polarisation> elements;
  for (const RcsCut& cut : table.cuts) elements.push_back(cut.element);
  return elements;
}

TEST(Exports, OfCstTakeFrequencySweepAndPolarisationFromTheirName) {
  const FieldTable table = read("rcs (f = 9.5), theta = (85,85,1), phi = (0,30,10), VP (1) [pw].txt");
  EXPECT_THAT(elements_of(table), ElementsAre(Polarisation::kVv, Polarisation::kHv));
  EXPECT_EQ(
      reading_of(table),
      "rcs (f = 9.5), theta = (85,85,1), phi = (0,30,10), VP (1) [pw].txt: read as a CST farfield table; frequency "
      "9.5 GHz by the file's name; monostatic: the file's name has a sweep of the incident wave; VP in the file's "
      "name: v transmitted; e^{+jwt}; theta^ = -v, phi^ = h");
  ASSERT_EQ(table.cuts[0].values.size(), 4u);
  EXPECT_EQ(table.cuts[0].values[2].line, 5);
  EXPECT_TRUE(table.cuts[0].transmitter->is_monostatic);
  expect_exact(table, 2e-3);  // 0.005 dB of four digits, 6e-4, and 0.0005 deg
}

TEST(Exports, OfCstFieldsAreBistaticAndFoldedAtThePole) {
  const FieldTable table = read("farfield (f=10) theta=90 phi=0 HP [pw].txt");
  EXPECT_THAT(elements_of(table), ElementsAre(Polarisation::kVh, Polarisation::kHh));
  EXPECT_FALSE(table.cuts[0].transmitter->is_monostatic);
  EXPECT_EQ(table.cuts[0].transmitter->theta_deg, 90);
  EXPECT_EQ(table.cuts[0].values[0].phi_deg, 200);
  expect_exact(table, 1e-4);
}

TEST(Exports, OfCstInLudwigsDefinition) {
  FieldTableSettings settings = monostatic({Polarisation::kVv, Polarisation::kHv});
  settings.frequency_hz = 10e9;
  expect_exact(read("ludwig3.txt", settings), 1e-5);
}

TEST(Exports, OfCstCurvesHaveTheirPlaceInParametersAndNames) {
  const FieldTable runs = read("curves of two runs.txt", monostatic({}));
  ASSERT_THAT(elements_of(runs), ElementsAre(Polarisation::kVv));
  ASSERT_EQ(runs.cuts[0].values.size(), 6u);
  EXPECT_EQ(runs.cuts[0].values[5].theta_deg, 90);
  EXPECT_EQ(runs.cuts[0].values[5].frequency_hz, 10e9);
  expect_exact(runs, 1e-12);
  const FieldTable older = read("curve f=9.5 theta=90 HH.txt", monostatic({}));
  ASSERT_THAT(elements_of(older), ElementsAre(Polarisation::kHh));
  EXPECT_EQ(older.cuts[0].values[4].phi_deg, 40);
  expect_exact(older, 1e-8);
}

TEST(Exports, OfCstSourcesAreAboutTheirPosition) {
  FieldTableSettings settings;
  settings.elements = {Polarisation::kVv, Polarisation::kHv};
  settings.transmitter = DeclaredTransmitter{false, 90, 0};
  const FieldTable table = read("source.ffs", settings);
  ASSERT_EQ(table.cuts.size(), 2u);
  ASSERT_EQ(table.cuts[0].values.size(), 12u);
  EXPECT_EQ(table.cuts[0].origin_m, Vec3(0.1, 0, 0.02));
  expect_exact(table, 1e-7);
}

TEST(Exports, OfFekoAreMonostaticOrBistaticByTheirBlocks) {
  const FieldTable mono = read("monostatic.ffe");
  EXPECT_THAT(elements_of(mono), ElementsAre(Polarisation::kVv, Polarisation::kHv));
  EXPECT_EQ(mono.cuts[0].values.size(), 6u);
  EXPECT_TRUE(mono.cuts[0].transmitter->is_monostatic);
  expect_exact(mono, 1e-7);
  const FieldTable bistatic = read("bistatic.ffe");
  EXPECT_EQ(bistatic.cuts.size(), 4u);
  EXPECT_EQ(bistatic.cuts[2].transmitter->phi_deg, 40);
  expect_exact(bistatic, 1e-7);
}

TEST(Exports, OfHfssHaveColumnsOrFamilies) {
  const FieldTable table = read("hfss VP.csv");
  EXPECT_THAT(elements_of(table), ElementsAre(Polarisation::kVv, Polarisation::kHv));
  EXPECT_TRUE(table.cuts[0].has_phase());
  EXPECT_FALSE(table.cuts[1].has_phase());
  expect_exact(table, 1e-12);
  FieldTableSettings hh;
  hh.elements = {Polarisation::kHh};
  const FieldTable families = read("hfss families HP.csv", hh);
  ASSERT_EQ(families.cuts[0].values.size(), 6u);
  EXPECT_EQ(families.cuts[0].values[3].theta_deg, 90);
  expect_exact(families, 1e-12);
}

TEST(Exports, OfPyaedtAreReadByEitherFile) {
  const FieldTable vv = read("pyaedt_VV.json");
  EXPECT_EQ(reading_of(vv),
            "pyaedt_VV.json: read as an export of PyAEDT; e^{+jwt}; theta^ = -v, phi^ = h; monostatic; vv by the "
            "file's name (received, transmitted)");
  ASSERT_THAT(elements_of(vv), ElementsAre(Polarisation::kVv));
  ASSERT_EQ(vv.cuts[0].values.size(), 12u);
  EXPECT_EQ(vv.cuts[0].values[11].frequency_hz, 10e9);
  EXPECT_EQ(vv.cuts[0].values[11].phi_deg, 200);
  EXPECT_EQ(vv.cuts[0].values[11].theta_deg, 90);
  expect_exact(vv, 1e-12);
  const FieldTable vh = read("pyaedt_VH.h5");  // MHz
  ASSERT_THAT(elements_of(vh), ElementsAre(Polarisation::kVh));
  EXPECT_EQ(vh.cuts[0].values[0].frequency_hz, 9.5e9);
  expect_exact(vh, 1e-12);
}

TEST(Exports, ThatContradictTheSettingsAreRefused) {
  FieldTableSettings settings;
  settings.frequency_hz = 5e9;
  EXPECT_THROW(read("monostatic.ffe", settings), InputError);
  settings = {};
  settings.transmitter = DeclaredTransmitter{false, 90, 0};
  try {
    read("monostatic.ffe", settings);
    ADD_FAILURE() << "read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("monostatic.ffe: is monostatic: remove --incidence"));
  }
}

}  // namespace
}  // namespace seaglint
