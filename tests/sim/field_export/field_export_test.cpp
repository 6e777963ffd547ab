// SPDX-License-Identifier: BSD-3-Clause
// Cuts written as other programs' files are read back by the readers of those formats.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/file.h"
#include "sim/field_export/field_export.h"
#include "sim/field_tables/field_table.h"
#include "tests/pipeline/program.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

using testing::HasSubstr;

// All elements with amplitudes of their own over two frequencies, thetas and three phis.
std::vector<RcsCut> cuts_of(const DeclaredTransmitter& transmitter) {
  std::vector<RcsCut> cuts;
  for (int element = 0; element < 4; ++element) {
    RcsCut& cut = cuts.emplace_back();
    cut.element = static_cast<Polarisation>(element);
    cut.transmitter = transmitter;
    for (const double frequency_hz : {9.3e9, 10.123456789e9}) {
      for (const double theta : {85.0, 90.25}) {
        for (const double phi : {0.0, 10.5, 200.0}) {
          const auto n = static_cast<double>(cut.values.size());
          const Complex s = std::polar((element + 1) * std::pow(10.0, -n / 3), 0.7 * element + 1.1 * n);
          cut.values.push_back({frequency_hz, theta, phi, dbsm(s), s, 0});
        }
      }
    }
  }
  return cuts;
}

const DeclaredTransmitter kMonostatic, kFixed{false, 80, 30.5};

const FieldValue* find(const RcsCut& cut, const FieldValue& place) {
  for (const FieldValue& value : cut.values)
    if (std::abs(value.frequency_hz - place.frequency_hz) < 1e-8 * place.frequency_hz &&
        std::abs(value.theta_deg - place.theta_deg) < 1e-9 && std::abs(value.phi_deg - place.phi_deg) < 1e-9)
      return &value;
  return nullptr;
}

// Every value that was read is the one written there, relative to it, and none is missing over all tables.
void expect_equal(const std::vector<FieldTable>& tables, const std::vector<RcsCut>& written, bool transmitted_v,
                  double relative) {
  std::size_t values = 0;
  for (const FieldTable& table : tables) {
    ASSERT_EQ(table.cuts.size(), 2u);
    for (const RcsCut& cut : table.cuts) {
      ASSERT_EQ(transmits_v(cut.element), transmitted_v);
      const RcsCut& source = written[static_cast<std::size_t>(cut.element)];
      ASSERT_TRUE(cut.transmitter);
      EXPECT_EQ(cut.transmitter->is_monostatic, source.transmitter->is_monostatic);
      EXPECT_EQ(cut.transmitter->theta_deg, source.transmitter->theta_deg);
      EXPECT_EQ(cut.transmitter->phi_deg, source.transmitter->phi_deg);
      for (const FieldValue& value : cut.values) {
        const FieldValue* wanted = find(source, value);
        ASSERT_NE(wanted, nullptr) << table.name << ":" << value.line;
        EXPECT_LT(std::abs(*value.amplitude_m - *wanted->amplitude_m), relative * std::abs(*wanted->amplitude_m))
            << table.name << ":" << value.line;
        ++values;
      }
    }
  }
  EXPECT_EQ(values, 2 * written[0].values.size());
}

TEST(FieldExport, AsFekoHasNineDigits) {
  const TemporaryFolder folder;
  for (const DeclaredTransmitter& transmitter : {kMonostatic, kFixed}) {
    const std::vector<RcsCut> cuts = cuts_of(transmitter);
    for (const bool v : {true, false}) {
      const std::filesystem::path file = folder.path() / (v ? "a VP.ffe" : "a HP.ffe");
      write_file(file, feko_text(cuts, v));
      expect_equal({read_field_table(file, {})}, cuts, v, 1e-8);  // 5e-9 of each part
    }
  }
}

TEST(FieldExport, AsFekoHasABlockPerReceiverWhereTheyAreNoGrid) {
  std::vector<RcsCut> cuts = cuts_of(kFixed);
  for (RcsCut& cut : cuts) cut.values.erase(cut.values.begin() + 2);
  const TemporaryFolder folder;
  write_file(folder.path() / "a VP.ffe", feko_text(cuts, true));
  expect_equal({read_field_table(folder.path() / "a VP.ffe", {})}, cuts, true, 1e-8);
}

TEST(FieldExport, AsCstHasTenDigitsAndItsPlaceInTheName) {
  const TemporaryFolder folder;
  for (const DeclaredTransmitter& transmitter : {kMonostatic, kFixed}) {
    const std::vector<RcsCut> cuts = cuts_of(transmitter);
    for (const bool v : {true, false}) {
      std::vector<FieldTable> tables;
      for (const NamedFile& file : cst_texts(cuts, v, "boat")) {
        write_file(folder.path() / file.name, file.text);
        tables.push_back(read_field_table(folder.path() / file.name, {}));
      }
      expect_equal(tables, cuts, v, 2e-8);  // -140 dBsm to 5e-8 dB, 6e-9 of the magnitude, and 5e-10 deg
    }
  }
  EXPECT_EQ(cst_texts(cuts_of(kMonostatic), true, "boat")[0].name,
            "boat (f = 9.3), theta = (85,90.25,5.25), phi = (0,200,100), VP.txt");
  EXPECT_EQ(cst_texts(cuts_of(kFixed), false, "boat")[1].name,
            "boat (f = 10.123456789), theta = 80, phi = 30.5, HP.txt");
  std::vector<RcsCut> across = cuts_of(kMonostatic);
  for (RcsCut& cut : across)
    for (FieldValue& value : cut.values) value.phi_deg = value.phi_deg == 200 ? 350 : value.phi_deg;
  EXPECT_EQ(cst_texts(across, true, "boat")[0].name,
            "boat (f = 9.3), theta = (85,90.25,5.25), phi = (-10,10.5,10.25), VP.txt");
}

TEST(FieldExport, OfWhatAFormatCannotHoldIsRefused) {
  const auto refusal = [](const auto& write) { return refusal_of([&] { write(); }); };
  std::vector<RcsCut> cuts = cuts_of(kFixed);
  cuts.pop_back();
  EXPECT_EQ(refusal([&] { feko_text(cuts, true); }), "a .ffe needs both vv and hv");
  EXPECT_EQ(refusal([&] { feko_text(cuts, false); }), "accepted");
  cuts[0].values[3].amplitude_m.reset();
  EXPECT_EQ(refusal([&] { cst_texts(cuts, false, "a"); }), "a table of CST needs phases: hh has none");
  cuts[0].values.pop_back();
  cuts[0].values[3].amplitude_m.emplace();
  EXPECT_EQ(refusal([&] { cst_texts(cuts, false, "a"); }),
            "a table of CST needs vh and hh at the same directions and frequencies");
}

}  // namespace
}  // namespace seaglint
