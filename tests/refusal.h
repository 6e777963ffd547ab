// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What messages say.

#include <gtest/gtest.h>

#include <string>

#include "sim/core/process/error.h"

// That a text contains another; compiled faster than HasSubstr().
#define EXPECT_HAS(text, part) EXPECT_PRED_FORMAT2(testing::IsSubstring, part, text)

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
