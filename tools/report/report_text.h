// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Texts and tables of a report, all from metrics.json: results, comparison with the paper's statements, expert notes.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "sim/scenario/scenario.h"
#include "tools/report/class_names.h"

namespace seaglint {

// Each returns HTML.
std::string summary_tiles(const nlohmann::ordered_json& metrics);
std::string accuracy_tables(const nlohmann::ordered_json& metrics, const ClassNames& classes);
std::string claims_table(const nlohmann::ordered_json& metrics, const ClassNames& classes);
std::string feature_table(const nlohmann::ordered_json& metrics, const ClassNames& classes);
// expert note on the number of seas that the splits test
std::string note_of_seas(const nlohmann::ordered_json& metrics);
std::string expert_notes(const nlohmann::ordered_json& metrics, const Scenario& scenario);

}  // namespace seaglint
