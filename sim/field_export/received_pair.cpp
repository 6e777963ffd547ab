// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_export/received_pair.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim/core/process/error.h"

namespace seaglint {
namespace {

const char* name_of(Polarisation element) { return kPolarisationNames[static_cast<int>(element)]; }

bool same_place(const FieldValue& a, const FieldValue& b) {
  return a.frequency_hz == b.frequency_hz && a.theta_deg == b.theta_deg && a.phi_deg == b.phi_deg;
}

}  // namespace

void require_complete(const RcsCut& cut, const char* format) {
  const auto fail = [&](const char* what) {
    throw InputError(fmt::format("{} needs {}: {} has none", format, what, name_of(cut.element)));
  };
  if (cut.values.empty()) fail("values");
  if (!cut.transmitter) fail("a transmitter");
  if (!std::all_of(cut.values.begin(), cut.values.end(), [](const FieldValue& value) { return value.amplitude_m; }))
    fail("phases");
}

std::vector<ReceivedPair> received_pairs(std::span<const RcsCut> cuts, bool transmitted_v, const char* format) {
  const Polarisation of_v = element_of(true, transmitted_v), of_h = element_of(false, transmitted_v);
  std::vector<ReceivedPair> pairs;
  for (const RcsCut& v : cuts) {
    if (v.element != of_v) continue;
    require_complete(v, format);
    const auto h = std::find_if(cuts.begin(), cuts.end(), [&](const RcsCut& other) {
      return other.element == of_h && other.transmitter && *other.transmitter == *v.transmitter;
    });
    if (h == cuts.end()) break;
    require_complete(*h, format);
    if (!std::equal(v.values.begin(), v.values.end(), h->values.begin(), h->values.end(), same_place)) {
      throw InputError(fmt::format("{} needs {} and {} at the same directions and frequencies", format, name_of(of_v),
                                   name_of(of_h)));
    }
    pairs.push_back({&v, &*h});
  }
  const auto of = [&](Polarisation element) {
    return std::count_if(cuts.begin(), cuts.end(), [&](const RcsCut& cut) { return cut.element == element; });
  };
  const auto count = static_cast<std::ptrdiff_t>(pairs.size());
  if (count == 0 || of(of_v) != count || of(of_h) != count)
    throw InputError(fmt::format("{} needs both {} and {}", format, name_of(of_v), name_of(of_h)));
  return pairs;
}

}  // namespace seaglint
