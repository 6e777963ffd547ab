// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Both elements of one transmitted polarisation, which files of far fields hold together.

#include <span>
#include <vector>

#include "sim/field_tables/field_table.h"

namespace seaglint {

struct ReceivedPair {
  const RcsCut* v = nullptr;
  const RcsCut* h = nullptr;

  const DeclaredTransmitter& transmitter() const { return *v->transmitter; }
  const std::vector<FieldValue>& places() const { return v->values; }
  // S in metres of a value, about the phase origin and in the directions of the cut.
  Complex s_v(std::size_t n) const { return *v->values[n].amplitude_m; }
  Complex s_h(std::size_t n) const { return *h->values[n].amplitude_m; }
};

// The pairs of the cuts with this transmitted polarisation, one per transmitter. Throws InputError "FORMAT needs ..."
// if there is none, an element is missing or has other directions and frequencies, no phase or no transmitter.
std::vector<ReceivedPair> received_pairs(std::span<const RcsCut> cuts, bool transmitted_v, const char* format);

// Throws InputError "FORMAT needs phases" etc. unless the cut has values, phases and a transmitter.
void require_complete(const RcsCut& cut, const char* format);

}  // namespace seaglint
