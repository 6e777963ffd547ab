// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "sim/core/process/file.h"
#include "sim/field_tables/field_formats.h"
#include "sim/field_tables/field_table.h"
#include "tests/fuzz/readers.h"

namespace seaglint {
namespace {

void read_file_of(const std::filesystem::path& file, const FieldTableSettings& settings) {
  is_refused([&] {
    for (const RcsCut& cut : read_field_table(file, settings).cuts) {
      SEAGLINT_CHECK(!cut.values.empty(), "a cut without values");
      for (const FieldValue& value : cut.values)
        SEAGLINT_CHECK(std::isfinite(value.theta_deg) && std::isfinite(value.phi_deg) && value.frequency_hz > 0 &&
                           std::isfinite(value.level_dbsm),
                       "no direction, frequency or level");
    }
  });
}

void read_export(const std::string& bytes, const FieldTableSettings& settings) {
  read_file_of(file_of(bytes, "export.txt"), settings);
}

FieldTableSettings of_both_received() {
  FieldTableSettings settings;
  settings.elements = {Polarisation::kVv, Polarisation::kHv};
  return settings;
}

}  // namespace

void fuzz_rcs_cut(const std::string& bytes) {
  FieldTableSettings settings;
  settings.elements = {Polarisation::kHh};
  read_export(bytes, settings);
}

void fuzz_own_table(const std::string& bytes) { read_export(bytes, {}); }

void fuzz_named_columns(const std::string& bytes) {
  FieldTableSettings settings;
  settings.frequency_hz = 10e9;
  settings.elevation_deg = 8;
  read_export(bytes, settings);
}

void fuzz_cst(const std::string& bytes) {
  FieldTableSettings settings = of_both_received();
  settings.frequency_hz = 10e9;
  read_export(bytes, settings);
}

void fuzz_cst_curves(const std::string& bytes) {
  FieldTableSettings settings;
  settings.elements = {Polarisation::kVv};
  settings.frequency_hz = 10e9;
  read_export(bytes, settings);
}

void fuzz_ffs(const std::string& bytes) { read_export(bytes, of_both_received()); }

void fuzz_ffe(const std::string& bytes) { read_export(bytes, {}); }

void fuzz_hfss(const std::string& bytes) { read_export(bytes, of_both_received()); }

void fuzz_pyaedt(const std::string& bytes) {
  file_of(R"({"monostatic_file": "export_VV.h5", "frequency_units": "GHz"})", "export_VV.json");
  read_file_of(file_of(bytes, "export_VV.h5"), {});
}

void fuzz_pyaedt_json(const std::string& bytes) {
  static const std::string table = read_file(SEAGLINT_SOURCE_DIR "/tests/cases/exports/pyaedt_VV.h5");
  file_of(table, "export_HH.h5");
  read_file_of(file_of(bytes, "export_HH.json"), {});
}

}  // namespace seaglint
