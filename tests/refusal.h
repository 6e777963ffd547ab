// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sim/core/process/error.h"

namespace seaglint {

// Message of the InputError that the work throws; "accepted" where it throws none.
template <class Work>
std::string refusal_of(const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace seaglint
