// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_export/write_pyaedt.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/field_export/received_pair.h"
#include "sim/field_tables/rows/pandas_table.h"

namespace seaglint {

PyaedtPair pyaedt_pair(const RcsCut& cut, const std::string& stem) {
  require_complete(cut, "an export of PyAEDT");
  if (!cut.transmitter->is_monostatic) throw InputError("an export of PyAEDT is monostatic: this cut is not");
  std::vector<PandasRow> rows;
  for (const FieldValue& value : cut.values) {
    const Complex component_m = is_cross(cut.element) ? -*value.amplitude_m : *value.amplitude_m;
    rows.push_back({value.frequency_hz * 1e-9, value.theta_deg, value.phi_deg, component_m * std::sqrt(4 * kPi)});
  }
  const nlohmann::ordered_json json = {{"solution", stem},
                                       {"monostatic_file", stem + ".h5"},
                                       {"model_units", "meter"},
                                       {"frequency_units", "GHz"},
                                       {"model_info", nlohmann::json::object()}};
  return {json.dump(2) + "\n", pandas_table_bytes(rows)};
}

}  // namespace seaglint
