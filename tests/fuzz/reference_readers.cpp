// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "sim/field_tables/rcs_reference.h"
#include "tests/fuzz/readers.h"
#include "tests/fuzz/refusal.h"

namespace seaglint {
namespace {

void read_cut(const std::string& bytes, const ReferenceSettings& settings) {
  is_refused([&] {
    const RcsReference cut = read_reference(file_of(bytes, "cut.H.txt"), settings);
    for (const ReferenceSample& sample : cut.samples) {
      SEAGLINT_CHECK(std::isfinite(sample.theta_deg) && std::isfinite(sample.phi_deg) && sample.frequency_hz > 0,
                     "no direction or frequency");
    }
  });
}

}  // namespace

void fuzz_rcs_cut(const std::string& bytes) { read_cut(bytes, {}); }

void fuzz_cst(const std::string& bytes) {
  ReferenceSettings settings;
  settings.frequency_hz = 10e9;
  read_cut(bytes, settings);
}

}  // namespace seaglint
